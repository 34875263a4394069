#include "fe2d/reduction/reduced_run.hpp"

#include "core/input_error.hpp"
#include "core/parallel.hpp"
#include "fe2d/contact/anchor_law.hpp"
#include "fe2d/contact/bond_law.hpp"
#include "fe2d/contact/joint_water.hpp"
#include "fe2d/run/run_watches.hpp"
#include "fe2d/run/earthquake_pass.hpp"
#include "scene/joint_bond.hpp"
#include "scene/section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
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

bool ReducedRun::on_plane_itself() const
{
    return water_ || !first_joint_law(scene_).empty() || !scene_.motion.sequence.empty();
}

double ReducedRun::wanted(const RunResult& run) const
{
    return allowed_error(scene_, options_, run.slip, run.max_slip);
}

ReducedRun::Motion ReducedRun::motion_of(const GroundMotion& motion, const std::optional<int>& halvings) const
{
    return {PlayedGround(motion, scene_.damping.mass, full_.damping().mass), scene_.time.dt.value_or(motion.dt), 1, options_.contact,
            halvings};
}

namespace {

constexpr int most_doublings = -2; ///< halvings of the first pass where only the side of limits is asked for

/// A series on rows half as far apart, linear in between.
std::vector<double> between_rows(const std::vector<double>& series)
{
    std::vector<double> rows{series.front()};
    for (std::size_t i = 1; i < series.size(); ++i) {
        rows.push_back(0.5 * (series[i - 1] + series[i]));
        rows.push_back(series[i]);
    }
    return rows;
}

} // namespace

ReducedRun::Start ReducedRun::stand(StaticContact& statics, const Contact& contact, RunResult& result) const
{
    const Stopwatch clock;
    const Plane& plane = full_.structure().plane();
    Start start{contact, Strength(contact, plane), full_.unloaded(contact), {}};
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
    motion.parts = 1 << std::max(0, halvings);
    strength = start.strength;
    result.halvings = halvings;
    Motion steps = motion;
    steps.dt = std::ldexp(motion.dt, std::max(0, -halvings));
    ReducedState end = shake(steps, *model_, strength, start.rest, &start.balance, result);
    for (int doubled = halvings; doubled < 0; ++doubled) result.history.slip = between_rows(result.history.slip);
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
                                FirstPass& coarsest) const
{
    const int first = motion.halvings.value_or(options_.slip_limits.empty() ? 0 : most_doublings);
    ReducedState end = shake_with(first, motion, start, strength, result);
    coarsest = {result.history.slip, event_rows(result)};
    std::vector<SlipAtStep> slips{{first, result.slip, 0.0}};
    const JointLaws& laws = start.rest.laws;
    const bool sudden = laws.find<BondLaw>() || laws.find<CrackWater>() || !strength.constant();
    for (int k = first + 1; !motion.halvings && k <= options_.largest_halvings; ++k) {
        const std::vector<double> coarser = result.history.slip;
        const std::vector<std::size_t> rows_before = event_rows(result);
        const bool was_self_excited = result.status == Status::self_excited;
        end = shake_with(k, motion, start, strength, result);
        if (k <= 0) coarsest = {result.history.slip, event_rows(result)};
        slips.push_back({k, result.slip, largest_difference(coarser, rows_before, result.history.slip, event_rows(result))});
        result.slip_error = step_error(slips, sudden ? sudden_order : contact_order);
        if (k <= 0 && result.status != Status::at_rest) continue; // two passes that coarse tell of a slip that is final alone
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
    FirstPass first;
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
    CrackLengths crack = strength.opened();
    bool drains_lost = false;
    end.laws = moved.contact.laws;
    if (auto* bond = end.laws.find<BondLaw>()) bond->set_motion(false);
    if (const auto* anchors = end.laws.find<AnchorLaw>()) result.anchors = anchors->outcomes();
    if (const auto* water = end.laws.find<CrackWater>()) {
        result.base_water = water->report();
        drains_lost = water->report().drains_lost.has_value();
        if (options_.cracked_uplift_after) crack = result.base_water->largest;
    }
    const SplitLoad before = load({});
    result.after = stage_after(statics, structure, drains_lost ? options_.drain_loss->uplift_after : options_.uplift_after, crack,
                               load, strength, end, end.laws.active() ? &before : nullptr);
    result.seconds.statics += clock.seconds();

    if (result.status != Status::interrupted && result.counts.unresolved > 0) result.status = Status::not_resolved;
    if (result.status == Status::self_excited)
        result.notes = self_excited_notes(scene_, result.slip, result.run_out);
    else
        result.notes = {ending_of(result, length, scene_.time.slip_tolerance)};
    if (const std::string event = judge_events(result.status, length, result.events); !event.empty())
        result.notes.insert(result.notes.begin(), {NoteKind::in_record, {event}});
    return result;
}

using Eigen::Index;
using Eigen::VectorXd;

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
    const bool laws = contact.laws.active();
    const VectorXd carried = laws ? contact.contact_force() : VectorXd();
    const VectorXd& force = laws ? carried : contact.force;
    history.normal_force.push_back(force.head(m).sum());
    history.shear_force.push_back(-force.tail(m).sum());
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
    PlayedGround ground = motion.ground;
    ContactMemory still = rest;
    if (auto* bond = still.laws.find<BondLaw>()) bond->set_motion(true);
    ReducedContact dynamics(model, still, scene_.contact, motion.contact);
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
    const double rest_time = options_.rest_time.value_or(full_.rest_time());
    const PassSteps steps{dt, parts, scene_.sliding.run_out_max, rest_time};
    const long rest_steps = steps.rows(rest_time), shown_steps = steps.rows(ground.samples_end());
    long record_steps = steps.rows(ground.end()), all_steps = record_steps + steps.rows(steps.run_out), at_rest_since = -1;
    result.history = {};
    reserve(result.history, static_cast<std::size_t>(record_steps + rest_steps) + 1);
    result.events.clear();
    const auto begin_event = [&] {
        if (const MotionEvent* event = ground.event()) result.events.push_back({event->name, ground.start(), ground.end(), 0.0, 0.0});
    };
    begin_event();
    if (balance) {
        probe.emplace(full_.structure().planes(), *balance, rest.slip);
        watch.emplace(SlideLimits{ground.end(), probe->static_normal_force(), scene_.sliding.steady_rate_change},
                      [this] { return full_.window(); });
        look();
    }
    add_row();
    result.dt = dt / parts;
    result.max_slip = 0.0;
    result.status = Status::sliding_at_end;
    for (long n = 0; n < all_steps; ++n) {
        for (int part = 1; part <= parts; ++part) {
            dynamics.advance(dt / parts, ground.at(steps.time(n, part)), strength.law());
            strength.follow(dynamics.state().contact);
            if (watch) look();
            result.max_slip = std::max(result.max_slip, std::abs(dynamics.mean_slip()));
        }
        add_row();
        if (options_.progress &&
            options_.progress({dynamics.state().time, ground.samples_end(), n + 1, shown_steps}) == RunAnswer::stop) {
            result.status = Status::interrupted;
            break;
        }
        // Deformed by its own height it is no dam any more.
        if (!(std::abs(dynamics.crest() - dynamics.mean_slip()) < crest_level(scene_.section))) {
            result.status = Status::diverged;
            break;
        }
        if (n + 1 >= record_steps + rest_steps && at_rest(result.history.time, result.history.slip, rest_time)) {
            if (!ground.more()) {
                result.status = Status::at_rest;
                break;
            }
            // As EarthquakePass::rest(): the next record after the pause.
            if (at_rest_since < 0) at_rest_since = n + 1;
            if (n + 1 >= at_rest_since + steps.rows(ground.pause())) {
                result.events.back().slip = result.history.slip.back();
                ground.next(static_cast<double>(n + 1) * dt);
                begin_event();
                if (watch) watch->next_record(ground.end());
                record_steps = steps.rows(ground.end());
                all_steps = record_steps + steps.rows(steps.run_out);
                at_rest_since = -1;
            }
        }
        if (watch && watch->self_excited()) {
            result.status = Status::self_excited;
            break;
        }
    }
    if (watch) result.run_out = watch->figures();
    result.events_left = ground.left();
    result.slip = result.history.slip.back();
    end_events(result);
    result.end_time = dynamics.state().time;
    result.counts = dynamics.counts();
    result.seconds.contact += result.counts.contact_seconds;
    return dynamics.state();
}

namespace {

constexpr double share = 0.1;          ///< of the correction, that may be wrong in any case
/// Stresses are not corrected, and want the record's step halved: largest σ₁ of own_dam 0.146, 0.212, 0.215, 0.221 MPa at Δt ... Δt/8.
constexpr std::size_t least_halvings = 1;
constexpr std::size_t most_passes = 4; ///< on few modes; slips that are still open are not of a kind to be corrected

/// A pass on few modes from which the full run may start, and what the slip then leaves open.
struct Choice {
    std::size_t coarse = 0;
    double of_step = 0.0, of_correction = 0.0; ///< error [m]
};

/// The last pass is the finest.
std::optional<Choice> coarsest_within(std::span<const RunResult> passes, double order, double wanted)
{
    if (passes.size() < least_halvings + 2 || passes.back().status != Status::at_rest) return {};
    std::vector<SlipAtStep> slips;
    for (std::size_t k = 0; k < passes.size(); ++k)
        slips.push_back({passes[k].halvings, passes[k].slip,
                         k == 0 ? 0.0 : largest_difference(passes[k - 1].history.slip, passes[k].history.slip)});
    const double of_step = step_error(slips, order);
    for (std::size_t k = least_halvings; k + 1 < passes.size(); ++k) {
        const double of_correction = share * largest_difference(passes[k].history.slip, passes.back().history.slip);
        if (of_step + of_correction <= wanted) return Choice{k, of_step, of_correction};
    }
    return {};
}

double at(const std::vector<double>& series, std::size_t row)
{
    return series[std::min(row, series.size() - 1)];
}

/// How much farther than its end the dam was on the way [m].
double beyond_the_end(const RunResult& run)
{
    return run.max_slip - std::abs(run.slip);
}

/// Slides the dam farther, as a rigid body.
void slide_farther(const ContactStructure& structure, const RunResult& coarse, const RunResult& fine, double record_end, RunResult& run)
{
    RunHistory& history = run.history;
    const double beyond = beyond_the_end(run) + beyond_the_end(fine) - beyond_the_end(coarse);
    std::vector<double> change;
    for (std::size_t row = 0; row < history.time.size(); ++row)
        change.push_back(at(fine.history.slip, row) - at(coarse.history.slip, row));
    const Eigen::Vector2d along = structure.plane().tangent;
    const Eigen::Index dam = structure.model().mesh.dam_node_count;
    const Eigen::VectorXd sliding = along.replicate(dam, 1);
    Eigen::VectorXd all_nodes = Eigen::VectorXd::Zero(structure.dam_unknowns()); // acoustic water's, too
    all_nodes.head(sliding.size()) = sliding;
    slide(change, structure.order().to_new(all_nodes), along.x(), history);
    run.displacement.head(sliding.size()) += change.back() * sliding;
    const auto end_of_record = static_cast<std::size_t>(
        std::lower_bound(history.time.begin(), history.time.end(), record_end - 1e-9) - history.time.begin());
    const double shaken = at(change, end_of_record), all = change.back();
    run.pair_slip.array() += all;
    run.state.slip.array() += all;
    run.after.slip += all;
    run.correction = StepCorrection{all, fine.dt};
    run.slip += all;
    run.max_slip = std::abs(run.slip) + std::max(0.0, beyond);
    run.run_out.slip_shaking += shaken;
    run.run_out.slip_at_rest += all - shaken;
    for (Note& note : run.notes)
        if (note.kind == NoteKind::slip_at_rest) note.values.front() = 1e3 * run.slip;
}

/// Options of the runs on few modes. They keep no frames and no series, and their progress only asks whether to stop.
RunOptions of_few_modes(RunOptions options)
{
    options.frames = 0;
    options.pair_series = PairSeries::none;
    if (options.progress)
        options.progress = [stop = options.stop](const RunProgress&) {
            return stop && stop() ? RunAnswer::stop : RunAnswer::go_on;
        };
    return options;
}

double duration(const GroundMotion& motion)
{
    return motion.dt * static_cast<double>(motion.accel_h.size() - 1);
}

} // namespace

/// The runs on few modes of one shaking: with the steps of the full run, and with the smallest.
struct CorrectedRun::OnFewModes {
    double of_step = 0.0, of_correction = 0.0; ///< error [m]
    RunResult coarse, fine;
    double seconds = 0.0;
};

CorrectedRun::CorrectedRun(const EarthquakeRun& full, const Scene& scene, const RunOptions& options)
    : full_(full), progress_(options.progress), few_(full, scene, of_few_modes(options))
{
}

/// Tells the progress before the runs on few modes of shaking `next`: those of all shakings count as a tenth of the work.
/// @returns whether to stop
bool CorrectedRun::stopped(std::size_t next, std::span<const Shaking> shakings) const
{
    if (!progress_) return false;
    constexpr long parts = 10;
    const auto step = static_cast<long>(next), steps = parts * static_cast<long>(shakings.size());
    const double end = duration(*shakings[next].motion);
    return progress_({end * static_cast<double>(step) / static_cast<double>(steps), end, step, steps}) == RunAnswer::stop;
}

std::optional<CorrectedRun::OnFewModes> CorrectedRun::on_few_modes(const Shaking& shaking) const
{
    const Stopwatch clock;
    const bool constant = Strength(shaking.contact, full_.structure().plane()).constant();
    std::optional<Choice> choice;
    std::vector<RunResult> passes = few_.passes(shaking, [&](std::span<const RunResult> so_far) {
        choice = coarsest_within(so_far, constant ? contact_order : sudden_order, few_.wanted(so_far.back()));
        return choice || so_far.size() == most_passes;
    });
    if (!choice) return std::nullopt;
    return OnFewModes{choice->of_step, choice->of_correction, std::move(passes[choice->coarse]), std::move(passes.back()),
                      clock.seconds()};
}

/// The full run at the steps of few.coarse. @returns whether its slip is within the tolerance now
bool CorrectedRun::correct(const GroundMotion& motion, const OnFewModes& few, RunResult& run) const
{
    if (run.status == Status::interrupted) return true;
    if (run.status != Status::at_rest) return false;
    run.slip_error = few.of_step + std::max(few.of_correction, largest_difference(run.history.slip, few.coarse.history.slip));
    if (run.slip_error > few_.wanted(run)) return false;
    run.seconds.dynamics += few.seconds;
    slide_farther(full_.structure(), few.coarse, few.fine, duration(motion), run);
    return true;
}

std::vector<RunResult> CorrectedRun::run_all(std::span<const Shaking> shakings) const
{
    std::vector<RunResult> results(shakings.size());
    std::vector<std::optional<OnFewModes>> few(shakings.size());
    std::map<int, std::vector<std::size_t>> of_steps; ///< numbers of shakings, by halvings
    std::vector<std::size_t> halved;
    bool stop = false;
    for (std::size_t i = 0; i < shakings.size(); ++i) {
        stop = stop || stopped(i, shakings);
        if (!stop) few[i] = on_few_modes(shakings[i]);
        (few[i] ? of_steps[few[i]->coarse.halvings] : halved).push_back(i);
    }
    const auto those = [&](const std::vector<std::size_t>& numbers) {
        std::vector<Shaking> chosen;
        for (const std::size_t i : numbers) chosen.push_back(shakings[i]);
        return chosen;
    };
    for (const auto& [halvings, numbers] : of_steps) {
        std::vector<RunResult> runs = full_.run_all(those(numbers), ChosenSteps{halvings, {}});
        for (std::size_t k = 0; k < runs.size(); ++k) {
            const std::size_t i = numbers[k];
            results[i] = std::move(runs[k]);
            if (!correct(*shakings[i].motion, *few[i], results[i])) halved.push_back(i);
        }
    }
    if (halved.empty()) return results;
    std::vector<RunResult> runs = full_.run_halved(those(halved));
    for (std::size_t k = 0; k < runs.size(); ++k) results[halved[k]] = std::move(runs[k]);
    return results;
}

std::unique_ptr<const StepCorrector> corrected_run(const EarthquakeRun& full, const Scene& scene, const RunOptions& options)
{
    return std::make_unique<const CorrectedRun>(full, scene, options);
}

} // namespace damslip::fe2d
