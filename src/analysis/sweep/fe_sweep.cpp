#include "analysis/sweep/fe_sweep.hpp"

#include "analysis/fe/contact_runs.hpp"
#include "analysis/prepare/plane_model.hpp"
#include "analysis/prepare/ready.hpp"
#include "analysis/sweep/sweep_grid.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "core/version.hpp"
#include "fe2d/reduction/reduced_run.hpp"
#include "scene/joint_bond.hpp"
#include "scene/planes.hpp"
#include "scene/scene_text.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <mutex>
#include <tuple>

namespace damslip {

namespace {

/// Mesh and matrices of one variant and law while a group needs them.
struct PreparedModel {
    std::mutex mutex;
    std::size_t groups_left = 0;
    Scene scene;
    fe2d::RunOptions options;
    std::unique_ptr<const fe2d::EarthquakeRun> full;
    std::unique_ptr<const fe2d::ReducedRun> reduced; ///< on `full`; none: not asked for yet
    std::string why_not;                             ///< it could not be made; empty: it could
};
/// Variant, law, and whether reservoir.model = "auto" stays added mass, as on few modes of the dam.
using ModelKey = std::tuple<std::size_t, FeLaw, bool>;

void count(const fe2d::RunResult& r, FeSweepCounts& counts)
{
    ++counts.runs;
    counts.static_failures += fails_statically(r.status);
    counts.steps += r.counts.steps;
    counts.unresolved += r.counts.unresolved;
    counts.static_seconds += r.seconds.statics;
    counts.dynamic_seconds += r.seconds.dynamics;
}

void add(const FeSweepCounts& c, FeSweepCounts& sum)
{
    sum.set_ups += c.set_ups;
    sum.runs += c.runs;
    sum.static_failures += c.static_failures;
    sum.steps += c.steps;
    sum.factorisations += c.factorisations;
    sum.unresolved += c.unresolved;
    sum.set_up_seconds += c.set_up_seconds;
    sum.static_seconds += c.static_seconds;
    sum.dynamic_seconds += c.dynamic_seconds;
    sum.choices.insert(c.choices.begin(), c.choices.end());
    sum.failures.insert(c.failures.begin(), c.failures.end());
}

Scene scene_of(const Sweep& in, const GridIndex& at)
{
    return with_law(variant_of(in.scene, in.axes, at), in.axes.method[at.method].law, in.penalty_stiffness);
}

/// Groups through their models.
class FeGroups {
public:
    FeGroups(const Sweep& inputs, const std::vector<FeGroup>& groups, Watch& watch, const BeginRows& begin,
             const TakeRuns& take)
        : in_(inputs), groups_(groups), meter_(watch), watch_(watch), begin_(begin), take_(take)
    {
        for (const FeGroup& group : groups) ++models_[key(group)].groups_left;
    }

    /// A group that the thread has taken, and others that go through the earthquake with it.
    FeSweepCounts run(std::size_t first, GroupQueue& queue)
    {
        FeSweepCounts counts;
        std::vector<const FeGroup*> together{&groups_[first]};
        PreparedModel& model = models_.at(key(*together.front()));
        meter_.begin(together.front()->rows.size());
        if (!watch_.stop_asked()) {
            try {
                begin_(together.front()->rows);
                if (made(model, in_.tasks.index(together.front()->rows.front()), counts)) {
                    if (!model.reduced)
                        for (const std::size_t i :
                             queue.more_of(first, model.full->runs_together() / together.front()->rows.size())) {
                            together.push_back(&groups_[i]);
                            begin_(groups_[i].rows);
                            meter_.more(groups_[i].rows.size());
                        }
                    run_prepared(model, together, counts);
                } else {
                    take_(together.front()->rows, std::vector<fe2d::RunResult>(together.front()->rows.size()));
                }
            } catch (const Interrupted&) { // in the set-up: these rows are not finished
            }
        }
        meter_.end();
        const std::lock_guard lock(model.mutex);
        model.groups_left -= together.size();
        if (model.groups_left == 0) {
            if (model.full) counts.factorisations += model.full->factorisations();
            model.reduced.reset();
            model.full.reset();
        }
        return counts;
    }

    /// Groups whose rows were stopped before go through the earthquake by themselves.
    std::vector<std::size_t> models_of_groups() const
    {
        std::vector<std::size_t> numbers;
        for (const FeGroup& group : groups_)
            numbers.push_back(group.alone
                                  ? models_.size() + numbers.size()
                                  : static_cast<std::size_t>(std::distance(models_.begin(), models_.find(key(group)))));
        return numbers;
    }

private:
    /// Laws that come to the same share a model.
    ModelKey key(const FeGroup& group) const
    {
        const FeLaw law = in_.axes.method[group.method].law;
        return {group.variant, law == FeLaw::exact && !with_exact_contact(in_.scene) ? FeLaw::scene : law,
                in_.axes.method[group.method].reduced};
    }

    GroundMotion motion_of(const FeGroup& group) const
    {
        const GridIndex at = in_.tasks.index(group.rows.front());
        return ground_motion(in_.scene, (*in_.records)[at.record], in_.axes.scale[at.scale],
                             in_.axes.polarity[at.polarity]);
    }

    void run_prepared(const PreparedModel& model, const std::vector<const FeGroup*>& together, FeSweepCounts& counts)
    {
        if (model.reduced)
            run_reduced_group(model, motion_of(*together.front()), *together.front(), counts);
        else
            run_full(model, together, counts);
    }

    /// @returns false where a solver found no answer: then there is no model, for any of its rows
    bool made(PreparedModel& model, const GridIndex& at, FeSweepCounts& counts)
    {
        const std::lock_guard lock(model.mutex); // others who need the same model wait for it
        if (!model.why_not.empty()) return false;
        try {
            make(model, at, counts);
        } catch (const NotConverged& error) {
            model.why_not = error.diagnostic().problem;
            counts.failures.insert(model.why_not);
        }
        return model.why_not.empty();
    }

    void make(PreparedModel& model, const GridIndex& at, FeSweepCounts& counts)
    {
        if (!model.full) {
            const Ready ready =
                prepare(scene_of(in_, at), Method::finite_elements, in_.records, {.stop = watch_.stop()});
            if (ready.reservoir) counts.choices.insert(ready.reservoir->reason);
            model.scene = ready.scene;
            model.options = ready.run_options(watch_);
            model.options.progress = [this](const fe2d::RunProgress& p) {
                meter_.step(p);
                return watch_.stop_asked() ? fe2d::RunAnswer::stop : fe2d::RunAnswer::go_on;
            };
            model.options.reducing_rock = tell_of_large_box(watch_);
            model.full = std::make_unique<fe2d::EarthquakeRun>(model.scene, model.options);
            ++counts.set_ups;
            counts.set_up_seconds += model.full->seconds();
        }
        if (in_.axes.method[at.method].reduced && !model.reduced)
            model.reduced = std::make_unique<fe2d::ReducedRun>(*model.full, model.scene, model.options,
                                                               in_.modes.value_or(fe2d::default_modes));
    }

    Contact contact(const PreparedModel& model, std::size_t id) const
    {
        const double friction = friction_of(in_.axes, in_.tasks.index(id));
        const Contact& own = base_strength(model.scene);
        return friction == own.friction ? own : base_strength(with_friction(model.scene, friction));
    }

    void run_full(const PreparedModel& model, const std::vector<const FeGroup*>& together, FeSweepCounts& counts)
    {
        std::vector<GroundMotion> motions;
        for (const FeGroup* group : together) motions.push_back(motion_of(*group));
        std::vector<fe2d::Shaking> shakings;
        for (std::size_t k = 0; k < together.size(); ++k)
            for (const std::size_t id : together[k]->rows) shakings.push_back({&motions[k], contact(model, id)});
        const std::vector<fe2d::RunResult> results = model.full->run_all(shakings);
        std::size_t first = 0;
        for (const FeGroup* group : together) {
            const std::span runs = std::span(results).subspan(first, group->rows.size());
            for (const fe2d::RunResult& run : runs) count(run, counts);
            take_(group->rows, runs);
            first += runs.size();
        }
    }

    void run_reduced_group(const PreparedModel& model, const GroundMotion& motion, const FeGroup& group,
                           FeSweepCounts& counts)
    {
        using fe2d::TruncationEstimate;
        const auto estimate = in_.truncation_error ? TruncationEstimate::made : TruncationEstimate::left_out;
        for (const std::size_t& id : group.rows) {
            if (watch_.stop_asked()) return;
            const fe2d::RunResult run = model.reduced->run(motion, contact(model, id), {}, estimate);
            count(run, counts);
            take_({&id, 1}, {&run, 1});
            meter_.reached(static_cast<double>(&id - group.rows.data() + 1) / static_cast<double>(group.rows.size()));
        }
    }

    const Sweep& in_;
    const std::vector<FeGroup>& groups_;
    FeMeter meter_;
    Watch& watch_;
    const BeginRows& begin_;
    const TakeRuns& take_;
    std::map<ModelKey, PreparedModel> models_;
};

} // namespace

Sweep make_sweep(Scene scene, Axes axes)
{
    Records records = load_records(scene, Method::rigid_block);
    const TaskList tasks = make_tasks(axes, records->size());
    return {std::move(scene), std::move(axes), tasks, std::move(records)};
}

void check_fe_scenes(const Sweep& in)
{
    for (std::size_t variant = 0; variant < in.tasks.variants(); ++variant)
        for (std::size_t method = 0; method < in.axes.method.size(); ++method) {
            if (in.axes.method[method].kind != SweepKind::finite_elements) continue;
            GridIndex at = in.tasks.index(variant * in.tasks.motions() * in.tasks.method);
            at.method = method;
            const Scene scene = with_seam_body(scene_of(in, at));
            const EffectPlan plan = make_effect_plan(scene, Method::finite_elements);
            if (in.axes.method[method].reduced) check_reducible(called_for(plan, scene));
        }
}

std::vector<FeGroup> fe_groups(const TaskList& tasks, const Axes& axes, const std::vector<std::size_t>& rows,
                               std::size_t parts)
{
    std::map<std::tuple<std::size_t, std::size_t, std::size_t>, FeGroup> found; // by variant, method, motion
    for (const std::size_t id : rows) { // ascending ids: ascending frictions within a group
        const GridIndex at = tasks.index(id);
        if (axes.method[at.method].kind != SweepKind::finite_elements) continue;
        FeGroup& group = found[{tasks.variant(at), at.method, tasks.motion(at)}];
        group.variant = tasks.variant(at);
        group.method = at.method;
        group.motion = tasks.motion(at);
        group.rows.push_back(id);
    }
    const std::size_t shares = found.empty() ? 1 : (parts + found.size() - 1) / found.size();
    std::vector<FeGroup> groups;
    for (const auto& [key, group] : found) {
        const std::size_t here = std::min(std::max<std::size_t>(1, shares), group.rows.size());
        for (std::size_t share = 0; share < here; ++share) { // every here-th friction: low ones fail at once
            FeGroup part{group.variant, group.motion, group.method, {}};
            for (std::size_t k = share; k < group.rows.size(); k += here) part.rows.push_back(group.rows[k]);
            groups.push_back(std::move(part));
        }
    }
    return groups;
}

std::vector<FeGroup> with_stopped_in_pieces(std::vector<FeGroup> groups, const std::map<std::size_t, int>& stopped)
{
    if (stopped.empty()) return groups;
    std::vector<FeGroup> pieces;
    for (const FeGroup& group : groups) {
        int times = 0;
        for (const std::size_t id : group.rows)
            if (const auto found = stopped.find(id); found != stopped.end()) times = std::max(times, found->second);
        const std::size_t length = std::max<std::size_t>(1, times < 32 ? group.rows.size() >> times : 0);
        for (std::size_t first = 0; first < group.rows.size(); first += length) {
            FeGroup piece{group.variant, group.motion, group.method, {}, times > 0};
            for (std::size_t k = first; k < std::min(group.rows.size(), first + length); ++k)
                piece.rows.push_back(group.rows[k]);
            pieces.push_back(std::move(piece));
        }
    }
    return pieces;
}

FeSweepCounts run_fe_groups(const Sweep& inputs, const std::vector<FeGroup>& groups, int jobs, Watch& watch,
                            const BeginRows& begin, const TakeRuns& take)
{
    FeGroups runner(inputs, groups, watch, begin, take);
    GroupQueue queue(runner.models_of_groups(), thread_count(jobs));
    std::vector<FeSweepCounts> counted(groups.size());
    parallel_for(groups.size(), jobs, [&](std::size_t task) {
        if (const std::optional<std::size_t> group = queue.next()) counted[task] = runner.run(*group, queue);
    });
    FeSweepCounts sum;
    for (const FeSweepCounts& c : counted) add(c, sum);
    return sum;
}

namespace {

constexpr double resolution = 1e7; ///< values per metre

double rounded(double slip)
{
    return std::round(slip * resolution) / resolution;
}

} // namespace

SlipHistory slip_history(const std::vector<double>& time, const std::vector<double>& slip)
{
    SlipHistory history;
    if (time.size() < 2) return history;
    const double step = time[1] - time[0];
    const auto every = static_cast<double>((time.size() + history_values - 1) / history_values);
    history.interval = every * step;
    std::size_t next = 1; // first sample at or after t
    for (std::size_t k = 0; k < history_values; ++k) {
        const double t = time.front() + static_cast<double>(k) * history.interval;
        if (t > time.back() + 1e-6 * step) break;
        while (next + 1 < time.size() && time[next] < t - 1e-6 * step) ++next;
        const double share = (t - time[next - 1]) / (time[next] - time[next - 1]);
        history.slip.push_back(rounded(slip[next - 1] + std::clamp(share, 0.0, 1.0) * (slip[next] - slip[next - 1])));
    }
    return history;
}

SweepIdentity sweep_identity(const Sweep& inputs)
{
    const Scene& scene = inputs.scene;
    SweepIdentity identity;
    identity.version = program_version();
    identity.scene = scene_hash(scene);
    std::string contents;
    for (const RecordFiles& files : scene.motion.records) {
        contents += sha256(read_file(files.horizontal)) + "\n";
        contents += (files.vertical ? sha256(read_file(*files.vertical)) : "none") + "\n";
    }
    if (scene.mesh.file) contents += sha256(read_file(*scene.mesh.file)) + "\n";
    identity.records = sha256(contents);
    identity.grid = text_of(inputs.axes);
    if (inputs.modes) identity.grid += fmt::format("; modes {}", *inputs.modes);
    if (inputs.truncation_error) identity.grid += "; truncation error";
    if (inputs.penalty_stiffness) identity.grid += "; penalty stiffness " + shortest(*inputs.penalty_stiffness);
    identity.rows = inputs.tasks.rows();
    return identity;
}

std::string hash_of(const SweepIdentity& identity)
{
    return sha256(fmt::format("{}\n{}\n{}\n{}\n{}\n", identity.version, identity.scene, identity.records, identity.grid,
                              identity.rows));
}

std::vector<std::string> csv_comments(const SweepIdentity& identity)
{
    return {"damslip " + identity.version + " sweep", "scene " + identity.scene,
            "sweep " + hash_of(identity) + fmt::format(", {} rows", identity.rows)};
}

} // namespace damslip
