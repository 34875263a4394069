#pragma once

#include "pages/fragility/fragility_view.hpp"
#include "pages/report/page.hpp"

#include <nlohmann/json_fwd.hpp>

namespace damslip::pages {

nlohmann::ordered_json fragility_json(const FragilityView& view);
std::string fragility_text(const FragilityView& view);
/// Curves with stripes and bands, rate by intensity, what P comes from, the tables.
Page fragility_page(const FragilityView& view);
/// OpenQuake's model of the limits whose curve is lognormal; empty: none is.
std::string fragility_nrml(const FragilityView& view);

} // namespace damslip::pages
