#include "fe2d/run/earthquake_lane.hpp"
#include "fe2d/run/ground_input.hpp"
#include "fe2d/run/slide_probe.hpp"
#include "fe2d/time/explicit_run.hpp"

#include "core/input_error.hpp"
#include "core/stopwatch.hpp"

#include <algorithm>
#include <cmath>

/// The passes of an earthquake run by explicit steps (ExplicitContact).
namespace damslip::fe2d {

namespace {

/// The work ledger is an identity and closes in an unstable run, too; there ½u_{n+1}ᵀKu_n goes below zero and the kinetic energy
/// beyond all that was put in.
bool has_diverged(const ContactMotion& dynamics, double start_strain)
{
    const Energy& e = dynamics.energy();
    const double given = start_strain + std::abs(e.external) + std::abs(e.contact_normal) + std::abs(e.friction);
    return !std::isfinite(e.kinetic) || e.kinetic > 1e-4 * dynamics.static_normal_force() + 10.0 * given;
}

ExplicitLimit limit_of(const ExplicitOperators& operators)
{
    return {operators.highest_frequency(), operators.limit(), operators.undamped_limit()};
}

} // namespace

/// @throws InputError for a step above the limit, and for joints that share nodes
std::shared_ptr<const ExplicitOperators> EarthquakeRun::explicit_operators() const
{
    auto operators = std::make_shared<const ExplicitOperators>(*structure_, damping_);
    if (!operators->separable())
        throw InputError(Diagnostic{
            scene_.file.string(), 0, 0, "time.scheme = \"central-difference\" with planes that share nodes.",
            "planes without common nodes: each pair is then a problem of its own", "use  scheme = \"hht\"  in [time]"});
    if (scene_.time.dt) explicit_step(*scene_.time.dt, scene_.time.dt, limit_of(*operators));
    return operators;
}

RunResult EarthquakeRun::shake_explicitly(int halvings, const Lane& lane) const
{
    const Stopwatch clock;
    const GroundMotion& motion = *lane.motion;
    const double row = motion.dt, duration = row * static_cast<double>(motion.accel_h.size() - 1);
    const double step = lane.steps && lane.steps->step
                            ? *lane.steps->step
                            : explicit_step(row, scene_.time.dt, limit_of(*explicit_)) / (1 << halvings);
    const long parts = std::lround(row / step);
    const GroundInput ground(motion, damping_.mass, damping_.constants.mass);
    const auto record_steps = std::lround(duration / row);
    const long all_steps = record_steps + static_cast<long>(std::ceil(scene_.sliding.run_out_max / row - 1e-9));
    const long rest_steps = static_cast<long>(std::ceil(rest_time() / row - 1e-9));
    ExplicitContact dynamics(explicit_, split(stages_.loads.size() - 1), lane.start, lane.memory);
    Strength strength = lane.strength;
    RunResult result = lane.result;
    result.dt = step;
    result.halvings = halvings;
    result.status = Status::sliding_at_end;
    HistoryRecorder recorder(dynamics, result.history, options_.pair_series, frame_interval(duration));
    const SlideProbe probe(structure_->planes(), lane.result.stages.back(), dynamics.state().contact.slip);
    SlideWatch watch = slide_watch(lane, duration);
    const auto look = [&] { watch.add(probe.instant(dynamics, strength.law())); };
    const auto add_row = [&] {
        recorder.add();
        watch.add_row(result.history.slide);
    };
    look();
    add_row();
    std::vector<GroundAcceleration> ahead(static_cast<std::size_t>(strength.constant() ? parts : 1));
    for (long n = 0; n < all_steps && result.status == Status::sliding_at_end; ++n) {
        for (long done = 0; done < parts; done += static_cast<long>(ahead.size())) {
            for (std::size_t k = 0; k < ahead.size(); ++k)
                ahead[k] = ground.at((static_cast<double>(n) + static_cast<double>(done + static_cast<long>(k) + 1) /
                                                                   static_cast<double>(parts)) *
                                     row);
            dynamics.advance(step, ahead, strength.law());
            strength.follow(dynamics.state().contact);
            look();
        }
        add_row();
        if (options_.progress &&
            options_.progress(progress_of(lane, halvings, record_steps, n + 1, row)) == RunAnswer::stop)
            result.status = Status::interrupted;
        else if (has_diverged(dynamics, result.history.energy.front().strain))
            result.status = Status::diverged;
        else if (n + 1 >= record_steps + rest_steps && at_rest(result.history, rest_time()))
            result.status = Status::at_rest;
        else if (watch.self_excited())
            result.status = Status::self_excited;
    }
    recorder.finish();
    result.run_out = watch.figures();
    end_lane(dynamics, strength, lane, result);
    result.seconds.dynamics += clock.seconds();
    return result;
}

} // namespace damslip::fe2d
