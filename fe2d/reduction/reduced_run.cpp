#include "fe2d/reduction/reduced_run.hpp"

#include "core/input_error.hpp"
#include "core/stopwatch.hpp"
#include "fe2d/run/self_excited.hpp"
#include "fe2d/run/slide_probe.hpp"
#include "fe2d/run/step_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace damslip::fe2d {

using Eigen::Index;

namespace {

constexpr int coarse_pairs = 22; ///< of the plane of the estimate

/// Modes of the estimate's reference: four times as many, or twice where that would cost more than the run.
int reference_modes(int modes)
{
    return std::max(2 * modes, std::min(4 * modes, 64));
}

void record(const ReducedContact& dynamics, ReducedHistory& history)
{
    const ContactMemory& contact = dynamics.state().contact;
    const Index m = contact.opening.size();
    history.time.push_back(dynamics.state().time);
    history.slip.push_back(dynamics.mean_slip());
    history.crest_x.push_back(dynamics.crest());
    history.normal_force.push_back(contact.force.head(m).sum());
    history.shear_force.push_back(-contact.force.tail(m).sum());
}

/// @param length  of the base [m]
std::string message_of(const ReducedResult& r, double length)
{
    switch (r.status) {
    case Status::not_resolved:
        return fmt::format("Contact was not resolved in {} of {} steps, largest residual {:.1e} of N'.",
                           r.counts.unresolved, r.counts.steps, r.counts.largest_residual);
    case Status::runs_away:
        return fmt::format("Runs away: slides further on the base than its {:.4g} m, where the model no longer holds.",
                           length);
    case Status::interrupted:
        return fmt::format("Interrupted at {:.2f} s.", r.end_time);
    case Status::diverged:
        return fmt::format("Stopped at {:.2f} s: the kinetic energy is no longer a number.", r.end_time);
    case Status::tolerance_missed:
        return fmt::format(
            "Largest slip {:.4g} mm ± {:.2g} mm with steps of {:.4g} s: more than time.slip_tolerance allows. Give a "
            "smaller time.dt_s, or a larger slip_tolerance.",
            1e3 * r.max_slip, 1e3 * r.step_error, r.dt);
    default:
        return fmt::format("Slip {:.4g} mm{} with {} elastic modes.", 1e3 * r.slip,
                           std::isnan(r.truncation_error) ? "" : fmt::format(" ± {:.2g} mm", 1e3 * r.truncation_error),
                           r.modes);
    }
}

} // namespace

struct ReducedRun::Motion {
    GroundInput ground;
    double dt = 0.0; ///< of the rows of the history [s]
    int parts = 1;   ///< steps in each
    ContactOptions contact;
};

ReducedRun::ReducedRun(const EarthquakeRun& full, const Scene& scene, RunOptions options, int modes)
    : full_(full), scene_(scene), options_(std::move(options)), stages_(full.stages()), wanted_(std::max(modes, 1)),
      coarse_(full.structure().plane(), coarse_pairs)
{
    const Stopwatch start;
    if (!full.model().mesh.contact.matching)
        refuse(scene.mesh.file.value_or(scene.file),
               "the nodes of dam and rock do not face each other along the base, as a reduced run needs them to.",
               "the same nodes on both sides",
               "let dam and rock share the curve from heel to toe, or run without --reduced");
    if (!full.why_not().empty() || full.structure().slides_far() || full.structure().water() ||
        full.in_motion().rock_moves())
        return;
    DamModes kept = dam_modes(full.structure(), wanted_);
    if (!kept.regular) return;
    system_ = std::make_unique<ReducedSystem>(system_of(std::move(kept)));
    seconds_ = start.seconds();
}

ReducedSystem ReducedRun::system_of(DamModes modes) const
{
    return {full_.structure(), std::move(modes), {full_.damping(), scene_.damping.mass}, full_.radiating_on_base()};
}

const ReducedRun::Estimators& ReducedRun::estimators() const
{
    std::call_once(estimators_made_, [this] {
        if (system_->modes.complete) return;
        DamModes reference = dam_modes(full_.structure(), reference_modes(wanted_));
        if (!reference.regular) return;
        const auto coarse = [&](const ReducedSystem& system) {
            return std::make_unique<ReducedSystem>(coarse_.coarsened(system));
        };
        estimators_.kept = coarse(*system_);
        estimators_.fewer = coarse(system_of(reference.first(3 + wanted_ / 2)));
        estimators_.reference = coarse(system_of(std::move(reference)));
    });
    return estimators_;
}

void ReducedRun::shake(const Motion& motion, const Plane& plane, const ReducedSystem& system, Strength& strength,
                       const ContactMemory& rest, const StageResult* rest_stage, ReducedResult& result) const
{
    const double dt = motion.dt;
    const int parts = motion.parts;
    const GroundInput& ground = motion.ground;
    ReducedContact dynamics(plane, system, scheme_of(scene_.time), rest, scene_.contact, motion.contact);
    std::optional<SlideProbe> probe;
    std::optional<SlideWatch> watch;
    double friction = 0.0; // dissipated so far [J/m]
    const auto look = [&] {
        watch->add(probe->instant(dynamics.state().time, dynamics.state().contact, strength.law(), friction));
    };
    const auto add_row = [&] {
        record(dynamics, result.history);
        if (watch) watch->add_row(result.history.slide);
    };
    result.history = {};
    if (rest_stage) {
        probe.emplace(full_.structure().planes(), *rest_stage, rest.slip);
        watch.emplace(SlideLimits{ground.duration(), probe->static_normal_force(), scene_.sliding.steady_rate_change},
                      [this] { return full_.window(); });
        look();
    }
    add_row();
    result.dt = dt / parts;
    result.max_slip = 0.0;
    result.status = Status::sliding_at_end;
    const auto record_steps = static_cast<long>(std::ceil(ground.duration() / dt - 1e-9));
    const auto all_steps = record_steps + static_cast<long>(std::ceil(scene_.sliding.run_out_max / dt - 1e-9));
    const auto rest_steps = static_cast<long>(std::ceil(options_.rest_time / dt - 1e-9));
    for (long n = 0; n < all_steps; ++n) {
        for (int part = 1; part <= parts; ++part) {
            const double time = (static_cast<double>(n) + static_cast<double>(part) / parts) * dt;
            const ContactMemory before = watch ? dynamics.state().contact : ContactMemory();
            dynamics.advance(dt / parts, ground.at(time), strength.law());
            strength.follow(dynamics.state().contact);
            if (watch) {
                friction += friction_work(before, dynamics.state().contact);
                look();
            }
            result.max_slip = std::max(result.max_slip, std::abs(dynamics.mean_slip()));
        }
        add_row();
        if (options_.progress &&
            options_.progress({dynamics.state().time, ground.duration(), n + 1, record_steps}) == RunAnswer::stop) {
            result.status = Status::interrupted;
            break;
        }
        if (!std::isfinite(dynamics.kinetic())) {
            result.status = Status::diverged;
            break;
        }
        if (n + 1 >= record_steps + rest_steps &&
            at_rest(result.history.time, result.history.slip, options_.rest_time)) {
            result.status = Status::at_rest;
            break;
        }
        if (watch && watch->self_excited()) {
            result.status = Status::self_excited;
            break;
        }
    }
    if (watch) result.run_out = watch->figures();
    const ContactMemory& end = dynamics.state().contact;
    result.slip = result.history.slip.back();
    result.end_time = dynamics.state().time;
    result.counts = dynamics.counts();
    result.seconds.contact += result.counts.contact_seconds;
    result.pair_force = end.force;
    result.pair_slip = end.slip - rest.slip;
    result.pair_opening = end.opening;
}

std::optional<double> ReducedRun::truncation_error(const Motion& motion, const Contact& contact,
                                                   const ContactMemory& rest) const
{
    if (system_->modes.complete) return 0.0;
    const Estimators& systems = estimators();
    if (!systems.kept) return std::numeric_limits<double>::quiet_NaN(); // the modes beyond did not converge
    const ContactMemory memory = coarse_.coarsened(rest);
    Motion coarse_motion = motion;
    coarse_motion.contact.landing = Landing::ringing; // few pairs land together: jolts that the full plane has not
    bool interrupted = false;
    const auto slips = [&](const ReducedSystem& system) {
        Strength strength(contact, coarse_.plane());
        strength.follow(memory);
        ReducedResult result;
        shake(coarse_motion, coarse_.plane(), system, strength, memory, nullptr, result);
        interrupted = interrupted || result.status == Status::interrupted;
        return result.history.slip;
    };
    const double modes = static_cast<double>(systems.kept->dam_modes - 3);
    const double more = static_cast<double>(systems.reference->dam_modes - 3);
    const double fewer = static_cast<double>(systems.fewer->dam_modes - 3);
    const std::vector<double> kept = slips(*systems.kept);
    const double to_more = largest_difference(kept, slips(*systems.reference));
    if (interrupted) return std::nullopt;
    if (systems.reference->modes.complete) return to_more;
    if (fewer < 1.0) return to_more / (1.0 - modes / more); // one mode: none to compare with, n^-1 as if the slower
    const double from_fewer = largest_difference(slips(*systems.fewer), kept);
    if (interrupted) return std::nullopt;
    // The error as n^-p: both differences tell it, and their ratio tells p.
    const auto gone = [&](double p) { return 1.0 - std::pow(modes / more, p); };
    const auto gained = [&](double p) { return std::pow(modes / fewer, p) - 1.0; };
    double slow = 1.0, fast = 2.0; // of modes whose frequencies grow as n^1/2; of smooth loads
    for (int k = 0; k < 40; ++k) {
        const double p = 0.5 * (slow + fast);
        (from_fewer * gone(p) > to_more * gained(p) ? slow : fast) = p;
    }
    return std::sqrt(to_more / gone(slow) * from_fewer / gained(slow));
}

ReducedResult ReducedRun::run(const GroundMotion& motion, const std::optional<Contact>& contact,
                              const std::optional<int>& halvings, TruncationEstimate estimate) const
{
    ReducedResult result;
    result.seconds.modes = seconds_;
    if (!system_) {
        result.message =
            !full_.why_not().empty() ? full_.why_not()
            : full_.structure().slides_far()
                ? "A reduced run needs small sliding: each dam node stays opposite its rock node."
            : full_.in_motion().rock_moves()
                ? "A reduced run has no unknowns of a rock box: rock that radiates or is massless, not "
                  "foundation.boundary = \"fixed\" or \"viscous\"."
            : full_.structure().water()
                ? "A reduced run has modes of the dam alone: water as added mass or hydrostatic, not acoustic."
                : "The dam's modes did not converge.";
        return result;
    }
    result.modes = static_cast<int>(system_->dam_modes) - 3;
    result.highest_frequency = std::sqrt(system_->modes.omega2[system_->dam_modes - 1]) / (2.0 * std::numbers::pi);
    const ContactStructure& structure = full_.structure();
    Stopwatch clock;
    StaticContact statics(full_.static_operator(), scene_.contact, options_.contact);
    Strength strength(contact.value_or(scene_.contact), structure.plane());
    ContactMemory memory(structure.plane().pairs());
    result.stages = full_.statics(statics, strength, memory);
    result.seconds.statics = clock.seconds();
    if (result.stages.back().status != StageStatus::ok) {
        result.status = status_of(result.stages.back().status);
        result.message = result.stages.back().text();
        return result;
    }

    clock = Stopwatch();
    Motion loop{GroundInput(motion, scene_.damping.mass, full_.damping().mass), scene_.time.dt.value_or(motion.dt), 1,
                options_.contact};
    const Strength at_start = strength;
    const auto shake_with = [&](int pass) {
        loop.parts = 1 << pass;
        strength = at_start;
        shake(loop, structure.plane(), *system_, strength, memory, &result.stages.back(), result);
        result.halvings = pass;
    };
    const auto wanted = [&] { return scene_.time.slip_tolerance * std::max(result.max_slip, options_.smallest_slip); };
    const std::optional<int> fixed = halvings ? halvings : scene_.time.substeps;
    const int first = fixed.value_or(0);
    shake_with(first);
    std::vector<SlipAtStep> slips{{first, result.slip, 0.0}};
    for (int k = first + 1; !fixed && k <= options_.largest_halvings; ++k) {
        const std::vector<double> coarser = result.history.slip;
        const bool was_self_excited = result.status == Status::self_excited;
        shake_with(k);
        slips.push_back({k, result.slip, largest_difference(coarser, result.history.slip)});
        result.step_error = step_error(slips);
        if (result.step_error <= wanted()) break;
        if (was_self_excited && result.status == Status::self_excited) break; // both agree; there is no slip to refine
    }
    const bool over = result.status == Status::at_rest || result.status == Status::sliding_at_end;
    const double length = structure.plane().length();
    if (over && result.step_error > wanted()) result.status = Status::tolerance_missed;
    const double open = std::isfinite(result.step_error) ? result.step_error : 0.0;
    if (over && result.max_slip - open > length) result.status = Status::runs_away;
    const bool estimated = estimate == TruncationEstimate::made && result.status != Status::self_excited; // no slip
    const std::optional<double> error = !estimated ? std::numeric_limits<double>::quiet_NaN()
                                                   : truncation_error(loop, contact.value_or(scene_.contact), memory);
    if (!error) result.status = Status::interrupted;
    result.truncation_error = error.value_or(std::numeric_limits<double>::quiet_NaN());
    result.seconds.dynamics = clock.seconds();

    clock = Stopwatch();
    const Eigen::VectorXd after = load_with(stages_, full_.model(), options_.uplift_after);
    ContactMemory end = memory;
    end.force = result.pair_force;
    end.slip = memory.slip + result.pair_slip;
    end.opening = result.pair_opening;
    result.after = solve_stage(statics, structure, "after the earthquake", structure.split(after), strength, end);
    result.seconds.statics += clock.seconds();

    if (result.status != Status::interrupted && result.counts.unresolved > 0) result.status = Status::not_resolved;
    result.message = result.status == Status::self_excited ? self_excited_sentence(scene_, result.slip, result.run_out)
                                                           : message_of(result, length);
    return result;
}

} // namespace damslip::fe2d
