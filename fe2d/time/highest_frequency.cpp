#include "fe2d/solver/dense_algebra.hpp"
#include "fe2d/solver/linear_solver.hpp"
#include "fe2d/time/linear_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace damslip::fe2d {

namespace {

/// A start vector no mode is orthogonal to in practice: alternating signs, unequal sizes, always the same.
Eigen::VectorXd start_vector(Eigen::Index size)
{
    Eigen::VectorXd x(size);
    for (Eigen::Index k = 0; k < size; ++k)
        x[k] = (k % 2 == 0 ? 1.0 : -1.0) * (1.0 + 0.3 * std::sin(1.7 * static_cast<double>(k)));
    return x;
}

} // namespace

/// Lanczos' method for M⁻¹K in the inner product of M, every vector made orthogonal to all before it.
double highest_frequency(const LinearSystem& system)
{
    const std::vector<char> massless = massless_unknowns(system.mass);
    if (std::find(massless.begin(), massless.end(), 1) != massless.end())
        return std::numeric_limits<double>::infinity();
    LinearSolver mass;
    if (!mass.factorise(system.mass).ok()) return std::numeric_limits<double>::infinity();
    const Eigen::Index size = system.size(), most = std::min<Eigen::Index>(80, size);
    Eigen::MatrixXd basis(size, most), momenta(size, most);
    Eigen::VectorXd diagonal(most), off_diagonal(most);
    Eigen::VectorXd next = start_vector(size);
    Eigen::Index steps = 0;
    double norm = std::sqrt(next.dot(system.mass * next));
    while (steps < most && norm > 1e-10 * (steps > 0 ? diagonal[0] : 0.0)) {
        basis.col(steps) = next / norm;
        momenta.col(steps) = system.mass * basis.col(steps);
        next = mass.solve(Eigen::VectorXd(system.stiffness * basis.col(steps)));
        diagonal[steps] = next.dot(momenta.col(steps));
        for (int twice = 0; twice < 2; ++twice)
            next -= basis.leftCols(steps + 1) * (momenta.leftCols(steps + 1).transpose() * next);
        norm = std::sqrt(std::max(0.0, next.dot(system.mass * next)));
        off_diagonal[steps++] = norm;
    }
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
    ritz.computeFromTridiagonal(diagonal.head(steps), off_diagonal.head(std::max<Eigen::Index>(steps - 1, 0)),
                                Eigen::EigenvaluesOnly);
    return std::sqrt(std::max(0.0, ritz.eigenvalues().maxCoeff()));
}

} // namespace damslip::fe2d
