#include "analysis/ablation/ablation_rows.hpp"

#include <algorithm>
#include <cmath>

namespace damslip {

namespace {

std::string remark_of(const AblationRow& row, const MotionOutcome& full, const MotionOutcome& own)
{
    if (!own.slip && !own.message.empty()) return own.reason();
    if (!full.slip && own.slip) return "the full scene has no slip to compare with";
    if (row.still_sliding) return "still sliding after the run-out: a lower bound";
    if (row.within_step_error) return "within the step error";
    return "";
}

/// The slip with AblationStep::other; empty where the one with AblationStep::halvings is.
std::optional<double> slip_at_other_step(const AblationRuns& runs, std::size_t scene, std::size_t motion)
{
    const bool both = runs.scenes[scene].motions[motion].slip && motion < runs.other_step[scene].motions.size();
    return both ? runs.other_step[scene].motions[motion].slip : std::nullopt;
}

AblationRow row_of(const std::string& name, const AblationRuns& runs, std::size_t scene, std::size_t motion)
{
    const MotionOutcome &full = runs.scenes.front().motions[motion], &own = runs.scenes[scene].motions[motion];
    const bool is_full = scene == 0;
    AblationRow row{runs.motions[motion], name, word(own.status)};
    row.still_sliding = own.still_sliding;
    row.slip = change_from(full.slip, own.slip);
    row.crest = change_from(full.crest, own.crest);
    for (std::size_t k = 0; k < full.lift_slips.size(); ++k)
        row.lifts.push_back(change_from(full.lift_slips[k],
                                        k < own.lift_slips.size() ? std::optional(own.lift_slips[k]) : std::nullopt));
    if (const std::optional<double> other = slip_at_other_step(runs, scene, motion)) {
        row.slip_error = difference_error(*runs.step, *own.slip, *other);
        if (const std::optional<double> full_other = slip_at_other_step(runs, 0, motion)) {
            row.change_error = difference_error(*runs.step, *own.slip - *full.slip, *other - *full_other);
            row.within_step_error =
                !is_full && *row.slip.change != 0.0 && std::abs(*row.slip.change) <= *row.change_error;
        }
    }
    row.remark = remark_of(row, full, own);
    if (is_full) {
        row.slip.change.reset();
        row.slip.percent.reset();
        row.crest.change.reset();
        row.crest.percent.reset();
        row.change_error.reset();
        for (Change& lift : row.lifts) lift.change.reset(), lift.percent.reset();
    }
    return row;
}

} // namespace

Change change_from(const std::optional<double>& full, const std::optional<double>& value)
{
    Change c{value, {}, {}};
    if (!full || !value) return c;
    c.change = *value - *full;
    if (*full != 0.0) c.percent = 100.0 * *c.change / std::abs(*full);
    return c;
}

std::vector<std::string> scene_names(const AblationPlan& plan)
{
    std::vector<std::string> names{full_name};
    for (const Ablation& a : plan.removals) names.push_back(a.name);
    if (plan.simplest) names.emplace_back(simplest_name);
    return names;
}

std::vector<AblationRow> rows_of(const AblationPlan& plan, const AblationRuns& runs, std::size_t motion)
{
    const std::vector<std::string> names = scene_names(plan);
    std::vector<AblationRow> rows;
    for (std::size_t i = 0; i < runs.scenes.size(); ++i) rows.push_back(row_of(names[i], runs, i, motion));
    return rows;
}

std::optional<double> sum_of_changes(const AblationPlan& plan, const std::vector<AblationRow>& rows)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < plan.removals.size(); ++i) {
        if (plan.removals[i].part_of) continue;
        const std::optional<double>& change = rows[i + 1].slip.change;
        if (!change || rows[i + 1].still_sliding) return std::nullopt;
        sum += *change;
    }
    return sum;
}

std::optional<double> saved_seconds(const VariantRuns& full, const VariantRuns& own)
{
    const auto whole = [](const VariantRuns& s) {
        return std::all_of(s.motions.begin(), s.motions.end(), [](const MotionOutcome& r) { return r.slip; });
    };
    if (!whole(full) || !whole(own)) return std::nullopt;
    return full.all_seconds() - own.all_seconds();
}

} // namespace damslip
