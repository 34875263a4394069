#pragma once

#include "fe2d/run/earthquake_run.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

/// Cracks through the concrete on paths that they find themselves (`dam.crack = "traced"`).
namespace damslip {

/// A crack that is followed from a face, or from both. Its line goes from face to face, bonded with the strength of the concrete;
/// what of it has broken is the crack.
struct TracedCrack {
    std::string name;            ///< "crack 1": of its lift joint
    bool from_upstream = false;  ///< the face at which it begins
    double start = 0.0;          ///< above the heel [m]
    double time = 0.0;           ///< when the concrete first came to its strength there [s]
    std::optional<double> other; ///< where a crack from the other face comes to meet it [m]; none: only from one
    bool alone = false;          ///< the two did not meet on a path that can be meshed: this one goes on by itself
    int passes = 0;             ///< runs after which its path was drawn anew
    double change = 0.0;        ///< largest of its cracked part at the last of them: the error of the path [m]
    bool settled = false;       ///< it moved less than an element at the last pass
    bool no_mesh = false;       ///< no mesh followed a path of it: the line of before stays
    std::ptrdiff_t damaged = 0; ///< pairs of its line at that pass
};

inline constexpr int most_path_passes = 10; ///< of one crack

/// Where they have begun: within half a section of it no other crack begins on the face.
std::vector<fe2d::CrackStart> starts_of(const Scene& scene, const std::vector<TracedCrack>& cracks);

/// The scene with one more crack, across σ₁ where `seed` came to its strength first; or, where the line of another comes out of the
/// same face no further away than the section is wide, with that line led to it: they join. @pre seed.cracks.cracks()
Scene with_traced_crack(Scene scene, const fe2d::RunResult& seed, std::vector<TracedCrack>& cracks);

/// The scene with the path of each crack drawn anew from the run in which it is longest: from its starts on across σ₁ at the first
/// exceedance (fe2d::PathTension), as far as that came near the strength without a gap; straight on, or from tip to tip,
/// beyond. Cracks that have settled stay.
/// @param runs  on `scene`, not empty @returns whether a path has moved
bool draw_paths_anew(Scene& scene, const std::vector<const fe2d::RunResult*>& runs, std::vector<TracedCrack>& cracks);

} // namespace damslip
