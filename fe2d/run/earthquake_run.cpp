#include "fe2d/run/earthquake_run.hpp"

#include "fe2d/modes/natural_modes.hpp"
#include "fe2d/run/ground_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

ModelOptions model_options(const RunOptions& options, Base base)
{
    ModelOptions result;
    result.base = base;
    if (options.range == SlidingRange::finite) result.extension.downstream = *options.max_slip;
    result.added_mass = options.added_mass;
    return result;
}

} // namespace

RunOptions completed(RunOptions options, const Scene& scene)
{
    if (!options.separation)
        options.separation = scene.contact.separation == JointOpening::none ? Separation::none : Separation::allowed;
    if (!options.range)
        options.range = scene.contact.sliding == JointPath::finite ? SlidingRange::finite : SlidingRange::small;
    if (!options.max_slip) options.max_slip = scene.contact.max_slip;
    if (!options.slip_tolerance) options.slip_tolerance = scene.time.slip_tolerance;
    if (!options.halvings) options.halvings = scene.time.substeps;
    if (scene.contact.enforcement == ContactEnforcement::penalty && options.contact.tangential_stiffness == 0.0)
        options.contact.tangential_stiffness = scene.contact.tangential_stiffness.value();
    if (scene.contact.enforcement == ContactEnforcement::slip_tolerance && options.contact.slip_tolerance == 0.0)
        options.contact.slip_tolerance = scene.contact.slip_tolerance;
    if (scene.contact.normal == NormalContact::exponential && options.contact.pressure_at_zero_clearance == 0.0) {
        options.contact.pressure_at_zero_clearance = scene.contact.pressure_at_zero_clearance;
        options.contact.clearance_at_zero_pressure = scene.contact.clearance_at_zero_pressure;
    }
    return options;
}

EarthquakeRun::EarthquakeRun(const Scene& scene, RunOptions options)
    : scene_(scene), options_(completed(std::move(options), scene))
{
    const auto start = Clock::now();
    model_ = std::make_unique<Model>(build_model(scene_, model_options(options_, Base::separate)));
    structure_ = std::make_unique<ContactStructure>(*model_, *options_.range);
    stages_ = load_stages(scene_, *model_, options_.uplift);
    usable_ = structure_->regular();
    if (!usable_) why_not_ = "The stiffness of dam or rock could not be factorised: a part is not held.";
    find_damping();
    seconds_ = seconds_since(start);
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
    const Model tied = build_model(scene_, model_options(options_, Base::tied));
    const int modes = std::max(wanted.first_mode, wanted.second_mode);
    const NaturalModes natural = natural_modes(tied, modes);
    if (natural.frequency.size() < modes) {
        usable_ = false;
        why_not_ = fmt::format("Rayleigh damping needs mode {}, and {} were found.", modes, natural.frequency.size());
        return;
    }
    const double to_omega = 2.0 * std::numbers::pi;
    damping_.constants = rayleigh_constants(wanted.ratio, to_omega * natural.frequency[wanted.first_mode - 1],
                                            to_omega * natural.frequency[wanted.second_mode - 1]);
}

/// The load at the end of a stage. The water in the joint comes with the last.
SplitLoad EarthquakeRun::split(std::size_t stage) const
{
    SplitLoad load = structure_->split(stages_.loads[stage]);
    if (stage + 1 == stages_.loads.size()) let_water_ride(*structure_, options_.uplift, load);
    return load;
}

std::vector<StageResult> EarthquakeRun::statics(StaticContact& statics, Strength& strength, ContactMemory& memory) const
{
    std::vector<StageResult> results;
    for (std::size_t k = 0; k < stages_.loads.size(); ++k) {
        results.push_back(solve_stage(statics, *structure_, stages_.names[k], split(k), strength, memory));
        if (results.back().status != StageStatus::ok) break;
    }
    return results;
}

namespace {

/// Energy that contact or the scheme has made up, beyond what the ground and the weights gave.
bool diverges(const Energy& energy)
{
    return !std::isfinite(energy.kinetic) ||
           energy.contact_normal > 10.0 + 0.05 * (std::abs(energy.external) + std::abs(energy.friction));
}

} // namespace

void EarthquakeRun::shake(const GroundMotion& motion, int halvings, const Strength& strength_at_start,
                          const ContactMemory& memory, const StaticState& start, RunResult& result) const
{
    const double dt = scene_.time.dt.value_or(motion.dt),
                 duration = motion.dt * static_cast<double>(motion.accel_h.size() - 1);
    const int parts = 1 << halvings;
    const double step = dt / parts;
    Strength strength = strength_at_start;
    const GroundInput ground(motion, damping_.mass, damping_.constants.mass);
    DynamicContact dynamics(*structure_, damping_, scheme_of(scene_.time), split(stages_.loads.size() - 1), start,
                            memory, options_.contact);
    HistoryRecorder recorder(dynamics, result.history, options_.pair_series);
    recorder.add();
    result.dt = step;
    result.halvings = halvings;
    result.max_slip = 0.0;
    result.status = RunStatus::sliding_at_end;

    const auto record_steps = static_cast<long>(std::ceil(duration / dt - 1e-9));
    const auto all_steps = record_steps + static_cast<long>(std::ceil(scene_.sliding.run_out_max / dt - 1e-9));
    const long rest_steps = static_cast<long>(std::ceil(options_.rest_time / dt - 1e-9));
    for (long n = 0; n < all_steps; ++n) {
        for (int part = 1; part <= parts && dynamics.within_reach(); ++part) {
            const double time = (static_cast<double>(n) + static_cast<double>(part) / parts) * dt;
            dynamics.advance(step, ground.at(time), strength.law());
            strength.follow(dynamics.state().contact);
        }
        recorder.add();
        result.max_slip = std::max(result.max_slip, std::abs(result.history.slip.back()));
        if (options_.progress && options_.progress(progress_of(halvings, record_steps, n + 1, dt)) == RunAnswer::stop) {
            result.status = RunStatus::interrupted;
            break;
        }
        if (!dynamics.within_reach()) {
            result.status = RunStatus::left_plane;
            break;
        }
        if (diverges(dynamics.energy())) {
            result.status = RunStatus::diverged;
            break;
        }
        if (n + 1 >= record_steps + rest_steps &&
            at_rest(result.history.time, result.history.slip, options_.rest_time)) {
            result.status = RunStatus::at_rest;
            break;
        }
    }
    const DynamicState& end = dynamics.state();
    const Plane& plane = structure_->plane();
    const Index m = plane.pairs();
    result.slip = result.history.slip.back();
    result.end_time = end.time;
    result.counts = dynamics.counts();
    result.energy_error =
        dynamics.energy_scale() > 0.0 ? std::abs(dynamics.energy_imbalance()) / dynamics.energy_scale() : 0.0;
    result.pair_distance = plane.distance;
    result.pair_area = plane.area;
    result.pair_pressure = end.contact.force.head(m).cwiseQuotient(plane.area);
    result.pair_shear = -end.contact.force.tail(m).cwiseQuotient(plane.area);
    result.pair_slip = end.contact.slip - memory.slip;
    result.pair_opening = end.contact.opening;
    result.displacement = structure_->assemble(end.u, end.rock, stages_.last());
    if (result.zero_displacement.size() > 0) result.displacement -= result.zero_displacement;
    result.bytes = dynamics.bytes();
    result.seconds.contact += result.counts.contact_seconds;

    VectorXd after = stages_.last();
    if (!options_.uplift_after.empty()) {
        after = stages_.loads[stages_.loads.size() - (options_.uplift.empty() ? 1 : 2)];
        for (const ContactSide side : {ContactSide::dam, ContactSide::rock})
            after += uplift_load(model_->mesh, model_->dofs, options_.uplift_after, side);
    }
    ContactMemory memory_after = end.contact;
    if (result.status == RunStatus::left_plane) return;
    StaticContact statics(*structure_, options_.contact, plane.weights().dot(end.contact.slip));
    SplitLoad load_after = structure_->split(after);
    let_water_ride(*structure_, options_.uplift_after.empty() ? options_.uplift : options_.uplift_after, load_after);
    result.after = solve_stage(statics, *structure_, "after the earthquake", load_after, strength, memory_after);
}

/// A pass with 2^k sub-steps costs 2^k times the first; where halvings are chosen there are two passes at least.
RunProgress EarthquakeRun::progress_of(int halvings, long record_steps, long step, double dt) const
{
    const int first = options_.halvings.value_or(0);
    const long before = record_steps * ((1L << halvings) - (1L << first)), now = record_steps << halvings;
    const long more = !options_.halvings && halvings == first ? 2 * now : 0;
    return {static_cast<double>(step) * dt, static_cast<double>(record_steps) * dt,
            before + (std::min(step, record_steps) << halvings), before + now + more};
}

void EarthquakeRun::judge(RunResult& result) const
{
    if (result.status != RunStatus::interrupted && result.counts.unresolved > 0) result.status = RunStatus::unresolved;
    switch (result.status) {
    case RunStatus::at_rest:
        result.message = fmt::format("Slip {:.4g} mm, at rest at {:.2f} s.", 1e3 * result.slip, result.end_time);
        break;
    case RunStatus::sliding_at_end:
        result.message = fmt::format("Slip {:.4g} mm so far: still sliding {:.0f} s after the record's end.",
                                     1e3 * result.slip, scene_.sliding.run_out_max);
        break;
    case RunStatus::unresolved:
        result.message = fmt::format("Contact was not resolved in {} of {} steps, largest residual {:.1e} of N'.",
                                     result.counts.unresolved, result.counts.steps, result.counts.largest_residual);
        break;
    case RunStatus::interrupted:
        if (result.message.empty())
            result.message =
                fmt::format("Interrupted at {:.2f} s, slip so far {:.4g} mm.", result.end_time, 1e3 * result.slip);
        break;
    case RunStatus::left_plane:
        result.message = fmt::format("Stopped at {:.2f} s: slipped {:.4g} m, beyond contact.max_slip_m = {:g} m.",
                                     result.end_time, result.slip, *options_.max_slip);
        break;
    case RunStatus::diverged:
        result.message = fmt::format("Stopped at {:.2f} s: contact has put {:.3g} J/m into the motion. Use a smaller "
                                     "step, damping, or a more negative time.alpha.",
                                     result.end_time, result.history.energy.back().contact_normal);
        break;
    default:
        break;
    }
}

std::vector<RunResult> EarthquakeRun::run_all(const GroundMotion& motion, std::span<const Contact> contacts) const
{
    std::vector<RunResult> results;
    for (const Contact& contact : contacts) results.push_back(run(motion, contact));
    return results;
}

/// Displacements at the end of the gravity stage where the scene counts from there; else empty.
VectorXd EarthquakeRun::zero_displacement(StaticContact& statics, const Strength& strength) const
{
    if (!scene_.stages.geostatic) return {};
    ContactMemory memory(structure_->plane().pairs());
    Strength trial = strength;
    const SplitLoad load = split(0);
    if (solve_stage(statics, *structure_, stages_.names[0], load, trial, memory).status != StageStatus::ok) return {};
    const StaticState state = statics.displacements(load, memory);
    return structure_->assemble(state.dam, state.rock, stages_.loads[0]);
}

RunResult EarthquakeRun::run(const GroundMotion& motion, const std::optional<Contact>& contact) const
{
    RunResult result;
    result.seconds.model = seconds_;
    result.damping = damping_.constants;
    if (!usable_) {
        result.message = why_not_;
        return result;
    }
    auto clock = Clock::now();
    StaticContact statics_solver(*structure_, options_.contact);
    Strength strength(contact.value_or(scene_.contact), structure_->plane());
    strength.set_separation(*options_.separation);
    ContactMemory memory(structure_->plane().pairs());
    result.zero_displacement = zero_displacement(statics_solver, strength);
    result.stages = statics(statics_solver, strength, memory);
    result.seconds.statics = seconds_since(clock);
    if (result.stages.back().status != StageStatus::ok) {
        result.status = RunStatus::static_failure;
        result.message = result.stages.back().text();
        return result;
    }
    const StaticState start = statics_solver.displacements(split(stages_.loads.size() - 1), memory);

    clock = Clock::now();
    const int first = options_.halvings.value_or(0);
    shake(motion, first, strength, memory, start, result);
    result.slip_error = std::numeric_limits<double>::quiet_NaN();
    for (int k = first + 1; !options_.halvings && k <= options_.largest_halvings; ++k) {
        if (result.status == RunStatus::interrupted) break;
        const double coarser = result.slip;
        RunResult finer = result;
        shake(motion, k, strength, memory, start, finer);
        if (finer.status == RunStatus::interrupted) { // the whole coarser run tells more than a part of the finer
            result.status = RunStatus::interrupted;
            result.message = fmt::format("Interrupted with sub-steps of {:.4g} s; slip {:.4g} mm with {:.4g} s.",
                                         finer.dt, 1e3 * result.slip, result.dt);
            break;
        }
        result = std::move(finer);
        // Contact with moving edges converges with first order at worst; then the finer run errs by the difference.
        result.slip_error = std::abs(result.slip - coarser);
        if (result.status == RunStatus::left_plane) break;
        if (result.slip_error <= *options_.slip_tolerance * std::max(std::abs(result.slip), options_.smallest_slip))
            break;
    }
    result.seconds.dynamics = seconds_since(clock);
    judge(result);
    return result;
}

} // namespace damslip::fe2d
