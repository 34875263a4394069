// What the levels say together, in words. Every number is one of the assessment's.
#include "pages/assess/assess_report.hpp"

#include "analysis/ablation/ablation_rows.hpp"
#include "core/number.hpp"
#include "core/units.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::pages {

namespace {

using units::mm;

std::string millimetres(double slip)
{
    return fmt::format("{:.4g} mm", slip / mm);
}

std::string percent_of(double value, double full)
{
    return full > 0.0 ? fmt::format("{:+.0f} %", 100.0 * (value / full - 1.0)) : "–";
}

const SpectrumDemand* demand_of(const Assessment& a, const std::string& record)
{
    if (!a.spectrum) return nullptr;
    for (const SpectrumDemand& row : a.spectrum->rows)
        if (row.record == record) return &row;
    return nullptr;
}

/// How much the first mode that carries mass amplifies the record.
std::string amplification_sentence(const Assessment& a, const std::string& record)
{
    const SpectrumDemand* row = demand_of(a, record);
    if (!row || row->modes.empty() || row->pga <= 0.0) return "";
    const auto main =
        std::max_element(row->modes.begin(), row->modes.end(),
                         [](const ModeShare& x, const ModeShare& y) { return x.effective_mass < y.effective_mass; });
    return fmt::format("The dam's main mode at {:.3g} Hz ({:.0f} % of the mass) answers with {:.3g} times the PGA of "
                       "{:.3g} m/s²; its base shear by the response spectrum is {:.3g} times that of a rigid dam.",
                       main->frequency, 100.0 * main->effective_mass / a.spectrum->total_mass,
                       main->acceleration / row->pga, row->pga, row->shear / (row->pga * a.spectrum->total_mass));
}

/// The plan's reasons begin with "no " where the scene has no such key.
std::vector<std::string> effects_off(const Assessment& a, bool unnamed)
{
    std::vector<std::string> list;
    const EffectPlan& plan = a.fe ? a.fe->plan : a.screening.plan;
    for (const PlannedEffect& e : plan.effects)
        if (!e.on && e.reason.starts_with("no ") == unnamed) list.push_back(e.name + ": " + e.reason);
    return list;
}

/// The effect whose absence changes the rigid block's slip most, of the records' worst.
std::string rigid_mover(const Assessment& a)
{
    if (!a.rigid_plan || !a.rigid_ablation || a.rigid_ablation->scenes.empty()) return "";
    const std::vector<RecordOutcome>& full = a.rigid_ablation->scenes.front().records;
    std::size_t record = full.size();
    for (std::size_t i = 0; i < full.size(); ++i)
        if (full[i].slip && (record == full.size() || *full[i].slip > *full[record].slip)) record = i;
    if (record == full.size()) return "";
    const std::vector<AblationRow> rows = rows_of(*a.rigid_plan, *a.rigid_ablation, record);
    const AblationRow* most = nullptr;
    for (std::size_t i = 1; i <= a.rigid_plan->removals.size(); ++i)
        if (rows[i].slip.change && (!most || std::abs(*rows[i].slip.change) > std::abs(*most->slip.change)))
            most = &rows[i];
    if (!most || !rows.front().slip.value || *most->slip.change == 0.0) return "";
    return fmt::format("Rigid block: most depends on {}; without it {} in place of {} (record {}).", most->name,
                       millimetres(most->slip.value.value_or(0.0)), millimetres(*rows.front().slip.value),
                       a.ready.records()[record].files.name);
}

} // namespace

std::vector<std::string> governing_sentences(const Assessment& a)
{
    std::vector<std::string> list;
    if (!a.recommended) {
        list.push_back(a.runs.empty() && !a.interrupted ? "No level has a slip for every record."
                               : a.interrupted          ? "Interrupted: nothing is recommended."
                       : !all_answered(a.runs)  ? "The finite elements decide, and not every run has an answer: " +
                                                     unanswered_words(a.runs) + "."
                              : fmt::format("The finite elements decide: {}. {}",
                                                    word(governing_run(a).fe.status), governing_run(a).fe.message));
        return list;
    }
    const Recommendation& r = *a.recommended;
    list.push_back(fmt::format("{} governs: record {}, polarity {:+d}.",
                               r.level == SlipLevel::finite_elements  ? "The finite-element model"
                               : r.level == SlipLevel::flexible_block ? "The flexible block"
                                                                      : "The rigid block",
                               r.record, r.polarity));
    list.push_back(r.level == SlipLevel::finite_elements
                       ? "It alone lets an elastic dam slide, open and rock; the blocks are checks of its order."
                       : "No finite elements ran, so the best block decides; it is no upper bound.");
    if (const std::string s = amplification_sentence(a, r.record); !s.empty()) list.push_back(s);
    list.push_back(fmt::format("Range {:.4g} to {:.4g} mm (a factor of {:.3g}): {}.", r.low / mm, r.high / mm,
                               r.low > 0.0 ? r.high / r.low : 1.0, r.from));
    if (!a.rock_change.empty()) list.push_back(a.rock_change);
    return list;
}

std::vector<std::string> disagreement_sentences(const Assessment& a)
{
    std::vector<std::string> list;
    for (const Disagreement& d : a.disagreements) {
        const double ratio = *d.lower.slip > 0.0 ? *d.higher.slip / *d.lower.slip : 0.0;
        std::string s = fmt::format(
            "{} give{} {}, {} {}{}.", word(d.lower.level),
            d.lower.level == SlipLevel::regressions || d.lower.level == SlipLevel::finite_elements ? "" : "s",
            millimetres(*d.lower.slip), word(d.higher.level), millimetres(*d.higher.slip),
            ratio > 0.0 ? fmt::format(", {:.3g} times as much", ratio) : "");
        s.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(s.front())));
        if (!d.closest)
            s += " Which assumption does it was not run.";
        else if (d.explains)
            s += fmt::format(" The assumption that does it: {}. With it the finite elements give {}.", d.closest->what,
                             millimetres(*d.closest->slip));
        else
            s += fmt::format(" No single assumption that was run does it; the nearest, {}, gives {}.", d.closest->what,
                             millimetres(*d.closest->slip));
        list.push_back(std::move(s));
    }
    return list;
}

std::vector<std::string> mover_sentences(const Assessment& a)
{
    std::vector<std::string> list;
    if (a.recommended && a.recommended->level == SlipLevel::finite_elements) {
        const AssumptionRun* most = nullptr;
        const double full = a.recommended->slip;
        for (const AssumptionRun& run : a.assumptions)
            if (run.slip && (!most || std::abs(*run.slip - full) > std::abs(*most->slip - full))) most = &run;
        if (most)
            list.push_back(fmt::format("Finite elements: of {} assumptions changed one at a time, {} moves the answer "
                                       "most: {} in place of {} ({}).",
                                       a.assumptions.size(), most->what, millimetres(*most->slip), millimetres(full),
                                       percent_of(*most->slip, full)));
        for (const AssumptionRun& run : a.assumptions)
            if (!run.slip) list.push_back(fmt::format("Finite elements, {}: {}.", run.what, word(run.status)));
    }
    if (std::string s = rigid_mover(a); !s.empty()) list.push_back(std::move(s));
    return list;
}

std::vector<std::string> after_sentences(const Assessment& a)
{
    std::vector<std::string> list;
    for (const sliding::Equilibrium& e : a.screening.combinations)
        if (e.kind == CombinationKind::post_seismic)
            list.push_back(fmt::format("Limit equilibrium, {} (crack rule {}): sliding factor {} with μ = {:.3g}.",
                                       e.name, sliding::word(e.crack_rule), factor_text(e.sliding_factor), e.friction));
    if (!a.runs.empty()) {
        const fe2d::StageResult& after = governing_run(a).fe.after;
        if (after.sliding_factor > 0.0 && std::isfinite(after.sliding_factor))
            list.push_back(fmt::format("Finite elements, after {}: sliding factor {:.3g}, {:.3g} m of the base open.",
                                       governing_run(a).label(), after.sliding_factor, after.open_length));
        if (falls_after(governing_run(a)))
            list.push_back("After the earthquake the dam does not stand: " + after.text());
        if (open_after(governing_run(a)))
            list.push_back("For the state after the earthquake the solver found no answer: " + after.text());
    }
    return list;
}

std::vector<std::string> not_named(const Assessment& a)
{
    return effects_off(a, true);
}

std::vector<std::string> taken_off(const Assessment& a)
{
    return effects_off(a, false);
}

} // namespace damslip::pages
