#pragma once

#include "core/geometry.hpp"
#include "scene/scene.hpp"

#include <string>

namespace damslip {

/// What moves below the dam in a finite element run.
enum class RockKind {
    rigid,    ///< no [foundation]
    massless, ///< gives way and keeps all waves
    boxed, ///< with mass, in the rock box of the statics: all its unknowns stay in every step; fixed or viscous edges
    radiating ///< with mass, waves leave: reduced to the base from a box of its own (fe2d/rock)
};

RockKind rock_kind(const Scene& scene);

/// "rigid base", "massless rock", ... of what is printed beside a slip.
std::string rock_words(const Scene& scene);

/// Of rock in its own box: the structure in motion has the rock's unknowns.
inline bool rock_is_boxed(const Scene& scene)
{
    return rock_kind(scene) == RockKind::boxed;
}

inline bool rock_radiates(const Scene& scene)
{
    return rock_kind(scene) == RockKind::radiating;
}

/// True where the rock below the dam has inertia, boxed or radiating.
bool rock_has_mass(const Scene& scene);

/// Density of rock that radiates [kg/m3]: that of the scene, else 2650. It has no part in the weight.
double radiating_density(const Foundation& rock);

/// True where the floor under acoustic water is the radiating rock itself (reservoir.floor = "rock").
bool floor_on_rock(const Scene& scene);

/// α = (ρ_r c_p - ρ_w c_w)/(ρ_r c_p + ρ_w c_w) of pressure waves that meet the rock's half space at a right angle, (3-55) with
/// the impedance ρ_r c_p of compression waves [-].
/// @pre [foundation] and [reservoir]
double rock_reflection(const Scene& scene);

/// True where the edges of the rock box are dashpots and the ground moves as its free surface would without the dam.
bool rock_edges_are_viscous(const Scene& scene);

/// Where the scene's floor is the rock: it absorbs by that rock's α instead. For scenes that are about to lose the rock.
void let_floor_absorb(Scene& scene);

/// The scene with rock that only gives way: what statics, natural modes and Rayleigh's constants are taken from.
Scene with_massless_rock(Scene scene);

/// The scene with rock that radiates; as it is without [foundation].
Scene with_radiating_rock(Scene scene);

/// A rock slope whose block slides on one plane that comes out in the face, cut off at the back by a vertical tension
/// crack. Hoek & Bray (1981), Rock Slope Engineering, ch. 7.

struct RockSlope {
    double height = 0.0;         ///< H, of the crest above the line where the plane comes out in the face [m]
    double face_dip = 0.0;       ///< psi_f [rad]
    double plane_dip = 0.0;      ///< psi_p [rad], below psi_f
    double crack_distance = 0.0; ///< b, of the crack behind the crest, horizontally [m]; negative: crack in the face
    double upper_dip = 0.0;      ///< psi_s of the surface behind the crest [rad], positive: falls towards the crest
};

/// Depth z of the crack, from the surface down to the plane [m]. Zero or less: the plane has reached the surface before.
double crack_depth(const RockSlope& slope);

/// The block as a section: the foot of the crack is the heel at (0, 0), the plane is the base, the face is the
/// downstream face. Counter-clockwise: heel, toe, crest (where the crack is behind it), top of the crack.
Polyline sliding_block(const RockSlope& slope);

} // namespace damslip
