#include "fe2d/rock/rock_of_scene.hpp"

#include "scene/rock_mass.hpp"
#include "scene/section.hpp"

#include <cassert>
#include <numbers>

namespace damslip::fe2d {

RadiatingRock radiating_rock_of(const Scene& scene, const Mesh& mesh, const std::vector<int>& nodes,
                                double wave_frequency, const std::filesystem::path& cache)
{
    assert(scene.foundation);
    RadiatingRockInput input;
    input.rock = elastic_material(scene.foundation->material, scene, "foundation");
    input.rock.density = radiating_density(*scene.foundation);
    input.heel = heel(scene.section);
    input.toe = toe(scene.section);
    for (const int node : nodes) input.surface.push_back(mesh.nodes[static_cast<std::size_t>(node)]);
    input.highest_frequency = 2.0 * std::numbers::pi * scene.foundation->wave_frequency.value_or(wave_frequency);
    input.box_size = scene.foundation->wave_box;
    return radiating_rock(input, RockStore(cache));
}

} // namespace damslip::fe2d
