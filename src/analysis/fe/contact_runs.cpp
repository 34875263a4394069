#include "analysis/fe/contact_runs.hpp"

#include "analysis/prepare/lift_joints.hpp"
#include "core/input_error.hpp"
#include "core/parallel.hpp"
#include "scene/joint_bond.hpp"
#include "scene/keys.hpp"

#include <algorithm>
#include <atomic>
#include <fmt/format.h>
#include <utility>

namespace damslip {

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
        throw InputError(Diagnostic{ready.scene.file.string(), 0, 0,
                                    fmt::format("the state is of {} pairs, the model has {}.", options_.start->pairs(),
                                                model_->structure().pairs()),
                                    "the state of the same model", "write the state anew with  --state-out"});
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
