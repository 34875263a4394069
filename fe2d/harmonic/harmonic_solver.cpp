#include "fe2d/harmonic/harmonic_solver.hpp"

#include "fe2d/assembly/shared_pattern.hpp"

#include <umfpack.h>

#include <array>
#include <cassert>
#include <vector>

namespace damslip::fe2d {

using Eigen::Index;

struct HarmonicSolver::Implementation {
    // One pattern for all three; UMFPACK takes real and imaginary parts apart.
    Eigen::SparseMatrix<double> mass, damping, stiffness;
    Eigen::VectorXd real, imaginary;
    std::vector<Index> block_places; ///< of the dense block's entries among those of the pattern, by columns
    void* symbolic = nullptr;
    void* numeric = nullptr;
    std::array<double, UMFPACK_CONTROL> control{};
    bool regular = false;

    ~Implementation()
    {
        if (numeric) umfpack_zi_free_numeric(&numeric);
        if (symbolic) umfpack_zi_free_symbolic(&symbolic);
    }
};

namespace {

/// Stored zeros at every pair of the unknowns.
Eigen::SparseMatrix<double> zero_block(std::span<const Index> unknowns, Index size)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (const Index column : unknowns)
        for (const Index row : unknowns) entries.emplace_back(row, column, 0.0);
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

} // namespace

HarmonicSolver::HarmonicSolver(const Matrix& mass, const Matrix& damping, const Matrix& stiffness,
                               std::span<const Index> block_at)
    : implementation_(std::make_unique<Implementation>())
{
    Implementation& s = *implementation_;
    SharedPattern shared = on_one_pattern(mass, damping, stiffness + zero_block(block_at, stiffness.rows()));
    s.mass = std::move(shared.mass);
    s.damping = std::move(shared.damping);
    s.stiffness = std::move(shared.stiffness);
    for (const Index column : block_at)
        for (const Index row : block_at)
            s.block_places.push_back(&s.stiffness.coeffRef(row, column) - s.stiffness.valuePtr());
    umfpack_zi_defaults(s.control.data());
}

HarmonicSolver::~HarmonicSolver() = default;
HarmonicSolver::HarmonicSolver(HarmonicSolver&&) noexcept = default;

bool HarmonicSolver::factorise(double frequency, const Eigen::MatrixXcd& block)
{
    Implementation& s = *implementation_;
    assert(static_cast<std::size_t>(block.size()) == s.block_places.size());
    const auto n = static_cast<int>(s.stiffness.rows());
    s.real = s.stiffness.coeffs() - frequency * frequency * s.mass.coeffs();
    s.imaginary = frequency * s.damping.coeffs();
    for (std::size_t k = 0; k < s.block_places.size(); ++k) {
        const std::complex<double> value = block.data()[k];
        s.real[s.block_places[k]] += value.real();
        s.imaginary[s.block_places[k]] += value.imag();
    }
    const int *columns = s.stiffness.outerIndexPtr(), *rows = s.stiffness.innerIndexPtr();
    if (s.numeric) umfpack_zi_free_numeric(&s.numeric);
    if (!s.symbolic)
        umfpack_zi_symbolic(n, n, columns, rows, s.real.data(), s.imaginary.data(), &s.symbolic, s.control.data(),
                            nullptr);
    s.regular = s.symbolic && umfpack_zi_numeric(columns, rows, s.real.data(), s.imaginary.data(), s.symbolic,
                                                 &s.numeric, s.control.data(), nullptr) == UMFPACK_OK;
    return s.regular;
}

Eigen::VectorXcd HarmonicSolver::solve(const Eigen::VectorXcd& right_hand_side) const
{
    const Implementation& s = *implementation_;
    assert(s.regular && right_hand_side.size() == s.stiffness.rows());
    const Eigen::VectorXd b = right_hand_side.real(), c = right_hand_side.imag();
    Eigen::VectorXd x(b.size()), y(b.size());
    umfpack_zi_solve(UMFPACK_A, s.stiffness.outerIndexPtr(), s.stiffness.innerIndexPtr(), s.real.data(),
                     s.imaginary.data(), x.data(), y.data(), b.data(), c.data(), s.numeric, s.control.data(), nullptr);
    Eigen::VectorXcd solution(b.size());
    solution.real() = x;
    solution.imag() = y;
    return solution;
}

} // namespace damslip::fe2d
