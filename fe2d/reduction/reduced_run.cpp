#include "fe2d/reduction/reduced_run.hpp"

#include "core/input_error.hpp"
#include "core/watch.hpp"
#include "fe2d/run/earthquake_pass.hpp"
#include "fe2d/run/slide_watch.hpp"
#include "fe2d/run/step_error.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace damslip::fe2d {

namespace {

constexpr int coarse_pairs = 22; ///< of the plane of the estimate

/// How a run on few modes ended, but for self-excited sliding. @param length  of the base [m] @param tolerance  of the slip [-]
Note ending_of(const RunResult& r, double length, double tolerance)
{
    switch (r.status) {
    case Status::not_resolved:
        return {NoteKind::contact_unresolved,
                {std::int64_t{r.counts.unresolved}, std::int64_t{r.counts.steps}, r.counts.largest_residual}};
    case Status::runs_away:
        return {NoteKind::runs_away, {"base", length}};
    case Status::interrupted:
        return {NoteKind::interrupted, {r.end_time, 1e3 * r.slip}};
    case Status::diverged:
        return {NoteKind::not_a_number, {r.end_time}};
    case Status::tolerance_missed:
        return {NoteKind::largest_slip_open, {"base", 1e3 * r.max_slip, 1e3 * r.slip_error, r.dt, tolerance}};
    default:
        break;
    }
    if (std::isnan(r.truncation_error)) return {NoteKind::slip_of_modes, {1e3 * r.slip, std::int64_t{r.modes}}};
    return {NoteKind::slip_of_modes_error, {1e3 * r.slip, 1e3 * r.truncation_error, std::int64_t{r.modes}}};
}

} // namespace

ReducedRun::ReducedRun(const EarthquakeRun& full, const Scene& scene, RunOptions options, int modes)
    : full_(full), scene_(scene), options_(std::move(options)), stages_(full.stages()), wanted_(std::max(modes, 1)),
      coarse_(full.structure().plane(), coarse_pairs)
{
    const Stopwatch start;
    if (!full.model().mesh.contact.matching)
        refuse(scene.mesh.file.value_or(scene.file),
               "the nodes of dam and rock do not face each other along the base, as a reduced run needs them to.",
               "the same nodes on both sides",
               "let dam and rock share the curve from heel to toe, or run without --reduced");
    if (full.structure().pairs() > full.structure().plane().pairs() || !full.structure().plane().segments.empty())
        refuse(scene.file, "the dam moves in more than one piece.", "a dam of one piece, as a reduced run needs it",
               "run without --reduced");
    why_not_ = obstacle();
    if (!why_not_.empty()) return;
    DamModes kept = dam_modes(full.structure(), wanted_);
    if (!kept.regular) why_not_ = {{NoteKind::modes_not_found}};
    if (const WaterBody* water = full.structure().water(); water && why_not_.empty()) {
        try {
            water_ = std::make_shared<const ReducedWater>(reduce_water(*water, kept.face, highest_frequency()));
            if (!water_->report.passed()) why_not_ = {water_->missed_gate()};
        } catch (const std::runtime_error& error) {
            why_not_ = {{NoteKind::water_not_reduced, {error.what()}}};
        }
    }
    if (!why_not_.empty()) return;
    const Plane& plane = full.structure().plane();
    model_ = std::make_unique<const ReducedModel>(plane, system_of(std::move(kept)), scheme_of(scene.time));
    seconds_ = start.seconds();
}

ReducedSystem ReducedRun::system_of(DamModes modes) const
{
    return {full_.structure(),         std::move(modes), {full_.damping(), scene_.damping.mass},
            full_.radiating_on_base(), water_,           highest_frequency()};
}

double ReducedRun::highest_frequency() const
{
    return 2.0 * std::numbers::pi * options_.wave_frequency;
}

std::vector<Note> ReducedRun::obstacle() const
{
    if (!full_.why_not().empty()) return full_.why_not();
    if (full_.structure().slides_far()) return {{NoteKind::modes_need_small_slip}};
    if (full_.in_motion().rock_moves()) return {{NoteKind::modes_need_free_rock}};
    return {};
}

double ReducedRun::wanted(const RunResult& run) const
{
    return allowed_error(scene_, options_, run.slip, run.max_slip);
}

ReducedRun::Motion ReducedRun::motion_of(const GroundMotion& motion, const std::optional<int>& halvings) const
{
    return {GroundInput(motion, scene_.damping.mass, full_.damping().mass), scene_.time.dt.value_or(motion.dt), 1, options_.contact,
            halvings};
}

ReducedRun::Start ReducedRun::stand(StaticContact& statics, const Contact& contact, RunResult& result) const
{
    const Stopwatch clock;
    const Plane& plane = full_.structure().plane();
    Start start{contact, Strength(contact, plane), ContactMemory(plane.pairs()), {}};
    result.stages = full_.statics(statics, start.strength, start.rest);
    start.balance = result.stages.back();
    if (start.balance.status != StageStatus::ok) {
        result.status = status_of(start.balance.status);
        result.notes = start.balance.notes();
    }
    result.seconds.statics = clock.seconds();
    return start;
}

ReducedState ReducedRun::shake_with(int halvings, Motion& motion, const Start& start, Strength& strength, RunResult& result) const
{
    motion.parts = 1 << halvings;
    strength = start.strength;
    result.halvings = halvings;
    ReducedState end = shake(motion, *model_, strength, start.rest, &start.balance, result);
    result.pair_slip = end.contact.slip - start.rest.slip;
    return end;
}

std::vector<RunResult> ReducedRun::passes(const Shaking& shaking, const Enough& enough) const
{
    std::vector<RunResult> passes;
    RunResult standing;
    if (!model_) return passes;
    StaticContact statics(full_.static_operator(), scene_.contact, options_.contact);
    const Start start = stand(statics, shaking.contact, standing);
    if (start.balance.status != StageStatus::ok) return passes;
    Motion loop = motion_of(*shaking.motion, {});
    for (int k = 0; k <= options_.largest_halvings; ++k) {
        Strength strength = start.strength;
        shake_with(k, loop, start, strength, passes.emplace_back());
        const RunResult& pass = passes.back();
        if (pass.status != Status::at_rest || pass.counts.unresolved > 0 || enough(passes)) break;
    }
    return passes;
}

ReducedState ReducedRun::refine(Motion& motion, Strength& strength, const Start& start, RunResult& result,
                                std::vector<double>& first_slips) const
{
    const int first = motion.halvings.value_or(0);
    ReducedState end = shake_with(first, motion, start, strength, result);
    first_slips = result.history.slip;
    std::vector<SlipAtStep> slips{{first, result.slip, 0.0}};
    for (int k = first + 1; !motion.halvings && k <= options_.largest_halvings; ++k) {
        const std::vector<double> coarser = result.history.slip;
        const bool was_self_excited = result.status == Status::self_excited;
        end = shake_with(k, motion, start, strength, result);
        slips.push_back({k, result.slip, largest_difference(coarser, result.history.slip)});
        result.slip_error = step_error(slips, strength.constant() ? contact_order : sudden_order);
        if (result.slip_error <= wanted(result)) break;
        if (was_self_excited && result.status == Status::self_excited) break; // both agree; there is no slip to refine
    }
    return end;
}

RunResult ReducedRun::run(const GroundMotion& motion, const std::optional<Contact>& contact,
                              const std::optional<int>& halvings, TruncationEstimate estimate) const
{
    RunResult result;
    result.slip_error = std::numeric_limits<double>::quiet_NaN();
    result.seconds.model = seconds_;
    if (!model_) {
        result.notes = why_not_;
        return result;
    }
    const ReducedSystem& system = model_->system();
    result.modes = static_cast<int>(system.dam_modes) - 3;
    result.highest_frequency = std::sqrt(system.modes.omega2[system.dam_modes - 1]) / (2.0 * std::numbers::pi);
    const ContactStructure& structure = full_.structure();
    StaticContact statics(full_.static_operator(), scene_.contact, options_.contact);
    const Start start = stand(statics, contact.value_or(scene_.contact), result);
    if (start.balance.status != StageStatus::ok) return result;

    Stopwatch clock;
    Motion loop = motion_of(motion, halvings ? halvings : scene_.time.substeps);
    Strength strength = start.strength;
    std::vector<double> first;
    const ReducedState moved = refine(loop, strength, start, result, first);
    result.pair_opening = moved.contact.opening;
    const bool over = result.status == Status::at_rest || result.status == Status::sliding_at_end;
    const double length = structure.plane().length();
    if (over && result.slip_error > wanted(result)) result.status = Status::tolerance_missed;
    const double open = std::isfinite(result.slip_error) ? result.slip_error : 0.0;
    if (over && result.max_slip - open > length) result.status = Status::runs_away;
    const bool estimated = estimate == TruncationEstimate::made && result.status != Status::self_excited; // no slip
    const std::optional<double> error =
        !estimated ? std::numeric_limits<double>::quiet_NaN() : truncation_error(loop, start, first);
    if (!error) result.status = Status::interrupted;
    result.truncation_error = error.value_or(std::numeric_limits<double>::quiet_NaN());
    result.seconds.dynamics = clock.seconds();

    clock = Stopwatch();
    ContactMemory end = start.rest;
    end.force = moved.contact.force;
    end.slip = start.rest.slip + result.pair_slip;
    end.opening = result.pair_opening;
    const auto load = [&](const PressureProfile& uplift) {
        return structure.split(load_with(stages_, full_.model(), uplift));
    };
    result.after = stage_after(statics, structure, options_.uplift_after, strength.opened(), load, strength, end);
    result.seconds.statics += clock.seconds();

    if (result.status != Status::interrupted && result.counts.unresolved > 0) result.status = Status::not_resolved;
    if (result.status == Status::self_excited)
        result.notes = self_excited_notes(scene_, result.slip, result.run_out);
    else
        result.notes = {ending_of(result, length, scene_.time.slip_tolerance)};
    return result;
}

using Eigen::Index;

namespace {

void record(const ReducedContact& dynamics, const GroundAcceleration& ground, RunHistory& history)
{
    const ContactMemory& contact = dynamics.state().contact;
    const Index m = contact.opening.size();
    history.time.push_back(dynamics.state().time);
    history.ground_h.push_back(ground.h);
    history.ground_v.push_back(ground.v);
    history.slip.push_back(dynamics.mean_slip());
    history.crest_x.push_back(dynamics.crest());
    history.normal_force.push_back(contact.force.head(m).sum());
    history.shear_force.push_back(-contact.force.tail(m).sum());
}

void reserve(RunHistory& history, std::size_t rows)
{
    SlideHistory& slide = history.slide;
    for (std::vector<double>* series :
         {&history.time, &history.ground_h, &history.ground_v, &history.slip, &history.crest_x, &history.normal_force,
          &history.shear_force,
          &slide.thrust_over_friction, &slide.lift_offs, &slide.unloaded_share, &slide.rate})
        series->reserve(rows);
}

} // namespace

ReducedState ReducedRun::shake(const Motion& motion, const ReducedModel& model, Strength& strength,
                               const ContactMemory& rest, const StageResult* balance, RunResult& result) const
{
    const double dt = motion.dt;
    const int parts = motion.parts;
    const GroundInput& ground = motion.ground;
    ReducedContact dynamics(model, rest, scene_.contact, motion.contact);
    std::optional<SlideProbe> probe;
    std::optional<SlideWatch> watch;
    const auto look = [&] {
        const ReducedState& now = dynamics.state();
        watch->add(probe->instant(now.time, now.contact, strength.law(), dynamics.friction()));
    };
    const auto add_row = [&] {
        record(dynamics, ground.at(dynamics.state().time), result.history);
        if (watch) watch->add_row(result.history.slide);
    };
    const auto record_steps = static_cast<long>(std::ceil(ground.duration() / dt - 1e-9));
    const auto all_steps = record_steps + static_cast<long>(std::ceil(scene_.sliding.run_out_max / dt - 1e-9));
    const double rest_time = options_.rest_time.value_or(full_.rest_time());
    const auto rest_steps = static_cast<long>(std::ceil(rest_time / dt - 1e-9));
    result.history = {};
    reserve(result.history, static_cast<std::size_t>(record_steps + rest_steps) + 1);
    if (balance) {
        probe.emplace(full_.structure().planes(), *balance, rest.slip);
        watch.emplace(SlideLimits{ground.duration(), probe->static_normal_force(), scene_.sliding.steady_rate_change},
                      [this] { return full_.window(); });
        look();
    }
    add_row();
    result.dt = dt / parts;
    result.max_slip = 0.0;
    result.status = Status::sliding_at_end;
    for (long n = 0; n < all_steps; ++n) {
        for (int part = 1; part <= parts; ++part) {
            const double time = (static_cast<double>(n) + static_cast<double>(part) / parts) * dt;
            dynamics.advance(dt / parts, ground.at(time), strength.law());
            strength.follow(dynamics.state().contact);
            if (watch) look();
            result.max_slip = std::max(result.max_slip, std::abs(dynamics.mean_slip()));
        }
        add_row();
        if (options_.progress &&
            options_.progress({dynamics.state().time, ground.duration(), n + 1, record_steps}) == RunAnswer::stop) {
            result.status = Status::interrupted;
            break;
        }
        // Deformed by its own height it is no dam any more.
        if (!(std::abs(dynamics.crest() - dynamics.mean_slip()) < crest_level(scene_.section))) {
            result.status = Status::diverged;
            break;
        }
        if (n + 1 >= record_steps + rest_steps && at_rest(result.history.time, result.history.slip, rest_time)) {
            result.status = Status::at_rest;
            break;
        }
        if (watch && watch->self_excited()) {
            result.status = Status::self_excited;
            break;
        }
    }
    if (watch) result.run_out = watch->figures();
    result.slip = result.history.slip.back();
    result.end_time = dynamics.state().time;
    result.counts = dynamics.counts();
    result.seconds.contact += result.counts.contact_seconds;
    return dynamics.state();
}

} // namespace damslip::fe2d
