#pragma once

#include "random/draw.hpp"
#include "records/record.hpp"
#include "scene/scene.hpp"

/// Scenes and motions the property tests draw.
namespace damslip::property {

enum class Rock { rigid, flexible, radiating };

/// Of tests that try them all: rigid and flexible by turns, radiating from a seed on.
constexpr Rock rock_of(std::uint32_t seed, std::uint32_t first_radiating)
{
    if (seed >= first_radiating) return Rock::radiating;
    return seed % 2 ? Rock::rigid : Rock::flexible;
}

struct Drawn {
    Scene scene;         ///< stands statically with a little friction to spare; fixed steps, no run-out limit in sight
    GroundMotion motion; ///< two components, strong enough to make most of the scenes slide
};

/// A dam of 4 ... 40 m with water as added mass, uplift, tailwater and damping, some twenty elements.
Drawn draw(std::uint32_t seed, Rock rock);

/// Everything that has a dimension taken to another scale: lengths x `length`, times x sqrt(length), so that
/// accelerations and densities are the same. See scaling_test.cpp.
Drawn scaled(const Drawn& drawn, double length);

GroundMotion times(GroundMotion motion, double factor);

/// `parts` samples for each one, on the straight lines between them.
GroundMotion subdivided(const GroundMotion& motion, int parts);

} // namespace damslip::property
