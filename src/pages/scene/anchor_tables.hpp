#pragma once

#include "core/table.hpp"
#include "scene/anchor_bar.hpp"
#include "scene/scene.hpp"

#include <string>
#include <vector>

/// Anchors: what they are, and what a run made of them.
namespace damslip::pages {

/// Strengths and limits of the scene's anchors; without rows where it has none.
Table anchor_list_table(const Scene& scene);

/// One anchor in one run.
struct AnchorRow {
    std::string record;
    int polarity = 1;
    const AnchorOutcome& anchor;
};
Table anchor_run_table(const std::vector<AnchorRow>& rows);

} // namespace damslip::pages
