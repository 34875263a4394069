#include "cli/show/contact_tables.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::cli {

Table contact_stage_table(const std::vector<ContactRun>& runs)
{
    Table t;
    t.title = "Static stages";
    t.columns = {{"record", "record", "", 4},
                 {"stage", "stage", "", 4},
                 {"status", "status", "", 4},
                 {"normal_force_kN_m", "N'", "kN/m", 6},
                 {"shear_force_kN_m", "T", "kN/m", 6},
                 {"friction_needed", "critical μ", "–", 6},
                 {"sliding_factor", "FS sliding", "–", 4},
                 {"slip_mm", "slip", "mm", 4},
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
    const auto row = [&](const std::string& record, const std::string& stage, fe2d::StageStatus end,
                         const fe2d::PlaneBalance& b) {
        t.rows.push_back({record, stage, status(end), b.resultant.normal_force / 1e3, b.resultant.shear_force / 1e3,
                          b.friction_needed, b.sliding_factor, 1e3 * b.slip, b.open_length, b.slipping_length});
    };
    const auto add = [&](const std::string& record, const fe2d::StageResult& s) {
        row(record, s.name, s.base_fails || s.lifts.empty() ? s.status : fe2d::StageStatus::ok, s);
        for (const fe2d::PlaneBalance& lift : s.lifts) row(record, s.name + ", " + lift.plane, lift.status, lift);
    };
    if (!runs.empty())
        for (const fe2d::StageResult& s : runs.front().fe.stages) add("all", s);
    for (const ContactRun& r : runs)
        if (!r.fe.after.name.empty()) add(r.record, r.fe.after);
    t.notes.push_back("after the earthquake: residual friction, ruptured curtain, ineffective drains; slip since the "
                      "start of the stages.");
    return t;
}

Table contact_run_table(const std::vector<ContactRun>& runs)
{
    Table t;
    const bool gives_way =
        std::any_of(runs.begin(), runs.end(), [](const ContactRun& r) { return r.exact.has_value(); });
    t.title = gives_way ? "Earthquake runs" : "Earthquake runs, exact contact";
    t.columns = {{"record", "record", "", 4},
                 {"status", "status", "", 4},
                 {"slip_mm", "slip FE", "mm", 5},
                 {"slip_error_mm", "± step", "mm", 2},
                 {"max_slip_m", "largest slip", "m", 5},
                 {"slip_rigid_mm", "slip rigid", "mm", 5},
                 {"steps", "steps", "", 4},
                 {"dt_s", "step", "s", 4},
                 {"unresolved", "unresolved", "", 4},
                 {"residual", "residual", "–", 2},
                 {"energy_error", "energy", "–", 2},
                 {"seconds", "time", "s", 3}};
    for (const ContactRun& r : runs) {
        const auto& s = r.fe.seconds;
        t.rows.push_back({r.record, word(r.fe.status), 1e3 * r.fe.slip, 1e3 * r.fe.slip_error, r.fe.max_slip,
                          r.rigid ? Cell(1e3 * r.rigid->slip) : Cell(), static_cast<std::int64_t>(r.fe.counts.steps),
                          r.fe.dt, static_cast<std::int64_t>(r.fe.counts.unresolved), r.fe.counts.largest_residual,
                          r.fe.energy_error, s.statics + s.dynamics});
    }
    t.notes.push_back("slip: area mean over the base at the end, since the static state, positive downstream; ± step: "
                      "what the time step leaves open (estimate).");
    t.notes.push_back("residual: largest complementarity residual over N'; energy: imbalance at the end over the "
                      "largest term; time without the shared set-up.");
    return t;
}

Table contact_slip_table(const std::vector<ContactRun>& runs)
{
    Table t;
    t.title = "Slip along the base and rocking";
    t.columns = {{"record", "record", "", 4},
                 {"slip_mm", "slip", "mm", 5},
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
        const auto largest = [](const std::vector<double>& v) { return *std::max_element(v.begin(), v.end()); };
        const double rocking = *std::max_element(h.rocking.begin(), h.rocking.end(),
                                                 [](double a, double b) { return std::abs(a) < std::abs(b); });
        t.rows.push_back({r.record, 1e3 * r.fe.slip, 1e3 * h.slip_heel.back(), 1e3 * h.slip_middle.back(),
                          1e3 * h.slip_toe.back(), rocking, 1e3 * largest(h.largest_opening), largest(h.open_length),
                          1e-3 * *std::min_element(h.normal_force.begin(), h.normal_force.end())});
    }
    t.notes.push_back("slips at the end; rocking, opening and open length: largest on the way, rocking positive where "
                      "the heel opens.");
    return t;
}

Table contact_lift_table(const std::vector<ContactRun>& runs)
{
    Table t;
    t.title = "Lift joints";
    t.columns = {{"record", "record", "", 4},
                 {"plane", "plane", "", 4},
                 {"name", "name", "", 4},
                 {"slip_mm", "slip", "mm", 5},
                 {"largest_slip_mm", "largest slip", "mm", 5},
                 {"largest_rocking_rad", "rocking", "rad", 3},
                 {"largest_opening_mm", "opening", "mm", 3},
                 {"smallest_normal_force_kN_m", "least N'", "kN/m", 4}};
    for (const ContactRun& r : runs)
        for (std::size_t k = 0; k < r.fe.lifts.size(); ++k) {
            const fe2d::LiftResult& lift = r.fe.lifts[k];
            const std::vector<double>& normal = r.fe.history.lifts[k].normal_force;
            t.rows.push_back({r.record, lift.plane, lift.name, 1e3 * lift.slip, 1e3 * lift.largest_slip,
                              lift.largest_rocking, 1e3 * lift.largest_opening,
                              1e-3 * *std::min_element(normal.begin(), normal.end())});
        }
    t.notes.push_back("of what stands above the joint against what is below; area mean at the end, since the static "
                      "state, positive downstream; slip, rocking and opening: largest on the way.");
    return t;
}

Table contact_count_table(const std::vector<ContactRun>& runs)
{
    Table t;
    t.title = "Steps by how the contact was solved";
    t.columns = {{"record", "record", "", 4},
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
        const auto path = [&](fe2d::ContactPath p) {
            return static_cast<std::int64_t>(c.by_path[static_cast<int>(p)]);
        };
        t.rows.push_back({r.record, static_cast<std::int64_t>(c.steps), std::int64_t{1} << r.fe.halvings,
                          path(fe2d::ContactPath::newton), path(fe2d::ContactPath::worst_violator),
                          path(fe2d::ContactPath::gauss_seidel), path(fe2d::ContactPath::lemke),
                          static_cast<std::int64_t>(c.unresolved), static_cast<std::int64_t>(c.halved),
                          c.largest_residual, static_cast<std::int64_t>(c.contact_iterations),
                          static_cast<std::int64_t>(c.largest_iterations), static_cast<std::int64_t>(c.factorisations),
                          static_cast<std::int64_t>(r.fe.bytes)});
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
    t.columns = {{"record", "record", "", 4},
                 {"kinetic_J_m", "kinetic", "J/m", 5},
                 {"strain_J_m", "strain", "J/m", 5},
                 {"damping_J_m", "damping", "J/m", 5},
                 {"numerical_J_m", "numerical", "J/m", 5},
                 {"friction_J_m", "friction", "J/m", 5},
                 {"external_J_m", "external", "J/m", 5},
                 {"contact_normal_J_m", "contact normal", "J/m", 5},
                 {"imbalance_J_m", "imbalance", "J/m", 3},
                 {"imbalance_share", "of the largest", "–", 2}};
    for (const ContactRun& r : runs) {
        if (r.fe.history.energy.empty()) continue;
        const fe2d::Energy& e = r.fe.history.energy.back();
        t.rows.push_back({r.record, e.kinetic, e.strain, e.damping, e.numerical, e.friction, e.external,
                          e.contact_normal, r.fe.history.imbalance.back(), r.fe.energy_error});
    }
    return t;
}

Table contact_law_table(const std::vector<ContactRun>& runs)
{
    Table t;
    t.title = "Error of the contact law";
    t.columns = {{"record", "record", "", 4},
                 {"slip_mm", "slip", "mm", 5},
                 {"slip_exact_mm", "slip, exact", "mm", 5},
                 {"status_exact", "exact run", "", 4},
                 {"law_error_mm", "error", "mm", 3},
                 {"law_error_percent", "error", "%", 3}};
    for (const ContactRun& r : runs) {
        if (!r.exact) continue;
        const double error = r.fe.slip - r.exact->slip;
        t.rows.push_back({r.record, 1e3 * r.fe.slip, 1e3 * r.exact->slip, word(r.exact->status), 1e3 * error,
                          r.exact->slip != 0.0 ? Cell(100.0 * error / std::abs(r.exact->slip)) : Cell()});
    }
    t.notes.push_back("slip without its elastic part; exact: the same run, but pairs that stick do not give way and "
                      "the joint is hard across.");
    return t;
}

} // namespace damslip::cli
