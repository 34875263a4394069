#pragma once

#include "core/table.hpp"
#include "scene/effect_plan.hpp"

namespace damslip::pages {

/// The plan as a table: effect, on, because, cost.
Table effect_table(const EffectPlan& plan);

} // namespace damslip::pages
