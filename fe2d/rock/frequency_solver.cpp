#include "fe2d/rock/frequency_solver.hpp"

#include "fe2d/solver/blas_threads.hpp"

#include <umfpack.h>

#include <array>
#include <cassert>
#include <new>

namespace damslip::fe2d {

using Eigen::Index;

struct FrequencySolver::Implementation {
    // One pattern for all three; UMFPACK takes real and imaginary parts apart.
    Matrix mass, damping, stiffness;
    Eigen::VectorXd real, imaginary;
    void* symbolic = nullptr;
    void* numeric = nullptr;
    std::array<double, UMFPACK_CONTROL> control{};
    int factorisations = 0;

    ~Implementation()
    {
        if (numeric) umfpack_zi_free_numeric(&numeric);
        if (symbolic) umfpack_zi_free_symbolic(&symbolic);
    }
};

FrequencySolver::FrequencySolver(const Matrix& mass, const Matrix& damping, const Matrix& stiffness)
    : implementation_(std::make_unique<Implementation>())
{
    assert(mass.rows() == stiffness.rows() && damping.rows() == stiffness.rows());
    Implementation& s = *implementation_;
    const auto pattern = [](Matrix m) {
        m.makeCompressed();
        m.coeffs().setOnes();
        return m;
    };
    Matrix zero = pattern(mass) + pattern(damping) + pattern(stiffness);
    zero.makeCompressed();
    zero.coeffs().setZero();
    s.mass = mass + zero;
    s.damping = damping + zero;
    s.stiffness = stiffness + zero;
    assert(s.mass.nonZeros() == zero.nonZeros() && s.damping.nonZeros() == zero.nonZeros());
    umfpack_zi_defaults(s.control.data());
    s.control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
    s.control[UMFPACK_IRSTEP] = 0;
    use_one_blas_thread();
}

FrequencySolver::~FrequencySolver() = default;

bool FrequencySolver::factorise(double frequency, double growth)
{
    Implementation& s = *implementation_;
    const auto n = static_cast<int>(s.stiffness.rows());
    s.real = s.stiffness.coeffs() + growth * s.damping.coeffs() +
             (growth * growth - frequency * frequency) * s.mass.coeffs();
    s.imaginary = frequency * s.damping.coeffs() + 2.0 * growth * frequency * s.mass.coeffs();
    const int *columns = s.stiffness.outerIndexPtr(), *rows = s.stiffness.innerIndexPtr();
    if (s.numeric) umfpack_zi_free_numeric(&s.numeric);
    int status = UMFPACK_OK;
    if (!s.symbolic)
        status = umfpack_zi_symbolic(n, n, columns, rows, s.real.data(), s.imaginary.data(), &s.symbolic,
                                     s.control.data(), nullptr);
    if (status == UMFPACK_OK)
        status = umfpack_zi_numeric(columns, rows, s.real.data(), s.imaginary.data(), s.symbolic, &s.numeric,
                                    s.control.data(), nullptr);
    if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
    ++s.factorisations;
    return status == UMFPACK_OK;
}

Eigen::MatrixXcd FrequencySolver::solve(const Eigen::MatrixXd& loads) const
{
    const Implementation& s = *implementation_;
    const Index n = s.stiffness.rows();
    assert(s.numeric && loads.rows() == n);
    const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(n);
    Eigen::VectorXd x(n), y(n), w(4 * n);
    Eigen::VectorXi wi(n);
    Eigen::MatrixXcd solution(n, loads.cols());
    for (Index k = 0; k < loads.cols(); ++k) {
        umfpack_zi_wsolve(UMFPACK_A, s.stiffness.outerIndexPtr(), s.stiffness.innerIndexPtr(), s.real.data(),
                          s.imaginary.data(), x.data(), y.data(), loads.col(k).data(), nothing.data(), s.numeric,
                          s.control.data(), nullptr, wi.data(), w.data());
        solution.col(k).real() = x;
        solution.col(k).imag() = y;
    }
    return solution;
}

int FrequencySolver::factorisations() const
{
    return implementation_->factorisations;
}

} // namespace damslip::fe2d
