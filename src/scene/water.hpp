#pragma once

#include "scene/scene.hpp"

#include <optional>

/// What a scene says of its water, for all who ask.
namespace damslip {

/// Water stands in the reservoir.
bool has_water(const Scene& scene);
/// It does, and waves travel through it.
bool is_acoustic(const Scene& scene);

double water_density(const Scene& scene);     ///< of the reservoir, of any water without one [kg/m^3]
double water_unit_weight(const Scene& scene); ///< γ_w, the same times the scene's gravity [N/m^3]

/// Water stands on the dam in the scene or in one of its load combinations, so that it can press up under the base.
bool water_on_dam(const Scene& scene);

/// Water stands on the dam, but there is no uplift: the base is taken as dry.
bool base_taken_as_dry(const Scene& scene);

enum class DrainState { effective, ineffective };
enum class CurtainState { intact, damaged };

/// The state of water and foundation that an uplift or a seepage belongs to.
struct UpliftState {
    std::optional<double> reservoir_level;       ///< above the heel [m]; none: dry
    std::optional<double> tailwater_level;       ///< above the heel [m]; none: dry
    DrainState drains = DrainState::effective;   ///< effective: as the scene says; ineffective: E = 0
    CurtainState curtain = CurtainState::intact; ///< intact: as the scene says; damaged: it holds nothing back
};

/// The scene's own levels, drains and curtain.
UpliftState scene_uplift_state(const Scene& scene);

/// Hydraulic conductivity of the rock [m/s]; without [foundation] the default of Foundation.
double rock_permeability(const Scene& scene);

/// Whether the curtain has an E or ν of its own, so that the solid model needs mesh lines around it. A curtain without a
/// modulus has that of the rock. False without a curtain or without flexible rock.
bool curtain_changes_stiffness(const Scene& scene);

/// The curtain is intact and has a permeability of its own: the flow model needs mesh lines around it.
bool curtain_changes_flow(const Scene& scene);

/// Some record of the scene has a vertical component.
bool any_vertical_record(const Scene& scene);

// What reads [drains] and [curtain]; beside anything else they change nothing.

/// The profile of the uplift model is lower where the scene has [drains].
bool reads_drains(UpliftModel model);

/// [drains] is given, and lowers the water pressure under the base or in a seam.
bool drains_lower_uplift(const Scene& scene);

/// The same, or it is read by finite elements alone: by the water in the rock, or the flow along a joint that opens.
bool drains_are_read(const Scene& scene);

/// [curtain] is given and read: by the uplift, the rock's stiffness, the water in the rock, or as the measure of a depth.
/// @param depth_given  foundation.depth_m stands in the scene file
bool curtain_is_read(const Scene& scene, bool depth_given);

} // namespace damslip
