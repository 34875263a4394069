#include "analysis/fe/tied_runs.hpp"

#include "analysis/prepare/ready.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/parallel.hpp"
#include "fe2d/rock/radiating_rock.hpp"
#include "fe2d/rock/reduced_rock.hpp"
#include "fe2d/time/central_difference.hpp"
#include "fe2d/time/integrate.hpp"
#include "fe2d/time/modal_run.hpp"
#include "fe2d/time/structure_system.hpp"
#include "scene/rock_mass.hpp"
#include "scene/water.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace damslip {

namespace {

fe2d::History integrate_by(TimeScheme scheme, const fe2d::Model& model, const GroundMotion& motion,
                           const fe2d::TiedRunOptions& options)
{
    if (scheme == TimeScheme::central_difference) return fe2d::integrate_explicit(model, motion, options);
    if (scheme == TimeScheme::modal) return fe2d::integrate_modal(model, motion, options);
    return fe2d::integrate(model, motion, options);
}

/// Static loads and where they leave the dam, on the unknowns of TiedModels::moving().
fe2d::HeldStart start_of(const TiedModels& models, const Eigen::VectorXd& load, const fe2d::StaticSolution& statics)
{
    if (!models.on_free_edges) return {{}, load};
    const Eigen::VectorXd rest =
        statics.stages.empty() ? Eigen::VectorXd::Zero(load.size()) : statics.stages.back().elastic;
    return fe2d::held_edges(models.still, *models.on_free_edges, rest, load);
}

fe2d::ModelOptions model_options(const Ready& ready)
{
    fe2d::ModelOptions options = ready.model_options();
    if (ready.scene.time.scheme == TimeScheme::central_difference) options.mass = fe2d::MassKind::lumped;
    return options;
}

std::string rock_note(const fe2d::RadiatingRock& radiating)
{
    const fe2d::ReductionReport& report = radiating.rock.report;
    return fmt::format(
        "radiating rock: {} modes of a box of {} unknowns, waves up to {:.3g} Hz, error of the reduction "
        "{:.2g} %{}",
        report.modes, report.unknowns, radiating.resolved / (2.0 * std::numbers::pi), 100.0 * report.error,
        radiating.rock.floor > 0 ? "; the water's floor is on it" : "");
}

} // namespace

TiedModels::TiedModels(const Scene& scene, const fe2d::ModelOptions& options) : still(fe2d::build_model(scene, options))
{
    if (!rock_is_boxed(scene)) return;
    massless = fe2d::build_model(with_massless_rock(scene), options);
    fe2d::ModelOptions free = options;
    free.edges = fe2d::RockEdges::free;
    if (rock_edges_are_viscous(scene)) on_free_edges = fe2d::build_model(scene, free);
}

TiedRuns::TiedRuns(const Ready& ready, const FeOptions& options, Watch& watch)
    : ready_(ready), watch_(watch), polarity_(options.polarity),
      models_(ready.scene, model_options(ready))
{
    const Scene& scene = ready.scene;
    if (!scene.motion.sequence.empty())
        refuse(scene.file, "--base tied with motion.sequence.",
               "each record alone: a dam that is tied keeps nothing of an earthquake",
               "delete sequence in [motion], or run without --base tied");
    if (is_acoustic(scene)) water_ = fe2d::build_fluid(scene);
    if (rock_radiates(scene))
        radiating_ = fe2d::radiating_rock_of(scene, model().mesh, model().mesh.contact.rock_nodes,
                                             ready.wave_frequency(), cache_folder());
    if (radiating_ && !radiating_->rock.report.passed())
        throw NotConverged(Diagnostic{scene.file.string(), 0, 0, text_of(radiating_->rock.report.missed_gate()),
                                      "a run on rock that is right", "or write  mass = \"massless\""});
    fe2d::StaticLoads loads = fe2d::static_loads(scene, model());
    if (scene.stages.pore_pressure != PorePressure::none)
        loads.impounding.push_back({"water in the rock", rock_water_load(scene, model()), Eigen::Vector2d::Zero()});
    statics_ = fe2d::solve_static(scene, model(), loads);
    if (!statics_.solver.ok())
        throw NotConverged(Diagnostic{scene.file.string(), 0, 0,
                                      "the static stages could not be solved: " + text_of(statics_.solver.note()),
                                      "a model held by its foundation", "check [foundation] and the materials"});
    const int unknowns = model().dofs.count;
    start_ =
        start_of(models_, fe2d::sum_of(loads.gravity, unknowns) + fe2d::sum_of(loads.impounding, unknowns), statics_);
}

std::vector<TiedRun> TiedRuns::run(const TakeRun& take)
{
    std::vector<TiedRun> runs;
    const std::vector<MotionName> names = motion_names(ready_.scene, ready_.records(), polarity_);
    for (const RecordPair& pair : ready_.records())
        for (const GroundMotion& motion : ready_.motions(pair, polarity_)) {
            if (watch_.stop_asked()) return runs;
            runs.push_back(run(names[runs.size()], motion));
            watch_.results_at_hand();
            if (take) take(runs.back());
        }
    return runs;
}

std::size_t TiedRuns::whole() const
{
    return motion_names(ready_.scene, ready_.records(), polarity_).size();
}

TiedRun TiedRuns::run(const MotionName& name, const GroundMotion& motion) const
{
    const Scene& scene = ready_.scene;
    const fe2d::Model& damped = models_.damped();
    TiedRun run{name, {}, motion.notes, 0.0, motion};
    fe2d::TiedRunOptions options;
    options.scheme = fe2d::scheme_of(scene.time);
    options.dt = scene.time.dt;
    options.damping =
        water_ ? fe2d::damping_of(scene, damped, *water_, motion) : fe2d::damping_of(scene, damped, motion);
    options.water = water();
    options.static_load = start_.load;
    options.start_displacement = start_.displacement;
    if (!statics_.stages.empty()) options.static_resultant = statics_.stages.back().resultant;
    if (radiating_) {
        options.moving_base = [this](const fe2d::StepConstants& constants, double stiffness_damping) {
            return fe2d::rock_base(radiating_->rock, constants, stiffness_damping);
        };
        run.notes.push_back(rock_note(*radiating_));
    }
    watch_.begin(name.label(), 1000);
    options.progress = [&](const fe2d::RunProgress& p) {
        watch_.at(1000.0 * static_cast<double>(p.step) / static_cast<double>(std::max<std::int64_t>(1, p.steps)));
        return watch_.stop_asked() ? fe2d::RunAnswer::stop : fe2d::RunAnswer::go_on;
    };
    const Stopwatch start;
    const TiedScheme chosen = tied_scheme(scene, motion, options);
    try {
        run.history = integrate_by(chosen.scheme, models_.moving(), motion, options);
    } catch (const InputError& error) { // what the integrator refuses is a key of the scene
        watch_.end();
        std::vector<Diagnostic> named = error.diagnostics();
        for (Diagnostic& d : named)
            if (d.file.empty()) d.file = scene.file;
        throw InputError(std::move(named));
    }
    watch_.end();
    run.seconds = start.seconds();
    if (!chosen.reason.empty()) run.notes.push_back(chosen.reason);
    if (models_.on_free_edges && run.history.displacement.size() > 0)
        run.history.displacement = fe2d::without_edges(models_.still, *models_.on_free_edges, run.history.displacement);
    for (const Note& note : run.history.notes) run.notes.push_back(text_of(note));
    return run;
}

} // namespace damslip
