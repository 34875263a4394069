#include "fe2d/rock/rock_of_scene.hpp"

#include "fe2d/mesh/reservoir_mesh.hpp"
#include "fe2d/model/edge_dashpots.hpp"
#include "scene/rock_mass.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace damslip::fe2d {

namespace {

// Largest a_max = ω B/c_s: the box and its modes grow with it, 0.7 s at 3.8, 3.4 s at 11.6 (rock of 3 GPa below 45 m for 25 Hz),
// minutes at 30. Softer rock answers rightly up to a lower frequency, which the answer says.
constexpr double largest_automatic = 11.6, largest_asked_for = 25.0;
constexpr double largest_on_floor = 80.0; // the same over the length of a floor: 900 modes, some 30 s

} // namespace

RadiatingRock radiating_rock_of(const Scene& scene, const Mesh& mesh, const std::vector<int>& nodes,
                                double wave_frequency, const std::filesystem::path& cache,
                                const std::function<void(int unknowns)>& reducing)
{
    assert(scene.foundation);
    RadiatingRockInput input;
    input.rock = elastic_material(scene.foundation->material, scene, "foundation");
    input.rock.density = radiating_density(*scene.foundation);
    input.heel = heel(scene.section);
    input.toe = toe(scene.section);
    double floor = 0.0;
    if (floor_on_rock(scene)) {
        const ReservoirMesh water = build_reservoir_mesh(scene);
        for (std::size_t k = 0; k + 1 < water.bottom.size(); ++k) // the last is the heel
            input.surface.push_back(water.mesh.nodes[static_cast<std::size_t>(water.bottom[k])]);
        input.floor = static_cast<int>(input.surface.size());
        floor = input.heel.x - input.surface.front().x;
    }
    for (const int node : nodes) input.surface.push_back(mesh.nodes[static_cast<std::size_t>(node)]);
    const double base = std::hypot(input.toe.x - input.heel.x, input.toe.y - input.heel.y),
                 largest = scene.foundation->wave_frequency ? largest_asked_for : largest_automatic;
    input.highest_frequency =
        std::min(2.0 * std::numbers::pi * scene.foundation->wave_frequency.value_or(wave_frequency),
                 largest * elastic_waves(input.rock).s / base);
    if (floor > 0.0)
        input.highest_frequency =
            std::min(input.highest_frequency, largest_on_floor * elastic_waves(input.rock).s / floor);
    input.box_size = scene.foundation->wave_box;
    input.reducing = reducing;
    return radiating_rock(input, RockStore(cache));
}

} // namespace damslip::fe2d
