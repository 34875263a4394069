#pragma once

#include "fe2d/damping/modified_rayleigh.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace damslip::fe2d {

/// The damping of one run: C = a_M M_structure + b_K K. The added mass of the water is not damped.
struct DampingChoice {
    RayleighConstants constants;              ///< zero: no damping
    MassDamping mass = MassDamping::relative; ///< which velocity a_M resists
    std::optional<ModifiedRayleigh> modified; ///< how the constants were found, where they are modified Rayleigh's
    std::vector<std::string> notes;           ///< what was chosen and what the user should know
};

/// Modes to compute for a choice: the second Rayleigh mode at least; modified Rayleigh needs most of the mass, 20 as a rule.
int modes_needed(const Damping& damping);

/// What the scene's [damping] asks for.
/// @param modes  ascending; a mode that was not found is replaced by the last one, and a note says so
/// @param total_mass  that horizontal motion can move [kg/m]
/// @param spectral_acceleration  used by modified Rayleigh only
/// a_M or b_K given directly take the place of the ones from ratio and modes.
/// @throws NotConverged where modes are needed and none was found
DampingChoice choose_damping(const Damping& damping, const std::vector<ModalMass>& modes, double total_mass,
                             const SpectralAcceleration& spectral_acceleration);

} // namespace damslip::fe2d
