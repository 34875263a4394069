#include "analysis/assess/assess.hpp"
#include "core/units.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip {

namespace {

MotionOutcome level_of(SlipLevel level, const MotionName& motion, const std::string& how, Status status, double max_slip,
                       double error)
{
    MotionOutcome out{motion, how, level, status};
    out.largest_slip = reported(status, max_slip);
    if (out.largest_slip && std::isfinite(error)) {
        out.low = std::max(0.0, *out.largest_slip - error);
        out.high = *out.largest_slip + error;
    }
    return out;
}

void add_regressions(const Screening& s, const std::string& record, std::vector<MotionOutcome>& levels)
{
    for (const RegressionRow& row : s.regressions)
        if (row.record == record && row.id == weighted_median_id && row.median) {
            MotionOutcome& out = levels.emplace_back(level_of(SlipLevel::regressions, {record, 0},
                                                              "weighted median, 16 to 84 %", Status::at_rest, *row.median, std::nan("")));
            out.low = row.low;
            out.high = row.high;
        }
}

/// The rigid block as it is judged: sliding, or rocking and sliding where that alone does not hold.
void add_block(const Screening& s, std::size_t number, SlipLevel level, std::vector<MotionOutcome>& levels)
{
    const SlipRow& row = worse_judged(s, number);
    const GoverningSlip g = row.governing();
    levels.push_back(level_of(level, {row.record, row.polarity}, std::string(g.method), g.slide.status, g.slide.max_slip, g.error));
}

void add_finite_elements(const Assessment& a, const std::string& record, std::vector<MotionOutcome>& levels)
{
    std::vector<ContactRun> own;
    for (const ContactRun& r : a.runs)
        if (r.record == record) own.push_back(r);
    if (own.empty()) return;
    const ContactRun& worst = worst_of(own);
    const SlipError error = slip_error(worst);
    levels.push_back(level_of(SlipLevel::finite_elements, worst, error.parts(), worst.fe.status, std::abs(worst.fe.max_slip), error.total));
}

std::vector<MotionOutcome> levels_of(const Assessment& a)
{
    std::vector<MotionOutcome> levels;
    const std::size_t records = a.screening.slips.size() / 2;
    for (std::size_t i = 0; i < records; ++i) {
        const std::string record = a.screening.slips[2 * i].record;
        add_regressions(a.screening, record, levels);
        add_block(a.screening, i, SlipLevel::rigid_block, levels);
        if (a.flexible) add_block(*a.flexible, i, SlipLevel::flexible_block, levels);
        add_finite_elements(a, record, levels);
    }
    return levels;
}

/// How many times as far, either way; infinite where one does not slide.
double times_apart(double a, double b)
{
    const double low = std::min(std::abs(a), std::abs(b)), high = std::max(std::abs(a), std::abs(b));
    if (high < 1e-6) return 1.0; // neither slides by a micrometre
    return low > 0.0 ? high / low : std::numeric_limits<double>::infinity();
}

/// Do the finite elements, with that changed, come closer to what the level assumes? Uplift and a vertical component are in
/// the blocks, too; regressions have the uplift, by the yield acceleration. A flexible block is not rigid.
bool parts_from(SlipLevel level, const MotionOutcome& run)
{
    if (run.without == Effect::uplift) return false;
    if (run.without == Effect::vertical_motion) return level == SlipLevel::regressions;
    return !(run.what == rigid_dam && level == SlipLevel::flexible_block);
}

/// Of the runs of finite elements that can tell them from a level the one nearest to its slip.
std::optional<MotionOutcome> nearest(const std::vector<MotionOutcome>& runs, SlipLevel level, double slip)
{
    const MotionOutcome* best = nullptr;
    for (const MotionOutcome& run : runs)
        if (run.largest_slip && parts_from(level, run) &&
            (!best || std::abs(*run.largest_slip - slip) < std::abs(*best->largest_slip - slip)))
            best = &run;
    return best ? std::optional(*best) : std::nullopt;
}

/// Of the record of the recommended value: every other level against the finite elements.
std::vector<Disagreement> disagreements_of(const Assessment& a)
{
    std::vector<Disagreement> list;
    if (!a.recommended || a.recommended->level != SlipLevel::finite_elements) return list;
    const double full = a.recommended->slip;
    const auto of_fe = std::find_if(a.levels.begin(), a.levels.end(), [&](const MotionOutcome& l) {
        return l.level == SlipLevel::finite_elements && l.record == a.recommended->record;
    });
    for (const MotionOutcome& other : a.levels) {
        if (other.record != a.recommended->record || other.level == SlipLevel::finite_elements || !other.largest_slip) continue;
        const double slip = *other.largest_slip;
        if (times_apart(slip, full) <= disagreement_factor) continue;
        Disagreement d{slip < full ? other : *of_fe, slip < full ? *of_fe : other, nearest(a.assumptions, other.level, slip), false};
        if (d.closest) {
            const double closest = *d.closest->largest_slip;
            d.explains = times_apart(closest, slip) < times_apart(closest, full) && std::abs(closest - slip) < std::abs(full - slip);
        }
        list.push_back(std::move(d));
    }
    return list;
}

/// The worst run with its numerical error, the other polarity and the other water.
std::optional<Recommendation> by_finite_elements(const Assessment& a)
{
    if (a.runs.empty() || !all_answered(a.runs)) return std::nullopt;
    const ContactRun& worst = worst_of(a.runs);
    const std::optional<double> slip = reported(worst.fe.status, std::abs(worst.fe.max_slip));
    if (!slip || status_row(worst.fe.status).slip != SlipMeaning::final) return std::nullopt;
    const SlipError error = slip_error(worst);
    Recommendation r{
        SlipLevel::finite_elements, worst.record, worst.polarity, *slip, *slip, *slip, std::isfinite(error.total), ""};
    if (r.error_known) {
        r.low = std::max(0.0, *slip - error.total);
        r.high = *slip + error.total;
        r.from = "numerical error (" + error.parts() + ")";
    } else {
        r.from = "models alone, the numerical error is not known";
        for (const ContactRun& run : a.runs) { // the other polarity's may be
            const SlipError other = slip_error(run);
            if (run.record != worst.record || !has_slip(run) || !std::isfinite(other.total)) continue;
            r.low = std::min(r.low, std::max(0.0, std::abs(run.fe.max_slip) - other.total));
            r.high = std::max(r.high, std::abs(run.fe.max_slip) + other.total);
            r.from = "the other polarity with its numerical error; that of this run is not known";
        }
    }
    for (const MotionOutcome& choice : a.spread.runs) {
        // Massless rock is no other opinion of the same rock: it keeps every wave. It is shown, not counted.
        if (choice.what == "massless rock" || !choice.largest_slip) continue;
        r.low = std::min(r.low, *choice.largest_slip);
        r.high = std::max(r.high, *choice.largest_slip);
        r.from += ", " + choice.what;
    }
    return r;
}

/// Without finite elements the flexible block, without that the rigid one.
std::optional<Recommendation> by_blocks(const Assessment& a)
{
    for (const SlipLevel level : {SlipLevel::flexible_block, SlipLevel::rigid_block}) {
        const MotionOutcome* worst = nullptr;
        bool all = true;
        for (const MotionOutcome& l : a.levels) {
            if (l.level != level) continue;
            all = all && l.largest_slip && status_row(l.status).slip == SlipMeaning::final;
            if (l.largest_slip && (!worst || *l.largest_slip > *worst->largest_slip)) worst = &l;
        }
        if (!worst || !all) continue;
        const double slip = *worst->largest_slip;
        Recommendation r{level, worst->record, worst->polarity, slip, slip, slip, false,
                         "this level and the regressions' 16 to 84 %"};
        for (const MotionOutcome& l : a.levels) {
            if (l.record != worst->record || l.level == SlipLevel::finite_elements) continue;
            r.low = std::min({r.low, l.largest_slip.value_or(r.low), l.low.value_or(r.low)});
            r.high = std::max({r.high, l.largest_slip.value_or(r.high), l.high.value_or(r.high)});
        }
        return r;
    }
    return std::nullopt;
}

/// All records, each in both polarities where both are run.
bool all_records_ran(const Assessment& a)
{
    if (!a.fe || a.fe->records().empty()) return false;
    for (const RecordPair& pair : a.fe->records()) {
        std::ptrdiff_t runs = 0, wanted = 1;
        for (const ContactRun& r : a.runs)
            if (r.record == pair.files.name) ++runs, wanted = r.both ? 2 : 1;
        if (runs < wanted) return false;
    }
    return true;
}

void judge_slip(Assessment& a)
{
    using units::mm;
    const std::optional<double>& allowable = a.ready.given.criteria.allowable_slip;
    if (a.interrupted) {
        a.verdict_reason = "Interrupted: no slip is recommended.";
        return;
    }
    if (!a.recommended) {
        a.verdict = a.runs.empty() ? Verdict::none : verdict_of(a.runs, allowable);
        a.verdict_reason = a.runs.empty() ? "No level has a slip to judge."
                           : all_answered(a.runs)
                               ? fmt::format("Finite elements: {}.", word(worst_of(a.runs).fe.status))
                               : "Finite elements without an answer: " + unanswered_words(a.runs) + ".";
        return;
    }
    const Recommendation& r = *a.recommended;
    if (!allowable) {
        a.verdict_reason = "No allowable slip is given (criteria.allowable_slip_mm).";
        return;
    }
    const std::string range = fmt::format("{:.4g} to {:.4g} mm", r.low / mm, r.high / mm);
    a.verdict = r.low > *allowable ? Verdict::fail : r.high > *allowable ? Verdict::undecided : Verdict::pass;
    a.verdict_reason = fmt::format("The range {} lies {} the allowable {:.4g} mm.", range,
                                   a.verdict == Verdict::fail   ? "above"
                                   : a.verdict == Verdict::pass ? "below"
                                                                : "across",
                                   *allowable / mm);
    if (r.level != SlipLevel::finite_elements && a.verdict == Verdict::pass) {
        a.verdict = Verdict::undecided;
        a.verdict_reason += " But no finite elements ran, and a block is no upper bound.";
        return;
    }
    if (r.level == SlipLevel::finite_elements) {
        const Verdict own = verdict_of(a.runs, allowable);
        if (own == Verdict::fail && a.verdict != Verdict::fail) {
            a.verdict = own;
            const SlipError error = slip_error(worst_of(a.runs));
            a.verdict_reason =
                r.slip - error.total > *allowable
                    ? fmt::format(
                          "The worst run's {:.4g} mm, less its numerical error, lie above the allowable {:.4g} mm.",
                          r.slip / mm, *allowable / mm)
                    : "A lift joint, or the state after the earthquake, fails in the finite elements.";
        } else if (own != Verdict::pass && a.verdict == Verdict::pass) {
            a.verdict = Verdict::undecided;
            a.verdict_reason += " But not every run of the finite elements can be judged.";
        } else if (a.verdict == Verdict::pass && !all_records_ran(a)) {
            a.verdict = Verdict::undecided;
            a.verdict_reason += " But not every record and polarity was run by finite elements.";
        }
    }
}

} // namespace

const ContactRun& governing_run(const Assessment& a)
{
    return worst_of(a.runs);
}

void judge_assessment(Assessment& a)
{
    a.levels = levels_of(a);
    a.recommended.reset();
    if (!a.interrupted) a.recommended = a.runs.empty() ? by_blocks(a) : by_finite_elements(a);
    a.disagreements = disagreements_of(a);
    const RigidModel& model = a.screening.bases.front().model;
    if (model.state != sliding::StaticState::at_rest) {
        a.slip_verdict = a.verdict = Verdict::fail;
        a.verdict_reason = "The dam does not stand without any earthquake: " + model.why_it_fails() + ".";
        return;
    }
    judge_slip(a);
    a.slip_verdict = a.verdict;
    const Verdict of_planes = judge(a.screening.planes, a.ready.scene);
    const bool check_fails = std::ranges::any_of(a.screening.combinations, [](const sliding::Equilibrium& e) {
        return std::ranges::any_of(e.checks, [](const sliding::Check& c) { return c.verdict == sliding::Verdict::fail; });
    });
    if (check_fails || of_planes == Verdict::fail) a.verdict = Verdict::fail;
    if (of_planes == Verdict::undecided && a.verdict == Verdict::pass) a.verdict = Verdict::undecided;
}

int exit_code_of(const Assessment& a)
{
    if (a.interrupted || !all_answered(a.runs)) return exit_no_answer;
    return a.recommended || a.verdict == Verdict::fail ? exit_ok : exit_no_answer;
}

} // namespace damslip
