#include "analysis/fe/contact_runs.hpp"

#include "analysis/prepare/plane_model.hpp"
#include "core/input_error.hpp"
#include "core/parallel.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "scene/joint_bond.hpp"
#include "scene/keys.hpp"
#include "scene/planes.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <utility>

namespace damslip {

namespace {

Verdict worse(Verdict a, Verdict b)
{
    const auto rank = [](Verdict v) {
        switch (v) {
        case Verdict::fail:
            return 3;
        case Verdict::none:
            return 2;
        case Verdict::undecided:
            return 1;
        case Verdict::pass:
            break;
        }
        return 0;
    };
    return rank(a) >= rank(b) ? a : b;
}

SlipError error_of(double step, double mesh, MeshCheck check)
{
    SlipError error{step, mesh, step};
    if (check == MeshCheck::done) error.total = step + mesh;
    if (check == MeshCheck::no_answer) error.total = std::numeric_limits<double>::quiet_NaN();
    return error;
}

} // namespace

bool would_crack(const ContactRun& r)
{
    const fe2d::CrackFigures& cracks = r.fe.cracks;
    return cracks.stress > r.tensile_strength.value_or(usual_tensile_strength[1]) ||
           std::any_of(cracks.lifts.begin(), cracks.lifts.end(), [](const auto& lift) { return lift.index > 1.0; });
}

const ContactRun* most_tensioned(const std::vector<ContactRun>& runs)
{
    const ContactRun* most = nullptr;
    for (const ContactRun& r : runs)
        if (r.fe.cracks.known && (!most || r.fe.cracks.stress > most->fe.cracks.stress)) most = &r;
    return most;
}

bool has_slip(const ContactRun& r)
{
    return reported(r.fe.status, r.fe.max_slip).has_value();
}

bool all_answered(const std::vector<ContactRun>& runs)
{
    return std::all_of(runs.begin(), runs.end(), [](const ContactRun& r) { return is_answer(r.fe.status); });
}

std::string unanswered_words(const std::vector<ContactRun>& runs)
{
    std::string words;
    for (const ContactRun& r : runs) {
        if (is_answer(r.fe.status)) continue;
        const std::optional<double> at_least = slid_at_least(r.fe.status, r.fe.slip);
        words +=
            fmt::format("{}{}, polarity {:+d} {}{}", words.empty() ? "" : "; ", r.record, r.polarity, word(r.fe.status),
                        at_least ? fmt::format(", slid at least {:.4g} mm", 1e3 * *at_least) : "");
    }
    return words;
}

std::optional<double> slid_at_least(Status status, double slip)
{
    return status == Status::self_excited ? std::optional(std::abs(slip)) : std::nullopt;
}

std::string SlipError::parts() const
{
    if (std::isnan(step)) return "no error estimate";
    const std::string first = modes ? "modes, step" : "step";
    return first + (std::isnan(total) ? ", mesh not known" : std::isnan(mesh) ? " only" : " and mesh");
}

SlipError slip_error(const ContactRun& run)
{
    SlipError error = error_of(run.fe.truncation_error + run.fe.slip_error, run.mesh.base, run.mesh.check);
    error.modes = run.fe.modes > 0;
    return error;
}

SlipError lift_error(const ContactRun& run, std::size_t lift)
{
    const double mesh = run.mesh.check == MeshCheck::done ? run.mesh.lifts[lift] : run.mesh.base;
    return error_of(run.fe.lifts[lift].slip_error, mesh, run.mesh.check);
}

std::vector<std::string> error_notes(const std::vector<ContactRun>& runs)
{
    std::vector<std::string> list;
    for (const ContactRun& r : runs) {
        std::string note = r.mesh.reason;
        if (r.mesh.check == MeshCheck::no_answer) note = r.label() + ": " + note;
        if (has_slip(r) && std::isnan(slip_error(r).step))
            note = "no error estimate: the step is fixed (time.substeps), so nothing tells what it leaves open; there "
                   "is no "
                   "verdict by such a slip";
        if (!note.empty() && std::find(list.begin(), list.end(), note + ".") == list.end()) list.push_back(note + ".");
    }
    return list;
}

bool falls_after(const ContactRun& r)
{
    return !r.fe.after.name.empty() && fails_statically(status_of(r.fe.after.status));
}

bool open_after(const ContactRun& r)
{
    return !r.fe.after.name.empty() && r.fe.after.status == fe2d::StageStatus::not_resolved;
}

Verdict verdict_of(const ContactRun& r, const std::optional<double>& allowable)
{
    if (status_row(r.fe.status).judging == Judging::none) return Verdict::none;
    if (falls_after(r)) return Verdict::fail;
    Verdict verdict = judge(r.fe.status, r.fe.max_slip, slip_error(r).total, allowable);
    for (std::size_t k = 0; k < r.fe.lifts.size(); ++k)
        verdict = worse(verdict, judge(r.fe.status, r.fe.lifts[k].largest_slip, lift_error(r, k).total, allowable));
    if (r.leaves_out) verdict = worse(verdict, Verdict::undecided);
    return open_after(r) ? worse(verdict, Verdict::none) : verdict;
}

Verdict verdict_of(const std::vector<ContactRun>& runs, const std::optional<double>& allowable)
{
    Verdict verdict = runs.empty() ? Verdict::none : Verdict::pass;
    for (const ContactRun& r : runs) verdict = worse(verdict, verdict_of(r, allowable));
    return verdict;
}

bool milder(const ContactRun& a, const ContactRun& b)
{
    const auto severity = [](const ContactRun& r) {
        const int rank = status_row(r.fe.status).judging == Judging::fails && !has_slip(r) ? 2 : has_slip(r) ? 1 : 0;
        return std::pair(rank, rank == 1 ? std::abs(r.fe.max_slip) : 0.0);
    };
    return severity(a) < severity(b);
}

const ContactRun& worst_of(const std::vector<ContactRun>& runs)
{
    return *std::max_element(runs.begin(), runs.end(), milder);
}

int exit_code_of(const std::vector<ContactRun>& runs)
{
    int code = exit_ok;
    for (const ContactRun& r : runs)
        code = worse_exit_code(code, open_after(r) ? exit_no_answer : status_row(r.fe.status).exit_code);
    return code;
}

namespace {

/// A second of 3 m/s² at 3 Hz: the dam slides and rocks, so that the contact solver has its usual work.
GroundMotion trial_motion(double dt)
{
    GroundMotion motion;
    motion.dt = dt;
    const auto steps = static_cast<std::size_t>(std::max(20.0, std::ceil(1.0 / dt)));
    for (std::size_t k = 0; k <= steps; ++k)
        motion.accel_h.push_back(3.0 * std::sin(6.0 * std::numbers::pi * dt * static_cast<double>(k)));
    return motion;
}

void add_parts(const fe2d::EarthquakeRun& model, const fe2d::RunResult& trial, ContactCost& cost)
{
    const fe2d::ContactStructure& structure = model.structure();
    const auto contact = static_cast<std::int64_t>(2 * structure.pairs()),
               dam = static_cast<std::int64_t>(structure.dam_unknowns()),
               rock = static_cast<std::int64_t>(model.model().dofs.count - structure.dam_unknowns()),
               moving = static_cast<std::int64_t>(model.in_motion().dam_unknowns());
    cost.contact_unknowns = contact;
    if (structure.has_rock()) cost.parts.push_back({"rock, condensed exactly", rock, "once", structure.rock_bytes()});
    cost.parts.push_back({"dam at rest, inside eliminated", dam, "once", structure.static_factor().bytes()});
    cost.parts.push_back({model.in_motion().rock_moves() ? "dam and rock in motion, inside eliminated"
                                                         : "dam in motion, inside eliminated",
                          moving, "once a step size, solved every step", trial.bytes});
    cost.parts.push_back({"contact problem, dense", contact, "every step",
                          sizeof(double) * static_cast<std::size_t>(contact * contact)});
}

void add_records(const Ready& ready, double seconds_per_step, ContactCost& cost)
{
    for (const RecordPair& pair : ready.records()) {
        const GroundMotion motion = ready.motion(pair);
        const double dt = ready.scene.time.dt.value_or(motion.dt);
        const auto steps = static_cast<std::int64_t>(
            std::ceil(motion.dt * static_cast<double>(motion.accel_h.size() - 1) / dt - 1e-9));
        cost.records.push_back({pair.files.name, steps, static_cast<double>(steps) * seconds_per_step});
    }
}

} // namespace

ContactCost contact_cost(const Ready& ready)
{
    Scene scene = ready.scene;
    scene.time.substeps = 0;
    const Watch nobody;
    fe2d::RunOptions options = ready.run_options(nobody);
    std::int64_t steps = 0;
    options.progress = [&](const fe2d::RunProgress& p) { // the run-out is of no interest
        steps = p.step;
        return p.step < p.steps ? fe2d::RunAnswer::go_on : fe2d::RunAnswer::stop;
    };
    const fe2d::EarthquakeRun model(scene, options);
    const GroundMotion motion = trial_motion(scene.time.dt.value_or(0.01));
    fe2d::RunResult trial = model.run(motion);
    if (fails_statically(trial.status)) { // costs do not depend on friction: try one that holds
        const double needed = trial.stages.back().critical_friction;
        if (std::isfinite(needed)) {
            Contact holds = base_strength(scene);
            holds.friction = 1.1 * std::max(needed, holds.friction);
            trial = model.run(motion, holds);
        }
    }
    ContactCost cost;
    cost.set_up_seconds = model.seconds();
    if (steps > 0) cost.seconds_per_step = trial.seconds.dynamics / static_cast<double>(steps);
    add_parts(model, trial, cost);
    if (cost.seconds_per_step) add_records(ready, *cost.seconds_per_step, cost);
    return cost;
}

namespace {

constexpr double share_of_run = 0.8; ///< of the progress of a run; the rest is that on the coarser mesh

double share_of(const fe2d::RunProgress& p)
{
    return static_cast<double>(p.step) / static_cast<double>(std::max<std::int64_t>(1, p.steps));
}

fe2d::RunAnswer answer(const Watch& watch)
{
    return watch.stop_asked() ? fe2d::RunAnswer::stop : fe2d::RunAnswer::go_on;
}

} // namespace

ContactRuns::ContactRuns(const Ready& ready, const FeOptions& options, Watch& watch)
    : ready_(ready), watch_(watch), meter_(watch), polarity_(options.polarity), jobs_(options.jobs),
      options_(ready.run_options(watch)), coarser_(
                                              ready_, options.mesh_error && !options.start,
                                              [this](const fe2d::RunProgress& p) {
                                                  meter_.reached(share_of_run + (1.0 - share_of_run) * share_of(p));
                                                  return answer(watch_);
                                              },
                                              watch, options.modes.value_or(fe2d::default_modes))
{
    if (options.reduced) check_reducible(ready.scene);
    watch.begin(options.reduced ? "fe --reduced" : "fe", static_cast<double>(whole()));
    watch.phase("set-up");
    options_.reducing_rock = tell_of_large_box(watch);
    fe2d::RunOptions plain = options_;
    options_.start = options.start;
    if (options.pair_histories) options_.pair_series = fe2d::PairSeries::every_step;
    options_.frames = options.frames;
    options_.progress = [this](const fe2d::RunProgress& p) {
        meter_.reached(share_of_run * share_of(p));
        return answer(watch_);
    };
    options_.ends_when_lifts_wake = !options_.start;
    model_.emplace(ready.scene, options_);
    if (options.reduced)
        reduced_.emplace(*model_, ready.scene, options_, options.modes.value_or(fe2d::default_modes));
    if (options_.start && options_.start->pairs() != model_->structure().pairs())
        refuse(ready.scene.file,
               fmt::format("the state is of {} pairs, the model has {}.", options_.start->pairs(),
                           model_->structure().pairs()),
               "the state of the same model", "write the state anew with  --state-out");
    wake_lifts();
    if (const std::optional<Scene> exact = with_exact_contact(ready_.scene); exact && !reduced_) {
        set_corrector(*exact, plain);
        exact_.emplace(*exact, plain);
    }
    rigid_ = ready.rigid_model();
    combinations_ = ready.combinations();
}

/// Runs every record on the model in which no more lifts wake.
void ContactRuns::wake_lifts()
{
    const bool traced = ready_.scene.dam.crack == BodyCrack::traced;
    if ((ready_.scene.tied_lifts.empty() && !traced) || options_.start || reduced_) return;
    found_.resize(ready_.records().size());
    for (bool woken = true; woken;) {
        woken = false;
        for (std::size_t k = 0; k < found_.size() && !watch_.stop_asked(); ++k) {
            Found& found = found_[k];
            while (found.runs.empty() || found.model != passes_to_wake_) {
                const std::vector<GroundMotion> motions = ready_.motions(ready_.records()[k], polarity_);
                found.runs.assign(motions.size(), {});
                found.model = passes_to_wake_;
                parallel_for(motions.size(), jobs_,
                             [&](std::size_t i) { found.runs[i] = model_->run(motions[i]); });
                if (watch_.stop_asked()) return;
                woken = wake(found.runs) || draw_anew(found.runs) || crack(found.runs) || woken;
            }
        }
    }
}

/// Makes joints of the lifts that have reached wake_index: of each run those with about the largest index, for once they crack
/// they relieve the others. @returns whether there are any
bool ContactRuns::wake(const std::vector<fe2d::RunResult>& runs)
{
    constexpr double about = 0.95;
    std::vector<std::string> names;
    for (const fe2d::RunResult& run : runs) {
        double largest = fe2d::wake_index;
        for (const fe2d::TiedLift& lift : run.cracks.lifts) largest = std::max(largest, lift.index);
        for (const fe2d::TiedLift& lift : run.cracks.lifts)
            if (lift.index >= std::max(fe2d::wake_index, about * largest)) names.push_back(lift.name);
    }
    if (names.empty()) return false;
    const Scene before = ready_.scene;
    ready_.scene = with_awake_lifts(before, names);
    make_model(fmt::format("awake lifts: {}", ready_.scene.lift_joints.size()), before);
    return true;
}

/// A line where the concrete came to its strength first. @returns whether it did
bool ContactRuns::crack(const std::vector<fe2d::RunResult>& runs)
{
    const fe2d::RunResult* first = nullptr;
    for (const fe2d::RunResult& run : runs)
        if (run.cracks.cracks() && (!first || run.cracks.seed.time < first->cracks.seed.time)) first = &run;
    if (!first) return false;
    const Scene before = ready_.scene;
    ready_.scene = with_traced_crack(before, *first, traced_);
    make_model(traced_.back().name + " begins", before);
    return true;
}

/// Paths of cracks that have not settled. @returns whether one has moved
bool ContactRuns::draw_anew(const std::vector<fe2d::RunResult>& found)
{
    std::vector<const fe2d::RunResult*> runs;
    for (const fe2d::RunResult& run : found) runs.push_back(&run);
    const Scene before = ready_.scene;
    if (ready_.scene.dam.crack != BodyCrack::traced || watch_.stop_asked() || !draw_paths_anew(ready_.scene, runs, traced_))
        return false;
    make_model("paths of cracks drawn anew", before);
    return true;
}

/// Where no mesh follows the path of a crack, the lines of before stay: no path is drawn anew any more, and where the line was new no
/// more are traced.
void ContactRuns::make_model(const std::string& what, const Scene& before)
{
    ++passes_to_wake_;
    watch_.phase(fmt::format("{}, model {}", what, passes_to_wake_ + 1));
    options_.crack_starts = starts_of(ready_.scene, traced_);
    try {
        model_.emplace(ready_.scene, options_);
    } catch (const InputError&) {
        if (traced_.empty()) throw;
        const bool drawn = before.lift_joints.size() == ready_.scene.lift_joints.size();
        ready_.scene = before;
        ready_.scene.dam.crack = drawn ? BodyCrack::traced : BodyCrack::none;
        std::erase_if(traced_, [&](const TracedCrack& crack) {
            return std::none_of(before.lift_joints.begin(), before.lift_joints.end(),
                                [&](const LiftJoint& joint) { return joint.name == crack.name; });
        });
        for (TracedCrack& crack : traced_)
            if (!crack.settled) crack.passes = most_path_passes, crack.no_mesh = true;
        options_.crack_starts = starts_of(ready_.scene, traced_);
        model_.emplace(ready_.scene, options_);
    }
}

std::size_t ContactRuns::whole() const
{
    return motion_names(ready_.scene, ready_.records(), polarity_).size();
}

std::vector<ContactRun> ContactRuns::run(const TakeRun& take)
{
    std::vector<ContactRun> runs;
    const std::vector<MotionName> names = motion_names(ready_.scene, ready_.records(), polarity_);
    for (std::size_t k = 0; k < ready_.records().size(); ++k) {
        if (watch_.stop_asked()) break;
        const std::vector<GroundMotion> motions = ready_.motions(ready_.records()[k], polarity_);
        std::vector<ContactRun> both(motions.size());
        parallel_for(motions.size(), jobs_, [&](std::size_t i) {
            static_cast<MotionName&>(both[i]) = names[runs.size() + i];
            both[i].leaves_out = !not_honoured(ready_.scene, reduced_ ? methods::reduced : methods::fe).empty();
            both[i].tensile_strength = ready_.scene.dam.tensile_strength;
            for (const TracedCrack& crack : traced_)
                if (!crack.settled) both[i].unsettled_cracks += (both[i].unsettled_cracks.empty() ? "" : ", ") + crack.name;
            if (!found_.empty() && !found_[k].runs.empty()) both[i].fe = std::move(found_[k].runs[i]);
            run(motions[i], both[i]);
        });
        for (std::size_t i = 0; i < both.size(); ++i) {
            runs.push_back(std::move(both[i]));
            if (take) take(runs.back(), motions[i]);
        }
    }
    watch_.end();
    return runs;
}

void ContactRuns::run(const GroundMotion& motion, ContactRun& r)
{
    meter_.begin(1);
    if (r.fe.stages.empty()) // else it has run while lifts were waking
        r.fe = reduced_ ? reduced_->run(motion) : model_->run(motion);
    watch_.results_at_hand();
    r.mesh = coarser_.error_of(*model_, r.fe, motion);
    if (exact_ && !watch_.stop_asked()) r.exact = exact_->run(motion);
    if (rigid_.state == sliding::StaticState::at_rest) r.rigid = slide_model(ready_.scene, rigid_, motion, 1);
    meter_.end();
}

GroupQueue::GroupQueue(std::vector<std::size_t> models, int threads)
    : models_(std::move(models)), taken_(models_.size(), false),
      threads_(static_cast<std::size_t>(std::max(1, threads)))
{
}

std::optional<std::size_t> GroupQueue::next()
{
    const std::lock_guard lock(mutex_);
    while (first_ < taken_.size() && taken_[first_]) ++first_;
    if (first_ == taken_.size()) return std::nullopt;
    taken_[first_] = true;
    return first_++;
}

std::vector<std::size_t> GroupQueue::more_of(std::size_t group, std::size_t most)
{
    std::vector<std::size_t> more;
    if (most < 2) return more;
    const std::lock_guard lock(mutex_);
    for (std::size_t i = first_; i < models_.size(); ++i)
        if (!taken_[i] && models_[i] == models_[group]) more.push_back(i);
    const std::size_t share = (more.size() + 1 + threads_ - 1) / threads_; // of those left and `group`
    more.resize(std::min({more.size(), most - 1, share - 1}));
    for (const std::size_t i : more) taken_[i] = true;
    return more;
}

void FeMeter::begin(std::size_t runs)
{
    const std::lock_guard lock(mutex_);
    under_way_[std::this_thread::get_id()] = {static_cast<double>(runs), 0.0};
}

void FeMeter::more(std::size_t runs)
{
    const std::lock_guard lock(mutex_);
    under_way_[std::this_thread::get_id()].runs += static_cast<double>(runs);
}

void FeMeter::step(const fe2d::RunProgress& p)
{
    reached(static_cast<double>(p.step) / static_cast<double>(std::max<std::int64_t>(1, p.steps)));
}

void FeMeter::reached(double share)
{
    const std::lock_guard lock(mutex_);
    Group& group = under_way_[std::this_thread::get_id()];
    group.share = std::clamp(share, group.share, 1.0); // a further halving adds steps: never back
    show();
}

void FeMeter::end()
{
    const std::lock_guard lock(mutex_);
    done_ += under_way_[std::this_thread::get_id()].runs;
    under_way_.erase(std::this_thread::get_id());
    show();
}

void FeMeter::show()
{
    double done = done_;
    for (const auto& [thread, group] : under_way_) done += group.runs * group.share;
    watch_.at(done);
}

std::function<void(int unknowns)> tell_of_large_box(Watch& watch)
{
    constexpr int large = 20000; // boxes of 25 Hz have 9 000 to 14 000 and take 1 to 4 s
    return [&watch](int unknowns) {
        if (unknowns >= large)
            watch.phase(fmt::format(
                "the box of waves, {} unknowns, is reduced to the base (foundation.wave_frequency_Hz)", unknowns));
    };
}

} // namespace damslip
