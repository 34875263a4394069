#include "analysis/fe/contact_cost.hpp"
#include "fe2d/run/earthquake_run.hpp"

#include <algorithm>
#include <cmath>
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
            Contact holds = scene.contact;
            holds.friction = 1.1 * std::max(needed, scene.contact.friction);
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
