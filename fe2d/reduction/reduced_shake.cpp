#include "fe2d/reduction/reduced_run.hpp"
#include "fe2d/run/self_excited.hpp"
#include "fe2d/run/slide_probe.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;

namespace {

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

void reserve(ReducedHistory& history, std::size_t rows)
{
    SlideHistory& slide = history.slide;
    for (std::vector<double>* series :
         {&history.time, &history.slip, &history.crest_x, &history.normal_force, &history.shear_force,
          &slide.thrust_over_friction, &slide.hops, &slide.unloaded_share, &slide.rate})
        series->reserve(rows);
}

} // namespace

ReducedState ReducedRun::shake(const Motion& motion, const ReducedModel& model, Strength& strength,
                               const ContactMemory& rest, const StageResult* balance, ReducedResult& result) const
{
    const double dt = motion.dt;
    const int parts = motion.parts;
    const GroundInput& ground = motion.ground;
    ReducedContact dynamics(model, rest, scene_.contact, motion.contact);
    std::optional<SlideProbe> probe;
    std::optional<SlideWatch> watch;
    const auto look = [&] {
        const ReducedState& now = dynamics.state();
        watch->add(probe->instant(now.time, now.contact, strength.law(), dynamics.friction()));
    };
    const auto add_row = [&] {
        record(dynamics, result.history);
        if (watch) watch->add_row(result.history.slide);
    };
    const auto record_steps = static_cast<long>(std::ceil(ground.duration() / dt - 1e-9));
    const auto all_steps = record_steps + static_cast<long>(std::ceil(scene_.sliding.run_out_max / dt - 1e-9));
    const double rest_time = options_.rest_time.value_or(full_.rest_time());
    const auto rest_steps = static_cast<long>(std::ceil(rest_time / dt - 1e-9));
    result.history = {};
    reserve(result.history, static_cast<std::size_t>(record_steps + rest_steps) + 1);
    if (balance) {
        probe.emplace(full_.structure().planes(), *balance, rest.slip);
        watch.emplace(SlideLimits{ground.duration(), probe->static_normal_force(), scene_.sliding.steady_rate_change},
                      [this] { return full_.window(); });
        look();
    }
    add_row();
    result.dt = dt / parts;
    result.max_slip = 0.0;
    result.status = Status::sliding_at_end;
    for (long n = 0; n < all_steps; ++n) {
        for (int part = 1; part <= parts; ++part) {
            const double time = (static_cast<double>(n) + static_cast<double>(part) / parts) * dt;
            dynamics.advance(dt / parts, ground.at(time), strength.law());
            strength.follow(dynamics.state().contact);
            if (watch) look();
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
            at_rest(result.history.time, result.history.slip, rest_time)) {
            result.status = Status::at_rest;
            break;
        }
        if (watch && watch->self_excited()) {
            result.status = Status::self_excited;
            break;
        }
    }
    if (watch) result.run_out = watch->figures();
    result.slip = result.history.slip.back();
    result.end_time = dynamics.state().time;
    result.counts = dynamics.counts();
    result.seconds.contact += result.counts.contact_seconds;
    return dynamics.state();
}

} // namespace damslip::fe2d
