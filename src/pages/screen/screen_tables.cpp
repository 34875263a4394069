#include "pages/screen/screen_tables.hpp"

#include "core/units.hpp"
#include "pages/screen/wedge_tables.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace damslip::pages {

namespace {

using units::mm;
using units::standard_gravity;

constexpr double long_period =
    2.0; ///< T_s from which one mode says little under common motions [s] (docs/neighbours.md)

Cell cell(const std::optional<double>& value, double unit = 1.0)
{
    return value ? Cell(*value / unit) : Cell();
}

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

/// @param slip  one of the slide's slips, in the unit of its column
Cell slip_cell(const sliding::SlideResult& r, double slip)
{
    return cell(reported(r.status, slip));
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
    if (row.flexible) return fmt::format("judged by {}", row.governing().method);
    return verdict_cell(judge(row, allowable));
}

/// What no PASS may rest on, and what a PASS rests on.
void note_premises(const Screening& s, const std::optional<double>& allowable, Table& table)
{
    if (allowable && s.dry_base)
        table.notes.push_back("verdict: of a base taken as dry although there is water on the dam.");
    for (const std::string& premise : broken_premises(s)) table.notes.push_back("no PASS: the dam " + premise + ".");
}

/// What a verdict says, and what it cannot say.
void note_verdict(const Screening& s, const std::optional<double>& allowable, Table& table)
{
    if (!allowable || s.flexible) return;
    table.notes.push_back(
        fmt::format("verdict: largest slip against criteria.allowable_slip = {:.4g} mm.", *allowable / mm));
    if (std::any_of(s.slips.begin(), s.slips.end(),
                    [](const SlipRow& row) { return std::isnan(row.governing().error); }))
        table.notes.push_back("undecided: the error of SLAMMER's scheme is not known; --scheme exact has none.");
}

constexpr std::string_view regressions_title =
    "Empirical regressions (horizontal component, no uplift or water beyond a_y)";

/// What gives no answer of its own for a record, by reason: "El Centro: outside its range, not weighted: jibson-1993
/// 707.7 mm, ...; no slip expected: 8; needs magnitude: 7." Empty: nothing.
std::string folded_line(const Screening& s, const std::string& record)
{
    std::vector<std::string> reasons;
    std::map<std::string, std::size_t> count;
    std::string outside;
    for (const RegressionRow& row : s.regressions) {
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
    Table t;
    t.title = "Yield acceleration";
    t.columns = {{"base", "base", "", 4},
                 {"friction", "μ", "–", 4},
                 {"uplift_kN_m", "uplift U", "kN/m", 6},
                 {"yield_acceleration_m_s2", "a_y downstream", "m/s²", 6},
                 {"yield_coefficient_g", "a_y downstream", "g", 6},
                 {"yield_acceleration_upstream_m_s2", "a_y upstream", "m/s²", 6},
                 {"tips_m_s2", "a tips", "m/s²", 4},
                 {"tips_g", "a tips", "g", 4},
                 {"opens_m_s2", "a opens base", "m/s²", 4},
                 {"opens_g", "a opens base", "g", 4},
                 {"critical_friction", "critical μ", "–", 6},
                 {"state", "without earthquake", "", 4}};
    for (const BaseRow& row : s.bases) {
        const RigidModel& m = row.model;
        t.rows.push_back({row.base, m.block.friction, m.block.uplift / 1e3, m.downstream.law.constant,
                          m.downstream.law.constant / standard_gravity, m.upstream.law.constant, row.limits.tips,
                          row.limits.tips / standard_gravity, row.limits.opens, row.limits.opens / standard_gravity,
                          m.critical_friction, state_word(row)});
    }
    t.notes.push_back("a_y: ground acceleration at which it starts to slide; critical μ: friction that just holds "
                      "it without an earthquake.");
    t.notes.push_back(
        "a tips: constant ground acceleration at which the dam tips about its toe, uplift unchanged; a opens "
        "base: at which its joint is open from heel to toe (by uplift.crack) and its bond lost.");
    return t;
}

Table slip_table(const Screening& s, const std::optional<double>& allowable)
{
    Table t;
    const bool wedge = s.bases.front().model.wedge.has_value();
    t.title = wedge ? "Displacement of the wedge" : "Rigid-block displacement";
    t.columns = {{"record", "record", "", 4},
                 {"polarity", "polarity", "", 4},
                 {"pga_m_s2", "PGA", "m/s²", 4},
                 {"yield_over_pga", "a_y/PGA", "–", 4},
                 {"slip_h_mm", "slip h", "mm", 5},
                 {"slip_hv_mm", "slip h+v", "mm", 5},
                 {"max_slip_m", "largest slip", "m", 5},
                 {"upstream_slip_mm", "upstream", "mm", 4},
                 {"lift_offs", "lift-offs", "", 4},
                 {"status", "status", "", 4},
                 {"verdict", "verdict", "", 4}};
    const double a_y = s.bases.front().model.downstream.law.constant;
    for (const SlipRow& row : s.slips) {
        const sliding::SlideResult& r = row.rigid();
        t.rows.push_back({row.record, static_cast<std::int64_t>(row.polarity), row.pga,
                          row.pga > 0 ? finite_cell(a_y / row.pga) : Cell(),
                          slip_cell(row.horizontal, row.horizontal.slip / mm),
                          row.with_vertical ? slip_cell(*row.with_vertical, row.with_vertical->slip / mm) : Cell(),
                          slip_cell(r, r.max_slip), slip_cell(r, r.upstream_slip / mm),
                          static_cast<std::int64_t>(r.lift_offs), word(r.status), rigid_verdict_cell(row, allowable)});
    }
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

Table flexible_table(const Screening& s, const std::optional<double>& allowable)
{
    const sliding::FlexibleBlock& flexible = *s.flexible;
    Table t;
    t.title = "Displacement of the flexible block";
    t.columns = {{"record", "record", "", 4},
                 {"polarity", "polarity", "", 4},
                 {"rigid_max_slip_mm", "rigid", "mm", 5},
                 {"decoupled_max_slip_mm", "decoupled", "mm", 5},
                 {"coupled_max_slip_mm", "coupled", "mm", 5},
                 {"amplification_decoupled", "peak average/PGA decoupled", "–", 4},
                 {"amplification_coupled", "peak average/PGA coupled", "–", 4},
                 {"coupled_slip_mm", "coupled, at the end", "mm", 5},
                 {"judged_by", "judged by", "", 4},
                 {"status", "status", "", 4},
                 {"verdict", "verdict", "", 4}};
    for (const SlipRow& row : s.slips) {
        if (!row.flexible) continue;
        const auto& [decoupled, coupled] = *row.flexible;
        const auto largest = [](const std::optional<sliding::FlexibleSlide>& r) {
            return r ? slip_cell(r->slide, r->slide.max_slip / mm) : Cell();
        };
        const auto over_pga = [&row](const std::optional<sliding::FlexibleSlide>& r) {
            return r && row.pga > 0 ? Cell(r->peak_acceleration / row.pga) : Cell();
        };
        t.rows.push_back(
            {row.record, static_cast<std::int64_t>(row.polarity), slip_cell(row.rigid(), row.rigid().max_slip / mm),
             largest(decoupled), largest(coupled), over_pga(decoupled), over_pga(coupled),
             coupled ? slip_cell(coupled->slide, coupled->slide.slip / mm) : Cell(),
             std::string(row.governing().method), word(row.judged().status), verdict_cell(judge(row, allowable))});
    }
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

Table regression_table(const Screening& s)
{
    Table t;
    t.title = regressions_title;
    t.columns = {{"record", "record", "", 4},
                 {"id", "id", "", 4},
                 {"model", "regression", "", 4},
                 {"slip_mm", "slip", "mm", 4},
                 {"slip_minus_sigma_mm", "16 %", "mm", 4},
                 {"slip_plus_sigma_mm", "84 %", "mm", 4},
                 {"zero_probability", "P(D = 0)", "–", 3},
                 {"nonzero_slip_mm", "slip where D > 0", "mm", 4},
                 {"status", "status", "", 4},
                 {"weight", "weight", "–", 3},
                 {"remark", "remark", "", 4}};
    for (const RegressionRow& row : s.regressions)
        t.rows.push_back({row.record, row.id, row.model, cell(row.median, mm), cell(row.low, mm), cell(row.high, mm),
                          cell(row.zero_probability), cell(row.nonzero_median, mm), row.status, cell(row.weight),
                          row.remark});
    return t;
}

Table regression_summary(const Screening& s)
{
    Table t;
    t.title = regressions_title;
    t.columns = {{"record", "record", "", 4},
                 {"model", "regression", "", 4},
                 {"slip_mm", "slip", "mm", 4},
                 {"slip_minus_sigma_mm", "16 %", "mm", 4},
                 {"slip_plus_sigma_mm", "84 %", "mm", 4}};
    const bool zeros = std::any_of(s.regressions.begin(), s.regressions.end(),
                                   [](const RegressionRow& row) { return row.valid && row.zero_probability; });
    if (zeros) t.columns.push_back({"zero_probability", "P(D = 0)", "–", 3});
    t.columns.push_back({"remark", "remark", "", 4});
    for (const RegressionRow& row : s.regressions) {
        const bool weighted = row.id == weighted_median_id;
        if (!weighted && row.status != "valid") continue;
        t.rows.push_back({row.record, row.model, cell(row.median, mm), cell(row.low, mm), cell(row.high, mm)});
        if (zeros) t.rows.back().push_back(cell(row.zero_probability));
        t.rows.back().push_back(row.remark);
        if (std::string line = weighted ? folded_line(s, row.record) : ""; !line.empty())
            t.notes.push_back(std::move(line));
    }
    return t;
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
    Table t;
    t.title = "Over the records (largest slip, worse polarity of each)";
    t.columns = {{"quantity", "method", "", 4},
                 {"n", "n", "", 4},
                 {"median_mm", "median", "mm", 4},
                 {"percentile_16_mm", "16 %", "mm", 4},
                 {"percentile_84_mm", "84 %", "mm", 4},
                 {"mean_mm", "mean", "mm", 4},
                 {"largest_mm", "largest", "mm", 4},
                 {"share_above_allowable_percent", "above allowable", "%", 3},
                 {"controlling_record", "controlling record", "", 4},
                 {"without_slip", "without a slip", "", 4}};
    for (const SetStatistics& q : s.statistics)
        t.rows.push_back({q.quantity, static_cast<std::int64_t>(q.n), finite_cell(q.median / mm),
                          finite_cell(q.percentile_16 / mm), finite_cell(q.percentile_84 / mm),
                          finite_cell(q.mean / mm), finite_cell(q.largest / mm),
                          q.share_above_allowable ? Cell(100 * *q.share_above_allowable) : Cell(),
                          name_cell(q.controlling_record), name_cell(q.without_slip.words())});
    note_lower_bounds(s, t);
    note_static_sliding(s, t);
    return t;
}

} // namespace damslip::pages
