#include "records/transform/transform.hpp"
#include "sliding/block/slide.hpp"
#include "verification/cases/fe_run_scenes.hpp"
#include "verification/cases/modules.hpp"

#include <cmath>
#include <functional>

namespace damslip::verification {

namespace {

using namespace damslip::sliding;

/// A block on a level base under a steady push for `t1`, then under its thrust alone:
///
///     m v' = P - N (mu_k + Δmu e^{-v/v_c}),   y = e^{v/v_c} = y* + (y_0 - y*) e^{at},
///     a = (P - N mu_k)/(m v_c),   y* = N Δmu/(P - N mu_k).
struct RateSlider {
    double mass = 2.0, normal = 20.0, friction = 0.5, ratio = 0.8, v_c = 0.05;
    double push = 3.0;   ///< a_h of the first part [m/s^2]
    double thrust = 0.0; ///< static [N/m]
    double t1 = 0.2;

    double kinetic() const { return ratio * friction; }
    double fall() const { return friction - kinetic(); }
    double growth(double force) const { return (force - normal * kinetic()) / (mass * v_c); }
    double steady(double force) const { return normal * fall() / (force - normal * kinetic()); }
    double y_at(double force, double y0, double t) const
    {
        return steady(force) + (y0 - steady(force)) * std::exp(growth(force) * t);
    }
    double first_force() const { return mass * push + thrust; }
    double y1() const { return y_at(first_force(), 1.0, t1); }
    /// From the end of the push on.
    double time_to_stop() const
    {
        if (thrust == 0.0)
            return mass * v_c / (normal * kinetic()) *
                   std::log((y1() + fall() / kinetic()) / (1.0 + fall() / kinetic()));
        return std::log((1.0 - steady(thrust)) / (y1() - steady(thrust))) / growth(thrust);
    }
    SlideResult run() const
    {
        RigidBlock block;
        block.mass = mass;
        block.gravity = normal / mass;
        block.friction = friction;
        block.horizontal_force = thrust;
        RateFriction rate;
        rate.kinetic_ratio = ratio;
        rate.characteristic_rate = v_c;
        return slide({"", t1, {push, push}, {}, {}}, SlipStages{{0.0, block, 0.0, rate}});
    }
};

/// Gauss-Legendre with four points on each of n equal parts.
double integral(const std::function<double(double)>& f, double end, int n)
{
    const double x[] = {0.3399810435848563, 0.8611363115940526}, w[] = {0.6521451548625461, 0.3478548451374538};
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
        const double half = 0.5 * end / n, middle = (2 * i + 1) * half;
        for (int k = 0; k < 2; ++k) sum += half * w[k] * (f(middle - half * x[k]) + f(middle + half * x[k]));
    }
    return sum;
}

std::vector<Check> rate_slider()
{
    std::vector<Check> checks;
    for (const double thrust : {0.0, 4.0})
        for (const double v_c : {0.05, 1e-3}) {
            const RateSlider slider{.v_c = v_c, .push = 6.0, .thrust = thrust, .t1 = v_c < 0.01 ? 0.01 : 0.2};
            const SlideResult result = slider.run();
            const auto rate = [&](double force, double y0) {
                return [&slider, force, y0](double t) { return slider.v_c * std::log(slider.y_at(force, y0, t)); };
            };
            const double slip = integral(rate(slider.first_force(), 1.0), slider.t1, 4000) +
                                integral(rate(thrust, slider.y1()), slider.time_to_stop(), 4000);
            const std::string at =
                ", P " + std::to_string(static_cast<int>(thrust)) + " N, v_c " + (v_c < 0.01 ? "1 mm/s" : "50 mm/s");
            checks.push_back({"rate at the end of the push" + at, "m/s", slider.v_c * std::log(slider.y1()),
                              result.peak_slip_rate, 1e-10});
            checks.push_back({"stop" + at, "s", slider.t1 + slider.time_to_stop(), result.last_slip_time, 1e-10});
            checks.push_back({"slip" + at, "m", slip, result.slip, 1e-10});
        }
    // A law that does not fall must give the bits' neighbour of plain friction: mu_k = mu (1 - 1e-15) is that to round-off.
    RateSlider plain;
    plain.ratio = 1.0 - 1e-13;
    plain.push = 6.0;
    const double rate = (plain.push - plain.friction * plain.normal / plain.mass) * plain.t1;
    checks.push_back({"mu_k -> mu: rate of constant friction", "m/s", rate, plain.run().peak_slip_rate, 1e-10});
    return checks;
}

/// Friction that lags by a time alone, under a rate so large that mu(v) = mu_k: mu falls as e^{-t/tau}.
std::vector<Check> lag()
{
    const double tau = 0.3, t1 = 0.5, push = 8.0, mu = 0.5, k = 0.6, g = 10.0;
    RigidBlock block;
    block.mass = 1.0;
    block.gravity = g;
    block.friction = mu;
    RateFriction rate;
    rate.kinetic_ratio = k;
    rate.characteristic_rate = 1e-9;
    rate.relaxation_time = tau;
    const SlideResult result = slide({"", t1, {push, push}, {}, {}}, SlipStages{{0.0, block, 0.0, rate}});
    const double v1 = (push - g * k * mu) * t1 - g * (1.0 - k) * mu * tau * (1.0 - std::exp(-t1 / tau));
    // Stops where v1 = g k mu x + g (1 - k) mu tau e^{-t1/tau} (1 - e^{-x/tau}), x the time from t1 on.
    double x = v1 / (g * k * mu);
    for (int i = 0; i < 100; ++i) {
        const double left = std::exp(-t1 / tau) * (1.0 - k) * g * mu;
        x -= (g * k * mu * x + left * tau * (1.0 - std::exp(-x / tau)) - v1) / (g * k * mu + left * std::exp(-x / tau));
    }
    // v_c is not zero but 1e-9 m/s: it shifts rates by some 1e-9 m/s.
    return {{"rate at the end of the push, lag 0.3 s", "m/s", v1, result.peak_slip_rate, 1e-8},
            {"stop, lag 0.3 s", "s", t1 + x, result.last_slip_time, 1e-8}};
}

/// A block with uplift thrown up by the ground: a_v = -A for one sample, back to zero over the next.
struct Bounce {
    double mass = 2.0, gravity = 10.0, uplift = 4.0, friction = 2.0, thrust = 0.0, restitution = 0.6;
    static constexpr double dt = 0.1, push = 24.0;

    double g() const { return gravity - uplift / mass; }
    double lift() const { return 0.5 * (push - g()) * dt * dt; }
    double rate() const { return (push - g()) * dt; }
    double rate_1() const { return rate() + (0.5 * push - g()) * dt; }
    double height() const
    {
        const double y1 = lift() + rate() * dt + 0.5 * (push - g()) * dt * dt - push * dt * dt / 6.0;
        return y1 + 0.5 * rate_1() * rate_1() / g();
    }
    double top() const { return 2.0 * dt + rate_1() / g(); } ///< when it is highest [s]
    double fall() const { return std::sqrt(2.0 * height() / g()); }

    SlideResult run() const
    {
        RigidBlock block;
        block.mass = mass;
        block.gravity = gravity;
        block.uplift = uplift;
        block.friction = friction;
        block.horizontal_force = thrust;
        SlideOptions options;
        options.sliding.lift_off = LiftOff::ballistic;
        SlipStage stage{0.0, block, 0.0};
        stage.restitution = restitution;
        return slide({"", dt, {0.0, 0.0, 0.0}, {-push, -push, 0.0}, {}}, SlipStages{stage}, options);
    }
};

std::vector<Check> bounces()
{
    std::vector<Check> checks;
    for (const double e : {0.0, 0.3, 0.6, 0.9}) {
        const Bounce bounce{.restitution = e};
        const SlideResult result = bounce.run();
        const std::string at = ", e " + std::to_string(e).substr(0, 3);
        checks.push_back({"height" + at, "m", bounce.height(), result.max_gap, 1e-10});
        checks.push_back(
            {"rests" + at, "s", bounce.top() + bounce.fall() * (1.0 + e) / (1.0 - e), result.last_landing_time, 1e-10});
        checks.push_back({"loss" + at, "J/m", bounce.mass * bounce.g() * bounce.height(), result.impact_loss, 1e-10});
    }
    return checks;
}

std::vector<Check> bounces_under_thrust()
{
    std::vector<Check> checks;
    for (const double e : {0.0, 0.5, 0.8}) {
        const Bounce bounce{.thrust = 6.0, .restitution = e};
        const double accel = bounce.thrust / bounce.mass, first = bounce.top() + bounce.fall();
        const double next = 2.0 * e * bounce.fall(); // the flight that begins with the first landing
        checks.push_back({"slip, e " + std::to_string(e).substr(0, 3), "m",
                          0.5 * accel * (first * first + next * next / (1.0 - e * e)), bounce.run().slip, 1e-10});
    }
    return checks;
}

/// Strength that falls with the path and the rate, cohesion that is lost, drains that fail: all of it goes on.
SlipStages ageing_block(double lag)
{
    Contact contact;
    contact.cohesion = 0.3;
    contact.cohesion_lost_at_slip = true;
    contact.friction_table = {{0.0, 0.62}, {0.03, 0.55}, {0.2, 0.5}};
    contact.rate.kinetic_ratio = 0.9;
    contact.rate.characteristic_rate = 0.05;
    if (lag > 0.0) contact.rate.relaxation_time = lag;
    RigidBlock block;
    block.mass = 1.0;
    block.horizontal_force = 3.0;
    block.uplift = 0.5;
    block.cohesion_force = 0.3;
    RigidBlock later = block;
    later.uplift = 1.0;
    return with_block_from(strength_stages(block, contact), 0.05, later);
}

std::vector<Check> sequences()
{
    std::vector<Check> checks;
    const GroundMotion first = fe2d::test::sines(5.5, 8.0, 5), second = fe2d::test::sines(5.0, 6.0, 9, 0.005);
    GroundMotion sequence = records::one_after_the_other({first, second}, 2.0);
    for (const double lag : {0.0, 1.0}) {
        const SlipStages stages = ageing_block(lag);
        const std::string at = lag > 0.0 ? ", friction lags by 1 s" : "";
        const SlideResult both = slide(sequence, stages);
        std::vector<double> starts;
        for (const EventSlip& event : both.events) starts.push_back(event.start);
        const SlideResult one = slide(records::as_played(sequence, starts), stages);
        checks.push_back({"slip, one record" + at, "m", one.slip, both.slip, 0.0, Measure::absolute});
        checks.push_back({"upstream slip" + at, "m", one.upstream_slip, both.upstream_slip, 0.0, Measure::absolute});
        checks.push_back({"last movement" + at, "s", one.last_slip_time, both.last_slip_time, 0.0, Measure::absolute});
        checks.push_back({"events" + at, "–", 2.0, static_cast<double>(both.events.size()), 0.0, Measure::absolute});
        // What is not carried would show: a fresh block slips less in the second record.
        checks.push_back({"second event over the same record on a fresh block" + at, "–", 1.05,
                          both.events.back().change / slide(second, stages).slip, 0.0, Measure::lower_bound});
    }
    return checks;
}

} // namespace

void add_block_rate_cases(Registry& registry)
{
    registry.push_back(
        {"sliding.block.rate-friction",
         "Friction that falls exponentially with the rate of slip: rate, stop and slip of a pushed block",
         "m v' = P - N (mu_k + Δmu e^{-v/v_c}) with y = e^{v/v_c}: linear in y; slip by quadrature of ln y",
         "1e-10: Taylor series to round-off, events located to the last digits", rate_slider});
    registry.push_back({"sliding.block.rate-lag", "Friction that lags behind its rate by a time",
                        "by hand: mu falls as e^{-t/tau} where v >> v_c", "1e-8: v_c is 1e-9 m/s, not zero", lag});
    registry.push_back({"sliding.block.bounce", "A block that rebounds rests after a geometric series of flights",
                        "t = sqrt(2H/g')(1 + e)/(1 - e) from the top, loss m g' H, g' = g - U/m",
                        "1e-10: flights below 1e-13 s are left out", bounces});
    registry.push_back({"sliding.block.bounce-under-thrust", "It slides in its flights and sticks between them",
                        "1/2 (T/M) Σ τ_n², τ_n as eⁿ from the first landing on (friction stops it: FS (1 + e)/2 >= 1)",
                        "1e-10: as above", bounces_under_thrust});
    registry.push_back({"sliding.block.sequence", "Two records in sequence are one record with the pause between them",
                        "the same block under that one record", "none: the same bits", sequences});
}

} // namespace damslip::verification
