#include "analysis/fe/contact_run.hpp"

#include "fe2d/run/earthquake_run.hpp"
#include "scene/planes.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace damslip {

namespace {

Verdict worse(Verdict a, Verdict b)
{
    const auto rank = [](Verdict v) {
        switch (v) {
        case Verdict::fail:
            return 3;
        case Verdict::none:
            return 2;
        case Verdict::undecided:
            return 1;
        case Verdict::pass:
            break;
        }
        return 0;
    };
    return rank(a) >= rank(b) ? a : b;
}

SlipError error_of(double step, double mesh, MeshCheck check)
{
    SlipError error{step, mesh, step};
    if (check == MeshCheck::done) error.total = step + mesh;
    if (check == MeshCheck::no_answer) error.total = std::numeric_limits<double>::quiet_NaN();
    return error;
}

} // namespace

bool would_crack(const ContactRun& r)
{
    const fe2d::CrackFigures& cracks = r.fe.cracks;
    return cracks.stress > r.tensile_strength.value_or(usual_tensile_strength[1]) ||
           std::any_of(cracks.lifts.begin(), cracks.lifts.end(), [](const auto& lift) { return lift.index > 1.0; });
}

const ContactRun* most_tensioned(const std::vector<ContactRun>& runs)
{
    const ContactRun* most = nullptr;
    for (const ContactRun& r : runs)
        if (r.fe.cracks.known && (!most || r.fe.cracks.stress > most->fe.cracks.stress)) most = &r;
    return most;
}

bool has_slip(const ContactRun& r)
{
    return reported(r.fe.status, r.fe.max_slip).has_value();
}

bool all_answered(const std::vector<ContactRun>& runs)
{
    return std::all_of(runs.begin(), runs.end(), [](const ContactRun& r) { return is_answer(r.fe.status); });
}

std::string unanswered_words(const std::vector<ContactRun>& runs)
{
    std::string words;
    for (const ContactRun& r : runs) {
        if (is_answer(r.fe.status)) continue;
        const std::optional<double> at_least = slid_at_least(r.fe.status, r.fe.slip);
        words += fmt::format("{}{}, polarity {:+d} {}{}", words.empty() ? "" : "; ", r.record, r.polarity,
                             word(r.fe.status), at_least ? fmt::format(", slid at least {:.4g} mm", 1e3 * *at_least) : "");
    }
    return words;
}

std::optional<double> slid_at_least(Status status, double slip)
{
    return status == Status::self_excited ? std::optional(std::abs(slip)) : std::nullopt;
}

std::string SlipError::parts() const
{
    if (std::isnan(step)) return "no error estimate";
    const std::string first = modes ? "modes, step" : "step";
    return first + (std::isnan(total) ? ", mesh not known" : std::isnan(mesh) ? " only" : " and mesh");
}

SlipError slip_error(const ContactRun& run)
{
    SlipError error = error_of(run.fe.truncation_error + run.fe.slip_error, run.mesh.base, run.mesh.check);
    error.modes = run.fe.modes > 0;
    return error;
}

SlipError lift_error(const ContactRun& run, std::size_t lift)
{
    const double mesh = run.mesh.check == MeshCheck::done ? run.mesh.lifts[lift] : run.mesh.base;
    return error_of(run.fe.lifts[lift].slip_error, mesh, run.mesh.check);
}

std::vector<std::string> error_notes(const std::vector<ContactRun>& runs)
{
    std::vector<std::string> list;
    for (const ContactRun& r : runs) {
        std::string note = r.mesh.reason;
        if (r.mesh.check == MeshCheck::no_answer) note = r.label() + ": " + note;
        if (has_slip(r) && std::isnan(slip_error(r).step))
            note = "no error estimate: the step is fixed (time.substeps), so nothing tells what it leaves open; there "
                   "is no "
                   "verdict by such a slip";
        if (!note.empty() && std::find(list.begin(), list.end(), note + ".") == list.end()) list.push_back(note + ".");
    }
    return list;
}

bool falls_after(const ContactRun& r)
{
    return !r.fe.after.name.empty() && fails_statically(status_of(r.fe.after.status));
}

bool open_after(const ContactRun& r)
{
    return !r.fe.after.name.empty() && r.fe.after.status == fe2d::StageStatus::not_resolved;
}

Verdict verdict_of(const ContactRun& r, const std::optional<double>& allowable)
{
    if (status_row(r.fe.status).judging == Judging::none) return Verdict::none;
    if (falls_after(r)) return Verdict::fail;
    Verdict verdict = judge(r.fe.status, r.fe.max_slip, slip_error(r).total, allowable);
    for (std::size_t k = 0; k < r.fe.lifts.size(); ++k)
        verdict = worse(verdict, judge(r.fe.status, r.fe.lifts[k].largest_slip, lift_error(r, k).total, allowable));
    if (r.leaves_out) verdict = worse(verdict, Verdict::undecided);
    return open_after(r) ? worse(verdict, Verdict::none) : verdict;
}

Verdict verdict_of(const std::vector<ContactRun>& runs, const std::optional<double>& allowable)
{
    Verdict verdict = runs.empty() ? Verdict::none : Verdict::pass;
    for (const ContactRun& r : runs) verdict = worse(verdict, verdict_of(r, allowable));
    return verdict;
}

bool milder(const ContactRun& a, const ContactRun& b)
{
    const auto severity = [](const ContactRun& r) {
        const int rank = status_row(r.fe.status).judging == Judging::fails && !has_slip(r) ? 2 : has_slip(r) ? 1 : 0;
        return std::pair(rank, rank == 1 ? std::abs(r.fe.max_slip) : 0.0);
    };
    return severity(a) < severity(b);
}

const ContactRun& worst_of(const std::vector<ContactRun>& runs)
{
    return *std::max_element(runs.begin(), runs.end(), milder);
}

int exit_code_of(const std::vector<ContactRun>& runs)
{
    int code = exit_ok;
    for (const ContactRun& r : runs)
        code = worse_exit_code(code, open_after(r) ? exit_no_answer : status_row(r.fe.status).exit_code);
    return code;
}

namespace {

/// A second of 3 m/s² at 3 Hz: the dam slides and rocks, so that the contact solver has its usual work.
GroundMotion trial_motion(double dt)
{
    GroundMotion motion;
    motion.dt = dt;
    const auto steps = static_cast<std::size_t>(std::max(20.0, std::ceil(1.0 / dt)));
    for (std::size_t k = 0; k <= steps; ++k)
        motion.accel_h.push_back(3.0 * std::sin(6.0 * std::numbers::pi * dt * static_cast<double>(k)));
    return motion;
}

void add_parts(const fe2d::EarthquakeRun& model, const fe2d::RunResult& trial, ContactCost& cost)
{
    const fe2d::ContactStructure& structure = model.structure();
    const auto contact = static_cast<std::int64_t>(2 * structure.pairs()),
               dam = static_cast<std::int64_t>(structure.dam_unknowns()),
               rock = static_cast<std::int64_t>(model.model().dofs.count - structure.dam_unknowns()),
               moving = static_cast<std::int64_t>(model.in_motion().dam_unknowns());
    cost.contact_unknowns = contact;
    if (structure.has_rock()) cost.parts.push_back({"rock, condensed exactly", rock, "once", structure.rock_bytes()});
    cost.parts.push_back({"dam at rest, inside eliminated", dam, "once", structure.static_factor().bytes()});
    cost.parts.push_back({model.in_motion().rock_moves() ? "dam and rock in motion, inside eliminated"
                                                         : "dam in motion, inside eliminated",
                          moving, "once a step size, solved every step", trial.bytes});
    cost.parts.push_back({"contact problem, dense", contact, "every step",
                          sizeof(double) * static_cast<std::size_t>(contact * contact)});
}

void add_records(const Ready& ready, double seconds_per_step, ContactCost& cost)
{
    for (const RecordPair& pair : ready.records()) {
        const GroundMotion motion = ready.motion(pair);
        const double dt = ready.scene.time.dt.value_or(motion.dt);
        const auto steps = static_cast<std::int64_t>(
            std::ceil(motion.dt * static_cast<double>(motion.accel_h.size() - 1) / dt - 1e-9));
        cost.records.push_back({pair.files.name, steps, static_cast<double>(steps) * seconds_per_step});
    }
}

} // namespace

ContactCost contact_cost(const Ready& ready)
{
    Scene scene = ready.scene;
    scene.time.substeps = 0;
    const Watch nobody;
    fe2d::RunOptions options = ready.run_options(nobody);
    std::int64_t steps = 0;
    options.progress = [&](const fe2d::RunProgress& p) { // the run-out is of no interest
        steps = p.step;
        return p.step < p.steps ? fe2d::RunAnswer::go_on : fe2d::RunAnswer::stop;
    };
    const fe2d::EarthquakeRun model(scene, options);
    const GroundMotion motion = trial_motion(scene.time.dt.value_or(0.01));
    fe2d::RunResult trial = model.run(motion);
    if (fails_statically(trial.status)) { // costs do not depend on friction: try one that holds
        const double needed = trial.stages.back().critical_friction;
        if (std::isfinite(needed)) {
            Contact holds = base_strength(scene);
            holds.friction = 1.1 * std::max(needed, holds.friction);
            trial = model.run(motion, holds);
        }
    }
    ContactCost cost;
    cost.set_up_seconds = model.seconds();
    if (steps > 0) cost.seconds_per_step = trial.seconds.dynamics / static_cast<double>(steps);
    add_parts(model, trial, cost);
    if (cost.seconds_per_step) add_records(ready, *cost.seconds_per_step, cost);
    return cost;
}

} // namespace damslip
