#include "fe2d/modes/natural_modes.hpp"

#include "fe2d/assembly/assemble.hpp"
#include "fe2d/solver/dense_product.hpp"
#include "fe2d/solver/linear_solver.hpp"

#include <Eigen/SparseCholesky>
#include <Spectra/SymEigsSolver.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace damslip::fe2d {

/// The symmetric operator  y -> L^T K^-1 L y  on the unknowns that have mass, M = L L^T there; its eigenvalues are 1 /
/// omega^2. In the form Spectra asks for.
class FlexibilityOperator {
public:
    using Scalar = double;

    /// `solver` holds the factorised K; both must outlive the operator. `valid()` is false when the mass is not
    /// positive definite.
    FlexibilityOperator(const LinearSolver& solver, const SparseMatrix& mass);

    bool valid() const { return factor_.info() == Eigen::Success; }
    Eigen::Index rows() const { return static_cast<Eigen::Index>(massive_.size()); }
    Eigen::Index cols() const { return rows(); }
    void perform_op(const double* in, double* out) const;

    Eigen::VectorXd
    displacement(const Eigen::VectorXd& y) const; ///< K^-1 L y on all unknowns: the mode shape up to its scale
    int applications() const { return applications_; }

private:
    const LinearSolver& solver_;
    std::vector<int> massive_; ///< unknowns with mass
    Eigen::Index unknowns_;
    Eigen::SimplicialLLT<SparseMatrix> factor_;
    SparseMatrix lower_; ///< L in the factor's order of unknowns
    mutable int applications_ = 0;
};

namespace {

struct EigenPairs {
    Eigen::VectorXd values; ///< 1 / omega^2, largest first
    Eigen::MatrixXd vectors;
};

/// The whole spectrum, for systems too small for a Krylov space.
EigenPairs all_pairs(const FlexibilityOperator& op, int count)
{
    Eigen::MatrixXd dense(op.rows(), op.rows());
    for (Eigen::Index j = 0; j < op.rows(); ++j) {
        const Eigen::VectorXd unit = Eigen::VectorXd::Unit(op.rows(), j);
        op.perform_op(unit.data(), dense.col(j).data());
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(dense);
    return {solver.eigenvalues().reverse().head(count), solver.eigenvectors().rowwise().reverse().leftCols(count)};
}

/// A start vector without symmetry and the same every time: a linear congruential sequence in -1 ... 1.
Eigen::VectorXd start_vector(Eigen::Index n)
{
    Eigen::VectorXd v(n);
    std::uint32_t state = 20150101u;
    for (double& x : v) {
        state = 1664525u * state + 1013904223u;
        x = static_cast<double>(state) / 2147483648.0 - 1.0;
    }
    return v;
}

EigenPairs largest_pairs(FlexibilityOperator& op, int count)
{
    const int n = static_cast<int>(op.rows());
    const int space = std::max(2 * count + 1, 20);
    if (space >= n) return all_pairs(op, count);
    Spectra::SymEigsSolver<FlexibilityOperator> solver(op, count, space);
    solver.init(start_vector(n).data());
    solver.compute(Spectra::SortRule::LargestMagn, 1000, 1e-13);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

/// Mass-normalised, the largest entry positive.
Eigen::VectorXd normalised(const Eigen::VectorXd& shape, const SparseMatrix& mass)
{
    Eigen::Index largest = 0;
    shape.cwiseAbs().maxCoeff(&largest);
    return shape * ((shape[largest] < 0.0 ? -1.0 : 1.0) / std::sqrt(shape.dot(mass * shape)));
}

} // namespace

NaturalModes natural_modes(const Model& model, int count, const SolverOptions& options)
{
    NaturalModes modes;
    const SparseMatrix mass = model.moving_mass();
    LinearSolver solver(options);
    modes.solver = solver.factorise(model.stiffness);
    if (!modes.solver.ok()) {
        modes.status = ModesStatus::solver_failed;
        return modes;
    }
    FlexibilityOperator op(solver, mass);
    if (!op.valid() || op.rows() == 0) {
        modes.status = ModesStatus::no_mass;
        return modes;
    }
    count = static_cast<int>(std::min<Eigen::Index>(count, op.rows()));
    const EigenPairs pairs = largest_pairs(op, count);
    modes.status = pairs.values.size() < count ? ModesStatus::not_converged : ModesStatus::ok;
    modes.operator_applications = op.applications();

    const Eigen::Index found = pairs.values.size();
    modes.frequency.resize(found);
    modes.shape.resize(model.dofs.count, found);
    modes.participation.resize(2, found);
    for (Eigen::Index i = 0; i < found; ++i) {
        modes.frequency[i] = 1.0 / (2.0 * std::numbers::pi * std::sqrt(pairs.values[i]));
        modes.shape.col(i) = normalised(op.displacement(pairs.vectors.col(i)), mass);
        modes.participation.col(i) << modes.shape.col(i).dot(model.inertia_x), modes.shape.col(i).dot(model.inertia_y);
    }
    modes.effective_mass = modes.participation.cwiseAbs2();
    modes.effective_share = model.total_mass.cwiseInverse().asDiagonal() * modes.effective_mass;
    return modes;
}

FlexibilityOperator::FlexibilityOperator(const LinearSolver& solver, const SparseMatrix& mass)
    : solver_(solver), unknowns_(mass.rows())
{
    std::vector<int> place(static_cast<std::size_t>(mass.rows()), no_dof);
    for (int i = 0; i < mass.rows(); ++i)
        if (mass.coeff(i, i) > 0.0) {
            place[i] = static_cast<int>(massive_.size());
            massive_.push_back(i);
        }
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < mass.cols(); ++j)
        for (SparseMatrix::InnerIterator it(mass, j); it; ++it)
            if (place[it.row()] != no_dof && place[j] != no_dof)
                entries.emplace_back(place[it.row()], place[j], it.value());
    SparseMatrix reduced(rows(), rows());
    reduced.setFromTriplets(entries.begin(), entries.end());
    factor_.compute(reduced);
    if (valid()) lower_ = factor_.matrixL();
}

Eigen::VectorXd FlexibilityOperator::displacement(const Eigen::VectorXd& y) const
{
    const Eigen::VectorXd force = factor_.permutationPinv() * (lower_ * y);
    Eigen::VectorXd full = Eigen::VectorXd::Zero(unknowns_);
    for (std::size_t i = 0; i < massive_.size(); ++i) full[massive_[i]] = force[static_cast<Eigen::Index>(i)];
    return solver_.solve(full);
}

void FlexibilityOperator::perform_op(const double* in, double* out) const
{
    ++applications_;
    const Eigen::VectorXd u = displacement(Eigen::Map<const Eigen::VectorXd>(in, rows()));
    Eigen::VectorXd massive(rows());
    for (std::size_t i = 0; i < massive_.size(); ++i) massive[static_cast<Eigen::Index>(i)] = u[massive_[i]];
    Eigen::Map<Eigen::VectorXd>(out, rows()) = lower_.transpose() * (factor_.permutationP() * massive);
}

double modal_correlation(double f_i, double f_j, double ratio)
{
    if (f_i == f_j) return 1.0;
    const double r = f_j / f_i, damping = ratio * ratio, apart = 1.0 - r * r;
    return 8.0 * damping * (1.0 + r) * r * std::sqrt(r) / (apart * apart + 4.0 * damping * r * (1.0 + r) * (1.0 + r));
}

Eigen::MatrixXd modal_correlations(const Eigen::VectorXd& frequency, double ratio, ModalRule rule)
{
    const Eigen::Index n = frequency.size();
    Eigen::MatrixXd rho = Eigen::MatrixXd::Identity(n, n);
    if (rule == ModalRule::srss) return rho;
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < i; ++j)
            rho(i, j) = rho(j, i) = modal_correlation(frequency[i], frequency[j], ratio);
    return rho;
}

double combined_product(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const Eigen::MatrixXd& correlation)
{
    return a.dot(correlation * b);
}

double combined_peak(const Eigen::VectorXd& modal, const Eigen::MatrixXd& correlation)
{
    return std::sqrt(std::max(0.0, combined_product(modal, modal, correlation)));
}

} // namespace damslip::fe2d
