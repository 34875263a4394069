#include "pages/fe/fe_pages.hpp"

#include "core/text.hpp"
#include "core/units.hpp"
#include "pages/scene/scene_pages.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <ranges>
#include <utility>

namespace damslip::pages {

namespace {

constexpr double force_round_off = 1e-9; ///< of N' before the motion: less is none

/// A force that is the round-off of sums of order `scale` is none [N/m].
double without_round_off(double force, double scale)
{
    return std::abs(force) <= force_round_off * std::abs(scale) ? 0.0 : force;
}

double least(const std::vector<double>& normal_force)
{
    return without_round_off(*std::ranges::min_element(normal_force), normal_force.front());
}

double largest(const std::vector<double>& values)
{
    return *std::ranges::max_element(values);
}

using ContactColumn = ColumnOf<ContactRun>;

} // namespace

Cell slip_cell(const ContactRun& r, double metres)
{
    const std::optional<double> slip = reported(r.fe.status, metres);
    return slip ? Cell(1e3 * *slip) : Cell();
}

const std::vector<ColumnOf<fe2d::Energy>>& energy_columns()
{
    using E = fe2d::Energy;
    static const std::vector<ColumnOf<E>> all{{{"kinetic_J_m", "kinetic", "J/m", 6}, &E::kinetic},
                                              {{"strain_J_m", "strain", "J/m", 6}, &E::strain},
                                              {{"damping_J_m", "damping", "J/m", 6}, &E::damping},
                                              {{"numerical_J_m", "numerical", "J/m", 6}, &E::numerical},
                                              {{"friction_J_m", "friction", "J/m", 6}, &E::friction},
                                              {{"radiated_J_m", "radiated", "J/m", 6}, &E::radiated},
                                              {{"external_J_m", "external", "J/m", 6}, &E::external},
                                              {{"contact_normal_J_m", "contact normal", "J/m", 6}, &E::contact_normal}};
    return all;
}

std::vector<ColumnOf<fe2d::Energy>> energy_columns_of(const std::vector<fe2d::Energy>& rows)
{
    using E = fe2d::Energy;
    std::vector<ColumnOf<E>> columns = energy_columns();
    const auto any = [&](double E::*term) {
        return std::ranges::any_of(rows, [=](const E& e) { return e.*term != 0.0; });
    };
    const auto add = [&](const char* key, const char* heading, double E::*term, bool shown = false) {
        if (shown || any(term)) columns.push_back({{key, heading, "J/m", 6}, term});
    };
    // A bond that is broken, or a bar that has snapped, stores nothing any more.
    add("joint_stored_J_m", "stored in joints", &E::joint_stored,
        any(&E::bond_fracture) || any(&E::anchor_plastic) || any(&E::anchor_loss));
    add("bond_fracture_J_m", "bond fracture", &E::bond_fracture);
    add("anchor_plastic_J_m", "anchors plastic", &E::anchor_plastic);
    add("anchor_loss_J_m", "anchors snapped", &E::anchor_loss);
    add("joint_water_J_m", "water in joints", &E::joint_water);
    add("impact_J_m", "impact", &E::impact);
    add("floor_J_m", "water on rock", &E::floor);
    return columns;
}

namespace {

/// Of the gravity stage, the scale of round-off in all that follow [N/m].
double first_normal_force(const ContactRun& r)
{
    return r.fe.stages.empty() ? 0.0 : r.fe.stages.front().resultant.normal_force;
}

/// Status of the base in a stage that a lift joint may have ended.
fe2d::StageStatus base_status(const fe2d::StageResult& s)
{
    return s.status == fe2d::StageStatus::not_resolved ? s.status : fe2d::StageStatus::ok;
}

fe2d::StageStatus lift_status(const fe2d::StageResult& s, const fe2d::PlaneBalance& lift)
{
    return s.status == fe2d::StageStatus::not_resolved ? s.status : lift.status;
}

const char* stage_word(fe2d::StageStatus status)
{
    return word_in(status, {{fe2d::StageStatus::ok, "stands"},
                            {fe2d::StageStatus::slides, "SLIDES"},
                            {fe2d::StageStatus::progressive, "BOND BREAKS"},
                            {fe2d::StageStatus::floats, "FLOATS"},
                            {fe2d::StageStatus::overturns, "OVERTURNS"},
                            {fe2d::StageStatus::not_resolved, "NOT RESOLVED"}});
}

/// The base or a lift joint at the end of a stage.
struct StageRow {
    std::string record;
    Cell polarity;
    std::string stage;
    fe2d::StageStatus end;
    bool solved;
    const fe2d::PlaneBalance& plane;
    const fe2d::BondLoad* bond; ///< of the whole stage; null: its bond needed no path, or another plane's row
};

void add_stage(const std::string& record, const Cell& polarity, const fe2d::StageResult& s, std::vector<StageRow>& rows)
{
    const bool solved = s.status == fe2d::StageStatus::ok;
    rows.push_back({record, polarity, s.name, s.base_fails || s.lifts.empty() ? s.status : base_status(s), solved, s,
                    s.bond ? &*s.bond : nullptr});
    for (const fe2d::PlaneBalance& lift : s.lifts)
        rows.push_back({record, polarity, s.name + ", " + lift.plane, lift_status(s, lift), solved, lift, nullptr});
}

} // namespace

Table contact_stage_table(const std::vector<ContactRun>& runs)
{
    using R = StageRow;
    std::vector<R> rows;
    if (!runs.empty())
        for (const fe2d::StageResult& s : runs.front().fe.stages) add_stage("all", {}, s, rows);
    for (const ContactRun& r : runs)
        for (const fe2d::StageResult& s : r.fe.between) add_stage(r.record, r.polarity, s, rows);
    for (const ContactRun& r : runs)
        if (!r.fe.after.name.empty()) add_stage(r.record, r.polarity, r.fe.after, rows);
    const double weight = runs.empty() ? 0.0 : first_normal_force(runs.front());
    const auto normal = [=](const R& r) { return without_round_off(r.plane.resultant.normal_force, weight); };
    const auto shear = [=](const R& r) { return without_round_off(r.plane.resultant.shear_force, weight); };
    const auto if_pressed = [=](double fe2d::PlaneBalance::*value) {
        return [=](const R& r) { return normal(r) > 0.0 ? Cell(r.plane.*value) : Cell(); };
    };
    const auto if_solved = [](double fe2d::PlaneBalance::*value) {
        return [=](const R& r) { return r.solved ? Cell(r.plane.*value) : Cell(); };
    };
    using B = fe2d::PlaneBalance;
    std::vector<ColumnOf<R>> columns{
        {{"record", "record"}, &R::record},
        {{"polarity", "polarity"}, &R::polarity},
        {{"stage", "stage"}, &R::stage},
        {{"status", "status"}, [](const R& r) { return stage_word(r.end); }},
        {{"normal_force_kN_m", "N'", "kN/m", 6}, [=](const R& r) { return normal(r) / 1e3; }},
        {{"shear_force_kN_m", "T", "kN/m", 6}, [=](const R& r) { return shear(r) / 1e3; }},
        {{"friction_needed", "critical μ", "–", 6}, if_pressed(&B::critical_friction)},
        {{"sliding_factor", "FS sliding", "–", 4}, if_pressed(&B::sliding_factor)},
        {{"slip_mm", "mean slip so far", "mm", 4},
         [](const R& r) { return r.solved ? Cell(1e3 * r.plane.slip) : Cell(); }},
        {{"open_length_m", "open", "m", 4}, if_solved(&B::open_length)},
        {{"slipping_length_m", "slipping", "m", 4}, if_solved(&B::slipping_length)}};
    const auto of_bond = [](auto fe2d::BondLoad::*value) {
        return [=](const R& r) { return r.bond ? Cell(r.bond->*value) : Cell(); };
    };
    if (std::ranges::any_of(rows, [](const R& r) { return r.bond != nullptr; })) {
        columns.push_back({{"t_max", "t_max", "–", 4}, of_bond(&fe2d::BondLoad::largest)});
        columns.push_back({{"t_limit", "t_LP", "–", 4}, of_bond(&fe2d::BondLoad::limit)});
        columns.push_back({{"jumps", "jumps"}, of_bond(&fe2d::BondLoad::jumps)});
        columns.push_back({{"jump_loss_J_m", "lost in jumps", "J/m", 4}, of_bond(&fe2d::BondLoad::lost)});
    }
    return table_of<R>("Static stages", columns, rows,
                       {"after the earthquake: cohesion lost where the joint has opened or slipped, friction of the "
                        "path, curtain and drains of the post-seismic combination; slip since the start of the "
                        "stages."});
}

namespace {

constexpr std::ptrdiff_t tied_lift_columns = 4; ///< the last of crack_columns()

std::vector<ContactColumn> crack_columns()
{
    using R = ContactRun;
    using F = fe2d::CrackFigures;
    const auto of_cracks = [](double (*value)(const F&)) {
        return [=](const R& r) { return r.fe.cracks.known ? Cell(value(r.fe.cracks)) : Cell(); };
    };
    const auto of_lift = [](Cell (*value)(const fe2d::TiedLift&)) {
        return [=](const R& r) {
            const auto& lifts = r.fe.cracks.lifts;
            const auto most =
                std::ranges::max_element(lifts, [](const auto& a, const auto& b) { return a.index < b.index; });
            return r.fe.cracks.known && most != lifts.end() ? value(*most) : Cell();
        };
    };
    return {{{"tension_MPa", "largest σ₁", "MPa", 3}, of_cracks([](const F& f) { return 1e-6 * f.stress; })},
            {{"tension_over_strength", "over f_t", "–", 3},
             [](const R& r) {
                 return r.fe.cracks.known && r.tensile_strength ? Cell(r.fe.cracks.stress / *r.tensile_strength) : Cell();
             }},
            {{"tension_x_m", "x", "m", 4}, of_cracks([](const F& f) { return f.at.x; })},
            {{"tension_y_m", "y", "m", 4}, of_cracks([](const F& f) { return f.at.y; })},
            {{"tension_time_s", "at", "s", 4}, of_cracks([](const F& f) { return f.time; })},
            {{"crack_dip_deg", "dip of a crack", "°", 3}, of_cracks([](const F& f) { return -f.angle / units::degree; })},
            {{"tied_lift", "tied lift"}, of_lift([](const fe2d::TiedLift& lift) { return Cell(lift.name); })},
            {{"tied_lift_index", "its index", "–", 3}, of_lift([](const fe2d::TiedLift& lift) { return Cell(lift.index); })},
            {{"tied_lift_x_m", "from its upstream end", "m", 4},
             of_lift([](const fe2d::TiedLift& lift) { return Cell(lift.distance); })},
            {{"tied_lift_time_s", "at", "s", 4}, of_lift([](const fe2d::TiedLift& lift) { return Cell(lift.time); })}};
}

} // namespace

namespace {

using Fe = fe2d::RunResult;

/// Of the run by finite elements: a value, a slip [mm], a count.
auto of_fe(auto Fe::*value)
{
    return [=](const ContactRun& r) { return r.fe.*value; };
}

auto slip_of_fe(double Fe::*metres)
{
    return [=](const ContactRun& r) { return slip_cell(r, r.fe.*metres); };
}

auto counted(auto fe2d::DynamicCounts::*number)
{
    return [=](const ContactRun& r) { return r.fe.counts.*number; };
}

Cell rigid_slip_cell(const ContactRun& r)
{
    return r.rigid ? optional_cell(reported(r.rigid->status, r.rigid->slip), units::mm) : Cell();
}

} // namespace

RunColumns::RunColumns(const std::optional<double>& allowable)
    : status{in_brief({"status", "status"}), [](const ContactRun& r) { return word(r.fe.status); }},
      slip{{"slip_mm", "slip at end (mean of base)", "mm", 5}, slip_of_fe(&Fe::slip)},
      modes_error{{"truncation_error_mm", "± modes", "mm", 2}, slip_of_fe(&Fe::truncation_error)},
      step_error{{"slip_error_mm", "± step", "mm", 2}, slip_of_fe(&Fe::slip_error)},
      mesh_error{{"mesh_error_mm", "± mesh", "mm", 2},
                 [](const ContactRun& r) { return slip_cell(r, slip_error(r).mesh); }},
      total_error{in_brief({"total_error_mm", "± total", "mm", 2}, "±"),
                  [](const ContactRun& r) { return slip_cell(r, slip_error(r).total); }},
      error_parts{in_brief({"error_parts", "error includes"}),
                  [](const ContactRun& r) { return has_slip(r) ? Cell(slip_error(r).parts()) : Cell(); }},
      max_slip{in_brief({"max_slip_m", "largest slip on the way", "m", 5}, "largest slip"),
               [](const ContactRun& r) { return reported(r.fe.status, r.fe.max_slip); }},
      rigid_slip{in_brief({"slip_rigid_mm", "rigid block at end", "mm", 5}, "rigid block"), rigid_slip_cell},
      verdict{in_brief({"verdict", "verdict"}), [=](const ContactRun& r) { return word(verdict_of(r, allowable)); }},
      modes{{"modes", "modes"}, of_fe(&Fe::modes)}, highest_frequency{{"highest_frequency_Hz", "up to", "Hz", 4},
                                                                      of_fe(&Fe::highest_frequency)},
      steps{{"steps", "steps"}, counted(&fe2d::DynamicCounts::steps)}, dt{{"dt_s", "step", "s", 4}, of_fe(&Fe::dt)},
      correction{{"step_correction_mm", "correction", "mm", 3},
                 [](const ContactRun& r) { return r.fe.correction ? Cell(1e3 * r.fe.correction->slip) : Cell(); }},
      corrected_dt{{"corrected_dt_s", "to step", "s", 4},
                   [](const ContactRun& r) { return r.fe.correction ? Cell(r.fe.correction->dt) : Cell(); }},
      unresolved{{"unresolved", "unresolved"}, counted(&fe2d::DynamicCounts::unresolved)},
      residual{{"residual", "residual", "–", 2}, counted(&fe2d::DynamicCounts::largest_residual)},
      energy_error{{"energy_error", "energy", "–", 2}, of_fe(&Fe::energy_error)},
      seconds{{"seconds", "time", "s", 3},
              [](const ContactRun& r) { return r.fe.seconds.statics + r.fe.seconds.dynamics; }},
      slid_at_least{{"walked_at_least_m", "slid at least", "m", 5},
                    [](const ContactRun& r) { return damslip::slid_at_least(r.fe.status, r.fe.slip); }},
      slip_in_words{ranking(slip.column, "slip at end"), [of_slip = slip.value](const ContactRun& r) {
                        const std::optional<double> at_least = damslip::slid_at_least(r.fe.status, r.fe.slip);
                        return at_least ? Cell(fmt::format("at least {:.4g}", 1e3 * *at_least)) : of_slip(r);
                    }}
{
}

Table crack_table(const std::vector<ContactRun>& runs)
{
    const bool tied = std::ranges::any_of(runs, [](const ContactRun& r) { return !r.fe.cracks.lifts.empty(); });
    std::vector<ContactColumn> columns{record_of_run, polarity_of_run};
    for (ContactColumn& column : crack_columns()) columns.push_back(std::move(column));
    if (!tied) columns.erase(columns.end() - tied_lift_columns, columns.end());
    std::vector<std::string> notes{
        "σ₁: largest principal tension away from base, joints and lifts, static state included, mean over about a "
        "characteristic length or over the element, whichever is larger. Dip of a crack across it: positive where it falls downstream."};
    if (tied) notes.push_back("tied lift: the one that comes nearest to its strength, 1 where it would slip or part.");
    return table_of<ContactRun>("Where the concrete comes nearest to cracking", columns,
                                runs | std::views::filter([](const ContactRun& r) { return r.fe.cracks.known; }), notes);
}

std::string crack_words(const ContactRun& r)
{
    const fe2d::CrackFigures& cracks = r.fe.cracks;
    std::string words = fmt::format("σ₁ {:.3g} MPa", 1e-6 * cracks.stress);
    words += r.tensile_strength ? fmt::format(", {:.3g} of f_t,", cracks.stress / *r.tensile_strength) : "";
    return words + fmt::format(" at x {:.3g} m, y {:.3g} m, {:.4g} s", cracks.at.x, cracks.at.y, cracks.time);
}

std::string crack_sentence(const std::vector<ContactRun>& runs)
{
    const ContactRun* most = most_tensioned(runs);
    const std::string open = runs.empty() || runs.front().unsettled_cracks.empty()
                                 ? ""
                                 : fmt::format(" The path of {} is not settled: see Traced cracks.", runs.front().unsettled_cracks);
    if (!most || std::ranges::none_of(runs, would_crack)) return open;
    if (!would_crack(*most)) return " A tied lift would slip or part: see the table of cracking.";
    if (!most->fe.cracks.paths.empty())
        return fmt::format(" The concrete would crack here, too: {}; no traced crack goes there.{}", crack_words(*most), open);
    return fmt::format(" The concrete would crack here: {}{}, where the model has no joint; run  fe  with  crack = "
                       "\"traced\"  in [dam], or with a bonded [[lift_joint]] at elevation_m = {:.3g}.",
                       crack_words(*most),
                       most->tensile_strength ? ""
                                              : fmt::format(", above the {:g} to {:g} MPa of mass concrete (Raphael 1984)",
                                                            1e-6 * usual_tensile_strength[0],
                                                            1e-6 * usual_tensile_strength[1]),
                       most->fe.cracks.at.y);
}

namespace {

bool few_modes(const std::vector<ContactRun>& runs)
{
    return std::ranges::any_of(runs, [](const ContactRun& r) { return r.fe.modes > 0; });
}

std::string run_title(const std::vector<ContactRun>& runs)
{
    const bool gives_way = std::ranges::any_of(runs, [](const ContactRun& r) { return r.exact.has_value(); });
    return fmt::format("Earthquake runs{}{}", few_modes(runs) ? ", reduced" : "", gives_way ? "" : ", exact contact");
}

std::vector<std::string> run_notes(const std::vector<ContactRun>& runs, const std::optional<double>& allowable)
{
    std::vector<std::string> notes{
        fmt::format("slip: area mean over the base since the static state, positive downstream; {}± step: what the time "
                    "step leaves open (estimate); ± mesh: change against elements of twice the size.",
                    few_modes(runs) ? "± modes: what the elastic modes left out change (estimate), " : "")};
    for (std::string& note : error_notes(runs)) notes.push_back(std::move(note));
    if (allowable)
        notes.push_back(
            fmt::format("verdict: PASS or FAIL where the largest slip ± total lies on one side of the allowable "
                        "{:.4g} mm, of the base and of every lift joint.",
                        1e3 * *allowable));
    notes.push_back("polarity -1: the record's horizontal component is flipped.");
    return notes;
}

/// What a run answers: its slip, the parts of its error and the verdict.
std::vector<ContactColumn> answer_columns(const RunColumns& c, const ContactColumn& slip,
                                          const std::vector<ContactRun>& runs)
{
    std::vector<ContactColumn> columns{record_of_run, polarity_of_run, c.status, slip};
    if (few_modes(runs)) columns.push_back(c.modes_error);
    columns.insert(columns.end(),
                   {c.step_error, c.mesh_error, c.total_error, c.error_parts, c.max_slip, c.rigid_slip, c.verdict});
    return columns;
}

} // namespace

Table contact_run_table(const std::vector<ContactRun>& runs, const std::optional<double>& allowable)
{
    const RunColumns c(allowable);
    std::vector<ContactColumn> columns = answer_columns(c, c.slip, runs);
    if (few_modes(runs)) columns.insert(columns.end(), {c.modes, c.highest_frequency});
    columns.insert(columns.end(),
                   {c.steps, c.dt, c.correction, c.corrected_dt, c.unresolved, c.residual, c.energy_error, c.seconds, c.slid_at_least});
    for (ContactColumn& column : crack_columns()) columns.push_back(std::move(column));
    return table_of(run_title(runs), columns, runs);
}

Table run_answer_table(const std::vector<ContactRun>& runs, const std::optional<double>& allowable)
{
    const RunColumns c(allowable);
    return table_of(run_title(runs), answer_columns(c, c.slip_in_words, runs), runs, run_notes(runs, allowable));
}

Table run_solution_table(const std::vector<ContactRun>& runs, bool with_seconds)
{
    const RunColumns c({});
    std::vector<ContactColumn> columns{record_of_run, polarity_of_run};
    if (few_modes(runs)) columns.insert(columns.end(), {c.modes, c.highest_frequency});
    const bool corrected = std::ranges::any_of(runs, [](const ContactRun& r) { return r.fe.correction.has_value(); });
    columns.insert(columns.end(), {c.steps, c.dt});
    if (corrected) columns.insert(columns.end(), {c.correction, c.corrected_dt});
    columns.insert(columns.end(), {c.unresolved, c.residual});
    if (!few_modes(runs)) columns.push_back(c.energy_error);
    if (with_seconds) columns.push_back(c.seconds);
    return table_of("How they were computed", columns, runs,
                    {std::string(corrected ? "correction: of the slip, to smaller steps, by runs on few modes of the dam; " : "") +
                     "residual: largest complementarity residual over N'; energy: imbalance at the end over the largest term" +
                     (with_seconds ? "; time without the shared set-up." : ".")});
}

Table contact_slip_table(const std::vector<ContactRun>& runs)
{
    using R = ContactRun;
    const auto last_of = [](std::vector<double> fe2d::RunHistory::*slips) {
        return [=](const R& r) { return slip_cell(r, (r.fe.history.*slips).back()); };
    };
    const auto rocking = [](const R& r) {
        const std::vector<double>& all = r.fe.history.rocking;
        return *std::ranges::max_element(all, [](double a, double b) { return std::abs(a) < std::abs(b); });
    };
    using H = fe2d::RunHistory;
    return table_of<R>(
        "Slip along the base and rocking",
        {record_of_run,
         polarity_of_run,
         {{"slip_mm", "slip at end (mean)", "mm", 5}, slip_of_fe(&Fe::slip)},
         {{"slip_heel_mm", "heel", "mm", 5}, last_of(&H::slip_heel)},
         {{"slip_middle_mm", "middle", "mm", 5}, last_of(&H::slip_middle)},
         {{"slip_toe_mm", "toe", "mm", 5}, last_of(&H::slip_toe)},
         {{"largest_rocking_rad", "rocking", "rad", 3}, rocking},
         {{"largest_opening_mm", "opening", "mm", 3},
          [](const R& r) { return 1e3 * largest(r.fe.history.largest_opening); }},
         {{"largest_open_length_m", "open", "m", 4}, [](const R& r) { return largest(r.fe.history.open_length); }},
         {{"smallest_normal_force_kN_m", "least N'", "kN/m", 4},
          [](const R& r) { return 1e-3 * least(r.fe.history.normal_force); }}},
        runs | std::views::filter([](const R& r) { return !r.fe.history.slip_heel.empty(); }),
        {"slips at the end; rocking, opening and open length: largest on the way, rocking positive where the heel "
         "opens; N' effective, compression positive."});
}

Table contact_lift_table(const std::vector<ContactRun>& runs, const std::optional<double>& allowable)
{
    struct Row {
        const ContactRun& run;
        std::size_t number;
        const fe2d::LiftResult& lift;
        SlipError error;
    };
    std::vector<Row> rows;
    for (const ContactRun& r : runs)
        for (std::size_t k = 0; k < r.fe.lifts.size(); ++k) rows.push_back({r, k, r.fe.lifts[k], lift_error(r, k)});
    const auto verdict = [&](const Row& r) {
        return word(judge(r.run.fe.status, r.lift.largest_slip, r.error.total, allowable));
    };
    return table_of<Row>(
        "Lift joints",
        {{in_brief({"record", "record"}), [](const Row& r) { return r.run.record; }},
         {in_brief({"polarity", "polarity"}), [](const Row& r) { return r.run.polarity; }},
         {in_brief({"plane", "plane"}), [](const Row& r) { return r.lift.plane; }},
         {in_brief({"name", "name"}), [](const Row& r) { return r.lift.name; }},
         {in_brief({"slip_mm", "slip at end (mean)", "mm", 5}, "slip at end"),
          [](const Row& r) { return slip_cell(r.run, r.lift.slip); }},
         {{"slip_error_mm", "± step", "mm", 2}, [](const Row& r) { return slip_cell(r.run, r.error.step); }},
         {{"mesh_error_mm", "± mesh", "mm", 2}, [](const Row& r) { return slip_cell(r.run, r.error.mesh); }},
         {in_brief({"total_error_mm", "± total", "mm", 2}, "±"),
          [](const Row& r) { return slip_cell(r.run, r.error.total); }},
         {ranking({"largest_slip_mm", "largest slip on the way", "mm", 5}, "largest slip"),
          [](const Row& r) { return slip_cell(r.run, r.lift.largest_slip); }},
         {in_brief({"verdict", "verdict"}), verdict},
         {{"largest_rocking_rad", "rocking", "rad", 3}, [](const Row& r) { return r.lift.largest_rocking; }},
         {{"largest_opening_mm", "opening", "mm", 3}, [](const Row& r) { return 1e3 * r.lift.largest_opening; }},
         {{"smallest_normal_force_kN_m", "least N'", "kN/m", 4},
          [](const Row& r) { return 1e-3 * least(r.run.fe.history.lifts[r.number].normal_force); }}},
        rows,
        {"of what stands above the joint against what is below; area mean since the static state, positive downstream; "
         "rocking and opening: largest on the way."});
}

Table bond_table(const std::vector<ContactRun>& runs)
{
    struct Row {
        const ContactRun& run;
        const fe2d::LiftResult& lift;
        const fe2d::LiftHistory& history;
    };
    std::vector<Row> rows;
    for (const ContactRun& r : runs)
        for (std::size_t k = 0; k < r.fe.lifts.size(); ++k)
            if (r.fe.lifts[k].bond.bonded > 0.0) rows.push_back({r, r.fe.lifts[k], r.fe.history.lifts[k]});
    const auto first = [](const Row& r, const std::vector<double>& length, double least) {
        const auto at = std::ranges::find_if(length, [least](double x) { return x >= least && x > 0.0; });
        return at == length.end() ? Cell() : Cell(r.run.fe.history.time[static_cast<std::size_t>(at - length.begin())]);
    };
    constexpr double all = 1.0 - 1e-9; // of the length: sums round
    return table_of<Row>(
        "Cracks along the lift joints",
        {{{"record", "record"}, [](const Row& r) { return r.run.record; }},
         {{"polarity", "polarity"}, [](const Row& r) { return r.run.polarity; }},
         {{"plane", "plane"}, [](const Row& r) { return r.lift.plane; }},
         {{"name", "name"}, [](const Row& r) { return r.lift.name; }},
         {{"bonded_length_m", "length", "m", 4}, [](const Row& r) { return r.lift.bond.bonded; }},
         {{"damaged_length_m", "damaged", "m", 4}, [](const Row& r) { return r.lift.bond.damaged; }},
         {{"broken_length_m", "broken", "m", 4}, [](const Row& r) { return r.lift.bond.broken; }},
         {{"ligament_m", "ligament", "m", 4}, [](const Row& r) { return r.lift.bond.ligament(); }},
         {{"dip_deg", "dip", "°", 3}, [](const Row& r) { return r.lift.dip / units::degree; }},
         {{"first_damage_s", "first damage", "s", 4}, [=](const Row& r) { return first(r, r.history.damaged, 0.0); }},
         {{"first_broken_s", "first broken", "s", 4}, [=](const Row& r) { return first(r, r.history.broken, 0.0); }},
         {{"cut_s", "cut", "s", 4},
          [=](const Row& r) { return first(r, r.history.broken, all * r.lift.bond.bonded); }},
         {{"largest_opening_mm", "opening", "mm", 3}, [](const Row& r) { return 1e3 * r.lift.largest_opening; }},
         {{"largest_slip_mm", "largest slip", "mm", 4}, [](const Row& r) { return 1e3 * r.lift.largest_slip; }},
         {{"largest_rocking_rad", "rocking", "rad", 3}, [](const Row& r) { return r.lift.largest_rocking; }},
         {{"cut_factor", "FS, full head", "–", 4},
          [](const Row& r) { return std::isnan(r.lift.cut_factor) ? Cell() : Cell(r.lift.cut_factor); }}},
        rows,
        {"damaged: has reached its strength and softened; broken: of it, what carries nothing but friction any more; "
         "ligament: what is not broken; cut: broken from face to face. Dip: positive where the joint falls downstream. FS, full "
         "head: sliding factor of what is above, after the earthquake, with the head of the reservoir or the tailwater in what is "
         "broken."});
}

Table traced_table(const std::vector<TracedCrack>& cracks, const Scene& scene)
{
    struct Row {
        const TracedCrack& crack;
        Polyline path; ///< from its start on
    };
    std::vector<Row> rows;
    for (const TracedCrack& crack : cracks)
        for (const LiftJoint& joint : scene.lift_joints)
            if (joint.name == crack.name) {
                rows.push_back({crack, joint.path});
                if (!crack.from_upstream) std::reverse(rows.back().path.begin(), rows.back().path.end());
            }
    const auto dip = [](Point a, Point b) { return std::atan((a.y - b.y) / (b.x - a.x)) / units::degree; };
    return table_of<Row>(
        "Traced cracks",
        {{in_brief({"name", "name"}), [](const Row& r) { return r.crack.name; }},
         {in_brief({"face", "from"}),
          [](const Row& r) {
              return r.crack.other ? "both faces" : r.crack.from_upstream ? "upstream" : "downstream";
          }},
         {in_brief({"start_y_m", "start", "m", 4}), [](const Row& r) { return r.path.front().y; }},
         {{"end_y_m", "other face", "m", 4}, [](const Row& r) { return r.path.back().y; }},
         {{"start_dip_deg", "dip at start", "°", 3}, [=](const Row& r) { return dip(r.path[0], r.path[1]); }},
         {in_brief({"dip_deg", "dip", "°", 3}), [=](const Row& r) { return dip(r.path.front(), r.path.back()); }},
         {in_brief({"start_time_s", "f_t at", "s", 4}), [](const Row& r) { return r.crack.time; }},
         {{"passes", "passes"}, [](const Row& r) { return r.crack.passes; }},
         {in_brief({"path_change_m", "path ±", "m", 2}), [](const Row& r) { return r.crack.change; }},
         {in_brief({"settled", "settled"}),
          [](const Row& r) {
              const char* const no = r.crack.no_mesh ? "no: no mesh follows it" : "no";
              return r.crack.settled ? "yes" : no;
          }}},
        rows,
        {"dip: positive where the path falls downstream; f_t at: when the concrete came to its strength at the start; "
         "path ±: what drawing the path anew moved of its cracked part at last. How far it has cracked: Cracks along "
         "the lift joints."});
}

Table contact_anchor_table(const std::vector<ContactRun>& runs)
{
    std::vector<AnchorRow> rows;
    for (const ContactRun& r : runs)
        for (const AnchorOutcome& anchor : r.fe.anchors) rows.push_back({r.record, r.polarity, anchor});
    return anchor_run_table(rows);
}

Table contact_event_table(const std::vector<ContactRun>& runs)
{
    std::vector<EventRow> rows;
    for (const ContactRun& run : runs)
        for (std::size_t i = 0; i < run.fe.events.size(); ++i)
            rows.push_back({run.record, run.polarity, run.fe.events[i],
                            run.rigid && i < run.rigid->events.size() ? &run.rigid->events[i] : nullptr});
    const auto of_rigid = [](const EventRow& r) {
        return r.rigid && reported(r.rigid->status, r.rigid->slip) ? Cell(1e3 * r.rigid->change) : Cell();
    };
    return event_run_table(rows, {{{"rigid_slip_of_event_mm", "rigid block, slip of it", "mm", 5}, of_rigid}},
                           "slip: mean of the base, positive downstream, the run to rest after each event included.");
}

Table contact_count_table(const std::vector<ContactRun>& runs)
{
    using R = ContactRun;
    const auto steps_by = [](fe2d::ContactPath path) {
        return [=](const R& r) { return r.fe.counts.by_path[static_cast<int>(path)]; };
    };
    using C = fe2d::DynamicCounts;
    return table_of<R>("Steps by how the contact was solved",
                       {record_of_run,
                        polarity_of_run,
                        {{"steps", "steps"}, counted(&C::steps)},
                        {{"sub_steps", "sub-steps"}, [](const R& r) { return std::int64_t{1} << r.fe.halvings; }},
                        {{"newton", "Newton"}, steps_by(fe2d::ContactPath::newton)},
                        {{"worst_violator", "worst violator"}, steps_by(fe2d::ContactPath::worst_violator)},
                        {{"gauss_seidel", "Gauss-Seidel"}, steps_by(fe2d::ContactPath::gauss_seidel)},
                        {{"lemke", "Lemke"}, steps_by(fe2d::ContactPath::lemke)},
                        {{"unresolved", "unresolved"}, counted(&C::unresolved)},
                        {{"halved", "halved"}, counted(&C::halved)},
                        {{"residual", "residual", "–", 2}, counted(&C::largest_residual)},
                        {{"iterations", "iterations"}, counted(&C::contact_iterations)},
                        {{"largest_iterations", "largest"}, counted(&C::largest_iterations)},
                        {{"factorisations", "factorisations"}, counted(&C::factorisations)},
                        {{"bytes", "bytes"}, of_fe(&Fe::bytes)}},
                       runs,
                       {"of the pass that is reported; sub-steps: by step of the record; halved: steps made in two "
                        "halves because they were not resolved whole; iterations: linear solutions of the contact "
                        "problem."});
}

namespace {

/// What the jumps of the static stages took, those between the events of a sequence included [J/m].
double jump_loss(const ContactRun& run)
{
    double lost = 0.0;
    for (const auto* stages : {&run.fe.stages, &run.fe.between})
        for (const fe2d::StageResult& stage : *stages)
            if (stage.bond) lost += stage.bond->lost;
    return lost;
}

} // namespace

Table contact_energy_table(const std::vector<ContactRun>& runs)
{
    using R = ContactRun;
    std::vector<ContactColumn> columns{record_of_run, polarity_of_run};
    std::vector<fe2d::Energy> ends;
    for (const R& r : runs)
        if (!r.fe.history.energy.empty()) ends.push_back(r.fe.history.energy.back());
    const std::vector<ColumnOf<fe2d::Energy>> terms = energy_columns_of(ends);
    for (const auto& [column, value] : terms)
        columns.push_back({column, [value](const R& r) { return value(r.fe.history.energy.back()); }});
    columns.push_back(
        {{"imbalance_J_m", "imbalance", "J/m", 3}, [](const R& r) { return r.fe.history.imbalance.back(); }});
    columns.push_back({{"imbalance_share", "of the largest", "–", 2}, [](const R& r) { return r.fe.energy_error; }});
    const bool jumped = std::ranges::any_of(runs, [](const R& r) { return jump_loss(r) > 0.0; });
    if (jumped) columns.push_back({{"jump_loss_J_m", "static jumps, apart", "J/m", 6}, jump_loss});
    const bool of_joints = terms.size() > energy_columns().size();
    return table_of("Energy at the end", columns,
                    runs | std::views::filter([](const R& r) { return !r.fe.history.energy.empty(); }),
                    {std::string("kinetic + strain + damping + numerical + friction + radiated") +
                     (of_joints ? " + those of the joints but water's" : "") + " = external + contact normal" +
                     (of_joints ? " + water in joints" : "") +
                     ", since the static state; what is left is the imbalance." +
                     (jumped ? " Static jumps: kinetic energy that damping and waves took where a bond lost its "
                               "equilibrium in a static stage; no part of the balance."
                             : "")});
}

Table run_out_table(const std::vector<ContactRun>& runs)
{
    using R = ContactRun;
    using F = fe2d::RunOutFigures;
    const auto figure = [](double F::*number, double factor = 1.0) {
        return [=](const R& r) { return finite_cell(factor * (r.fe.run_out.*number)); };
    };
    return table_of<R>(
        "After the record",
        {record_of_run,
         polarity_of_run,
         {{"shaking_slip_mm", "slip while shaken", "mm", 5}, figure(&F::slip_shaking, 1e3)},
         {{"run_out_slip_mm", "slip at rest", "mm", 5}, figure(&F::slip_at_rest, 1e3)},
         {{"end_rate_mm_s", "rate at end", "mm/s", 3}, figure(&F::rate, 1e3)},
         {{"thrust_over_friction", "χ", "–", 3}, figure(&F::thrust_over_friction)},
         {{"energy_kept_J_m", "ΔE", "J/m", 3}, figure(&F::energy_kept)},
         {{"hops", "lift-offs"}, [](const R& r) { return r.fe.run_out.lift_offs; }},
         {{"hop_frequency_Hz", "lift-offs", "Hz", 3}, figure(&F::lift_off_frequency)},
         {{"unloaded_share", "unloaded", "–", 3}, figure(&F::unloaded_share)},
         {{"sliding_factor", "FS at rest", "–", 4}, figure(&F::sliding_factor)}},
        runs | std::views::filter([](const R& r) { return !r.fe.history.time.empty(); }),
        {"slip while the ground moved, and with it at rest; χ: work of the static thrust on the slip over that of "
         "friction (1/FS where N' stays as it is; 1 or more with FS > 1: it slides by itself); ΔE: what the dam kept "
         "of "
         "it; lift-offs: times that the whole base was open; unloaded: share of the time with N' below 5 % of its "
         "static "
         "value. Of the run-out; where sliding is self-excited χ, ΔE and unloaded of its last three windows."});
}

Table contact_law_table(const std::vector<ContactRun>& runs)
{
    using R = ContactRun;
    const auto exact_slip = [](const R& r) { return reported(r.exact->status, r.exact->slip); };
    const auto error = [=](const R& r) {
        const std::optional<double> own = reported(r.fe.status, r.fe.slip), exact = exact_slip(r);
        return own && exact ? std::optional(*own - *exact) : std::nullopt;
    };
    const auto in_mm = [](const std::optional<double>& metres) { return metres ? Cell(1e3 * *metres) : Cell(); };
    const auto error_share = [=](const R& r) {
        const std::optional<double> e = error(r);
        return e && *exact_slip(r) != 0.0 ? Cell(100.0 * *e / std::abs(*exact_slip(r))) : Cell();
    };
    return table_of<R>("Error of the contact law",
                       {record_of_run,
                        polarity_of_run,
                        {{"slip_mm", "slip", "mm", 5}, slip_of_fe(&Fe::slip)},
                        {{"slip_exact_mm", "slip, exact", "mm", 5}, [=](const R& r) { return in_mm(exact_slip(r)); }},
                        {{"status_exact", "exact run"}, [](const R& r) { return word(r.exact->status); }},
                        {{"law_error_mm", "error", "mm", 3}, [=](const R& r) { return in_mm(error(r)); }},
                        {{"law_error_percent", "error", "%", 3}, error_share}},
                       runs | std::views::filter([](const R& r) { return r.exact.has_value(); }),
                       {"slip without its elastic part; exact: the same run, but pairs that stick do not give way and "
                        "the joint is hard across."});
}

} // namespace damslip::pages
