#include "verification/cases/modules.hpp"

#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/solver/dense_product.hpp"
#include "fe2d/time/integrate.hpp"
#include "verification/cases/fe_time_models.hpp"
#include "verification/exact/damped_oscillator.hpp"
#include "verification/exact/time_schemes.hpp"

#include <cmath>
#include <numbers>

namespace damslip::verification {

namespace {

using Eigen::Index;
using Eigen::VectorXd;
using std::numbers::pi;

VectorXd scalar(double value)
{
    return VectorXd::Constant(1, value);
}

struct NamedScheme {
    const char* name;
    fe2d::Scheme scheme;
};

std::vector<NamedScheme> all_schemes()
{
    return {{"average acceleration", fe2d::average_acceleration()},
            {"linear acceleration", fe2d::linear_acceleration()},
            {"HHT alpha = -0.05", fe2d::hht(-0.05)},
            {"HHT alpha = -1/3", fe2d::hht(-1.0 / 3.0)}};
}

/// Displacements of one oscillator in free vibration from u = 1, a in equilibrium.
std::vector<double> free_vibration(const fe2d::Scheme& scheme, double omega, double ratio, double dt, int steps)
{
    fe2d::LinearIntegrator integrator(oscillator(omega, ratio), scheme);
    fe2d::State before = integrator.start(scalar(1.0), scalar(0.0), scalar(0.0)), after;
    std::vector<double> u{1.0};
    const auto& step = integrator.step_operator(dt);
    for (int n = 0; n < steps; ++n) {
        integrator.finish_step(step, before, scalar(0.0), integrator.free_step(step, before, scalar(0.0)), after);
        std::swap(before, after);
        u.push_back(before.displacement[0]);
    }
    return u;
}

/// Decay and period from the recurrence u_{n+1} - 2 Re(z) u_n + |z|² u_{n-1} = 0 of the last four samples.
std::vector<Check> decay_and_period()
{
    const double dt = 0.02, omega_dt = 2.0 * pi / 10.0, ratio = 0.02;
    std::vector<Check> checks;
    for (const auto& [name, scheme] : all_schemes()) {
        const std::vector<double> u = free_vibration(scheme, omega_dt / dt, ratio, dt, 63);
        const double det = u[60] * u[62] - u[61] * u[61];
        const double modulus = std::sqrt((u[61] * u[63] - u[62] * u[62]) / det);
        const double angle = std::acos(0.5 * (u[60] * u[63] - u[61] * u[62]) / det / modulus);
        const auto exact = exact::numerical_vibration({scheme.alpha, scheme.gamma, scheme.beta}, ratio, omega_dt);
        checks.push_back({std::string(name) + ", damping ratio at dt/T = 0.1", "-", exact.damping_ratio,
                          -std::log(modulus) / angle, 1e-8, Measure::absolute});
        checks.push_back({std::string(name) + ", period ratio at dt/T = 0.1", "-", exact.period_ratio,
                          omega_dt * std::sqrt(1.0 - ratio * ratio) / angle, 1e-8, Measure::absolute});
    }
    return checks;
}

double harmonic_error(const fe2d::Scheme& scheme, const exact::DampedOscillator& o, int steps)
{
    const double t_end = 1.7, dt = t_end / steps;
    fe2d::LinearIntegrator integrator(oscillator(o.omega, o.ratio), scheme);
    fe2d::State before = integrator.start(scalar(0.0), scalar(0.0), scalar(0.0)), after;
    const auto& step = integrator.step_operator(dt);
    for (int n = 1; n <= steps; ++n) {
        const VectorXd load = scalar(5.0 * std::sin(7.0 * n * dt));
        integrator.finish_step(step, before, load, integrator.free_step(step, before, load), after);
        std::swap(before, after);
    }
    const exact::Motion exact = o.harmonic(5.0, 7.0, t_end);
    return std::hypot(before.displacement[0] - exact.displacement, (before.velocity[0] - exact.velocity) / o.omega);
}

std::vector<Check> measured_order()
{
    const exact::DampedOscillator o{12.0, 0.05};
    std::vector<Check> checks;
    for (const auto& [name, scheme] : all_schemes())
        checks.push_back({std::string("order of ") + name + ", dt to dt/2", "-", 2.0,
                          std::log2(harmonic_error(scheme, o, 3200) / harmonic_error(scheme, o, 6400)), 0.02,
                          Measure::absolute});
    return checks;
}

std::vector<Check> linear_acceleration_limit()
{
    const double limit = std::sqrt(12.0) / (2.0 * pi);
    const auto largest = [&](double dt_over_period) {
        double value = 0.0;
        for (double u : free_vibration(fe2d::linear_acceleration(), 2.0 * pi * dt_over_period / 0.01, 0.0, 0.01, 4000))
            value = std::max(value, std::abs(u));
        return value;
    };
    return {{"limit of dt/T", "-", 0.551, limit, 5e-4, Measure::absolute},
            {"largest amplitude at 0.9999 of the limit, start 1", "-", 1e3, largest(0.9999 * limit), 0.0,
             Measure::upper_bound},
            {"largest amplitude at 1.0001 of the limit, start 1", "-", 1e20, largest(1.0001 * limit), 0.0,
             Measure::lower_bound}};
}

/// A shaken lattice with damping and massless unknowns; largest imbalance of any step over the largest energy.
double worst_imbalance(const fe2d::Scheme& scheme)
{
    const fe2d::LinearSystem system =
        lattice({.nx = 6, .ny = 8, .massless_rows = 2, .mass_coefficient = 0.7, .stiffness_coefficient = 0.002});
    const Index n = system.size();
    fe2d::LinearIntegrator integrator(system, scheme);
    const VectorXd dead = 20.0 * uneven_vector(n, 0.9), shaking = system.mass * VectorXd::Ones(n);
    const VectorXd still = Eigen::MatrixXd(system.stiffness).ldlt().solve(dead);
    fe2d::State before = integrator.start(still, VectorXd::Zero(n), dead), after;
    fe2d::EnergyLedger ledger(before);
    const auto& step = integrator.step_operator(0.02);
    double worst = 0.0;
    for (int k = 1; k <= 500; ++k) {
        const double t = 0.02 * k;
        const VectorXd load = dead + 6.0 * std::sin(t * (4.0 + 2.0 * t)) * shaking;
        integrator.finish_step(step, before, load, integrator.free_step(step, before, load), after);
        ledger.add_step(before, after, step.constants());
        worst = std::max(worst, std::abs(ledger.imbalance()));
        std::swap(before, after);
    }
    return worst / ledger.largest_scale();
}

std::vector<Check> energy_closure()
{
    std::vector<Check> checks;
    for (const auto& [name, scheme] : all_schemes())
        if (scheme.unconditionally_stable())
            checks.push_back({std::string("imbalance over the largest energy, ") + name, "-", 1e-12,
                              worst_imbalance(scheme), 0.0, Measure::upper_bound});
    return checks;
}

std::vector<Check> rayleigh_table()
{
    const auto c = fe2d::rayleigh_constants(0.05, 2.0 * pi * 1.54, 2.0 * pi * 2.29);
    const auto modified = fe2d::rayleigh_constants(0.05, 2.0 * pi * 1.54, 2.0 * pi * 6.25);
    return {{"a_M, 5 % at 1.54 and 2.29 Hz", "1/s", 0.579, c.mass, 5e-4, Measure::absolute},
            {"b_K, 5 % at 1.54 and 2.29 Hz", "s", 0.0042, c.stiffness, 5e-5, Measure::absolute},
            {"a_M, 5 % at 1.54 and 6.25 Hz (table 6-6)", "1/s", 0.777, modified.mass, 2e-3, Measure::absolute},
            {"b_K, 5 % at 1.54 and 6.25 Hz (table 6-6)", "s", 0.002, modified.stiffness, 5e-4, Measure::absolute}};
}

/// (2-58) written out on its own for steady harmonic ground motion of 3 Hz, whose spectrum is the transmissibility.
std::vector<Check> modified_rayleigh_equation()
{
    const auto spectrum = [](double frequency, double ratio) {
        return exact::DampedOscillator{frequency, ratio}.transmissibility(2.0 * pi * 3.0);
    };
    std::vector<fe2d::ModalMass> modes;
    for (const auto& [hertz, mass] : {std::pair{3.6, 800e3}, {8.4, 450e3}, {10.6, 60e3}, {14.9, 190e3}, {15.9, 120e3}})
        modes.push_back({2.0 * pi * hertz, mass});
    const auto result = fe2d::modified_rayleigh(modes, spectrum, {.ratio = 0.05, .total_mass = 2e6});
    const double wi = modes[0].frequency, wj = result.second_frequency;
    double imbalance = 0.0, wanted = 0.0;
    for (const auto& mode : modes) {
        const double w = mode.frequency, ratio = 0.05 * (wi * wj / w + w) / (wi + wj);
        imbalance += (spectrum(w, ratio) - spectrum(w, 0.05)) * mode.effective_mass_x;
        wanted += spectrum(w, 0.05) * mode.effective_mass_x;
    }
    const std::vector<fe2d::ModalMass> two = {{5.0, 7.0}, {12.0, 2.0}};
    return {{"base shear difference over base shear", "-", 0.0, imbalance / wanted, 1e-11, Measure::absolute},
            {"two modes: second frequency", "rad/s", 12.0,
             fe2d::modified_rayleigh(two, spectrum, {.ratio = 0.05, .total_mass = 9.0}).second_frequency, 1e-9,
             Measure::relative}};
}

/// Two lattices, the lower one massless, standing apart: r, w of the upper one over the lower.
std::vector<Check> deformation_only()
{
    const Index n_dam = 24, base = 4;
    const fe2d::LinearSystem dam = lattice({.nx = base, .ny = 6}),
                             rock = lattice({.nx = base, .ny = 3, .massless_rows = 3});
    const Index n = n_dam + rock.size();
    std::vector<Eigen::Triplet<double>> entries;
    for (Index k = 0; k < n_dam; ++k)
        for (fe2d::SparseMatrix::InnerIterator entry(dam.mass, k); entry; ++entry)
            entries.emplace_back(entry.row(), k, entry.value());
    fe2d::SparseMatrix mass(n, n);
    mass.setFromTriplets(entries.begin(), entries.end());
    VectorXd rigid = VectorXd::Zero(n), weights = VectorXd::Zero(n), tied = VectorXd::Zero(n);
    rigid.head(n_dam).setOnes();
    weights.head(base).setConstant(0.25);
    weights.tail(base).setConstant(-0.25);
    tied = uneven_vector(n, 0.3);
    tied.tail(base) = tied.head(base);
    const fe2d::LowRank correction = fe2d::deformation_only_correction(1.8, mass, rigid, weights);
    VectorXd slipping = 1.8 * (mass * rigid), deforming = 1.8 * (mass * tied);
    const double full = slipping.norm(), work = tied.dot(deforming);
    correction.add_product(rigid, 1.0, slipping);
    correction.add_product(tied, 1.0, deforming);
    return {{"force under uniform slip over that of a_M M", "-", 0.0, slipping.norm() / full, 1e-14, Measure::absolute},
            {"dissipation of a tied motion over that of a_M M", "-", 1.0, tied.dot(deforming) / work, 1e-13,
             Measure::absolute}};
}

/// The thesis' dam on its rock, coarsely meshed, full reservoir as added mass, both components.
std::vector<Check> condensed_rock()
{
    Scene scene;
    scene.section.polygon = {{0, 0}, {45, 0}, {12, 51.5}, {12, 62.5}, {0, 62.5}};
    scene.dam.density = 2500.0;
    scene.dam.young_modulus = 25e9;
    scene.foundation.emplace();
    scene.foundation->mass = RockMass::massless;
    scene.foundation->material.young_modulus = 30e9;
    scene.foundation->width = 300.0;
    scene.foundation->depth = 100.0;
    scene.reservoir.emplace();
    scene.reservoir->level = 62.5;
    scene.mesh.size = 6.0;
    const fe2d::Model model = fe2d::build_model(
        scene, {.added_mass = [](Point p, double) { return 875.0 * std::sqrt(62.5 * std::max(0.0, 62.5 - p.y)); }});
    GroundMotion motion;
    motion.dt = 0.01;
    for (int k = 0; k <= 400; ++k) {
        motion.accel_h.push_back(2.0 * std::sin(0.05 * k) * std::sin(0.21 * k));
        motion.accel_v.push_back(1.0 * std::sin(0.04 * k) * std::sin(0.33 * k));
    }
    fe2d::TiedRunOptions options;
    options.damping.constants = {1.9, 0.00075};
    const auto loads = fe2d::static_loads(scene, model);
    options.static_load =
        fe2d::sum_of(loads.gravity, model.dofs.count) + fe2d::sum_of(loads.impounding, model.dofs.count);
    const auto condensed = fe2d::integrate(model, motion, options);
    options.rock = fe2d::RockTreatment::whole;
    const auto whole = fe2d::integrate(model, motion, options);
    double difference = 0.0, largest = 0.0;
    for (std::size_t k = 0; k < whole.rows.size(); ++k) {
        difference = std::max(difference, std::abs(whole.rows[k].crest_x - condensed.rows[k].crest_x));
        largest = std::max(largest, std::abs(whole.rows[k].crest_x));
    }
    return {{"largest difference of the crest's motion over its largest value", "-", 1e-12, difference / largest, 0.0,
             Measure::upper_bound},
            {"energy imbalance over the largest energy, rock condensed", "-", 1e-12, condensed.largest_imbalance, 0.0,
             Measure::upper_bound},
            {"unknowns, condensed over whole", "-", 1.0,
             static_cast<double>(condensed.unknowns) / static_cast<double>(whole.unknowns), 0.0, Measure::upper_bound}};
}

} // namespace

void add_fe_time_cases(Registry& registry)
{
    registry.push_back(
        {"fe2d.time.decay-and-period", "Every scheme damps and lengthens a vibration as its amplification matrix says",
         "Characteristic polynomial z(z-1)² + ((1+α)z - α)(2ζΩV(z)(z-1) + Ω²P(z)) derived from (2-9), (2-10), "
         "(2-25); Hilber, Hughes & Taylor (1977)",
         "What 60 steps leave of the third root, below 0.7^60 = 5e-10", decay_and_period});
    registry.push_back({"fe2d.time.order", "Displacement and velocity are of second order under a harmonic load",
                        "Closed solution of the damped oscillator (Chopra, Dynamics of Structures)",
                        "Next term of the error at ωΔt = 0.006", measured_order});
    registry.push_back({"fe2d.time.linear-acceleration-limit",
                        "Linear acceleration is stable up to Δt/T = √12/2π and not beyond",
                        "Newmark (1959): trace of the amplification matrix -2 at Ω² = 12",
                        "Bounds far apart: a beat against exponential growth", linear_acceleration_limit});
    registry.push_back(
        {"fe2d.time.energy",
         "Kinetic, strain, damping and numerical dissipation balance the work of the loads in every step",
         "Identity derived in fe2d/time/energy.hpp", "Round-off of 500 steps", energy_closure});
    registry.push_back({"fe2d.damping.rayleigh",
                        "Rayleigh constants of thesis table 5-5, whose printed a_M = 0.422 is wrong",
                        "(2-56), (2-57) by hand: 0.579 1/s and 0.0042 s; table 6-6", "Digits printed", rayleigh_table});
    registry.push_back(
        {"fe2d.damping.modified-rayleigh", "Modified Rayleigh constants leave the base shear of all modes unchanged",
         "Spears & Jensen (2012), (2-58), evaluated again; two modes must give ordinary Rayleigh damping",
         "Root bisected to 1e-12", modified_rayleigh_equation});
    registry.push_back({"fe2d.damping.deformation-only",
                        "Damping of the deformation only does not feel uniform slip and damps a tied dam as a_M M does",
                        "C_M = a_M (I - r wᵀ)ᵀ M (I - r wᵀ) with wᵀr = 1", "Round-off", deformation_only});
    registry.push_back(
        {"fe2d.time.condensed-rock",
         "Massless rock condensed onto the base gives the run of the whole rock, stiffness damping included",
         "K_c = K_cc - K_ci K_ii⁻¹ K_ic and b_K K_c, exact from equilibrium (fe2d/time/condensation.hpp)",
         "Round-off of 400 steps", condensed_rock});
}

} // namespace damslip::verification
