#include "pages/screen/yield_charts.hpp"

#include "scene/section.hpp"

#include <algorithm>
#include <cassert>
#include <fmt/format.h>

namespace damslip::pages {

namespace {

constexpr int steps = 41;

std::vector<double> spaced(double low, double high)
{
    std::vector<double> x;
    for (int i = 0; i < steps; ++i) x.push_back(low + (high - low) * i / (steps - 1));
    return x;
}

Scene with_uplift(Scene scene, UpliftModel model)
{
    if (!scene.uplift) scene.uplift.emplace();
    scene.uplift->model = model;
    return scene;
}

/// The scene's own uplift first, then the other models it has the data for.
std::vector<std::pair<std::string, Scene>> uplift_variants(const Scene& given, const Screening& s)
{
    const UpliftModel own = given.uplift ? given.uplift->model : UpliftModel::none;
    const Scene scene = with_solved_uplift(given, s);
    std::vector<std::pair<std::string, Scene>> variants{{fmt::format("uplift {}, as given", word(own)), scene}};
    for (const sliding::UpliftComparison& u : s.uplifts)
        if (u.model != own && u.model != UpliftModel::seepage &&
            (u.model != UpliftModel::points || (given.uplift && !given.uplift->points.empty())))
            variants.emplace_back(fmt::format("uplift {}", word(u.model)), with_uplift(scene, u.model));
    return variants;
}

Chart yield_chart(const Screening& s)
{
    Chart chart;
    chart.y = {"yield acceleration", "m/s²", Scale::linear, 0.1, {}, {}, {}};
    chart.horizontal.push_back({0.0, "slides without an earthquake below"});
    if (s.largest_pga > 0) chart.horizontal.push_back({s.largest_pga, "largest PGA of the records"});
    return chart;
}

} // namespace

Scene with_solved_uplift(const Scene& scene, const Screening& s)
{
    if (!scene.uplift || scene.uplift->model != UpliftModel::seepage) return scene;
    const auto found =
        std::find_if(s.uplifts.begin(), s.uplifts.end(), [](const auto& u) { return u.model == UpliftModel::seepage; });
    if (found == s.uplifts.end() || found->profile.points.empty()) return scene;
    const auto& points = found->profile.points;
    if (!(points.front().pressure > 0)) return scene;
    Scene solved = with_uplift(scene, UpliftModel::points);
    solved.uplift->points.clear();
    for (const ProfilePoint& p : points)
        solved.uplift->points.push_back({p.distance, p.pressure / points.front().pressure});
    return solved;
}

Chart yield_over_friction(const Scene& scene, const Screening& s)
{
    const RigidModel& own = s.bases.front().model;
    Chart chart = yield_chart(s);
    chart.title = "Yield acceleration over friction";
    chart.x = {"friction μ", "–", Scale::linear, 0.1, {}, {}, {}};
    chart.vertical.push_back({own.block.friction, "scene"});
    const std::vector<double> friction = spaced(0.5 * own.block.friction, std::max(0.1, 1.4 * own.block.friction));
    for (const auto& [name, variant] : uplift_variants(scene, s)) {
        sliding::RigidBlock block = make_rigid_model(variant, {}).block;
        Curve curve;
        curve.name = name;
        curve.x = friction;
        for (const double mu : friction) {
            block.friction = mu;
            curve.y.push_back(sliding::yield_acceleration(block));
        }
        curve.weight = chart.curves.empty() ? Weight::strong : Weight::normal;
        chart.curves.push_back(std::move(curve));
    }
    return chart;
}

Chart yield_over_level(const Scene& scene, const Screening& s)
{
    assert(scene.reservoir);
    Chart chart = yield_chart(s);
    chart.title = "Yield acceleration over the water level";
    chart.x = {"reservoir level above the heel", "m", Scale::linear, 0.1, {}, {}, {}};
    chart.vertical.push_back({scene.reservoir->level, "scene"});
    const double full = std::max(scene.reservoir->level, crest_level(scene.section));
    const std::vector<double> levels = spaced(0.2 * full, full);
    for (const auto& [name, variant] : uplift_variants(scene, s)) {
        Curve curve;
        curve.name = name;
        curve.x = levels;
        Scene here = variant;
        for (const double level : levels) {
            here.reservoir->level = level;
            curve.y.push_back(make_rigid_model(here, {}).downstream.law.constant);
        }
        curve.weight = chart.curves.empty() ? Weight::strong : Weight::normal;
        chart.curves.push_back(std::move(curve));
    }
    chart.note =
        fmt::format("Friction {:.4g}; added mass and uplift follow the level.", s.bases.front().model.block.friction);
    return chart;
}

} // namespace damslip::pages
