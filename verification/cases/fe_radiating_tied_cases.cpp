#include "verification/cases/modules.hpp"

#include "fe2d/modes/modes_and_damping.hpp"
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

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <complex>
#include <fmt/format.h>
#include <numbers>

namespace damslip::verification {

namespace {

using namespace damslip::fe2d;

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::VectorXd;
using std::numbers::pi;

constexpr RayleighConstants some_damping{1.5, 1e-3};

/// The reference dam with added mass on coarse elements, its rock homogeneous.
Scene dam_on_rock(RockBoundary boundary, double width = 300.0, double depth = 100.0)
{
    Scene scene = test::sliding_dam(0.77, 1.0, 5.0);
    scene.curtain.reset();
    scene.foundation->material.density = 2650.0;
    scene.foundation->mass = RockMass::with_mass;
    scene.foundation->boundary = boundary;
    scene.foundation->width = width;
    scene.foundation->depth = depth;
    scene.mesh.size = 5.0;
    scene.mesh.rock_size = 12.5;
    return scene;
}

Scene with_acoustic_water(Scene scene)
{
    scene.reservoir->model = ReservoirModel::acoustic;
    scene.reservoir->length = 125.0;
    scene.reservoir->mesh_size = 6.25;
    return scene;
}

Model tied_model(const Scene& scene, RockEdges edges = RockEdges::fixed)
{
    ModelOptions options;
    options.added_mass = test::options_of(scene).added_mass;
    options.edges = edges;
    return build_model(scene, options);
}

/// A dam tied to radiating rock.
struct OnRadiatingRock {
    explicit OnRadiatingRock(const Scene& scene_)
        : scene(scene_), model(tied_model(scene)),
          rock(radiating_rock_of(scene, model.mesh, model.mesh.contact.rock_nodes, 25.0, {}))
    {
        if (scene.reservoir && scene.reservoir->model == ReservoirModel::acoustic) water = build_fluid(scene);
    }

    TiedRunOptions options() const
    {
        TiedRunOptions options;
        options.damping.constants = some_damping;
        options.water = water ? &*water : nullptr;
        options.moving_base = [this](const StepConstants& constants, double stiffness_damping) {
            return rock_base(rock.rock, constants, stiffness_damping);
        };
        return options;
    }

    Scene scene;
    Model model;
    RadiatingRock rock;
    std::optional<FluidModel> water;
};

/// Largest difference of the crest's motion over its largest, each from its own start.
double crest_difference(const std::vector<double>& a, const std::vector<double>& b)
{
    double difference = a.size() == b.size() && !a.empty() ? 0.0 : std::nan(""), largest = 0.0;
    for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
        difference = std::max(difference, std::abs((a[k] - a[0]) - (b[k] - b[0])));
        largest = std::max(largest, std::abs(b[k] - b[0]));
    }
    return difference / largest;
}

std::vector<double> crest_of(const History& history)
{
    std::vector<double> crest;
    for (const HistoryRow& row : history.rows) crest.push_back(row.crest_x);
    return crest;
}

/// Adds `from`, whose unknowns stand at `place`, to the entries.
void add_at(const SparseMatrix& from, const std::vector<Index>& place, double factor,
            std::vector<Eigen::Triplet<double>>& entries)
{
    for (Index j = 0; j < from.outerSize(); ++j)
        for (SparseMatrix::InnerIterator it(from, j); it; ++it)
            entries.emplace_back(place[static_cast<std::size_t>(it.row())], place[static_cast<std::size_t>(j)],
                                 factor * it.value());
}

/// The dam on all unknowns of the box that the rock was reduced from.
LinearSystem dam_on_box(const OnRadiatingRock& dam, const WaveBox& box)
{
    const LinearSystem above = dam_on_free_base(dam.model, some_damping);
    const std::vector<Index> base = unknowns_of_base(dam.model);
    std::vector<Index> same(static_cast<std::size_t>(above.size())),
        place(static_cast<std::size_t>(box.stiffness.rows()), -1);
    for (std::size_t k = 0; k < same.size(); ++k) same[k] = static_cast<Index>(k);
    for (std::size_t k = 0; k < box.interface.size(); ++k) place[static_cast<std::size_t>(box.interface[k])] = base[k];
    Index size = above.size();
    for (Index& p : place)
        if (p < 0) p = size++;
    const auto joined = [&](const SparseMatrix& of_dam, const SparseMatrix& of_box, const SparseMatrix* more,
                            double factor) {
        std::vector<Eigen::Triplet<double>> entries;
        add_at(of_dam, same, 1.0, entries);
        add_at(of_box, place, 1.0, entries);
        if (more) add_at(*more, place, factor, entries);
        SparseMatrix matrix(size, size);
        matrix.setFromTriplets(entries.begin(), entries.end());
        return matrix;
    };
    return {joined(above.mass, box.mass, nullptr, 0.0),
            joined(above.damping, box.damping, &box.stiffness, some_damping.stiffness),
            joined(above.stiffness, box.stiffness, nullptr, 0.0),
            {}};
}

std::vector<double> crest_on_whole_box(const OnRadiatingRock& dam, const GroundMotion& motion)
{
    WaveBoxInput input;
    input.rock = dam.model.materials.rock;
    const std::vector<int>& nodes = dam.model.mesh.contact.rock_nodes;
    for (const int node : nodes) input.surface.push_back(dam.model.mesh.nodes[static_cast<std::size_t>(node)]);
    input.base = input.surface.back().x - input.surface.front().x;
    input.middle = 0.5 * (input.surface.back().x + input.surface.front().x);
    input.highest_frequency = dam.rock.resolved;
    input.shape = dam.rock.box;
    const LinearSystem system = dam_on_box(dam, make_wave_box(input));
    LinearIntegrator integrator(system, TiedRunOptions{}.scheme);
    VectorXd load = VectorXd::Zero(system.size());
    const Index n = dam_dof_count(dam.model.mesh, dam.model.dofs);
    const auto shake = [&](std::size_t k) {
        load.head(n) =
            motion.accel_h[k] * dam.model.inertia_x.head(n) - motion.accel_v[k] * dam.model.inertia_y.head(n);
    };
    shake(0);
    const VectorXd still = VectorXd::Zero(system.size());
    State before = integrator.start(still, still, load), after;
    const StepOperator& step = integrator.step_operator(motion.dt);
    const int crest = dam.model.dofs(dam.model.mesh.crest.back(), 0);
    std::vector<double> history{0.0};
    for (std::size_t k = 1; k < motion.accel_h.size(); ++k) {
        shake(k);
        integrator.finish_step(step, before, load, integrator.free_step(step, before, load), after);
        std::swap(before, after);
        history.push_back(before.displacement[crest]);
    }
    return history;
}

std::vector<double> crest_on_viscous_box(double width, double depth, const GroundMotion& motion)
{
    const Model model = tied_model(dam_on_rock(RockBoundary::viscous, width, depth), RockEdges::free);
    TiedRunOptions options;
    options.damping.constants = some_damping;
    options.start_displacement = VectorXd::Zero(model.dofs.count);
    return crest_of(integrate(model, motion, options));
}

std::vector<Check> boxes()
{
    const GroundMotion motion = test::sines(1.0, 6.0);
    const OnRadiatingRock dam(dam_on_rock(RockBoundary::absorbing));
    const std::vector<double> reduced = crest_of(integrate(dam.model, motion, dam.options())),
                              small = crest_on_viscous_box(600.0, 300.0, motion),
                              large = crest_on_viscous_box(1200.0, 600.0, motion);
    const double open = crest_difference(small, large);
    return {{"crest beside that on all unknowns of its box, largest difference over the largest", "-", 0.0,
             crest_difference(reduced, crest_on_whole_box(dam, motion)), 5e-3, Measure::absolute},
            {"crest, dashpots alone, 600 x 300 m beside 1200 x 600 m: what such boxes leave open", "-", 0.15, open, 0.0,
             Measure::upper_bound},
            {"crest beside 1200 x 600 m with dashpots alone, over that", "-", 0.75,
             crest_difference(reduced, large) / open, 0.0, Measure::upper_bound}};
}

/// A blow with frequencies up to some 12 Hz, and rest for as long as the dam rings.
GroundMotion blow(double dt, double duration)
{
    GroundMotion motion;
    motion.dt = dt;
    for (int k = 0; k * dt <= duration; ++k) {
        const double x = (k * dt - 0.3) / 0.04;
        motion.accel_h.push_back(-2.0 * x * std::exp(-x * x));
    }
    return motion;
}

/// Of the history and the ground's downstream acceleration at one frequency.
template <class Value>
Complex quotient(const History& history, double frequency, const Value& value)
{
    Complex sum = 0.0, ground = 0.0;
    for (const HistoryRow& row : history.rows) {
        const Complex turn = std::exp(Complex(0.0, -2.0 * pi * frequency * row.time));
        sum += value(row) * turn;
        ground += -row.ground_accel_h * turn;
    }
    return sum / ground;
}

std::vector<Check> transfer_of_a_blow()
{
    std::vector<Check> checks;
    const std::vector<double> frequencies{1.0, 2.0, 3.0, 4.0, 6.0, 9.0};
    for (const bool acoustic : {false, true}) {
        Scene scene = dam_on_rock(RockBoundary::absorbing);
        if (acoustic) scene = with_acoustic_water(scene);
        const OnRadiatingRock dam(scene);
        TiedRunOptions options = dam.options();
        options.scheme = average_acceleration();
        const History history = integrate(dam.model, blow(0.001, 6.0), options);
        const RockBelow rock{dam.rock.rock, some_damping.stiffness};
        const std::vector<TransferPoint> points =
            transfer_functions(dam.model, dam_on_free_base(dam.model, some_damping), options.water, frequencies, &rock);
        double crest = 0.0, force = 0.0;
        for (const TransferPoint& p : points) {
            const Complex of_crest =
                quotient(history, p.frequency, [](const HistoryRow& r) { return r.crest_accel_x; });
            crest = std::max(crest, std::abs(of_crest - p.crest) / std::abs(p.crest));
            if (!acoustic) continue;
            const Complex of_water =
                quotient(history, p.frequency, [](const HistoryRow& r) { return r.water_force_x; });
            force = std::max(force, std::abs(of_water - p.water_force) / std::abs(p.water_force));
        }
        const std::string water = acoustic ? "acoustic water: " : "added mass: ";
        checks.push_back(
            {water + "crest acceleration, largest complex difference", "-", 0.0, crest, 2e-3, Measure::absolute});
        if (acoustic)
            checks.push_back(
                {water + "water force, largest complex difference", "-", 0.0, force, 2e-3, Measure::absolute});
    }
    return checks;
}

std::vector<Check> rest_and_energy()
{
    std::vector<Check> checks;
    GroundMotion still;
    still.dt = 0.01;
    still.accel_h.assign(501, 0.0);
    const GroundMotion motion = test::sines(1.0, 6.0);
    for (const bool acoustic : {false, true}) {
        Scene scene = dam_on_rock(RockBoundary::absorbing);
        if (acoustic) scene = with_acoustic_water(scene);
        const OnRadiatingRock dam(scene);
        const std::string water = acoustic ? "acoustic water, " : "added mass, ";
        TiedRunOptions options = dam.options();
        const StaticLoads loads = static_loads(scene, dam.model);
        options.static_load =
            sum_of(loads.gravity, dam.model.dofs.count) + sum_of(loads.impounding, dam.model.dofs.count);
        checks.push_back({water + "record of zeros: crest after 5 s", "m", 0.0,
                          integrate(dam.model, still, options).peak_crest_x, 1e-12, Measure::absolute});
        for (const double alpha : {0.0, -0.05, -1.0 / 3.0}) {
            options.scheme = hht(alpha);
            const History history = integrate(dam.model, motion, options);
            const Energy& end = history.rows.back().energy;
            const std::string run = water + fmt::format("alpha {:.2g}: ", alpha);
            checks.push_back({run + "largest imbalance over the largest energy", "-", 0.0, history.largest_imbalance,
                              1e-11, Measure::absolute});
            checks.push_back(
                {run + "radiated over damped", "-", 0.1, end.radiated / end.damping, 0.0, Measure::lower_bound});
            if (alpha == 0.0)
                checks.push_back({run + "numerical dissipation over the largest energy", "-", 0.0,
                                  end.numerical / history.energy_scale, 1e-10, Measure::absolute});
        }
    }
    return checks;
}

// Pine Flat, tallest monolith, as fe.modes.pine-flat has it.
constexpr double ft = 0.3048, psi = 6894.757293168361, lb_ft3 = 16.01846337396014;

Scene pine_flat(bool flexible, bool full)
{
    const Polyline feet{{0, 0},       {314.32, 0},  {48.75, (314.32 - 48.75) / 0.78},
                        {48.75, 400}, {16.75, 400}, {16.75, 335}};
    Polyline polygon;
    for (const Point p : feet) polygon.push_back({p.x * ft, p.y * ft});
    Scene scene = exact::bare_scene(polygon, 155.0 * lb_ft3);
    const auto plane_stress = [](double density, double modulus, double ratio) {
        const ElasticMaterial m = plane_stress_equivalent({density, modulus, ratio});
        return Material{m.density, m.young_modulus, m.poisson_ratio};
    };
    scene.dam = plane_stress(155.0 * lb_ft3, 3.25e6 * psi, 0.2);
    scene.mesh.size = scene.mesh.contact_size = 6.0;
    if (flexible) {
        Foundation rock;
        rock.material = plane_stress(165.0 * lb_ft3, 3.25e6 * psi, 1.0 / 3.0);
        rock.mass = RockMass::with_mass;
        rock.boundary = RockBoundary::absorbing;
        rock.width = 3.0 * 314.32 * ft;
        rock.depth = 314.32 * ft;
        scene.foundation = rock;
        scene.mesh.rock_size = 20.0;
    }
    if (full) {
        Reservoir water;
        water.level = 381.0 * ft;
        water.model = ReservoirModel::acoustic;
        water.length = 400.0 * ft;
        water.bottom_reflection = 0.5;
        scene.reservoir = water;
    }
    return scene;
}

std::vector<double> pine_flat_frequencies()
{
    std::vector<double> frequencies;
    for (int k = 0; k <= 125; ++k) frequencies.push_back(1.5 + 0.02 * k);
    return frequencies;
}

/// 5 % at the period of the empty dam on a rigid base and a quarter of it.
RayleighConstants pine_flat_damping()
{
    const double first = 2.0 * pi * 3.22;
    return rayleigh_constants(0.05, first, 4.0 * first);
}

/// 1/f where the amplitude is largest, of the parabola through three points [s].
double resonant_period(const std::vector<double>& frequencies, const std::vector<double>& amplitudes)
{
    const auto peak = std::max_element(amplitudes.begin(), amplitudes.end());
    if (peak == amplitudes.begin() || peak + 1 == amplitudes.end()) return std::nan(""); // no peak within
    const double a = peak[-1], b = peak[0], c = peak[1], step = frequencies[1] - frequencies[0];
    const double at = frequencies[static_cast<std::size_t>(peak - amplitudes.begin())];
    return 1.0 / (at + 0.5 * step * (a - c) / (a - 2.0 * b + c));
}

/// Where the dam's own deformation, the coordinate of the fundamental mode, is largest as an acceleration [s].
double period_of(const Scene& scene)
{
    const Model model = build_model(scene);
    std::optional<FluidModel> water;
    if (scene.reservoir) water = build_fluid(scene);
    const RayleighConstants damping = pine_flat_damping();
    const std::vector<double> frequencies = pine_flat_frequencies();
    std::vector<TransferPoint> points;
    if (scene.foundation) {
        const RadiatingRock rock = radiating_rock_of(scene, model.mesh, model.mesh.contact.rock_nodes, 10.0, {});
        const RockBelow below{rock.rock, damping.stiffness};
        points =
            transfer_functions(model, dam_on_free_base(model, damping), water ? &*water : nullptr, frequencies, &below);
    } else {
        points =
            transfer_functions(model, structure_system(model, damping).system, water ? &*water : nullptr, frequencies);
    }
    std::vector<double> amplitudes;
    for (const TransferPoint& p : points) amplitudes.push_back(std::abs(p.deflection));
    return resonant_period(frequencies, amplitudes);
}

/// How a dam on a rigid strip deforms.
enum class Deformation {
    free,    ///< as all its elements let it
    one_mode ///< by the first mode of the dam on a rigid base alone
};

/// First mode of the dam with its base held, by inverse iteration from a uniform load: ratio of the first two frequencies
/// squared about 1/6, so 40 steps leave round-off. @returns on all unknowns of the dam, zero on the base
VectorXd first_mode_on_held_base(const LinearSystem& dam, const std::vector<char>& on_base)
{
    std::vector<Eigen::Triplet<double>> entries;
    Index size = 0;
    for (std::size_t k = 0; k < on_base.size(); ++k)
        if (!on_base[k]) entries.emplace_back(static_cast<Index>(k), size++, 1.0);
    SparseMatrix off_base(dam.size(), size);
    off_base.setFromTriplets(entries.begin(), entries.end());
    const SparseMatrix stiffness = off_base.transpose() * dam.stiffness * off_base;
    const SparseMatrix mass = off_base.transpose() * dam.mass * off_base;
    const Eigen::SimplicialLDLT<SparseMatrix> solver(stiffness);
    VectorXd shape = solver.solve(VectorXd::Ones(size));
    for (int i = 0; i < 40; ++i) shape = solver.solve(mass * shape).normalized();
    return off_base * shape;
}

/// The unknowns of a dam on a rigid strip: what deforms, and last the strip's x, y and turn about the crest.
SparseMatrix unknowns_on_strip(const Model& model, const LinearSystem& dam, const std::vector<char>& on_base,
                               const std::vector<Index>& base, const Eigen::MatrixXd& rigid, Deformation deformation)
{
    std::vector<Eigen::Triplet<double>> entries;
    Index size = 0;
    if (deformation == Deformation::free) {
        for (std::size_t k = 0; k < on_base.size(); ++k)
            if (!on_base[k]) entries.emplace_back(static_cast<Index>(k), size++, 1.0);
        for (std::size_t i = 0; i < base.size(); ++i)
            for (const Index c : {0, 1, 2}) entries.emplace_back(base[i], size + c, rigid(static_cast<Index>(i), c));
    } else {
        const VectorXd mode = first_mode_on_held_base(dam, on_base);
        for (Index k = 0; k < mode.size(); ++k) entries.emplace_back(k, 0, mode[k]);
        size = 1;
        const Point about = model.mesh.nodes[static_cast<std::size_t>(model.mesh.crest.back())];
        for (int node = 0; node < model.mesh.node_count(); ++node) {
            const Point at = model.mesh.nodes[static_cast<std::size_t>(node)];
            const int x = model.dofs(node, 0), y = model.dofs(node, 1);
            if (x != no_dof && x < dam.size()) {
                entries.emplace_back(x, size, 1.0);
                entries.emplace_back(x, size + 2, about.y - at.y);
            }
            if (y != no_dof && y < dam.size()) {
                entries.emplace_back(y, size + 1, 1.0);
                entries.emplace_back(y, size + 2, at.x - about.x);
            }
        }
    }
    SparseMatrix expand(dam.size(), size + 3);
    expand.setFromTriplets(entries.begin(), entries.end());
    return expand;
}

/// The same with a base that moves as a rigid strip, whose dynamic stiffness is that of the rock beneath it.
double period_on_strip(const Scene& scene, Deformation deformation)
{
    const Model model = build_model(scene);
    const RayleighConstants damping = pine_flat_damping();
    const RadiatingRock rock = radiating_rock_of(scene, model.mesh, model.mesh.contact.rock_nodes, 10.0, {});
    const LinearSystem dam = dam_on_free_base(model, damping);
    const std::vector<Index> base = unknowns_of_base(model);
    const int crest = model.mesh.crest.back();
    const Point about = model.mesh.nodes[static_cast<std::size_t>(crest)];

    // Rigid motions: x, y, and a turn about the crest, which leaves it where it is.
    Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(static_cast<Index>(base.size()), 3);
    std::vector<char> on_base(static_cast<std::size_t>(dam.size()), 0);
    for (std::size_t i = 0; i < model.mesh.contact.dam_nodes.size(); ++i) {
        const Point at = model.mesh.nodes[static_cast<std::size_t>(model.mesh.contact.dam_nodes[i])];
        const auto row = static_cast<Index>(2 * i);
        rigid.row(row) << 1.0, 0.0, about.y - at.y;
        rigid.row(row + 1) << 0.0, 1.0, at.x - about.x;
    }
    for (const Index k : base) on_base[static_cast<std::size_t>(k)] = 1;
    const SparseMatrix expand = unknowns_on_strip(model, dam, on_base, base, rigid, deformation);
    const Index size = expand.cols() - 3;
    const std::vector<Index> strip{size, size + 1, size + 2};
    VectorXd of_crest = expand.transpose() * VectorXd::Unit(dam.size(), model.dofs(crest, 0));
    of_crest[strip[0]] -= 1.0; // against the strip, whose turn leaves the crest where it is
    const auto reduced = [&](const SparseMatrix& m) { return SparseMatrix(expand.transpose() * m * expand); };

    const SparseMatrix mass = reduced(dam.mass), damper = reduced(dam.damping), stiffness = reduced(dam.stiffness);
    CoupledSystem system;
    system.mass = mass;
    system.damping = damper;
    system.stiffness = stiffness;
    system.structure_unknowns = size + 3;
    system.velocity_x = VectorXd::Zero(size + 3);
    if (scene.reservoir) {
        const FluidModel water = build_fluid(scene);
        const SparseMatrix coupling =
            face_coupling(model.mesh, model.dofs, water.reservoir, water.dofs, water.unknowns());
        system = couple(mass, damper, stiffness,
                        SparseMatrix(expand.transpose() * SparseMatrix(coupling.topRows(dam.size()))), water);
    }
    HarmonicSolver solver(system.mass, system.damping, system.stiffness, strip);
    const std::vector<double> frequencies = pine_flat_frequencies();
    std::vector<double> amplitudes;
    for (const double frequency : frequencies) {
        const double w = 2.0 * pi * frequency;
        const Index n = rock.rock.interface();
        const Eigen::MatrixXcd flexibility = rock.rock.response(w, damping.stiffness, Eigen::MatrixXd::Identity(n, n));
        const Eigen::MatrixXcd turned = rigid.cast<Complex>();
        if (!solver.factorise(w, turned.transpose() * flexibility.partialPivLu().solve(turned))) return std::nan("");
        Eigen::VectorXcd load = system.velocity_x.cast<Complex>() / Complex(0.0, w);
        load.head(size + 3) -= expand.transpose() * model.inertia_x.head(dam.size());
        const Eigen::VectorXcd z = solver.solve(load);
        amplitudes.push_back(w * w * std::abs((of_crest.cast<Complex>().array() * z.head(size + 3).array()).sum()));
    }
    return resonant_period(frequencies, amplitudes);
}

/// On rock in plane strain, stiffer than the plane stress that the source has.
Scene on_rock_in_plane_strain(Scene scene)
{
    scene.foundation->material = {165.0 * lb_ft3, 3.25e6 * psi, 1.0 / 3.0};
    return scene;
}

/// Beside the published periods those of a dam that is held more and more: each is at most the one before.
std::vector<Check> pine_flat_periods()
{
    const double rigid_base = 1.4 * 400.0 / std::sqrt(3.25e6), with_water = 1.246, on_rock = 1.187;
    std::vector<Check> checks;
    for (const bool full : {false, true}) {
        const std::string state = full ? "period, full, " : "period, empty, ";
        const double theirs = full ? rigid_base * with_water : rigid_base;
        const double elastic = period_of(pine_flat(true, full));
        const double strip = period_on_strip(pine_flat(true, full), Deformation::free);
        checks.push_back({state + "rigid base", "s", theirs, period_of(pine_flat(false, full)), 0.04});
        checks.push_back({state + "rigid strip on rock", "s", theirs * on_rock, strip, 0.04});
        checks.push_back({state + "elastic base on rock", "s", theirs * on_rock, elastic, 0.08});
        checks.push_back({state + "strip at most elastic base", "s", elastic, strip, 0.0, Measure::upper_bound});
        checks.push_back({state + "one mode at most all elements on a strip", "s", strip,
                          period_on_strip(pine_flat(true, full), Deformation::one_mode), 0.0, Measure::upper_bound});
        checks.push_back({state + "rock in plane strain at most in plane stress", "s", elastic,
                          period_of(on_rock_in_plane_strain(pine_flat(true, full))), 0.0, Measure::upper_bound});
    }
    return checks;
}

} // namespace

void add_fe_radiating_tied_cases(Registry& registry)
{
    registry.push_back(
        {"fe2d.rock.radiating-tied",
         "A dam tied to radiating rock, shaken in time: the reduced rock beside all unknowns of its box, and "
         "beside large boxes with dashpots alone.",
         "the whole box by the same steps; boxes of the scene's rock (boundary = \"viscous\")",
         "the reduction's gate is 2 % of single frequencies and typically 0.5 %: 0.5 % of the crest; "
         "dashpots alone converge slowly: from one box to the next of twice the size the crest still "
         "changes by a tenth, and the radiating rock has to lie nearer to the larger one than the smaller does",
         boxes});
    registry.push_back(
        {"fe2d.rock.radiating-transfer",
         "Transfer functions on radiating rock are the Fourier quotients of a run in time after a blow.",
         "two solvers: L U of the dam with the inverse of the rock's flexibility on its base, and time steps",
         "average acceleration stretches periods by (omega dt)^2/12, 3e-4 at 9 Hz and 1 ms, a resonance with 10 % of "
         "damping shows it five times: 0.2 %",
         transfer_of_a_blow});
    registry.push_back({"fe2d.rock.radiating-energy",
                        "Tied runs on radiating rock: with a record of zeros nothing moves, and energy closes, what "
                        "the rock takes included.",
                        "statics on fixed edges; every term of the energy from the states",
                        "round-off of displacements of some cm over 500 steps; of sums over 600 steps",
                        rest_and_energy});
    registry.push_back(
        {"fe2d.rock.radiating-pine-flat",
         "Pine Flat dam, plane stress: periods where the crest resonates, empty and full, on a rigid base and on "
         "radiating rock of the same modulus.",
         "Fenves & Chopra, UCB/EERC-85/10 (1986): T = 1.4 H/sqrt(E) (ft, psi) = 0.311 s, x 1.246 with water, "
         "x 1.187 on rock with E_f = E_s, both 0.46 s",
         "standard values of a standard section, rounded: 4 %; they are held against a dam on a rigid strip. A base "
         "that bends with the rock is softer: 8 %. What holds the dam more makes it stiffer (Rayleigh): one mode on a "
         "strip, all "
         "elements on it, a base that bends. Water to 381 ft, alpha 0.5; rock 165 lb/ft^3, nu = 1/3",
         pine_flat_periods});
}

} // namespace damslip::verification
