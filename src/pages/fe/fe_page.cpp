#include "pages/fe/fe_page.hpp"

#include "analysis/prepare/contact_law.hpp"
#include "pages/fe/fe_output.hpp"
#include "pages/fe/mesh_drawing.hpp"
#include "pages/scene/limits.hpp"
#include "pages/scene/record_charts.hpp"
#include "pages/scene/report_provenance.hpp"
#include "pages/scene/section_drawing.hpp"

#include <algorithm>

namespace damslip::pages {

Page begin_fe_page(const FePageFrame& in)
{
    const std::optional<std::string> first = in.slides ? base_note(in.scene) : std::nullopt;
    Page page = begin_page(in.scene, "Sliding in an earthquake: " + in.kind + ". " + (first ? *first + ". " : ""),
                           in.plan.scene_hash);
    page.warnings = record_warnings(in.records);
    page.sections.push_back(
        {"Section", {section_drawing(in.scene, in.uplift, dam_mesh_lines(in.model.mesh))}, Fold::open});
    return page;
}

void end_fe_page(const FePageFrame& in, const std::vector<GroundMotion>& motions, const std::vector<Table>& tables,
                 Page& page)
{
    if (!motions.empty())
        page.sections.push_back({"Records", {record_part(record_table(motions)), spectra(motions, 1)}, Fold::open});
    Section model{"Model and solution",
                  {effect_part(in.plan),
                   rows_part(count_table(in.model.counts, in.water),
                             {"Elements and unknowns by what they are for; non-zeros: stored entries of stiffness and "
                              "mass that would not be there without it; bytes: of what is stored for it."})},
                  Fold::open};
    for (const Table& table : tables) model.parts.push_back(rows_part(table));
    page.sections.push_back(std::move(model));
    page.sections.push_back(limits_section(in.scene, Method::finite_elements));
    page.sections.push_back({"Scene", {scene_listing(in.scene)}, Fold::open});
    page.provenance = scene_provenance(in.scene, in.plan.scene_hash);
    page.provenance.emplace_back("method", in.method);
    add_record_provenance(in.records, page.provenance);
}

std::vector<Section> add_worse_polarities(const std::vector<ContactRun>& runs, std::vector<Section> sections,
                                          Page& page)
{
    std::vector<Section> others;
    std::size_t shown = 0;
    for (std::size_t i = 0; i < sections.size(); ++i) {
        const bool worst = std::none_of(runs.begin(), runs.end(), [&](const ContactRun& r) {
            return r.record == runs[i].record && (milder(runs[i], r) || (!milder(r, runs[i]) && &r < &runs[i]));
        });
        if (worst) {
            sections[i].fold = shown++ < open_records ? Fold::open : Fold::folded;
            page.sections.push_back(std::move(sections[i]));
            continue;
        }
        sections[i].title = "Appendix: " + sections[i].title;
        sections[i].fold = Fold::folded;
        others.push_back(std::move(sections[i]));
    }
    return others;
}

Table without_seconds(Table table)
{
    const auto at = std::find_if(table.columns.begin(), table.columns.end(),
                                 [&](const Column& column) { return column.key == "seconds"; });
    if (at == table.columns.end()) return table;
    const auto k = at - table.columns.begin();
    table.columns.erase(at);
    for (std::vector<Cell>& row : table.rows) row.erase(row.begin() + k);
    for (std::string& note : table.notes)
        if (const auto end = note.find("; time without"); end != std::string::npos) note = note.substr(0, end) + ".";
    std::erase_if(table.notes, [](const std::string& note) { return note.starts_with("time without"); });
    return table;
}

} // namespace damslip::pages
