#include "pages/ablation/ablation_pages.hpp"

#include "analysis/prepare/ready.hpp"
#include "analysis/prepare/records.hpp"
#include "core/units.hpp"
#include "pages/report/picture.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/scene_pages.hpp"
#include "scene/plausible.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numeric>

namespace damslip::pages {

namespace {

using units::mm;

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
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
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
                   "effects, positive where the slip is larger without it; ± step: what the time step leaves open."})},
             Fold::open});
    if (in.plan.method == Method::rigid_block)
        page.sections.push_back(
            {"Yield acceleration", {yield_bars(in), rows_part(yield_change_table(in))}, Fold::open});
    page.sections.push_back({"Seconds", {second_bars(in), rows_part(seconds_table(in))}, Fold::open});
    Section how{"How to read it", {rows_part(removal_table(in))}, Fold::open};
    for (std::string& note : ablation_notes(in)) how.parts.push_back(Paragraph{std::move(note)});
    page.sections.push_back(std::move(how));
    page.sections.push_back({"Effects taken into account", {effect_part(effects)}, Fold::folded});
    page.sections.push_back(limits_section(given, in.plan.method));
    page.sections.push_back({"Scene", {scene_listing(given)}, Fold::open});
    page.provenance = scene_provenance(given);
    add_record_provenance(in.records, page.provenance);
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

namespace {

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

} // namespace

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

namespace {

// Pixels of the drawing; y is up.
constexpr double width = 720.0, names = 200.0, figures = 130.0, row = 26.0, bar = 15.0, axis_height = 44.0;

/// 1, 2 or 5 times a power of ten, at most the value.
double round_step(double value)
{
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double digit : {5.0, 2.0})
        if (digit * power <= value) return digit * power;
    return power;
}

struct Frame {
    double low = 0.0, high = 0.0; ///< of the values
    /// Both sides that have bars have room for their figures.
    double x(double value) const
    {
        const double left = names + (low < 0 ? figures : 0.0);
        return left + (value - low) / (high - low) * (width - figures - left);
    }
};

Frame frame_of(const std::vector<Bar>& bars)
{
    Frame f;
    double largest = 0.0;
    for (const Bar& b : bars) {
        if (!b.value) continue;
        largest = std::max(largest, std::abs(*b.value));
        f.low = std::min(f.low, *b.value);
        f.high = std::max(f.high, *b.value);
    }
    for (const Bar& b : bars) { // whiskers longer than half the longest bar are cut at the frame
        if (!b.value) continue;
        f.low = std::min(f.low, *b.value - std::min(b.error, 0.5 * largest));
        f.high = std::max(f.high, *b.value + std::min(b.error, 0.5 * largest));
    }
    if (f.high == f.low) f.high = 1.0;
    return f;
}

void draw_axis(Sketch& sketch, const Frame& f, double top, const std::string& axis)
{
    const double step = round_step((f.high - f.low) / 3.0);
    for (double k = std::ceil(f.low / step); k * step <= f.high * (1 + 1e-12); ++k) {
        const double x = f.x(k * step);
        sketch.line({{x, axis_height}, {x, top}}, k == 0.0 ? "axis" : "grid-line");
        sketch.text({x, axis_height}, fmt::format("{:.6g}", k == 0.0 ? 0.0 : k * step), Align::middle, 0, 15, "small");
    }
    sketch.text({f.x(0.5 * (f.low + f.high)), axis_height}, axis, Align::middle, 0, 33, "small");
}

void draw_bar(Sketch& sketch, const Frame& f, const Bar& b, double middle)
{
    sketch.text({names, middle}, b.name, Align::end, -12, 4.5, "");
    if (!b.value) {
        sketch.text({f.x(0.0), middle}, b.words, Align::start, 8, 4.5, "small");
        return;
    }
    const double from = f.x(0.0), to = f.x(*b.value), low = middle - bar / 2, high = middle + bar / 2;
    const std::string css = std::string(*b.value > 0 ? "more" : "less") + (b.doubtful ? " doubtful" : "");
    if (from != to) sketch.polygon({{from, low}, {to, low}, {to, high}, {from, high}}, css);
    double end = to;
    if (b.error > 0) {
        const double a = f.x(std::max(f.low, *b.value - b.error)), z = f.x(std::min(f.high, *b.value + b.error));
        sketch.line({{a, middle}, {z, middle}}, "whisker");
        for (const double x : {a, z}) sketch.line({{x, middle - 4}, {x, middle + 4}}, "whisker");
        end = *b.value < 0 ? std::min(a, to) : std::max(z, to);
    }
    sketch.text({end, middle}, b.words, *b.value < 0 ? Align::end : Align::start, *b.value < 0 ? -6 : 6, 4.5,
                "halo small");
}

} // namespace

Drawing tornado(std::string title, std::vector<Bar> bars, const std::string& axis, const std::string& note)
{
    std::stable_sort(bars.begin(), bars.end(), [](const Bar& a, const Bar& b) {
        return (a.value ? std::abs(*a.value) : -1.0) > (b.value ? std::abs(*b.value) : -1.0);
    });
    const Frame f = frame_of(bars);
    const double top = axis_height + row * static_cast<double>(bars.size()) + 4.0;
    Sketch sketch({0, 0}, {width, top}, width);
    draw_axis(sketch, f, top, axis);
    double middle = top - 4.0 - row / 2;
    for (const Bar& b : bars) {
        draw_bar(sketch, f, b, middle);
        middle -= row;
    }
    std::string description = title + ":";
    for (const Bar& b : bars) description += fmt::format(" {} {};", b.name, b.words);
    return {std::move(title), sketch.svg(description), note};
}

} // namespace damslip::pages
