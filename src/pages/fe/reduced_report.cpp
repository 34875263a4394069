#include "pages/fe/reduced_report.hpp"

#include "pages/fe/fe_charts.hpp"
#include "pages/fe/fe_page.hpp"
#include "pages/fe/fe_report.hpp"
#include "pages/scene/open_records.hpp"

#include <cmath>
#include <fmt/format.h>

namespace damslip::pages {

Page reduced_page(const ReducedReportInput& in)
{
    const int modes = in.runs.empty() ? 0 : in.runs.front().result.modes;
    const FePageFrame frame{
        in.scene,
        in.plan,
        in.records,
        in.full.model(),
        nullptr,
        in.uplift,
        fmt::format("finite elements with contact on {} elastic modes of the dam", modes),
        fmt::format(
            "plane-strain finite elements, {} unknowns, {} contact pairs, of the dam's modes {} elastic ones and "
            "the rigid ones; static stages by the full model; rigid block for comparison",
            in.full.model().dofs.count, in.full.structure().pairs(), modes)};
    Page page = begin_fe_page(frame);
    page.warnings.insert(page.warnings.begin(), in.messages.begin(), in.messages.end());
    std::vector<ContactRun> runs;
    std::vector<GroundMotion> motions;
    std::vector<Section> sections;
    for (const ReducedRecord& r : in.runs) {
        runs.push_back(as_contact_run(r));
        if (motions.empty() || motions.back().name != r.motion.name)
            motions.push_back(r.motion); // once for both polarities
        std::optional<sliding::SlideResult> rigid;
        if (in.rigid.state == sliding::StaticState::at_rest)
            rigid = slide_model(in.scene, in.rigid, r.motion, 1, sliding::HistoryOutput::samples);
        Section section{"Record " + runs.back().label(), {}, runs.size() <= open_records ? Fold::open : Fold::folded};
        if (!r.result.message.empty()) section.parts.push_back(Paragraph{r.result.message});
        const RunView view{runs.back(), rigid ? &*rigid : nullptr, in.scene.criteria.allowable_slip,
                           fmt::format("record{}", runs.size()), in.runs.size()};
        if (runs.back().fe.history.time.size() > 1)
            for (Chart& chart : history_charts(view)) section.parts.emplace_back(std::move(chart));
        sections.push_back(std::move(section));
    }
    page.headline = fe_headline(in.scene, runs, "step and modes");
    page.key_figures = fe_key_figures(in.scene, runs);
    std::erase_if(page.key_figures,
                  [](const auto& figure) { return figure.first == "Largest open length"; }); // not kept
    page.key_figures.emplace_back("Elastic modes", fmt::format("{}", modes));
    page.sections.push_back({"Slip", {TablePart{without_seconds(in.table), Layout::rows, 1, Fold::open}}, Fold::open});
    page.sections.push_back(
        {"Static stages", {TablePart{contact_stage_table(runs), Layout::rows, 1, Fold::open}}, Fold::open});
    for (Section& section : sections) page.sections.push_back(std::move(section));
    end_fe_page(frame, motions, {}, page);
    return page;
}

} // namespace damslip::pages
