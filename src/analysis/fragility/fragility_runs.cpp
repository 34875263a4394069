#include "analysis/fragility/fragility_runs.hpp"

#include "analysis/fe/contact_runs.hpp"
#include "analysis/fragility/fragility_estimate.hpp"
#include "analysis/prepare/plane_model.hpp"
#include "analysis/sweep/sweep_grid.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/parallel.hpp"
#include "core/version.hpp"
#include "fe2d/reduction/reduced_run.hpp"
#include "scene/scene_text.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

namespace damslip {

namespace {

constexpr const char* friction_key = "contact.friction";

std::atomic<double> in_solvers{0.0}; // [s], of all threads

/// Adds the wall time of its life to it.
class InSolver {
public:
    InSolver() = default;
    ~InSolver() { in_solvers += time_.seconds(); }
    InSolver(const InSolver&) = delete;
    InSolver& operator=(const InSolver&) = delete;

private:
    Stopwatch time_;
};

/// What the statics of the base and the modes of the dam do not know: strengths, and seams.
bool moves_no_statics(const std::string& key)
{
    return key == friction_key || key.starts_with("seam[") || key.starts_with("lifts.friction") ||
           key.starts_with("lifts.residual") || key.starts_with("lifts.cohesion");
}

/// What a rigid block does not ask the seepage for.
bool moves_no_water(const std::string& key)
{
    return moves_no_statics(key) || key.starts_with("contact.cohesion") || key.starts_with("contact.residual") ||
           key.starts_with("dam.") || key.starts_with("motion.") || key.starts_with("damping.");
}

/// The changes of a draw as text, without some keys: draws with the same text may share what does not depend on those.
template <class LeftOut>
std::string words_of(const FragilityDraw& draw, LeftOut left_out)
{
    std::string words;
    for (const KeyChange& change : draw.changes)
        if (!left_out(change.key)) words += change.key + " = " + text_of(change.value) + "\n";
    return words;
}

std::string words_without_friction(const FragilityDraw& draw)
{
    return words_of(draw, [](const std::string& key) { return key == friction_key; });
}

/// Rows of samples as they finish, from several threads.
class SampleStore {
public:
    SampleStore(FragilityRuns& runs, ResultStore* kept, Watch& watch) : runs_(runs), kept_(kept), watch_(watch) {}

    void finish(const std::vector<FinishedRow>& rows)
    {
        if (kept_)
            kept_->append(rows);
        else
            watch_.results_at_hand();
        const std::lock_guard lock(mutex_);
        for (const FinishedRow& row : rows) runs_.rows.put(row);
    }
    void begin(std::span<const std::size_t> ids)
    {
        if (kept_) kept_->begin(ids);
    }

private:
    FragilityRuns& runs_;
    ResultStore* kept_;
    Watch& watch_;
    std::mutex mutex_;
};

/// Shared by draws of the same words: those asked for last are kept, others are made again.
template <class Shared>
class KeptByWords {
public:
    std::shared_ptr<Shared> of(const std::string& words)
    {
        constexpr std::size_t most = 256;
        const auto [at, fresh] = kept_.try_emplace(words);
        if (fresh) at->second.shared = std::make_shared<Shared>();
        at->second.asked = ++asked_;
        const std::shared_ptr<Shared> shared = at->second.shared;
        if (kept_.size() > most)
            kept_.erase(std::min_element(kept_.begin(), kept_.end(),
                                         [](const auto& a, const auto& b) { return a.second.asked < b.second.asked; }));
        return shared;
    }

private:
    struct Entry {
        std::shared_ptr<Shared> shared;
        std::size_t asked = 0; ///< for the last time, counted over all
    };
    std::map<std::string, Entry> kept_;
    std::size_t asked_ = 0;
};

/// Statics and seepage that rigid blocks of several draws share.
class SharedStatics {
public:
    PrepareOptions options_of(const FragilityDraw& draw)
    {
        const std::lock_guard lock(mutex_);
        PrepareOptions options;
        options.seepage = seepage_.of(words_of(draw, moves_no_water));
        options.statics = statics_.of(words_of(draw, moves_no_statics));
        return options;
    }

private:
    std::mutex mutex_;
    KeptByWords<SeepageSource> seepage_;
    KeptByWords<KeptStatics> statics_;
};

/// The rigid runs of a plan.
class RigidSamples {
public:
    RigidSamples(const FragilityPlan& plan, const SceneText& text, const SweepMethod& method)
        : plan_(plan), text_(text), rocks_(method.kind == SweepKind::rocking),
          with_vertical_(rocks_ || method.kind == SweepKind::rigid_vertical),
          base_(prepare(text.scene(), Method::rigid_block, plan.suite.pairs)), own_motion_(plan.draws_key("motion."))
    {
    }

    /// The scaled records of these samples, made once; none where the motion itself is drawn.
    void make_motions(const SampleIds& wanted, int jobs)
    {
        if (own_motion_) return;
        for (const std::size_t id : wanted) motions_[key(plan_.samples[id])];
        std::vector<std::pair<const std::pair<std::size_t, std::size_t>, std::unique_ptr<sliding::SkippingMotion>>*>
            places;
        for (auto& entry : motions_) places.push_back(&entry);
        parallel_for(places.size(), jobs, [&](std::size_t i) {
            const auto& [record, level] = places[i]->first;
            const bool cloud = plan_.input.intensity.design == FragilityDesign::cloud;
            const double factor = cloud ? 1.0 : factor_of(record, level);
            places[i]->second = std::make_unique<sliding::SkippingMotion>(motion(base_, record, factor));
        });
    }

    /// All wanted samples of one draw. @param yield  of its block
    std::vector<FinishedRow> run(std::span<const std::size_t> ids, double& yield)
    {
        const FragilityDraw& draw = plan_.draws[plan_.samples[ids.front()].draw];
        const Ready ready =
            prepare(text_.with(draw.changes), Method::rigid_block, plan_.suite.pairs, shared_.options_of(draw));
        const std::vector<RigidModel> models = models_of(ready);
        yield = models.front().downstream.law.constant;
        std::vector<FinishedRow> rows;
        for (const std::size_t id : ids) {
            rows.push_back(run_one(ready, models.front(), id));
            for (std::size_t i = 1; i < models.size(); ++i)
                if (FinishedRow other = run_one(ready, models[i], id); further(other, rows.back())) rows.back() = std::move(other);
        }
        return rows;
    }

private:
    /// What may slide: the base, the plane of the limits, or all.
    std::vector<RigidModel> models_of(const Ready& ready) const
    {
        const std::string& plane = plan_.input.limits.front().plane;
        if (plane == base_plane) return {ready.rigid_model()};
        if (plane == any_plane) return all_models(ready);
        Scene scene = ready.scene;
        restore_lift_joints(scene, ready.given);
        return {plane_model(scene, plane, ready.statics.get())};
    }
    /// A plane that fails without an answer to give is the worst, then one without an answer, then the larger slip.
    static bool further(const FinishedRow& a, const FinishedRow& b)
    {
        const auto rank = [](const FinishedRow& row) { return !row.good ? 1 : row.results.max_slip ? 0 : 2; };
        return rank(a) != rank(b) ? rank(a) > rank(b) : a.results.max_slip > b.results.max_slip;
    }
    static std::pair<std::size_t, std::size_t> key(const FragilitySample& s) { return {s.record, s.level}; }
    double factor_of(std::size_t record, std::size_t level) const
    {
        return std::pow(plan_.input.intensity.levels[level] / plan_.suite.intensity[record], 1.0 / plan_.suite.power);
    }
    GroundMotion motion(const Ready& ready, std::size_t record, double factor) const
    {
        GroundMotion motion = ready.motion((*plan_.suite.pairs)[record], factor);
        return with_vertical_ ? motion : horizontal_only(std::move(motion));
    }
    sliding::SlideResult slide(const Ready& ready, const RigidModel& model, const FragilitySample& s) const
    {
        if (own_motion_) {
            const GroundMotion own = motion(ready, s.record, s.factor);
            const InSolver timed;
            return rocks_ ? rock_model(ready.scene, model, own, s.polarity).slide
                          : slide_model(ready.scene, model, own, s.polarity);
        }
        const sliding::SkippingMotion& shared = *motions_.at(key(s));
        const InSolver timed;
        return rocks_ ? rock_model(ready.scene, model, shared.motion(), s.polarity).slide
                      : slide_model(ready.scene, model, shared, s.polarity);
    }
    FinishedRow run_one(const Ready& ready, const RigidModel& model, std::size_t id) const
    {
        const FragilitySample& s = plan_.samples[id];
        const sliding::SlideResult r = slide(ready, model, s);
        FinishedRow row;
        row.id = id;
        row.results.slip = reported(r.status, r.slip);
        row.results.max_slip = reported(r.status, r.max_slip);
        row.results.upstream_slip = reported(r.status, r.upstream_slip);
        row.results.status = word(r.status);
        row.results.critical_friction = model.critical_friction;
        row.good = is_answer(r.status);
        return row;
    }

    const FragilityPlan& plan_;
    const SceneText& text_;
    bool rocks_, with_vertical_;
    Ready base_;
    bool own_motion_;
    SharedStatics shared_;
    std::map<std::pair<std::size_t, std::size_t>, std::unique_ptr<sliding::SkippingMotion>> motions_;
};

/// Wanted samples that are not finished, in runs of one draw each, some thousand at a time.
class MissingByDraw {
public:
    MissingByDraw(const FragilityPlan& plan, const SampleIds& wanted) : plan_(plan), wanted_(wanted) {}

    /// Those that come next; empty: there are no more.
    std::vector<std::vector<std::size_t>> next(const FragilityRuns& runs)
    {
        constexpr std::size_t most = 4096;
        std::vector<std::vector<std::size_t>> groups;
        std::size_t last = 0;
        for (; place_ < wanted_.size(); ++place_) {
            const std::size_t id = wanted_[place_];
            if (runs.rows.has(id)) continue;
            const std::size_t draw = plan_.samples[id].draw;
            if (groups.empty() || draw != last) {
                if (groups.size() == most) break;
                groups.emplace_back();
            }
            groups.back().push_back(id);
            last = draw;
        }
        return groups;
    }

private:
    const FragilityPlan& plan_;
    const SampleIds& wanted_;
    std::size_t place_ = 0;
};

void run_rigid(const FragilityPlan& plan, const SceneText& text, const SweepMethod& method, const SampleIds& wanted,
               SampleStore& store, int jobs, Watch& watch, FragilityRuns& runs)
{
    constexpr std::size_t draws_at_once = 16; // stored together
    const ProcessorClock clock(ProcessorTimeOf::process);
    RigidSamples samples(plan, text, method);
    watch.begin(method.kind == SweepKind::rocking ? "fragility, rocking block" : "fragility, rigid block",
                static_cast<double>(wanted.size()));
    samples.make_motions(wanted, jobs);
    std::atomic<std::size_t> done{runs.found};
    MissingByDraw missing(plan, wanted);
    for (auto groups = missing.next(runs); !groups.empty() && !watch.stop_asked(); groups = missing.next(runs)) {
        parallel_for((groups.size() + draws_at_once - 1) / draws_at_once, jobs, [&](std::size_t block) {
            if (watch.stop_asked()) return;
            std::vector<FinishedRow> rows;
            for (std::size_t g = block * draws_at_once; g < std::min(groups.size(), (block + 1) * draws_at_once); ++g) {
                double yield = 0.0;
                for (FinishedRow& row : samples.run(groups[g], yield)) rows.push_back(std::move(row));
                if (!runs.yield.empty()) runs.yield[plan.samples[groups[g].front()].draw] = yield;
            }
            store.finish(rows);
            watch.at(static_cast<double>(done += rows.size()));
        });
        runs.set_ups += groups.size();
    }
    watch.end();
    runs.seconds = clock.seconds();
}

/// Frictions of one model that meet one motion.
struct MotionGroup {
    std::string model; ///< changes but for the friction
    std::vector<std::size_t> ids;
};

std::vector<MotionGroup> motion_groups(const FragilityPlan& plan, const SampleIds& wanted, const FragilityRuns& runs)
{
    std::map<std::tuple<std::string, std::size_t, std::size_t, int>, std::vector<std::size_t>> found;
    std::vector<std::string> words;
    for (const FragilityDraw& draw : plan.draws) words.push_back(words_without_friction(draw));
    for (const std::size_t id : wanted) {
        const FragilitySample& s = plan.samples[id];
        if (!runs.rows.has(id)) found[{words[s.draw], s.level, s.record, s.polarity}].push_back(id);
    }
    constexpr std::size_t most_together = 64; // what goes through an earthquake together, and into the store at once
    std::vector<MotionGroup> groups;
    for (const auto& [key, ids] : found)
        for (std::size_t first = 0; first < ids.size(); first += most_together)
            groups.push_back(
                {std::get<0>(key),
                 {ids.begin() + static_cast<std::ptrdiff_t>(first),
                  ids.begin() + static_cast<std::ptrdiff_t>(std::min(ids.size(), first + most_together))}});
    return groups;
}

/// Mesh and matrices of one model while a group needs them.
struct DrawnModel {
    std::mutex mutex;
    std::size_t groups_left = 0;
    std::optional<Ready> ready;
    std::unique_ptr<const fe2d::EarthquakeRun> run;
    std::unique_ptr<const fe2d::ReducedRun> reduced; ///< on `run`; none: not asked for
    std::string why_not;                             ///< it could not be made; empty: it could
};

/// Limits whose answers are all that is asked of a run; empty: something needs the slip itself.
std::vector<double> slips_whose_side_counts(const FragilityInput& input)
{
    std::vector<double> slips;
    if (input.intensity.design == FragilityDesign::cloud) return slips; // it fits the slips
    for (const LimitInput& limit : input.limits) {
        if (!is_of_slip(limit)) return {};
        slips.push_back(limit.value);
    }
    return slips;
}

class FiniteElementSamples {
public:
    FiniteElementSamples(const FragilityPlan& plan, const SceneText& text, const SweepMethod& method, Watch& watch)
        : plan_(plan), text_(text), method_(method), watch_(watch), meter_(watch)
    {
    }

    void run(const std::vector<MotionGroup>& groups, SampleStore& store, int jobs, FragilityRuns& runs)
    {
        for (const MotionGroup& group : groups) ++models_[group.model].groups_left;
        GroupQueue queue(numbers_of_models(groups), thread_count(jobs));
        std::mutex mutex;
        parallel_for(groups.size(), jobs, [&](std::size_t) {
            if (watch_.stop_asked()) return;
            const std::optional<std::size_t> first = queue.next();
            if (!first) return;
            const ProcessorClock clock;
            run(groups, *first, queue, store);
            const std::lock_guard lock(mutex);
            runs.seconds += clock.seconds();
        });
        for (const auto& [words, model] : models_) {
            runs.set_ups += model.ready.has_value();
            if (!model.why_not.empty()) runs.failures.insert(model.why_not);
        }
    }

private:
    std::vector<std::size_t> numbers_of_models(const std::vector<MotionGroup>& groups) const
    {
        std::map<std::string_view, std::size_t> numbers;
        for (const auto& [words, model] : models_) numbers.emplace(words, numbers.size());
        std::vector<std::size_t> of_groups;
        for (const MotionGroup& group : groups) of_groups.push_back(numbers.at(group.model));
        return of_groups;
    }

    /// A group that the thread has taken, and others that go through the earthquake with it.
    void run(const std::vector<MotionGroup>& groups, std::size_t first, GroupQueue& queue, SampleStore& store)
    {
        std::vector<const MotionGroup*> together{&groups[first]};
        DrawnModel& model = models_.at(groups[first].model);
        meter_.begin(groups[first].ids.size());
        store.begin(groups[first].ids);
        try {
            const bool is_made = made(model, plan_.draws[plan_.samples[groups[first].ids.front()].draw]);
            if (is_made && !model.reduced)
                for (const std::size_t i :
                     queue.more_of(first, model.run->runs_together() / groups[first].ids.size())) {
                    together.push_back(&groups[i]);
                    store.begin(groups[i].ids);
                    meter_.more(groups[i].ids.size());
                }
            std::vector<FinishedRow> rows = is_made ? rows_of(model, together) : rows_without_model(groups[first]);
            std::erase_if(rows, [](const FinishedRow& row) { return row.results.status == word(Status::interrupted); });
            store.finish(rows);
        } catch (const Interrupted&) { // in the set-up: these are not finished
        }
        meter_.end();
        const std::lock_guard lock(model.mutex);
        model.groups_left -= together.size();
        if (model.groups_left == 0) {
            model.reduced.reset();
            model.run.reset();
        }
    }

    static std::vector<FinishedRow> rows_without_model(const MotionGroup& group)
    {
        std::vector<FinishedRow> rows;
        for (const std::size_t id : group.ids) rows.push_back(fe_row(id, {}, false)); // not resolved
        return rows;
    }

    GroundMotion motion_of(const Ready& ready, const MotionGroup& group) const
    {
        const FragilitySample& s = plan_.samples[group.ids.front()];
        return ready.motion((*plan_.suite.pairs)[s.record], s.factor, s.polarity);
    }

    std::vector<FinishedRow> rows_of(const DrawnModel& model, const std::vector<const MotionGroup*>& together) const
    {
        std::vector<std::size_t> ids;
        std::vector<GroundMotion> motions;
        for (const MotionGroup* group : together) motions.push_back(motion_of(*model.ready, *group));
        std::vector<fe2d::Shaking> shakings;
        for (std::size_t k = 0; k < together.size(); ++k)
            for (const std::size_t id : together[k]->ids) {
                shakings.push_back({&motions[k], contact_of(*model.ready, plan_.draws[plan_.samples[id].draw])});
                ids.push_back(id);
            }
        std::vector<FinishedRow> rows;
        const auto put = [&](const fe2d::RunResult& run) {
            rows.push_back(fe_row(ids[rows.size()], run, false));
            if (run.modes == 0) put_base(run, rows.back().results);
        };
        const InSolver timed;
        if (model.reduced) {
            for (const fe2d::Shaking& shaking : shakings) {
                if (watch_.stop_asked()) break;
                put(model.reduced->run(*shaking.motion, shaking.contact, {}, fe2d::TruncationEstimate::left_out));
            }
            return rows;
        }
        for (const fe2d::RunResult& run : model.run->run_all(shakings)) put(run);
        return rows;
    }

    /// Opening of the base and what it holds after the earthquake: of full runs alone.
    static constexpr double most_factor = 1e6;
    static void put_base(const fe2d::RunResult& r, RowResults& results)
    {
        if (!is_answer(r.status) || fails_statically(r.status)) return;
        const std::vector<double>& opening = r.history.largest_opening;
        if (!opening.empty()) results.opening = *std::max_element(opening.begin(), opening.end());
        if (r.after.status != fe2d::StageStatus::not_resolved && !r.after.name.empty())
            results.factor_after = std::min(r.after.sliding_factor, most_factor); // infinite without shear
    }

    static Contact contact_of(const Ready& ready, const FragilityDraw& draw)
    {
        for (const KeyChange& change : draw.changes)
            if (const auto* mu = std::get_if<double>(&change.value); mu && change.key == friction_key)
                return *mu == ready.scene.contact.friction ? ready.scene.contact
                                                           : with_friction(ready.scene, *mu).contact;
        return ready.scene.contact;
    }

    bool made(DrawnModel& model, const FragilityDraw& draw)
    {
        const std::lock_guard lock(model.mutex); // others who need the same model wait for it
        if (!model.why_not.empty()) return false;
        if (model.run) return true;
        try {
            std::vector<KeyChange> changes = draw.changes; // the friction is each run's own
            std::erase_if(changes, [](const KeyChange& change) { return change.key == friction_key; });
            const Scene scene = with_law(text_.with(changes), method_.law, {});
            const InSolver timed;
            model.ready.emplace(prepare(scene, Method::finite_elements, plan_.suite.pairs, {.stop = watch_.stop()}));
            fe2d::RunOptions options = model.ready->run_options(watch_);
            options.progress = [this](const fe2d::RunProgress& p) {
                meter_.step(p);
                return watch_.stop_asked() ? fe2d::RunAnswer::stop : fe2d::RunAnswer::go_on;
            };
            if (method_.reduced) options.slip_limits = slips_whose_side_counts(plan_.input); // full runs are those of `fe`
            model.run = std::make_unique<fe2d::EarthquakeRun>(model.ready->scene, options);
            if (method_.reduced)
                model.reduced =
                    std::make_unique<fe2d::ReducedRun>(*model.run, model.ready->scene, options, fe2d::default_modes);
        } catch (const NotConverged& error) {
            model.why_not = error.diagnostic().problem;
        }
        return model.why_not.empty();
    }

    const FragilityPlan& plan_;
    const SceneText& text_;
    const SweepMethod& method_;
    Watch& watch_;
    FeMeter meter_;
    std::map<std::string, DrawnModel> models_;
};

} // namespace

double seconds_in_solvers()
{
    return in_solvers;
}

FragilityRuns no_runs(const FragilityPlan& plan, std::size_t wanted, Yields yields)
{
    FragilityRuns runs;
    runs.rows = PackedRows(plan.samples.size());
    if (yields == Yields::kept) runs.yield.assign(plan.draws.size(), std::numeric_limits<double>::quiet_NaN());
    runs.wanted = wanted;
    return runs;
}

void take_finished(const ResultStore& store, std::size_t first, std::size_t last, FragilityRuns& runs)
{
    constexpr std::size_t at_once = 4096; // rows that are not packed yet
    for (std::size_t from = first; from <= last; from += at_once)
        for (const FinishedRow& row : store.rows(from, std::min(last, from + at_once - 1))) {
            ++runs.found;
            runs.rows.put(row);
        }
}

SweepIdentity fragility_identity(const FragilityPlan& plan, const SceneText& text, const std::string& method)
{
    SweepIdentity identity;
    identity.version = program_version();
    identity.scene = scene_hash(text.scene());
    std::string contents;
    for (const RecordPair& pair : *plan.suite.pairs)
        contents +=
            pair.horizontal.source.sha256 + "\n" + (pair.vertical ? pair.vertical->source.sha256 : "none") + "\n";
    identity.records = sha256(contents);
    Sha256 words;
    for (const FragilityDraw& draw : plan.draws)
        words.add(words_of(draw, [](const std::string&) { return false; }) + ";");
    for (const FragilitySample& s : plan.samples)
        words.add(fmt::format("{} {} {} {} {}\n", s.draw, s.level, s.record, s.polarity, s.factor));
    identity.grid = fmt::format("fragility by {}, {} draws, {} levels, plan {}", method, plan.draws.size(), plan.levels,
                                words.finish());
    if (const std::string& plane = plan.input.limits.front().plane; plane != base_plane) identity.grid += ", plane " + plane;
    identity.rows = plan.samples.size();
    return identity;
}

SampleIds wanted_samples(const FragilityPlan& plan, const Shard& shard)
{
    const std::size_t draws = plan.draws.size();
    const auto first_of = [&](std::size_t draw) { // samples lie by draw
        std::size_t low = 0, high = plan.samples.size();
        while (low < high) {
            const std::size_t middle = low + (high - low) / 2;
            const bool before = plan.samples[middle].draw < draw;
            (before ? low : high) = before ? middle + 1 : middle;
        }
        return low;
    };
    const std::size_t first = first_of(shard.index * draws / shard.count),
                      last = first_of((shard.index + 1) * draws / shard.count);
    return {last - first, [first](std::size_t place) { return first + place; }};
}

FragilityRuns run_fragility(const FragilityPlan& plan, const SceneText& text, const SweepMethod& method,
                            const SampleIds& wanted, ResultStore* kept, int jobs, Watch& watch, Yields yields)
{
    FragilityRuns runs = no_runs(plan, wanted.size(), yields);
    SampleStore store(runs, kept, watch);
    if (kept && !wanted.empty()) take_finished(*kept, wanted[0], wanted[wanted.size() - 1], runs);
    if (method.kind != SweepKind::finite_elements) {
        run_rigid(plan, text, method, wanted, store, jobs, watch, runs);
        if (kept) kept->flush();
        return runs;
    }
    const std::vector<MotionGroup> groups = motion_groups(plan, wanted, runs);
    watch.begin("fragility, finite elements", static_cast<double>(wanted.size() - runs.found));
    FiniteElementSamples(plan, text, method, watch).run(groups, store, jobs, runs);
    if (kept) kept->flush();
    watch.end();
    return runs;
}

namespace {

constexpr std::uint8_t bad_run = 0x80;

/// Stands for no figure: a NaN that no calculation gives.
constexpr std::uint64_t no_figure = 0x7ff8'6e6f'6e65'0001;

bool is_figure(double x)
{
    return std::bit_cast<std::uint64_t>(x) != no_figure;
}

} // namespace

std::size_t PackedRows::finished() const
{
    return size() - static_cast<std::size_t>(std::count(state_.begin(), state_.end(), std::uint8_t{0}));
}

const std::optional<FinishedRow> PackedRows::operator[](std::size_t id) const
{
    if (!has(id)) return std::nullopt;
    FinishedRow row;
    row.id = id;
    row.good = (state_[id] & bad_run) == 0;
    row.results.status = statuses_[(state_[id] & ~bad_run) - 1u];
    for (std::size_t i = 0; i < figures_.size(); ++i)
        if (!figures_[i].empty() && is_figure(figures_[i][id])) row.results.*row_numbers[i].value = figures_[i][id];
    return row;
}

void PackedRows::put(const FinishedRow& row)
{
    for (std::size_t i = 0; i < figures_.size(); ++i) {
        const std::optional<double>& figure = row.results.*row_numbers[i].value;
        if (figure && figures_[i].empty()) figures_[i].assign(size(), std::bit_cast<double>(no_figure));
        if (!figures_[i].empty()) figures_[i][row.id] = figure.value_or(std::bit_cast<double>(no_figure));
    }
    state_[row.id] = state_of(row);
}

std::uint8_t PackedRows::state_of(const FinishedRow& row)
{
    const auto at = std::find(statuses_.begin(), statuses_.end(), row.results.status);
    const auto place = static_cast<std::uint8_t>(at - statuses_.begin());
    if (at == statuses_.end()) statuses_.push_back(row.results.status); // of a list of few words
    return static_cast<std::uint8_t>((place + 1u) | (row.good ? 0u : bad_run));
}

} // namespace damslip
