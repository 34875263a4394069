#include "analysis/screen/variation.hpp"

#include "analysis/screen/screening.hpp"
#include "core/parallel.hpp"
#include "core/status.hpp"
#include "scene/scene_text.hpp"
#include "scene/section.hpp"
#include "scene/uplift_models.hpp"
#include "sliding/block/slide_batch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
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

namespace {

constexpr int looked_at = 33;             ///< frictions between the one that stands and the highest
constexpr double settled_friction = 1e-7; ///< of the bisection [-]

/// The rigid block with one friction after the other.
class Slips {
public:
    Slips(const Ready& ready, const sliding::SkippingMotion& motion, int polarity)
        : ready_(ready), statics_(ready.statics ? *ready.statics : own_), motion_(motion), polarity_(polarity),
          scene_(ready.scene)
    {
    }

    /// Largest slip with that friction [m]; without an end or without an answer: infinite.
    double largest(double friction)
    {
        scene_.contact = ready_.scene.contact; // a residual value that a lower friction has taken down comes back
        scene_.wedge = ready_.scene.wedge;
        set_friction(scene_, friction);
        const RigidModel model = make_rigid_model(scene_, ready_.seepage->profile_of(scene_), std::nullopt, &statics_);
        const sliding::SlideResult slide = slide_model(scene_, model, motion_, polarity_);
        return slide.status == Status::at_rest || slide.status == Status::rocks_first
                   ? slide.max_slip
                   : std::numeric_limits<double>::infinity();
    }

private:
    const Ready& ready_;
    KeptStatics own_;
    KeptStatics& statics_;
    const sliding::SkippingMotion& motion_;
    int polarity_;
    Scene scene_;
};

/// A friction and by how much the block slips more than it may with it [m].
struct Tried {
    double friction = 0.0;
    double excess = 0.0;
};

/// Says of the frictions between one that slips too far and one that does not on which side of the crossing they lie. A
/// secant says where that is; a friction close to it, on the side asked for, then settles all that lie beyond.
class Crossing {
public:
    Crossing(Slips& slips, double allowed, const Tried& more, const Tried& less)
        : slips_(slips), allowed_(allowed), more_(more), less_(less)
    {
    }

    bool slips_more(double friction)
    {
        if (!settled(friction)) try_near_crossing(friction);
        if (!settled(friction)) try_at(friction);
        return friction <= more_.friction;
    }

private:
    bool settled(double friction) const { return friction <= more_.friction || friction >= less_.friction; }

    void try_at(double friction)
    {
        const Tried tried{friction, slips_.largest(friction) - allowed_};
        (tried.excess > 0.0 ? more_ : less_) = tried;
    }
    void try_near_crossing(double friction)
    {
        constexpr double off = 0.02; // of the way from the crossing to the friction
        const double share = more_.excess / (more_.excess - less_.excess);
        if (!std::isfinite(more_.excess) || !(share < 1.0)) return;
        const double crossing = more_.friction + share * (less_.friction - more_.friction);
        const double near = crossing + off * (friction - crossing);
        if (near > more_.friction && near < less_.friction) try_at(near);
    }

    Slips& slips_;
    double allowed_;
    Tried more_, less_;
};

/// The first sample of the largest acceleration that drives it downstream.
void find_peak(const GroundMotion& motion, NeededRow& row)
{
    for (std::size_t k = 0; k < motion.accel_h.size(); ++k) {
        const double drive = row.polarity * motion.accel_h[k];
        if (drive <= row.peak) continue;
        row.peak = drive;
        row.peak_time = motion.dt * static_cast<double>(k);
    }
}

/// Least friction from which on the rigid block's largest slip stays at or below `slip`: all frictions above it that were
/// looked at do. Looked at 33 values between the friction that stands and `highest_friction`, the last crossing by bisection
/// to 1e-7. A slip without an end (runs away, still sliding) is more than any. @returns nothing where even the highest slips more
/// @param slip  largest slip allowed [m], >= 0
std::optional<double> friction_for_slip(const Ready& ready, const sliding::SkippingMotion& motion, int polarity,
                                        double slip)
{
    Slips slips(ready, motion, polarity);
    const auto tried = [&](double friction) { return Tried{friction, slips.largest(friction) - slip}; };
    const double stands = std::max(0.0, ready.rigid_model().critical_friction);
    if (!(stands < highest_friction)) return std::nullopt;
    Tried less = tried(highest_friction);
    if (less.excess > 0.0) return std::nullopt;
    Tried more{stands, std::numeric_limits<double>::infinity()};
    for (int i = looked_at - 1; i >= 0; --i) {
        const Tried here = tried(stands + (highest_friction - stands) * i / looked_at);
        if (here.excess > 0.0) {
            more = here;
            break;
        }
        less = here;
    }
    Crossing crossing(slips, slip, more, less);
    double slides = more.friction, holds = less.friction;
    while (holds - slides > settled_friction) {
        const double middle = 0.5 * (slides + holds);
        (crossing.slips_more(middle) ? slides : holds) = middle;
    }
    return holds;
}

} // namespace

std::vector<NeededRow> needed_rows(const Ready& ready, int jobs)
{
    const Scene& scene = ready.scene;
    if (!scene.criteria.allowable_slip || scene.wedge || !scene.contact.friction_table.empty()) return {};
    const double allowable = *scene.criteria.allowable_slip;
    std::vector<NeededRow> rows;
    std::vector<sliding::SkippingMotion> motions, horizontal;
    for (const RecordPair& pair : ready.records()) {
        motions.emplace_back(ready.motion(pair));
        horizontal.emplace_back(horizontal_only(motions.back().motion()));
        for (const int polarity : {1, -1}) {
            NeededRow& row = rows.emplace_back();
            row.record = motions.back().motion().name;
            row.polarity = polarity;
        }
    }
    parallel_for(rows.size(), jobs, [&](std::size_t i) {
        NeededRow& row = rows[i];
        find_peak(motions[i / 2].motion(), row);
        row.yield = sliding::yield_for_slip(horizontal[i / 2], allowable, row.polarity);
        row.friction = friction_for_slip(ready, motions[i / 2], row.polarity, allowable);
    });
    return rows;
}

} // namespace damslip
