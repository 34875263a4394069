#pragma once

#include "cli/streams.hpp"
#include "scene/effect_plan.hpp"

namespace damslip::cli {

struct ExplainArguments {
    std::filesystem::path scene;
    std::string method = "rigid"; ///< "rigid" or "fe"
};

/// The plan as a table: effect, on, because, cost.
Table effect_table(const EffectPlan& plan);

/// The effect plan: which effects are on, why, and what each costs.
int explain(const ExplainArguments& arguments, const Streams& streams);

} // namespace damslip::cli
