#include "pages/sweep/sweep_pages.hpp"

#include "analysis/prepare/plane_model.hpp"
#include "analysis/prepare/ready.hpp"
#include "analysis/prepare/records.hpp"
#include "pages/scene/scene_pages.hpp"
#include "scene/plausible.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::pages {

namespace {

/// What the numbers of a row do not say by themselves.
Cell remark(const SweepLine& l)
{
    return l.error_known() ? Cell() : Cell(no_error_estimate);
}

/// Empty of methods that know no rock.
Cell rock(const Grid& grid, const GridIndex& at)
{
    const std::string& words = grid.rocks[at.method];
    return words.empty() ? Cell() : Cell(words);
}

/// Null: the method does not have it, as the rigid block those through lift joints.
const RowAnchor* anchor_of(const SweepLine& l, const std::string& name)
{
    const std::vector<RowAnchor>& all = l.results.anchors;
    const auto at = std::ranges::find_if(all, [&](const RowAnchor& a) { return a.name == name; });
    return at == all.end() ? nullptr : &*at;
}

/// Only an axis with several values is an answer.
Column if_varied(std::size_t values, Column column)
{
    return values > 1 ? in_brief(std::move(column)) : column;
}

/// Of the axes that every method has. @param Item  has a place `at` in the grid
template <class Item>
std::vector<ColumnOf<Item>> dam_columns(const Axes& axes)
{
    using I = Item;
    std::vector<ColumnOf<I>> all{
        {if_varied(axes.friction.size(), {"friction", "μ", "–", 4}),
         [&](const I& i) { return friction_of(axes, i.at); }},
        {if_varied(axes.level.size() * axes.size.size(), {"level_m", "level", "m", 4}),
         [&](const I& i) { return axes.level[i.at.level] * axes.size[i.at.size]; }},
        {if_varied(axes.uplift.size(), {"uplift", "uplift"}), [&](const I& i) { return axes.uplift[i.at.uplift]; }}};
    if (has_opening_axis(axes))
        all.push_back({if_varied(axes.opening.size(), {"opening_water", "opening water"}),
                       [&](const I& i) { return axes.opening[i.at.opening]; }});
    all.push_back({if_varied(axes.reservoir.size(), {"reservoir", "reservoir"}),
                   [&](const I& i) { return axes.reservoir[i.at.reservoir]; }});
    all.push_back(
        {if_varied(axes.size.size(), {"size", "size", "–", 4}), [&](const I& i) { return axes.size[i.at.size]; }});
    return all;
}

/// Of what the grid has. @param mean  of both polarities, too
std::vector<ColumnOf<SweepLine>> columns(const Grid& grid, bool mean)
{
    using L = SweepLine;
    using units::standard_gravity;
    const auto given = [](std::optional<double> RowResults::*number) {
        return [=](const L& l) { return optional_cell(l.results.*number); };
    };
    using R = RowResults;
    const Axes& axes = grid.axes;
    std::vector<ColumnOf<L>> all{{{"id", "id"}, &L::id}};
    if (has_plane_axis(axes))
        all.push_back({if_varied(axes.plane.size(), {"plane", "plane"}), [](const L& l) {
                           const std::string& plane = l.axes().plane[l.at.plane];
                           return plane.empty() ? Cell(std::string(base_plane)) : Cell(plane);
                       }});
    for (ColumnOf<L>& column : dam_columns<L>(axes)) all.push_back(std::move(column));
    if (!axes.period.empty())
        all.push_back({{"period_s", "T_s", "s", 4}, [](const L& l) { return l.axes().period[l.at.period]; }});
    if (!axes.damping.empty())
        all.push_back({{"damping", "damping", "–", 4}, [](const L& l) { return l.axes().damping[l.at.damping]; }});
    const std::vector<ColumnOf<L>> rest{
        {if_varied(axes.scale.size(), {"scale", "scale", "–", 4}), [](const L& l) { return l.axes().scale[l.at.scale]; }},
        {in_brief({"polarity", "polarity"}), [](const L& l) { return l.axes().polarity[l.at.polarity]; }},
        {in_brief({"record", "record"}), [](const L& l) { return l.grid.records[l.at.record]; }},
        {if_varied(axes.method.size(), {"method", "method"}),
         [](const L& l) { return l.axes().method[l.at.method].id; }},
        {{"yield_acceleration_m_s2", "a_y", "m/s²", 5}, [](const L& l) { return l.yield(); }},
        {{"yield_coefficient_g", "a_y", "g", 5}, [](const L& l) { return l.yield() / standard_gravity; }},
        {{"pga_m_s2", "PGA", "m/s²", 4}, [](const L& l) { return l.grid.pga(l.id); }},
        {{"slip_m", "slip", "m", 5}, given(&R::slip)},
        {ranking({"max_slip_m", "largest", "m", 5}), given(&R::max_slip)},
        {{"upstream_slip_m", "upstream", "m", 4}, given(&R::upstream_slip)},
        {{"slip_low_m", "−1σ", "m", 4}, given(&R::slip_low)},
        {{"slip_high_m", "+1σ", "m", 4}, given(&R::slip_high)},
        {in_brief({"slip_error_m", "± step", "m", 2}), given(&R::slip_error)},
        {in_brief({"truncation_error_m", "± modes", "m", 2}), given(&R::truncation_error)},
        {{"critical_friction", "critical μ", "–", 6}, given(&R::critical_friction)},
        {in_brief({"status", "status"}), [](const L& l) { return l.results.status.empty() ? Cell() : Cell(l.results.status); }},
        {{"lift_joint_slip_m", "lift joints", "m", 5}, given(&R::lift_slip)},
        {{"remark", "remark"}, remark},
        {in_brief({"walked_at_least_m", "slid at least", "m", 5}), given(&R::slid_at_least)},
        {{"thrust_over_friction", "χ", "–", 3}, given(&R::thrust_over_friction)},
        {{"hops", "lift-offs"},
         [](const L& l) { return l.results.lift_offs ? Cell(std::llround(*l.results.lift_offs)) : Cell(); }},
        {{"hop_frequency_Hz", "lift-offs", "Hz", 3}, given(&R::lift_off_frequency)},
        {{"unloaded_share", "unloaded", "–", 3}, given(&R::unloaded_share)},
        {{"end_rate_m_s", "rate at end", "m/s", 3}, given(&R::end_rate)},
        {{"shaking_slip_m", "while shaken", "m", 5}, given(&R::slip_shaking)},
        {{"run_out_slip_m", "at rest", "m", 5}, given(&R::slip_at_rest)},
        {{"rock", "rock"}, [](const L& l) { return rock(l.grid, l.at); }}};
    all.insert(all.end(), rest.begin(), rest.end());
    for (std::size_t k = 0; k < grid.events.size(); ++k)
        all.push_back(
            {{fmt::format("slip_after_event_{}_m", k + 1), "after " + grid.events[k], "m", 5}, [k](const L& l) {
                 const std::vector<double>& slips = l.results.event_slips;
                 return k < slips.size() ? Cell(slips[k]) : Cell();
             }});
    for (std::size_t k = 0; k < grid.anchors.size(); ++k) {
        const std::string& name = grid.anchors[k];
        all.push_back(
            {{fmt::format("anchor_{}_largest_force_N_m", k + 1), "largest N, " + name, "N/m", 5}, [name](const L& l) {
                 const RowAnchor* anchor = anchor_of(l, name);
                 return anchor ? Cell(anchor->largest_force) : Cell();
             }});
        all.push_back({{fmt::format("anchor_{}_state", k + 1), name}, [name](const L& l) {
                           const RowAnchor* anchor = anchor_of(l, name);
                           return anchor ? Cell(anchor->state) : Cell();
                       }});
    }
    if (mean) all.push_back({{"mean_slip_m", "mean of both polarities", "m", 5}, &L::mean});
    return all;
}

/// Of the rows that differ in polarity alone; none where one of them is missing or has no slip.
std::optional<double> mean_of_polarities(const Grid& grid, GridIndex at, const SweepOutcome& outcome)
{
    double sum = 0.0;
    for (at.polarity = 0; at.polarity < grid.axes.polarity.size(); ++at.polarity) {
        const FinishedRow* row = outcome.find(grid.tasks.id(at));
        if (!row || !row->results.slip) return std::nullopt;
        sum += *row->results.slip;
    }
    return sum / static_cast<double>(grid.axes.polarity.size());
}

} // namespace

void for_each_sweep_row(const Grid& grid, const std::vector<std::size_t>& ids, const SweepOutcome& outcome, bool mean,
                        const TakeLine& take)
{
    static const RowResults unreached = not_run();
    const std::vector<ColumnOf<SweepLine>> list = columns(grid, mean);
    std::vector<Cell> cells(list.size());
    auto next = outcome.rows.begin(); // both ascend
    for (const std::size_t id : ids) {
        while (next != outcome.rows.end() && next->id < id) ++next;
        const FinishedRow* row = next != outcome.rows.end() && next->id == id ? &*next : nullptr;
        const GridIndex at = grid.tasks.index(id);
        const SweepLine line{grid, id, at, row ? row->results : unreached, row,
                             mean ? mean_of_polarities(grid, at, outcome) : std::nullopt};
        for (std::size_t j = 0; j < list.size(); ++j) cells[j] = list[j].value(line);
        take(line, cells);
    }
}

Table sweep_table(const Grid& grid, const std::vector<std::size_t>& ids, const SweepOutcome& outcome, bool mean)
{
    Table table{"", sweep_columns(grid, mean), {}, {}};
    table.rows.reserve(ids.size());
    for_each_sweep_row(grid, ids, outcome, mean,
                       [&](const SweepLine&, const std::vector<Cell>& cells) { table.rows.push_back(cells); });
    return table;
}

std::vector<Column> sweep_columns(const Grid& grid, bool mean)
{
    std::vector<Column> list;
    for (const ColumnOf<SweepLine>& c : columns(grid, mean)) list.push_back(c.column);
    return list;
}

Table comparison_table(const Grid& grid, const std::vector<SweepComparison>& compared)
{
    using C = SweepComparison;
    const Axes& axes = grid.axes;
    const auto in_mm = [](double C::*slip) {
        return [=](const C& c) { return c.motions ? Cell(1e3 * (c.*slip)) : Cell(); };
    };
    const auto error = [](const C& c) { return c.largest_error && c.motions ? Cell(1e3 * *c.largest_error) : Cell(); };
    std::vector<ColumnOf<C>> all = dam_columns<C>(axes);
    const std::vector<ColumnOf<C>> rest{
        {{"scale", "scale", "–", 4}, [&](const C& c) { return axes.scale[c.at.scale]; }},
        {{"method", "method"}, [&](const C& c) { return axes.method[c.at.method].id; }},
        {{"motions", "motions"}, &C::motions},
        {{"static_failures", "static failures"}, &C::static_failures},
        {{"critical_friction", "critical μ", "–", 6}, &C::critical_friction},
        {{"mean_fe_mm", "FE mean", "mm", 5}, in_mm(&C::mean_fe)},
        {{"mean_rigid_mm", "rigid mean", "mm", 5}, in_mm(&C::mean_rigid)},
        {{"ratio_of_means", "ratio", "–", 4}, &C::ratio_of_means},
        {{"largest_fe_mm", "FE largest", "mm", 5}, in_mm(&C::largest_fe)},
        {{"largest_rigid_mm", "rigid largest", "mm", 5}, in_mm(&C::largest_rigid)},
        {{"largest_slip_error_mm", "± step", "mm", 2}, error},
        {{"without_slip", "not compared"},
         [](const C& c) { return c.without.empty() ? Cell() : Cell(c.without.words()); }},
        {{"rock", "rock"}, [&](const C& c) { return rock(grid, c.at); }}};
    all.insert(all.end(), rest.begin(), rest.end());
    return table_of<C>(
        "Slip by finite elements against the rigid block, " + polarity_words(axes.polarity), all, compared,
        {"both with the vertical component where the record has one; only motions that both methods carried to their "
         "end count; not compared: FE runs without a slip or an answer. No ± step: sub-steps are fixed."});
}

Table count_table(const FeSweepCounts& counts)
{
    using C = FeSweepCounts;
    return table_of<C>(
        "Finite-element runs",
        {{{"set_ups", "set-ups"}, &C::set_ups},
         {{"runs", "runs"}, &C::runs},
         {{"static_failures", "static failures"}, &C::static_failures},
         {{"steps", "steps"}, &C::steps},
         {{"factorisations", "factorisations"}, &C::factorisations},
         {{"unresolved", "unresolved steps"}, &C::unresolved}},
        std::vector<C>{counts},
        {"steps: of the pass that is reported of each run; factorisations: step sizes, each made once for "
         "all runs."});
}

} // namespace damslip::pages
