#include "pages/fe/contact_tables.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string_view>
#include <utility>

namespace damslip::pages {

namespace {

constexpr double force_round_off = 1e-9; ///< of N' before the motion: less is none

/// A force that is the round-off of sums of order `scale` is none [N/m].
double without_round_off(double force, double scale)
{
    return std::abs(force) <= force_round_off * std::abs(scale) ? 0.0 : force;
}

Cell in_mm(double metres)
{
    return std::isfinite(metres) ? Cell(1e3 * metres) : Cell();
}

/// A slip of the run in mm, where its status has one.
Cell slip_cell(const ContactRun& r, double metres)
{
    return in_mm(reported(r.fe.status, metres).value_or(std::numeric_limits<double>::quiet_NaN()));
}

double least(const std::vector<double>& normal_force)
{
    return without_round_off(*std::min_element(normal_force.begin(), normal_force.end()), normal_force.front());
}

double largest(const std::vector<double>& values)
{
    return *std::max_element(values.begin(), values.end());
}

std::int64_t count(std::int64_t n)
{
    return n;
}

Table with_columns(const Table& from, std::initializer_list<std::string_view> keys)
{
    Table t;
    t.title = from.title;
    t.rows.resize(from.rows.size());
    for (const std::string_view key : keys) {
        const auto at =
            std::find_if(from.columns.begin(), from.columns.end(), [&](const Column& c) { return c.key == key; });
        t.columns.push_back(*at);
        for (std::size_t i = 0; i < from.rows.size(); ++i)
            t.rows[i].push_back(from.rows[i][static_cast<std::size_t>(at - from.columns.begin())]);
    }
    return t;
}

const Column record_column{"record", "record", "", 4};
const Column polarity_column{"polarity", "polarity", "", 4};

} // namespace

const std::vector<EnergyTerm>& energy_terms()
{
    using E = fe2d::Energy;
    static const std::vector<EnergyTerm> all{{{"kinetic_J_m", "kinetic", "J/m", 6}, &E::kinetic},
                                             {{"strain_J_m", "strain", "J/m", 6}, &E::strain},
                                             {{"damping_J_m", "damping", "J/m", 6}, &E::damping},
                                             {{"numerical_J_m", "numerical", "J/m", 6}, &E::numerical},
                                             {{"friction_J_m", "friction", "J/m", 6}, &E::friction},
                                             {{"radiated_J_m", "radiated", "J/m", 6}, &E::radiated},
                                             {{"external_J_m", "external", "J/m", 6}, &E::external},
                                             {{"contact_normal_J_m", "contact normal", "J/m", 6}, &E::contact_normal}};
    return all;
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

} // namespace

Table contact_stage_table(const std::vector<ContactRun>& runs)
{
    Table t;
    t.title = "Static stages";
    t.columns = {record_column,
                 polarity_column,
                 {"stage", "stage", "", 4},
                 {"status", "status", "", 4},
                 {"normal_force_kN_m", "N'", "kN/m", 6},
                 {"shear_force_kN_m", "T", "kN/m", 6},
                 {"friction_needed", "critical μ", "–", 6},
                 {"sliding_factor", "FS sliding", "–", 4},
                 {"slip_mm", "mean slip so far", "mm", 4},
                 {"open_length_m", "open", "m", 4},
                 {"slipping_length_m", "slipping", "m", 4}};
    const auto status = [](fe2d::StageStatus s) -> std::string {
        switch (s) {
        case fe2d::StageStatus::ok:
            return "stands";
        case fe2d::StageStatus::slides:
            return "SLIDES";
        case fe2d::StageStatus::floats:
            return "FLOATS";
        case fe2d::StageStatus::overturns:
            return "OVERTURNS";
        case fe2d::StageStatus::not_resolved:
            return "NOT RESOLVED";
        }
        return "";
    };
    const double weight = runs.empty() ? 0.0 : first_normal_force(runs.front());
    const auto row = [&](const std::string& record, const Cell& polarity, const std::string& stage,
                         fe2d::StageStatus end, bool solved, const fe2d::PlaneBalance& b) {
        const double normal = without_round_off(b.resultant.normal_force, weight);
        const auto pressed = [&](double value) { return normal > 0.0 ? Cell(value) : Cell(); };
        const auto found = [&](double value) { return solved ? Cell(value) : Cell(); };
        t.rows.push_back({record, polarity, stage, status(end), normal / 1e3,
                          without_round_off(b.resultant.shear_force, weight) / 1e3, pressed(b.critical_friction),
                          pressed(b.sliding_factor), found(1e3 * b.slip), found(b.open_length),
                          found(b.slipping_length)});
    };
    const auto add = [&](const std::string& record, const Cell& polarity, const fe2d::StageResult& s) {
        const bool solved = s.status == fe2d::StageStatus::ok;
        row(record, polarity, s.name, s.base_fails || s.lifts.empty() ? s.status : base_status(s), solved, s);
        for (const fe2d::PlaneBalance& lift : s.lifts)
            row(record, polarity, s.name + ", " + lift.plane, lift_status(s, lift), solved, lift);
    };
    if (!runs.empty())
        for (const fe2d::StageResult& s : runs.front().fe.stages) add("all", {}, s);
    for (const ContactRun& r : runs)
        if (!r.fe.after.name.empty()) add(r.record, count(r.polarity), r.fe.after);
    t.notes.push_back("after the earthquake: residual friction, ruptured curtain, ineffective drains; slip since the "
                      "start of the stages.");
    return t;
}

Table contact_run_table(const std::vector<ContactRun>& runs, const std::optional<double>& allowable)
{
    Table t;
    const bool gives_way =
        std::any_of(runs.begin(), runs.end(), [](const ContactRun& r) { return r.exact.has_value(); });
    t.title = gives_way ? "Earthquake runs" : "Earthquake runs, exact contact";
    t.columns = {record_column,
                 polarity_column,
                 {"status", "status", "", 4},
                 {"slip_mm", "slip at end (mean of base)", "mm", 5},
                 {"slip_error_mm", "± step", "mm", 2},
                 {"mesh_error_mm", "± mesh", "mm", 2},
                 {"total_error_mm", "± total", "mm", 2},
                 {"error_parts", "error holds", "", 4},
                 {"max_slip_m", "largest slip on the way", "m", 5},
                 {"slip_rigid_mm", "rigid block at end", "mm", 5},
                 {"verdict", "verdict", "", 4},
                 {"steps", "steps", "", 4},
                 {"dt_s", "step", "s", 4},
                 {"unresolved", "unresolved", "", 4},
                 {"residual", "residual", "–", 2},
                 {"energy_error", "energy", "–", 2},
                 {"seconds", "time", "s", 3}};
    for (const ContactRun& r : runs) {
        const auto& s = r.fe.seconds;
        const SlipError error = slip_error(r);
        const std::optional<double> rigid = r.rigid ? reported(r.rigid->status, r.rigid->slip) : std::nullopt;
        const std::optional<double> most = reported(r.fe.status, r.fe.max_slip);
        t.rows.push_back({r.record, count(r.polarity), word(r.fe.status), slip_cell(r, r.fe.slip),
                          slip_cell(r, error.step), slip_cell(r, error.mesh), slip_cell(r, error.total),
                          has_slip(r) ? Cell(error.parts()) : Cell(), most ? Cell(*most) : Cell(),
                          rigid ? Cell(1e3 * *rigid) : Cell(), word(verdict_of(r, allowable)), count(r.fe.counts.steps),
                          r.fe.dt, count(r.fe.counts.unresolved), r.fe.counts.largest_residual, r.fe.energy_error,
                          s.statics + s.dynamics});
    }
    t.notes.push_back(
        "slip: area mean over the base since the static state, positive downstream; ± step: what the time "
        "step leaves open (estimate); ± mesh: change against elements of twice the size.");
    for (std::string& note : error_notes(runs)) t.notes.push_back(std::move(note));
    if (allowable)
        t.notes.push_back(
            fmt::format("verdict: PASS or FAIL where the largest slip ± total lies on one side of the allowable "
                        "{:.4g} mm, of the base and of every lift joint.",
                        1e3 * *allowable));
    t.notes.push_back("polarity -1: the record's horizontal component is flipped.");
    t.notes.push_back("residual: largest complementarity residual over N'; energy: imbalance at the end over the "
                      "largest term; time without the shared set-up.");
    return t;
}

Table answer_part(const Table& run_table)
{
    Table t = with_columns(run_table, {"record", "polarity", "status", "slip_mm", "slip_error_mm", "mesh_error_mm",
                                       "total_error_mm", "error_parts", "max_slip_m", "slip_rigid_mm", "verdict"});
    t.notes.assign(run_table.notes.begin(), run_table.notes.end() - 1);
    return t;
}

Table solution_part(const Table& run_table)
{
    Table t = with_columns(
        run_table, {"record", "polarity", "steps", "dt_s", "unresolved", "residual", "energy_error", "seconds"});
    t.title = "How they were computed";
    t.notes = {run_table.notes.back()};
    return t;
}

Table contact_slip_table(const std::vector<ContactRun>& runs)
{
    Table t;
    t.title = "Slip along the base and rocking";
    t.columns = {record_column,
                 polarity_column,
                 {"slip_mm", "slip at end (mean)", "mm", 5},
                 {"slip_heel_mm", "heel", "mm", 5},
                 {"slip_middle_mm", "middle", "mm", 5},
                 {"slip_toe_mm", "toe", "mm", 5},
                 {"largest_rocking_rad", "rocking", "rad", 3},
                 {"largest_opening_mm", "opening", "mm", 3},
                 {"largest_open_length_m", "open", "m", 4},
                 {"smallest_normal_force_kN_m", "least N'", "kN/m", 4}};
    for (const ContactRun& r : runs) {
        const fe2d::RunHistory& h = r.fe.history;
        if (h.time.empty()) continue;
        const double rocking = *std::max_element(h.rocking.begin(), h.rocking.end(),
                                                 [](double a, double b) { return std::abs(a) < std::abs(b); });
        t.rows.push_back({r.record, count(r.polarity), slip_cell(r, r.fe.slip), slip_cell(r, h.slip_heel.back()),
                          slip_cell(r, h.slip_middle.back()), slip_cell(r, h.slip_toe.back()), rocking,
                          1e3 * largest(h.largest_opening), largest(h.open_length), 1e-3 * least(h.normal_force)});
    }
    t.notes.push_back("slips at the end; rocking, opening and open length: largest on the way, rocking positive where "
                      "the heel opens; N' effective, compression positive.");
    return t;
}

Table contact_lift_table(const std::vector<ContactRun>& runs, const std::optional<double>& allowable)
{
    Table t;
    t.title = "Lift joints";
    t.columns = {record_column,
                 polarity_column,
                 {"plane", "plane", "", 4},
                 {"name", "name", "", 4},
                 {"slip_mm", "slip at end (mean)", "mm", 5},
                 {"slip_error_mm", "± step", "mm", 2},
                 {"mesh_error_mm", "± mesh", "mm", 2},
                 {"total_error_mm", "± total", "mm", 2},
                 {"largest_slip_mm", "largest slip on the way", "mm", 5},
                 {"verdict", "verdict", "", 4},
                 {"largest_rocking_rad", "rocking", "rad", 3},
                 {"largest_opening_mm", "opening", "mm", 3},
                 {"smallest_normal_force_kN_m", "least N'", "kN/m", 4}};
    for (const ContactRun& r : runs)
        for (std::size_t k = 0; k < r.fe.lifts.size(); ++k) {
            const fe2d::LiftResult& lift = r.fe.lifts[k];
            const SlipError error = lift_error(r, k);
            t.rows.push_back({r.record, count(r.polarity), lift.plane, lift.name, slip_cell(r, lift.slip),
                              slip_cell(r, error.step), slip_cell(r, error.mesh), slip_cell(r, error.total),
                              slip_cell(r, lift.largest_slip),
                              word(judge(r.fe.status, lift.largest_slip, error.total, allowable)), lift.largest_rocking,
                              1e3 * lift.largest_opening, 1e-3 * least(r.fe.history.lifts[k].normal_force)});
        }
    t.notes.push_back("of what stands above the joint against what is below; area mean since the static state, "
                      "positive downstream; rocking and opening: largest on the way.");
    return t;
}

Table contact_count_table(const std::vector<ContactRun>& runs)
{
    Table t;
    t.title = "Steps by how the contact was solved";
    t.columns = {record_column,
                 polarity_column,
                 {"steps", "steps", "", 4},
                 {"sub_steps", "sub-steps", "", 4},
                 {"newton", "Newton", "", 4},
                 {"worst_violator", "worst violator", "", 4},
                 {"gauss_seidel", "Gauss-Seidel", "", 4},
                 {"lemke", "Lemke", "", 4},
                 {"unresolved", "unresolved", "", 4},
                 {"halved", "halved", "", 4},
                 {"residual", "residual", "–", 2},
                 {"iterations", "iterations", "", 4},
                 {"largest_iterations", "largest", "", 4},
                 {"factorisations", "factorisations", "", 4},
                 {"bytes", "bytes", "", 4}};
    for (const ContactRun& r : runs) {
        const fe2d::DynamicCounts& c = r.fe.counts;
        const auto path = [&](fe2d::ContactPath p) { return count(c.by_path[static_cast<int>(p)]); };
        t.rows.push_back({r.record, count(r.polarity), count(c.steps), std::int64_t{1} << r.fe.halvings,
                          path(fe2d::ContactPath::newton), path(fe2d::ContactPath::worst_violator),
                          path(fe2d::ContactPath::gauss_seidel), path(fe2d::ContactPath::lemke), count(c.unresolved),
                          count(c.halved), c.largest_residual, count(c.contact_iterations), count(c.largest_iterations),
                          count(c.factorisations), static_cast<std::int64_t>(r.fe.bytes)});
    }
    t.notes.push_back(
        "of the pass that is reported; sub-steps: by step of the record; halved: steps made in two halves "
        "because they were not resolved whole; iterations: linear solutions of the contact problem.");
    return t;
}

Table contact_energy_table(const std::vector<ContactRun>& runs)
{
    Table t;
    t.title = "Energy at the end";
    t.columns = {record_column, polarity_column};
    for (const EnergyTerm& term : energy_terms()) t.columns.push_back(term.column);
    t.columns.push_back({"imbalance_J_m", "imbalance", "J/m", 3});
    t.columns.push_back({"imbalance_share", "of the largest", "–", 2});
    for (const ContactRun& r : runs) {
        if (r.fe.history.energy.empty()) continue;
        std::vector<Cell>& row = t.rows.emplace_back(std::vector<Cell>{r.record, count(r.polarity)});
        for (const EnergyTerm& term : energy_terms()) row.emplace_back(r.fe.history.energy.back().*term.value);
        row.emplace_back(r.fe.history.imbalance.back());
        row.emplace_back(r.fe.energy_error);
    }
    t.notes.push_back(
        "kinetic + strain + damping + numerical + friction + radiated = external + contact normal, since the "
        "static state; what is left is the imbalance.");
    return t;
}

Table contact_law_table(const std::vector<ContactRun>& runs)
{
    Table t;
    t.title = "Error of the contact law";
    t.columns = {record_column,
                 polarity_column,
                 {"slip_mm", "slip", "mm", 5},
                 {"slip_exact_mm", "slip, exact", "mm", 5},
                 {"status_exact", "exact run", "", 4},
                 {"law_error_mm", "error", "mm", 3},
                 {"law_error_percent", "error", "%", 3}};
    for (const ContactRun& r : runs) {
        if (!r.exact) continue;
        const std::optional<double> own = reported(r.fe.status, r.fe.slip),
                                    exact = reported(r.exact->status, r.exact->slip);
        const std::optional<double> error = own && exact ? std::optional(*own - *exact) : std::nullopt;
        t.rows.push_back({r.record, count(r.polarity), slip_cell(r, r.fe.slip), exact ? Cell(1e3 * *exact) : Cell(),
                          word(r.exact->status), error ? Cell(1e3 * *error) : Cell(),
                          error && *exact != 0.0 ? Cell(100.0 * *error / std::abs(*exact)) : Cell()});
    }
    t.notes.push_back("slip without its elastic part; exact: the same run, but pairs that stick do not give way and "
                      "the joint is hard across.");
    return t;
}

} // namespace damslip::pages
