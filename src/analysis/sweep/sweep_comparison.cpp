#include "analysis/sweep/sweep_comparison.hpp"

#include <algorithm>
#include <cmath>

namespace damslip {

namespace {

SweepComparison comparison_at(const Scene& scene, const Grid& grid, const SweepOutcome& outcome, GridIndex g)
{
    SweepComparison c;
    c.at = g;
    c.largest_error = 0.0;
    const RigidModel& model = grid.model(g);
    double fe = 0.0, rigid = 0.0;
    for (g.record = 0; g.record < grid.records.size(); ++g.record)
        for (g.polarity = 0; g.polarity < grid.axes.polarity.size(); ++g.polarity) {
            const FinishedRow* row = outcome.find(grid.tasks.id(g));
            if (!row) continue;
            const RowResults& found = row->results;
            if (found.critical_friction) c.critical_friction = found.critical_friction;
            const Status status = status_of(*row).value_or(Status::not_resolved);
            c.static_failures += fails_statically(status);
            if (!found.slip || !is_answer(status)) c.without.add(status);
            if (!is_answer(status) || !found.slip || model.state != sliding::StaticState::at_rest) continue;
            const sliding::SlideResult slide =
                slide_model(scene, model, grid.motion(g), grid.axes.polarity[g.polarity]);
            const std::optional<double> block = reported(slide.status, std::abs(slide.slip));
            if (!block) continue;
            const double slip = std::abs(*found.slip);
            ++c.motions;
            fe += slip;
            rigid += *block;
            c.largest_fe = std::max(c.largest_fe, slip);
            c.largest_rigid = std::max(c.largest_rigid, *block);
            c.largest_error = found.slip_error && c.largest_error
                                  ? std::optional(std::max(*c.largest_error, *found.slip_error))
                                  : std::nullopt;
        }
    const auto n = static_cast<double>(std::max<std::int64_t>(1, c.motions));
    c.mean_fe = fe / n;
    c.mean_rigid = rigid / n;
    if (rigid > 0.0) c.ratio_of_means = fe / rigid;
    return c;
}

} // namespace

std::vector<SweepComparison> compare_with_rigid(const Scene& scene, const Grid& grid, const SweepOutcome& outcome)
{
    std::vector<SweepComparison> list;
    for (std::size_t id = 0; id < grid.tasks.rows(); ++id) { // one of each group of motions stands for it
        const GridIndex g = grid.tasks.index(id);
        if (g.record == 0 && g.polarity == 0 && grid.axes.method[g.method].kind == SweepKind::finite_elements)
            list.push_back(comparison_at(scene, grid, outcome, g));
    }
    return list;
}

} // namespace damslip
