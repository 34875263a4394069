#include "verification/cases/modules.hpp"

#include "fe2d/contact/contact_solver.hpp"
#include "fe2d/time/linear_integrator.hpp"
#include "verification/cases/fe_time_models.hpp"
#include "verification/exact/coulomb_oscillator.hpp"
#include "verification/exact/frictional_bed.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace damslip::verification {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using std::numbers::pi;

std::string fixed(double value, int digits)
{
    return fmt::format("{:.{}f}", value, digits);
}

/// Largest difference in u from the event-located motion while the scheme follows it from `start` on, in units of F_0/k.
double oscillator_error(const exact::CoulombOscillator& o, const exact::CoulombMotion& motion, double start,
                        int periods, int steps_per_period, const fe2d::Scheme& scheme)
{
    const double k = o.frequency * o.frequency, dt = 2.0 * pi / o.drive / steps_per_period; // m = 1, F_0 = k
    fe2d::LinearIntegrator integrator(oscillator(o.frequency, 0.0), scheme);
    const fe2d::StepOperator& op = integrator.step_operator(dt);
    const double response = op.solve(VectorXd::Ones(1))[0], flexibility = (1.0 + scheme.alpha) * response;
    // One pair: pressed with a constant force, free to slide.
    fe2d::ContactSolver solver(Eigen::Vector2d::Constant(1.0 / flexibility).asDiagonal().toDenseMatrix());
    const fe2d::ContactLaw law = fe2d::uniform_law(1, o.friction);
    fe2d::ContactSolution contact;
    const auto one = [](double value) { return VectorXd::Constant(1, value); };
    const auto load = [&](double t) { return one(k * std::cos(o.drive * t)); };
    const double v0 = motion.velocity(start);
    fe2d::State before = integrator.start(one(motion.displacement(start)), one(v0), load(start),
                                          one(v0 == 0.0 ? 0.0 : -std::copysign(o.friction * k, v0))),
                after;
    double error = 0.0;
    for (int n = 1; n <= periods * steps_per_period; ++n) {
        const double t = start + n * dt;
        const fe2d::FreeStep free = integrator.free_step(op, before, load(t));
        solver.solve(Eigen::Vector2d(k, -free.increment[0] / flexibility), law, contact);
        const VectorXd friction = contact.force.tail(1);
        integrator.finish_step(op, before, load(t), free, {friction, response * friction}, after);
        std::swap(before, after);
        error = std::max(error, std::abs(before.displacement[0] - motion.displacement(t)));
    }
    return error;
}

/// The largest of five starts in the steady motion, at steps of 1/n of the drive's period: where a reversal falls
/// within its step is a matter of chance, so one start alone scatters.
double largest_error(const exact::CoulombOscillator& o, const exact::CoulombMotion& motion, int n,
                     const fe2d::Scheme& scheme)
{
    double error = 0.0;
    for (int k = 0; k < 5; ++k) {
        const double start = (100.0 + 0.377 * k) * 2.0 * pi / o.drive;
        error = std::max(error, oscillator_error(o, motion, start, 2, n, scheme));
    }
    return error;
}

constexpr int fine = 4000; ///< steps a period

/// Bound of the error of u over two periods with average acceleration, five reversals or stops at most:
///
/// A step in which the velocity changes its sign ends with u exact to the second order, but the friction in it (and in
/// the next step, by the trapezoid) is known up to its sign only. Going through the cases (reverses, sticks for a step,
/// goes on; the time theta dt of the reversal within the step) its impulse is wrong by 2 f dt F_0 at most; at a stop
/// the scheme keeps the last velocity with alternating sign, (g + f) dt F_0/m with a rest g <= f of the load, until the
/// mass breaks away. Each is a velocity error of 2 f w^2 dt, a displacement amplitude of 2 f w dt; Coulomb friction is
/// monotone, so two motions never get further apart in energy and the errors only add. The smooth part of the motion
/// has the period error (w dt)^2/12 of the scheme, amplitude 2 at most.
double first_order_bound(const exact::CoulombOscillator& o)
{
    const double step = 2.0 * pi / fine * o.frequency / o.drive;
    return 5.0 * 2.0 * o.friction * step + 2.0 * step * step / 12.0 * 2.0 * fine * step;
}

/// Motion with stops and alpha < 0: the velocity kept at a stop dies out during it, so what is left per stop is the way
/// within the step, (g + f) (w dt)^2/2 <= f (w dt)^2, and the load's change within the step of breaking away,
/// W/w (w dt)^2/2.
double second_order_bound(const exact::CoulombOscillator& o)
{
    const double step = 2.0 * pi / fine * o.frequency / o.drive;
    return 5.0 * (o.friction + 0.5 * o.drive / o.frequency) * step * step +
           2.0 * step * step / 12.0 * 2.0 * fine * step;
}

enum class Stops { none, two_a_cycle };

std::vector<Check> coulomb_oscillator(Stops stops)
{
    using Cases = std::vector<std::pair<double, double>>;
    std::vector<Check> checks;
    for (const auto& [r, f] : stops == Stops::none ? Cases{{0.7, 0.3}, {0.7, 0.5}, {1.3, 0.5}, {1.5, 0.5}}
                                                   : Cases{{0.3, 0.5}, {0.3, 0.7}, {0.45, 0.8}, {1.3, 0.8}}) {
        const exact::CoulombOscillator o{2.0 * pi, 2.0 * pi * r, f};
        const double period = 2.0 * pi / o.drive;
        const exact::CoulombMotion motion(o, 104.0 * period);
        const std::string name = ", r = " + fixed(r, 2) + ", F_f/F_0 = " + fixed(f, 1);
        checks.push_back({"stops a cycle" + name, "-", stops == Stops::none ? 0.0 : 2.0,
                          motion.stops(80.0 * period, 100.0 * period) / 20.0, 0.0, Measure::absolute});
        if (stops == Stops::none)
            checks.push_back({"amplitude of the event-located motion" + name, "F_0/k", o.amplitude(),
                              motion.largest(98.0 * period, 100.0 * period), 1e-10, Measure::relative});
        for (const double alpha : {0.0, -0.05}) {
            const bool second_order = stops == Stops::two_a_cycle && alpha < 0.0;
            const fe2d::Scheme scheme = alpha == 0.0 ? fe2d::average_acceleration() : fe2d::hht(alpha);
            const double error = largest_error(o, motion, fine, scheme);
            if (second_order || alpha == 0.0)
                checks.push_back({"error of u, 4000 steps a period, alpha = " + fixed(alpha, 2) + name, "F_0/k",
                                  second_order ? second_order_bound(o) : first_order_bound(o), error, 0.0,
                                  Measure::upper_bound});
            checks.push_back({"order in dt, alpha = " + fixed(alpha, 2) + name, "-", second_order ? 1.8 : 0.8,
                              std::log2(largest_error(o, motion, fine / 8, scheme) / error) / 3.0, 0.0,
                              Measure::lower_bound});
        }
    }
    return checks;
}

/// Bar of equal elements of length 1 on a bed, EA = 1, tau = 1, node 0 pulled; friction lumped at the nodes.
class BarOnBed {
public:
    explicit BarOnBed(Index elements) : nodes_(elements + 1), solver_(stiffness(nodes_)), slip_(VectorXd::Zero(nodes_))
    {
    }

    void pull(double force)
    {
        VectorXd stuck(2 * nodes_);
        stuck.head(nodes_).setConstant(1.0);
        stuck[0] = stuck[nodes_ - 1] = 0.5;
        stuck.tail(nodes_) = solver_.stiffness().bottomRightCorner(nodes_, nodes_) * slip_;
        stuck[nodes_] -= force;
        const fe2d::ContactReport report = solver_.solve(stuck, fe2d::uniform_law(nodes_, 1.0), solution_);
        resolved_ = resolved_ && report.resolved();
        slip_ += solution_.displacement.tail(nodes_);
    }
    const VectorXd& slip() const { return slip_; }
    bool resolved() const { return resolved_; }

private:
    static MatrixXd stiffness(Index n)
    {
        MatrixXd v = MatrixXd::Zero(2 * n, 2 * n);
        v.topLeftCorner(n, n).setIdentity();
        for (Index k = n; k + 1 < 2 * n; ++k) {
            v(k, k) += 1.0;
            v(k + 1, k + 1) += 1.0;
            v(k, k + 1) -= 1.0;
            v(k + 1, k) -= 1.0;
        }
        return v;
    }

    Index nodes_;
    fe2d::ContactSolver solver_;
    fe2d::ContactSolution solution_;
    VectorXd slip_;
    bool resolved_ = true;
};

/// Largest difference at the nodes, of the slip at the pulled end.
double bed_error(const BarOnBed& bar, const std::function<double(double)>& expected, double scale)
{
    double error = 0.0;
    for (Index k = 0; k < bar.slip().size(); ++k)
        error = std::max(error, std::abs(bar.slip()[k] - expected(static_cast<double>(k))));
    return error / scale;
}

std::vector<Check> frictional_bed()
{
    const exact::FrictionalBed bed{1.0, 1.0};
    const double pull = 40.0, end = bed.loaded(pull, 0.0); // slip zone of 40 of the 60 elements
    BarOnBed bar(60);
    std::vector<Check> checks;
    const auto compare = [&](const std::string& what, const std::function<double(double)>& expected) {
        checks.push_back({"slip at the pulled end, " + what, "tau h^2/EA", expected(0.0), bar.slip()[0], 1e-12 * end,
                          Measure::absolute});
        checks.push_back({"largest error of a node's slip, " + what, "of P^2/2 EA tau", 1e-12,
                          bed_error(bar, expected, end), 0.0, Measure::upper_bound});
    };
    bar.pull(pull);
    compare("P", [&](double x) { return bed.loaded(pull, x); });
    bar.pull(0.0);
    compare("P to 0", [&](double x) { return bed.unloaded(pull, 0.0, x); });
    bar.pull(pull / 2.0);
    compare("0 to P/2", [&](double x) { return bed.reloaded(pull, 0.0, pull / 2.0, x); });
    bar.pull(pull);
    compare("back to P", [&](double x) { return bed.loaded(pull, x); });
    bar.pull(-pull);
    compare("P to -P", [&](double x) { return bed.unloaded(pull, -pull, x); });
    double largest = 0.0, smallest = 0.0;
    for (double p = 10.05; p < 11.5; p += 0.1) {
        BarOnBed other(60);
        other.pull(p);
        const double below = bed.loaded(p, 0.0) - other.slip()[0];
        largest = std::max(largest, below);
        smallest = std::min(smallest, below);
    }
    checks.push_back({"slip zone that ends inside an element: too little slip", "tau h^2/EA", 0.125, largest, 0.0,
                      Measure::upper_bound});
    checks.push_back({"... and never too much", "tau h^2/EA", -1e-12, smallest, 0.0, Measure::lower_bound});
    checks.push_back({"every step resolved", "-", 1.0, bar.resolved() ? 1.0 : 0.0, 0.0, Measure::absolute});
    return checks;
}

} // namespace

void add_fe_friction_cases(Registry& registry)
{
    registry.push_back(
        {"fe.contact.coulomb-oscillator", "Steady motion of an oscillator with Coulomb friction, without stops.",
         "Den Hartog (1931), Trans. ASME 53, 107-115: amplitude; event-located motion (verification/exact)",
         "each reversal is known to its step only: at most 2 F_f/F_0 omega dt, and friction is monotone, so "
         "errors only add; first order in dt, 0.8 measured because reversals fall anywhere in their steps",
         [] { return coulomb_oscillator(Stops::none); }});
    registry.push_back(
        {"fe.contact.coulomb-oscillator-stops", "The same with two stops in each cycle.",
         "event-located motion (verification/exact), which agrees with Den Hartog (1931) where nothing stops",
         "alpha = 0: as without stops, the velocity kept at a stop changes sign each step; alpha < 0: it "
         "dies out, the way within the step is left, second order",
         [] { return coulomb_oscillator(Stops::two_a_cycle); }});
    registry.push_back(
        {"fe.contact.frictional-bed",
         "An elastic bar on a frictional bed is pulled, let go, pulled again and pushed: slip of every node.",
         "EA u'' = tau: u = tau/(2 EA) (P/tau - x)^2, P^2/(4 EA tau) remains; Masing (1926) for reversals",
         "linear elements and lumped friction are exact at the nodes when the slip zone ends at one: round-off; else "
         "the element forces are a midpoint sum, short of the integral by (h/2)^2 tau/(2 EA) at most",
         frictional_bed});
}

} // namespace damslip::verification
