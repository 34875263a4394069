#include "pages/assess/assess_pages.hpp"

#include "analysis/ablation/ablation.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "pages/modes/modes_pages.hpp"
#include "pages/report/page.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/scene_pages.hpp"
#include "pages/screen/screen_pages.hpp"
#include "scene/plausible.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace damslip::pages {

namespace {

using units::mm;

constexpr std::array slip_levels{SlipLevel::regressions, SlipLevel::rigid_block, SlipLevel::flexible_block,
                                 SlipLevel::finite_elements};

/// The product, as `fe` and `worker` write it: a quotient by 0.001 can differ in the last bit.
double in_mm(const std::optional<double>& slip)
{
    return slip ? 1e3 * *slip : std::nan("");
}

Cell cell_in_mm(const std::optional<double>& slip)
{
    return slip ? Cell(in_mm(slip)) : Cell();
}

/// "no uplift": what the narrow margin of a chart has room for.
std::string short_name(const MotionOutcome& run)
{
    constexpr std::string_view long_word = "without ";
    return run.what.starts_with(long_word) ? "no " + run.what.substr(long_word.size()) : run.what;
}

/// All levels on one axis: a curve for each record, and the range that is recommended.
Chart level_chart(const Assessment& a)
{
    Chart chart{.title = "Slip by level", .y = {"slip", "mm", Scale::asinh}, .height = 380};
    for (const SlipLevel level : slip_levels) chart.x.categories.push_back(word(level));
    for (const MotionOutcome& run : a.assumptions) chart.x.categories.push_back(short_name(run));
    std::vector<std::string> records;
    for (const MotionOutcome& l : a.levels)
        if (std::ranges::find(records, l.record) == records.end()) records.push_back(l.record);
    for (const std::string& record : records) {
        Curve curve{.name = record, .mark = Mark::points};
        for (std::size_t i = 0; i < slip_levels.size(); ++i)
            for (const MotionOutcome& l : a.levels)
                if (l.record == record && l.level == slip_levels[i] && l.largest_slip)
                    curve.add(static_cast<double>(i), in_mm(l.largest_slip), in_mm(l.low ? l.low : l.largest_slip),
                              in_mm(l.high ? l.high : l.largest_slip));
        chart.curves.push_back(std::move(curve));
    }
    if (a.recommended) {
        const Recommendation& r = *a.recommended;
        Curve& range = chart.curves.emplace_back(
            Curve{.name = "recommended range", .mark = Mark::points, .weight = Weight::strong});
        range.add(static_cast<double>(std::ranges::find(slip_levels, r.level) - slip_levels.begin()), r.slip / mm,
                  r.low / mm, r.high / mm);
    }
    Curve changed{.name = "finite elements, one assumption changed", .mark = Mark::points};
    for (std::size_t i = 0; i < a.assumptions.size(); ++i)
        if (a.assumptions[i].largest_slip)
            changed.add(static_cast<double>(slip_levels.size() + i), in_mm(a.assumptions[i].largest_slip));
    if (!changed.x.empty()) chart.curves.push_back(std::move(changed));
    if (const auto& allowable = a.ready.given.criteria.allowable_slip)
        chart.horizontal.push_back({*allowable / mm, "allowable"});
    chart.note =
        "Bars: numerical error of finite elements, 16 to 84 % of regressions. To the right of the levels: finite "
        "elements on the worst record with one assumption changed.";
    return chart;
}

Drawing assumption_bars(const Assessment& a)
{
    const double full = a.recommended ? a.recommended->slip : 0.0;
    std::vector<Bar> bars;
    for (const MotionOutcome& run : a.assumptions) {
        Bar bar{short_name(run), {}, 0.0, word(run.status), false};
        if (run.largest_slip) {
            bar.value = (*run.largest_slip - full) / mm;
            bar.words = fmt::format("{:+.4g} mm", *bar.value);
        }
        bars.push_back(std::move(bar));
    }
    return tornado("Change of the slip with each assumption changed", std::move(bars), "change of the slip [mm]",
                   fmt::format("Finite elements on the worst record; as they are {:.4g} mm. To the right: it slides "
                               "further.",
                               full / mm));
}

Table off_table(const std::string& title, const std::vector<std::string>& effects)
{
    return table_of<std::string>(
        title,
        {{{"effect", "effect"}, [](const std::string& s) { return s.substr(0, s.find(": ")); }},
         {{"why", "why"}, [](const std::string& s) { return s.substr(s.find(": ") + 2); }}},
        effects);
}

// What the levels say together, in words. Every number is one of the assessment's.

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
    const auto main = std::ranges::max_element(row->modes, {}, &ModeShare::effective_mass);
    return fmt::format("The dam's main mode at {:.3g} Hz ({:.0f} % of the mass) answers with {:.3g} times the PGA of "
                       "{:.3g} m/s²; its base shear by the response spectrum is {:.3g} times that of a rigid dam.",
                       main->frequency, 100.0 * main->effective_mass / a.spectrum->total_mass,
                       main->acceleration / row->pga, row->pga, row->shear / (row->pga * a.spectrum->total_mass));
}

enum class Off {
    not_named, ///< the scene has no such key: the plan's reasons begin with "no "
    by_choice  ///< of scene or method
};

std::vector<std::string> effects_off(const Assessment& a, Off why)
{
    std::vector<std::string> list;
    const EffectPlan& plan = a.fe ? a.fe->plan : a.screening.plan;
    for (const PlannedEffect& e : plan.effects)
        if (!e.on && e.reason.starts_with("no ") == (why == Off::not_named)) list.push_back(e.name + ": " + e.reason);
    return list;
}

/// The effect whose absence changes the rigid block's slip most, of the worst motion.
std::string rigid_mover(const Assessment& a)
{
    if (!a.rigid_plan || !a.rigid_ablation || a.rigid_ablation->scenes.empty()) return "";
    const std::vector<MotionOutcome>& full = a.rigid_ablation->scenes.front().motions;
    std::size_t worst = full.size();
    for (std::size_t i = 0; i < full.size(); ++i)
        if (full[i].slip && (worst == full.size() || *full[i].slip > *full[worst].slip)) worst = i;
    if (worst == full.size()) return "";
    const std::vector<AblationRow> rows = rows_of(*a.rigid_plan, *a.rigid_ablation, worst);
    const AblationRow* most = nullptr;
    for (std::size_t i = 1; i <= a.rigid_plan->removals.size(); ++i)
        if (rows[i].slip.change && (!most || std::abs(*rows[i].slip.change) > std::abs(*most->slip.change)))
            most = &rows[i];
    if (!most || !rows.front().slip.value || *most->slip.change == 0.0) return "";
    return fmt::format("Rigid block: most depends on {}; without it {} in place of {} (record {}).", most->name,
                       millimetres(most->slip.value.value_or(0.0)), millimetres(*rows.front().slip.value),
                       a.rigid_ablation->motions[worst].label());
}

std::vector<std::string> governing_sentences(const Assessment& a)
{
    std::vector<std::string> list;
    if (!a.recommended) {
        list.push_back(
            a.runs.empty() && !a.interrupted ? "No level has a slip for every record."
            : a.interrupted                  ? "Interrupted: nothing is recommended."
            : !all_answered(a.runs)
                ? "The finite elements decide, and not every run has an answer: " + unanswered_words(a.runs) + "."
                : fmt::format("The finite elements decide: {}. {}", word(governing_run(a).fe.status),
                              text_of(governing_run(a).fe.notes)));
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

std::vector<std::string> mover_sentences(const Assessment& a)
{
    std::vector<std::string> list;
    if (a.recommended && a.recommended->level == SlipLevel::finite_elements) {
        const MotionOutcome* most = nullptr;
        const double full = a.recommended->slip;
        for (const MotionOutcome& run : a.assumptions)
            if (run.largest_slip &&
                (!most || std::abs(*run.largest_slip - full) > std::abs(*most->largest_slip - full)))
                most = &run;
        if (most)
            list.push_back(fmt::format("Finite elements: of {} assumptions changed one at a time, {} moves the answer "
                                       "most: {} in place of {} ({}).",
                                       a.assumptions.size(), most->what, millimetres(*most->largest_slip),
                                       millimetres(full), percent_of(*most->largest_slip, full)));
        for (const MotionOutcome& run : a.assumptions)
            if (!run.largest_slip) list.push_back(fmt::format("Finite elements, {}: {}.", run.what, word(run.status)));
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
            list.push_back("After the earthquake the dam does not stand: " + text_of(after.notes()));
        if (open_after(governing_run(a)))
            list.push_back("For the state after the earthquake the solver found no answer: " + text_of(after.notes()));
    }
    return list;
}

/// One sentence for each reason: "Not run (the time was over): finite elements, record EC8; ..."
std::vector<std::string> left_out_sentences(const Assessment& a)
{
    std::vector<std::string> reasons, list;
    for (const LeftOut& l : a.left_out)
        if (std::ranges::find(reasons, l.why) == reasons.end()) reasons.push_back(l.why);
    for (const std::string& reason : reasons) {
        std::string parts, why = reason;
        while (!why.empty() && why.back() == '.') why.pop_back();
        for (const LeftOut& l : a.left_out)
            if (l.why == reason) parts += (parts.empty() ? "" : "; ") + l.what;
        list.push_back(fmt::format("Not run ({}): {}.", why, parts));
    }
    return list;
}

/// All that is said, by the questions it answers.
std::vector<std::pair<std::string, std::vector<std::string>>> answers(const Assessment& a)
{
    return {{"Which level governs, and why", governing_sentences(a)},
            {"Where the levels disagree", disagreement_sentences(a)},
            {"What moves the answer most", mover_sentences(a)},
            {"After the earthquake", after_sentences(a)}};
}

std::vector<std::string> assess_notes(const Assessment& a)
{
    std::vector<std::string> notes = note_texts(a.ready.given.notes);
    if (a.fe)
        for (std::string& note : note_texts(a.fe->given.notes))
            if (std::ranges::find(notes, note) == notes.end()) notes.push_back(std::move(note));
    for (const std::string& s : left_out_sentences(a)) notes.push_back(s);
    return notes;
}

/// Of lifts and seams, by rigid blocks; none: the scene has neither.
std::optional<Table> governing_planes(const Assessment& a)
{
    if (a.screening.planes.rows.empty()) return std::nullopt;
    return plane_table(a.screening.planes, a.ready.scene, PlaneRows::governing);
}

Table level_table(const Assessment& a)
{
    using L = MotionOutcome;
    return table_of<L>(
        "Slip by level, the worse polarity",
        {{in_brief({"record", "record"}), &L::record},
         {in_brief({"level", "level"}), [](const L& l) { return word(l.level); }},
         {in_brief({"how", "how"}), &L::what},
         {in_brief({"polarity", "polarity"}), [](const L& l) { return l.polarity ? Cell(std::int64_t{l.polarity}) : Cell(); }},
         {in_brief({"status", "status"}), [](const L& l) { return word(l.status); }},
         {ranking({"slip_mm", "largest slip", "mm"}), [](const L& l) { return cell_in_mm(l.largest_slip); }},
         {in_brief({"low_mm", "from", "mm"}), [](const L& l) { return cell_in_mm(l.low); }},
         {in_brief({"high_mm", "to", "mm"}), [](const L& l) { return cell_in_mm(l.high); }}},
        a.levels,
        {"from, to: numerical error of finite elements; 16 and 84 % of the regressions, which are of both "
         "polarities. The rigid block is exact for its record."});
}

Table assumption_table(const Assessment& a)
{
    using R = MotionOutcome;
    const double full = a.recommended ? a.recommended->slip : std::nan("");
    return table_of<R>("Finite elements with one assumption changed",
                       {{in_brief({"assumption", "assumption"}), &R::what},
                        {in_brief({"status", "status"}), [](const R& r) { return word(r.status); }},
                        {in_brief({"slip_mm", "largest slip", "mm"}), [](const R& r) { return cell_in_mm(r.largest_slip); }},
                        {ranking({"change_mm", "change", "mm"}),
                         [&](const R& r) { return r.largest_slip ? finite_cell(*r.largest_slip - full, mm) : Cell(); }}},
                       a.assumptions, {"on the worst record and its polarity, without a second mesh."});
}

} // namespace

Headline assess_headline(const Assessment& a)
{
    std::string sentence = "No slip can be recommended.";
    if (a.recommended)
        sentence = fmt::format("Use {:.4g} mm, range {:.4g} to {:.4g} mm ({}, record {}).", a.recommended->slip / mm,
                               a.recommended->low / mm, a.recommended->high / mm, word(a.recommended->level),
                               a.recommended->record);
    std::vector<std::string> ran;
    for (const ContactRun& r : a.runs)
        if (std::ranges::find(ran, r.record) == ran.end()) ran.push_back(r.record);
    if (a.fe && !ran.empty() && ran.size() < a.fe->records().size())
        sentence += fmt::format(" Only {} of {} records fitted the budget.", ran.size(), a.fe->records().size());
    if (a.recommended && a.recommended->level != SlipLevel::finite_elements)
        sentence += " By the " + word(a.recommended->level) + ": no bound for an elastic dam.";
    sentence += " " + a.verdict_reason;
    const Outcome outcome = a.slip_verdict == Verdict::pass                    ? Outcome::pass
                            : a.slip_verdict == Verdict::fail                  ? Outcome::fail
                            : a.slip_verdict == Verdict::none && a.recommended ? Outcome::none
                                                                               : Outcome::unresolved;
    const std::string verdict = a.slip_verdict == Verdict::undecided ? "Undecided"
                                : a.slip_verdict != Verdict::none    ? word(a.slip_verdict)
                                : a.recommended                      ? "No criterion."
                                                                     : "No answer.";
    return with_failed_checks(with_planes({sentence, outcome, verdict}, a.screening.planes, a.ready.scene), failed_checks(a.screening.combinations));
}

Page assess_page(const Assessment& a, const Scene& given, const WorkPlan& plan)
{
    Page page = begin_page(given, "Every level of effort on one dam. ");
    page.headline = assess_headline(a);
    if (a.recommended) {
        page.key_figures.emplace_back("Use", fmt::format("{:.4g} mm", a.recommended->slip / mm));
        page.key_figures.emplace_back(
            "Range", fmt::format("{:.4g} to {:.4g} mm", a.recommended->low / mm, a.recommended->high / mm));
        page.key_figures.emplace_back("By", word(a.recommended->level));
    }
    if (const auto& allowable = given.criteria.allowable_slip)
        page.key_figures.emplace_back("Allowable slip", fmt::format("{:.4g} mm", *allowable / mm));
    page.warnings = assess_notes(a);
    for (std::string& w : record_warnings(a.ready.records())) page.warnings.push_back(std::move(w));
    page.sections.push_back({"Slip by level", {level_chart(a), rows_part(level_table(a))}});
    if (const auto planes = governing_planes(a)) page.sections.push_back({"Planes that govern", {rows_part(*planes)}});
    for (const auto& [title, sentences] : answers(a)) {
        if (sentences.empty()) continue;
        Section& section = page.sections.emplace_back(Section{title});
        for (const std::string& s : sentences) section.parts.push_back(Paragraph{s});
        if (title == "What moves the answer most" && !a.assumptions.empty()) {
            section.parts.push_back(assumption_bars(a));
            section.parts.push_back(rows_part(assumption_table(a)));
        }
    }
    page.sections.push_back(equilibrium_section(a.screening.combinations));
    if (a.spectrum) page.sections.push_back(spectrum_section(*a.spectrum));
    Section planned{"Work plan, and what came of it", {rows_part(work_plan_table(plan, &a))}};
    if (Table judged = judgement_table(a.ready); !judged.rows.empty()) planned.parts.push_back(rows_part(std::move(judged)));
    page.sections.push_back(std::move(planned));
    page.sections.push_back(
        {"What was not considered",
         {rows_part(off_table("The scene does not name", effects_off(a, Off::not_named))),
          rows_part(off_table("A choice of scene or method leaves off", effects_off(a, Off::by_choice)))}});
    page.sections.push_back(limits_section(a.ready.scene, a.fe ? Method::finite_elements : Method::rigid_block));
    end_page(given, a.ready.records(), page);
    order_sections(given.criteria.report_order, page);
    return page;
}

Answer assess_answer(const Assessment& a, const Scene& given)
{
    Answer all(json_header("assess", given));
    all += given.title + "\n\n";
    if (const auto& r = a.recommended)
        all.set("recommended", {{"slip_mm", in_mm(r->slip)},     {"low_mm", in_mm(r->low)}, {"high_mm", in_mm(r->high)},
                                {"level", word(r->level)},       {"record", r->record},     {"polarity", r->polarity},
                                {"error_known", r->error_known}, {"range_of", r->from}});
    else
        all.set("recommended", nullptr);
    all.set("verdict", word(a.verdict));
    all.set("verdict_reason", a.verdict_reason);
    const Headline headline = assess_headline(a);
    all.set("headline", headline.sentence + " " + headline.verdict);
    all.add("levels", level_table(a), {.brief = true});
    if (const auto planes = governing_planes(a)) all.add("planes", *planes, {.brief = true});
    if (a.spectrum) {
        all += text(spectrum_table(*a.spectrum)) + "\n";
        all.set("response_spectrum", spectrum_json(*a.spectrum));
    }
    all.add("assumptions", assumption_table(a), {.brief = true});
    nlohmann::ordered_json said;
    for (const auto& [title, sentences] : answers(a)) {
        said[title] = sentences;
        if (sentences.empty()) continue;
        all += title + "\n";
        for (const std::string& s : sentences) all += "  " + s + "\n";
        all += "\n";
        all.point(title, sentences.front());
    }
    all.set("answers", said);
    all.add("limit_equilibrium", equilibrium_table(a.screening.combinations), {.text = false});
    all += "Not considered, for the scene does not name it\n";
    for (const std::string& s : effects_off(a, Off::not_named)) all += "  " + s + "\n";
    all += "\nOff by a choice of scene or method\n";
    for (const std::string& s : effects_off(a, Off::by_choice)) all += "  " + s + "\n";
    all.set("not_considered",
            {{"not_named", effects_off(a, Off::not_named)}, {"left_off", effects_off(a, Off::by_choice)}});
    all += "\n";
    all.headline(headline);
    all.notes("notes", assess_notes(a));
    return all;
}

std::vector<std::string> disagreement_sentences(const Assessment& a)
{
    std::vector<std::string> list;
    for (const Disagreement& d : a.disagreements) {
        const double ratio = *d.lower.largest_slip > 0.0 ? *d.higher.largest_slip / *d.lower.largest_slip : 0.0;
        std::string s = fmt::format(
            "{} give{} {}, {} {}{}.", word(d.lower.level),
            d.lower.level == SlipLevel::regressions || d.lower.level == SlipLevel::finite_elements ? "" : "s",
            millimetres(*d.lower.largest_slip), word(d.higher.level), millimetres(*d.higher.largest_slip),
            ratio > 0.0 ? fmt::format(", {:.3g} times as much", ratio) : "");
        s.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(s.front())));
        if (!d.closest)
            s += " Which assumption does it was not run.";
        else if (d.explains)
            s += fmt::format(" The assumption that does it: {}. With it the finite elements give {}.", d.closest->what,
                             millimetres(*d.closest->largest_slip));
        else
            s += fmt::format(" No single assumption that was run does it; the nearest, {}, gives {}.", d.closest->what,
                             millimetres(*d.closest->largest_slip));
        list.push_back(std::move(s));
    }
    return list;
}

} // namespace damslip::pages
