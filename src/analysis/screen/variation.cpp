#include "analysis/screen/variation.hpp"

#include "core/parallel.hpp"
#include "scene/section.hpp"
#include "scene/scene_text.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace damslip {

namespace {

/// `count` values from `low` to `high`.
std::vector<double> spaced(double low, double high, int count = 41)
{
    std::vector<double> x;
    for (int i = 0; i < count; ++i) x.push_back(low + (high - low) * i / (count - 1));
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

/// Around the scene's friction, from where the block stands by itself on.
std::vector<double> friction_values(const RigidModel& own)
{
    const double mu = own.block.friction;
    const double stands = std::isfinite(own.critical_friction) ? 1.002 * own.critical_friction : 0.0;
    const double low = std::max(0.7 * mu, stands), high = std::max(1.35 * mu, 1.5 * stands);
    std::vector<double> values = spaced(low, high, 25);
    if (mu > low && mu < high) values.insert(std::upper_bound(values.begin(), values.end(), mu), mu);
    return values;
}

/// The model with another peak friction; forces, uplift and what they become with slip stay.
RigidModel at_friction(const Scene& scene, RigidModel model, double friction)
{
    if (scene.wedge) return make_rigid_model(with_friction(scene, friction), {});
    const Contact contact = with_friction(scene, friction).contact;
    const sliding::SlipStage last = model.stages.back();
    model.block.friction = friction;
    model.stages = sliding::strength_stages(model.block, contact);
    if (scene.drains && scene.drains->lost_at_slip)
        model.stages = sliding::with_block_from(model.stages, *scene.drains->lost_at_slip, last.block);
    model.downstream = sliding::yield_downstream(model.block);
    model.upstream = sliding::yield_upstream(model.block);
    model.state = sliding::static_state(model.block);
    return model;
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

YieldVariation yields_by_friction(const Scene& scene, const Screening& s)
{
    const double own = s.bases.front().model.block.friction;
    YieldVariation all{spaced(0.5 * own, std::max(0.1, 1.4 * own)), {}};
    for (const auto& [name, variant] : uplift_variants(scene, s)) {
        sliding::RigidBlock block = make_rigid_model(variant, {}).block;
        YieldVariation::Curve& curve = all.curves.emplace_back(YieldVariation::Curve{name, {}});
        for (const double mu : all.at) {
            block.friction = mu;
            curve.yield.push_back(sliding::yield_acceleration(block));
        }
    }
    return all;
}

YieldVariation yields_by_level(const Scene& scene, const Screening& s)
{
    assert(scene.reservoir);
    const double full = std::max(scene.reservoir->level, crest_level(scene.section));
    YieldVariation all{spaced(0.2 * full, full), {}};
    for (const auto& [name, variant] : uplift_variants(scene, s)) {
        YieldVariation::Curve& curve = all.curves.emplace_back(YieldVariation::Curve{name, {}});
        Scene here = variant;
        for (const double level : all.at) {
            here.reservoir->level = level;
            curve.yield.push_back(make_rigid_model(here, {}).downstream.law.constant);
        }
    }
    return all;
}

std::optional<SlipVariation> slips_by_friction(const Scene& scene, const Screening& s,
                                               const std::vector<GroundMotion>& motions, int jobs)
{
    const RigidModel& own = s.bases.front().model;
    if (motions.empty() || !scene.contact.friction_table.empty() || !(own.block.friction > 0)) return std::nullopt;
    SlipVariation all{friction_values(own), {}};
    std::vector<RigidModel> models;
    for (const double mu : all.friction) models.push_back(at_friction(scene, own, mu));
    const std::vector<sliding::SkippingMotion> prepared(motions.begin(), motions.end());
    const std::vector<double> none(motions.size(), std::numeric_limits<double>::quiet_NaN());
    all.slip.assign(models.size(), none);
    parallel_for(models.size() * motions.size(), jobs, [&](std::size_t task) {
        const std::size_t i = task / motions.size(), j = task % motions.size();
        double worst = 0.0;
        for (const int polarity : {1, -1}) {
            const sliding::SlideResult r = slide_model(scene, models[i], prepared[j], polarity);
            const std::optional<double> largest = reported(r.status, r.max_slip);
            if (!largest) return;
            worst = std::max(worst, *largest);
        }
        all.slip[i][j] = worst;
    });
    return all;
}

RecordHistories record_histories(const Scene& scene, const Screening& s, const GroundMotion& motion, std::size_t number)
{
    constexpr auto samples = sliding::HistoryOutput::samples;
    const RigidModel& model = s.bases.front().model;
    RecordHistories found;
    const int h = worse_horizontal(s, number).polarity;
    found.horizontal = {h, slide_model(scene, model, horizontal_only(motion), h, samples)};
    if (const SlipRow* hv = worse_with_vertical(s, number))
        found.with_vertical = {hv->polarity, slide_model(scene, model, motion, hv->polarity, samples)};
    if (s.flexible) {
        const int polarity = worse_judged(s, number).polarity;
        found.flexible = {polarity, slide_flexible(scene, *s.flexible, model, motion, polarity, samples)};
    }
    const SlipRow& first = s.slips[2 * number];
    const SlipRow& second = s.slips[2 * number + 1];
    if (first.rocking && second.rocking) {
        const bool other = second.rocking->slide.max_slip > first.rocking->slide.max_slip;
        const int polarity = (other ? second : first).polarity;
        found.rocking = {polarity, rock_model(scene, model, motion, polarity, samples)};
    }
    return found;
}

} // namespace damslip
