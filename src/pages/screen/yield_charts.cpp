#include "pages/screen/screen_charts.hpp"

#include "analysis/screen/variation.hpp"

#include <fmt/format.h>

namespace damslip::pages {

namespace {

/// A curve for each uplift model, the scene's own strong.
Chart yield_chart(const Screening& s, const YieldVariation& found)
{
    Chart chart;
    chart.y = {"yield acceleration", "m/s²"};
    chart.horizontal.push_back({0.0, "slides without an earthquake below"});
    if (s.largest_pga > 0) chart.horizontal.push_back({s.largest_pga, "largest PGA of the records"});
    for (const YieldVariation::Curve& c : found.curves) {
        const Weight weight = chart.curves.empty() ? Weight::strong : Weight::normal;
        chart.curves.push_back({c.uplift, found.at, c.yield, {}, {}, Mark::line, weight, -1});
    }
    return chart;
}

} // namespace

Chart yield_over_friction(const Scene& scene, const Screening& s)
{
    Chart chart = yield_chart(s, yields_by_friction(scene, s));
    chart.title = "Yield acceleration over friction";
    chart.x = {"friction μ", "–"};
    chart.vertical.push_back({s.bases.front().model.block.friction, "scene"});
    return chart;
}

Chart yield_over_level(const Scene& scene, const Screening& s)
{
    Chart chart = yield_chart(s, yields_by_level(scene, s));
    chart.title = "Yield acceleration over the water level";
    chart.x = {"reservoir level above the heel", "m"};
    chart.vertical.push_back({scene.reservoir->level, "scene"});
    chart.note =
        fmt::format("Friction {:.4g}; added mass and uplift follow the level.", s.bases.front().model.block.friction);
    return chart;
}

} // namespace damslip::pages
