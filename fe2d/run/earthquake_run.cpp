#include "fe2d/run/contact_structure.hpp"
#include "fe2d/run/run_watches.hpp"
#include "fe2d/run/earthquake_pass.hpp"
#include "fe2d/run/stages.hpp"
#include "fe2d/run/strength.hpp"

#include "core/input_error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/rock/radiating_rock.hpp"
#include "fe2d/time/structure_system.hpp"
#include "scene/joint_bond.hpp"
#include "scene/planes.hpp"
#include "scene/rock_mass.hpp"
#include "scene/water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

ModelOptions model_options(const Scene& scene, const RunOptions& options, Base base)
{
    ModelOptions result;
    result.base = base;
    if (scene.contact.sliding == JointPath::finite) result.extension.downstream = scene.contact.max_slip;
    result.added_mass = options.added_mass;
    return result;
}

InputError wrong_scheme(const Scene& scene, std::string problem, std::string expected, std::string fix)
{
    return InputError(Diagnostic{scene.file.string(), 0, 0, std::move(problem), std::move(expected), std::move(fix)});
}

/// What explicit steps with contact cannot do. Rock by the mass of its unknowns, not by a key.
void check_explicit(const Scene& scene, const Model& model)
{
    const std::string scheme = "time.scheme = \"central-difference\" with ", hht = "use  scheme = \"hht\"  in [time]";
    if (model.mesh.has_rock()) {
        const Eigen::Index rock = model.dofs.count - 2 * model.mesh.dam_node_count;
        const auto massless = (model.mass.diagonal().tail(rock).array() <= 0.0).count();
        if (massless > 0)
            throw wrong_scheme(
                scene,
                scheme + fmt::format("rock of {} unknowns without mass: its highest frequency is infinite, no "
                                     "step is stable.",
                                     massless),
                "a rigid base (no [foundation]) below a dam that slides",
                hht + ", or run  fe --base tied  (the rock is condensed), or delete [foundation]");
        throw wrong_scheme(scene, scheme + "rock below a dam that slides.", "a rigid base (no [foundation])",
                           hht + ", or delete [foundation]");
    }
    if (is_acoustic(scene))
        throw wrong_scheme(scene, scheme + "acoustic water.", "no acoustic water: its coupling is not diagonal",
                           hht + ", or  model = \"added-mass\"  in [reservoir]");
    if (scene.contact.enforcement != ContactEnforcement::exact || scene.contact.normal != NormalContact::hard)
        throw wrong_scheme(scene, scheme + "contact that gives way.",
                           "contact.enforcement = \"exact\", normal = \"hard\"",
                           hht + ", or delete enforcement and normal in [contact]");
}

/// Massless rock has an infinite frequency: a scheme that is stable below some step only is not stable at all.
void check_scheme(const Scene& scene)
{
    if (scene.time.scheme == TimeScheme::modal)
        throw wrong_scheme(
            scene, "time.scheme = \"modal\" with a base that slides.",
            "a linear model: contact with friction has no modes",
            "run  fe --base tied , or  fe --reduced  (modes of the dam with exact contact), or use  scheme = "
            "\"hht\"  in [time]");
    if (scene.time.scheme == TimeScheme::central_difference) return; // check_explicit()
    const Scheme scheme = scheme_of(scene.time);
    if (!scene.foundation || scheme.unconditionally_stable()) return;
    throw InputError(
        Diagnostic{scene.file.string(), 0, 0,
                   fmt::format("time.beta = {:g} with time.gamma = {:g}: unstable at any step on massless rock.",
                               scheme.beta, scheme.gamma),
                   fmt::format("beta >= gamma/2 = {:g}, no unit", 0.5 * scheme.gamma),
                   "write  beta = 0.25  (average acceleration), or  scheme = \"hht\"  in [time]"});
}

} // namespace

EarthquakeRun::EarthquakeRun(const Scene& scene, RunOptions options) : scene_(scene), options_(std::move(options))
{
    if (scene_.seam_body) {
        scene_.contact = Contact(base_strength(scene_));
        scene_.stages.geostatic = true; // zero_displacement()
    }
    check_scheme(scene_);
    check_friction_over_rate(scene_);
    check_rebounds(scene_);
    const Stopwatch start;
    const auto part_done = [this] { stop_if_asked(options_.stop, "the set-up of the finite elements"); };
    part_done();
    const bool explicit_steps = scene_.time.scheme == TimeScheme::central_difference;
    ModelOptions parts = model_options(scene_, options_, Base::separate);
    if (explicit_steps) parts.mass = MassKind::lumped;
    model_ = std::make_unique<Model>(build_model(scene_, parts));
    if (explicit_steps) check_explicit(scene_, *model_);
    part_done();
    if (is_acoustic(scene_))
        water_ = std::make_unique<WaterBody>(scene_, *model_,
                                             rock_is_boxed(scene_) ? WaterBeside::dam_and_rock : WaterBeside::dam);
    part_done();
    if (rock_is_boxed(scene_)) {
        ModelOptions moving = model_options(scene_, options_, Base::separate);
        if (rock_edges_are_viscous(scene_)) moving.edges = RockEdges::free;
        moving_model_ = std::make_unique<Model>(build_model(scene_, moving));
        part_done();
        moving_ = std::make_unique<ContactStructure>(*moving_model_, JointPath::small, water_.get(), RockBody::moving);
    }
    part_done();
    structure_ = std::make_unique<ContactStructure>(*model_, scene_.contact.sliding, moving_ ? nullptr : water_.get());
    part_done();
    stages_ = load_stages(scene_, *model_, options_.uplift,
                          options_.water_in_rock ? options_.water_in_rock(*model_) : Eigen::VectorXd());
    usable_ = structure_->regular();
    if (!usable_) why_not_ = {{NoteKind::part_not_held}};
    part_done();
    find_damping();
    part_done();
    if (usable_) {
        statics_ = std::make_shared<const StaticOperator>(*structure_);
        cracks_.emplace(scene_, in_motion(), damping_.constants.stiffness, options_.crack_starts);
        part_done();
        if (explicit_steps)
            explicit_ = explicit_operators();
        else
            operators_ = std::make_shared<StepOperators>(in_motion(), damping_, scheme_of(scene_.time), let_radiate());
    }
    seconds_ = start.seconds();
}

EarthquakeRun::~EarthquakeRun() = default;

/// Of the nodes that the dam faces, or may come to face.
std::shared_ptr<const ReducedRock> EarthquakeRun::let_radiate()
{
    if (!rock_radiates(scene_)) return {};
    const ContactPlane& contact = model_->mesh.contact;
    try {
        radiating_ = std::make_unique<const RadiatingRock>(
            radiating_rock_of(scene_, model_->mesh, structure_->slides_far() ? contact.rock_line : contact.rock_nodes,
                              options_.wave_frequency, options_.rock_cache, options_.reducing_rock));
    } catch (const std::runtime_error& error) {
        usable_ = false;
        why_not_ = {{NoteKind::rock_cannot_radiate, {error.what()}}};
        return {};
    }
    if (const ReductionReport& report = radiating_->rock.report;
        !report.passed()) { // no slip on rock that is not right
        usable_ = false;
        why_not_ = {report.missed_gate()};
    }
    const Plane& plane = structure_->plane();
    const Index nodes = radiating_->rock.base() / 2; // of a seam they are the pairs
    Eigen::Matrix2Xd normals(2, nodes), tangents(2, nodes);
    for (Index i = 0; i < nodes; ++i) {
        normals.col(i) = plane.segments.empty() ? plane.normal : plane.normal_of(i);
        tangents.col(i) = plane.segments.empty() ? plane.tangent : plane.tangent_of(i);
    }
    return std::make_shared<const ReducedRock>(radiating_->rock.on_path(normals, tangents));
}

/// The dam bonded to massless rock in any case: modes of a box of rock with mass are the box's, and waves that leave have
/// none.
Model EarthquakeRun::tied_model() const
{
    return build_model(with_massless_rock(scene_), model_options(scene_, options_, Base::tied));
}

double EarthquakeRun::window() const
{
    std::call_once(window_found_, [this] {
        double frequency = 0.0;
        if (!in_motion().model().mesh.contact.matching && scene_.mesh.file) {
            // Nodes that do not face each other cannot be tied: the frequency is not known.
        } else if (water_) {
            frequency = first_frequency_.value_or(0.0);
            if (!first_frequency_) frequency = leading_modal_masses(coupled_modes(1), 1).front().frequency;
        } else if (const VectorXd found = bonded_frequencies(1); found.size() > 0)
            frequency = found[0];
        window_ = slide_window(frequency / (2.0 * std::numbers::pi));
    });
    return window_;
}

/// Of the dam bonded to massless rock, without acoustic water, ascending [rad/s]; fewer where there are fewer.
VectorXd EarthquakeRun::bonded_frequencies(int count) const
{
    const bool lumped = scene_.time.scheme == TimeScheme::central_difference;
    if (const auto found = lumped ? std::nullopt : tied_frequencies(*structure_, count)) return *found;
    return (2.0 * std::numbers::pi) * natural_modes(tied_model(), count).frequency;
}

/// Of the tied dam and its acoustic water, so that `leading` are the dam's.
CoupledModes EarthquakeRun::coupled_modes(int leading) const
{
    const std::optional<CoupledPencil> condensed = tied_pencil(*structure_, water_->water);
    return coupled_modes_up_to(condensed ? *condensed : coupled_pencil(tied_model(), water_->water), 0.0, leading);
}

void EarthquakeRun::find_damping()
{
    const Damping& wanted = scene_.damping;
    damping_.mass = wanted.mass;
    if (wanted.method == DampingMethod::none && !options_.damping) return;
    if (options_.damping) {
        damping_.constants = *options_.damping;
        return;
    }
    if (wanted.mass_coefficient || wanted.stiffness_coefficient) {
        damping_.constants = {wanted.mass_coefficient.value_or(0.0), wanted.stiffness_coefficient.value_or(0.0)};
        return;
    }
    if (water_) { // the leading modes, without those of the water alone
        const CoupledModes modes = coupled_modes(modes_needed(wanted));
        damping_.constants = damping_of(scene_, modes, {}).constants;
        if (const auto leading = leading_modal_masses(modes, 1); !leading.empty())
            first_frequency_ = leading.front().frequency;
        return;
    }
    const int modes = std::max(wanted.first_mode, wanted.second_mode);
    const VectorXd frequency = bonded_frequencies(modes);
    if (frequency.size() < modes) {
        usable_ = false;
        why_not_ = {
            {NoteKind::damping_mode_missing, {std::int64_t{modes}, static_cast<std::int64_t>(frequency.size())}}};
        return;
    }
    damping_.constants =
        rayleigh_constants(wanted.ratio, frequency[wanted.first_mode - 1], frequency[wanted.second_mode - 1]);
}

/// The load at the end of a stage. The water in the joint comes with the last.
SplitLoad EarthquakeRun::split(std::size_t stage) const
{
    SplitLoad load = structure_->split(stages_.loads[stage]);
    if (stage + 1 == stages_.loads.size()) let_water_ride(*structure_, options_.uplift, load);
    return load;
}

namespace {

/// No load at all, before the first stage.
SplitLoad nothing(const SplitLoad& like)
{
    return {VectorXd::Zero(like.dam.size()), VectorXd::Zero(like.rock.size()), VectorXd::Zero(like.joint.size())};
}

} // namespace

/// For static stages whose bond breaks. The rock is that of the motion where it is the same structure.
Relaxation EarthquakeRun::relaxation() const
{
    const Mesh& mesh = model_->mesh;
    double top = -std::numeric_limits<double>::infinity(), foot = -top;
    for (int node = 0; node < mesh.dam_node_count; ++node) {
        top = std::max(top, mesh.nodes[node].y);
        foot = std::min(foot, mesh.nodes[node].y);
    }
    const double young_modulus = scene_.dam.young_modulus.value_or(25e9); // about: the period sets a step size
    const bool explicit_steps = !operators_;
    return relaxation_of(*structure_, damping_, explicit_steps ? Scheme{} : operators_->scheme(),
                     explicit_steps || moving_ ? nullptr : operators_->radiating(), scene_.contact, options_.contact,
                     first_period(top - foot, young_modulus));
}

std::vector<StageResult> EarthquakeRun::statics(StaticContact& statics, Strength& strength, ContactMemory& memory) const
{
    std::vector<StageResult> results;
    const Relaxation relax = relaxation();
    for (std::size_t k = 0; k < stages_.loads.size(); ++k) {
        const SplitLoad load = split(k), before = k > 0 ? split(k - 1) : nothing(load);
        results.push_back(solve_stage(statics, *structure_, stages_.names[k], load, strength, memory, &before, relax));
        if (results.back().status != StageStatus::ok) break;
    }
    // Pairs almost without friction may defeat the solver before the load comes that no friction of theirs can hold.
    for (std::size_t k = results.size(); results.back().status == StageStatus::not_resolved && k < stages_.loads.size();
         ++k) {
        StageResult later = solve_stage(statics, *structure_, stages_.names[k], split(k), strength, memory);
        if (later.status != StageStatus::ok && later.status != StageStatus::not_resolved)
            results.push_back(std::move(later));
    }
    return results;
}

/// A pass with 2^k sub-steps costs 2^k times the first; where halvings are chosen there are two passes at least, and
/// passes that are left out count as made.
RunProgress EarthquakeRun::progress_of(const BatchedRun& batched, int halvings, long record_steps, long step, double dt) const
{
    const bool chosen = !batched.steps && !scene_.time.substeps;
    const int first = batched.steps ? batched.steps->halvings : scene_.time.substeps.value_or(0);
    if (batched.steps_of_all > 0) { // a record of a sequence
        step = batched.steps_before + std::min(step, record_steps);
        record_steps = batched.steps_of_all;
    }
    const long before = record_steps * ((1L << halvings) - (1L << first)), now = record_steps << halvings;
    const long more = chosen && halvings == first ? 2 * now : 0;
    return {static_cast<double>(step) * dt, static_cast<double>(record_steps) * dt,
            before + (std::min(step, record_steps) << halvings), before + now + more};
}

/// Has the dam, or the block above a lift joint, slid further than the plane below it is long, beyond what the step leaves
/// open? There water, uplift and the plane itself are no longer those of the model. @returns empty: no
std::vector<Note> EarthquakeRun::runs_away(const RunResult& result) const
{
    const ContactPlanes& planes = structure_->planes();
    const auto away = [&](const std::string& plane, double slip, double error, Index index) -> std::vector<Note> {
        const double length = planes[index].length();
        if (!(slip - (std::isfinite(error) ? error : 0.0) > length)) return {};
        return {{NoteKind::runs_away, {plane, length}}};
    };
    std::vector<Note> notes = away("base", result.max_slip, result.slip_error, 0);
    for (std::size_t k = 0; notes.empty() && k < result.lifts.size(); ++k)
        notes = away(result.lifts[k].plane, result.lifts[k].largest_slip, result.lifts[k].slip_error,
                     static_cast<Index>(k + 1));
    return notes;
}

double RunResult::least_slip_of_planes() const
{
    double largest = max_slip;
    for (const LiftResult& lift : lifts) largest = std::max(largest, lift.largest_slip);
    return 0.01 * largest;
}

/// What of the slip the step leaves open, of the plane where that is most against what time.slip_tolerance allows.
Note EarthquakeRun::missed_tolerance(const RunResult& result) const
{
    const double least = result.least_slip_of_planes();
    const auto excess = [&](double slip, double error) { return error / std::max({slip, least, options_.smallest_slip}); };
    std::string where = "base";
    double slip = result.max_slip, error = result.slip_error;
    for (const LiftResult& lift : result.lifts)
        if (excess(lift.largest_slip, lift.slip_error) > excess(slip, error)) {
            where = lift.plane;
            slip = lift.largest_slip;
            error = lift.slip_error;
        }
    return {NoteKind::largest_slip_open, {where, 1e3 * slip, 1e3 * error, result.dt, scene_.time.slip_tolerance}};
}

namespace {

/// Friction only takes energy. Over a step its work goes by the mean of the forces at both ends, so a dam that leaves the rock
/// within a step after a hard landing is thrown back by the friction of that landing: steps that are too long for it.
/// @returns a note where friction gave back more than a hundredth of the largest kinetic energy
std::vector<Note> friction_gave_back(const RunHistory& history)
{
    double kinetic = 0.0;
    for (const Energy& energy : history.energy) kinetic = std::max(kinetic, energy.kinetic);
    const double gave = history.energy.empty() ? 0.0 : -history.energy.back().friction;
    if (!(gave > 0.01 * kinetic)) return {};
    return {{NoteKind::friction_gave_back, {gave}}};
}

} // namespace

/// Of a run that is neither self-excited nor ended by its statics.
Note EarthquakeRun::ending(const RunResult& result) const
{
    switch (result.status) {
    case Status::tolerance_missed:
        return missed_tolerance(result);
    case Status::sliding_at_end:
        return {NoteKind::run_still_sliding, {1e3 * result.slip, scene_.sliding.run_out_max}};
    case Status::not_resolved:
        return {NoteKind::contact_unresolved,
                {std::int64_t{result.counts.unresolved}, std::int64_t{result.counts.steps},
                 result.counts.largest_residual}};
    case Status::interrupted:
        return {NoteKind::interrupted, {result.end_time, 1e3 * result.slip}};
    case Status::left_plane:
        return {NoteKind::beyond_mesh, {result.end_time, result.slip, scene_.contact.max_slip}};
    case Status::diverged: {
        const Energy& energy = result.history.energy.back();
        if (-energy.numerical > energy.contact_normal)
            return {NoteKind::scheme_gained, {result.end_time, -energy.numerical}};
        return {NoteKind::contact_gained, {result.end_time, energy.contact_normal}};
    }
    default:
        return {NoteKind::slip_at_rest, {1e3 * result.slip, result.end_time}};
    }
}

void EarthquakeRun::judge(RunResult& result) const
{
    std::vector<Note>& notes = result.notes;
    const auto add = [&notes](std::vector<Note> more) { notes.insert(notes.end(), more.begin(), more.end()); };
    if (result.status != Status::interrupted && result.counts.unresolved > 0) result.status = Status::not_resolved;
    const bool over = result.status == Status::at_rest || result.status == Status::sliding_at_end ||
                      result.status == Status::tolerance_missed;
    if (std::vector<Note> away = over ? runs_away(result) : std::vector<Note>(); !away.empty()) {
        result.status = Status::runs_away;
        notes = std::move(away);
    }
    // Where the state between two records does not stand, the records before it have been answered.
    const bool stopped_between = !result.between.empty() && result.rest().status != StageStatus::ok;
    const std::string event = judge_events(stopped_between ? Status::at_rest : result.status,
                                           structure_->planes()[0].length(), result.events);
    if (!event.empty() && !notes.empty()) notes.insert(notes.begin(), {NoteKind::in_record, {event}});
    switch (result.status) {
    case Status::self_excited:
        notes = self_excited_notes(scene_, result.slip, result.run_out);
        break;
    case Status::interrupted:
        if (notes.empty()) notes = {ending(result)};
        break;
    case Status::at_rest:
    case Status::tolerance_missed:
    case Status::sliding_at_end:
    case Status::not_resolved:
    case Status::left_plane:
    case Status::diverged:
        notes = {ending(result)};
        break;
    default: // its statics, or what ran away, have said it
        break;
    }
    if (result.status == Status::sliding_at_end && result.run_out.sliding_factor > 1.0)
        notes.push_back({NoteKind::would_stand, {result.run_out.sliding_factor}});
    // Where contact gives way before it slips, what that stores comes back through friction.
    if (scene_.contact.enforcement == ContactEnforcement::exact && scene_.contact.normal == NormalContact::hard)
        add(friction_gave_back(result.history));
    const auto left = static_cast<std::int64_t>(result.events_left);
    if (left > 0 && stopped_between)
        notes.push_back({NoteKind::records_not_run, {left}});
    else if (left > 0 && !result.events.empty())
        notes.push_back({NoteKind::records_after_not_run, {result.events.back().name, left}});
    if (result.status == Status::not_resolved && scene_.contact.rate.active()) add(longest_rated_step());
}

/// Steps for which friction over the rate has one answer in any case, of the dam as a rigid block.
std::vector<Note> EarthquakeRun::longest_rated_step() const
{
    const RateFriction& rate = scene_.contact.rate;
    const BaseResultant base = base_resultant(*structure_, split(stages_.loads.size() - 1).dam);
    const double mass = structure_->dam_inertia_x().sum();
    const double fall = std::abs(1.0 - rate.kinetic_ratio) * FrictionOverSlip(scene_.contact).peak();
    if (!(fall > 0.0) || !(base.normal_force > 0.0)) return {};
    return {{NoteKind::rate_needs_steps, {*rate.characteristic_rate * mass / (base.normal_force * fall)}}};
}

/// Displacements at the end of the gravity stage where the scene counts from there; else empty.
VectorXd EarthquakeRun::zero_displacement(StaticContact& statics, const Strength& strength) const
{
    if (!scene_.stages.geostatic) return {};
    ContactMemory memory(structure_->pairs());
    if (scene_.seam_body) { // from the rock as it lies before the dam, where nothing has parted
        const VectorXd weight = sum_of(static_loads(scene_, *model_).rock, model_->dofs.count);
        const StaticState state = statics.displacements(structure_->split(weight), memory);
        return structure_->assemble(state.dam, state.rock, weight);
    }
    Strength trial = strength;
    const SplitLoad load = split(0);
    if (solve_stage(statics, *structure_, stages_.names[0], load, trial, memory).status != StageStatus::ok) return {};
    const StaticState state = statics.displacements(load, memory);
    return structure_->assemble(state.dam, state.rock, stages_.loads[0]);
}

/// Null: steps are halved, or fixed.
const StepCorrector* EarthquakeRun::corrector() const
{
    if (!options_.corrector || scene_.time.substeps || options_.start || !why_not_.empty()) return nullptr;
    if (!model_->mesh.contact.matching) return nullptr;
    std::call_once(corrector_made_, [this] { corrector_ = options_.corrector(*this, scene_, options_); });
    return corrector_.get();
}

std::vector<RunResult> EarthquakeRun::run_all(const GroundMotion& motion, std::span<const Contact> contacts,
                                              const std::optional<ChosenSteps>& steps) const
{
    std::vector<Shaking> shakings;
    for (const Contact& contact : contacts) shakings.push_back({&motion, contact});
    return run_all(shakings, steps);
}

std::vector<RunResult> EarthquakeRun::run_all(std::span<const Shaking> shakings,
                                              const std::optional<ChosenSteps>& steps) const
{
    const StepCorrector* corrector = steps ? nullptr : this->corrector();
    return corrector ? corrector->run_all(shakings) : run_in_step(shakings, steps);
}

RunResult EarthquakeRun::run(const GroundMotion& motion, const std::optional<Contact>& contact) const
{
    const Contact contacts[] = {contact.value_or(scene_.contact)};
    return std::move(run_all(motion, contacts).front());
}

RunResult EarthquakeRun::run_at(const GroundMotion& motion, const ChosenSteps& steps) const
{
    const Contact contacts[] = {scene_.contact};
    return std::move(run_all(motion, contacts, steps).front());
}

ChosenSteps EarthquakeRun::steps_of(const RunResult& run) const
{
    return {run.halvings, explicit_ ? std::optional(run.dt) : std::nullopt};
}

} // namespace damslip::fe2d
