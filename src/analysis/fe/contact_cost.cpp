#include "analysis/fe/contact_cost.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

namespace damslip {

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

Table part_table(const fe2d::EarthquakeRun& model, const fe2d::RunResult& trial)
{
    const fe2d::ContactStructure& structure = model.structure();
    const auto contact = static_cast<std::int64_t>(2 * structure.pairs());
    const auto rock = static_cast<std::int64_t>(model.model().dofs.count - structure.dam_unknowns());
    Table t;
    t.title = "Contact run";
    t.columns = {{"part", "part", "", 4},
                 {"unknowns", "unknowns", "", 4},
                 {"become", "become", "", 4},
                 {"made", "made", "", 4},
                 {"bytes", "bytes", "", 4}};
    const auto add = [&](std::string part, std::int64_t unknowns, std::string made, std::size_t bytes) {
        t.rows.push_back({std::move(part), unknowns, contact, std::move(made), static_cast<std::int64_t>(bytes)});
    };
    const auto dam = static_cast<std::int64_t>(structure.dam_unknowns());
    if (structure.has_rock()) add("rock, condensed exactly", rock, "once", structure.rock_bytes());
    add("dam at rest, inside eliminated", dam, "once", structure.static_factor().bytes());
    const auto moving = static_cast<std::int64_t>(model.in_motion().dam_unknowns());
    const char* in_motion = model.in_motion().rock_moves() ? "dam and rock in motion, inside eliminated"
                                                           : "dam in motion, inside eliminated";
    add(in_motion, moving, "once a step size, solved every step", trial.bytes);
    add("contact problem, dense", contact, "every step", sizeof(double) * static_cast<std::size_t>(contact * contact));
    t.notes.push_back("the contact problem's bytes are its matrix V, which the motion of the dam holds already.");
    return t;
}

Table record_table(const Ready& ready, double seconds_per_step)
{
    Table t;
    t.title = "Estimate by record";
    t.columns = {{"record", "record", "", 4},
                 {"steps", "steps", "", 4},
                 {"pass_seconds", "one pass", "s", 2},
                 {"least_seconds", "run", "s", 2}};
    t.notes.push_back("run: two passes, whole and half steps; each halving more that the slip asks for costs twice the "
                      "one before.");
    for (const RecordPair& pair : ready.records()) {
        const GroundMotion motion = ready.motion(pair);
        const double dt = ready.scene.time.dt.value_or(motion.dt);
        const auto steps = static_cast<std::int64_t>(
            std::ceil(motion.dt * static_cast<double>(motion.accel_h.size() - 1) / dt - 1e-9));
        const double pass = static_cast<double>(steps) * seconds_per_step;
        t.rows.push_back({pair.files.name, steps, pass, 3 * pass});
    }
    return t;
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
            Contact holds = scene.contact;
            holds.friction = 1.1 * std::max(needed, scene.contact.friction);
            trial = model.run(motion, holds);
        }
    }
    ContactCost cost;
    cost.set_up_seconds = model.seconds();
    if (steps > 0) cost.seconds_per_step = trial.seconds.dynamics / static_cast<double>(steps);
    cost.parts = part_table(model, trial);
    if (cost.seconds_per_step) cost.records = record_table(ready, *cost.seconds_per_step);
    return cost;
}

} // namespace damslip
