#include "verification/cases/modules.hpp"

#include "fe2d/model/model.hpp"
#include "fe2d/time/central_difference.hpp"
#include "fe2d/time/modal_run.hpp"
#include "verification/exact/oscillator.hpp"
#include "verification/exact/reference_scene.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace damslip::verification {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
constexpr double half_turn = std::numbers::pi;

fe2d::SparseMatrix one_by_one(double value)
{
    fe2d::SparseMatrix matrix(1, 1);
    matrix.insert(0, 0) = value;
    return matrix;
}

/// One mass of 2 kg/m by central differences.
struct ExplicitOscillator {
    double omega, mass_ratio = 0.0, lagged_ratio = 0.0; ///< damping ratios of the two parts
    fe2d::CentralDifference scheme(double dt) const
    {
        return {{one_by_one(2.0), one_by_one(4.0 * mass_ratio * omega), one_by_one(2.0 * omega * omega),
                 2.0 * lagged_ratio / omega},
                dt};
    }
};

VectorXd scalar_of(double value)
{
    return VectorXd::Constant(1, value);
}

std::vector<double> explicit_free_vibration(const ExplicitOscillator& o, double dt, int steps)
{
    fe2d::CentralDifference scheme = o.scheme(dt);
    fe2d::State before = scheme.start(scalar_of(1.0), scalar_of(0.0), scalar_of(0.0)), after;
    std::vector<double> u{1.0};
    for (int n = 0; n < steps; ++n) {
        scheme.step(before, scalar_of(0.0), after);
        std::swap(before, after);
        u.push_back(before.displacement[0]);
    }
    return u;
}

/// Without damping u_n = cos(n θ) with sin(θ/2) = Ω/2: put it into u_{n+1} - 2u_n + u_{n-1} = -Ω² u_n.
std::vector<Check> central_difference_period()
{
    const double omega = 30.0;
    std::vector<Check> checks;
    std::vector<double> errors;
    for (const double omega_dt : {0.8, 0.4, 0.2}) {
        const std::vector<double> u = explicit_free_vibration({omega}, omega_dt / omega, 200);
        const double angle = std::acos((u[200] + u[198]) / (2.0 * u[199]));
        double worst = 0.0;
        for (int n = 0; n <= 200; ++n)
            worst = std::max(worst,
                             std::abs(u[static_cast<std::size_t>(n)] - std::cos(n * 2.0 * std::asin(0.5 * omega_dt))));
        checks.push_back({"largest error of 200 steps, omega dt = " + std::to_string(omega_dt).substr(0, 3), "-", 1e-11,
                          worst, 0.0, Measure::upper_bound});
        errors.push_back(1.0 - omega_dt / angle);
    }
    checks.push_back({"order of the period error, omega dt = 0.4 to 0.2", "-", 2.0, std::log2(errors[1] / errors[2]),
                      0.02, Measure::absolute});
    return checks;
}

double explicit_harmonic_error(const ExplicitOscillator& o, int steps)
{
    const double t_end = 1.7, dt = t_end / steps;
    fe2d::CentralDifference scheme = o.scheme(dt);
    // f = 5 t per unit mass: the closed solution of a ramp.
    fe2d::State before = scheme.start(scalar_of(0.0), scalar_of(0.0), scalar_of(0.0)), after;
    for (int n = 1; n <= steps; ++n) {
        scheme.step(before, scalar_of(2.0 * 5.0 * n * dt), after);
        std::swap(before, after);
    }
    const exact::RampedOscillator exact{o.omega, o.mass_ratio + o.lagged_ratio, 0.0, -5.0};
    return std::hypot(before.displacement[0] - exact.displacement(t_end),
                      (before.velocity[0] - exact.velocity(t_end)) / o.omega);
}

std::vector<Check> central_difference_order()
{
    const auto order = [](const ExplicitOscillator& o) {
        return std::log2(explicit_harmonic_error(o, 3200) / explicit_harmonic_error(o, 6400));
    };
    return {
        {"undamped", "-", 2.0, order({12.0}), 0.02, Measure::absolute},
        {"mass damping of 5 %", "-", 2.0, order({12.0, 0.05}), 0.02, Measure::absolute},
        {"stiffness damping of 5 %, half a step late", "-", 1.0, order({12.0, 0.0, 0.05}), 0.02, Measure::absolute}};
}

std::vector<Check> central_difference_limits()
{
    std::vector<Check> checks{{"limit of dt/T, undamped", "-", 1.0 / half_turn,
                               fe2d::central_difference_limit(2.0 * half_turn, 0.0), 1e-15, Measure::absolute}};
    const auto largest = [](const ExplicitOscillator& o, double dt) {
        double value = 0.0;
        for (const double u : explicit_free_vibration(o, dt, 4000)) {
            if (!(std::abs(u) < 1e300)) return 1e300;
            value = std::max(value, std::abs(u));
        }
        return value;
    };
    const double omega = 100.0;
    for (const auto& [name, o] : {std::pair<const char*, ExplicitOscillator>{"undamped", {omega}},
                                  {"mass damping of 30 %", {omega, 0.3}},
                                  {"lagged damping of 50 %", {omega, 0.0, 0.5}},
                                  {"lagged damping of 600 %", {omega, 0.0, 6.0}},
                                  {"both, 30 and 50 %", {omega, 0.3, 0.5}}}) {
        const double dt = fe2d::central_difference_limit(omega, 2.0 * o.lagged_ratio / omega);
        checks.push_back({std::string(name) + ": largest amplitude at 0.9999 of the limit, start 1", "-", 1e3,
                          largest(o, 0.9999 * dt), 0.0, Measure::upper_bound});
        checks.push_back(
            {std::string(name) + ": at 1.01 of it", "-", 1e6, largest(o, 1.01 * dt), 0.0, Measure::lower_bound});
    }
    return checks;
}

// ---- a small dam

GroundMotion chirp()
{
    GroundMotion motion;
    motion.dt = 0.01;
    for (int k = 0; k <= 300; ++k) {
        motion.accel_h.push_back(2.0 * std::sin(0.0105 * k) * std::sin(0.04 * k + 0.0006 * k * k));
        motion.accel_v.push_back(1.0 * std::sin(0.0105 * k) * std::sin(0.11 * k));
    }
    return motion;
}

Scene small_scene(double size)
{
    Scene scene = exact::bare_scene(exact::triangle(30.0, 40.0), 2400.0);
    scene.dam.young_modulus = 2e9;
    scene.dam.poisson_ratio = 0.2;
    scene.reservoir.emplace();
    scene.reservoir->level = 38.0;
    scene.mesh.size = size;
    scene.mesh.contact_size = size;
    return scene;
}

enum class Face { dry, wet };

fe2d::Model small_model(double size, Face face, fe2d::MassKind mass)
{
    Scene scene = small_scene(size);
    fe2d::ModelOptions options;
    options.mass = mass;
    if (face == Face::wet)
        options.added_mass = [](Point p, double) { return 875.0 * std::sqrt(38.0 * std::max(0.0, 38.0 - p.y)); };
    return fe2d::build_model(scene, options);
}

double crests_apart(const fe2d::History& a, const fe2d::History& b)
{
    double largest = 0.0;
    const std::size_t step = (a.rows.size() - 1) / 300, other = (b.rows.size() - 1) / 300;
    for (std::size_t k = 0; k <= 300; ++k)
        largest = std::max(largest, std::abs(a.rows[k * step].crest_x - b.rows[k * other].crest_x));
    return largest;
}

fe2d::TiedRunOptions small_options(const fe2d::Model& model)
{
    fe2d::TiedRunOptions options;
    options.damping.constants = {1.2, 0.0};
    const fe2d::StaticLoads loads = fe2d::static_loads(small_scene(10.0), model);
    options.static_load =
        fe2d::sum_of(loads.gravity, model.dofs.count) + fe2d::sum_of(loads.impounding, model.dofs.count);
    return options;
}

fe2d::History direct(const fe2d::Model& model, const fe2d::TiedRunOptions& base, int parts)
{
    fe2d::TiedRunOptions options = base;
    options.scheme = fe2d::average_acceleration();
    options.dt = 0.01 / parts;
    return fe2d::integrate(model, chirp(), options);
}

/// Differences of direct runs at dt/8, dt/16, dt/32 from a reference, over the peak, and their order.
std::vector<Check> direct_towards(const fe2d::Model& model, const fe2d::TiedRunOptions& options,
                                  const fe2d::History& reference, double tolerance, const std::string& of)
{
    const double e16 = crests_apart(direct(model, options, 16), reference),
                 e32 = crests_apart(direct(model, options, 32), reference);
    return {{"average acceleration at dt/32 from " + of, "of the peak", tolerance, e32 / reference.peak_crest_x, 0.0,
             Measure::upper_bound},
            {"order of the difference, dt/16 to dt/32", "-", 2.0, std::log2(e16 / e32), 0.05, Measure::absolute}};
}

std::vector<Check> central_difference_dam()
{
    const fe2d::Model model = small_model(10.0, Face::dry, fe2d::MassKind::lumped);
    fe2d::TiedRunOptions options = small_options(model);
    options.dt = 0.01 / 256;
    const fe2d::History reference = fe2d::integrate_explicit(model, chirp(), options);
    std::vector<Check> checks =
        direct_towards(model, options, reference, 1e-3, "central difference at dt/256, same lumped mass");
    checks.push_back({"energy imbalance over the largest energy", "-", 1e-11, reference.largest_imbalance, 0.0,
                      Measure::upper_bound});
    options.dt.reset();
    options.damping.constants.stiffness = 0.004;
    const fe2d::History late = fe2d::integrate_explicit(model, chirp(), options), both = direct(model, options, 32);
    checks.push_back({"with stiffness damping, half a step late, from average acceleration at dt/32", "of the peak",
                      0.005, crests_apart(late, both) / both.peak_crest_x, 0.0, Measure::upper_bound});
    checks.push_back({"its energy imbalance", "-", 1e-11, late.largest_imbalance, 0.0, Measure::upper_bound});
    // Added mass lumped by node, the dam's mass against the consistent one: another discretisation, of second order in h.
    double lumping[2];
    for (const int k : {0, 1}) {
        const fe2d::Model wet = small_model(k == 0 ? 4.0 : 2.0, Face::wet, fe2d::MassKind::consistent);
        const fe2d::TiedRunOptions plain = small_options(wet);
        lumping[k] = crests_apart(fe2d::integrate_explicit(wet, chirp(), plain), direct(wet, plain, 16));
    }
    checks.push_back({"with added mass, lumped against consistent: order in h, 4 m to 2 m", "-", 1.6,
                      std::log2(lumping[0] / lumping[1]), 0.0, Measure::lower_bound});
    return checks;
}

// ---- modes

std::vector<Check> modal_recurrence()
{
    const double dt = 0.01, a0 = 0.7, slope = 31.0;
    std::vector<Check> checks;
    for (const double omega : {8.0, 100.0, 700.0})
        for (const double ratio : {0.0, 0.05, 0.7}) {
            const fe2d::ModalRecurrence recurrence(scalar_of(omega), scalar_of(2.0 * ratio * omega),
                                                   MatrixXd::Identity(1, 1), dt);
            VectorXd q = scalar_of(0.3), rate = scalar_of(-2.0);
            const exact::RampedOscillator exact{omega, ratio, a0, slope, 0.3, -2.0};
            for (int n = 0; n < 50; ++n)
                recurrence.step(q, rate, scalar_of(-a0 - slope * n * dt), scalar_of(-a0 - slope * (n + 1) * dt));
            const double t = 50 * dt;
            const double scale = 0.3 + 2.0 / omega + 16.0 / (omega * omega);
            checks.push_back({"omega = " + std::to_string(static_cast<int>(omega)) + " rad/s, damping ratio " +
                                  std::to_string(ratio).substr(0, 4),
                              "of the amplitude", 1e-12,
                              std::hypot(q[0] - exact.displacement(t), (rate[0] - exact.velocity(t)) / omega) / scale,
                              0.0, Measure::upper_bound});
        }
    // Two modes of one frequency whose damping is diagonal in axes turned by 0.6: the coupled path against the closed one.
    const Eigen::Matrix2d turn = Eigen::Rotation2Dd(0.6).toRotationMatrix();
    const Eigen::Vector2d omega(40.0, 40.0), diagonal(4.0, 24.0);
    const MatrixXd damping = turn * diagonal.asDiagonal() * turn.transpose();
    const fe2d::ModalRecurrence coupled(omega, damping, turn, dt),
        plain(omega, MatrixXd(diagonal.asDiagonal()), MatrixXd::Identity(2, 2), dt);
    VectorXd q = Eigen::Vector2d(0.1, 0.2), rate = Eigen::Vector2d(3.0, -1.0);
    VectorXd p = turn.transpose() * q, p_rate = turn.transpose() * rate;
    for (int n = 0; n < 50; ++n) {
        const Eigen::Vector2d before(std::sin(0.3 * n), std::cos(0.2 * n)),
            after(std::sin(0.3 * n + 0.3), std::cos(0.2 * n + 0.2));
        coupled.step(q, rate, 40.0 * before, 40.0 * after);
        plain.step(p, p_rate, 40.0 * before, 40.0 * after);
    }
    checks.push_back({"coupled by damping, against its own axes", "of the amplitude", 1e-12,
                      (turn.transpose() * q - p).norm() / 0.2, 0.0, Measure::upper_bound});
    checks.push_back({"the coupled path was taken", "-", 1.0, coupled.coupled() && !plain.coupled() ? 1.0 : 0.0, 0.0,
                      Measure::absolute});
    return checks;
}

/// All modes: nothing is left out, so direct integration must go to it with its own order.
std::vector<Check> modal_dam()
{
    std::vector<Check> checks;
    for (const Face face : {Face::dry, Face::wet}) {
        const fe2d::Model model = small_model(10.0, face, fe2d::MassKind::consistent);
        fe2d::TiedRunOptions options = small_options(model);
        options.damping.constants = {1.2, 0.002};
        options.dt = 0.01;
        const fe2d::History modal = fe2d::integrate_modal(model, chirp(), options, {.modes = model.dofs.count});
        const std::string name = face == Face::dry ? "dry: " : "with added mass: ";
        for (Check& check : direct_towards(model, options, modal, 1e-3, "all modes")) {
            check.quantity = name + check.quantity;
            checks.push_back(std::move(check));
        }
        fe2d::TiedRunOptions halved = options;
        halved.dt = 0.005;
        const fe2d::History half = fe2d::integrate_modal(model, chirp(), halved, {.modes = model.dofs.count});
        checks.push_back({name + "steps of dt and dt/2 agree", "of the peak", 1e-9,
                          crests_apart(modal, half) / modal.peak_crest_x, 0.0, Measure::upper_bound});
        checks.push_back({name + "order of the energy imbalance", "-", 3.0,
                          std::log2(modal.largest_imbalance / half.largest_imbalance), 0.0, Measure::lower_bound});
    }
    return checks;
}

/// Few modes of a finer dam against all of them.
std::vector<Check> modal_truncation()
{
    std::vector<Check> checks;
    for (const Face face : {Face::dry, Face::wet})
        for (const int modes : {3, 6, 12}) {
            const fe2d::Model model = small_model(5.0, face, fe2d::MassKind::consistent);
            fe2d::TiedRunOptions options = small_options(model);
            options.damping.constants = {1.2, 0.002};
            const fe2d::History all = fe2d::integrate_modal(model, chirp(), options, {.modes = model.dofs.count}),
                                some = fe2d::integrate_modal(model, chirp(), options, {.modes = modes});
            const double error = crests_apart(some, all);
            const std::string name =
                std::to_string(modes) + (face == Face::dry ? " modes, dry: " : " modes, with water: ");
            if (face == Face::wet && modes == 12) { // what damping couples back is left: beyond any need
                checks.push_back({name + "error of the crest", "of the peak", 1e-4, error / all.peak_crest_x, 0.0,
                                  Measure::upper_bound});
                continue;
            }
            checks.push_back({name + "error of the crest over its estimate", "-", 2.0, error / some.modal.crest_x_error,
                              0.0, Measure::upper_bound});
            checks.push_back({name + "the same, not ten times too cautious", "-", 0.1, error / some.modal.crest_x_error,
                              0.0, Measure::lower_bound});
        }
    const fe2d::Model model = small_model(5.0, Face::wet, fe2d::MassKind::consistent);
    fe2d::TiedRunOptions options = small_options(model);
    options.damping.constants = {1.2, 0.002};
    const fe2d::History all = fe2d::integrate_modal(model, chirp(), options, {.modes = model.dofs.count});
    const fe2d::History chosen = fe2d::integrate_modal(model, chirp(), options);
    checks.push_back({"modes chosen by the program: error of the crest", "of the peak", 1e-3,
                      crests_apart(chosen, all) / all.peak_crest_x, 0.0, Measure::upper_bound});
    checks.push_back({"of the peak acceleration", "-", 0.01,
                      std::abs(chosen.peak_crest_accel_x / all.peak_crest_accel_x - 1.0), 0.0, Measure::upper_bound});
    checks.push_back({"of the peak base shear", "-", 0.01, std::abs(chosen.peak_base_shear / all.peak_base_shear - 1.0),
                      0.0, Measure::upper_bound});
    return checks;
}

} // namespace

void add_fe_integrator_cases(Registry& registry)
{
    registry.push_back({"fe2d.time.central-difference-period",
                        "The central difference vibrates as its own closed solution says, without decay",
                        "u_n = cos(2n asin(Ω/2)), put into u_{n+1} - 2u_n + u_{n-1} = -Ω²u_n", "Round-off of 200 steps",
                        central_difference_period});
    registry.push_back({"fe2d.time.central-difference-order",
                        "Second order; first order of damping that acts half a step late",
                        "Closed solution of the damped oscillator under a ramp (Chopra, Dynamics of Structures)",
                        "Next term of the error at ωΔt = 0.006", central_difference_order});
    registry.push_back({"fe2d.time.central-difference-limit",
                        "Stable up to Δt = (2/ω)(√(1 + ζ²) - ζ), ζ of the lagged damping alone, and not beyond",
                        "Jury's conditions of (1+e)z² - (2 - b - Ω²)z + (1 - e - b); Belytschko, Liu & Moran (2000)",
                        "Bounds far apart: a beat against growth by 1.01 of the limit in 4000 steps",
                        central_difference_limits});
    registry.push_back(
        {"fe2d.time.central-difference-dam", "A tied dam by central differences is the limit of implicit steps",
         "integrate() with average acceleration, same lumped mass; consistent mass as another discretisation",
         "Implicit error at dt/32, (ωΔt)²/12 of the phase; damping half a step late: b_K acts as if on (1 - ωΔt/2) of "
         "a "
         "cycle; lumping is of second order in h (asymptotically); round-off of 80 000 steps in the ledger",
         central_difference_dam});
    registry.push_back({"fe2d.time.modal-recurrence", "Modal equations are solved exactly under piecewise-linear loads",
                        "Closed solution of the ramped oscillator; Nigam & Jennings (1969)", "Round-off of 50 steps",
                        modal_recurrence});
    registry.push_back(
        {"fe2d.time.modal-dam", "Direct integration goes to the superposition of all modes with order 2",
         "integrate() with average acceleration at dt/16 and dt/32",
         "Implicit error at dt/32; the order within 0.05; agreement of two step sizes: eigenvectors to 1e-10",
         modal_dam});
    registry.push_back(
        {"fe2d.time.modal-truncation", "The error of a truncated superposition is what its estimate says",
         "The same superposition with all modes",
         "The estimate takes one oscillator for all modes left out: within twice and a tenth", modal_truncation});
}

} // namespace damslip::verification
