#include "verification/cases/modules.hpp"

#include "fe2d/fluid/coupled_system.hpp"
#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/harmonic/transfer.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/rock/radiating_rock.hpp"
#include "fe2d/rock/reduced_rock.hpp"
#include "fe2d/solver/dense_product.hpp"
#include "fe2d/time/integrate.hpp"
#include "fe2d/time/structure_system.hpp"
#include "verification/cases/fe_run_scenes.hpp"
#include "verification/exact/half_plane.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <numbers>

namespace damslip::verification {

namespace {

using namespace damslip::fe2d;

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using std::numbers::pi;

// --- A column of water on a half space -----------------------------------------------------------------------------------

/// Upright, one element wide.
ReservoirMesh water_column(double width, double depth, int elements)
{
    ReservoirMesh column;
    column.depth = depth;
    for (int j = 0; j <= elements; ++j)
        for (const double x : {0.0, -width}) column.mesh.nodes.push_back({x, depth * j / elements});
    for (int j = 0; j < elements; ++j)
        column.mesh.elements.push_back({{2 * j + 1, 2 * j, 2 * j + 2, 2 * j + 3}, Region::reservoir});
    for (int j = 0; j <= elements; ++j) {
        column.face.push_back(2 * j);
        column.far_end.push_back(2 * (elements - j) + 1);
    }
    column.surface = {2 * elements, 2 * elements + 1};
    column.bottom = {1, 0};
    return column;
}

/// A rod of compression waves below the column, linear elements, a dashpot ρc at its end: in one dimension nothing comes back from there.
/// All its modes, so nothing is left to the residual.
ReducedRock half_space_of_a_column(double width, double density, double speed, double length, int elements)
{
    const Index n = elements + 1;
    const double h = length / elements;
    VectorXd mass = VectorXd::Constant(n, density * width * h);
    mass[0] *= 0.5;
    mass[n - 1] *= 0.5;
    MatrixXd stiffness = MatrixXd::Zero(n, n), damping = MatrixXd::Zero(n, n);
    for (Index k = 0; k + 1 < n; ++k) {
        const double spring = density * speed * speed * width / h;
        stiffness(k, k) += spring;
        stiffness(k + 1, k + 1) += spring;
        stiffness(k, k + 1) -= spring;
        stiffness(k + 1, k) -= spring;
    }
    stiffness(n - 1, n - 1) += 1e-9 * stiffness(0, 0); // positive definite
    damping(n - 1, n - 1) = density * speed * width;
    const VectorXd scale = mass.cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scale.asDiagonal() * stiffness * scale.asDiagonal());
    const MatrixXd modes = scale.asDiagonal() * eigen.eigenvectors();
    ReducedRock rock;
    rock.floor = 2;
    rock.stiffness = eigen.eigenvalues().cwiseMax(1e-12);
    rock.damping = modes.transpose() * damping * modes;
    rock.modes = MatrixXd(2, n); // down is out of the water: each node takes half of the width
    rock.modes.row(0) = rock.modes.row(1) = 0.5 * width * modes.row(0);
    rock.residual = MatrixXd::Zero(2, 2);
    return rock;
}

/// Peak of a pulse that comes back from the floor over that of the pulse which went there, of the signed pressure.
double reflected_share(double impedance_over_water)
{
    constexpr double width = 1.0, depth = 300.0, sigma = 8.0, start = 170.0, probe = 90.0;
    constexpr int elements = 600;
    FluidOptions options;
    options.far_end = FarEnd::closed;
    options.floor_on_rock = true;
    const FluidModel water = build_fluid(water_column(width, depth, elements), options);
    const double c = options.sound_speed(), rock_speed = 3500.0,
                 rock_density = impedance_over_water * options.density * c / rock_speed;
    const SparseMatrix none(0, 0);
    const CoupledSystem system = couple(none, none, none, SparseMatrix(0, water.unknowns()), water);
    SolverOptions solver;
    solver.definiteness = Definiteness::quasi_definite;
    LinearIntegrator integrator({system.mass, system.damping, system.stiffness, {}}, average_acceleration(), solver);
    const double dt = 0.5 * depth / elements / c;
    const StepOperator& step = integrator.step_operator(dt);
    const ReducedRock rock = half_space_of_a_column(width, rock_density, rock_speed, 60.0, 120);
    BaseCoupling coupling(rock_base(rock, step.constants(), 0.0), step, {}, system.size(),
                          {unknowns_of_floor(system, water), system.scale});

    // φ = f(y + ct), p = s φ̇ = exp(-((y - start)/σ)²) at first
    VectorXd phi = VectorXd::Zero(system.size()), rate = phi, acceleration = phi;
    for (std::size_t node = 0; node < water.reservoir.mesh.nodes.size(); ++node) {
        const int k = water.dofs(static_cast<int>(node));
        if (k == no_dof) continue;
        const double x = (water.reservoir.mesh.nodes[node].y - start) / sigma, pulse = std::exp(-x * x);
        phi[k] = -0.5 * std::sqrt(pi) * sigma * std::erfc(x) / (system.scale * c);
        rate[k] = pulse / system.scale;
        acceleration[k] = -2.0 * x / sigma * c * pulse / system.scale;
    }
    const VectorXd load = VectorXd::Zero(system.size());
    State before = integrator.state(phi, rate, acceleration, load), after;
    const int at = water.dofs(2 * static_cast<int>(std::lround(probe / depth * elements)));
    double down = 0.0, up = 0.0;
    const double passed = (start - probe + 4.0 * sigma) / c, end = (start + probe + 4.0 * sigma) / c;
    for (double t = 0.0; t < end; t += dt) {
        const FreeStep free = integrator.free_step(step, before, load);
        integrator.finish_step(step, before, load, free, coupling.step(free, before), after);
        std::swap(before, after);
        const double pressure = system.scale * before.velocity[at];
        double& peak = t < passed ? down : up;
        if (std::abs(pressure) > std::abs(peak)) peak = pressure;
    }
    return up / down;
}

std::vector<Check> reflections()
{
    std::vector<Check> checks;
    for (const double ratio : {6.337, 2.0, 1.0, 0.5})
        checks.push_back(
            {fmt::format("reflected over incident pressure, impedance of the rock {:.4g} times the water's", ratio),
             "-", (ratio - 1.0) / (ratio + 1.0), reflected_share(ratio), 5e-3, Measure::absolute});
    return checks;
}

// --- The floor of the reference dam ----------------------------------------------------------------------------------------

constexpr RayleighConstants floor_damping{1.5, 1e-3};

Scene dam_on_floor(double stiffness = 1.0)
{
    Scene scene = test::sliding_dam(0.70, 1.0, 5.0);
    scene.curtain.reset();
    scene.foundation->material = {2650.0, 30e9 * stiffness, 0.2};
    scene.foundation->mass = RockMass::with_mass;
    scene.foundation->boundary = RockBoundary::absorbing;
    scene.mesh.size = 5.0;
    scene.mesh.rock_size = 12.5;
    scene.reservoir->model = ReservoirModel::acoustic;
    scene.reservoir->length = 125.0;
    scene.reservoir->mesh_size = 6.25;
    scene.reservoir->floor = ReservoirFloor::rock;
    return scene;
}

struct TiedOnFloor {
    explicit TiedOnFloor(const Scene& scene)
        : model(build_model(scene)), water(build_fluid(scene)),
          rock(radiating_rock_of(scene, model.mesh, model.mesh.contact.rock_nodes, 25.0, {}))
    {
    }
    TiedRunOptions options() const
    {
        TiedRunOptions options;
        options.damping.constants = floor_damping;
        options.water = &water;
        options.moving_base = [this](const StepConstants& constants, double stiffness_damping) {
            return rock_base(rock.rock, constants, stiffness_damping);
        };
        return options;
    }

    Model model;
    FluidModel water;
    RadiatingRock rock;
};

std::vector<Check> strips()
{
    const Scene scene = dam_on_floor();
    const TiedOnFloor dam(scene);
    const double length = scene.reservoir->length, density = 2650.0;
    const exact::HalfPlane plane{30e9 / 2.4, 0.2, density, 0.5 * length};
    const ReducedRock& rock = dam.rock.rock;
    VectorXd load = VectorXd::Zero(rock.interface());
    load.tail(rock.floor).setOnes();
    std::vector<Check> checks;
    for (const double hertz : {3.0, 8.0, 16.0, 25.0}) {
        const double w = 2.0 * pi * hertz;
        const std::complex<double> sunk = (load.transpose() * rock.response(w, 0.0, load)).value() / (length * length);
        checks.push_back({fmt::format("{:g} Hz: compliance of the whole floor, largest complex error", hertz), "-", 0.0,
                          std::abs(sunk / plane.vertical(w) - 1.0), 0.03, Measure::absolute});
    }
    return checks;
}

/// Transfer functions on all unknowns of the box of rock, dam and water standing on it.
std::vector<TransferPoint> on_whole_box(const TiedOnFloor& dam, const std::vector<double>& frequencies)
{
    WaveBoxInput input;
    input.rock = dam.model.materials.rock;
    const ReservoirMesh& reservoir = dam.water.reservoir;
    for (std::size_t k = 0; k + 1 < reservoir.bottom.size(); ++k)
        input.surface.push_back(reservoir.mesh.nodes[static_cast<std::size_t>(reservoir.bottom[k])]);
    input.floor = static_cast<int>(input.surface.size());
    for (const int node : dam.model.mesh.contact.rock_nodes)
        input.surface.push_back(dam.model.mesh.nodes[static_cast<std::size_t>(node)]);
    const auto heel = static_cast<std::size_t>(input.floor);
    input.base = input.surface.back().x - input.surface[heel].x;
    input.middle = 0.5 * (input.surface.back().x + input.surface.front().x);
    input.highest_frequency = dam.rock.resolved;
    input.shape = dam.rock.box;
    const WaveBox box = make_wave_box(input);

    const LinearSystem above = dam_on_free_base(dam.model, floor_damping);
    const std::vector<Index> base = unknowns_of_base(dam.model);
    std::vector<Index> place(static_cast<std::size_t>(box.stiffness.rows()), -1);
    for (std::size_t k = 0; k < base.size(); ++k)
        place[static_cast<std::size_t>(box.interface[2 * heel + k])] = base[k];
    Index size = above.size();
    for (Index& p : place)
        if (p < 0) p = size++;
    const auto joined = [&](const SparseMatrix& of_dam, const SparseMatrix& of_box) {
        std::vector<Eigen::Triplet<double>> entries;
        for (Index j = 0; j < of_dam.outerSize(); ++j)
            for (SparseMatrix::InnerIterator it(of_dam, j); it; ++it) entries.emplace_back(it.row(), j, it.value());
        for (Index j = 0; j < of_box.outerSize(); ++j)
            for (SparseMatrix::InnerIterator it(of_box, j); it; ++it)
                entries.emplace_back(place[static_cast<std::size_t>(it.row())], place[static_cast<std::size_t>(j)],
                                     it.value());
        SparseMatrix matrix(size, size);
        matrix.setFromTriplets(entries.begin(), entries.end());
        return matrix;
    };
    // H of the face, and of the floor: down is out of the water
    const SparseMatrix face =
        face_coupling(dam.model.mesh, dam.model.dofs, reservoir, dam.water.dofs, dam.water.unknowns());
    std::vector<Eigen::Triplet<double>> entries;
    for (Index j = 0; j < face.outerSize(); ++j)
        for (SparseMatrix::InnerIterator it(face, j); it; ++it)
            if (it.row() < above.size()) entries.emplace_back(it.row(), j, it.value());
    for (std::size_t k = 0; k < heel; ++k) {
        const double length = input.surface[k + 1].x - input.surface[k].x;
        for (const std::size_t i : {k, k + 1})
            for (const std::size_t j : {k, k + 1})
                entries.emplace_back(place[static_cast<std::size_t>(box.interface[2 * i + 1])], dam.water.floor[j],
                                     -length * (i == j ? 1.0 / 3.0 : 1.0 / 6.0));
    }
    SparseMatrix coupling(size, dam.water.unknowns());
    coupling.setFromTriplets(entries.begin(), entries.end());
    const CoupledSystem system =
        couple(joined(above.mass, box.mass),
               joined(above.damping, SparseMatrix(box.damping + floor_damping.stiffness * box.stiffness)),
               joined(above.stiffness, box.stiffness), coupling, dam.water);
    HarmonicSolver solver(system.mass, system.damping, system.stiffness);
    const int crest = dam.model.dofs(dam.model.mesh.crest.back(), 0);
    std::vector<TransferPoint> points;
    for (const double frequency : frequencies) {
        const double w = 2.0 * pi * frequency;
        const std::complex<double> rate(0.0, w);
        TransferPoint point;
        point.frequency = frequency;
        point.regular = solver.factorise(w);
        Eigen::VectorXcd load = system.velocity_x.cast<std::complex<double>>() / rate;
        load.head(above.size()) -= dam.model.inertia_x.head(above.size());
        const Eigen::VectorXcd z = solver.solve(load);
        point.crest = 1.0 - w * w * z[crest];
        point.water_force =
            system.scale * rate *
            (dam.water.force_x.cast<std::complex<double>>().transpose() * z.tail(system.water_unknowns)).value();
        points.push_back(point);
    }
    return points;
}

std::vector<Check> whole_box()
{
    const TiedOnFloor dam(dam_on_floor());
    const std::vector<double> frequencies{1.0, 2.0, 3.0, 3.5, 4.5, 6.0, 9.0, 14.0, 20.0};
    const RockBelow below{dam.rock.rock, floor_damping.stiffness};
    const std::vector<TransferPoint> found = transfer_functions(dam.model, dam_on_free_base(dam.model, floor_damping),
                                                                &dam.water, frequencies, &below),
                                     wanted = on_whole_box(dam, frequencies);
    double crest = 0.0, force = 0.0;
    for (std::size_t k = 0; k < found.size(); ++k) {
        crest = std::max(crest, std::abs(found[k].crest - wanted[k].crest) / std::abs(wanted[k].crest));
        force =
            std::max(force, std::abs(found[k].water_force - wanted[k].water_force) / std::abs(wanted[k].water_force));
    }
    return {{"crest acceleration, 1 to 20 Hz, largest complex difference", "-", 0.0, crest, 0.01, Measure::absolute},
            {"water force on the dam, largest complex difference", "-", 0.0, force, 0.01, Measure::absolute}};
}

std::vector<double> crest_of_run(const Scene& scene, const GroundMotion& motion)
{
    const TiedOnFloor dam(scene);
    std::vector<double> crest;
    for (const HistoryRow& row : integrate(dam.model, motion, dam.options()).rows) crest.push_back(row.crest_x);
    return crest;
}

double difference_of_crests(const std::vector<double>& a, const std::vector<double>& b)
{
    double difference = a.size() == b.size() && !a.empty() ? 0.0 : std::nan(""), largest = 0.0;
    for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
        difference = std::max(difference, std::abs(a[k] - b[k]));
        largest = std::max(largest, std::abs(b[k]));
    }
    return difference / largest;
}

std::vector<Check> limits_of_the_floor()
{
    const GroundMotion motion = test::sines(1.0, 6.0);
    std::vector<Check> checks;
    for (const auto& [modulus, tolerance] : {std::pair{1e6, 0.01}, {1e8, 0.001}}) {
        const Scene stiff = dam_on_floor(modulus / 30.0);
        Scene rigid = stiff;
        rigid.reservoir->floor = ReservoirFloor::absorbing;
        rigid.reservoir->bottom_reflection = 1.0;
        checks.push_back(
            {fmt::format(
                 "rock of {:.0e} GPa: crest beside that over a rigid floor, largest difference over the largest",
                 modulus),
             "-", 0.0, difference_of_crests(crest_of_run(stiff, motion), crest_of_run(rigid, motion)), tolerance,
             Measure::absolute});
    }
    Scene boxed = dam_on_floor();
    const std::vector<double> crest = crest_of_run(boxed, motion);
    for (const double size : {0.7, 1.4}) {
        boxed.foundation->wave_box = size;
        checks.push_back({fmt::format("box x {:g}: crest, largest difference over the largest", size), "-", 0.0,
                          difference_of_crests(crest_of_run(boxed, motion), crest), 0.02, Measure::absolute});
    }
    return checks;
}

std::vector<Check> energy_across_the_floor()
{
    std::vector<Check> checks;
    const GroundMotion motion = test::sines(1.0, 6.0);
    const Scene scene = dam_on_floor();
    const TiedOnFloor dam(scene);
    for (const double alpha : {0.0, -0.05, -1.0 / 3.0}) {
        TiedRunOptions options = dam.options();
        options.scheme = hht(alpha);
        const History history = integrate(dam.model, motion, options);
        const std::string run = fmt::format("tied, alpha {:.2g}: ", alpha);
        checks.push_back({run + "largest imbalance over the largest energy", "-", 0.0, history.largest_imbalance, 1e-11,
                          Measure::absolute});
        const Energy& end = history.rows.back().energy;
        checks.push_back({run + "work of the water on the rock over what radiates", "-", 0.01, end.floor / end.radiated,
                          0.0, Measure::lower_bound});
    }
    const RunResult slide = EarthquakeRun(scene, test::options_of(scene)).run(motion);
    checks.push_back(
        {"sliding: imbalance over the largest energy", "-", 0.0, slide.energy_error, 1e-10, Measure::absolute});
    checks.push_back({"sliding: slip", "m", 1e-3, slide.slip, 0.0, Measure::lower_bound});
    return checks;
}

} // namespace

void add_fe_rock_floor_cases(Registry& registry)
{
    registry.push_back(
        {"fe2d.rock.floor-column",
         "A column of water on a half space: what comes back from the coupled floor (reservoir.floor = "
         "\"rock\") of a pulse that goes straight down.",
         "(rho_r c_r - rho c)/(rho_r c_r + rho c), d'Alembert's waves on both sides; Goldgruber (2015), (3-55)",
         "linear elements of 1/16 of the pulse's length, rounded peaks between steps: 0.005", reflections});
    registry.push_back({"fe2d.rock.floor-strip",
                        "The reduced rock under 125 m of water, pushed by one pressure on its whole floor.",
                        "half plane under a uniform strip load (Lamb 1904), exact integrals",
                        "the gate of boxes of waves, base or floor: 3 % from 3 Hz on", strips});
    registry.push_back(
        {"fe2d.rock.floor-box",
         "Transfer functions of the reference dam, acoustic water on the rock: rock reduced to base and floor "
         "beside all unknowns of its box.",
         "one matrix of dam, water and box, the floor coupled node by node",
         "the reduction's gate is 2 % of single loads and frequencies, of which the dam feels part: 1 %", whole_box});
    registry.push_back(
        {"fe2d.rock.floor-limits",
         "Water on the rock, tied dam in time: on rock of 1e6 and 1e8 GPa its floor is rigid, and boxes of other sizes "
         "give the same.",
         "a floor with alpha = 1 on that rock; boxes x 0.7 and x 1.4",
         "1 - alpha of those rocks is 1.7e-3 and 1.7e-4, of which the water's resonance makes some five times as much: "
         "1 % and 0.1 "
         "%; box: the gate of the slip, 2 %",
         limits_of_the_floor});
    registry.push_back(
        {"fe2d.rock.floor-energy", "Energy closes with what passes from the water through the floor into the rock.",
         "every term from the states", "round-off of sums over 600 steps; of a sliding dam 1e-10 as without the floor",
         energy_across_the_floor});
}

} // namespace damslip::verification
