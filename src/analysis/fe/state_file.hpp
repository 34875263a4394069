#pragma once

#include "fe2d/run/strength.hpp"
#include "scene/scene.hpp"

#include <filesystem>
#include <string>

/// The joints of a dam after an earthquake in a file, for another run to go on from.
namespace damslip {

/// Hash of the dam: of the scene without its motion. Runs that go on from each other have it in common.
std::string dam_hash(const Scene& scene);

/// @throws UsageError  for a scene whose joints hold more than the file does: contact that gives way, finite sliding
void check_state_file(const Scene& scene, const std::string& flag);

/// @param scene  as read @param after  what shook it: "main shock, polarity +1"
void write_state(const std::filesystem::path& file, const Scene& scene, const fe2d::RunState& state,
                 const std::string& after);

/// @throws InputError  for a file of another dam, or none
fe2d::RunState read_state(const std::filesystem::path& file, const Scene& scene);

} // namespace damslip
