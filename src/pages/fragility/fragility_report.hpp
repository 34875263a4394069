#pragma once

#include "pages/fragility/fragility_view.hpp"
#include "pages/report/page.hpp"

#include <nlohmann/json_fwd.hpp>

namespace damslip::pages {

nlohmann::ordered_json fragility_json(const FragilityView& view);
std::string fragility_text(const FragilityView& view);
/// Curves with stripes and bands, rate by intensity, what P comes from, the tables.
Page fragility_page(const FragilityView& view);
/// OpenQuake's model (NRML 0.5): lognormal curves; P at the levels where a curve does not hold or two of them cross. Of a cloud: empty.
std::string fragility_nrml(const FragilityView& view);
/// P over the water level as the USACE library fragility-curves reads it; empty: the level is not drawn from a list of values.
std::string fragility_usace(const FragilityView& view);

} // namespace damslip::pages
