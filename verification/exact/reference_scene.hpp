#pragma once

#include "scene/scene.hpp"

/// The gravity dam of Goldgruber (2015), chapter 4, and plain shapes for hand calculations.
namespace damslip::exact {

/// Which uplift the reference dam gets.
enum class ReferenceUplift {
    none,
    linear,          ///< ruptured curtain
    printed_curtain, ///< 2/3 of the head at the curtain, 7 m from the heel
    points           ///< free profile from a separate flow solution
};

/// 62.5 m high, 45 m base, 12 m crest, vertical upstream face, area 1599.75 m^2, 2500 kg/m^3, water to the crest,
/// Westergaard's simplified added mass, g = 9.81 m/s^2. All lengths times `scale`.
Scene reference_scene(ReferenceUplift uplift, double friction, double scale = 1.0);

/// The same dam as finite elements see it: 25 GPa, ν = 0.17, on 300 m x 100 m of massless rock of 30 GPa, curtain of 27 GPa, water to
/// the crest. No uplift.
Scene elastic_reference_scene(double scale = 1.0);

/// The reference dam with Westergaard's series on a level seam 8 m deep, μ 0.7, below rock of 2650 kg/m^3; drains 6 m from the heel, E 0.8;
/// in front of the toe a wedge of friction 40° at 25°, smooth interface.
Scene seam_scene();

/// A scene with nothing but a section (counter-clockwise, heel first) of the given density [kg/m^3], g = 9.81 m/s^2.
Scene bare_scene(Polyline polygon, double density = 2400.0);

/// Right-angled triangle, vertical upstream face: (0,0) (base,0) (0,height).
Polyline triangle(double base, double height);

/// Mirrored about a vertical line so that the toe becomes the heel at the origin; water and foundation are not touched.
Polyline mirrored(const Polyline& polygon);

} // namespace damslip::exact
