#include "fe2d/modes/modes_and_damping.hpp"

#include "core/input_error.hpp"
#include "core/units.hpp"
#include "fe2d/assembly/assemble.hpp"
#include "fe2d/solver/dense_product.hpp"
#include "fe2d/solver/linear_solver.hpp"

#include <Eigen/SparseCholesky>
#include <Spectra/SymEigsSolver.h>
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
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

namespace {

using units::hertz;

/// Index of a mode counted from 1, or of the last there is.
std::size_t mode_index(int mode, const std::vector<ModalMass>& modes, DampingChoice& choice)
{
    const auto index = static_cast<std::size_t>(std::max(mode, 1) - 1);
    if (index < modes.size()) return index;
    choice.notes.push_back({NoteKind::mode_missing, {std::int64_t{mode}, static_cast<std::int64_t>(modes.size())}});
    return modes.size() - 1;
}

void note(const Damping& damping, DampingChoice& choice, double first, double second)
{
    choice.notes.push_back({NoteKind::damping_of_modes,
                            {100.0 * damping.ratio, hertz(first), hertz(second), choice.constants.mass,
                             choice.constants.stiffness}});
}

void choose_constants(const Damping& damping, const std::vector<ModalMass>& modes, double total_mass,
                      const SpectralAcceleration& spectral_acceleration, DampingChoice& choice)
{
    if (modes.empty())
        throw NotConverged(Diagnostic{"", 0, 0, "no natural mode was found that damping could be taken from.",
                                      "masses and stiffnesses of real dams",
                                      "check density and moduli, or give damping.mass_coefficient_1_s and "
                                      "damping.stiffness_coefficient_s"});
    const std::size_t first = mode_index(damping.first_mode, modes, choice);
    const std::size_t second = mode_index(damping.second_mode, modes, choice);
    double second_frequency = modes[second].frequency;
    if (damping.method == DampingMethod::modified_rayleigh) {
        choice.modified = modified_rayleigh(
            modes, spectral_acceleration,
            {.ratio = damping.ratio, .first_mode = first, .ordinary_mode = second, .total_mass = total_mass});
        choice.constants = choice.modified->constants;
        second_frequency = choice.modified->second_frequency;
        choice.notes.insert(choice.notes.end(), choice.modified->warnings.begin(), choice.modified->warnings.end());
    } else {
        choice.constants = rayleigh_constants(damping.ratio, modes[first].frequency, second_frequency);
    }
    note(damping, choice, modes[first].frequency, second_frequency);
}

} // namespace

int modes_needed(const Damping& damping)
{
    const int pair = std::max({damping.first_mode, damping.second_mode, 1});
    switch (damping.method) {
    case DampingMethod::none:
        return 0;
    case DampingMethod::rayleigh:
        return damping.mass_coefficient && damping.stiffness_coefficient ? 0 : pair;
    case DampingMethod::modified_rayleigh:
        return std::max(pair, 20);
    }
    return pair;
}

DampingChoice choose_damping(const Damping& damping, const std::vector<ModalMass>& modes, double total_mass,
                             const SpectralAcceleration& spectral_acceleration)
{
    DampingChoice choice;
    choice.mass = damping.mass;
    if (damping.method == DampingMethod::none) return choice;
    if (modes_needed(damping) > 0) choose_constants(damping, modes, total_mass, spectral_acceleration, choice);
    if (damping.mass_coefficient) choice.constants.mass = *damping.mass_coefficient;
    if (damping.stiffness_coefficient) choice.constants.stiffness = *damping.stiffness_coefficient;
    if (damping.mass_coefficient || damping.stiffness_coefficient)
        choice.notes.push_back({NoteKind::damping_given, {choice.constants.mass, choice.constants.stiffness}});
    return choice;
}

RayleighConstants rayleigh_constants(double ratio, double first_frequency, double second_frequency)
{
    assert(ratio >= 0.0 && first_frequency > 0.0 && second_frequency > 0.0);
    const double sum = first_frequency + second_frequency;
    return {2.0 * ratio * first_frequency * second_frequency / sum, 2.0 * ratio / sum};
}

double damping_ratio(const RayleighConstants& constants, double frequency)
{
    return 0.5 * (constants.mass / frequency + constants.stiffness * frequency);
}

namespace {

/// ΔS as a function of ω_j, with the part that does not depend on it computed once.
class Imbalance {
public:
    Imbalance(const std::vector<ModalMass>& modes, const SpectralAcceleration& spectral_acceleration, double ratio,
              double first_frequency)
        : modes_(modes), spectral_acceleration_(spectral_acceleration), ratio_(ratio), first_frequency_(first_frequency)
    {
        for (const ModalMass& mode : modes)
            wanted_ += spectral_acceleration(mode.frequency, ratio) * mode.effective_mass_x;
    }

    double wanted() const { return wanted_; }
    RayleighConstants constants(double second_frequency) const
    {
        return rayleigh_constants(ratio_, first_frequency_, second_frequency);
    }
    double operator()(double second_frequency) const
    {
        const RayleighConstants c = constants(second_frequency);
        double sum = 0.0;
        for (const ModalMass& mode : modes_)
            sum += spectral_acceleration_(mode.frequency, damping_ratio(c, mode.frequency)) * mode.effective_mass_x;
        return sum - wanted_;
    }

private:
    const std::vector<ModalMass>& modes_;
    const SpectralAcceleration& spectral_acceleration_;
    double ratio_, first_frequency_, wanted_ = 0.0;
};

/// Root between a and b, where f changes sign. Bisection: f is continuous but has kinks where the peak changes its
/// place.
double bisect(const Imbalance& f, double a, double b, double f_a)
{
    while (b - a > 1e-12 * b) {
        const double middle = 0.5 * (a + b);
        if (middle <= a || middle >= b) break;
        const double f_middle = f(middle);
        if (f_middle == 0.0) return middle;
        if ((f_middle > 0.0) == (f_a > 0.0)) {
            a = middle;
        } else {
            b = middle;
        }
    }
    return 0.5 * (a + b);
}

std::vector<double> sign_changes(const Imbalance& f, double from, double to, int points)
{
    std::vector<double> roots;
    const double ratio = std::pow(to / from, 1.0 / points);
    double left = from * (1.0 + 1e-9), f_left = f(left);
    for (int k = 1; k <= points; ++k) {
        const double right = k == points ? to : from * std::pow(ratio, k), f_right = f(right);
        if (f_right == 0.0) {
            roots.push_back(right);
        } else if (f_left != 0.0 && (f_left > 0.0) != (f_right > 0.0)) {
            roots.push_back(bisect(f, left, right, f_left));
        }
        left = right;
        f_left = f_right;
    }
    return roots;
}

void warn_of_missing_mass(ModifiedRayleigh& result, const ModifiedRayleighOptions& options, std::size_t modes)
{
    if (result.mass_share < options.required_mass)
        result.warnings.push_back({NoteKind::modes_lack_mass,
                                   {static_cast<std::int64_t>(modes), 100.0 * result.mass_share,
                                    100.0 * options.required_mass}});
}

} // namespace

double shear_imbalance(const std::vector<ModalMass>& modes, const SpectralAcceleration& spectral_acceleration,
                       double ratio, const RayleighConstants& constants)
{
    double sum = 0.0;
    for (const ModalMass& mode : modes)
        sum += (spectral_acceleration(mode.frequency, damping_ratio(constants, mode.frequency)) -
                spectral_acceleration(mode.frequency, ratio)) *
               mode.effective_mass_x;
    return sum;
}

ModifiedRayleigh modified_rayleigh(const std::vector<ModalMass>& modes,
                                   const SpectralAcceleration& spectral_acceleration,
                                   const ModifiedRayleighOptions& options)
{
    assert(options.first_mode < modes.size() && options.total_mass > 0.0 && options.scan_points >= 2);
    const double first = modes[options.first_mode].frequency;
    const Imbalance imbalance(modes, spectral_acceleration, options.ratio, first);

    ModifiedRayleigh result;
    for (const ModalMass& mode : modes) result.mass_share += mode.effective_mass_x / options.total_mass;
    warn_of_missing_mass(result, options, modes.size());
    result.sign_changes = sign_changes(imbalance, first, 3.0 * modes.back().frequency, options.scan_points);
    if (!result.sign_changes.empty()) {
        result.status = ModifiedRayleighStatus::found;
        result.second_frequency = result.sign_changes.front();
    } else {
        result.second_frequency = modes[std::min(options.ordinary_mode, modes.size() - 1)].frequency;
    }
    result.constants = imbalance.constants(result.second_frequency);
    result.imbalance = imbalance(result.second_frequency);
    result.relative_imbalance = imbalance.wanted() > 0.0 ? std::abs(result.imbalance) / imbalance.wanted() : 0.0;
    if (result.status == ModifiedRayleighStatus::no_solution)
        result.warnings.push_back({NoteKind::no_second_frequency,
                                   {hertz(first), hertz(3.0 * modes.back().frequency), hertz(result.second_frequency),
                                    1e-3 * std::abs(result.imbalance), 100.0 * result.relative_imbalance}});
    return result;
}

void LowRank::add_product(const Eigen::VectorXd& x, double factor, Eigen::VectorXd& result) const
{
    if (!empty()) result.noalias() += columns * (factor * (core * (columns.transpose() * x)));
}

LowRank deformation_only_correction(double mass_coefficient, const Eigen::SparseMatrix<double>& mass,
                                    const Eigen::VectorXd& rigid_translation, const Eigen::VectorXd& slip_weights)
{
    assert(std::abs(slip_weights.dot(rigid_translation) - 1.0) < 1e-9);
    const Eigen::VectorXd momentum = mass * rigid_translation;
    const double modal_mass = rigid_translation.dot(momentum);
    // Columns of like size keep the small system of Woodbury's formula well scaled: M r is divided by rᵀM r.
    LowRank correction;
    correction.columns.resize(mass.rows(), 2);
    correction.columns << slip_weights, momentum / modal_mass;
    correction.core.resize(2, 2);
    correction.core << 1.0, -1.0, -1.0, 0.0;
    correction.core *= mass_coefficient * modal_mass;
    return correction;
}

} // namespace damslip::fe2d
