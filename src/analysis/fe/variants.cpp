#include "analysis/fe/variants.hpp"

#include "analysis/prepare/plane_model.hpp"
#include "core/units.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip {

namespace {

/// The shortest time of the task, made at least once [s].
template <class Task>
double shortest_time(const VariantOptions& options, Task&& task)
{
    constexpr double long_run = 0.005; // not repeated [s]
    double least = 0.0;
    for (int k = 0; k < options.repetitions; ++k) {
        const ProcessorClock clock(options.seconds_of);
        task();
        const double seconds = clock.seconds();
        least = k == 0 ? seconds : std::min(least, seconds);
        if (seconds > long_run) break;
    }
    return least;
}

/// The one loop over records and polarities. @param run  fills the outcome of a motion
void run_motions(const Ready& ready, const VariantOptions& options, const Watch& watch, VariantRuns& runs,
                 const std::function<void(const GroundMotion&, MotionOutcome&)>& run)
{
    const std::vector<MotionName> names = motion_names(ready.scene, ready.records());
    for (const RecordPair& pair : ready.records())
        for (const GroundMotion& motion : ready.motions(pair)) {
            MotionOutcome& outcome = runs.motions.emplace_back(MotionOutcome{names[runs.motions.size()]});
            if (!watch.stop_asked()) run(motion, outcome);
            if (options.ends_at_failure && outcome.status != Status::at_rest) return;
        }
}

void take(Status status, double slip, double max_slip, MotionOutcome& outcome)
{
    outcome.status = status;
    if (status == Status::at_rest || status == Status::sliding_at_end) outcome.slip = slip;
    outcome.largest_slip = reported(status, std::abs(max_slip));
}

void take(const sliding::SlideResult& r, const RigidModel& model, MotionOutcome& outcome)
{
    take(r.status, r.slip, r.max_slip, outcome);
    outcome.level = SlipLevel::rigid_block;
    outcome.still_sliding = r.status == Status::sliding_at_end;
    if (fails_statically(r.status)) outcome.why_it_fails = model.why_it_fails();
    if (r.status != Status::at_rest)
        outcome.message = r.notes.empty() ? std::string(status_row(r.status).meaning) : ending_of(r);
}

VariantRuns run_rigid(const Ready& ready, const VariantOptions& options, const Watch& watch)
{
    VariantRuns runs;
    std::vector<RigidModel> models;
    runs.set_up_seconds = shortest_time(options, [&] {
        const Ready alone = ready.with(ready.scene); // seepage solved anew: what a run of this scene alone costs
        models = options.all_planes ? all_models(alone) : std::vector{alone.rigid_model()};
    });
    runs.yield_acceleration = models.front().downstream.law.constant;
    runs.critical_friction = models.front().critical_friction;
    for (const RigidModel& model : models) {
        runs.yield_acceleration = std::min(*runs.yield_acceleration, model.downstream.law.constant / model.amplification);
        runs.critical_friction = std::max(*runs.critical_friction, model.critical_friction);
    }
    run_motions(ready, options, watch, runs, [&](const GroundMotion& motion, MotionOutcome& outcome) {
        std::vector<sliding::SlideResult> results(models.size());
        outcome.seconds = shortest_time(options, [&] {
            for (std::size_t i = 0; i < models.size(); ++i)
                results[i] = options.rocking ? rock_model(ready.scene, models[i], motion, 1).slide
                                             : slide_model(ready.scene, models[i], motion, 1);
        });
        const auto worst = std::max_element(results.begin(), results.end(),
                                            [](const auto& a, const auto& b) { return a.max_slip < b.max_slip; });
        take(*worst, models[std::size_t(worst - results.begin())], outcome);
    });
    return runs;
}

/// Largest distance of the crest from where it stood over the base [m].
std::optional<double> crest_motion(const fe2d::RunHistory& history)
{
    if (history.time.empty()) return std::nullopt;
    double largest = 0.0;
    for (std::size_t i = 0; i < history.time.size(); ++i)
        largest = std::max(largest, std::abs(history.crest_x[i] - history.slip[i]));
    return largest;
}

/// @param run_out  the scene's sliding.run_out_max [s]; without one nothing is known to rest
void take(const fe2d::RunResult& r, double run_out, MotionOutcome& outcome)
{
    take(r.status, r.slip, r.max_slip, outcome);
    outcome.halvings = r.halvings;
    if (r.correction) // to the smallest step of the correction: a run alone needs that for the tolerance
        outcome.halvings += static_cast<int>(std::lround(std::log2(r.dt / r.correction->dt)));
    outcome.still_sliding = r.status == Status::sliding_at_end && run_out > 0.0;
    if (r.status != Status::at_rest) outcome.message = text_of(r.notes);
    if (!outcome.slip) return;
    outcome.crest = crest_motion(r.history);
    for (const fe2d::LiftResult& lift : r.lifts) outcome.lift_slips.push_back(lift.slip);
}

/// Adds what a run by finite elements came to.
void add(const fe2d::RunResult& r, const Ready& ready, VariantRuns& runs, MotionOutcome& outcome)
{
    take(r, ready.scene.sliding.run_out_max, outcome);
    runs.steps = runs.steps.value_or(0) + r.counts.steps;
    runs.time_step = std::min(runs.time_step.value_or(r.dt), r.dt);
    if (!r.stages.empty()) runs.critical_friction = r.stages.back().critical_friction;
}

std::int64_t unknowns_of(const fe2d::EarthquakeRun& model)
{
    return model.model().dofs.count + (model.water() ? model.water()->water.unknowns() : 0);
}

/// Says what share is done, and lets be stopped.
class ShareWatch : public Watch {
public:
    ShareWatch(const Watch& outer, const std::function<void(double share)>& done) : outer_(outer), done_(done) {}
    bool stop_asked() const override { return outer_.stop_asked(); }
    void begin(const std::string&, double total) override { total_ = total; }
    void at(double done) override
    {
        if (done_) done_(std::min(1.0, done / total_));
    }

private:
    const Watch& outer_;
    const std::function<void(double share)>& done_;
    double total_ = 1.0;
};

/// Models follow each other as lifts wake and cracks are followed.
VariantRuns run_awake(const Ready& ready, const VariantOptions& options, const Watch& watch)
{
    VariantRuns runs;
    for (const MotionName& name : motion_names(ready.scene, ready.records())) runs.motions.emplace_back(MotionOutcome{name});
    const ProcessorClock clock(options.seconds_of);
    ShareWatch share(watch, options.done);
    ContactRuns all(ready, {.mesh_error = false, .jobs = 1}, share);
    runs.unknowns = unknowns_of(all.model());
    runs.set_up_seconds = all.model().seconds();
    std::size_t next = 0;
    all.run([&](ContactRun& r, const GroundMotion&) {
        add(r.fe, ready, runs, runs.motions[next++]);
        r.fe.history = {};
    });
    const double seconds = std::max(0.0, clock.seconds() - runs.set_up_seconds);
    for (MotionOutcome& outcome : runs.motions) outcome.seconds = seconds / static_cast<double>(runs.motions.size());
    return runs;
}

VariantRuns run_finite_elements(const Ready& ready, const VariantOptions& options, const Watch& watch)
{
    VariantRuns runs;
    const ProcessorClock clock(options.seconds_of);
    const double motions = static_cast<double>(motion_names(ready.scene, ready.records()).size());
    fe2d::RunOptions of_run = ready.run_options(watch);
    if (options.done)
        of_run.progress = [&](const fe2d::RunProgress& p) {
            options.done((static_cast<double>(runs.motions.size()) - 1.0 + std::min(1.0, p.time / p.end)) / motions);
            return watch.stop_asked() ? fe2d::RunAnswer::stop : fe2d::RunAnswer::go_on;
        };
    const fe2d::EarthquakeRun model(ready.scene, of_run);
    std::optional<fe2d::ReducedRun> reduced;
    if (options.modes) reduced.emplace(model, ready.scene, of_run, *options.modes);
    runs.unknowns = options.modes ? *options.modes + 3 : unknowns_of(model); // with the rigid motions
    runs.set_up_seconds = clock.seconds();
    run_motions(ready, options, watch, runs, [&](const GroundMotion& motion, MotionOutcome& outcome) {
        const ProcessorClock run_clock(options.seconds_of);
        const fe2d::RunResult r =
            reduced ? reduced->run(motion, {}, {}, fe2d::TruncationEstimate::left_out) : model.run(motion);
        outcome.seconds = run_clock.seconds();
        add(r, ready, runs, outcome);
    });
    return runs;
}

} // namespace

std::string word(SlipLevel level)
{
    constexpr const char* words[] = {"regressions", "rigid block", "flexible block", "finite elements"};
    return words[static_cast<std::size_t>(level)];
}

double VariantRuns::run_seconds() const
{
    double sum = 0.0;
    for (const MotionOutcome& motion : motions) sum += motion.seconds;
    return sum;
}

VariantRuns run_variant(const Ready& ready, const VariantOptions& options, const Watch& watch)
{
    if (ready.plan.method == Method::rigid_block) return run_rigid(ready, options, watch);
    const bool wakes = !ready.scene.tied_lifts.empty() || ready.scene.dam.crack == BodyCrack::traced;
    return wakes && !options.modes ? run_awake(ready, options, watch) : run_finite_elements(ready, options, watch);
}

VariantRuns without_model(Status status, const std::string& why, const std::vector<MotionName>& motions)
{
    VariantRuns runs;
    for (const MotionName& motion : motions) {
        runs.motions.push_back({motion});
        runs.motions.back().status = status;
        runs.motions.back().message = why;
    }
    return runs;
}

std::vector<ContactRun> run_record(const Scene& scene, const RecordPair& record, std::optional<int> polarity, Watch& watch)
{
    const auto alone = std::make_shared<const std::vector<RecordPair>>(1, record);
    const Ready ready =
        prepare(scene, Method::finite_elements, alone, {.joints_of_lifts = true, .stop = watch.stop()});
    FeOptions options;
    options.polarity = polarity;
    options.mesh_error = false;
    ContactRuns all(ready, options, watch);
    std::vector<ContactRun> runs = all.run([](ContactRun& r, const GroundMotion&) { r.fe.history = {}; });
    std::erase_if(runs, [](const ContactRun& r) { return r.fe.status == Status::interrupted; });
    return runs;
}

namespace {

MotionOutcome outcome_of(const std::string& what, const ContactRun& run)
{
    MotionOutcome outcome{run, what};
    take(run.fe, 0.0, outcome);
    return outcome;
}

/// "+70 %"
std::string change_words(double share)
{
    const double percent = std::round(100.0 * share);
    return percent == 0.0 ? "within 1 %" : fmt::format("{:+.0f} %", percent);
}

} // namespace

MotionOutcome run_worst(const Variant& variant, const Ready& ready, const ContactRun& worst, Watch& watch)
{
    const auto record = std::find_if(ready.records().begin(), ready.records().end(),
                                     [&](const RecordPair& pair) { return pair.files.name == worst.record; });
    const std::vector<ContactRun> runs = run_record(variant.scene, *record, worst.polarity, watch);
    MotionOutcome outcome = runs.empty() ? MotionOutcome{worst, variant.what} : outcome_of(variant.what, runs.front());
    outcome.without = variant.without;
    return outcome;
}

ModelSpread model_spread(const Ready& ready, const std::vector<ContactRun>& runs, bool run_them, Watch& watch)
{
    ModelSpread spread;
    if (runs.empty()) return spread;
    const ContactRun& worst = worst_of(runs);
    const auto flipped = std::find_if(runs.begin(), runs.end(), [&](const ContactRun& r) {
        return r.record == worst.record && r.polarity == -worst.polarity;
    });
    if (flipped != runs.end())
        spread.runs.push_back(outcome_of("other polarity", *flipped));
    else
        spread.not_run.emplace_back("other polarity");
    for (const OtherModel& other : other_models()) {
        if (!other.concerns(ready.given)) continue;
        if (run_them && !watch.stop_asked())
            spread.runs.push_back(run_worst({other.name, other.change(ready.given), other.without}, ready, worst, watch));
        else
            spread.not_run.push_back(other.name);
    }
    return spread;
}

std::string spread_line(const ModelSpread& spread, const std::vector<ContactRun>& runs)
{
    if (runs.empty()) return "";
    const ContactRun& worst = worst_of(runs);
    const std::optional<double> slip = reported(worst.fe.status, std::abs(worst.fe.max_slip));
    std::string there;
    for (const MotionOutcome& other : spread.runs) {
        there += (there.empty() ? "" : "; ") + other.what + " ";
        if (!other.largest_slip)
            there += word(other.status);
        else if (slip && *slip > 0.0)
            there += fmt::format("{:.4g} mm ({})", *other.largest_slip / units::mm, change_words(*other.largest_slip / *slip - 1.0));
        else
            there += fmt::format("{:.4g} mm", *other.largest_slip / units::mm);
    }
    std::string line = "Model spread, " + worst.label() + ": " + there;
    const std::string missing = fmt::format("{}", fmt::join(spread.not_run, ", "));
    if (!missing.empty())
        line += fmt::format("{}{} not run{}", there.empty() ? "" : "; ", missing,
                            missing == "other polarity" ? "" : " (--spread runs the models)");
    return line + ".";
}

} // namespace damslip
