#pragma once

#include "records/record.hpp"
#include "sliding/block/fixed_yield.hpp"

#include <array>

/// A rock wedge on two planes, whose way of sliding is found, not assumed. Hoek & Bray (1981), Rock Slope Engineering,
/// app. 2; Goodman (1989), Introduction to Rock Mechanics, ch. 8; cases after Warburton (1981), Int. J. Rock Mech. Min.
/// Sci. 18.
namespace damslip::sliding {

using Vector3 = std::array<double, 3>; ///< x east, y north, z up

struct WedgePlane {
    double dip = 0.0;           ///< from the horizontal, 0 ... pi/2 [rad]
    double dip_direction = 0.0; ///< clockwise from north [rad]
    double area = 0.0;          ///< [m^2]
    double friction = 0.0;      ///< tan phi [-]
    double cohesion = 0.0;      ///< c [Pa]
    double water_force = 0.0;   ///< normal to the plane, lifts the wedge [N]
};

/// The wedge lies above both planes.
struct Wedge {
    WedgePlane first, second;
    double mass = 0.0;     ///< [kg]
    double gravity = 9.81; ///< [m/s^2]
};

enum class WedgeMode { both_planes, first_plane, second_plane, lifts };

/// The wedge under its weight, the water and the inertia force m a e.
struct WedgeState {
    WedgeMode mode = WedgeMode::both_planes;
    Vector3 direction{};           ///< it slides this way, or would [-]
    double first_normal = 0.0;     ///< effective, compression positive [N]
    double second_normal = 0.0;    ///< [N]
    double drive = 0.0;            ///< force along the direction [N]
    double resistance = 0.0;       ///< cohesion and friction of the planes in contact [N]
    double factor_of_safety = 0.0; ///< resistance / drive; 0 when it lifts, infinite without drive
};

/// @param push  e, unit vector of the inertia force, opposite to the ground acceleration; need not be horizontal
/// @param accel  a [m/s^2]
/// @throws InputError for parallel planes, mass <= 0, dips outside 0 ... pi/2, negative strength, areas or water
WedgeState wedge_state(const Wedge& wedge, const Vector3& push = {}, double accel = 0.0);

struct WedgeYield {
    double acceleration = 0.0; ///< smallest a >= 0 with factor 1 [m/s^2]; 0: slides without; infinite: none below 10 g
    double factor = 0.0;       ///< slip acceleration per excess ground acceleration, the way of sliding kept [-]
    WedgeState state;          ///< at the yield
};

/// Looks at a in steps of g/200 and locates the first crossing in a bracket.
WedgeYield wedge_yield(const Wedge& wedge, const Vector3& push);

/// Newmark's slip along the direction of sliding at the yield, one way, by the integrator of the rigid block.
/// @param motion  a_h is the ground acceleration opposite to `push`: positive drives the wedge; a_v is not used
SlipSummary slide_wedge(const GroundMotion& motion, const WedgeYield& yield, const FixedYieldOptions& options = {});

} // namespace damslip::sliding
