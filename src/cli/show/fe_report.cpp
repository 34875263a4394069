#include "cli/show/fe_report.hpp"

#include "cli/show/base_charts.hpp"
#include "cli/show/fe_charts.hpp"
#include "cli/show/fe_page.hpp"
#include "cli/show/open_records.hpp"
#include "core/units.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::cli {

namespace {

using report::Fold;
using report::Layout;
using report::Outcome;
using report::Section;
using report::TablePart;

using units::mm;
constexpr std::size_t stress_records = 4; ///< whose stresses are shown

const ContactRun& worst_of(const std::vector<ContactRun>& runs)
{
    return *std::max_element(runs.begin(), runs.end(), [](const ContactRun& a, const ContactRun& b) {
        return std::abs(a.fe.max_slip) < std::abs(b.fe.max_slip);
    });
}

const ContactRun* find(const std::vector<ContactRun>& runs, auto&& condition)
{
    const auto at = std::find_if(runs.begin(), runs.end(), condition);
    return at == runs.end() ? nullptr : &*at;
}

bool falls_after(const ContactRun& r)
{
    return !r.fe.after.name.empty() && r.fe.after.status != fe2d::StageStatus::ok;
}

TablePart rows(Table table)
{
    return {std::move(table), Layout::rows, 1, Fold::open};
}

struct LiftSlip {
    double slip = 0.0; ///< largest |slip| of the lift joints in all runs [m]
    std::string name;
};

LiftSlip largest_lift_slip(const std::vector<ContactRun>& runs)
{
    LiftSlip largest;
    for (const ContactRun& r : runs)
        for (const fe2d::LiftResult& lift : r.fe.lifts)
            if (lift.largest_slip > largest.slip)
                largest = {lift.largest_slip, lift.name.empty() ? lift.plane : lift.name};
    return largest;
}

std::string slip_sentence(const Scene& scene, const std::vector<ContactRun>& runs, const std::string& error_source)
{
    const ContactRun& worst = worst_of(runs);
    const double slip = std::abs(worst.fe.max_slip);
    std::string out =
        slip < 1e-7
            ? fmt::format("The {} does not slide in {}", sliding_body(scene),
                          runs.size() > 1 ? fmt::format("any of the {} records", runs.size())
                                          : "the record " + worst.record)
            : fmt::format("The {} slides {:.4g} mm at most by finite elements{} (record {})", sliding_body(scene),
                          slip / mm, runs.size() > 1 ? fmt::format(" over {} records", runs.size()) : "", worst.record);
    if (std::isfinite(worst.fe.slip_error) && worst.fe.slip_error > 0.0)
        out += fmt::format(", ± {:.2g} mm {}", worst.fe.slip_error / mm, error_source);
    if (const LiftSlip lift = largest_lift_slip(runs); lift.slip > 1e-7)
        out += fmt::format("; lift joint {} {:.4g} mm", lift.name, lift.slip / mm);
    if (worst.rigid) out += fmt::format("; the rigid block {:.4g} mm", worst.rigid->max_slip / mm);
    if (scene.criteria.allowable_slip)
        out += fmt::format("; allowable: {:.4g} mm", *scene.criteria.allowable_slip / mm);
    return out + ".";
}

Section statics_section(const std::vector<ContactRun>& runs)
{
    return {"Static stages", {rows(contact_stage_table(runs))}, Fold::open};
}

std::vector<std::string> falls_after_earthquake(const std::vector<ContactRun>& runs)
{
    std::vector<std::string> list;
    for (const ContactRun& r : runs)
        if (falls_after(r)) list.push_back(r.record + ": " + r.fe.after.text());
    return list;
}

} // namespace

std::vector<std::pair<std::string, std::string>> fe_key_figures(const Scene& scene, const std::vector<ContactRun>& runs)
{
    std::vector<std::pair<std::string, std::string>> list;
    if (runs.empty()) return list;
    const ContactRun& worst = worst_of(runs);
    const bool failure = fails_statically(worst.fe.status);
    list.emplace_back("Largest slip, FE",
                      failure ? "slides statically" : fmt::format("{:.4g} mm", std::abs(worst.fe.max_slip) / mm));
    list.emplace_back("Rigid block, same record",
                      worst.rigid ? fmt::format("{:.4g} mm", worst.rigid->max_slip / mm) : "slides statically");
    if (scene.criteria.allowable_slip)
        list.emplace_back("Allowable slip", fmt::format("{:.4g} mm", *scene.criteria.allowable_slip / mm));
    list.emplace_back("Friction μ", fmt::format("{:.4g}", scene.contact.friction));
    if (!worst.fe.stages.empty())
        list.emplace_back("Stands without earthquake from μ",
                          fmt::format("{:.4g}", worst.fe.stages.back().friction_needed));
    double open = 0.0;
    for (const ContactRun& r : runs)
        for (const double length : r.fe.history.open_length) open = std::max(open, length);
    list.emplace_back("Largest open length", fmt::format("{:.3g} m", open));
    return list;
}

report::Headline fe_headline(const Scene& scene, const std::vector<ContactRun>& runs, const std::string& error_source)
{
    if (runs.empty()) return {"No earthquake was run.", Outcome::none, "No answer."};
    if (const ContactRun* r =
            find(runs, [](const ContactRun& run) { return fails_statically(run.fe.status); }))
        return {"The dam has no equilibrium without any earthquake. " + r->fe.message, Outcome::fail, "FAIL"};
    if (const ContactRun* r = find(runs, [](const ContactRun& run) { return !is_answer(run.fe.status); }))
        return {r->record + ": " + r->fe.message, Outcome::unresolved, "UNRESOLVED"};

    const std::string sentence = slip_sentence(scene, runs, error_source);
    if (const ContactRun* r = find(runs, falls_after))
        return {sentence + " After the earthquake it does not stand: " + r->fe.after.text(), Outcome::fail, "FAIL"};
    if (const ContactRun* r =
            find(runs, [](const ContactRun& run) { return run.fe.status == Status::sliding_at_end; }))
        return {sentence + " " + r->record + ": " + r->fe.message, Outcome::fail, "FAIL"};
    if (!scene.criteria.allowable_slip) return {sentence, Outcome::none, "No criterion for the slip."};
    const double allowable = *scene.criteria.allowable_slip, slip = std::abs(worst_of(runs).fe.max_slip),
                 error = worst_of(runs).fe.slip_error;
    if (slip > allowable || largest_lift_slip(runs).slip > allowable) return {sentence, Outcome::fail, "FAIL"};
    if (std::isfinite(error) && slip + error > allowable)
        return {sentence, Outcome::unresolved, "Within what the time step leaves open."};
    return {sentence, Outcome::pass, "PASS"};
}

FeReport::FeReport(const Input& input) : in_(input), stresses_(input.model) {}

void FeReport::add(const ContactRun& run, const GroundMotion& motion)
{
    motions_.push_back(motion);
    Section section{"Record " + run.record, {}, motions_.size() <= open_records ? Fold::open : Fold::folded};
    if (!run.fe.message.empty()) section.parts.push_back(report::Paragraph{run.fe.message});
    if (run.fe.history.time.size() < 2 || run.fe.history.by_pair.pairs == 0) {
        sections_.push_back(std::move(section));
        return;
    }
    std::optional<sliding::SlideResult> rigid;
    if (in_.rigid.state == sliding::StaticState::at_rest)
        rigid = slide_model(in_.scene, in_.rigid, motion, 1, sliding::HistoryOutput::samples);
    const RunView view{run, rigid ? &*rigid : nullptr, in_.scene.criteria.allowable_slip,
                       fmt::format("record{}", motions_.size()), in_.records.size()};
    for (report::Chart& chart : history_charts(view)) section.parts.emplace_back(std::move(chart));
    section.parts.emplace_back(base_states(view));
    for (report::Chart& chart : base_charts(view)) section.parts.emplace_back(std::move(chart));
    sections_.push_back(std::move(section));
    if (stress_records_ < stress_records) {
        ++stress_records_;
        stresses_.add(run.record, run.fe);
    }
}

report::Page FeReport::page(const std::vector<ContactRun>& runs, const std::vector<Table>& tables,
                            const std::vector<std::string>& messages) const
{
    const FePageFrame frame{in_.scene,
                            in_.plan,
                            in_.records,
                            in_.model.model(),
                            in_.model.water() ? &in_.model.water()->water : nullptr,
                            in_.uplift,
                            "finite elements with contact",
                            fmt::format("plane-strain finite elements, {} unknowns, {} contact pairs; rigid block for "
                                        "comparison with events located exactly",
                                        in_.model.model().dofs.count, in_.model.structure().pairs())};
    report::Page page = begin_fe_page(frame);
    page.headline = fe_headline(in_.scene, runs);
    page.key_figures = fe_key_figures(in_.scene, runs);
    std::vector<std::string> warnings = messages;
    for (std::string& w : falls_after_earthquake(runs)) warnings.push_back(std::move(w));
    page.warnings.insert(page.warnings.begin(), warnings.begin(), warnings.end());

    Section slip{"Slip", {rows(without_seconds(contact_run_table(runs))), rows(contact_slip_table(runs))}, Fold::open};
    if (!in_.scene.lift_joints.empty()) slip.parts.push_back(rows(contact_lift_table(runs)));
    page.sections.push_back(std::move(slip));
    page.sections.push_back(statics_section(runs));
    if (!stresses_.empty()) {
        report::MeshView view = stresses_.view();
        if (motions_.size() > stress_records_)
            view.note += fmt::format(" The first {} of {} records.", stress_records_, motions_.size());
        page.sections.push_back({"Stresses", {std::move(view)}, Fold::open});
    }
    for (const Section& section : sections_) page.sections.push_back(section);
    end_fe_page(frame, motions_, tables, page);
    return page;
}

} // namespace damslip::cli
