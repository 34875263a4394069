#pragma once

#include "records/record.hpp"
#include "scene/effect_plan.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <vector>

namespace damslip {

/// One record pair of a scene as read, with what its files are.
struct RecordPair {
    RecordFiles files;
    Record horizontal;
    std::optional<Record> vertical;
};

/// Reads the scene's records; verticals only where the plan has vertical motion.
std::vector<RecordPair> read_records(const Scene& scene, const EffectPlan& plan);

/// Both components on one grid, scaled as scene and record say. @param scale  on top of them; @param polarity  on top
/// of the scene's
GroundMotion ground_motion(const Scene& scene, const RecordPair& pair, double scale = 1.0, int polarity = 1);

} // namespace damslip
