#include "pages/sweep/sweep_pages.hpp"

#include "analysis/prepare/ready.hpp"
#include "analysis/prepare/records.hpp"
#include "analysis/prepare/reservoir.hpp"
#include "core/units.hpp"
#include "core/version.hpp"
#include "pages/fe/fe_pages.hpp"
#include "pages/report/page.hpp"
#include "pages/scene/scene_pages.hpp"
#include "pages/screen/screen_pages.hpp"
#include "scene/effect_plan.hpp"
#include "scene/plausible.hpp"
#include "scene/write.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace damslip::pages {

namespace {

using units::mm;
constexpr std::size_t drawn_variants = 12, open_variants = 3; ///< with a chart of their own; of these unfolded

/// Rows of one method: how many have a slip, failed statically, or have no answer.
struct MethodRows {
    std::string method;
    std::int64_t rows = 0, static_failures = 0, unanswered = 0, above_allowable = 0;
    std::vector<double> slips; ///< ascending [mm]
    StatusCount without;

    Cell median() const
    {
        const std::size_t n = slips.size();
        return n ? Cell(0.5 * (slips[(n - 1) / 2] + slips[n / 2])) : Cell();
    }
};

MethodRows rows_of(const SweepView& view, const std::string& method, const std::optional<double>& allowable)
{
    MethodRows m;
    m.method = method;
    for (const SweepRow& r : view.rows) {
        if (r.method != method) continue;
        ++m.rows;
        m.static_failures += r.fails_statically();
        m.unanswered += r.unanswered();
        if (!r.slip && r.state) m.without.add(*r.state);
        if (!r.slip) continue;
        m.above_allowable += allowable && std::abs(*r.slip) > *allowable;
        m.slips.push_back(std::abs(*r.slip) / mm);
    }
    std::ranges::sort(m.slips);
    return m;
}

Table method_table(const SweepView& view, const std::optional<double>& allowable)
{
    using M = MethodRows;
    std::vector<M> rows;
    for (const std::string& method : view.methods) rows.push_back(rows_of(view, method, allowable));
    std::vector<ColumnOf<M>> columns{{{"method", "method"}, &M::method},
                                     {{"rows", "rows"}, &M::rows},
                                     {{"with_slip", "with a slip"}, [](const M& m) { return m.slips.size(); }},
                                     {{"static_failures", "slide statically"}, &M::static_failures},
                                     {{"unanswered", "no answer"}, &M::unanswered},
                                     {{"median_mm", "median", "mm", 4}, &M::median},
                                     {{"largest_mm", "largest", "mm", 4},
                                      [](const M& m) { return m.slips.empty() ? Cell() : Cell(m.slips.back()); }},
                                     {{"without_slip", "without a slip"},
                                      [](const M& m) { return m.without.empty() ? Cell() : Cell(m.without.words()); }}};
    if (allowable) columns.push_back({{"above_allowable", "above the allowable"}, &M::above_allowable});
    return table_of("Rows by method", columns, rows,
                    {"slips: largest on the way, of rows with an answer; slide statically: there is no equilibrium "
                     "without an earthquake; without a slip: by status."});
}

/// The variants with the friction that each needs without an earthquake.
Table variant_table(const SweepView& view)
{
    using V = SweepVariant;
    const auto stands_from = [&](const V& v) {
        const auto number = static_cast<std::size_t>(&v - view.variants.data());
        const auto row = std::ranges::find_if(
            view.rows, [&](const SweepRow& r) { return r.variant == number && r.critical_friction; });
        return row == view.rows.end() ? Cell() : Cell(*row->critical_friction);
    };
    std::vector<ColumnOf<V>> columns{{{"level_m", "level", "m", 4}, &V::level},
                                     {{"uplift", "uplift"}, &V::uplift},
                                     {{"reservoir", "water"}, &V::reservoir},
                                     {{"size", "size", "–", 4}, &V::size},
                                     {{"scale", "motion ×", "–", 4}, &V::scale},
                                     {{"critical_friction", "needs statically μ ≥", "–", 5}, stands_from}};
    if (!view.variants.empty() && !view.variants.front().opening.empty())
        columns.insert(columns.begin() + 2, {{"opening_water", "opening water"}, &V::opening});
    if (!view.variants.empty() && !view.variants.front().plane.empty())
        columns.insert(columns.begin(), {{"plane", "plane"}, &V::plane});
    const auto add_given = [&](Column column, std::optional<double> V::*member) {
        if (std::ranges::any_of(
                view.variants, [](const auto& value) { return value.has_value(); }, member))
            columns.insert(columns.end() - 2, {std::move(column), member});
    };
    add_given({"damping", "damping", "–", 4}, &V::damping);
    add_given({"period_s", "T_s", "s", 4}, &V::period);
    return table_of("Variants", columns, view.variants);
}

const SweepRow* worst_of(const SweepView& view)
{
    const SweepRow* worst = nullptr;
    const bool fe = std::ranges::any_of(view.rows, [](const SweepRow& r) { return r.finite_elements() && r.slip; });
    for (const SweepRow& r : view.rows) {
        if (!r.slip || !(fe ? r.finite_elements() : r.rigid())) continue;
        if (!worst || std::abs(*r.slip) > std::abs(*worst->slip)) worst = &r;
    }
    if (const auto& other = view.largest_left_out; other && !fe && other->rigid())
        if (!worst || std::abs(*other->slip) > std::abs(*worst->slip)) worst = &*other;
    return worst;
}

/// The variant that needs most friction by the main method; null: the sweep does not say.
const NeededFriction* most_needed(const std::vector<NeededFriction>& all, const std::string& method)
{
    const auto wanted = [](const NeededFriction& n) {
        return !n.more ? 0.0 : n.friction().value_or(std::numeric_limits<double>::infinity());
    };
    const NeededFriction* most = nullptr;
    for (const NeededFriction& n : all)
        if (n.method == method && (!most || wanted(n) > wanted(*most))) most = &n;
    return most;
}

/// "0.895", "below 0.65", "above 1": where the grid does not bracket it.
std::string friction_words(const NeededFriction& n, const SweepView& view)
{
    return !n.more    ? fmt::format("below {:.4g}", view.frictions.front())
           : !n.holds ? fmt::format("above {:.4g}", view.frictions.back())
                      : fmt::format("{:.4g}", *n.friction());
}

/// What the sweep is for, first of all.
std::string needed_sentence(const SweepView& view, const std::optional<double>& allowable)
{
    const std::vector<NeededFriction> all = needed_frictions(view, allowable);
    const NeededFriction* n = all.empty() ? nullptr : most_needed(all, main_method(view));
    if (!n) return "";
    std::string out = fmt::format("A slip of {:.4g} mm at most needs a friction of {} ({}", *allowable / mm,
                                  friction_words(*n, view), n->method);
    if (!n->variant.empty()) out += ", " + n->variant;
    if (n->more) out += fmt::format(", governed by record {}, polarity {:+d}", n->record, n->polarity.value_or(1));
    if (n->friction()) out += fmt::format("; {:.4g} slips more, {:.4g} holds", *n->more, *n->holds);
    return out + "). ";
}

Headline headline(const SweepView& view, const std::optional<double>& allowable)
{
    const std::string unanswered = view.unanswered.words();
    const SweepRow* worst = worst_of(view);
    std::string sentence =
        needed_sentence(view, allowable) +
        (worst ? fmt::format("{} rows: the largest slip is {:.4g} mm ({}, μ = {:.4g}, record {})", view.all(),
                             std::abs(*worst->slip) / mm, worst->method, worst->friction, worst->record)
               : fmt::format("{} rows: none has a slip", view.all()));
    double critical = 0.0;
    std::size_t failing = 0;
    for (const SweepRow& r : view.rows) {
        if (!r.fails_statically()) continue;
        ++failing;
        if (r.critical_friction && std::isfinite(*r.critical_friction))
            critical = std::max(critical, *r.critical_friction);
    }
    if (failing)
        sentence += fmt::format("; {} rows slide without any earthquake, up to a critical friction of {:.4g}", failing,
                                critical);
    if (allowable && worst) {
        std::size_t above = 0, judged = 0;
        for (const SweepRow& r : view.rows) {
            if (r.method != worst->method || !r.slip) continue;
            ++judged;
            above += std::abs(*r.slip) > *allowable;
        }
        sentence += fmt::format("; {} of {} slips by {} exceed the allowable {:.4g} mm", above, judged, worst->method,
                                *allowable / mm);
    }
    sentence += ".";
    if (!view.polarities.empty()) sentence += " Run: " + polarity_words(view.polarities) + ".";
    if (worst && !worst->finite_elements()) sentence += " By " + std::string(worst->method) + ": no bound for an elastic dam.";
    if (!unanswered.empty()) return {sentence, Outcome::unresolved, unanswered + "."};
    return {sentence, Outcome::none, ""};
}

/// What the page leaves out of a sweep of many rows; empty: nothing.
std::string thinned_words(const SweepView& view, const std::filesystem::path& csv)
{
    if (view.left_out == 0) return "";
    return fmt::format(
        "Drawn and counted on this page are {} of {} rows, those of one friction in {}; only the largest "
        "slip and the rows without an answer are of all rows{}.",
        view.rows.size(), view.all(), view.every, csv.empty() ? "" : ", which are in " + csv.filename().string());
}

std::vector<std::string> warnings(const SweepView& view)
{
    std::vector<std::string> list;
    for (const SweepRow& r : view.rows)
        if (r.unanswered())
            list.push_back(
                fmt::format("{}, μ = {:.4g}, {}{}, polarity {:+d}: {}", r.method, r.friction, r.record,
                            view.variant_names[r.variant].empty() ? "" : ", " + view.variant_names[r.variant],
                            r.polarity, r.status));
    if (const std::string unknown = unknown_error_words(view); !unknown.empty()) list.push_back(unknown + ".");
    return list;
}

/// A chart of each variant that has a slip, from the first on to the one before `end`.
void add_variants(const SweepView& view, std::size_t first, std::size_t end, const std::optional<double>& allowable,
                  Section& section)
{
    for (std::size_t v = first; v < std::min(view.variants.size(), end); ++v)
        if (Chart chart = slip_over_friction(view, v, allowable); !chart.curves.empty())
            section.parts.emplace_back(std::move(chart));
}

Section friction_section(const SweepView& view, const std::optional<double>& allowable)
{
    Section section{"Slip over friction"};
    add_variants(view, 0, open_variants, allowable, section);
    if (section.parts.empty())
        section.parts.push_back(Paragraph{"No row of the first variants has a slip: see the critical frictions."});
    return section;
}

/// The variants after those that are unfolded.
std::optional<Section> further_variants(const SweepView& view, const std::optional<double>& allowable)
{
    if (view.variants.size() <= open_variants) return std::nullopt;
    Section section{"Slip over friction, further variants", {}, Fold::folded};
    add_variants(view, open_variants, drawn_variants, allowable, section);
    if (view.variants.size() > drawn_variants)
        section.parts.push_back(Paragraph{
            fmt::format("{} further variants are in the table of rows only.", view.variants.size() - drawn_variants)});
    return section;
}

/// Of the unfolded variants, by the main method and by the rigid block with the same motion.
std::optional<Section> history_section(const SweepView& view, const std::vector<SlipHistory>& histories)
{
    if (histories.size() != view.rows.size()) return std::nullopt;
    Section section{"Slip over time"};
    std::vector<std::string> methods{main_method(view)};
    if (!methods.front().starts_with("rigid"))
        for (const char* rigid : {"rigid-v", "rigid"})
            if (methods.size() == 1 && std::ranges::find(view.methods, rigid) != view.methods.end())
                methods.emplace_back(rigid);
    for (std::size_t v = 0; v < std::min(view.variants.size(), open_variants); ++v)
        for (const std::string& method : methods)
            if (auto chart = slip_histories(view, v, method, histories)) section.parts.emplace_back(std::move(*chart));
    if (section.parts.empty()) return std::nullopt;
    return section;
}

Section variant_section(const SweepView& view, const std::optional<double>& allowable)
{
    Section section{
        "Variants",
        {rows_part(variant_table(view),
                   {"Level: water above the heel; size: factor on all lengths of the scene; motion ×: "
                    "factor on the records; needs statically μ ≥: friction that just holds the dam without an "
                    "earthquake."})}};
    if (view.variants.size() > 1)
        for (const std::string& method : view.methods) {
            if (!is_of_elements(method) && method != "rigid" && method != "rigid-v") continue;
            Chart chart = slip_by_variant(view, method, allowable);
            if (chart.curves.size() > 1) section.parts.emplace_back(std::move(chart));
        }
    section.parts.emplace_back(yield_over_friction(view));
    return section;
}

/// Columns that no row has a value in, such as those of methods that are not there, are left out.
Table without_empty_columns(Table table)
{
    for (std::size_t j = table.columns.size(); j-- > 0;) {
        const auto empty = [j](const std::vector<Cell>& row) {
            return std::holds_alternative<std::monostate>(row[j]) || row[j] == Cell(std::string());
        };
        if (!std::ranges::all_of(table.rows, empty)) continue;
        table.columns.erase(table.columns.begin() + static_cast<std::ptrdiff_t>(j));
        for (std::vector<Cell>& row : table.rows) row.erase(row.begin() + static_cast<std::ptrdiff_t>(j));
    }
    return table;
}

Section rows_section(const SweepReportInput& in, std::size_t all)
{
    Table table = without_empty_columns(in.rows);
    table.title = "Rows";
    if (all > listed_rows) {
        table.notes.push_back(fmt::format("The first {} of {} rows{}.", listed_rows, all,
                                          in.csv.empty() ? "" : "; all are in " + in.csv.filename().string()));
        table.rows.resize(std::min(listed_rows, table.rows.size()));
    }
    return {"Rows",
            {rows_part(std::move(table),
                       {"Level: water above the heel; size: factor on all lengths of the scene; scale: factor on the "
                        "record; polarity -1: its horizontal component is flipped. a_y: ground acceleration at which "
                        "it starts to slide, negative where it slides without an earthquake; critical μ: friction that "
                        "just holds it without one. Slip: at the end, positive downstream; largest: on the way; "
                        "upstream: farthest to that side; −1σ, +1σ: of regressions; ±: what steps, or modes, leave "
                        "open."})},
            Fold::folded};
}

Method method_of(const SweepView& view)
{
    return view.finite_elements() ? Method::finite_elements : Method::rigid_block;
}

/// The scene as given, before the axes change it; with the mesh where there are FE rows.
Section section_of(const Scene& given, const SweepView& view)
{
    const Scene scene = called_for(make_effect_plan(given, method_of(view)), given);
    if (scene.wedge) {
        const RigidWedge wedge = make_rigid_wedge(scene);
        Section section{"Wedge"};
        if (auto drawing = wedge_drawing(scene, wedge)) section.parts.emplace_back(std::move(*drawing));
        section.parts.emplace_back(stereonet(scene, wedge));
        return section;
    }
    const PressureProfile uplift = SeepageSource().uplift_of(scene);
    std::vector<Polyline> mesh;
    if (view.finite_elements()) mesh = dam_mesh_lines(fe2d::build_model(scene, {}).mesh);
    return {"Section", {section_drawing(scene, uplift, mesh)}};
}

std::vector<std::pair<std::string, std::string>> provenance(const SweepReportInput& in, const SweepView& view)
{
    std::vector<std::pair<std::string, std::string>> list{
        {"program", "damslip " + program_version()}, {"methods", fmt::format("{}", fmt::join(view.methods, ", "))}};
    if (in.scene) {
        list.emplace_back("scene", in.scene->file.string());
        list.emplace_back("scene hash", scene_hash(*in.scene));
    }
    if (!in.csv.empty()) list.emplace_back("rows", in.csv.filename().string());
    add_record_provenance(in.records, list);
    return list;
}

/// What is to be known beside the rows.
std::vector<std::string> all_warnings(const SweepReportInput& in, const SweepView& view)
{
    std::vector<std::string> list;
    if (in.scene) {
        if (const std::optional<std::string> rigid_base = base_note(*in.scene); rigid_base && view.finite_elements())
            list.push_back(*rigid_base + ".");
        for (std::string& note : note_texts(in.scene->notes)) list.push_back(std::move(note));
    }
    if (const std::string thinned = thinned_words(view, in.csv); !thinned.empty()) list.push_back(thinned);
    for (std::string& w : warnings(view)) list.push_back(std::move(w));
    for (std::string& w : record_warnings(in.records)) list.push_back(std::move(w));
    return list;
}

/// Choices and seconds of the FE runs.
std::string cost_text(const FeSweepCounts& c)
{
    std::string all;
    for (const std::string& choice : c.choices) all += "  " + choice + "\n";
    const auto runs = static_cast<double>(std::max<std::int64_t>(1, c.runs));
    return all + fmt::format("  set-up {:.2f} s, statics {:.1f} ms a run, earthquakes {:.1f} s\n\n", c.set_up_seconds,
                             1e3 * c.static_seconds / runs, c.dynamic_seconds);
}

} // namespace

Answer sweep_answer(const SweepReportInput& in)
{
    constexpr std::size_t most_compared = 100; // lines that people read
    const SweepView& view = in.view;
    const std::optional<double>& allowable = in.scene->criteria.allowable_slip;
    Answer answer(json_header("sweep", *in.scene));
    answer.headline_in_brief(headline(view, allowable));
    answer.add("rows", in.rows, {.text = false});
    Table rows = in.rows;
    rows.title = rows.rows.size() < view.all() ? fmt::format("The first {} rows", rows.rows.size())
                                              : "Rows, those with the largest slips";
    answer.add("", std::move(rows), {.text = false, .brief = true, .data = false});
    std::vector<std::string> notes;
    if (const std::optional<std::string> note = base_note(*in.scene); note && in.fe) notes.push_back(*note + ".");
    for (std::string& note : note_texts(in.scene->notes)) notes.push_back(std::move(note));
    answer.set("notes", notes);
    if (in.fe) {
        const bool listed = in.compared.rows.size() <= most_compared;
        answer.add("comparison", in.compared, {.text = listed});
        if (!listed)
            answer += fmt::format("FE against the rigid block: {} lines, with --json\n\n", in.compared.rows.size());
        answer.add("counts", count_table(*in.fe), {.data = false});
        answer.set("counts", json_of(count_table(*in.fe))[0]);
        answer += cost_text(*in.fe);
    }
    answer.add("needed", needed_friction_table(view, allowable), {.brief = true, .data = false});
    if (std::optional<Table> rules = opening_water_table(view))
        answer.add("opening_water", std::move(*rules), {.brief = true});
    answer += in.closing;
    for (const std::string& note : all_warnings(in, view)) answer.note_in_brief(note);
    if (!view.finite_elements())
        answer.next(fmt::format("damslip sweep {} --method rigid,fe", in.scene->file.string()));
    return answer;
}

Page sweep_page(const SweepReportInput& in)
{
    const SweepView& view = in.view;
    const std::optional<double> allowable = in.scene ? in.scene->criteria.allowable_slip : std::nullopt;
    const std::string about = "Sliding in an earthquake: sweep over friction and more. ";
    Page page;
    page.title = "Sweep";
    page.subtitle = about + "damslip " + program_version();
    if (in.scene) page = begin_page(*in.scene, about);
    page.headline = headline(view, allowable);
    const std::vector<NeededFriction> needed = needed_frictions(view, allowable);
    const NeededFriction* most = needed.empty() ? nullptr : most_needed(needed, main_method(view));
    if (most) page.key_figures.emplace_back("Friction needed, " + most->method, friction_words(*most, view));
    if (most && most->more)
        page.key_figures.emplace_back("Governed by",
                                      fmt::format("{}, polarity {:+d}", most->record, most->polarity.value_or(1)));
    if (allowable) page.key_figures.emplace_back("Allowable slip", fmt::format("{:.4g} mm", *allowable / mm));
    for (auto& count :
         std::vector<std::pair<std::string, std::string>>{{"Rows", fmt::format("{}", view.all())},
                                                          {"Variants", fmt::format("{}", view.variants.size())},
                                                          {"Frictions", fmt::format("{}", view.frictions.size())},
                                                          {"Records", fmt::format("{}", view.records.size())},
                                                          {"Methods", fmt::format("{}", view.methods.size())}})
        page.key_figures.push_back(std::move(count));
    page.warnings = all_warnings(in, view);
    if (view.rows.empty()) return page;

    if (Table table = needed_friction_table(view, allowable); !table.rows.empty())
        page.sections.push_back({"Friction needed", {rows_part(std::move(table))}});
    page.sections.push_back(friction_section(view, allowable));
    if (auto more = further_variants(view, allowable)) page.sections.push_back(std::move(*more));
    if (auto histories = history_section(view, in.histories)) page.sections.push_back(std::move(*histories));
    page.sections.push_back(variant_section(view, allowable));
    if (std::optional<Table> rules = opening_water_table(view))
        page.sections.push_back({"Water in the opening base", {rows_part(std::move(*rules))}});
    Section methods{"Methods", {rows_part(method_table(view, allowable))}};
    if (auto chart = fe_over_rigid(view)) methods.parts.emplace_back(std::move(*chart));
    if (Chart chart = slip_over_yield_ratio(view); !chart.curves.empty()) methods.parts.emplace_back(std::move(chart));
    if (in.fe)
        for (const Table& table : {in.compared, count_table(*in.fe)})
            methods.parts.push_back(TablePart{table, Layout::rows, 1, Fold::folded});
    page.sections.push_back(std::move(methods));
    page.sections.push_back(rows_section(in, view.all()));
    if (in.scene) {
        page.sections.push_back(section_of(*in.scene, view));
        std::vector<GroundMotion> motions;
        for (const RecordPair& pair : in.records) motions.push_back(ground_motion(*in.scene, pair));
        if (!motions.empty()) page.sections.push_back(records_section(motions, 1));
        page.sections.push_back(limits_section(*in.scene, method_of(view)));
        page.sections.push_back(
            {"Scene", {effect_part(make_effect_plan(*in.scene, method_of(view))), scene_listing(*in.scene)}});
    }
    page.provenance = provenance(in, view);
    return page;
}

} // namespace damslip::pages
