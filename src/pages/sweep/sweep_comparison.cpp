#include "pages/sweep/sweep_comparison.hpp"

#include "core/status_count.hpp"

#include <algorithm>

namespace damslip::pages {

namespace {

std::vector<Cell> comparison_row(const Scene& scene, const Grid& grid, const SweepOutcome& outcome, GridIndex g)
{
    const Axes& axes = grid.axes;
    const RigidModel& model = grid.model(g);
    std::int64_t motions = 0, failures = 0;
    double fe = 0.0, rigid = 0.0, largest_fe = 0.0, largest_rigid = 0.0;
    std::optional<double> critical, error = 0.0; // no error: some motion has none
    StatusCount without;
    for (g.record = 0; g.record < grid.records.size(); ++g.record)
        for (g.polarity = 0; g.polarity < axes.polarity.size(); ++g.polarity) {
            const FinishedRow* row = outcome.find(grid.tasks.id(g));
            if (!row) continue;
            if (const auto value = critical_friction_of(*row)) critical = value;
            const std::optional<double> slip = slip_of(*row);
            const Status status = status_of(*row).value_or(Status::not_resolved);
            failures += fails_statically(status);
            if (!slip || !is_answer(status)) without.add(status);
            if (!is_answer(status) || !slip || model.state != sliding::StaticState::at_rest) continue;
            const sliding::SlideResult slide = slide_model(scene, model, grid.motion(g), axes.polarity[g.polarity]);
            const std::optional<double> block = reported(slide.status, slide.slip);
            if (!block) continue;
            ++motions;
            fe += *slip;
            rigid += *block;
            largest_fe = std::max(largest_fe, *slip);
            largest_rigid = std::max(largest_rigid, *block);
            const std::optional<double> own = slip_error_of(*row);
            error = own && error ? std::optional(std::max(*error, *own)) : std::nullopt;
        }
    const auto mm = [&](double metres) { return motions ? Cell(1e3 * metres) : Cell(); };
    const auto n = static_cast<double>(std::max<std::int64_t>(1, motions));
    return {axes.friction[g.friction],
            axes.level[g.level] * axes.size[g.size],
            axes.uplift[g.uplift],
            axes.reservoir[g.reservoir],
            axes.size[g.size],
            axes.scale[g.scale],
            axes.method[g.method].id,
            motions,
            failures,
            critical ? Cell(*critical) : Cell(),
            mm(fe / n),
            mm(rigid / n),
            rigid > 0.0 ? Cell(fe / rigid) : Cell(),
            mm(largest_fe),
            mm(largest_rigid),
            error ? mm(*error) : Cell(),
            without.empty() ? Cell() : Cell(without.words())};
}

} // namespace

Table comparison(const Scene& scene, const Grid& grid, const SweepOutcome& outcome)
{
    const Axes& axes = grid.axes;
    Table t;
    t.title = "Slip by finite elements against the rigid block";
    t.columns = {{"friction", "μ", "–", 4},
                 {"level_m", "level", "m", 4},
                 {"uplift", "uplift", "", 4},
                 {"reservoir", "reservoir", "", 4},
                 {"size", "size", "–", 4},
                 {"scale", "scale", "–", 4},
                 {"method", "method", "", 4},
                 {"motions", "motions", "", 4},
                 {"static_failures", "static failures", "", 4},
                 {"critical_friction", "critical μ", "–", 6},
                 {"mean_fe_mm", "FE mean", "mm", 5},
                 {"mean_rigid_mm", "rigid mean", "mm", 5},
                 {"ratio_of_means", "ratio", "–", 4},
                 {"largest_fe_mm", "FE largest", "mm", 5},
                 {"largest_rigid_mm", "rigid largest", "mm", 5},
                 {"largest_slip_error_mm", "± step", "mm", 2},
                 {"without_slip", "not compared", "", 4}};
    for (std::size_t id = 0; id < grid.tasks.rows(); ++id) { // one of each group of motions stands for it
        const GridIndex g = grid.tasks.index(id);
        if (g.record == 0 && g.polarity == 0 && axes.method[g.method].kind == SweepKind::finite_elements)
            t.rows.push_back(comparison_row(scene, grid, outcome, g));
    }
    t.notes.push_back("both with the vertical component where the record has one; only motions that both methods "
                      "carried to their end count; not compared: FE runs without a slip or an answer. No ± step: "
                      "sub-steps are fixed.");
    return t;
}

Table count_table(const FeSweepCounts& c)
{
    Table t;
    t.title = "Finite-element runs";
    t.columns = {{"set_ups", "set-ups", "", 4},
                 {"runs", "runs", "", 4},
                 {"static_failures", "static failures", "", 4},
                 {"steps", "steps", "", 4},
                 {"factorisations", "factorisations", "", 4},
                 {"unresolved", "unresolved steps", "", 4}};
    t.notes.push_back(
        "steps: of the pass that is reported of each run; factorisations: step sizes, each made once for all runs.");
    t.rows.push_back({c.set_ups, c.runs, c.static_failures, c.steps, c.factorisations, c.unresolved});
    return t;
}

} // namespace damslip::pages
