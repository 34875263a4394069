#pragma once

#include "scene/scene.hpp"
#include "sliding/wedge/wedge.hpp"

#include <string>
#include <vector>

/// The rock wedge of a scene, which takes the place of the rigid block.
namespace damslip {

/// The wedge, the ground motion that drives it and what it does then.
struct RigidWedge {
    sliding::Wedge wedge;
    sliding::WedgeState still; ///< without earthquake
    double azimuth = 0.0;      ///< positive a_h drives the wedge this way [rad]
    Vector3 push{};            ///< unit vector of it
    sliding::WedgeYields yields;
};

/// @param gravity  [m/s^2]
sliding::Wedge make_wedge(const RockWedge& wedge, double gravity);

/// @pre scene.wedge
RigidWedge make_rigid_wedge(const Scene& scene);

/// Friction of the first plane at which a wedge just stands as it is in `state`, the second keeping its share of it as
/// with_friction() has it [-]; infinite when it lifts or no friction would do. Of planes alike it is that of both.
double critical_first_friction(const sliding::Wedge& wedge, const sliding::WedgeState& state);

/// How long the plane or line is that it slides on [m]; none where the scene gives no surfaces, or it lifts.
std::optional<double> sliding_length(const RockWedge& wedge, sliding::WedgeMode mode);

/// The yield under ground motion of one direction.
struct WedgeYieldRow {
    std::string motion;            ///< "record", "opposite", "most unfavourable", "ground down", "ground up"
    std::optional<double> azimuth; ///< it drives the wedge this way [rad]; none: vertical
    sliding::WedgeYield yield;
};

/// Along the records and against them, the least over all azimuths to 1 degree, and vertical.
std::vector<WedgeYieldRow> wedge_yield_rows(const RigidWedge& wedge);

/// Yield accelerations over the azimuth the motion drives to, every 5 degrees from 0 to 360 [m/s^2].
std::vector<double> yields_over_azimuth(const sliding::Wedge& wedge);

/// "both planes, along their line", "plane 1 alone", ...
std::string mode_words(const RockWedge& names, sliding::WedgeMode mode);

} // namespace damslip
