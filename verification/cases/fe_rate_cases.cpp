#include "verification/cases/modules.hpp"

#include "fe2d/contact/joint_laws.hpp"
#include "fe2d/contact/joint_law.hpp"
#include "fe2d/run/ground_input.hpp"
#include "records/transform/transform.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace damslip::verification {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using fe2d::EarthquakeRun;
using fe2d::RunResult;

RateFriction rate_of(double ratio, double v_c)
{
    RateFriction rate;
    rate.kinetic_ratio = ratio;
    rate.characteristic_rate = v_c;
    return rate;
}

/// A mass on a spring and a dashpot that a belt drags along with the speed V: friction that falls with the rate feeds the
/// vibration about the steady slide. Average acceleration (Newmark), the law in the contact problem of one pair.
class BeltOscillator {
public:
    double mass = 1.0, stiffness = 100.0, damping = 0.2, normal = 1.0, speed = 0.05, dt = 1e-3;
    double friction = 0.5, ratio = 0.8, v_c = 0.1;

    double fall() const { return (1.0 - ratio) * friction; }
    double growth() const { return 0.5 * (normal * fall() * std::exp(-speed / v_c) / v_c - damping) / mass; }
    /// ln of the amplitude's growth over n periods, over the time.
    double measured(int periods) const
    {
        const double omega = std::sqrt(stiffness / mass - growth() * growth());
        const auto steps = static_cast<long>(std::lround(periods * 2.0 * std::numbers::pi / omega / dt));
        const double balance = normal * (ratio * friction + fall() * std::exp(-speed / v_c)) / stiffness;
        const double a0 = 4.0 / (dt * dt), a1 = 2.0 / dt, a2 = 4.0 / dt; // a3 = 1, a4 = 1, a5 = 0
        const double step_stiffness = a0 * mass + a1 * damping + stiffness;
        MatrixXd v(2, 2);
        v << 1e3 * step_stiffness, 0.0, 0.0, step_stiffness;
        fe2d::JointLawSolver solver(std::make_shared<const MatrixXd>(v), {});
        fe2d::JointLaws laws;
        laws.add(std::make_unique<fe2d::RateFrictionLaw>(
            1, std::vector<fe2d::RateFrictionPart>{{0, 1, rate_of(ratio, v_c)}}));
        const fe2d::ContactLaw strength = fe2d::uniform_law(1, friction);
        const VectorXd none = VectorXd::Zero(1);
        fe2d::ContactSolution solution;
        solution.states = {fe2d::ContactState::slip_upstream};
        double x = balance + 1e-7, rate = 0.0, accel = 0.0;
        const auto amplitude = [&] {
            const double from = x - balance;
            return std::sqrt(from * from + rate * rate * mass / stiffness);
        };
        const double before = amplitude();
        for (long n = 0; n < steps; ++n) {
            const double known = mass * (a2 * rate + accel) + damping * rate - stiffness * x;
            VectorXd stuck(2), rate_known(1);
            stuck << normal, step_stiffness * speed * dt - known;
            rate_known << a1 * speed * dt - rate - speed;
            const fe2d::ContactStates states = solution.states;
            laws.solve(solver, stuck, {dt, none, none, states, a1, rate_known}, strength, solution);
            laws.end();
            const double step = solution.displacement[1] + speed * dt;
            const double next = a0 * step - a2 * rate - accel;
            rate = a1 * step - rate;
            accel = next;
            x += step;
        }
        return std::log(amplitude() / before) / (static_cast<double>(steps) * dt);
    }
};

std::vector<Check> belt()
{
    BeltOscillator grows, falls;
    falls.damping = 1.2;
    return {{"growth, friction feeds more than the dashpot takes", "1/s", grows.growth(), grows.measured(8), 0.01},
            {"growth, the dashpot takes more", "1/s", falls.growth(), falls.measured(4), 0.01}};
}

/// One pair under a constant push in steps of Δt: the answer of each step solves its own equation, and a step too long for one
/// answer is refused.
std::vector<Check> uniqueness()
{
    const double mass = 1.0, normal = 10.0, friction = 0.5, ratio = 0.6, v_c = 0.01;
    const double longest =
        v_c * mass / (normal * (1.0 - ratio) * friction); // Δt of v_c/(g' Δμ), first-order rate update
    const auto resolves = [&](double dt, double push) {
        // x = v Δt: m (v - v_0)/Δt = push + λ_t
        MatrixXd v(2, 2);
        v << 1e6, 0.0, 0.0, mass / (dt * dt);
        fe2d::JointLawSolver solver(std::make_shared<const MatrixXd>(v), {});
        fe2d::JointLaws laws;
        laws.add(std::make_unique<fe2d::RateFrictionLaw>(
            1, std::vector<fe2d::RateFrictionPart>{{0, 1, rate_of(ratio, v_c)}}));
        VectorXd stuck(2);
        stuck << normal, -push;
        const VectorXd none = VectorXd::Zero(1);
        fe2d::ContactSolution solution;
        solution.states = {fe2d::ContactState::stick};
        const fe2d::ContactStates states = solution.states;
        const auto report = laws.solve(solver, stuck, {dt, none, none, states, 1.0 / dt, none},
                                       fe2d::uniform_law(1, friction), solution);
        const double rate = solution.displacement[1] / dt;
        const double residual =
            mass * rate / dt - push + normal * friction * (ratio + (1.0 - ratio) * std::exp(-std::abs(rate) / v_c));
        return std::pair(report.resolved() ? 1.0 : 0.0, residual);
    };
    const double push = 1.001 * normal * friction;
    const auto [short_step, residual] = resolves(0.5 * longest, push);
    return {
        {"half the longest step: resolved", "–", 1.0, short_step, 0.0, Measure::absolute},
        {"its equation of motion", "N/m", 0.0, residual, 1e-9, Measure::absolute},
        {"one and a half times it: resolved", "–", 0.0, resolves(1.5 * longest, push).first, 0.0, Measure::absolute}};
}

Scene plain_dam(double contact_size)
{
    Scene scene = fe2d::test::sliding_dam(0.75, 1.0, contact_size);
    scene.mesh.size = 8.0;
    scene.time.substeps = 0;
    scene.damping.stiffness_coefficient = 1e-3;
    return scene;
}

std::vector<Check> sequence()
{
    std::vector<Check> checks;
    Scene scene = plain_dam(9.0);
    scene.contact.residual_friction = 0.72;
    scene.contact.residual_slip = 0.004;
    scene.contact.rate = rate_of(0.95, 0.02);
    scene.contact.rate.relaxation_time = 0.1;
    const GroundMotion both =
        records::one_after_the_other({fe2d::test::sines(1.0, 4.0, 5), fe2d::test::sines(1.2, 3.0, 9)}, 0.3);
    const EarthquakeRun run(scene, fe2d::test::options_of(scene));
    const RunResult sequence = run.run(both);
    std::vector<double> starts;
    for (const EventSlip& event : sequence.events) starts.push_back(event.start);
    const GroundMotion one = records::as_played(both, starts);
    const RunResult whole = run.run(one);
    checks.push_back({"slip, one record", "m", whole.slip, sequence.slip, 0.0, Measure::absolute});
    checks.push_back({"friction's work", "J/m", whole.history.energy.back().friction,
                      sequence.history.energy.back().friction, 0.0, Measure::absolute});
    checks.push_back({"crest at the end", "m", whole.history.crest_x.back(), sequence.history.crest_x.back(), 0.0,
                      Measure::absolute});
    checks.push_back({"events", "–", 2.0, static_cast<double>(sequence.events.size()), 0.0, Measure::absolute});
    const double alone = run.run(fe2d::test::sines(1.2, 3.0, 9)).slip;
    // of a dam whose joint has slid before: not that of a new one
    checks.push_back({"second event against its record on a dam that has not slid", "–", 0.01,
                      std::abs(sequence.events.back().change / alone - 1.0), 0.0, Measure::lower_bound});
    checks.push_back(
        {"energy imbalance over the largest term", "–", 1e-9, sequence.energy_error, 0.0, Measure::upper_bound});
    return checks;
}

} // namespace

void add_fe_rate_cases(Registry& registry)
{
    registry.push_back({"fe.friction.belt",
                        "Friction that falls with the rate feeds the vibration of a mass on a moving belt",
                        "growth 1/2 (N Δmu e^{-V/v_c}/v_c - c_d)/m of small vibrations",
                        "1 %: average acceleration, 600 steps a period, damping of second order left out", belt});
    registry.push_back(
        {"fe.friction.rate-unique",
         "A step has one answer below v_c/(g' Δmu) for a first-order update of the rate; longer ones are refused",
         "m v/Δt = P - N mu(v), slopes compared", "1e-9 N of 10 N: friction settles to 1e-12", uniqueness});
    registry.push_back({"fe.run.sequence", "Two records in sequence are one record with the pause between them",
                        "the same run under that one record", "none: the same bits; 1e-9 round-off of all steps",
                        sequence});
}

} // namespace damslip::verification
