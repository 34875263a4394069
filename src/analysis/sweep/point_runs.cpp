#include "analysis/sweep/point_runs.hpp"

#include "core/processor_clock.hpp"
#include "core/usage_error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tuple>

namespace damslip {

namespace {

/// All that the records, as they are read, depend on.
std::string names_of_records(const Scene& scene)
{
    std::string text = fmt::format("{}|{}|{}", scene.motion.vertical, scene.motion.sequence_pause,
                                   fmt::join(scene.motion.sequence, "|"));
    for (const RecordFiles& r : scene.motion.records)
        text += fmt::format("\n{}|{}|{}|{}|{}|{}|{}|{}|{}", r.name, r.horizontal.string(),
                            r.vertical ? r.vertical->string() : "", r.unit, r.dt.value_or(0.0), r.column,
                            r.vertical_column, r.magnitude.value_or(0.0), r.scale);
    return text;
}

std::size_t record_index(const Records& records, const std::string& name)
{
    std::vector<std::string> names;
    for (const RecordPair& pair : *records) names.push_back(pair.files.name);
    if (name.empty() && names.size() == 1) return 0;
    const auto at = std::find(names.begin(), names.end(), name);
    if (at != names.end()) return static_cast<std::size_t>(at - names.begin());
    refuse_usage(name.empty() ? fmt::format("the scene has {} records, and none is named.", names.size())
                              : fmt::format("the scene has no record \"{}\".", name),
                 fmt::format("one of \"{}\"", fmt::join(names, "\", \"")), "name one of them as \"record\"");
}

/// What a method needs of the scene. @throws UsageError
void check_method(const Scene& scene, const SweepMethod& method)
{
    if (scene.wedge && method.kind == SweepKind::finite_elements)
        refuse_usage(fmt::format("method {} cannot take a [wedge]: it has no section for finite elements.", method.id),
                     "rigid, rigid-v and the regressions", "write another method");
    if (is_flexible(method.kind) && (scene.wedge || (!scene.flexible_block && scene.regressions.period <= 0.0)))
        refuse_usage(fmt::format("method {}: the scene does not say how the block vibrates.", method.id),
                     "[flexible_block] with period_s, or regressions.period_s", "add it to the scene");
    if (method.law == FeLaw::penalty && !scene.contact.tangential_stiffness)
        refuse_usage("method fe-penalty: the scene does not give the stiffness of sticking.",
                     "contact.tangential_stiffness_N_m3 with enforcement = \"penalty\"", "write  fe  or  fe-exact");
}

} // namespace

PointAnswer PointRuns::run(const Scene& scene, const SweepMethod& method, const std::string& record, Watch& watch)
{
    const ProcessorClock clock(ProcessorTimeOf::process);
    check_method(scene, method);
    const std::string names = names_of_records(scene);
    if (!records_ || names != names_) records_ = load_records(scene, Method::rigid_block);
    names_ = names;
    Axes axes = axes_of(scene);
    axes.method = {method};
    Sweep sweep{scene, std::move(axes), {}, records_};
    sweep.tasks = make_tasks(sweep.axes, records_->size());
    check_fe_scenes(sweep);
    GridIndex at = sweep.tasks.index(0);
    at.record = record_index(records_, record);
    std::vector<std::size_t> ids;
    for (at.polarity = 0; at.polarity < sweep.axes.polarity.size(); ++at.polarity) ids.push_back(sweep.tasks.id(at));
    const Grid grid = make_grid(scene, sweep.axes, sweep.tasks, records_, 1);
    SweepOutcome outcome = run_sweep(sweep, grid, ids, nullptr, 1, watch);
    if (outcome.rows.size() < ids.size()) throw Interrupted("a point");
    const auto severity = [](const FinishedRow& row) {
        return std::tuple(!row.good, !row.results.slip, row.results.max_slip ? std::abs(*row.results.max_slip) : 0.0);
    };
    FinishedRow& worse = *std::max_element(outcome.rows.begin(), outcome.rows.end(), [&](const auto& a, const auto& b) {
        return severity(a) < severity(b);
    });
    const int polarity = sweep.axes.polarity[sweep.tasks.index(worse.id).polarity];
    return {std::move(worse), (*records_)[at.record].files.name, polarity, method.id, clock.seconds()};
}

SweepMethod usual_method(const Scene& scene)
{
    const bool vertical = std::any_of(scene.motion.records.begin(), scene.motion.records.end(),
                                      [](const RecordFiles& r) { return r.vertical.has_value(); });
    return sweep_method(vertical && scene.motion.vertical ? "rigid-v" : "rigid");
}

} // namespace damslip
