#include "analysis/fe/mesh_scale.hpp"

#include "scene/mesh_sizes.hpp"
#include "scene/section.hpp"
#include "scene/water.hpp"

namespace damslip {

void scale_mesh(double factor, Scene& scene)
{
    const MeshSizes sizes = mesh_sizes(scene);
    scene.mesh.size = factor * sizes.dam;
    scene.mesh.contact_size = factor * sizes.contact;
    if (scene.mesh.rock_contact_size) *scene.mesh.rock_contact_size *= factor;
    if (scene.mesh.rock_size) *scene.mesh.rock_size *= factor;
    scene.mesh.growth = 1.0 + factor * (scene.mesh.growth - 1.0);
    if (has_water(scene)) scene.reservoir->mesh_size = factor * water_mesh_size(*scene.reservoir);
}

double elements_on_base(const Scene& scene)
{
    return base_length(scene.section) / mesh_sizes(scene).contact;
}

} // namespace damslip
