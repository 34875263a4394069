#include "analysis/prepare/rigid_model.hpp"

#include "analysis/prepare/plane_model.hpp"
#include "core/units.hpp"
#include "records/measure/measures.hpp"
#include "scene/rock_wedge.hpp"
#include "scene/section.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/equilibrium/base_state.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace damslip {

namespace {

Vector3 towards(double azimuth)
{
    return line_direction(azimuth, 0.0);
}

sliding::WedgePlane plane_of(const RockWedge& w, std::size_t i, double gravity)
{
    const RockPlane& p = w.planes[i];
    const double area = wedge_area(w, i);
    return {p.dip, p.dip_direction, area, p.friction, p.cohesion, area * wedge_water_pressure(w, i, gravity)};
}

sliding::Wedge make_wedge(const RockWedge& w, double gravity)
{
    sliding::Wedge wedge;
    wedge.first = plane_of(w, 0, gravity);
    wedge.second = plane_of(w, 1, gravity);
    wedge.mass = w.density * wedge_volume(w);
    wedge.gravity = gravity;
    for (const WedgeForce& f : w.forces) wedge.force = sum(wedge.force, f.force, line_direction(f.trend, f.plunge));
    return wedge;
}

/// Azimuth of the least yield, to 1 degree around the least of every fifth.
double least_azimuth(const sliding::Wedge& wedge)
{
    const std::vector<double> coarse = yields_over_azimuth(wedge);
    const auto middle = 5 * (std::min_element(coarse.begin(), coarse.end()) - coarse.begin());
    double best = static_cast<double>(middle), least = std::numeric_limits<double>::infinity();
    for (auto a = middle - 4; a <= middle + 4; ++a) {
        const double here = wedge_yield(wedge, towards(static_cast<double>(a) * units::degree)).acceleration;
        if (!(here < least)) continue;
        least = here;
        best = static_cast<double>((a + 360) % 360);
    }
    return best * units::degree;
}

} // namespace

RigidWedge make_rigid_wedge(const Scene& scene)
{
    RigidWedge w;
    w.wedge = make_wedge(*scene.wedge, scene.gravity);
    w.still = wedge_state(w.wedge);
    w.azimuth = scene.wedge->motion_azimuth.value_or(trend(w.still.direction));
    w.push = towards(w.azimuth);
    w.yields.at_rest = wedge_yield(w.wedge, w.push);
    if (scene.wedge->cohesion_lost_at_slip && w.yields.at_rest.state.cohesion > 0.0)
        w.yields.moving = without_cohesion(w.wedge, w.yields.at_rest);
    return w;
}

std::vector<double> yields_over_azimuth(const sliding::Wedge& wedge)
{
    std::vector<double> yields;
    for (int a = 0; a <= 360; a += 5) yields.push_back(wedge_yield(wedge, towards(a * units::degree)).acceleration);
    return yields;
}

std::vector<WedgeYieldRow> wedge_yield_rows(const RigidWedge& w)
{
    const auto row = [&w](const char* motion, double azimuth) {
        return WedgeYieldRow{motion, azimuth, wedge_yield(w.wedge, towards(azimuth))};
    };
    const double back = w.azimuth < std::numbers::pi ? w.azimuth + std::numbers::pi : w.azimuth - std::numbers::pi;
    return {{"records, a_h > 0", w.azimuth, w.yields.at_rest},
            row("records, a_h < 0", back),
            row("least of all azimuths", least_azimuth(w.wedge)),
            {"ground up", std::nullopt, wedge_yield(w.wedge, {0.0, 0.0, -1.0})},
            {"ground down", std::nullopt, wedge_yield(w.wedge, {0.0, 0.0, 1.0})}};
}

double critical_first_friction(const sliding::Wedge& w, const sliding::WedgeState& state)
{
    if (!(w.first.friction > 0.0)) return critical_friction(state); // no share to keep: both get the same
    const double by_friction = state.resistance - state.cohesion, missing = state.drive - state.cohesion;
    if (state.mode == sliding::WedgeMode::lifts) return std::numeric_limits<double>::infinity();
    if (!(missing > 0.0)) return 0.0;
    if (!(by_friction > 0.0)) return std::numeric_limits<double>::infinity();
    return w.first.friction * missing / by_friction;
}

std::string mode_words(const RockWedge& names, sliding::WedgeMode mode)
{
    switch (mode) {
    case sliding::WedgeMode::both_planes:
        return "both planes, along their line";
    case sliding::WedgeMode::first_plane:
        return names.planes[0].name + " alone";
    case sliding::WedgeMode::second_plane:
        return names.planes[1].name + " alone";
    case sliding::WedgeMode::lifts:
        return "lifts off both planes";
    }
    return "";
}

namespace {

using sliding::BaseState;
using sliding::RigidBlock;
using sliding::StaticCase;

/// The block with the uplift of the crack that it opens, by its friction.
RigidBlock with_opening(const Scene& scene, const StaticCase& static_case, const BaseState& before,
                        const sliding::SeepageProfile& seepage, RigidBlock block)
{
    if (!scene.uplift || scene.uplift->water.opening == OpeningWater::unchanged) return block;
    const bool vertical =
        scene.motion.vertical && std::any_of(scene.motion.records.begin(), scene.motion.records.end(),
                                             [](const RecordFiles& record) { return record.vertical.has_value(); });
    block.opening = sliding::opening_uplift(scene, static_case, before, block, vertical, seepage);
    return block;
}

StaticCase without_drains(StaticCase static_case)
{
    static_case.uplift.drains = DrainState::ineffective;
    return static_case;
}

/// The rigid block of one static state.
struct RigidStages {
    sliding::RigidBlock block;          ///< before any slip
    sliding::SlipStages stages;         ///< strength and uplift over slip
    sliding::SlipStages opening_stages; ///< the same with the uplift of the crack that each opens (uplift.opening)
};

/// @param later  with the drains lost; null: they are not @param options  its seepage alone is read here
RigidStages rigid_stages(const Scene& scene, const StaticCase& static_case, const BaseState& before,
                         const BaseState* later, const sliding::BlockOptions& options)
{
    const std::optional<double> level = static_case.loads.reservoir_level;
    RigidStages made;
    made.block = with_opening(scene, static_case, before, options.seepage,
                              sliding::make_rigid_block(scene, before, level, options));
    made.stages = sliding::strength_stages(made.block, scene.contact);
    if (later)
        made.stages = sliding::with_block_from(made.stages, *scene.drains->lost_at_slip,
                                               sliding::make_rigid_block(scene, *later, level, options));
    made.opening_stages = made.stages;
    if (!made.block.opening) return made;
    for (sliding::SlipStage& stage : made.opening_stages) {
        const bool drains_lost = later && stage.block.uplift != made.block.uplift;
        stage.block = with_opening(scene, drains_lost ? without_drains(static_case) : static_case,
                                   drains_lost ? *later : before, options.seepage, stage.block);
    }
    return made;
}

class FullHeadBetween final : public sliding::RestBetweenEvents {
public:
    FullHeadBetween(const Scene& scene, const StaticCase& static_case, const BaseState& before, const RigidBlock& block,
                    const sliding::BlockOptions& options)
        : scene_(scene), static_case_(static_case), before_(before), block_(block), options_(options),
          shaken_(static_case), water_(sliding::scene_added_mass(scene, static_case.loads.reservoir_level))
    {
        shaken_.crack =
            sliding::crack_rule_while_open(scene.uplift->water.opening).value_or(CrackRule::seismic_unchanged);
    }

    double crack(sliding::SlipDirection direction, double a_h, double a_v) const override
    {
        const bool downstream = direction == sliding::SlipDirection::downstream;
        const double d = sliding::sign(direction);
        const double slides = (downstream ? yield_downstream(block_) : yield_upstream(block_)).law.at(a_v);
        const double felt = std::min(d * a_h, slides);
        if (!(felt > 0.0)) return 0.0;
        sliding::Force load = before_.load;
        for (const sliding::Load& shaking : earthquake_loads(scene_, water_, d * felt, a_v))
            load += shaking.force.total();
        const sliding::CrackedBase base = shaken_base(scene_, shaken_, before_, load, options_.seepage);
        const sliding::Side opens = downstream ? sliding::Side::heel : sliding::Side::toe;
        return base.crack.side == opens ? base.crack.length : 0.0;
    }

    Rest rest(double heel, double toe) const override
    {
        StaticCase now = static_case_;
        now.opened = heel >= toe ? sliding::Crack{sliding::Side::heel, std::max(heel, before_heel())}
                                 : sliding::Crack{sliding::Side::toe, toe};
        now.uplift.curtain = CurtainState::damaged;
        const BaseState state = sliding::base_state(scene_, now, options_.seepage);
        std::optional<BaseState> later;
        if (scene_.drains && scene_.drains->lost_at_slip)
            later = sliding::base_state(scene_, without_drains(now), options_.seepage);
        RigidStages on_base = rigid_stages(scene_, now, state, later ? &*later : nullptr, options_);
        Note note{NoteKind::rest_after,
                  {state.base.crack.length, std::string(heel >= toe ? "heel" : "toe"), state.base.uplift.force / 1e6,
                   before_.base.uplift.force / 1e6}};
        auto next =
            std::make_shared<const FullHeadBetween>(scene_, now, state, on_base.opening_stages.front().block, options_);
        return {std::move(on_base.opening_stages), std::move(note), std::move(next)};
    }

private:
    double before_heel() const
    {
        return before_.base.crack.side == sliding::Side::heel ? before_.base.crack.length : 0.0;
    }

    Scene scene_;
    StaticCase static_case_;
    BaseState before_;
    RigidBlock block_;
    sliding::BlockOptions options_;
    StaticCase shaken_;
    sliding::AddedMassIntegral water_;
};

/// Between the records of a sequence with uplift.after = "full": full head on what has cracked so far, curtain ruptured, drains
/// without effect where the crack has reached them. Of cracks from both ends the longer one holds water.
/// @returns null without a sequence, or where uplift.after leaves the water as it was
std::shared_ptr<const sliding::RestBetweenEvents> rests_of(const Scene& scene, const StaticCase& static_case,
                                                           const BaseState& before, const RigidBlock& block,
                                                           const sliding::BlockOptions& options)
{
    if (scene.motion.sequence.empty() || !scene.uplift || scene.uplift->model == UpliftModel::none ||
        scene.uplift->water.after != WaterAfter::full)
        return nullptr;
    return std::make_shared<const FullHeadBetween>(scene, static_case, before, block, options);
}

/// How long the plane or line is that it slides on [m]; none where the scene gives no surfaces, or it lifts.
std::optional<double> sliding_length(const RockWedge& wedge, sliding::WedgeMode mode)
{
    switch (mode) {
    case sliding::WedgeMode::both_planes:
        return line_length(wedge);
    case sliding::WedgeMode::first_plane:
        return plane_length(wedge, 0);
    case sliding::WedgeMode::second_plane:
        return plane_length(wedge, 1);
    case sliding::WedgeMode::lifts:
        break;
    }
    return std::nullopt;
}

RigidModel make_wedge_model(const Scene& scene)
{
    RigidModel model;
    RigidWedge& w = model.wedge.emplace(make_rigid_wedge(scene));
    model.block.mass = w.wedge.mass;
    model.block.gravity = w.wedge.gravity;
    model.block.friction = w.wedge.first.friction;
    model.stages = {{0.0, model.block, 0.0}};
    model.downstream = {w.yields.at_rest.law, w.yields.at_rest.factor};
    const sliding::WedgeYield back = wedge_yield(w.wedge, sum({}, -1.0, w.push));
    model.upstream = {back.law, back.factor};
    model.state = w.still.mode == sliding::WedgeMode::lifts ? sliding::StaticState::lifts_off
                  : w.still.factor_of_safety < 1.0          ? sliding::StaticState::slides_downstream
                                                            : sliding::StaticState::at_rest;
    model.critical_friction = critical_first_friction(w.wedge, w.still);
    model.length = sliding_length(*scene.wedge, w.yields.at_rest.state.mode);
    return model;
}

} // namespace

RigidModel make_rigid_model(const Scene& scene, const sliding::SeepageProfile& seepage, std::optional<CrackRule> crack,
                            KeptStatics* kept)
{
    if (scene.wedge) return make_wedge_model(scene);
    if (!scene.planes.slides_on.empty()) return plane_model(scene, scene.planes.slides_on, kept);
    sliding::BlockOptions options;
    options.crack = crack;
    options.seepage = seepage;
    sliding::StaticCase static_case = sliding::scene_static_case(scene);
    if (crack) static_case.crack = *crack;
    const std::optional<double> level = static_case.loads.reservoir_level;
    const auto find = [&] {
        RigidStatics statics{
            sliding::base_state(scene, static_case, seepage), {}, sliding::scene_added_mass(scene, level)};
        if (scene.drains && scene.drains->lost_at_slip) {
            sliding::StaticCase without_drains = static_case;
            without_drains.uplift.drains = DrainState::ineffective;
            statics.later = sliding::base_state(scene, without_drains, seepage);
        }
        return statics;
    };
    KeptStatics own;
    const auto& [state, later, water] = (kept ? kept : &own)->base.get(find);
    RigidModel model;
    RigidStages on_base = rigid_stages(scene, static_case, state, later ? &*later : nullptr, options);
    model.block = on_base.block;
    model.anchors = sliding::base_anchors(scene);
    sliding::RockingBlock rocking =
        sliding::make_rocking_block(scene, state, water, on_base.stages, later ? &*later : nullptr);
    rocking.uplift_on_toe = uplift_of_open_joint(scene, static_case, state, sliding::Side::heel, seepage);
    rocking.uplift_on_heel = uplift_of_open_joint(scene, static_case, state, sliding::Side::toe, seepage);
    if (const auto& opening = on_base.opening_stages.front().block.opening; opening && opening->slow)
        rocking.mouth = rocking_mouth(scene, static_case, state, opening->slow, seepage);
    model.rocking = std::make_shared<sliding::RockingBlock>(std::move(rocking));
    model.tips = sliding::tipping_acceleration(
        scene, water, sliding::with_open_joint(scene, static_case, state, sliding::Side::heel, seepage), 0.0,
        sliding::Towards::downstream);
    model.stages = std::move(on_base.opening_stages);
    model.rests = rests_of(scene, static_case, state, model.block, options);
    model.downstream = sliding::yield_downstream(model.block);
    model.upstream = sliding::yield_upstream(model.block);
    model.state = sliding::static_state(model.block);
    model.critical_friction = sliding::critical_friction(model.block);
    model.length = base_length(scene.section);
    return model;
}

namespace {

sliding::SlideOptions slide_options(const Scene& scene, const RigidModel& model, int polarity,
                                    sliding::HistoryOutput history)
{
    sliding::SlideOptions options{scene.sliding, polarity, history, model.anchors};
    options.sliding.two_way &= !model.one_way;
    return options;
}

/// The ground's motion as the block's foot has it.
GroundMotion amplified(GroundMotion motion, double by)
{
    for (auto* component : {&motion.accel_h, &motion.accel_v})
        for (double& a : *component) a *= by;
    return motion;
}

/// Does the ground push a seam's body away from its wedge?
bool moves_back(const Scene& scene, const RigidModel& model, const sliding::AccelRange& range, int polarity)
{
    if (!model.bodies || !model.one_way || !scene.sliding.two_way) return false;
    const double back = -sliding::turned(range, polarity).h_min;
    const auto below = [&](const sliding::Yield& upstream) {
        return back > std::min(upstream.law.at(range.v_min), upstream.law.at(range.v_max));
    };
    const auto weaker = [&](const sliding::SeamStage& stage) { return below(sliding::yield_upstream_alone(stage.body)); };
    return below(model.upstream) || std::any_of(model.bodies->begin() + 1, model.bodies->end(), weaker);
}

/// May its wedge run ahead of it?
bool wedge_may_part(const RigidModel& model, const sliding::SkippingMotion& motion, int polarity)
{
    return model.bodies && sliding::may_run_ahead(motion, *model.bodies, polarity);
}

/// The slide of a seam that leaves its wedge, or whose wedge leaves it; none: they stay together, or it does not stand.
std::optional<sliding::SlideResult> both_ways(const Scene& scene, const RigidModel& model,
                                              const sliding::SkippingMotion& motion, int polarity)
{
    if (motion.motion().is_sequence() || model.state != sliding::StaticState::at_rest) return std::nullopt;
    const bool back = moves_back(scene, model, motion.whole(), polarity);
    if (!back && !wedge_may_part(model, motion, polarity)) return std::nullopt;
    sliding::SeamSlide found =
        sliding::slide_seam(motion, *model.bodies, {scene.sliding, polarity}, sliding::SeamWorks::left_out);
    if (!back && found.partings == 0) return std::nullopt; // slide() is that to round-off, and sooner
    return std::move(found.slide);
}

} // namespace

sliding::SeamSlide slide_bodies(const Scene& scene, const RigidModel& model, const GroundMotion& motion, int polarity)
{
    return sliding::slide_seam(motion, *model.bodies, {scene.sliding, polarity});
}

void check_length(const RigidModel& model, sliding::SlideResult& result)
{
    const bool slides = result.status == Status::at_rest || result.status == Status::sliding_at_end;
    if (!slides || !model.length || !(result.max_slip > *model.length)) {
        judge_events(result.status, 0.0, result.events);
        return;
    }
    result.status = Status::runs_away;
    const std::string event = judge_events(result.status, *model.length, result.events);
    result.notes.push_back(event.empty() ? Note{NoteKind::beyond_its_plane, {*model.length}}
                                         : Note{NoteKind::beyond_its_plane_in, {event, *model.length}});
}

namespace {

bool reaches(double tips, double yield, double peak)
{
    return tips > 0.0 && tips < peak && tips < yield; // without an earthquake it overturns
}

} // namespace

void check_tipping(const RigidModel& model, double peak, sliding::SlideResult& result)
{
    if (result.status != Status::at_rest && result.status != Status::sliding_at_end) return;
    const double yield = model.downstream.law.constant;
    if (!reaches(model.tips, yield, peak)) return;
    result.status = Status::rocks_first;
    judge_events(result.status, 0.0, result.events);
    const double tips = model.tips / units::standard_gravity;
    result.notes.push_back(std::isfinite(yield)
                               ? Note{NoteKind::tips_before_sliding, {tips, yield / units::standard_gravity}}
                               : Note{NoteKind::tips_only, {tips}});
}

std::string ending_of(const sliding::SlideResult& result)
{
    if (result.notes.empty()) return "";
    const bool added_last = result.status == Status::runs_away || result.status == Status::rocks_first;
    return text_of(added_last ? result.notes.back() : result.notes.front());
}

sliding::RockingResult rock_model(const Scene& scene, const RigidModel& model, const GroundMotion& motion, int polarity,
                                  sliding::HistoryOutput history)
{
    sliding::RockingResult result =
        sliding::rock_and_slide(motion, *model.rocking, slide_options(scene, model, polarity, history));
    check_length(model, result.slide);
    return result;
}

sliding::SlideResult slide_model(const Scene& scene, const RigidModel& model, const sliding::SkippingMotion& motion,
                                 int polarity, sliding::HistoryOutput history)
{
    if (model.wedge || model.moves_unlike_ground()) return slide_model(scene, model, motion.motion(), polarity, history);
    if (model.rests && motion.motion().is_sequence())
        return slide_model(scene, model, motion.motion(), polarity, history);
    std::optional<sliding::SlideResult> back = both_ways(scene, model, motion, polarity);
    sliding::SlideResult result =
        back ? std::move(*back) : sliding::slide(motion, model.stages, slide_options(scene, model, polarity, history));
    check_length(model, result);
    check_tipping(model, polarity > 0 ? motion.whole().h_max : -motion.whole().h_min, result);
    return result;
}

std::vector<sliding::SlideResult> slide_models(const Scene& scene, std::span<const RigidModel* const> models,
                                               const sliding::SkippingMotion& motion, int polarity)
{
    const RigidModel& first = *models.front();
    const bool together = !first.wedge && first.anchors.empty() && !first.moves_unlike_ground() && !motion.motion().is_sequence();
    std::vector<sliding::SlideResult> results(models.size());
    std::vector<const sliding::SlipStages*> stages;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < models.size(); ++i)
        if (together && !moves_back(scene, *models[i], motion.whole(), polarity) &&
            !wedge_may_part(*models[i], motion, polarity)) {
            stages.push_back(&models[i]->stages);
            places.push_back(i);
        } else {
            results[i] = slide_model(scene, *models[i], motion, polarity, sliding::HistoryOutput::none);
        }
    std::vector<sliding::SlideResult> found =
        sliding::slide_together(motion, stages, slide_options(scene, first, polarity, sliding::HistoryOutput::none));
    for (std::size_t k = 0; k < places.size(); ++k) {
        sliding::SlideResult& result = results[places[k]] = std::move(found[k]);
        check_length(*models[places[k]], result);
        check_tipping(*models[places[k]], polarity > 0 ? motion.whole().h_max : -motion.whole().h_min, result);
    }
    return results;
}

sliding::SlideResult slide_model(const Scene& scene, const RigidModel& model, const GroundMotion& motion, int polarity,
                                 sliding::HistoryOutput history)
{
    const sliding::SlideOptions options = slide_options(scene, model, polarity, history);
    const auto block = [&] {
        if (model.bodies)
            if (auto back = both_ways(scene, model, sliding::SkippingMotion(motion), polarity)) return std::move(*back);
        if (model.tied) return sliding::slide_above(motion, *model.tied, model.stages, options);
        if (model.amplification == 1.0) return sliding::slide(motion, model.stages, options, model.rests.get());
        return sliding::slide(amplified(motion, model.amplification), model.stages, options, model.rests.get());
    };
    sliding::SlideResult result = model.wedge ? sliding::slide_wedge(motion, model.wedge->yields, options) : block();
    if (model.wedge && fails_statically(result.status)) result.status = sliding::status_of(model.state);
    check_length(model, result);
    const auto [least, most] = std::minmax_element(motion.accel_h.begin(), motion.accel_h.end());
    check_tipping(model, polarity > 0 ? *most : -*least, result);
    return result;
}

sliding::RegressionInputs regression_inputs(const RecordPair& pair, const GroundMotion& motion, const RigidModel& model,
                                            double period_s)
{
    Record horizontal;
    horizontal.dt = motion.dt;
    horizontal.acceleration = motion.accel_h;
    const records::Measures m = records::measure(horizontal);
    sliding::RegressionInputs inputs;
    inputs.yield_coefficient = model.downstream.law.constant / units::standard_gravity;
    inputs.pga_g = m.pga / units::standard_gravity;
    inputs.arias_m_s = m.arias_intensity;
    inputs.pgv_cm_s = m.pgv / units::cm;
    inputs.mean_period_s = m.mean_period;
    inputs.magnitude = pair.files.magnitude;
    // N_eq sine cycles of amplitude a_max and period T_m have the Arias intensity pi/(2g) N_eq T_m a_max^2/2.
    if (m.mean_period && m.pga > 0.0)
        inputs.cycles =
            4.0 * units::standard_gravity * m.arias_intensity / (std::numbers::pi * *m.mean_period * m.pga * m.pga);
    inputs.sa_13_g = inputs.sa_15_g = inputs.pga_g;
    if (period_s > 0.0) {
        inputs.period_s = period_s;
        const double periods[] = {1.3 * period_s, 1.5 * period_s};
        const auto spectrum = records::response_spectrum(motion.accel_h, motion.dt, periods, 0.05);
        inputs.sa_13_g = spectrum.points[0].pseudo_acceleration / units::standard_gravity;
        inputs.sa_15_g = spectrum.points[1].pseudo_acceleration / units::standard_gravity;
    }
    return inputs;
}

std::string RigidModel::why_it_fails() const
{
    return state == sliding::StaticState::lifts_off || !std::isfinite(critical_friction)
               ? "the uplift carries more than the weight, no friction would hold it"
               : fmt::format("friction {:.4g} is below the {:.4g} that would hold it", block.friction,
                             critical_friction);
}

GroundMotion horizontal_only(GroundMotion motion)
{
    motion.accel_v.clear();
    return motion;
}

} // namespace damslip
