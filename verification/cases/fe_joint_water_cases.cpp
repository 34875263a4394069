#include "verification/cases/modules.hpp"

#include "fe2d/contact/joint_laws.hpp"
#include "fe2d/contact/joint_water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace damslip::verification {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using fe2d::HeldPressure;
using fe2d::JointChannel;
using fe2d::JointFlowState;
using fe2d::JointFlowStep;
using fe2d::JointFlowWork;
using fe2d::JointFluid;

JointChannel equal_cells(double length, Index cells)
{
    JointChannel channel;
    channel.length = VectorXd::Constant(cells, length / static_cast<double>(cells));
    return channel;
}

JointFlowState full_of_water(Index cells, double pressure = 0.0)
{
    return {VectorXd::Constant(cells, pressure), VectorXd::Zero(cells)};
}

/// Laminar, and no cavitation.
JointFluid ideal_water()
{
    JointFluid fluid;
    fluid.density = 0.0;
    fluid.cavitation = -1e30;
    return fluid;
}

constexpr double viscosity = 1.3e-3; ///< [Pa s]

/// Force on plates that close at 1 mm/s, over ηVL³/w³.
double squeeze_share(Index cells, bool one_end_closed)
{
    constexpr double length = 30.0, width = 2e-3, speed = 1e-3, dt = 1e-4;
    JointChannel channel = equal_cells(length, cells);
    channel.second_open = !one_end_closed;
    const JointFluid fluid = ideal_water();
    const JointFlowState start = full_of_water(cells);
    const VectorXd at_start = VectorXd::Constant(cells, width);
    const JointFlowStep step(channel, fluid, start, at_start, {}, {}, dt);
    const JointFlowState end = step.state(at_start.array() - speed * dt);
    return end.pressure.dot(channel.length) / (viscosity * speed * std::pow(length, 3) / std::pow(width, 3));
}

/// -12η dV/w³ = p'' over m cells: at the centres it is the parabola plus what half a cell at an open end leaves out, so the
/// sum is F(1 + 2/m²) with both ends open, F(1 + 1/(2m²)) with one.
Case closing_plates()
{
    return {"fe.joint-water.closing-plates",
            "Rigid plates that close on water: force with both ends drained and with one end shut",
            "Reynolds' equation integrated: F = ηVL³/w³, and 4ηVL³/w³ with one end shut",
            "the discrete sum is known: F (1 + 2/m²) and 4F (1 + 1/(2m²)) with m cells, so round-off", [] {
                std::vector<Check> checks;
                for (const Index m : {5, 20, 80}) {
                    const double cells = static_cast<double>(m), squared = cells * cells;
                    checks.push_back({fmt::format("F, both ends open, {} cells", m), "ηVL³/w³", 1.0 + 2.0 / squared,
                                      squeeze_share(m, false), 1e-10});
                    checks.push_back({fmt::format("F, one end shut, {} cells", m), "ηVL³/w³", 4.0 + 2.0 / squared,
                                      squeeze_share(m, true), 1e-10});
                }
                return checks;
            }};
}

constexpr double plate_length = 20.0, plate_width = 3e-3, plate_force = 2e5, plate_time = 2.0;

/// 1/w² - 1/w₀² after `plate_time` under a constant force, over 2Ft/(ηL³) of the m cells' own force.
double squeezed_by_force(Index cells, int steps)
{
    const JointChannel channel = equal_cells(plate_length, cells);
    const JointFluid fluid = ideal_water();
    JointFlowState water = full_of_water(cells);
    const double dt = plate_time / steps;
    double width = plate_width;
    for (int n = 0; n < steps; ++n) {
        const VectorXd at_start = VectorXd::Constant(cells, width);
        const JointFlowStep step(channel, fluid, water, at_start, {}, {}, dt);
        // Without storage the pressure is proportional to the closing.
        const double per_closing = step.state(at_start.array() - 1.0).pressure.dot(channel.length);
        width -= plate_force / per_closing;
        water = step.state(VectorXd::Constant(cells, width));
    }
    const double m = static_cast<double>(cells), share = 1.0 + 2.0 / (m * m);
    return (1.0 / (width * width) - 1.0 / (plate_width * plate_width)) /
           (2.0 * plate_force * plate_time / (viscosity * std::pow(plate_length, 3) * share));
}

/// The same in the contact problem: pairs on a plate that only moves as a whole, pressed down by the force, the water as a law.
double squeezed_in_contact(Index pairs, int steps)
{
    auto joint = std::make_shared<fe2d::WetJoint>();
    joint->area = VectorXd::Constant(pairs, plate_length / static_cast<double>(pairs));
    joint->distance.resize(pairs);
    for (Index i = 0; i < pairs; ++i) joint->distance[i] = (static_cast<double>(i) + 0.5) * joint->area[0];
    joint->before.points = {{0.0, 0.0}, {plate_length, 0.0}};
    joint->fluid = ideal_water();
    JointWaterLaw rule;
    rule.opening = OpeningWater::reynolds;
    rule.clearance = 1e-3;
    fe2d::JointLaws laws;
    laws.add(fe2d::make_joint_water(rule, joint));

    const double stiff = 1e16; // of bending the plate [N/m²]: a million times that of the water
    auto stiffness = std::make_shared<MatrixXd>(MatrixXd::Identity(2 * pairs, 2 * pairs));
    stiffness->topLeftCorner(pairs, pairs) =
        stiff * (MatrixXd::Identity(pairs, pairs) - MatrixXd::Constant(pairs, pairs, 1.0 / static_cast<double>(pairs)));
    fe2d::JointLawSolver solver(stiffness, {});
    VectorXd pressed = VectorXd::Zero(2 * pairs);
    pressed.head(pairs).setConstant(plate_force / static_cast<double>(pairs));

    VectorXd opening = VectorXd::Constant(pairs, plate_width - rule.clearance);
    const VectorXd slip = VectorXd::Zero(pairs);
    fe2d::ContactSolution solution;
    solution.states.assign(static_cast<std::size_t>(pairs), fe2d::ContactState::open);
    const fe2d::ContactLaw law = fe2d::uniform_law(pairs, 0.5);
    for (int n = 0; n < steps; ++n) {
        const fe2d::ContactStates states = solution.states;
        const auto report = laws.solve(solver, pressed, {plate_time / steps, opening, slip, states}, law, solution);
        if (!report.resolved()) return std::numeric_limits<double>::quiet_NaN();
        laws.end();
        opening = solution.displacement.head(pairs);
    }
    const double width = rule.clearance + opening.mean(), m = static_cast<double>(pairs), share = 1.0 + 2.0 / (m * m);
    return (1.0 / (width * width) - 1.0 / (plate_width * plate_width)) /
           (2.0 * plate_force * plate_time / (viscosity * std::pow(plate_length, 3) * share));
}

Case pressed_plates()
{
    return {"fe.joint-water.pressed-plates",
            "Rigid plates pressed together by a constant force: alone, and as pairs of the contact problem",
            "w' = -F w³/(ηL³): 1/w² - 1/w₀² = 2Ft/(ηL³), F that of the cells",
            "first order in the step, w³ being that of its start: halving halves the error, ± 5 % of the ratio between "
            "400 and 800 steps; 0.5 % at 800; law against flow alone 1e-5: the law's pressures end within 1e-7 bar and "
            "the plate bends a millionth",
            [] {
                const double coarse = squeezed_by_force(20, 400) - 1.0, fine = squeezed_by_force(20, 800) - 1.0,
                             pairs = squeezed_in_contact(20, 400) - 1.0;
                return std::vector<Check>{
                    {"error over error of half the step", "-", 2.0, coarse / fine, 0.05},
                    {"1/w² - 1/w₀², 800 steps", "2Ft/(ηL³)", 1.0, 1.0 + fine, 0.005},
                    {"the same in the contact problem, 400 steps", "alone", 1.0 + coarse, 1.0 + pairs, 1e-5}};
            }};
}

/// Length of the water in a dry crack, shut at its end.
struct Front {
    double length, cell;
};

Front filling_front(Index cells, double pressure, double seconds)
{
    constexpr double crack = 4.0, width = 1e-3;
    JointChannel channel = equal_cells(crack, cells);
    channel.second_open = false;
    JointFluid fluid = ideal_water();
    fluid.cavitation = 0.0; // air at the front
    const VectorXd widths = VectorXd::Constant(cells, width);
    JointFlowState water{VectorXd::Zero(cells), width * channel.length};
    const double dt = 1e-4;
    for (int n = 0; n < static_cast<int>(std::lround(seconds / dt)); ++n)
        water = JointFlowStep(channel, fluid, water, widths, {pressure, 0.0}, {}, dt).state(widths);
    return {crack - water.empty.sum() / width, crack / static_cast<double>(cells)};
}

Case dry_crack()
{
    return {"fe.joint-water.dry-crack", "Water runs into a dry crack of 1 mm under 600 kPa",
            "x x' = w²p/(12η): x² = w²pt/(6η), 2.77 m after 0.1 s", "one cell, from which the front is read", [] {
                std::vector<Check> checks;
                for (const double seconds : {0.025, 0.05, 0.1}) {
                    const Front front = filling_front(40, 600e3, seconds);
                    checks.push_back({fmt::format("front after {} s", seconds), "m",
                                      1e-3 * std::sqrt(600e3 * seconds / (6.0 * viscosity)), front.length, front.cell,
                                      Measure::absolute});
                }
                return checks;
            }};
}

Case pressure_wave()
{
    return {"fe.joint-water.diffusion", "Pressure at the mouth spreads along a long shut joint with compressible water",
            "p/p₀ = erfc(x/(2√(Dt))), D = w³/(12ηS), S = w/K_w (Carslaw & Jaeger 1959)", "1 % of p₀", [] {
                constexpr double width = 2e-4, length = 12.0;
                constexpr Index m = 240;
                JointFluid fluid = ideal_water();
                fluid.bulk_modulus = 2.2e9;
                const double diffusivity = width * width * fluid.bulk_modulus / (12.0 * viscosity), // of w³/(12ηS)
                    seconds = 1.0 / diffusivity, dt = seconds / 400.0;                              // √(Dt) = 1 m
                const JointChannel channel = equal_cells(length, m);
                const VectorXd widths = VectorXd::Constant(m, width);
                JointFlowState water = full_of_water(m);
                for (int n = 0; n < 400; ++n)
                    water = JointFlowStep(channel, fluid, water, widths, {1.0, 0.0}, {}, dt).state(widths);
                std::vector<Check> checks;
                for (const Index cell : {4, 19, 39, 59}) {
                    const double x = (static_cast<double>(cell) + 0.5) * length / m;
                    checks.push_back({fmt::format("p/p₀ at {:.4g} √(Dt)", x), "-", std::erfc(0.5 * x),
                                      water.pressure[cell], 0.01, Measure::absolute});
                }
                return checks;
            }};
}

double largest_of(const JointFlowWork& w)
{
    return std::max({std::abs(w.walls), std::abs(w.ends), std::abs(w.drain), std::abs(w.rock), std::abs(w.gravity),
                     std::abs(w.viscous), std::abs(w.stored), std::abs(w.cavities)});
}

/// A joint that dips, with a drain and a source, whose faces part and shut twice, the mouth's more than the rest.
struct Parting {
    JointFlowWork work;
    double least_pressure = 0.0, most_empty = 0.0, water_gained = 0.0, water_lost = 0.0;
};

Parting part_and_shut()
{
    constexpr Index m = 30;
    constexpr double length = 40.0, clearance = 2e-4, dt = 2e-3;
    JointChannel channel = equal_cells(length, m);
    channel.fall = 0.05;
    channel.drain = 9;
    JointFluid fluid;
    fluid.bulk_modulus = 2.2e9;
    fluid.unit_weight = 9810.0;
    const HeldPressure held{500e3, 20e3, 150e3};
    VectorXd pressure(m), widths = VectorXd::Constant(m, clearance);
    for (Index i = 0; i < m; ++i) pressure[i] = 500e3 - 480e3 * (static_cast<double>(i) + 0.5) / m;
    pressure[9] = held.drain;
    const VectorXd source = steady_source(channel, fluid, pressure, widths, held);
    JointFlowState water{pressure, VectorXd::Zero(m)};
    Parting result;
    for (int n = 1; n <= 1500; ++n) {
        const double opening = 2e-3 * std::pow(std::sin(2.0 * std::numbers::pi * n * dt / 1.5), 2);
        VectorXd next(m);
        for (Index i = 0; i < m; ++i)
            next[i] = clearance + opening * std::max(0.0, 1.0 - static_cast<double>(i) / 20.0);
        const JointFlowStep step(channel, fluid, water, widths, held, source, dt);
        const JointFlowState end = step.state(next);
        result.work += step.work(end, next);
        result.least_pressure = std::min(result.least_pressure, end.pressure.minCoeff());
        result.most_empty =
            std::max(result.most_empty, end.empty.cwiseQuotient(next.cwiseProduct(channel.length)).maxCoeff());
        water = end;
        widths = next;
    }
    return result;
}

Case parting_plates()
{
    return {
        "fe.joint-water.ledger",
        "Faces part and shut: no pressure below cavitation, no cell emptier than its room, and every joule is found",
        "energy balance of Reynolds' equation, ∫p dw = p₀q₀ - p_L q_L - ∫(12η/w³)q² - storage, term by term",
        "an identity of every step: round-off, 1e-10 of the largest term; the bounds hold exactly", [] {
            const Parting p = part_and_shut();
            return std::vector<Check>{
                {"imbalance over the largest term", "-", 0.0, p.work.imbalance() / largest_of(p.work), 1e-10,
                 Measure::absolute},
                {"least pressure", "kPa", -99.0, 1e-3 * p.least_pressure, 0.0, Measure::lower_bound},
                {"it was reached", "kPa", -99.0, 1e-3 * p.least_pressure, 0.0, Measure::upper_bound},
                {"largest empty share of a cell", "-", 1.0, p.most_empty, 0.0, Measure::upper_bound},
                {"some cell was half empty", "-", 0.5, p.most_empty, 0.0, Measure::lower_bound},
                {"lost to viscosity", "J/m", 0.0, p.work.viscous, 0.0, Measure::lower_bound}};
        }};
}

Case fast_flow()
{
    return {"fe.joint-water.turbulent", "Steady flow along a wide joint beyond the laminar range",
            "Darcy-Weisbach with Blasius' friction: dp/dx = f ρq²/(4w³), f = 0.316 (2q/ν)^-1/4; laminar below the "
            "crossing with 96/Re",
            "the secant repeats itself in a steady flow: 1e-10", [] {
                std::vector<Check> checks;
                for (const double width : {1e-4, 5e-3}) {
                    constexpr Index m = 12;
                    constexpr double length = 30.0, fall = 600e3;
                    JointFluid fluid;
                    fluid.cavitation = -1e30;
                    const JointChannel channel = equal_cells(length, m);
                    const VectorXd widths = VectorXd::Constant(m, width);
                    JointFlowState water = full_of_water(m);
                    for (Index i = 0; i < m; ++i) water.pressure[i] = fall * (1.0 - (static_cast<double>(i) + 0.5) / m);
                    const JointFlowStep step(channel, fluid, water, widths, {fall, 0.0}, {}, 0.01);
                    const double flow = step.flux(step.state(widths))[m / 2], cube = std::pow(width, 3);
                    const double laminar = cube / (12.0 * viscosity) * fall / length;
                    const double kinematic = viscosity / 1000.0;
                    const double turbulent = std::pow(
                        fall / length * 4.0 * cube * std::pow(2.0 / kinematic, 0.25) / (0.316 * 1000.0), 4.0 / 7.0);
                    checks.push_back({fmt::format("q, width {} mm, Re {:.3g}", 1e3 * width, 2.0 * flow / kinematic),
                                      "m²/s", std::min(laminar, turbulent), flow, 1e-10});
                }
                return checks;
            }};
}

/// A stiff block over m pairs whose heel opens by 1 mm and shuts, under each rule.
struct RuleRun {
    double largest_crack = 0.0, most = 0.0, least = 0.0, work = 0.0;
};

RuleRun open_and_shut(OpeningWater opening, double speed)
{
    constexpr Index m = 21;
    constexpr double length = 40.0, head = 400e3;
    auto joint = std::make_shared<fe2d::WetJoint>();
    joint->distance = VectorXd::LinSpaced(m, 0.0, length);
    joint->area = VectorXd::Constant(m, length / (m - 1));
    joint->area[0] = joint->area[m - 1] = 0.5 * length / (m - 1);
    joint->before.points = {{0.0, head}, {length, 0.0}};
    joint->upstream_pressure = head;
    joint->cracked = [=](double crack, double) { return PressureProfile{{{0.0, head}, {crack, head}, {length, 0.0}}}; };
    JointWaterLaw law;
    law.opening = opening;
    if (opening == OpeningWater::mouth) law.mouth_speed = speed;
    const auto water = fe2d::make_joint_water(law, joint);
    fe2d::ContactSolution solution;
    solution.force = solution.displacement = VectorXd::Zero(2 * m);
    VectorXd before = VectorXd::Zero(m);
    const VectorXd slip = VectorXd::Zero(m);
    RuleRun run;
    for (int n = 1; n <= 100; ++n) { // open to 16 m at half-time
        const double tip = 16.0 * std::sin(std::numbers::pi * n / 100.0);
        fe2d::ContactStates states(m, fe2d::ContactState::stick);
        for (Index i = 0; i < m; ++i) {
            const double g = 1e-4 * std::max(0.0, tip - joint->distance[i]);
            solution.displacement[i] = g;
            if (g > 0.0) states[static_cast<std::size_t>(i)] = fe2d::ContactState::open;
        }
        const fe2d::ContactStates was = solution.states.empty() ? states : solution.states;
        solution.states = states;
        water->begin({0.01, before, slip, was});
        water->end(solution);
        before = solution.displacement.head(m);
        const VectorXd change = water->report().pressure;
        const double uplift = change.dot(joint->area) - 0.5 * head * length;
        run.most = std::max(run.most, uplift);
        run.least = std::min(run.least, uplift);
        run.largest_crack = water->report().largest.upstream;
    }
    run.work = water->energy().water;
    return run;
}

Case rules()
{
    return {
        "fe.joint-water.rules", "Rules zero, full and mouth while a wedge of a crack opens to 16 m of 40 m and shuts",
        "triangles of pressure by hand: full adds head · tip/2 for a crack of length tip, zero takes "
        "head · tip (1 - tip/(2L)); fast water is full, slow water is zero",
        "the tip of a wedge is found exactly; pressure follows one step late: tip 15.98 m at most: 0.2 %; the pairs "
        "share out the jump at the tip, their sum is exact; ratio to full and zero 1e-12",
        [] {
            const RuleRun full = open_and_shut(OpeningWater::full, 0.0), zero = open_and_shut(OpeningWater::zero, 0.0),
                          fast = open_and_shut(OpeningWater::mouth, 1e6),
                          slow = open_and_shut(OpeningWater::mouth, 1e-12);
            constexpr double head = 400e3, tip = 16.0, length = 40.0;
            return std::vector<Check>{
                {"largest crack", "m", tip, full.largest_crack, 1e-12},
                {"full: uplift gained", "N/m", 0.5 * head * tip, full.most, 2e-3},
                {"zero: uplift lost", "N/m", -head * tip * (1.0 - 0.5 * tip / length), zero.least, 2e-3},
                {"mouth, very fast: uplift gained, over full", "-", 1.0, fast.most / full.most, 1e-12},
                {"mouth, very slow: uplift lost, over zero", "-", 1.0, slow.least / zero.least, 1e-9}};
        }};
}

} // namespace

void add_fe_joint_water_cases(Registry& registry)
{
    for (const Case& c :
         {closing_plates(), pressed_plates(), dry_crack(), pressure_wave(), parting_plates(), fast_flow(), rules()})
        registry.push_back(c);
}

} // namespace damslip::verification
