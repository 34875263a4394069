#include "fe2d/damping/modified_rayleigh.hpp"

#include "core/units.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace damslip::fe2d {

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

using units::hertz;

void warn_of_missing_mass(ModifiedRayleigh& result, const ModifiedRayleighOptions& options, std::size_t modes)
{
    if (result.mass_share < options.required_mass)
        result.warnings.push_back(fmt::format(
            "modified Rayleigh damping: {} modes carry {:.1f} % of the horizontal mass; at least {:.0f} % are needed, "
            "use more modes",
            modes, 100.0 * result.mass_share, 100.0 * options.required_mass));
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
        result.warnings.push_back(fmt::format("modified Rayleigh damping: no second frequency between {:.3g} and "
                                              "{:.3g} Hz balances the base shear; ordinary "
                                              "Rayleigh damping on {:.3g} and {:.3g} Hz is used, which changes the "
                                              "base shear by |dS| = {:.3g} kN/m ({:.1f} %)",
                                              hertz(first), hertz(3.0 * modes.back().frequency), hertz(first),
                                              hertz(result.second_frequency), 1e-3 * std::abs(result.imbalance),
                                              100.0 * result.relative_imbalance));
    return result;
}

} // namespace damslip::fe2d
