#include "fe2d/damping/damping_choice.hpp"

#include "core/input_error.hpp"
#include "core/units.hpp"

#include <algorithm>
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
    choice.notes.push_back(fmt::format("damping: mode {} was not found, mode {} takes its place", mode, modes.size()));
    return modes.size() - 1;
}

void note(const Damping& damping, DampingChoice& choice, double first, double second)
{
    choice.notes.push_back(fmt::format("damping: {:g} % at {:.4g} and {:.4g} Hz, a_M = {:.4g} 1/s, b_K = {:.4g} s",
                                       100.0 * damping.ratio, hertz(first), hertz(second), choice.constants.mass,
                                       choice.constants.stiffness));
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
        choice.notes.push_back(fmt::format("damping: as given, a_M = {:.4g} 1/s, b_K = {:.4g} s", choice.constants.mass,
                                           choice.constants.stiffness));
    return choice;
}

} // namespace damslip::fe2d
