#include "studies/goldgruber_2015/study_page.hpp"

#include "pages/scene/scene_pages.hpp"
#include "pages/sweep/sweep_pages.hpp"
#include "scene/plausible.hpp"
#include "studies/goldgruber_2015/study_charts.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace damslip::study {

using namespace pages;

namespace {

using pages::Section;

/// FE methods of the study, the most accurate first, then the source's settings.
std::vector<std::string> shown_methods(const StudyRows& rows)
{
    std::vector<std::string> methods;
    if (!rows.accurate().empty()) methods.push_back(rows.accurate());
    if (rows.has(chapter_4::source_method)) methods.emplace_back(chapter_4::source_method);
    if (rows.has(chapter_4::radiating_method)) methods.emplace_back(chapter_4::radiating_method);
    return methods;
}

Section histories(const StudyRows& rows, const std::string& figure, const std::string& uplift, double size)
{
    Section section{figure, {}, Fold::open};
    for (const std::string& method : shown_methods(rows))
        section.parts.emplace_back(fe_histories(rows, uplift, size, method));
    return section;
}

Section block_section(const StudyPageInput& in)
{
    Section section{"Figures 4-11 and 4-12: the rigid block", {}, Fold::open};
    section.parts.emplace_back(block_histories(in.rows, "seepage"));
    section.parts.emplace_back(regression_chart(in.regressions));
    return section;
}

GroundMotion study_motion(const StudyPageInput& in)
{
    return ground_motion(in.scene, in.records.front(), 1.0, study_polarity(in.scene));
}

Section yield_section(const StudyPageInput& in)
{
    Section section{"Figures 4-6 and 4-7: yield acceleration of the rigid block", {}, Fold::open};
    section.parts.emplace_back(yield_by_level(in.scene, "curtain"));
    section.parts.emplace_back(yield_by_level(in.scene, "seepage"));
    section.parts.emplace_back(yield_with_vertical(in.scene, "curtain", study_motion(in)));
    return section;
}

/// Both waters and sizes with one uplift by each method.
std::vector<Part> waters_and_sizes(const StudyRows& rows, const std::string& uplift)
{
    std::vector<Part> parts;
    for (const std::string& method : shown_methods(rows)) {
        std::vector<FrictionCurve> curves;
        int colour = 0;
        for (const double size : chapter_4::sizes)
            for (const std::string water : {"acoustic", "westergaard"})
                curves.push_back({fmt::format("{}, {:g} m", water, size * rows.grid().axes.level.front()),
                                  {uplift, water, size, 1.0, method},
                                  size == 1.0 ? Mark::line_and_points : Mark::dashed,
                                  colour++});
        parts.emplace_back(over_friction(rows, fmt::format("Slip by {}, uplift {}", method, uplift), curves));
    }
    return parts;
}

Section curtain_section(const StudyRows& rows)
{
    Section section{"Figure 4-18: with and without curtain, acoustic elements", {}, Fold::open};
    for (const std::string& method : shown_methods(rows)) {
        std::vector<FrictionCurve> curves;
        int colour = 0;
        for (const double size : chapter_4::sizes)
            for (const std::string uplift : {"seepage", "linear"})
                curves.push_back({fmt::format("{}, {:g} m", uplift == "seepage" ? "with curtain" : "without",
                                              size * rows.grid().axes.level.front()),
                                  {uplift, "acoustic", size, 1.0, method},
                                  size == 1.0 ? Mark::line_and_points : Mark::dashed,
                                  colour++});
        section.parts.emplace_back(over_friction(rows, "Slip by " + method, curves));
    }
    return section;
}

Section rigid_against_fe(const StudyRows& rows)
{
    Section section{"Figure 4-19: rigid block against finite elements, 62.5 m, with curtain", {}, Fold::open};
    for (const std::string& method : shown_methods(rows))
        section.parts.emplace_back(over_friction(
            rows, "Slip by " + method + " and by the rigid block",
            {{"rigid block", {"seepage", chapter_4::block_water, 1.0, 1.0, "rigid"}, Mark::line_and_points, -1},
             {"rigid block with vertical",
              {"seepage", chapter_4::block_water, 1.0, 1.0, "rigid-v"},
              Mark::line_and_points,
              -1},
             {"FE, acoustic", {"seepage", "acoustic", 1.0, 1.0, method}, Mark::line_and_points, -1},
             {"FE, Westergaard", {"seepage", "westergaard", 1.0, 1.0, method}, Mark::line_and_points, -1},
             {"FE, Westergaard simplified", {"seepage", chapter_4::block_water, 1.0, 1.0, method}, Mark::dashed, -1}}));
    return section;
}

/// What step, water, joint, damping and contact law change.
Section settings_section(const StudyPageInput& in)
{
    const StudyRows& rows = in.rows;
    Section section{"What each setting changes", {}, Fold::open};
    if (!in.settings.empty()) {
        section.parts.push_back(rows_part(settings_table(in.settings)));
        for (const char* water : {"acoustic", "westergaard"})
            section.parts.emplace_back(settings_chart(in.settings, water));
    }
    for (const double size : chapter_4::sizes) {
        std::vector<FrictionCurve> curves;
        int colour = 0;
        for (const std::string water : {"acoustic", "westergaard"})
            for (const auto& [method, name] :
                 {std::pair{"fe", "step converged"}, std::pair{"fe-whole-steps", "whole steps of the record"},
                  std::pair{chapter_4::source_method, "source's settings"},
                  std::pair{chapter_4::radiating_method, "rock that radiates"}})
                curves.push_back({fmt::format("{}, {}", water, name),
                                  {"seepage", water, size, 1.0, method},
                                  water == "acoustic" ? Mark::line_and_points : Mark::dashed,
                                  colour++});
        section.parts.emplace_back(over_friction(
            rows, fmt::format("Slip, {:g} m, uplift seepage", size * rows.grid().axes.level.front()), curves));
    }
    return section;
}

Section printed_uplift_section(const StudyRows& rows)
{
    Section section{"With the printed uplift, 2/3 of the full pressure at the curtain", {}, Fold::folded};
    section.parts.emplace_back(block_histories(rows, "curtain"));
    for (Part& part : waters_and_sizes(rows, "curtain")) section.parts.push_back(std::move(part));
    return section;
}

pages::Headline headline(const std::vector<Finding>& findings)
{
    const auto count = [&](Holds holds) {
        return std::count_if(findings.begin(), findings.end(),
                             [holds](const Finding& f) { return f.here && f.here->holds == holds; });
    };
    const auto source = [&](Holds holds) {
        return std::count_if(findings.begin(), findings.end(),
                             [holds](const Finding& f) { return f.as_source && f.as_source->holds == holds; });
    };
    std::string text = fmt::format("Of {} printed findings {} hold, {} hold in part and {} do not.",
                                   count(Holds::yes) + count(Holds::partly) + count(Holds::no), count(Holds::yes),
                                   count(Holds::partly), count(Holds::no));
    if (const auto all = source(Holds::yes) + source(Holds::partly) + source(Holds::no); all > 0)
        text += fmt::format(
            " Of the {} on finite elements, with the source's own settings {} hold, {} in part and {} do not.", all,
            source(Holds::yes), source(Holds::partly), source(Holds::no));
    return {text, pages::Outcome::none, ""};
}

std::vector<std::string> warnings(const StudyPageInput& in)
{
    std::vector<std::string> list = note_texts(in.scene.notes);
    list.push_back("The source's pair of records is not published; " + in.records.front().files.name +
                   " stands in for it. Signs, orders and ratios compare; digits do not.");
    if (!in.rows.has("fe"))
        list.emplace_back("The finite elements ran in whole steps of the record. With --method ...,fe they run to the "
                          "default accuracy.");
    for (const SweepRow& r : in.view.rows)
        if (r.unanswered()) list.push_back(fmt::format("{}, μ = {:.2f}: {}", r.method, r.friction, r.status));
    for (std::string& w : record_warnings(in.records)) list.push_back(std::move(w));
    return list;
}

} // namespace

pages::Page study_page(const StudyPageInput& in)
{
    Page page = begin_page(in.scene, "The study of Goldgruber (2015), chapter 4, with our numbers. ");
    page.headline = headline(in.findings);
    page.key_figures = {{"Rows", fmt::format("{}", in.table.rows.size())},
                        {"FE method", in.rows.accurate().empty() ? "none" : in.rows.accurate()}};
    for (const StudyUplift& u : in.uplifts)
        page.key_figures.emplace_back("Stands from μ, uplift " + u.model, fmt::format("{:.4f}", u.critical_friction));
    page.warnings = warnings(in);

    page.sections.push_back({"Findings", {rows_part(findings_table(in.findings))}, Fold::open});
    page.sections.push_back({"Figures 4-1 and 4-2: section and uplift",
                             {section_drawing(in.scene, in.uplifts.front().profile), uplift_chart(in.uplifts),
                              rows_part(uplift_table(in.uplifts))},
                             Fold::open});
    page.sections.push_back(yield_section(in));
    page.sections.push_back(block_section(in));
    if (!in.rows.accurate().empty()) {
        page.sections.push_back({"Tables 4-3 and 4-4: natural frequencies and damping",
                                 {rows_part(modes_table(in.modes, 1.0)), rows_part(modes_table(in.modes, 2.0))},
                                 Fold::open});
        page.sections.push_back(
            histories(in.rows, "Figure 4-13: finite elements, 62.5 m, with curtain", "seepage", 1.0));
        page.sections.push_back(
            histories(in.rows, "Figure 4-14: finite elements, 125 m, with curtain", "seepage", 2.0));
        page.sections.push_back(
            {"Figure 4-15: water models and heights, with curtain", waters_and_sizes(in.rows, "seepage"), Fold::open});
        page.sections.push_back(
            histories(in.rows, "Figure 4-16: finite elements, 62.5 m, without curtain", "linear", 1.0));
        page.sections.push_back(
            histories(in.rows, "Figure 4-17: finite elements, 125 m, without curtain", "linear", 2.0));
        page.sections.push_back(curtain_section(in.rows));
        page.sections.push_back(rigid_against_fe(in.rows));
        page.sections.push_back(settings_section(in));
        page.sections.push_back(printed_uplift_section(in.rows));
    }
    const std::vector<GroundMotion> motions{study_motion(in)};
    page.sections.push_back({"Record", {rows_part(record_table(motions)), spectra(motions, 1)}, Fold::open});
    Table table = in.table;
    table.title = "Rows";
    page.sections.push_back({"Rows", {rows_part(std::move(table))}, Fold::folded});
    page.sections.push_back(
        {"Scene",
         {rows_part(effect_table(make_effect_plan(in.scene, Method::finite_elements))), scene_listing(in.scene)},
         Fold::open});
    page.provenance = scene_provenance(in.scene);
    page.provenance.emplace_back(
        "source", "M. Goldgruber, Nonlinear Seismic Modelling of Concrete Dams, TU Graz 2015, chapter 4");
    add_record_provenance(in.records, page.provenance);
    return page;
}

nlohmann::ordered_json study_json(const StudyPageInput& in)
{
    auto j = json_header("study", in.scene);
    j["findings"] = json_of(findings_table(in.findings));
    j["modes"] = {{"table_4_3", json_of(modes_table(in.modes, 1.0))},
                  {"table_4_4", json_of(modes_table(in.modes, 2.0))}};
    j["settings"] = json_of(settings_table(in.settings));
    j["rows"] = json_of(in.table);
    j["notes"] = note_texts(in.scene.notes);
    return j;
}

} // namespace damslip::study
