#include "scene/mesh_sizes.hpp"

#include "scene/joint_bond.hpp"
#include "scene/rock_mass.hpp"
#include "scene/section.hpp"
#include "scene/water.hpp"

#include <algorithm>
#include <cmath>

namespace damslip {

namespace {

/// Elements that resolve the process zone of a joint's bond, but not more than 240 along the joint.
double bond_size(const Contact& strength, const std::optional<double>& modulus, double length)
{
    if (!modulus || !breaks_by_energy(strength)) return HUGE_VAL;
    return std::max(bond_element_length(strength, *modulus), length / 240.0);
}

/// 60 elements along the base; of one so short that they would be shorter than 0.1 m, 20 at least. A block of a few metres
/// rocks, and finer elements only make its landings harder to follow in time.
double base_size(const Scene& scene)
{
    constexpr double short_element = 0.1; // [m]
    const double length = base_length(scene.section);
    return std::max(length / 60.0, std::min(short_element, length / 20.0));
}

} // namespace

MeshSizes mesh_sizes(const Scene& scene)
{
    const double lowest = std::min(heel(scene.section).y, toe(scene.section).y);
    MeshSizes sizes;
    sizes.dam = scene.mesh.size.value_or((crest_level(scene.section) - lowest) / 40.0);
    sizes.contact = scene.mesh.contact_size.value_or(
        std::min({sizes.dam, base_size(scene),
                  bond_size(scene.contact, joint_modulus(scene, true), base_length(scene.section))}));
    if (scene.foundation) sizes.rock = scene.mesh.rock_size.value_or(scene.foundation->depth / 8.0);
    return sizes;
}

double lift_mesh_size(const Scene& scene, const LiftJoint& joint)
{
    return bond_size(joint.strength, joint_modulus(scene, false), width_at_level(scene.section, joint.elevation));
}

double water_mesh_size(const Reservoir& water)
{
    constexpr double rows_over_depth = 20.0;
    return water.mesh_size.value_or(water.level / rows_over_depth);
}

Scene with_own_choices(Scene scene)
{
    if (scene.wedge) return scene;
    if (!scene.mesh.file) {
        const MeshSizes sizes = mesh_sizes(scene);
        scene.mesh.size = sizes.dam;
        scene.mesh.contact_size = sizes.contact;
        if (scene.foundation) scene.mesh.rock_size = sizes.rock;
    }
    if (rock_radiates(scene)) scene.foundation->material.density = radiating_density(*scene.foundation);
    if (has_water(scene)) scene.reservoir->mesh_size = water_mesh_size(*scene.reservoir);
    return scene;
}

} // namespace damslip
