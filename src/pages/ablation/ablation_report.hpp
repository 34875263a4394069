#pragma once

#include "pages/ablation/ablation_tables.hpp"
#include "pages/report/page.hpp"

#include <nlohmann/json_fwd.hpp>

namespace damslip::pages {

/// The page of an ablation: bars of the slip changes by record, of the seconds saved, and the tables. Seconds differ
/// from call to call, all else is the same.
/// @param given  the scene as read
Page ablation_page(const Ablations& in, const Scene& given, const EffectPlan& effects);

nlohmann::ordered_json ablation_json(const Ablations& in, const Scene& given, const EffectPlan& effects);
std::string ablation_text(const Ablations& in, const EffectPlan& effects);

} // namespace damslip::pages
