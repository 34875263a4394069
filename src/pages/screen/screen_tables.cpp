#include "pages/fe/fe_pages.hpp"
#include "pages/screen/screen_pages.hpp"

#include "analysis/screen/regression_rows.hpp"
#include "core/units.hpp"
#include "pages/scene/scene_pages.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <ranges>

namespace damslip::pages {

namespace {

using units::mm;
using units::standard_gravity;

constexpr double long_period =
    2.0; ///< T_s from which one mode says little under common motions [s] (docs/neighbours.md)

std::string state_word(const BaseRow& row)
{
    switch (row.model.state) {
    case sliding::StaticState::at_rest:
        return overturns(row) ? "OVERTURNS" : "stands";
    case sliding::StaticState::slides_downstream:
        return "SLIDES STATICALLY";
    case sliding::StaticState::slides_upstream:
        return "SLIDES UPSTREAM";
    case sliding::StaticState::lifts_off:
        return "FLOATS";
    }
    return "";
}

Cell verdict_cell(Verdict verdict)
{
    return verdict == Verdict::none ? Cell() : Cell(word(verdict));
}

Cell verdict_cell(const SlipRow& row, const std::optional<double>& allowable)
{
    return judge(row, allowable) == Verdict::none ? Cell() : Cell(verdict_word(row, allowable));
}

/// @param slip  one of the slide's slips, in the unit of its column
Cell slip_cell(const sliding::SlideResult& r, double slip)
{
    return optional_cell(reported(r.status, slip));
}

void note_static_sliding(const Screening& s, Table& table)
{
    if (s.slips.empty() || !fails_statically(s.slips.front().horizontal.status)) return;
    const RigidModel& m = s.bases.front().model;
    if (overturns(s.bases.front())) {
        table.notes.push_back("tips over without any earthquake: no slip is given.");
        return;
    }
    table.notes.push_back("slides statically: no slip is given, it would grow for as long as the record lasts; " +
                          (std::isfinite(m.critical_friction) ? fmt::format("critical μ = {:.4g}.", m.critical_friction)
                                                              : std::string("no friction would hold it.")));
}

/// A mass that is flexible is not judged by the rigid block.
Cell rigid_verdict_cell(const SlipRow& row, const std::optional<double>& allowable)
{
    if (row.governing().method != "rigid") return fmt::format("judged by {}", row.governing().method);
    return verdict_cell(row, allowable);
}

/// What no PASS may rest on, and what a PASS rests on.
void note_premises(const Screening& s, const std::optional<double>& allowable, Table& table)
{
    if (allowable && s.dry_base)
        table.notes.push_back("verdict: of a base taken as dry although there is water on the dam.");
    const bool rocks =
        std::ranges::any_of(s.slips, [](const SlipRow& row) { return row.governing().method == "rocking"; });
    for (const std::string& premise : broken_premises(s))
        table.notes.push_back((rocks ? "judged by the block that rocks and slides: the dam " : "no PASS: the dam ") +
                              premise + ".");
}

/// What a verdict says, and what it cannot say.
void note_verdict(const Screening& s, const std::optional<double>& allowable, Table& table)
{
    if (!allowable || s.flexible) return;
    table.notes.push_back(
        fmt::format("verdict: largest slip against criteria.allowable_slip = {:.4g} mm{}.", *allowable / mm,
                    s.slips.front().of_dam ? "; below: no PASS, the rigid block is no upper bound of an elastic dam" : ""));
    if (std::ranges::any_of(s.slips, [](const SlipRow& row) { return std::isnan(row.governing().error); }))
        table.notes.push_back("undecided: the error of SLAMMER's scheme is not known; --scheme exact has none.");
}

constexpr const char* regressions_title = "Empirical regressions (horizontal component, no uplift or water beyond a_y)";

/// What gives no answer of its own for a record, by reason: "El Centro: outside its range, not weighted: jibson-1993
/// 707.7 mm, ...; no slip expected: 8; needs magnitude: 7." Empty: nothing.
std::string folded_line(const std::vector<RegressionRow>& rows, const std::string& record)
{
    std::vector<std::string> reasons;
    std::map<std::string, std::size_t> count;
    std::string outside;
    for (const RegressionRow& row : rows) {
        if (row.record != record || row.status == "valid" || row.id == weighted_median_id) continue;
        if (count[row.status]++ == 0) reasons.push_back(row.status);
        if (!row.valid && row.median)
            outside += fmt::format("{}{} {:.4g} mm", outside.empty() ? "" : ", ", row.id, *row.median / mm);
    }
    std::string line;
    for (const std::string& reason : reasons)
        line += fmt::format("{}{}", line.empty() ? record + ": " : "; ",
                            reason == sliding::outside_its_range ? reason + ", not weighted: " + outside
                                                                 : fmt::format("{}: {}", reason, count[reason]));
    return line.empty() ? line : line + ".";
}

} // namespace

Table yield_table(const Screening& s)
{
    using R = BaseRow;
    const auto downstream = [](const R& r) { return r.model.downstream.law.constant; };
    Table t = table_of<R>(
        "Yield acceleration",
        {{{"base", "base"}, &R::base},
         {{"friction", "μ", "–", 4}, [](const R& r) { return r.model.block.friction; }},
         {{"uplift_kN_m", "uplift U", "kN/m", 6}, [](const R& r) { return r.model.block.uplift / 1e3; }},
         {{"yield_acceleration_m_s2", "a_y downstream", "m/s²", 6}, downstream},
         {{"yield_coefficient_g", "a_y downstream", "g", 6},
          [=](const R& r) { return downstream(r) / standard_gravity; }},
         {{"yield_acceleration_upstream_m_s2", "a_y upstream", "m/s²", 6},
          [](const R& r) { return r.model.upstream.law.constant; }},
         {{"yield_with_crack_m_s2", "a_y with crack", "m/s²", 6},
          [](const R& r) { return finite_cell(r.limits.yield_with_crack); }},
         {{"yield_with_crack_g", "a_y with crack", "g", 4},
          [](const R& r) { return finite_cell(r.limits.yield_with_crack / standard_gravity); }},
         {{"tips_m_s2", "overturning at", "m/s²", 4}, [](const R& r) { return r.limits.tips; }},
         {{"tips_g", "overturning at", "g", 4}, [](const R& r) { return r.limits.tips / standard_gravity; }},
         {{"opens_m_s2", "full base opening at", "m/s²", 4}, [](const R& r) { return r.limits.opens; }},
         {{"opens_g", "full base opening at", "g", 4}, [](const R& r) { return r.limits.opens / standard_gravity; }},
         {{"critical_friction", "critical μ", "–", 6}, [](const R& r) { return r.model.critical_friction; }},
         {{"state", "without earthquake"}, state_word}},
        s.bases,
        {"a_y: ground acceleration at which it starts to slide; critical μ: friction that just holds it without an "
         "earthquake.",
         "a_y with crack: the same with the crack that this acceleration opens (by uplift.crack) and the bond of the "
         "rest.",
         "overturning at: constant ground acceleration at which the dam tips about its toe, uplift by uplift.opening; "
         "full base opening at: that at which its joint is open from heel to toe (by uplift.crack) and its bond "
         "lost."});
    if (std::ranges::any_of(
            s.bases, [](const R& r) { return r.model.critical_friction == 0.0 && r.model.block.cohesion_force > 0.0; }))
        t.notes.push_back("critical μ 0: cohesion alone suffices.");
    return t;
}

Table lift_joint_table(const Scene& scene)
{
    using B = LiftBlock;
    Table t =
        table_of<B>("Blocks above the lift joints",
                    {{{"joint", "joint"}, &B::joint},
                     {{"elevation_m", "elevation", "m", 5}, &B::elevation},
                     {{"friction", "μ", "–", 4}, &B::friction},
                     {{"normal_force_kN_m", "N'", "kN/m", 6}, &B::normal_force, 1e3},
                     {{"shear_force_kN_m", "T", "kN/m", 6}, &B::shear_force, 1e3},
                     {{"sliding_factor", "sliding factor", "–", 4}, &B::sliding_factor},
                     {{"critical_friction", "critical μ", "–", 6}, &B::critical_friction},
                     {{"yield_acceleration_m_s2", "a_y downstream", "m/s²", 6}, &B::yield_acceleration},
                     {{"yield_coefficient_g", "a_y downstream", "g", 6}, &B::yield_acceleration, standard_gravity}},
                    lift_blocks(scene));
    if (!t.rows.empty())
        t.notes.push_back("a_y: acceleration of the joint at which the block above starts to slide; the dam below "
                          "amplifies that of the ground, which `damslip fe` computes.");
    return t;
}

Table mean_slip_table(const Screening& s)
{
    struct Row {
        std::string record;
        std::vector<const sliding::SlideResult*> horizontal, vertical, governing;
    };
    std::vector<Row> rows;
    for (const SlipRow& r : s.slips) {
        if (rows.empty() || rows.back().record != r.record) rows.push_back({r.record, {}, {}, {}});
        Row& row = rows.back();
        row.horizontal.push_back(&r.horizontal);
        if (r.with_vertical) row.vertical.push_back(&*r.with_vertical);
        if (r.flexible) row.governing.push_back(&r.judged());
    }
    const auto mean = [](auto member) {
        return [member](const Row& r) {
            double sum = 0.0;
            for (const sliding::SlideResult* slide : r.*member) {
                const std::optional<double> slip = reported(slide->status, slide->slip / mm);
                if (!slip) return Cell();
                sum += *slip;
            }
            return (r.*member).size() == 2 ? Cell(0.5 * sum) : Cell();
        };
    };
    std::vector<ColumnOf<Row>> columns{{{"record", "record"}, &Row::record},
                                       {{"mean_slip_h_mm", "slip h", "mm", 5}, mean(&Row::horizontal)},
                                       {{"mean_slip_hv_mm", "slip h+v", "mm", 5}, mean(&Row::vertical)}};
    if (std::ranges::any_of(rows, [](const Row& r) { return !r.governing.empty(); }))
        columns.push_back({{"mean_slip_flexible_mm", "flexible block", "mm", 5}, mean(&Row::governing)});
    return table_of<Row>(
        "Mean of both polarities", columns, rows,
        {"slip at the end, positive downstream; the rigid block, and the flexible one's governing analysis. "
         "A verdict rests on the larger of both, not on their mean."});
}

Table elastic_table(const Screening& s, const std::optional<double>& allowable)
{
    const RunColumns c(allowable);
    Table t = table_of<ContactRun>("Elastic dam, reduced finite elements",
                                   {record_of_run,
                                    polarity_of_run,
                                    c.status,
                                    {c.slip_in_words.column, c.slip.value},
                                    c.total_error,
                                    c.error_parts,
                                    c.max_slip,
                                    c.rigid_slip,
                                    c.dt,
                                    c.verdict},
                                   s.elastic->runs);
    t.notes = {"slip: area mean over the base since the static state, positive downstream; ± total: what steps and modes "
               "left out leave open (estimate), nothing of the mesh, which  damslip fe  adds."};
    if (!s.elastic->why_not.empty()) t.notes.push_back(s.elastic->why_not);
    return t;
}

Table slip_table(const Screening& s, const std::optional<double>& allowable)
{
    using R = SlipRow;
    const bool wedge = s.bases.front().model.wedge.has_value();
    const double a_y = s.bases.front().model.downstream.law.constant;
    const auto with_vertical = [](const R& r) {
        return r.with_vertical ? slip_cell(*r.with_vertical, r.with_vertical->slip / mm) : Cell();
    };
    std::vector<ColumnOf<R>> columns{
        {in_brief({"record", "record"}), &R::record},
        {in_brief({"polarity", "polarity"}), &R::polarity},
        {{"pga_m_s2", "PGA", "m/s²", 4}, &R::pga},
        {{"yield_over_pga", "a_y/PGA", "–", 4},
         [=](const R& r) { return r.pga > 0 ? finite_cell(a_y / r.pga) : Cell(); }},
        {in_brief({"slip_h_mm", "slip h", "mm", 5}),
         [](const R& r) { return slip_cell(r.horizontal, r.horizontal.slip / mm); }},
        {in_brief({"slip_hv_mm", "slip h+v", "mm", 5}), with_vertical},
        {ranking({"max_slip_m", "largest slip", "m", 5}),
         [](const R& r) { return slip_cell(r.rigid(), r.rigid().max_slip); }},
        {{"upstream_slip_mm", "upstream", "mm", 4},
         [](const R& r) { return slip_cell(r.rigid(), r.rigid().upstream_slip / mm); }},
        {{"lift_offs", "lift-offs"}, [](const R& r) { return r.rigid().lift_offs; }},
        {in_brief({"status", "status"}), [](const R& r) { return word(r.rigid().status); }},
        {in_brief({"verdict", "verdict"}), [&](const R& r) { return rigid_verdict_cell(r, allowable); }}};
    const sliding::SlipStages& stages = s.bases.front().model.stages;
    if (!stages.empty() && stages.front().restitution > 0.0) {
        const std::vector<ColumnOf<R>> rebounds{
            {{"landings", "impacts"}, [](const R& r) { return r.rigid().landings; }},
            {{"impact_J_m", "lost in impacts", "J/m", 4}, [](const R& r) { return r.rigid().impact_loss; }}};
        columns.insert(columns.end() - 2, rebounds.begin(), rebounds.end());
    }
    Table t = table_of<R>(wedge ? "Displacement of the wedge" : "Rigid-block displacement", columns, s.slips);
    if (wedge)
        t.notes.push_back("slip: along the way of sliding at the yield, " +
                          direction_words(s.bases.front().model.wedge->yields.at_rest.state.direction) +
                          "; one way, nothing upstream; with the vertical component where the record has one.");
    else
        t.notes.push_back("slip: at the end, positive downstream; largest slip, status and verdict: with the vertical "
                          "component where the record has one.");
    note_static_sliding(s, t);
    note_verdict(s, allowable, t);
    note_premises(s, allowable, t);
    return t;
}

Table screened_anchor_table(const Screening& s)
{
    std::vector<AnchorRow> rows;
    for (const SlipRow& row : s.slips)
        for (const AnchorOutcome& anchor : row.rigid().anchors) rows.push_back({row.record, row.polarity, anchor});
    return anchor_run_table(rows);
}

Table event_table(const Screening& s)
{
    std::vector<EventRow> rows;
    for (const SlipRow& row : s.slips)
        for (const EventSlip& event : row.rigid().events) rows.push_back({row.record, row.polarity, event});
    return event_run_table(rows, {},
                           "slip: positive downstream, the run to rest after each event included; with the vertical "
                           "component where the records have one.");
}

Table flexible_table(const Screening& s, const std::optional<double>& allowable)
{
    using R = SlipRow;
    const sliding::FlexibleBlock& flexible = *s.flexible;
    const auto largest = [](auto FlexibleSlips::*analysis) {
        return [=](const R& r) {
            const auto& found = (*r.flexible).*analysis;
            return found ? slip_cell(found->slide, found->slide.max_slip / mm) : Cell();
        };
    };
    const auto over_pga = [](auto FlexibleSlips::*analysis) {
        return [=](const R& r) {
            const auto& found = (*r.flexible).*analysis;
            return found && r.pga > 0 ? Cell(found->peak_acceleration / r.pga) : Cell();
        };
    };
    const auto at_end = [](const R& r) {
        const auto& coupled = r.flexible->coupled;
        return coupled ? slip_cell(coupled->slide, coupled->slide.slip / mm) : Cell();
    };
    std::vector<ColumnOf<R>> columns{
        {{"record", "record"}, &R::record},
        {{"polarity", "polarity"}, &R::polarity},
        {{"rigid_max_slip_mm", "rigid", "mm", 5},
         [](const R& r) { return slip_cell(r.rigid(), r.rigid().max_slip / mm); }},
        {{"decoupled_max_slip_mm", "decoupled", "mm", 5}, largest(&FlexibleSlips::decoupled)},
        {{"coupled_max_slip_mm", "coupled", "mm", 5}, largest(&FlexibleSlips::coupled)},
        {{"amplification_decoupled", "peak average/PGA decoupled", "–", 4}, over_pga(&FlexibleSlips::decoupled)},
        {{"amplification_coupled", "peak average/PGA coupled", "–", 4}, over_pga(&FlexibleSlips::coupled)},
        {{"coupled_slip_mm", "coupled, at the end", "mm", 5}, at_end},
        {{"judged_by", "judged by"}, [](const R& r) { return r.governing().method; }},
        {{"status", "status"}, [](const R& r) { return word(r.judged().status); }},
        {{"verdict", "verdict"}, [&](const R& r) { return verdict_cell(judge(r, allowable)); }}};
    const auto of_column = [](auto value) {
        return [=](const R& r) { return r.flexible->column ? Cell(value(*r.flexible->column)) : Cell(); };
    };
    using C = sliding::StrainCompatible;
    const bool is_column = std::ranges::any_of(s.slips, [](const R& r) { return r.flexible && r.flexible->column; });
    if (is_column) {
        const std::vector<ColumnOf<R>> more{
            {{"column_velocity_m_s", "V_s", "m/s", 4}, of_column([](const C& c) { return c.velocity; })},
            {{"column_strain", "strain", "%", 3}, of_column([](const C& c) { return 100.0 * c.strain; })},
            {{"column_period_s", "T_s", "s", 4}, of_column([](const C& c) { return c.block.period; })},
            {{"column_damping", "damping", "%", 3},
             of_column([](const C& c) { return 100.0 * c.block.damping_ratio; })}};
        columns.insert(columns.begin() + 2, more.begin(), more.end());
    }
    Table t = table_of<R>("Displacement of the flexible block", columns,
                          s.slips | std::views::filter([](const R& r) { return r.flexible.has_value(); }));
    if (is_column)
        t.notes.push_back(
            "V_s, T_s, damping: of the column under this record, radiation into the rock included; strain: effective, "
            "0.65 of the largest. The mode below is that at small strain.");
    t.notes.push_back(fmt::format(
        "one mode: period {:.4g} s, damping {:.3g} %, mass ratio {:.3g} ({}); largest slips. Average: the horizontal "
        "acceleration over the mass. Decoupled can be more or less than coupled.",
        flexible.period, 100.0 * flexible.damping_ratio, flexible.mass_ratio, s.mass_ratio_words));
    if (flexible.period >= long_period)
        t.notes.push_back(
            fmt::format("a period this long: one mode says little. What it leaves, {:.3g} of the mass, moves "
                        "with the ground as if rigid and drives the base, where a real mass is soft too.",
                        1.0 - flexible.mass_ratio));
    if (allowable)
        t.notes.push_back(fmt::format("verdict: largest slip of the analysis in \"judged by\" against "
                                      "criteria.allowable_slip = {:.4g} mm; the rigid slip has none of its own.",
                                      *allowable / mm));
    note_premises(s, allowable, t);
    return t;
}

Table rocking_table(const Screening& s, const std::optional<double>& allowable)
{
    using R = SlipRow;
    const double length = s.bases.front().model.length.value_or(0.0);
    const auto slide = [](const R& r) -> const sliding::SlideResult& { return r.rocking->slide; };
    const auto opening = [=](const R& r, double rotation) {
        return optional_cell(reported(slide(r).status, length * std::sin(rotation) / mm));
    };
    const auto lost = [](double work) { return Cell(work / 1e3); };
    Table t = table_of<R>(
        "Displacement of the block that rocks and slides",
        {{{"record", "record"}, &R::record},
         {{"polarity", "polarity"}, &R::polarity},
         {{"slip_mm", "slip", "mm", 5}, [=](const R& r) { return slip_cell(slide(r), slide(r).slip / mm); }},
         {{"max_slip_mm", "largest slip", "mm", 5},
          [=](const R& r) { return slip_cell(slide(r), slide(r).max_slip / mm); }},
         {{"heel_opening_mm", "heel opens", "mm", 4},
          [=](const R& r) { return opening(r, r.rocking->max_toe_rotation); }},
         {{"toe_opening_mm", "toe opens", "mm", 4},
          [=](const R& r) { return opening(r, r.rocking->max_heel_rotation); }},
         {{"landings", "impacts"}, [](const R& r) { return r.rocking->landings; }},
         {{"friction_work_kJ_m", "friction", "kJ/m", 4}, [=](const R& r) { return lost(r.rocking->energy.friction); }},
         {{"landing_loss_kJ_m", "impact loss", "kJ/m", 4},
          [=](const R& r) { return lost(r.rocking->energy.landings); }},
         {{"energy_imbalance", "energy imbalance", "–", 1}, [](const R& r) { return r.rocking->energy.imbalance; }},
         {{"status", "status"}, [=](const R& r) { return word(slide(r).status); }},
         {{"verdict", "verdict"}, [&, slide](const R& r) { return verdict_cell(judge(slide(r), allowable)); }}},
        s.slips | std::views::filter([](const R& r) { return r.rocking.has_value(); }));
    t.notes.push_back("free to stand on toe or heel, with the vertical component where the record has one; slip of the "
                      "corner that stands, largest rise of heel and toe (docs/rocking.md).");
    if (allowable)
        t.notes.push_back("verdict: of the slip alone; a base that opens may pass water, whatever the slip.");
    t.notes.push_back(
        "energy imbalance: what ground and loads put in less kinetic energy, friction and impacts, over the "
        "largest of them.");
    return t;
}

Table bond_table(const Screening& s, const std::optional<double>& allowable)
{
    using R = SlipRow;
    Table t = table_of<R>(
        "Displacement without the bond (c = 0)",
        {{{"record", "record"}, &R::record},
         {{"polarity", "polarity"}, &R::polarity},
         {{"judged_by", "judged by"}, [](const R& r) { return r.governing().method; }},
         {{"slip_mm", "slip", "mm", 5}, [](const R& r) { return slip_cell(r.judged(), r.judged().slip / mm); }},
         {{"max_slip_mm", "largest slip", "mm", 5},
          [](const R& r) { return slip_cell(r.judged(), r.judged().max_slip / mm); }},
         {{"status", "status"}, [](const R& r) { return word(r.judged().status); }},
         {{"verdict", "verdict"}, [&](const R& r) { return verdict_cell(r, allowable); }}},
        s.slips_without_bond);
    t.notes.push_back(fmt::format("the bond is {:.0f} % of the resistance before the earthquake; from a third on (a "
                                  "judgement) the slip is judged without it, too.",
                                  100.0 * s.bond_share));
    return t;
}

namespace {

using RegressionColumn = ColumnOf<RegressionRow>;

const RegressionColumn record_column{{"record", "record"}, &RegressionRow::record},
    model_column{in_brief({"model", "regression"}), &RegressionRow::model},
    slip_column{ranking({"slip_mm", "slip", "mm", 4}), &RegressionRow::median, mm},
    low_column{in_brief({"slip_minus_sigma_mm", "16 %", "mm", 4}), &RegressionRow::low, mm},
    high_column{in_brief({"slip_plus_sigma_mm", "84 %", "mm", 4}), &RegressionRow::high, mm},
    zero_column{{"zero_probability", "P(D = 0)", "–", 3}, &RegressionRow::zero_probability},
    remark_column{in_brief({"remark", "remark"}), &RegressionRow::remark};

} // namespace

Table needed_table(const std::vector<NeededRow>& rows, const Scene& scene)
{
    using R = NeededRow;
    const auto in_g = [](double a) { return a / units::standard_gravity; };
    const double allowable = scene.criteria.allowable_slip.value_or(0.0);
    Table t = table_of<R>(
        fmt::format("Needed for a slip of {:.4g} mm at most", allowable / mm),
        {{{"record", "record"}, &R::record},
         {{"polarity", "polarity"}, &R::polarity},
         {{"k_max", "k_max", "g", 4}, [=](const R& r) { return in_g(r.peak); }},
         {{"k_max_time_s", "at", "s", 4}, &R::peak_time},
         {{"k_allowable", "k(d*)", "g", 4}, [=](const R& r) { return r.yield ? Cell(in_g(*r.yield)) : Cell(); }},
         {{"k_allowable_over_k_max", "k(d*)/k_max", "–", 3},
          [](const R& r) { return r.yield && r.peak > 0.0 ? Cell(*r.yield / r.peak) : Cell(); }},
         {{"friction", "friction", "–", 4}, &R::friction},
         {{"friction_over_given", "over the scene's", "–", 3},
          [&](const R& r) {
              const double given = scene.contact.friction;
              return r.friction && given > 0.0 ? Cell(*r.friction / given) : Cell();
          }}},
        rows);
    t.notes.push_back(
        "k_max: largest acceleration that drives it downstream. k(d*): seismic coefficient for this slip, the yield of "
        "a "
        "block that slides one way under the horizontal record; – : even a block without resistance slips less.");
    t.notes.push_back(fmt::format("friction: least μ from which on the rigid block's largest slip is no more, with the "
                                  "vertical component where there is one; – : above {:.2g}.",
                                  highest_friction));
    return t;
}

Table regression_table(const std::vector<RegressionRow>& rows)
{
    using R = RegressionRow;
    return table_of<R>(regressions_title,
                       {record_column,
                        {{"id", "id"}, &R::id},
                        model_column,
                        slip_column,
                        low_column,
                        high_column,
                        zero_column,
                        {{"nonzero_slip_mm", "slip where D > 0", "mm", 4}, &R::nonzero_median, mm},
                        {{"status", "status"}, &R::status},
                        {{"weight", "weight", "–", 3}, &R::weight},
                        remark_column},
                       rows);
}

Table regression_summary(const std::vector<RegressionRow>& all)
{
    std::vector<RegressionRow> rows;
    std::vector<std::string> notes;
    for (const RegressionRow& row : all) {
        const bool weighted = row.id == weighted_median_id;
        if (weighted || row.status == "valid") rows.push_back(row);
        if (std::string line = weighted ? folded_line(all, row.record) : ""; !line.empty())
            notes.push_back(std::move(line));
    }
    std::vector<RegressionColumn> columns{record_column, model_column, slip_column, low_column, high_column};
    if (std::ranges::any_of(all, [](const RegressionRow& row) { return row.valid && row.zero_probability; }))
        columns.push_back(zero_column);
    columns.push_back(remark_column);
    return table_of(regressions_title, columns, rows, std::move(notes));
}

namespace {

Cell name_cell(const std::string& name)
{
    return name.empty() ? Cell() : Cell(name);
}

void note_lower_bounds(const Screening& s, Table& table)
{
    for (const SetStatistics& q : s.statistics)
        if (!q.lower_bounds.empty())
            table.notes.push_back(fmt::format("{}: {} of the {} slips are lower bounds ({}).", q.quantity,
                                              q.lower_bounds.all(), q.n, q.lower_bounds.words()));
}

} // namespace

Table statistics_table(const Screening& s)
{
    using Q = SetStatistics;
    Table t = table_of<Q>(
        "Over the records (largest slip, worse polarity of each)",
        {{{"quantity", "method"}, &Q::quantity},
         {{"n", "n"}, &Q::n},
         {{"median_mm", "median", "mm", 4}, [](const Q& q) { return finite_cell(q.median, mm); }},
         {{"percentile_16_mm", "16 %", "mm", 4}, [](const Q& q) { return finite_cell(q.percentile_16, mm); }},
         {{"percentile_84_mm", "84 %", "mm", 4}, [](const Q& q) { return finite_cell(q.percentile_84, mm); }},
         {{"mean_mm", "mean", "mm", 4}, [](const Q& q) { return finite_cell(q.mean, mm); }},
         {{"largest_mm", "largest", "mm", 4}, [](const Q& q) { return finite_cell(q.largest, mm); }},
         {{"share_above_allowable_percent", "above allowable", "%", 3},
          [](const Q& q) { return q.share_above_allowable ? Cell(100 * *q.share_above_allowable) : Cell(); }},
         {{"controlling_record", "controlling record"}, [](const Q& q) { return name_cell(q.controlling_record); }},
         {{"without_slip", "without a slip"}, [](const Q& q) { return name_cell(q.without_slip.words()); }}},
        s.statistics);
    note_lower_bounds(s, t);
    note_static_sliding(s, t);
    return t;
}

namespace {

Cell slip_or_none(const GivenYieldRow& row, double slip)
{
    return optional_cell(reported(row.status(), slip / units::mm));
}

struct CoefficientRow {
    std::string id, model;
    std::optional<double> coefficient;
};

} // namespace

Table given_yield_table(const GivenYieldBlock& block, const std::vector<GivenYieldRow>& rows)
{
    using R = GivenYieldRow;
    std::vector<ColumnOf<R>> columns{
        {in_brief({"yield_g", "a_y", "g", 5}), &R::yield, standard_gravity},
        {in_brief({"record", "record"}), &R::record},
        {in_brief({"method", "method"}), &R::method},
        {{"pga_g", "PGA", "g", 4}, &R::pga, standard_gravity},
        {in_brief({"yield_over_pga", "a_y/PGA", "–", 4}),
         [](const R& r) { return r.pga > 0 ? finite_cell(r.yield / r.pga) : Cell(); }},
        {ranking({"slip_mm", "slip", "mm", 5}), [](const R& r) { return slip_or_none(r, r.normal.max_slip); }},
        {in_brief({"slip_inverse_mm", "slip, record flipped", "mm", 5}),
         [](const R& r) { return slip_or_none(r, r.inverse.max_slip); }},
        {in_brief({"slip_mean_mm", "mean of both", "mm", 5}),
         [](const R& r) { return slip_or_none(r, r.mean_slip()); }},
        {{"largest_acceleration_g", "largest acceleration", "g", 4}, &R::largest_acceleration, standard_gravity},
        {in_brief({"status", "status"}), [](const R& r) { return word(r.status()); }}};
    if (block.flexible) {
        const auto period = [](const R& r) { return r.mode ? Cell(r.mode->period) : Cell(); };
        const auto damping = [](const R& r) { return r.mode ? Cell(100.0 * r.mode->damping_ratio) : Cell(); };
        columns.insert(columns.end() - 1,
                       {{{"period_s", "period", "s", 4}, period}, {{"damping_percent", "damping", "%", 4}, damping}});
    }
    Table table = table_of<R>("Slip on a given yield acceleration", columns, rows);
    table.notes.push_back(
        fmt::format("{}{}.", block.yield.size() > 1 ? "a_y: at rest, then as the table over the slip; " : "",
                    block.two_way ? "the block slides both ways, slip: the largest on the way" : "one way, downhill"));
    table.notes.push_back("horizontal component alone; the largest acceleration is the mass's own on average.");
    return table;
}

Table allowable_coefficient_table(const sliding::RegressionInputs& inputs, double allowable)
{
    std::vector<CoefficientRow> rows;
    for (const sliding::Regression& r : sliding::regressions())
        if (const std::optional<double> k = yield_coefficient_for(r, inputs, allowable))
            rows.push_back({std::string(r.id), std::string(r.name), k});
    using R = CoefficientRow;
    Table table = table_of<R>(fmt::format("Yield coefficient for a median slip of {:.4g} mm", allowable / units::mm),
                              {{in_brief({"id", "id"}), &R::id},
                               {in_brief({"model", "regression"}), &R::model},
                               {in_brief({"k_allowable", "k(d*)", "g", 4}), &R::coefficient},
                               {in_brief({"k_allowable_over_pga", "k(d*)/PGA", "–", 3}),
                                [&](const R& r) { return optional_cell(r.coefficient, inputs.pga_g); }}},
                              rows);
    table.notes.push_back(
        "regressions whose inputs are given; those that slip less even at the smallest yield of their data "
        "are left out. Half of the slips are larger than the median.");
    return table;
}

} // namespace damslip::pages
