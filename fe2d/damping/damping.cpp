#include "fe2d/damping/damping.hpp"

#include "core/input_error.hpp"
#include "core/units.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace damslip::fe2d {

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
