#include "studies/goldgruber_2015/study_block.hpp"

#include "analysis/prepare/ready.hpp"
#include "analysis/prepare/rigid_model.hpp"
#include "core/units.hpp"
#include "scene/scene_text.hpp"
#include "studies/goldgruber_2015/study_rows.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace damslip::study {

using namespace pages;

namespace {

using pages::Curve;
using pages::Mark;
using pages::Scale;
using pages::Weight;

using units::mm, units::standard_gravity;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

RigidModel block_of(const Scene& scene, const std::string& uplift, double level_share, double friction)
{
    Scene here = variant(scene, level_share * scene.reservoir->level, uplift, chapter_4::block_water, 1.0);
    here = with_friction(std::move(here), friction);
    return prepare(std::move(here), Method::rigid_block, nullptr).rigid_model();
}

pages::Axis axis(const char* label, const char* unit)
{
    return {label, unit};
}

Curve line(std::string name, Mark mark = Mark::line, Weight weight = Weight::normal, int colour = -1)
{
    return {std::move(name), {}, {}, {}, {}, mark, weight, colour};
}

} // namespace

std::vector<StudyUplift> study_uplifts(const Scene& scene)
{
    std::vector<StudyUplift> list;
    for (const std::string& model : chapter_4::uplifts) {
        const Ready ready = prepare(variant(scene, scene.reservoir->level, model, chapter_4::block_water, 1.0),
                                    Method::rigid_block, nullptr);
        const Scene& here = ready.scene;
        StudyUplift u;
        u.model = model;
        u.profile = ready.seepage->uplift_of(here);
        const RigidModel block = ready.rigid_model();
        u.force = block.block.uplift;
        u.critical_friction = block.critical_friction;
        const double heel = u.profile.points.front().pressure, curtain = scene.curtain->distance,
                     half = scene.curtain->thickness;
        u.before_curtain = pressure_at(u.profile, curtain - half) / heel;
        u.behind_curtain = pressure_at(u.profile, curtain + half) / heel;
        list.push_back(std::move(u));
    }
    return list;
}

Table uplift_table(const std::vector<StudyUplift>& uplifts)
{
    using U = StudyUplift;
    return table_of<U>(
        "Uplift of the full reservoir",
        {{{"uplift", "uplift"}, &U::model},
         {{"force_MN_m", "U", "MN/m", 4}, [](const U& u) { return u.force / 1e6; }},
         {{"before_curtain", "p/p₀ before the curtain", "–", 3}, &U::before_curtain},
         {{"behind_curtain", "p/p₀ behind it", "–", 3}, &U::behind_curtain},
         {{"critical_friction", "stands from μ", "–", 4}, &U::critical_friction}},
        uplifts,
        {"seepage: flow through rock and curtain; curtain: the printed rule, 2/3 of the full pressure at the curtain; "
         "linear: no curtain. p one curtain thickness to either side of its axis."});
}

pages::Chart uplift_chart(const std::vector<StudyUplift>& uplifts)
{
    pages::Chart chart;
    chart.title = "Uplift pressure along the base";
    chart.x = axis("distance from the heel", "m");
    chart.y = axis("p/p₀", "");
    chart.y.low = 0.0;
    for (const StudyUplift& u : uplifts) {
        Curve curve = line(u.model, u.model == "seepage" ? Mark::line : Mark::dashed,
                           u.model == "seepage" ? Weight::strong : Weight::normal);
        for (const ProfilePoint& p : u.profile.points) {
            if (!curve.x.empty() && p.distance <= curve.x.back()) continue;
            curve.x.push_back(p.distance);
            curve.y.push_back(p.pressure / u.profile.points.front().pressure);
        }
        chart.curves.push_back(std::move(curve));
    }
    return chart;
}

double yield_of(const Scene& scene, const std::string& uplift, double level_share, double friction)
{
    return block_of(scene, uplift, level_share, friction).downstream.law.constant;
}

pages::Chart yield_by_level(const Scene& scene, const std::string& uplift)
{
    pages::Chart chart;
    chart.title = "Yield acceleration over friction and water level, uplift " + uplift;
    chart.x = axis("friction μ", "");
    chart.y = axis("yield acceleration a_y", "g");
    chart.horizontal.push_back({0.0, "slides statically below"});
    for (const double share : {1.0, 0.95, 0.9, 0.8, 0.7}) {
        RigidModel model = block_of(scene, uplift, share, 1.0);
        Curve curve = line(fmt::format("level {:.0f} % of the crest's", 100 * share));
        for (int i = 0; i <= 36; ++i) {
            model.block.friction = 0.6 + 0.025 * i;
            curve.x.push_back(model.block.friction);
            curve.y.push_back(sliding::yield_acceleration(model.block) / standard_gravity);
        }
        chart.curves.push_back(std::move(curve));
    }
    return chart;
}

pages::Chart yield_with_vertical(const Scene& scene, const std::string& uplift, const GroundMotion& motion)
{
    const sliding::YieldLaw law = block_of(scene, uplift, 1.0, 0.84).downstream.law;
    pages::Chart chart;
    chart.title = "Yield acceleration with vertical motion, μ = 0.84";
    chart.x = axis("time", "s");
    chart.y = axis("acceleration", "m/s²");
    Curve ground = line("ground, horizontal", Mark::line, Weight::faint, 7),
          with = line("a_y with vertical motion", Mark::line, Weight::normal, 1),
          constant = line("a_y, horizontal motion only", Mark::line, Weight::strong, 0);
    for (std::size_t i = 0; i < motion.accel_h.size(); ++i) {
        const double t = static_cast<double>(i) * motion.dt;
        for (Curve* curve : {&ground, &with, &constant}) curve->x.push_back(t);
        ground.y.push_back(motion.accel_h[i]);
        with.y.push_back(law.at(i < motion.accel_v.size() ? motion.accel_v[i] : 0.0));
        constant.y.push_back(law.constant);
    }
    chart.curves = {std::move(ground), std::move(with), std::move(constant)};
    chart.note = "The block starts to slide downstream where the ground's acceleration exceeds a_y.";
    return chart;
}

RegressionsBeside regressions_beside_block(const Scene& scene, const RecordPair& record)
{
    const GroundMotion motion = horizontal_only(ground_motion(scene, record, 1.0, study_polarity(scene)));
    const sliding::SkippingMotion prepared(motion);
    Scene here = variant(scene, scene.reservoir->level, "seepage", chapter_4::block_water, 1.0);
    SeepageSource seepage;
    const RigidModel at_1 = make_rigid_model(with_friction(here, 1.0), seepage.profile_of(here));
    const double per_friction = at_1.downstream.law.constant / (1.0 - at_1.critical_friction); // a_y is linear in mu
    RegressionsBeside out;
    for (const char* id : {"ambraseys-menu-1988", "jibson-1993", "jibson-1998"})
        out.regressions.push_back({id, {}, {}, {}});
    for (int i = 1; i <= 24; ++i) {
        const double a_y = 0.005 * i;
        here = with_friction(std::move(here), at_1.critical_friction + a_y * standard_gravity / per_friction);
        const RigidModel model = make_rigid_model(here, seepage.profile_of(here));
        out.yield.push_back(model.downstream.law.constant / standard_gravity);
        const sliding::SlideResult slide = slide_model(here, model, prepared, 1);
        out.block.push_back(reported(slide.status, slide.max_slip).value_or(nothing) / mm);
        const sliding::RegressionInputs inputs = regression_inputs(record, motion, model);
        for (RegressionsBeside::Curve& curve : out.regressions) {
            const sliding::RegressionResult r = sliding::evaluate(*sliding::find_regression(curve.id), inputs);
            curve.median.push_back(10.0 * r.median_cm.value_or(nothing));
            curve.low.push_back(10.0 * r.minus_sd_cm.value_or(nothing));
            curve.high.push_back(10.0 * r.plus_sd_cm.value_or(nothing));
        }
    }
    return out;
}

pages::Chart regression_chart(const RegressionsBeside& values)
{
    pages::Chart chart;
    chart.title = "Regressions beside the rigid block";
    chart.x = axis("yield acceleration a_y", "g");
    chart.y = {"slip", "mm", Scale::asinh, 1.0};
    chart.curves.push_back(
        {"rigid block, horizontal", values.yield, values.block, {}, {}, Mark::line_and_points, Weight::strong, -1});
    for (const RegressionsBeside::Curve& r : values.regressions) {
        const bool banded = r.id == "jibson-1998";
        chart.curves.push_back({banded ? r.id + ", band ±1σ" : r.id, values.yield, r.median,
                                banded ? r.low : std::vector<double>{}, banded ? r.high : std::vector<double>{},
                                Mark::dashed, Weight::normal, -1});
    }
    return chart;
}

} // namespace damslip::study
