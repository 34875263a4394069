#include "pages/ablation/ablation_pages.hpp"

#include "analysis/prepare/ready.hpp"
#include "core/units.hpp"
#include "pages/report/page.hpp"
#include "pages/scene/scene_pages.hpp"
#include "scene/plausible.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numeric>

namespace damslip::pages {

StatusCount unanswered_runs(const AblationRuns& runs)
{
    StatusCount count;
    for (const VariantRuns& scene : runs.scenes)
        for (const MotionOutcome& r : scene.motions)
            if (!is_answer(r.status)) count.add(r.status);
    if (runs.step && runs.step->missed) count.add(Status::tolerance_missed);
    return count;
}

namespace {

using units::mm;

bool fe(const Ablations& in)
{
    return in.plan.method == Method::finite_elements;
}

std::string name_of(const AblationPlan& plan, const std::optional<Effect>& effect)
{
    for (const Ablation& a : plan.removals)
        if (effect && a.effect == *effect) return a.name;
    return "";
}

AblationRow sum_row(const AblationPlan& plan, const std::vector<AblationRow>& rows)
{
    AblationRow row{rows.front().motion, "(sum of changes)", "sum"};
    row.remark = "some run has no final slip";
    const double full = rows.front().slip.value.value_or(0.0);
    if (const std::optional<double> sum = sum_of_changes(plan, rows)) {
        row.slip.change = sum;
        if (full != 0.0) row.slip.percent = 100.0 * *sum / std::abs(full);
        row.remark = "without rows that are part of another";
    }
    return row;
}

/// The sum stands before the row of the simplest scene, which it compares with.
void add_changes(const Ablations& in, std::size_t motion, std::vector<AblationRow>& list)
{
    std::vector<AblationRow> rows = rows_of(in.plan, in.runs, motion);
    if (in.plan.simplest) rows.insert(rows.end() - 1, sum_row(in.plan, rows));
    list.insert(list.end(), rows.begin(), rows.end());
}

std::vector<ColumnOf<AblationRow>> change_columns(const Ablations& in)
{
    using R = AblationRow;
    const ColumnOf<R> slip_error{in_brief({"slip_error_mm", "± step", "mm", 2}), &R::slip_error, mm},
        change_error{in_brief({"change_error_mm", "± step", "mm", 2}), &R::change_error, mm};
    std::vector<ColumnOf<R>> columns{
        {in_brief({"effect", "without"}), &R::name},
        {in_brief({"status", "status"}), &R::status},
        {in_brief({"slip_mm", "slip", "mm", 5}), [](const R& r) { return r.slip.value; }, mm}};
    if (fe(in)) columns.push_back(slip_error);
    columns.push_back({ranking({"change_mm", "change", "mm", 4}), [](const R& r) { return r.slip.change; }, mm});
    if (fe(in)) columns.push_back(change_error);
    columns.push_back({in_brief({"change_percent", "change", "%", 3}), [](const R& r) { return r.slip.percent; }});
    if (fe(in)) {
        columns.push_back({{"crest_mm", "crest", "mm", 4}, [](const R& r) { return r.crest.value; }, mm});
        columns.push_back({{"crest_change_mm", "change", "mm", 3}, [](const R& r) { return r.crest.change; }, mm});
        columns.push_back({{"crest_change_percent", "change", "%", 3}, [](const R& r) { return r.crest.percent; }});
        for (std::size_t k = 0; k < in.plan.full.lift_joints.size(); ++k) {
            const std::string key = fmt::format("lift_joint_{}_", k + 1);
            columns.push_back(
                {{key + "slip_mm", "slip, " + in.plan.full.lift_joints[k].name, "mm", 5},
                 [k](const R& r) { return k < r.lifts.size() ? optional_cell(r.lifts[k].value, mm) : Cell(); }});
            columns.push_back({{key + "change_mm", "change", "mm", 4}, [k](const R& r) {
                                   return k < r.lifts.size() ? optional_cell(r.lifts[k].change, mm) : Cell();
                               }});
        }
    }
    columns.push_back({in_brief({"remark", "remark"}), &R::remark});
    return columns;
}

/// Every effect that is on: what takes its place, or why it stays.
Table removal_table(const Ablations& in)
{
    struct Row {
        std::string effect, part_of, instead;
    };
    std::vector<Row> rows;
    for (const Ablation& a : in.plan.removals) rows.push_back({a.name, name_of(in.plan, a.part_of), a.instead});
    for (const KeptEffect& k : in.plan.kept) rows.push_back({k.name, "", "stays: " + k.why});
    return table_of<Row>("What takes the place of each effect",
                         {{{"effect", "effect"}, &Row::effect},
                          {{"part_of", "part of"}, &Row::part_of},
                          {{"instead", "instead"}, &Row::instead}},
                         rows);
}

/// Slip and crest motion of every scene under one motion, and their changes; with the sum of the changes.
Table change_table(const Ablations& in, std::size_t motion)
{
    std::vector<AblationRow> rows;
    add_changes(in, motion, rows);
    return table_of("Record " + in.runs.motions[motion].label(), change_columns(in), rows);
}

/// The same of all motions, with columns that name them.
Table change_table_of_all(const Ablations& in)
{
    std::vector<AblationRow> rows;
    for (std::size_t r = 0; r < in.runs.motions.size(); ++r) add_changes(in, r, rows);
    std::vector<ColumnOf<AblationRow>> columns = change_columns(in);
    columns.insert(columns.begin(),
                   {{{"record", "record"}, [](const AblationRow& r) { return r.motion.record; }},
                    {{"polarity", "polarity"}, [](const AblationRow& r) { return r.motion.polarity; }}});
    return table_of("Changes by effect", columns, rows);
}

/// Yield acceleration and critical friction of every scene, rigid block.
Table yield_change_table(const Ablations& in)
{
    struct Row {
        std::string name;
        Change yield, critical_friction;
    };
    const std::vector<std::string> names = scene_names(in.plan);
    const VariantRuns& full = in.runs.scenes.front();
    std::vector<Row> rows{{names[0], {full.yield_acceleration, {}, {}}, {full.critical_friction, {}, {}}}};
    for (std::size_t i = 1; i < names.size(); ++i) {
        const VariantRuns& own = in.runs.scenes[i];
        rows.push_back({names[i], change_from(full.yield_acceleration, own.yield_acceleration),
                        change_from(full.critical_friction, own.critical_friction)});
    }
    return table_of<Row>(
        "Yield acceleration",
        {{in_brief({"effect", "without"}), &Row::name},
         {in_brief({"yield_acceleration_m_s2", "a_y", "m/s²", 6}), [](const Row& r) { return r.yield.value; }},
         {{"change_m_s2", "change", "m/s²", 4}, [](const Row& r) { return r.yield.change; }},
         {ranking({"change_percent", "change", "%", 3}), [](const Row& r) { return r.yield.percent; }},
         {{"critical_friction", "critical μ", "–", 6}, [](const Row& r) { return r.critical_friction.value; }},
         {{"critical_friction_change", "change", "–", 4}, [](const Row& r) { return r.critical_friction.change; }}},
        rows, {"before any slip, downstream, without vertical motion; negative: slides without earthquake."});
}

/// Seconds of every scene and those saved; unknowns of FE models. Differs from call to call.
Table seconds_table(const Ablations& in)
{
    struct Row {
        std::string name;
        const VariantRuns& runs;
        std::optional<double> saved;
        std::optional<std::int64_t> unknowns_saved = {};

        std::int64_t unknowns() const { return runs.unknowns.value_or(0); }
    };
    const std::vector<std::string> names = scene_names(in.plan);
    const VariantRuns& full = in.runs.scenes.front();
    std::vector<Row> rows{{names[0], full, {}}};
    for (std::size_t i = 1; i < names.size(); ++i) {
        rows.push_back({names[i], in.runs.scenes[i], saved_seconds(full, in.runs.scenes[i])});
        rows.back().unknowns_saved = rows.front().unknowns() - rows.back().unknowns();
    }
    const double percent = 0.01 * full.all_seconds();
    std::vector<ColumnOf<Row>> columns{
        {{"effect", "without"}, &Row::name},
        {{"set_up_seconds", "set-up", "s", 3}, [](const Row& r) { return r.runs.set_up_seconds; }},
        {{"run_seconds", "runs", "s", 3}, [](const Row& r) { return r.runs.run_seconds(); }},
        {{"seconds", "sum", "s", 3}, [](const Row& r) { return r.runs.all_seconds(); }},
        {{"saved_seconds", "saved", "s", 2}, &Row::saved},
        {{"saved_percent", "saved", "%", 2}, [=](const Row& r) { return optional_cell(r.saved, percent); }}};
    if (fe(in)) {
        columns.push_back({{"unknowns", "unknowns"}, &Row::unknowns});
        columns.push_back({{"unknowns_saved", "saved"}, &Row::unknowns_saved});
    }
    Table t = table_of("Seconds", columns, rows,
                       {"processor time of one thread, so other work on the machine does not count; saved is positive "
                        "where the simpler scene is faster."});
    if (in.runs.jobs > 1)
        t.notes.push_back(fmt::format("measured with up to {} scenes side by side, which share caches and memory: use "
                                      "--jobs 1 for seconds to rely on.",
                                      in.runs.jobs));
    return t;
}

/// The removal that changes the slip most under one motion; null: none has a change.
const AblationRow* strongest(const AblationPlan& plan, const std::vector<AblationRow>& rows)
{
    const AblationRow* best = nullptr;
    for (std::size_t i = 1; i <= plan.removals.size(); ++i)
        if (rows[i].slip.change && !rows[i].still_sliding &&
            (!best || std::abs(*rows[i].slip.change) > std::abs(*best->slip.change)))
            best = &rows[i];
    return best;
}

/// " (-12 %)"; nothing where it would not help.
std::string percent(const std::optional<double>& value)
{
    if (!value || std::abs(*value) >= 1000.0) return "";
    return std::abs(*value) < 10.0 ? fmt::format(" ({:+.2g} %)", *value) : fmt::format(" ({:+.0f} %)", *value);
}

Drawing slip_bars(const Ablations& in, std::size_t motion)
{
    const std::vector<AblationRow> rows = rows_of(in.plan, in.runs, motion);
    std::vector<Bar> bars;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const AblationRow& r = rows[i];
        Bar b{r.name,
              {},
              r.change_error.value_or(0.0) / mm,
              r.slip.value ? "no change to show" : r.status,
              r.within_step_error};
        if (r.still_sliding && r.slip.value)
            b.words = fmt::format("still sliding after {:.4g} mm", *r.slip.value / mm);
        else if (r.slip.change) {
            b.value = *r.slip.change / mm;
            b.words = fmt::format("{:+.4g} mm", *b.value) + percent(r.slip.percent);
        }
        bars.push_back(std::move(b));
    }
    const auto& full = rows.front().slip.value;
    std::string note = full ? fmt::format("With all effects the dam slides {:.4g} mm. ", *full / mm)
                            : "With all effects: " + rows.front().status + ". ";
    note += "To the right: without the effect it slides further.";
    if (in.runs.step)
        note += " Whiskers: what the time step leaves open in the change; hollow: the change is within it.";
    return tornado("Change of the slip without each effect, record " + in.runs.motions[motion].label(), std::move(bars),
                   "change of the slip [mm]", note);
}

Drawing second_bars(const Ablations& in)
{
    const std::vector<std::string> names = scene_names(in.plan);
    const double whole = in.runs.scenes.front().all_seconds();
    const bool small = whole < 0.1;
    const double unit = small ? 1e-3 : 1.0;
    const char* const word = small ? "ms" : "s";
    std::vector<Bar> bars;
    for (std::size_t i = 1; i < names.size(); ++i) {
        const std::optional<double> saved = saved_seconds(in.runs.scenes.front(), in.runs.scenes[i]);
        Bar b{names[i], {}, 0.0, "not run to the end", false};
        if (saved) {
            b.value = *saved / unit;
            b.words = fmt::format("{:+.2g} {}", *b.value, word) + percent(100.0 * *saved / whole);
        }
        bars.push_back(std::move(b));
    }
    return tornado(small ? "Milliseconds saved without each effect" : "Seconds saved without each effect",
                   std::move(bars), fmt::format("saved [{}]", word),
                   fmt::format("With all effects: {:.3g} {} of set-up and runs. To the right: faster without the "
                               "effect.{}",
                               whole / unit, word,
                               in.runs.jobs > 1 ? " Measured with several scenes side by side: not to rely on." : ""));
}

Drawing yield_bars(const Ablations& in)
{
    const std::vector<std::string> names = scene_names(in.plan);
    std::vector<Bar> bars;
    const double full = in.runs.scenes.front().yield_acceleration.value_or(std::nan(""));
    for (std::size_t i = 1; i < names.size(); ++i) {
        const auto& own = in.runs.scenes[i].yield_acceleration;
        if (!own) {
            bars.push_back({names[i], {}, 0.0, word(Status::not_resolved), false});
            continue;
        }
        const double change = *own - full;
        bars.push_back({names[i], change, 0.0, fmt::format("{:+.3g}", change), false});
    }
    return tornado("Change of the yield acceleration without each effect", std::move(bars), "change of a_y [m/s²]",
                   fmt::format("With all effects a_y = {:.4g} m/s². To the right: it slides later.", full));
}

std::string motion_sentence(const Ablations& in, std::size_t motion)
{
    const std::vector<AblationRow> rows = rows_of(in.plan, in.runs, motion);
    const AblationRow* most = strongest(in.plan, rows);
    const std::string name = in.runs.motions[motion].label();
    if (!rows.front().slip.value)
        return fmt::format("Record {}: the full scene ends as {}.", name, rows.front().status);
    if (!most) return fmt::format("Record {}: the dam slides {:.4g} mm.", name, *rows.front().slip.value / mm);
    return fmt::format("Record {}: the dam slides {:.4g} mm; most depends on {}, without it {:+.4g} mm.", name,
                       *rows.front().slip.value / mm, most->name, *most->slip.change / mm);
}

/// Motions by the slip of the full scene: the first is the line of --quiet and the table of the answer in brief.
std::vector<std::size_t> worst_first(const Ablations& in)
{
    std::vector<std::size_t> order(in.runs.motions.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
        const std::vector<MotionOutcome>& full = in.runs.scenes.front().motions;
        return std::abs(full[a].slip.value_or(0.0)) > std::abs(full[b].slip.value_or(0.0));
    });
    return order;
}

Headline headline(const Ablations& in)
{
    std::string sentence;
    for (const std::size_t m : worst_first(in)) sentence += (sentence.empty() ? "" : " ") + motion_sentence(in, m);
    if (in.records.empty())
        sentence = fmt::format("The dam starts to slide at a ground acceleration of {:.4g} m/s²; no record is given.",
                               in.runs.scenes.front().yield_acceleration.value_or(std::nan("")));
    if (const StatusCount unanswered = unanswered_runs(in.runs); !unanswered.empty())
        return {sentence, Outcome::unresolved, "Runs without an answer: " + unanswered.words() + "."};
    return {sentence, Outcome::none, ""};
}

std::vector<std::pair<std::string, std::string>> key_figures(const Ablations& in)
{
    std::vector<std::pair<std::string, std::string>> list{
        {"Method", in.plan.method == Method::rigid_block ? "rigid block" : "finite elements"},
        {"Effects removed",
         fmt::format("{} of {} that are on", in.plan.removals.size(), in.plan.removals.size() + in.plan.kept.size())}};
    if (in.runs.step) list.emplace_back("Time step", fmt::format("{:.4g} s", in.runs.step->largest_dt));
    list.emplace_back("Time with all effects", fmt::format("{:.3g} s", in.runs.scenes.front().all_seconds()));
    return list;
}

std::vector<std::string> warnings(const Ablations& in)
{
    std::vector<std::string> list = record_warnings(in.records);
    const std::vector<std::string> names = scene_names(in.plan);
    if (in.plan.method == Method::rigid_block && (in.plan.full.lifts || !in.plan.full.seams.empty()))
        list.push_back("Yield, critical friction and slip are those of the plane where they are worst: base, lifts and seams.");
    for (std::size_t r = 0; r < in.runs.motions.size(); ++r)
        for (std::size_t i = 0; i < names.size(); ++i) {
            const MotionOutcome& o = in.runs.scenes[i].motions[r];
            if (o.slip && !o.still_sliding) continue;
            const std::string why = o.still_sliding ? "still sliding after the run-out" : o.reason();
            list.push_back(fmt::format(
                "{}, {}: {}{}{}", in.runs.motions[r].label(), i == 0 ? "with all effects" : "without " + names[i],
                o.still_sliding ? "" : word(o.status), why.empty() || o.still_sliding ? "" : ": ", why));
        }
    return list;
}

/// "dt/8"
std::string step_word(int halvings)
{
    return halvings == 0 ? "dt" : fmt::format("dt/{}", 1 << halvings);
}

std::string step_note(const AblationStep& step)
{
    return fmt::format(
        "time step: {} = {:.4g} s in all runs, {}; ± step is what it leaves open, from the same runs with {} and first "
        "order; that of a change is of the difference itself.",
        step_word(step.halvings), step.largest_dt,
        step.missed
            ? "the smallest there is: time.slip_tolerance asks for a smaller one with all effects (tolerance missed)"
        : step.chosen ? "what time.slip_tolerance asks for with all effects, but dt/8 at least"
                      : "as time.substeps says",
        step_word(step.other));
}

std::optional<std::string> interaction_note(const Ablations& in)
{
    if (!in.plan.simplest || in.records.empty()) return std::nullopt;
    std::string text = "effects act on each other, so the changes do not add up: ";
    bool any = false;
    for (std::size_t r = 0; r < in.runs.motions.size(); ++r) {
        const std::vector<AblationRow> rows = rows_of(in.plan, in.runs, r);
        const std::optional<double> sum = sum_of_changes(in.plan, rows), all = rows.back().slip.change;
        if (!sum || !all) continue;
        text += fmt::format("{}{}: sum {:+.4g} mm, all removed at once {:+.4g} mm", any ? "; " : "",
                            in.runs.motions[r].label(), *sum / units::mm, *all / units::mm);
        any = true;
    }
    return any ? text + "." : "effects act on each other, so the changes do not add up.";
}

/// What has to be known to read the tables, a sentence each; the same at each call.
std::vector<std::string> ablation_notes(const Ablations& in)
{
    std::vector<std::string> notes;
    if (const auto note = base_note(in.plan.full); note && in.plan.method == Method::finite_elements)
        notes.push_back(*note + ".");
    for (std::string& note : note_texts(in.plan.full.notes)) notes.push_back(std::move(note));
    notes.push_back("every run with " + polarity_words(polarities_of(in.plan.full)));
    if (!in.water.empty()) notes.push_back(in.water + " in all runs");
    if (in.runs.step) notes.push_back(step_note(*in.runs.step));
    if (in.plan.method == Method::rigid_block)
        notes.push_back(
            in.plan.full.sliding.scheme == SlidingScheme::exact
                ? "rigid block: events are located exactly, so no step error; the crest moves with the base."
                : "rigid block, SLAMMER's scheme: its step error is not estimated; the crest moves with "
                  "the base.");
    else
        notes.push_back("crest: largest horizontal distance of its upstream end from where it stood over the base "
                        "before the earthquake, so deformation and rocking without the slip; contact runs keep no "
                        "crest acceleration.");
    for (std::size_t r = 0; r < in.runs.motions.size(); ++r)
        if (const MotionOutcome& full = in.runs.scenes.front().motions[r]; !full.slip)
            notes.push_back(fmt::format("{}: with all effects {}, so there is no slip that a removal could change. {}",
                                        in.runs.motions[r].label(), word(full.status), full.reason()));
    if (const StatusCount unanswered = unanswered_runs(in.runs); !unanswered.empty())
        notes.push_back("runs without an answer: " + unanswered.words() + ".");
    if (in.records.empty())
        notes.push_back("no record is given: no slip. Name one with --record or [[motion.record]].");
    if (auto note = interaction_note(in)) notes.push_back(std::move(*note));
    return notes;
}

} // namespace

Page ablation_page(const Ablations& in, const Scene& given, const EffectPlan& effects)
{
    Page page = begin_page(given, "What each effect does to the slip, and what it costs. ");
    page.headline = headline(in);
    page.key_figures = key_figures(in);
    page.warnings = warnings(in);
    for (std::size_t r = 0; r < in.runs.motions.size(); ++r)
        page.sections.push_back(
            {"Slip, record " + in.runs.motions[r].label(),
             {slip_bars(in, r),
              rows_part(
                  change_table(in, r),
                  {"Slip: of the scene without the effect named, positive downstream; change: against the run with all "
                   "effects, positive where the slip is larger without it; ± step: what the time step leaves "
                   "open."})}});
    if (in.plan.method == Method::rigid_block)
        page.sections.push_back({"Yield acceleration", {yield_bars(in), rows_part(yield_change_table(in))}});
    page.sections.push_back({"Seconds", {second_bars(in), rows_part(seconds_table(in))}});
    Section how{"How to read it", {rows_part(removal_table(in))}};
    for (std::string& note : ablation_notes(in)) how.parts.push_back(Paragraph{std::move(note)});
    page.sections.push_back(std::move(how));
    page.sections.push_back({"Effects taken into account", {effect_part(effects)}, Fold::folded});
    page.sections.push_back(limits_section(given, in.plan.method));
    end_page(given, in.records, page);
    return page;
}

Answer ablation_answer(const Ablations& in, const Scene& given, const EffectPlan& effects)
{
    Answer all(json_header("explain", given));
    all += in.plan.full.title + "\n\n";
    const Table removals = removal_table(in), yields = yield_change_table(in), seconds = seconds_table(in);
    const bool rigid = in.plan.method == Method::rigid_block;
    all.set("method", rigid ? "rigid" : "fe");
    all.add("effects", effect_table(effects));
    nlohmann::ordered_json of_runs;
    all.add("removals", removals, {.data = false});
    of_runs["removals"] = json_of(removals);
    if (const auto& step = in.runs.step)
        of_runs["step"] = {{"substeps", step->halvings},
                           {"dt_s", step->largest_dt},
                           {"chosen", step->chosen},
                           {"error_from_substeps", step->other}};
    if (rigid) {
        all.add("yield", yields, {.brief = in.records.empty(), .data = false});
        of_runs["yield"] = json_of(yields);
    }
    const std::vector<std::size_t> order = worst_first(in);
    for (std::size_t m = 0; m < order.size(); ++m)
        all.add("changes", change_table(in, m), {.brief = m == order.front(), .data = false});
    all.add("seconds", seconds, {.data = false});
    of_runs["changes"] = json_of(change_table_of_all(in));
    of_runs["notes"] = ablation_notes(in);
    of_runs["seconds"] = {{"jobs", in.runs.jobs}, {"scenes", json_of(seconds)}};
    all.set("ablation", of_runs);
    all.headline_in_brief(headline(in));
    for (const std::string& note : ablation_notes(in)) all.note(note);
    return all;
}

} // namespace damslip::pages
