#include "fe2d/fluid/coupled_system.hpp"
#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/harmonic/transfer.hpp"
#include "fe2d/time/integrate.hpp"
#include "fe2d/time/structure_system.hpp"
#include "verification/cases/modules.hpp"
#include "verification/exact/reference_scene.hpp"
#include "verification/exact/reservoir.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace damslip::verification {

namespace {

using namespace damslip::fe2d;
using std::numbers::pi;

/// A box of water, nx x ny elements, with named sides; which of them are what is the caller's choice.
ReservoirMesh box(double length, double depth, int nx, int ny)
{
    ReservoirMesh r;
    r.depth = depth;
    const auto node = [nx](int i, int j) { return j * (nx + 1) + i; };
    for (int j = 0; j <= ny; ++j)
        for (int i = 0; i <= nx; ++i) r.mesh.nodes.push_back({-length * i / nx, depth * j / ny});
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
            r.mesh.elements.push_back(
                {{node(i + 1, j), node(i, j), node(i, j + 1), node(i + 1, j + 1)}, Region::reservoir});
    for (int j = 0; j <= ny; ++j) r.face.push_back(node(0, j));
    for (int i = 0; i <= nx; ++i) r.surface.push_back(node(i, ny));
    for (int j = ny; j >= 0; --j) r.far_end.push_back(node(nx, j));
    for (int i = nx; i >= 0; --i) r.bottom.push_back(node(i, 0));
    return r;
}

/// A horizontal duct, one element high, rigid sides: its end takes the place of the bottom.
ReservoirMesh duct(double length, int n)
{
    ReservoirMesh r = box(length, 1.0, n, 1);
    r.bottom = r.far_end;
    r.surface.clear();
    r.far_end.clear();
    return r;
}

/// One mass on a spring, for water that needs some structure.
CoupledPencil pencil_of(const FluidModel& water, double mass, double stiffness, const Eigen::VectorXd& coupling)
{
    CoupledPencil p;
    const auto scalar = [](double value) {
        SparseMatrix m(1, 1);
        m.insert(0, 0) = value;
        return m;
    };
    p.mass = scalar(mass);
    p.stiffness = scalar(stiffness);
    p.coupling = SparseMatrix(coupling.transpose().sparseView());
    p.water_mass = water.mass;
    p.water_stiffness = water.stiffness;
    p.inertia_x = Eigen::VectorXd::Constant(1, mass);
    p.inertia_y = Eigen::VectorXd::Zero(1);
    p.flux_x = water.flux_x;
    p.flux_y = water.flux_y;
    p.structure_mass = {mass, mass};
    return p;
}

std::vector<Check> cavity()
{
    // ω = c √((m π/L)² + ((n - ½) π/h)²): rigid walls and bottom, p = 0 on the surface.
    const double length = 150.0, depth = 100.0, c = std::sqrt(2.2e6);
    std::vector<double> exact;
    for (int m = 0; m < 4; ++m)
        for (int n = 1; n < 4; ++n) exact.push_back(c / (2 * pi) * std::hypot(m * pi / length, (n - 0.5) * pi / depth));
    std::sort(exact.begin(), exact.end());
    const auto run = [&](int n) {
        const FluidModel water = build_fluid(box(length, depth, 3 * n / 2, n), {.far_end = FarEnd::closed});
        // A structure that is not coupled and far above the water.
        return coupled_modes(pencil_of(water, 1.0, 1e8, Eigen::VectorXd::Zero(water.unknowns())), 5).frequency;
    };
    const Eigen::VectorXd coarse = run(10), fine = run(20);
    std::vector<Check> checks;
    for (int k = 0; k < 5; ++k) {
        const std::string mode = fmt::format("mode {}", k + 1);
        checks.push_back({mode + ": frequency, 20 elements over the depth", "Hz", exact[static_cast<std::size_t>(k)],
                          fine[k], 1e-2});
        const double e0 = coarse[k] - exact[static_cast<std::size_t>(k)],
                     e1 = fine[k] - exact[static_cast<std::size_t>(k)];
        checks.push_back({mode + ": order", "–", 2.0, std::log2(e0 / e1), 0.05, Measure::absolute});
    }
    return checks;
}

/// Surface waves between a wall and an end with p = 0: ω² = g γ tanh γh, γ² = k² - ω²/c², k = (n - ½)π/L.
double sloshing_frequency(int n, double length, double depth, double c)
{
    const double k = (n - 0.5) * pi / length;
    double w2 = 0.0;
    for (int i = 0; i < 20; ++i) { // ω/ck is below 0.1: every round adds two digits and more
        const double gamma = std::sqrt(k * k - w2 / (c * c));
        w2 = 9.81 * gamma * std::tanh(gamma * depth);
    }
    return std::sqrt(w2) / (2.0 * pi);
}

std::vector<Check> sloshing()
{
    const double length = 50.0, depth = 20.0, c = std::sqrt(2.2e6);
    const auto run = [&](int n) {
        const FluidModel water =
            build_fluid(box(length, depth, 2 * n, n), {.surface = WaterSurface::sloshing, .far_end = FarEnd::open});
        return coupled_modes(pencil_of(water, 1.0, 1e8, Eigen::VectorXd::Zero(water.unknowns())), 4).frequency;
    };
    const Eigen::VectorXd coarse = run(10), fine = run(20);
    std::vector<Check> checks;
    for (int n = 1; n <= 4; ++n) {
        const double exact = sloshing_frequency(n, length, depth, c);
        checks.push_back(
            {fmt::format("wave {}: frequency, 20 elements over the depth", n), "Hz", exact, fine[n - 1], 1e-2});
        checks.push_back({fmt::format("wave {}: order", n), "–", 2.0,
                          std::log2((coarse[n - 1] - exact) / (fine[n - 1] - exact)), 0.05, Measure::absolute});
    }
    return checks;
}

std::vector<Check> piston()
{
    const double length = 100.0, mass = 2e5, stiffness = 8e7, c = std::sqrt(2.2e6);
    const std::vector<double> exact = exact::piston_and_column(mass, stiffness, 1000.0, c, length, 3);
    const auto run = [&](int n) {
        const FluidModel water = build_fluid(duct(length, n), {.bottom_reflection = -1.0, .far_end = FarEnd::closed});
        return coupled_modes(pencil_of(water, mass, stiffness, water.force_x), 3);
    };
    const CoupledModes a = run(20), b = run(40);
    std::vector<Check> checks;
    for (int k = 0; k < 3; ++k) {
        const double e = exact[static_cast<std::size_t>(k)] / (2 * pi);
        checks.push_back({fmt::format("mode {}: frequency, 40 elements", k + 1), "Hz", e, b.frequency[k], 5e-3});
        checks.push_back({fmt::format("mode {}: order", k + 1), "–", 2.0,
                          std::log2((a.frequency[k] - e) / (b.frequency[k] - e)), 0.05, Measure::absolute});
    }
    const CoupledModes all = coupled_modes(
        pencil_of(build_fluid(duct(length, 20), {.bottom_reflection = -1.0, .far_end = FarEnd::closed}), mass,
                  stiffness,
                  build_fluid(duct(length, 20), {.bottom_reflection = -1.0, .far_end = FarEnd::closed}).force_x),
        1000);
    checks.push_back({"effective masses of all modes: piston and column", "kg/m", mass + 1000.0 * length,
                      all.effective_mass.row(0).sum(), 1e-9});
    return checks;
}

std::vector<Check> duct_reflection()
{
    const double length = 100.0;
    std::vector<Check> checks;
    for (const double alpha : {1.0, 0.5, 0.0, -0.5, -1.0}) {
        double error[2] = {0, 0}, size = 0;
        for (const int fine : {0, 1}) {
            const FluidModel water =
                build_fluid(duct(length, fine ? 80 : 40), {.bottom_reflection = alpha, .far_end = FarEnd::closed});
            HarmonicSolver solver(water.mass, water.damping, water.stiffness);
            const double w = 2.3 * water.options.sound_speed() / length; // away from the duct's resonances
            solver.factorise(w);
            const Eigen::VectorXcd p = solver.solve((-water.flux_x).cast<std::complex<double>>());
            // The water pushes back: force -ρ L a times the closed pressure.
            const std::complex<double> computed =
                                           -(water.force_x.cast<std::complex<double>>().transpose() * p).value() / 1e5,
                                       expected = exact::duct_pressure(w, length, water.options.sound_speed(), alpha);
            error[fine] = std::abs(computed - expected);
            size = std::abs(expected);
        }
        checks.push_back({fmt::format("alpha {:g}: complex error, 80 elements", alpha), "–", 2e-3, error[1] / size, 0.0,
                          Measure::upper_bound});
        checks.push_back({fmt::format("alpha {:g}: order", alpha), "–", 2.0, std::log2(error[0] / error[1]), 0.05,
                          Measure::absolute});
    }
    return checks;
}

Scene wall_and_reservoir()
{
    Scene scene;
    scene.section.polygon = {{0, 0}, {200, 0}, {0, 100}};
    scene.reservoir = Reservoir{};
    scene.reservoir->level = 100.0;
    scene.reservoir->length = 100.0;
    scene.reservoir->bottom_reflection = 1.0;
    return scene;
}

/// Water alone in the symmetric form, stepped by the trapezoid rule under a ground acceleration that starts at once and stays.
std::vector<Check> step_response()
{
    Scene scene = wall_and_reservoir();
    scene.reservoir->mesh_size = 100.0 / 24.0;
    scene.mesh.growth = 1.02; // columns as fine as the rows: the first wave runs along the axis
    const FluidModel water = build_fluid(scene);
    const CoupledSystem system =
        couple(SparseMatrix(0, 0), SparseMatrix(0, 0), SparseMatrix(0, 0), SparseMatrix(0, water.unknowns()), water);
    const double c = water.options.sound_speed(), dt = 0.02 * 100.0 / c;
    SolverOptions solver;
    solver.definiteness = Definiteness::quasi_definite;
    LinearIntegrator integrator({system.mass, system.damping, system.stiffness, {}}, average_acceleration(), solver);
    const StepOperator& step = integrator.step_operator(dt);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(system.size());
    State before = integrator.state(zero, zero, zero, zero), after;
    const exact::InfiniteReservoir infinite{100.0, 1000.0, c, 1.0};
    double largest = 0.0;
    std::vector<Check> checks;
    const int steps = 1000;
    for (int k = 1; k <= steps; ++k) {
        const Eigen::VectorXd load = (dt * k) * system.velocity_x;
        integrator.finish_step(step, before, load, integrator.free_step(step, before, load), after);
        std::swap(before, after);
        const double force = -water.force_x.dot(system.pressures(before.velocity)) / 1e7;
        const bool shown = k == 25 || k == 50 || k == 100 || k == 200 || k == 500 || k == steps;
        if (shown || k % 10 == 0) {
            const double exact = infinite.step_force(dt * k);
            largest = std::max(largest, std::abs(force - exact));
            if (shown)
                checks.push_back({fmt::format("force at t = {:g} h/c", 0.02 * k), "rho h^2 a", exact, force,
                                  0.02 * 0.5428, Measure::absolute});
        }
    }
    checks.push_back(
        {"largest error over 0 < t < 20 h/c", "rho h^2 a", 0.02 * 0.5428, largest, 0.0, Measure::upper_bound});
    return checks;
}

/// The dam of Goldgruber (2015) with acoustic water and a closed far end at 2.4 depths.
Scene thesis_dam(double scale)
{
    Scene scene = exact::elastic_reference_scene(scale);
    scene.reservoir->length = 150.0 * scale;
    scene.reservoir->model = ReservoirModel::acoustic;
    scene.reservoir->far_end = FarEnd::closed;
    return scene;
}

std::vector<Check> thesis_modes()
{
    const double published[2][5] = {{3.6, 9.9, 12.2, 17.1, 18.0}, {1.8, 4.9, 6.1, 8.5, 9.0}};
    std::vector<Check> checks;
    for (const int doubled : {0, 1}) {
        const Scene scene = thesis_dam(doubled ? 2.0 : 1.0);
        const CoupledModes modes = coupled_modes_up_to(coupled_pencil(build_model(scene), build_fluid(scene)), 20.0, 5);
        const std::vector<Eigen::Index> leading = leading_modes(modes, 5);
        for (int k = 0; k < 5; ++k)
            checks.push_back({fmt::format("{} m, leading mode {}", doubled ? 125 : 62.5, k + 1), "Hz",
                              published[doubled][k], modes.frequency[leading[static_cast<std::size_t>(k)]], 0.025});
    }
    return checks;
}

/// Small coupled dam with everything that radiates.
Scene radiating_dam()
{
    Scene scene = thesis_dam(1.0);
    scene.curtain.reset();
    scene.foundation.reset();
    scene.mesh.size = 6.0;
    scene.mesh.contact_size = 5.0;
    scene.reservoir->far_end = FarEnd::absorbing;
    scene.reservoir->length = 62.5;
    scene.reservoir->mesh_size = 62.5 / 12.0;
    scene.reservoir->bottom_reflection = 0.6;
    return scene;
}

/// The symmetric form in ψ against the unsymmetric one in p, solved by the same L U.
std::vector<Check> symmetric_form()
{
    const Scene scene = radiating_dam();
    const Model model = build_model(scene);
    const FluidModel water = build_fluid(scene);
    const StructureSystem structure = structure_system(model, {1.5, 0.001});
    const SparseMatrix h = face_coupling(model.mesh, model.dofs, water.reservoir, water.dofs, water.unknowns());
    const Eigen::Index n = model.dofs.count, m = water.unknowns();
    const auto blocks = [&](const SparseMatrix& a, const SparseMatrix& upper, const SparseMatrix& lower,
                            const SparseMatrix& b) {
        std::vector<Eigen::Triplet<double>> entries;
        const auto add = [&](const SparseMatrix& x, Eigen::Index row, Eigen::Index column, double factor) {
            for (Eigen::Index j = 0; j < x.outerSize(); ++j)
                for (SparseMatrix::InnerIterator it(x, j); it; ++it)
                    entries.emplace_back(row + it.row(), column + it.col(), factor * it.value());
        };
        add(a, 0, 0, 1.0);
        add(upper, 0, n, -1.0);
        add(lower, n, 0, 1.0);
        add(b, n, n, 1.0);
        SparseMatrix result(n + m, n + m);
        result.setFromTriplets(entries.begin(), entries.end());
        return result;
    };
    const SparseMatrix none_upper(n, m), none_lower(m, n);
    HarmonicSolver pressures(blocks(structure.system.mass, none_upper, SparseMatrix(h.transpose()), water.mass),
                             blocks(structure.system.damping, none_upper, none_lower, water.damping),
                             blocks(structure.system.stiffness, h, none_lower, water.stiffness));
    std::vector<Check> checks;
    for (const double frequency : {0.5, 3.0, 6.5, 17.0}) {
        const TransferPoint point = transfer_functions(model, structure.system, &water, {frequency}).front();
        const double w = 2.0 * pi * frequency;
        pressures.factorise(w);
        Eigen::VectorXcd load(n + m);
        load << -model.inertia_x.cast<std::complex<double>>(), -water.flux_x.cast<std::complex<double>>();
        const Eigen::VectorXcd z = pressures.solve(load);
        const std::complex<double> crest = 1.0 - w * w * z[model.dofs(model.mesh.crest.back(), 0)],
                                   force = (water.force_x.cast<std::complex<double>>().transpose() * z.tail(m)).value();
        checks.push_back({fmt::format("{:g} Hz: crest acceleration, complex difference", frequency), "–", 0.0,
                          std::abs(point.crest - crest) / std::abs(crest), 1e-9, Measure::absolute});
        checks.push_back({fmt::format("{:g} Hz: water force, complex difference", frequency), "–", 0.0,
                          std::abs(point.water_force - force) / std::abs(force), 1e-9, Measure::absolute});
    }
    return checks;
}

std::vector<Check> energy()
{
    GroundMotion motion;
    motion.dt = 0.01;
    for (int k = 0; k <= 200; ++k) {
        const double t = k * motion.dt, window = std::sin(pi * k / 200.0);
        motion.accel_h.push_back(2.0 * std::sin(2.0 * pi * 2.5 * t) * window);
        motion.accel_v.push_back(1.1 * std::sin(2.0 * pi * 4.0 * t) * window);
    }
    std::vector<Check> checks;
    for (const BottomMotion bottom : {BottomMotion::still, BottomMotion::ground})
        for (const double alpha : {0.0, -1.0 / 3.0}) {
            Scene scene = radiating_dam();
            scene.reservoir->bottom_motion = bottom;
            const Model model = build_model(scene);
            const FluidModel water = build_fluid(scene);
            TiedRunOptions options;
            options.scheme = hht(alpha);
            options.damping.constants = {1.5, 0.001};
            options.water = &water;
            options.free_vibration = 3.0;
            const History history = integrate(model, motion, options);
            if (history.rows.empty()) { // the step's matrix could not be factorised
                checks.push_back({"steps made", "-", 1.0, 0.0, 0.0, Measure::lower_bound});
                continue;
            }
            const std::string run =
                fmt::format("bottom {}, alpha {:.2g}: ", bottom == BottomMotion::still ? "still" : "moving", alpha);
            checks.push_back({run + "largest imbalance over the largest energy", "–", 0.0, history.largest_imbalance,
                              1e-10, Measure::absolute});
            checks.push_back({run + "radiated over the largest energy", "–", 0.05,
                              history.rows.back().energy.radiated / history.energy_scale, 0.0, Measure::lower_bound});
            if (alpha == 0.0)
                checks.push_back({run + "numerical dissipation over the largest energy", "–", 0.0,
                                  history.rows.back().energy.numerical / history.energy_scale, 1e-10,
                                  Measure::absolute});
            const Energy& end = history.rows.back().energy;
            checks.push_back({run + "left in motion 3 s after the shaking, over the largest energy", "–", 1e-3,
                              (end.kinetic + end.strain) / history.energy_scale, 0.0, Measure::upper_bound});
        }
    return checks;
}

/// Steady shaking in the time domain: the last cycles against the harmonic solution.
std::vector<Check> time_against_frequency()
{
    const Scene scene = radiating_dam();
    const Model model = build_model(scene);
    const FluidModel water = build_fluid(scene);
    std::vector<Check> checks;
    for (const double frequency : {4.0, 8.0}) {
        GroundMotion motion;
        motion.dt = 1.0 / frequency / 100.0;
        for (int k = 0; k <= 4000; ++k) {
            const double t = k * motion.dt, rise = std::min(1.0, k / 1000.0);
            motion.accel_h.push_back(rise * rise * (3.0 - 2.0 * rise) * std::sin(2.0 * pi * frequency * t));
        }
        TiedRunOptions options;
        options.scheme = average_acceleration();
        options.damping.constants = {3.0, 0.002};
        options.water = &water;
        const History history = integrate(model, motion, options);
        double force = 0.0, crest = 0.0;
        for (std::size_t k = history.rows.size() - 100; k < history.rows.size(); ++k) {
            force = std::max(force, std::abs(history.rows[k].water_force_x));
            crest = std::max(crest, std::abs(history.rows[k].crest_accel_x));
        }
        const TransferPoint exact =
            transfer_functions(model, structure_system(model, options.damping.constants).system, &water, {frequency})
                .front();
        checks.push_back(
            {fmt::format("{:g} Hz: crest acceleration", frequency), "–", std::abs(exact.crest), crest, 5e-3});
        checks.push_back(
            {fmt::format("{:g} Hz: water force", frequency), "N/m", std::abs(exact.water_force), force, 5e-3});
    }
    return checks;
}

} // namespace

void add_fe_water_cases(Registry& registry)
{
    registry.push_back(
        {"fe2d.fluid.cavity", "Natural frequencies of a box of water: rigid walls, p = 0 on top.",
         "c/2 sqrt((m/L)^2 + ((n - 1/2)/h)^2)",
         "bilinear elements: order 2, error (kh)^2/24 of a mode, 1 % for the fifth with 20 elements over the depth",
         cavity});
    registry.push_back(
        {"fe2d.fluid.sloshing",
         "Surface waves of a tank: frequencies of a sloshing surface between a wall and an end with p = 0.",
         "omega^2 = g gamma tanh(gamma h), gamma^2 = k^2 - omega^2/c^2, k = (n - 1/2) pi/L (Lamb, "
         "Hydrodynamics, art. 228, with compressible water)",
         "order 2; the fourth wave with 11 elements a quarter of its length errs by (kh)^2/24, 0.3 %", sloshing});
    registry.push_back({"fe2d.fluid.piston-and-column",
                        "A sprung mass in front of a water column with p = 0 at its end.",
                        "k = omega^2 (m + rho tan(omega L/c) c/omega), from the wave equation; all effective masses "
                        "sum to piston and water",
                        "order 2; (kh)^2/24 of the third mode with 40 elements is 0.2 %; sums to round-off", piston});
    registry.push_back({"fe2d.fluid.duct-impedance", "A piston drives a duct whose end reflects the share alpha.",
                        "p = rho c v (1 + alpha e^-2ikL)/(1 - alpha e^-2ikL); admittance (1/rho c)(1 - alpha)/(1 + "
                        "alpha) (Goldgruber 2015, (3-54)-(3-58))",
                        "order 2; 0.2 % with 80 elements at kL = 2.3", duct_reflection});
    registry.push_back(
        {"fe2d.fluid.step-response",
         "Force on a rigid wall under an acceleration that starts at once and stays; infinite reservoir.",
         "(2c/h^3) sum mu_n^-2 times the integral of J_0(mu_n c t): transform of Chopra's series, rigid bottom",
         "2 % of the static force at every time up to 20 h/c: 24 elements over the depth, columns alike, trapezoid "
         "rule of 0.02 h/c; the wave fronts, "
         "which no mesh resolves, ring",
         step_response});
    registry.push_back({"fe2d.fluid.reference-modes",
                        "Dam on massless rock with acoustic water and a closed far end: leading coupled modes.",
                        "Goldgruber (2015), tables 4-3 and 4-4, acoustic rows: 3.6, 9.9, 12.2, 17.1, 18.0 Hz; twice "
                        "the size 1.8, 4.9, 6.1, 8.5, 9.0 Hz",
                        "2.5 %: the source rounds to 0.1 Hz and its section is a reconstruction. Leading: the first "
                        "five by frequency in which the "
                        "dam's own mass carries at least 0.1 % of the horizontal effective mass",
                        thesis_modes});
    registry.push_back({"fe2d.fluid.symmetric-form",
                        "Dam and absorbing reservoir: the symmetric system in the velocity potential answers as the "
                        "unsymmetric one in pressures.",
                        "the same equations before integration in time and scaling",
                        "round-off of two L U factorisations: 1e-9", symmetric_form});
    registry.push_back({"fe2d.fluid.energy", "Energy of a tied dam with acoustic water closes, what radiates included.",
                        "balance of the equations themselves: every term from the states",
                        "round-off over 500 steps: 1e-10 of the largest energy", energy});
    registry.push_back({"fe2d.fluid.time-against-frequency", "Steady shaking in time reaches the harmonic solution.",
                        "transfer functions of the same matrices, solved by L U at the frequency",
                        "0.5 %: 100 steps of the trapezoid per cycle lengthen periods by 0.03 %, peaks read at samples "
                        "lose 0.05 %, the rest "
                        "of the start's transient is below 0.1 % after 40 cycles",
                        time_against_frequency});
}

} // namespace damslip::verification
