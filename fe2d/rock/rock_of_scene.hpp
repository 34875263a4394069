#pragma once

#include "fe2d/mesh/mesh.hpp"
#include "fe2d/rock/radiating_rock.hpp"

#include <filesystem>

namespace damslip::fe2d {

/// The radiating rock of a scene, reduced to nodes on its surface; rows (x, y) by these; where the water's floor is the rock
/// (floor_on_rock()), its nodes' rows too.
/// @param nodes  of the mesh, upstream to downstream: those that the dam faces, or may come to face
/// @param wave_frequency  up to which waves are to be right where the scene has none [Hz]
/// @param cache  folder of reduced rock (RockStore); empty: none
/// @param reducing  as RadiatingRockInput::reducing
RadiatingRock radiating_rock_of(const Scene& scene, const Mesh& mesh, const std::vector<int>& nodes,
                                double wave_frequency, const std::filesystem::path& cache,
                                const std::function<void(int unknowns)>& reducing = {});

} // namespace damslip::fe2d
