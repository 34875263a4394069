#include "fe2d/run/tied_frequencies.hpp"
#include "fe2d/solver/dense_algebra.hpp"

#include <cmath>
#include <cstdint>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int largest_space = 60;         ///< vectors; a few frequencies take ten to twenty
constexpr double largest_error = 1e-13;   ///< of 1/ω², relative
constexpr double smallest_change = 1e-14; ///< of a new vector's length to the old one's; below, the space is complete

bool fits(const ContactStructure& structure)
{
    return structure.regular() && structure.planes().count() == 1 && !structure.water() && !structure.rock_moves() &&
           (!structure.has_rock() || structure.matching());
}

/// The dam on what holds its base.
class TiedStiffness {
public:
    explicit TiedStiffness(const ContactStructure& structure) : factor_(structure.static_factor())
    {
        if (!structure.has_rock()) return;
        const auto& gaps = structure.planes().gaps(); // square: turns the interface to the plane's axes
        const MatrixXd rock = structure.rock_stiffness() * gaps;
        base_.emplace(factor_.schur() + gaps.transpose() * rock);
    }

    bool regular() const { return !base_ || base_->info() == Eigen::Success; }

    VectorXd solve(VectorXd load) const
    {
        const Index base = load.size() - factor_.inner_unknowns();
        factor_.forward(load);
        if (base_)
            load.tail(base) = base_->solve(load.tail(base)).eval();
        else
            load.tail(base).setZero();
        factor_.backward(load);
        return load;
    }

private:
    const InterfaceFactor& factor_;
    std::optional<Eigen::LLT<MatrixXd>> base_; ///< nothing: rigid
};

/// A motion that no mode is orthogonal to but by accident: it changes from unknown to unknown by numbers of a linear
/// congruential sequence, the same every time.
VectorXd start_motion(Index n)
{
    VectorXd motion(n);
    std::uint32_t state = 20150101u;
    for (Index i = 0; i < n; ++i) {
        state = 1664525u * state + 1013904223u;
        motion[i] = (i % 2 == 0 ? 1.0 : 0.5) * (0.5 + static_cast<double>(state) / 4294967296.0);
    }
    return motion;
}

/// The largest `count` eigenvalues, descending, if their errors are small enough.
/// @param last  length of the next vector
std::optional<VectorXd> converged(const VectorXd& diagonal, const VectorXd& off, double last, Index count)
{
    const Index size = diagonal.size();
    if (size <= count) return std::nullopt;
    Eigen::SelfAdjointEigenSolver<MatrixXd> solver;
    solver.computeFromTridiagonal(diagonal, off.head(size - 1));
    const VectorXd values = solver.eigenvalues().reverse();
    for (Index i = 0; i < count; ++i) {
        const double residual = std::abs(last * solver.eigenvectors()(size - 1, size - 1 - i));
        double gap = values[i] - values[i + 1] - residual;
        if (i > 0) gap = std::min(gap, values[i - 1] - values[i] - residual);
        const double error = gap > 0.0 ? std::min(residual, residual * residual / gap) : residual;
        if (!(error <= largest_error * values[i])) return std::nullopt;
    }
    return values.head(count);
}

} // namespace

std::optional<VectorXd> tied_frequencies(const ContactStructure& structure, int count)
{
    if (!fits(structure) || count < 1) return std::nullopt;
    const TiedStiffness stiffness(structure);
    if (!stiffness.regular()) return std::nullopt;
    const SparseMatrix& mass = structure.mass();
    MatrixXd vectors(mass.rows(), largest_space), momenta = vectors; // q and M q
    VectorXd diagonal(largest_space), off(largest_space);

    VectorXd next = stiffness.solve(mass * start_motion(mass.rows()));
    VectorXd momentum = mass * next;
    double length = std::sqrt(next.dot(momentum));
    for (Index k = 0; k < largest_space; ++k) {
        if (!(length > 0.0)) return std::nullopt;
        vectors.col(k) = next / length;
        momenta.col(k) = momentum / length;
        next = stiffness.solve(momenta.col(k));
        diagonal[k] = next.dot(momenta.col(k));
        for (int twice = 0; twice < 2; ++twice)
            next -= vectors.leftCols(k + 1) * (momenta.leftCols(k + 1).transpose() * next).eval();
        momentum = mass * next;
        length = off[k] = std::sqrt(std::max(0.0, next.dot(momentum)));
        if (!(length > smallest_change * diagonal[0])) return std::nullopt;
        if (const auto found = converged(diagonal.head(k + 1), off, length, count))
            return found->cwiseSqrt().cwiseInverse();
    }
    return std::nullopt;
}

} // namespace damslip::fe2d
