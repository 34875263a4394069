#include "fe2d/contact/anchor_law.hpp"
#include "fe2d/contact/bond_law.hpp"
#include "fe2d/run/earthquake_pass.hpp"
#include "fe2d/run/strength.hpp"

#include "core/parallel.hpp"
#include "fe2d/model/model.hpp"
#include "scene/planes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

double largest(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0,
                           [](double sum, double value) { return std::max(sum, std::abs(value)); });
}

bool over(Status status)
{
    return status == Status::at_rest || status == Status::sliding_at_end;
}

double worst(std::vector<double> errors)
{
    if (errors.empty()) return 0.0;
    const auto at = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() * 99 / 100);
    std::nth_element(errors.begin(), at, errors.end());
    return *at;
}

} // namespace

double allowed_error(const Scene& scene, const RunOptions& options, double slip, double largest)
{
    double distance = options.slip_limits.empty() ? 0.0 : std::numeric_limits<double>::infinity();
    for (const double limit : options.slip_limits)
        for (const double there : {std::abs(slip), largest}) distance = std::min(distance, std::abs(there - limit));
    return std::max(scene.time.slip_tolerance * std::max(largest, options.smallest_slip), 0.5 * distance);
}

/// A dam that nothing has loaded yet.
EarthquakeRun::BatchedRun EarthquakeRun::batched_run(const Contact& contact) const
{
    std::vector<Contact> segments;
    if (scene_.seam_body) {
        segments = scene_.seam_body->strengths;
        std::fill_n(segments.begin(), scene_.seam_body->of_seam, contact);
    }
    BatchedRun batched{Strength(contact, joints_of(scene_), structure_->planes(), segments),
                       unloaded(contact)};
    batched.contact = contact;
    batched.load = stages_.last();
    batched.uplift = options_.uplift;
    return batched;
}

ContactMemory EarthquakeRun::unloaded(const Contact& contact) const
{
    ContactMemory memory(structure_->pairs());
    memory.laws = joint_laws(scene_, contact, structure_->planes());
    if (auto water = base_water(scene_, structure_->plane(), options_.uplift, options_.cracked_uplift, options_.drain_loss))
        memory.laws.add(std::move(water));
    return memory;
}

/// What rests on the dam while it shakes.
SplitLoad EarthquakeRun::load_of(const BatchedRun& batched) const
{
    SplitLoad load = structure_->split(batched.load);
    let_water_ride(*structure_, batched.uplift, load);
    return load;
}

/// The static stages. Where they do not end in equilibrium, batched.result.status says why.
/// @param from  null: a dam that no earthquake has shaken
void EarthquakeRun::stand(BatchedRun& batched, const RunState* from) const
{
    const Stopwatch clock;
    RunResult& result = batched.result;
    StaticContact contact_statics(statics_, scene_.contact, options_.contact);
    result.zero_displacement = zero_displacement(contact_statics, batched.strength);
    result.stages = statics(contact_statics, batched.strength, batched.memory);
    if (result.stages.back().status == StageStatus::ok && from) go_on(contact_statics, batched, *from);
    if (result.stages.back().status == StageStatus::ok) {
        batched.start = contact_statics.displacements(load_of(batched), batched.memory);
    } else {
        result.status = status_of(result.stages.back().status);
        result.notes = result.stages.back().notes();
    }
    result.seconds.statics = clock.seconds();
}

/// The joints as an earthquake before has left them, in equilibrium under the static loads; with full head in what has cracked
/// where uplift.after says so.
void EarthquakeRun::go_on(StaticContact& statics, BatchedRun& batched, const RunState& from) const
{
    batched.memory.force = from.force;
    batched.memory.opening = from.opening;
    batched.memory.slip = from.slip;
    batched.memory.states = from.states;
    batched.strength.restore(from);
    batched.memory.laws.restore(from.laws);
    const SplitLoad before = load_of(batched);
    auto* water = batched.memory.laws.find<CrackWater>();
    if (water && (options_.cracked_uplift_after || water->report().drains_lost)) {
        const CrackLengths& crack = water->report().largest;
        const CrackedUplift& cracked = cracked_after(water->report());
        batched.uplift = cracked ? cracked(crack.upstream, crack.downstream) : options_.drain_loss->before;
        batched.load = load_with(stages_, *model_, batched.uplift);
        water->rest_with(batched.uplift);
    }
    batched.result.stages.push_back(
        solve_stage(statics, *structure_, "as it was left", load_of(batched), batched.strength, batched.memory, &before));
    if (const auto* now = batched.memory.laws.find<CrackWater>(); now && options_.cracked_uplift_after) // a stage makes the memory anew
        batched.result.stages.back().flooded = now->report().largest.upstream + now->report().largest.downstream;
}

/// Where the static stages leave the dam, and the loads that go on.
EarthquakeRun::Rest EarthquakeRun::rest(const BatchedRun& batched) const
{
    if (!moving_) return {load_of(batched), batched.start};
    const HeldStart held = held_edges(*model_, *moving_model_,
                                      structure_->assemble(batched.start.dam, batched.start.rock, batched.load), batched.load);
    Rest rest;
    rest.load.dam = moving_->with_rock_to_order(held.load);
    rest.start.dam = moving_->with_rock_to_order(held.displacement);
    return rest;
}

/// @param moving  in the order of in_motion()   @param rock  of massless rock's contact nodes
VectorXd EarthquakeRun::displacement_of(const VectorXd& moving, const VectorXd& rock) const
{
    if (!moving_) return structure_->assemble(moving, rock, stages_.last());
    return without_edges(*model_, *moving_model_, moving_->with_rock_to_model(moving));
}

/// Control of the steps in pass `level`. Half a step has an eighth of the local error, so the worst steps of the first pass
/// are halved `level` times, and the others as often as they need to reach the same local error.
StepControl EarthquakeRun::control_of(const BatchedRun& batched, int level) const
{
    return {batched.local_error / std::pow(8.0, level), level};
}

/// Of frames, by the end of the record's samples [s]; 0: none are asked for.
double EarthquakeRun::frame_interval(double record_end) const
{
    return options_.frames > 1 ? record_end / (options_.frames - 1) : 0.0;
}

/// The steps of a pass over the batched's motion.
PassSteps EarthquakeRun::pass_steps(const BatchedRun& batched, int parts) const
{
    return {scene_.time.dt.value_or(batched.motion->dt), parts, scene_.sliding.run_out_max, rest_time()};
}

bool EarthquakeRun::adapts_steps(const BatchedRun& batched) const
{
    return scene_.time.stepping == Stepping::adaptive && !scene_.time.substeps && !batched.steps.has_value();
}

/// One pass of each run. Runs with steps of the same size go on side by side; a sequence that rests between its records, and
/// explicit steps, go alone.
std::vector<RunResult> EarthquakeRun::shake(int halvings, std::span<BatchedRun* const> batch) const
{
    std::vector<RunResult> results(batch.size());
    std::vector<std::size_t> left(batch.size());
    std::iota(left.begin(), left.end(), 0);
    while (!left.empty()) {
        const BatchedRun& first = *batch[left.front()];
        const auto goes_along = [&](std::size_t i) {
            return batch[i] == &first ||
                   (!explicit_ && !rests_between(*first.motion) && !rests_between(*batch[i]->motion) &&
                    pass_steps(*batch[i], 1) == pass_steps(first, 1));
        };
        const auto others = std::stable_partition(left.begin(), left.end(), goes_along);
        std::vector<BatchedRun*> together;
        for (auto i = left.begin(); i != others; ++i) together.push_back(batch[*i]);
        std::vector<RunResult> some;
        if (rests_between(*first.motion))
            some.push_back(shake_with_rests(halvings, *together.front()));
        else if (explicit_)
            some.push_back(shake_explicitly(halvings, *together.front()));
        else
            some = shake_in_step(halvings, together);
        for (std::size_t k = 0; k < some.size(); ++k) results[left[k]] = std::move(some[k]);
        left.erase(left.begin(), others);
    }
    return results;
}

std::unique_ptr<EarthquakePass> EarthquakeRun::pass_of(const BatchedRun& batched, int halvings, const PassSteps& steps) const
{
    const Rest at_rest = rest(batched);
    ContactMemory memory = batched.memory;
    if (auto* bond = memory.laws.find<BondLaw>()) bond->set_motion(true);
    DynamicContact start(operators_, at_rest.load, at_rest.start, memory, scene_.contact, options_.contact);
    if (adapts_steps(batched)) start.control(control_of(batched, halvings));
    PlayedGround ground(*batched.motion, damping_.mass, damping_.constants.mass);
    const double interval = frame_interval(ground.samples_end());
    SlideWatch watch = slide_watch(batched, ground.end());
    return std::make_unique<EarthquakePass>(std::move(start), std::move(ground), steps, batched.strength, batched.result,
                                            options_.pair_series, interval, batched.before, std::move(watch), *cracks_,
                                            options_.ends_when_lifts_wake);
}

/// Runs with steps of the same size, side by side.
std::vector<RunResult> EarthquakeRun::shake_in_step(int halvings, std::span<BatchedRun* const> batch) const
{
    const Stopwatch clock;
    const PassSteps steps = pass_steps(*batch.front(), adapts_steps(*batch.front()) ? 1 : 1 << halvings);
    std::vector<std::unique_ptr<EarthquakePass>> passes;
    std::size_t longest = 0; // what is left of it is what is left of all
    for (const BatchedRun* batched : batch) {
        passes.push_back(pass_of(*batched, halvings, steps));
        if (passes.back()->shown_rows() > passes[longest]->shown_rows()) longest = passes.size() - 1;
    }
    std::optional<HeelWaves> waves;
    if (scene_.uplift && scene_.uplift->water.opening == OpeningWater::reynolds &&
        scene_.uplift->water.wet_end == WetEndPressure::with_waves)
        waves.emplace(scene_, in_motion(), water_.get(), options_.added_mass);

    std::vector<DynamicContact::BatchedRun> under_way;
    const auto any = [&] {
        return std::any_of(passes.begin(), passes.end(), [](const auto& p) { return p->going(); });
    };
    for (long n = 0; any(); ++n) {
        for (int part = 1; part <= steps.parts; ++part) {
            under_way.clear();
            for (const auto& pass : passes)
                if (pass->makes_steps()) under_way.push_back(pass->batched(steps.time(n, part)));
            if (waves)
                for (const DynamicContact::BatchedRun& batched : under_way)
                    batched.run->set_wave_pressure(waves->pressure(batched.run->state()));
            DynamicContact::advance(under_way, steps.step());
            for (const auto& pass : passes)
                if (pass->going()) pass->after_step();
        }
        const bool stopped =
            options_.progress && options_.progress(progress_of(*batch[longest], halvings, passes[longest]->shown_rows(),
                                                               n + 1, steps.row)) == RunAnswer::stop;
        for (const auto& pass : passes)
            if (pass->going()) pass->after_row(n, stopped);
    }
    const double seconds = clock.seconds() / static_cast<double>(batch.size());
    std::vector<RunResult> results;
    for (std::size_t i = 0; i < passes.size(); ++i) {
        EarthquakePass& pass = *passes[i];
        RunResult& result = pass.finish();
        result.halvings = halvings;
        const DynamicContact& dynamics = pass.dynamics();
        if (adapts_steps(*batch[i])) {
            if (halvings == 0) batch[i]->local_error = worst(dynamics.local_errors());
            result.dt = dynamics.state().time / std::max(1, dynamics.counts().steps);
        }
        end_run(dynamics, pass.strength(), *batch[i], result);
        result.seconds.dynamics += seconds;
        results.push_back(std::move(result));
    }
    return results;
}

/// Pressure with cracks between two records, with what the first has left of the drains; empty: cracks do not matter then.
const CrackedUplift& EarthquakeRun::cracked_after(const JointWaterReport& water) const
{
    return water.drains_lost ? options_.drain_loss->cracked_after : options_.cracked_uplift_after;
}

bool EarthquakeRun::rests_between(const GroundMotion& motion) const
{
    return motion.is_sequence() && scene_.uplift && scene_.uplift->water.after == WaterAfter::full &&
           options_.cracked_uplift_after && !structure_->slides_far();
}

namespace {

/// One record of a sequence.
GroundMotion event_alone(const GroundMotion& motion, std::size_t event)
{
    const auto first = static_cast<std::ptrdiff_t>(motion.events[event].first),
               end = static_cast<std::ptrdiff_t>(motion.last_of(event)) + 1;
    GroundMotion alone;
    alone.name = motion.events[event].name;
    alone.dt = motion.dt;
    alone.accel_h.assign(motion.accel_h.begin() + first, motion.accel_h.begin() + end);
    if (!motion.accel_v.empty()) alone.accel_v.assign(motion.accel_v.begin() + first, motion.accel_v.begin() + end);
    return alone;
}

/// What a run that went on from another one shares with it.
void add_run_before(const RunResult& before, RunResult& run)
{
    run.max_slip = std::max(run.max_slip, before.max_slip);
    for (std::size_t k = 0; k < run.lifts.size(); ++k)
        run.lifts[k].largest_slip = std::max(run.lifts[k].largest_slip, before.lifts[k].largest_slip);
    run.counts += before.counts;
    run.bytes = std::max(run.bytes, before.bytes);
    double scale = std::numeric_limits<double>::min();
    for (const Energy& energy : run.history.energy) scale = std::max(scale, energy.scale());
    run.energy_error = std::abs(run.history.imbalance.back()) / scale;
}

} // namespace

/// A sequence whose water follows the crack between its records: each begins from a static state with it, as a run does
/// that starts from the state another one has left (options.start), with the same bits.
RunResult EarthquakeRun::shake_with_rests(int halvings, BatchedRun& first) const
{
    const GroundMotion& motion = *first.motion;
    const std::size_t records = motion.events.size();
    const auto steps_of = [&](const GroundMotion& played) {
        const double end = motion.dt * static_cast<double>(played.accel_h.size() - 1);
        return static_cast<long>(std::ceil(end / scene_.time.dt.value_or(motion.dt) - 1e-9));
    };
    first.steps_of_all = 0;
    for (std::size_t k = 0; k < records; ++k) first.steps_of_all += steps_of(event_alone(motion, k));
    first.later_errors.resize(records - 1);
    const Index crest =
        2 * in_motion().order().new_node[static_cast<std::size_t>(in_motion().model().mesh.crest.back())];

    RunResult run;
    std::vector<EventSlip> events;
    long steps_before = 0;
    for (std::size_t k = 0; k < records; ++k) {
        const GroundMotion alone = event_alone(motion, k);
        const double begin = k == 0 ? 0.0 : run.history.time.back() + motion.dt + motion.pause;
        std::optional<BatchedRun> later;
        if (k > 0) {
            if (run.status != Status::at_rest) break;
            later = batched_run(first.contact);
            stand(*later, &run.state);
            StageResult standing = later->result.stages.back();
            standing.name = fmt::format("before \"{}\"", alone.name);
            run.seconds.statics += later->result.seconds.statics;
            run.between.push_back(standing);
            if (standing.status != StageStatus::ok) {
                run.status = status_of(standing.status);
                run.notes = standing.notes();
                break;
            }
            later->before = HistoryBefore{begin, run.history.energy.back(), run.history.imbalance.back(),
                                          first.memory.slip, rest(first).start.dam[crest]};
            later->result = run;
            later->steps = first.steps;
            later->local_error = first.later_errors[k - 1];
            later->steps_before = steps_before;
            later->steps_of_all = first.steps_of_all;
        }
        BatchedRun* const batched[] = {later ? &*later : &first};
        batched[0]->motion = &alone;
        RunResult now = std::move(shake(halvings, batched).front());
        first.motion = &motion;
        if (later) {
            add_run_before(run, now);
            first.later_errors[k - 1] = later->local_error;
        }
        run = std::move(now);
        const double end = begin + motion.dt * static_cast<double>(alone.accel_h.size() - 1);
        events.push_back({alone.name, begin, end, run.slip, run.slip - (events.empty() ? 0.0 : events.back().slip)});
        steps_before += steps_of(alone);
    }
    run.events_left = records - events.size();
    run.events = std::move(events);
    return run;
}

/// The figures at the end of a pass, and the static state after it.
void EarthquakeRun::end_run(const ContactMotion& dynamics, const Strength& strength_at_end, const BatchedRun& batched,
                             RunResult& result) const
{
    const DynamicState& end = dynamics.state();
    const ContactPlanes& planes = structure_->planes();
    const Plane& plane = planes.base();
    const Index m = plane.pairs();
    result.slip = result.history.slip.back();
    end_events(result);
    result.max_slip = dynamics.largest_slips().of(0);
    result.end_time = result.history.time.back();
    result.counts = dynamics.counts();
    // Where nothing but round-off moves, that is no share of itself but of the weight's work over a nanometre.
    const double least = 1e-9 * dynamics.static_normal_force();
    result.energy_error = std::abs(dynamics.energy_imbalance()) /
                          std::max({dynamics.energy_scale(), least, std::numeric_limits<double>::min()});
    result.pair_distance = plane.distance;
    result.pair_area = plane.area;
    const VectorXd force = end.contact.contact_force();
    result.pair_pressure = force.head(m).cwiseQuotient(plane.area);
    result.pair_shear = -force.segment(planes.pairs(), m).cwiseQuotient(plane.area);
    result.pair_slip = (end.contact.slip - (batched.before ? batched.before->slip_zero : batched.memory.slip)).head(m);
    result.pair_opening = end.contact.opening.head(m);
    result.lifts.clear();
    for (std::size_t k = 0; k < result.history.lifts.size(); ++k) {
        const LiftHistory& h = result.history.lifts[k];
        LiftResult& lift = result.lifts.emplace_back();
        lift.plane = batched.result.stages.front().lifts[k].plane;
        lift.name = joints_of(scene_)[k].name;
        lift.slip = h.slip.back();
        lift.largest_slip = dynamics.largest_slips().of(static_cast<Index>(k + 1));
        lift.largest_opening = largest(h.largest_opening);
        lift.largest_rocking = largest(h.rocking);
        const auto number = static_cast<Index>(k + 1);
        const Mesh& mesh = structure_->model().mesh;
        const Point a = mesh.nodes[static_cast<std::size_t>(mesh.lifts[k].lower_nodes.front())],
                    b = mesh.nodes[static_cast<std::size_t>(mesh.lifts[k].lower_nodes.back())];
        lift.dip = std::atan2(a.y - b.y, b.x - a.x);
        if (const auto* bond = end.contact.laws.find<BondLaw>())
            lift.bond = bond->lengths(planes.first(number), planes[number].pairs());
    }
    if (const auto* anchors = end.contact.laws.find<AnchorLaw>()) result.anchors = anchors->outcomes();
    ContactMemory still = end.contact;
    if (auto* bond = still.laws.find<BondLaw>()) bond->set_motion(false);
    result.state = {end.contact.force,  end.contact.opening,    end.contact.slip, {}, {},
                    end.contact.states, still.laws.save()};
    strength_at_end.save(result.state);
    result.displacement = displacement_of(end.u, end.rock);
    if (result.zero_displacement.size() > 0) result.displacement -= result.zero_displacement;
    result.bytes = dynamics.bytes();
    result.seconds.contact += result.counts.contact_seconds;

    CrackLengths crack = strength_at_end.opened();
    if (const auto* water = end.contact.laws.find<CrackWater>()) {
        result.base_water = water->report();
        if (options_.cracked_uplift_after) crack = result.base_water->largest;
    }
    if (result.status == Status::left_plane) return;
    std::optional<StaticContact> statics;
    if (structure_->slides_far())
        statics.emplace(*structure_, scene_.contact, options_.contact, planes.mean(0, end.contact.slip));
    else
        statics.emplace(statics_, scene_.contact, options_.contact);
    const auto load = [&](const PressureProfile& uplift) {
        SplitLoad split = structure_->split(load_with(stages_, *model_, uplift));
        let_water_ride(*structure_, uplift.empty() ? options_.uplift : uplift, split);
        return split;
    };
    const SplitLoad before = load_of(batched);
    const bool drains_lost = result.base_water && result.base_water->drains_lost;
    const CrackedUplift& uplift_after = drains_lost ? options_.drain_loss->uplift_after : options_.uplift_after;
    result.after = stage_after(*statics, *structure_, uplift_after, crack, load, strength_at_end, still, &before,
                               structure_->slides_far() ? Relaxation{} : relaxation());
    if (scene_.seam_body) return;
    for (std::size_t k = 0; k < std::min(result.lifts.size(), result.after.lifts.size()); ++k) {
        const auto number = static_cast<Index>(k + 1);
        const PlaneBalance& balance = result.after.lifts[k];
        LiftResult& lift = result.lifts[k];
        if (!(lift.bond.broken > 0.0) || !std::isfinite(balance.sliding_factor)) continue;
        const double friction =
            strength_at_end.law().friction.segment(planes.first(number), planes[number].pairs()).minCoeff();
        const double head = head_in_crack(scene_, joints_of(scene_)[k], planes[number], lift.bond);
        lift.cut_factor = std::max(
            0.0, balance.sliding_factor - friction * head / std::abs(balance.resultant.shear_force));
    }
}

SlideWatch EarthquakeRun::slide_watch(const BatchedRun& batched, double record_end) const
{
    const double normal_force = batched.result.rest().resultant.normal_force;
    return {{record_end, normal_force, scene_.sliding.steady_rate_change}, [this] { return window(); }};
}

void end_events(RunResult& run)
{
    if (run.events.empty()) return;
    run.events.back().slip = run.slip;
    double before = 0.0;
    for (EventSlip& event : run.events) {
        event.change = event.slip - before;
        before = event.slip;
    }
}

std::vector<std::size_t> event_rows(const RunResult& run)
{
    std::vector<std::size_t> rows{0};
    for (std::size_t k = 1; k < run.events.size(); ++k) {
        const std::vector<double>& time = run.history.time;
        const auto at = std::lower_bound(time.begin(), time.end(), run.events[k].start);
        rows.push_back(std::min(static_cast<std::size_t>(at - time.begin()), time.size() - 1));
    }
    return rows;
}

void EarthquakeRun::BatchedRun::note_slips(const RunResult& pass)
{
    const bool first = slips.empty();
    slips.resize(1 + pass.lifts.size());
    const std::vector<std::size_t> rows_before = event_rows(result), rows = event_rows(pass);
    const auto change = [&](const std::vector<double>& before, const std::vector<double>& now) {
        return first ? 0.0 : largest_difference(before, rows_before, now, rows);
    };
    slips.front().push_back({pass.halvings, pass.slip, change(result.history.slip, pass.history.slip)});
    for (std::size_t k = 0; k < pass.lifts.size(); ++k)
        slips[k + 1].push_back({pass.halvings, pass.lifts[k].slip,
                                first ? 0.0 : change(result.history.lifts[k].slip, pass.history.lifts[k].slip)});
}

double EarthquakeRun::BatchedRun::order_in_step() const
{
    const bool sudden = memory.laws.find<BondLaw>() || memory.laws.find<CrackWater>() || !strength.constant();
    return sudden ? sudden_order : contact_order;
}

/// A pass with smaller steps; runs whose error is still too large get the next one.
void EarthquakeRun::refine(int halvings, std::span<BatchedRun* const> batch) const
{
    std::vector<RunResult> finer = shake(halvings, batch);
    for (std::size_t i = 0; i < batch.size(); ++i) {
        BatchedRun& batched = *batch[i];
        batched.next = 0;
        if (finer[i].status == Status::interrupted) { // the whole coarser run tells more than part of the finer
            batched.result.status = Status::interrupted;
            batched.result.notes = {
                {NoteKind::interrupted_refining, {finer[i].dt, 1e3 * batched.result.slip, batched.result.dt}}};
            batched.result.cracks = std::move(finer[i].cracks);
            continue;
        }
        const bool was_self_excited = batched.result.status == Status::self_excited;
        batched.note_slips(finer[i]);
        batched.result = std::move(finer[i]);
        const double order = batched.order_in_step();
        batched.result.slip_error = step_error(batched.slips.front(), order);
        for (std::size_t k = 0; k < batched.result.lifts.size(); ++k)
            batched.result.lifts[k].slip_error = step_error(batched.slips[k + 1], order);
        double excess = 0.0; // error over what is allowed, the largest of all planes; one that is no number halves nothing
        const double least = batched.result.least_slip_of_planes();
        excess = std::max(excess, batched.result.slip_error / allowed_error(scene_, options_, batched.result.slip,
                                                                            std::max(least, batched.result.max_slip)));
        for (const LiftResult& lift : batched.result.lifts)
            excess = std::max(excess, lift.slip_error / (scene_.time.slip_tolerance *
                                                         std::max({lift.largest_slip, least, options_.smallest_slip})));
        if (batched.result.status == Status::left_plane || excess <= 1.0) continue;
        if (was_self_excited && batched.result.status == Status::self_excited)
            continue; // both agree; there is no slip to refine
        batched.next = next_halvings(batched.slips.front(), excess, order);
        if (halvings < options_.largest_halvings) batched.next = std::min(batched.next, options_.largest_halvings);
    }
}

std::size_t EarthquakeRun::runs_together() const
{
    constexpr Eigen::Index in_cache = 15'000; // moving unknowns; see docs/performance.md
    constexpr std::size_t columns = 4;        // of the widest pass over the factor
    return operators_ && in_motion().dam_unknowns() > in_cache ? columns : 1;
}

std::vector<RunResult> EarthquakeRun::run_in_step(std::span<const Shaking> shakings,
                                                  const std::optional<ChosenSteps>& steps) const
{
    std::vector<RunResult> results(shakings.size());
    std::vector<std::unique_ptr<BatchedRun>> batch(shakings.size()); // null: it cannot move
    std::vector<BatchedRun*> going;
    const int first = steps ? steps->halvings : scene_.time.substeps.value_or(0);
    const bool chosen = !steps && !scene_.time.substeps; // by the slip tolerance
    for (std::size_t i = 0; i < shakings.size(); ++i) {
        results[i].notes = why_not_;
        if (!usable_) continue;
        const double step = scene_.time.dt.value_or(shakings[i].motion->dt) / (1 << first);
        if (operators_ && !operators_->at(step).regular()) { // explicit steps factorise nothing
            results[i].notes = {{NoteKind::step_not_factorised, {step}}};
            continue;
        }
        batch[i] = std::make_unique<BatchedRun>(batched_run(shakings[i].contact));
        batch[i]->motion = shakings[i].motion;
        batch[i]->steps = steps;
        stand(*batch[i], options_.start ? &*options_.start : nullptr);
        if (batch[i]->stands()) going.push_back(batch[i].get());
    }
    std::vector<RunResult> coarse = shake(first, going);
    for (std::size_t i = 0; i < going.size(); ++i) {
        going[i]->note_slips(coarse[i]);
        going[i]->result = std::move(coarse[i]);
        going[i]->result.slip_error = std::numeric_limits<double>::quiet_NaN();
        going[i]->next = first + 1;
    }
    for (int k = first + 1; chosen && k <= options_.largest_halvings; ++k) {
        std::vector<BatchedRun*> now;
        for (BatchedRun* batched : going)
            if (batched->next == k && batched->result.status != Status::interrupted) now.push_back(batched);
        if (!now.empty()) refine(k, now);
    }
    for (std::size_t i = 0; i < results.size(); ++i) {
        if (BatchedRun* batched = batch[i].get()) {
            const bool stands = batched->stands();
            if (batched->next != 0 && chosen && over(batched->result.status)) batched->result.status = Status::tolerance_missed;
            results[i] = std::move(batched->result);
            if (stands) judge(results[i]);
        }
        results[i].seconds.model = seconds_;
        results[i].damping = damping_.constants;
    }
    return results;
}

} // namespace damslip::fe2d
