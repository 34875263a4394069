#include "verification/cases/modules.hpp"

#include "fe2d/model/model.hpp"
#include "fe2d/time/central_difference.hpp"
#include "fe2d/time/modal_run.hpp"
#include "scene/rock_mass.hpp"
#include "verification/cases/direct_input.hpp"
#include "verification/cases/fe_run_scenes.hpp"
#include "verification/exact/free_field.hpp"
#include "verification/exact/reference_scene.hpp"

#include <Eigen/SparseLU>

#include <cmath>
#include <complex>
#include <numbers>

namespace damslip::verification {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double box_density = 2600.0;

/// A triangle of 20 m on a box of rock with mass, 60 m wide and 40 m deep; square elements of `size` far from the base.
Scene small_dam_on_rock(double size, RockBoundary boundary)
{
    Scene scene = exact::bare_scene(exact::triangle(20.0, 25.0));
    scene.dam.young_modulus = 25e9;
    scene.foundation = Foundation{.material = {box_density, 5e9, 0.25},
                                  .mass = RockMass::with_mass,
                                  .boundary = boundary,
                                  .width = 60.0,
                                  .depth = 40.0};
    scene.mesh.size = scene.mesh.contact_size = scene.mesh.rock_size = size;
    return scene;
}

fe2d::Model rock_model(const Scene& scene, fe2d::Base base)
{
    fe2d::ModelOptions options;
    options.base = base;
    if (rock_edges_are_viscous(scene)) options.edges = fe2d::RockEdges::free;
    return fe2d::build_model(scene, options);
}

struct RockBoxRun {
    double surface_error = 0.0; ///< largest |u - u_g| of the surface over the amplitude
    double unevenness = 0.0;    ///< largest difference of two surface nodes over the amplitude
    double left_behind = 0.0;   ///< largest |u̇| of any node once the pulse has left, over the largest of the surface
    double arrival = 0.0; ///< of the largest displacement half way down, on the way up, before that of the surface [s]
};

/// The pulse goes up through rock alone, turns at the surface and leaves through the bottom.
RockBoxRun box_run(double size, double dt, int component)
{
    const fe2d::Model model = rock_model(small_dam_on_rock(size, RockBoundary::viscous), fe2d::Base::separate);
    const exact::SurfacePulse pulse{0.01, 0.3, 0.04}, none{0.0, 0.3, 0.04};
    const DirectInput input(model, component == 0 ? pulse : none, component == 1 ? pulse : none);
    const RockAlone rock(model);
    fe2d::LinearIntegrator integrator(rock.system, fe2d::average_acceleration());
    const Index n = rock.system.size();
    const auto part = [&](double time) { return VectorXd(input.load(time).tail(n)); };
    const VectorXd still = VectorXd::Zero(n);
    fe2d::State before = integrator.start(still, still, part(0.0)), after;
    const auto& step = integrator.step_operator(dt);
    std::vector<Index> surface;
    for (const fe2d::NodeChain* chain : {&model.mesh.floor, &model.mesh.ground})
        for (const int node : *chain) surface.push_back(model.dofs(node, component) - rock.first);
    RockBoxRun result;
    const double end = 0.8, left = 0.6; // u_g(0.6 s) is 4e-25 of the pulse
    double largest = 0.0, fastest = 0.0;
    for (int k = 1; k * dt <= end + 1e-9; ++k) {
        const double time = k * dt;
        const VectorXd load = part(time);
        integrator.finish_step(step, before, load, integrator.free_step(step, before, load), after);
        std::swap(before, after);
        const double wanted = pulse.displacement(time), first = before.displacement[surface.front()];
        for (const Index i : surface) {
            result.surface_error = std::max(result.surface_error, std::abs(before.displacement[i] - wanted));
            result.unevenness = std::max(result.unevenness, std::abs(before.displacement[i] - first));
            fastest = std::max(fastest, std::abs(before.velocity[i]));
        }
        if (time > left) largest = std::max(largest, before.velocity.cwiseAbs().maxCoeff());
    }
    result.surface_error /= pulse.amplitude;
    result.unevenness /= pulse.amplitude;
    result.left_behind = largest / fastest;
    return result;
}

std::vector<Check> free_field_of_box()
{
    std::vector<Check> checks;
    for (const int component : {0, 1}) {
        const std::string wave = component == 0 ? "shear wave" : "compression wave";
        const RockBoxRun coarse = box_run(5.0, 0.004, component), fine = box_run(2.5, 0.002, component);
        checks.push_back({wave + ": surface against the record, 2.5 m elements", "-", 0.01, fine.surface_error, 0.0,
                          Measure::upper_bound});
        checks.push_back({wave + ": order of that error", "-", 2.0,
                          std::log2(coarse.surface_error / fine.surface_error), 0.2, Measure::absolute});
        checks.push_back({wave + ": difference of surface nodes", "-", 0.0, fine.unevenness, 1e-3, Measure::absolute});
        checks.push_back({wave + ": velocity left behind by the wave that has left", "-", 0.0, fine.left_behind, 1e-5,
                          Measure::absolute});
    }
    return checks;
}

/// Crest displacement relative to the free surface, of the direct method and in motion relative to the free field.
struct TwoWays {
    double difference = 0.0; ///< largest, over the largest of either
};

TwoWays two_ways(double size, double dt)
{
    Scene scene = small_dam_on_rock(size, RockBoundary::viscous);
    scene.dam.young_modulus = 2.5e9;
    const fe2d::Model model = rock_model(scene, fe2d::Base::tied);
    const exact::SurfacePulse h{0.01, 0.3, 0.05}, v{0.005, 0.32, 0.06};
    const auto steps = static_cast<int>(std::lround(0.9 / dt));
    GroundMotion motion;
    motion.dt = dt;
    for (int k = 0; k <= steps; ++k) {
        motion.accel_h.push_back(-h.acceleration(k * dt)); // positive upstream
        motion.accel_v.push_back(v.acceleration(k * dt));
    }
    fe2d::TiedRunOptions options;
    options.scheme = fe2d::average_acceleration();
    options.start_displacement = VectorXd::Zero(model.dofs.count);
    const fe2d::History relative = fe2d::integrate(model, motion, options);

    const DirectInput input(model, h, v);
    fe2d::LinearIntegrator integrator(fe2d::LinearSystem{model.mass, model.edge_damping, model.stiffness, {}},
                                      options.scheme);
    const VectorXd still = VectorXd::Zero(model.dofs.count);
    fe2d::State before = integrator.start(still, still, input.load(0.0)), after;
    const auto& step = integrator.step_operator(dt);
    const int crest = model.mesh.crest.back();
    double difference = 0.0, largest = 0.0;
    for (int k = 1; k <= steps; ++k) {
        const VectorXd load = input.load(k * dt);
        integrator.finish_step(step, before, load, integrator.free_step(step, before, load), after);
        std::swap(before, after);
        const fe2d::HistoryRow& row = relative.rows[static_cast<std::size_t>(k)];
        const double x = before.displacement[model.dofs(crest, 0)] - h.displacement(k * dt),
                     y = before.displacement[model.dofs(crest, 1)] - v.displacement(k * dt);
        difference = std::max(difference, std::hypot(x - row.crest_x, y - row.crest_y));
        largest = std::max(largest, std::hypot(row.crest_x, row.crest_y));
    }
    return {difference / largest};
}

std::vector<Check> direct_method_of_rock()
{
    const TwoWays coarse = two_ways(2.5, 0.002), fine = two_ways(1.25, 0.001);
    return {
        {"crest, largest difference of the two over the largest displacement, 1.25 m elements", "-", 0.0,
         fine.difference, 1e-3, Measure::absolute},
        {"order of that difference", "-", 2.0, std::log2(coarse.difference / fine.difference), 0.3, Measure::absolute}};
}

/// Dashpot of a rigid strip that rests on the rock between heel and toe, Im(force)/ω over its high-frequency limit.
double strip_dashpot(const fe2d::Model& model, int component, double omega)
{
    using Complex = std::complex<double>;
    using Matrix = Eigen::SparseMatrix<Complex>;
    const RockAlone rock(model);
    const Index n = rock.system.size();
    const Matrix dynamic = rock.system.stiffness.cast<Complex>() - omega * omega * rock.system.mass.cast<Complex>() +
                           Complex(0.0, omega) * rock.system.damping.cast<Complex>();
    std::vector<char> held(static_cast<std::size_t>(n), 0);
    Eigen::VectorXcd moved = Eigen::VectorXcd::Zero(n);
    for (const int node : model.mesh.contact.rock_nodes)
        for (const int c : {0, 1}) {
            const Index dof = model.dofs(node, c) - rock.first;
            held[static_cast<std::size_t>(dof)] = 1;
            moved[dof] = c == component ? 1.0 : 0.0;
        }
    Eigen::VectorXcd right = -(dynamic * moved);
    std::vector<Eigen::Triplet<Complex>> entries;
    for (Index column = 0; column < n; ++column)
        for (Matrix::InnerIterator it(dynamic, column); it; ++it)
            if (!held[static_cast<std::size_t>(it.row())] && !held[static_cast<std::size_t>(column)])
                entries.emplace_back(it.row(), column, it.value());
    for (Index k = 0; k < n; ++k)
        if (held[static_cast<std::size_t>(k)]) {
            entries.emplace_back(k, k, 1.0);
            right[k] = moved[k];
        }
    Matrix inner(n, n);
    inner.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SparseLU<Matrix> factor(inner);
    const Eigen::VectorXcd u = factor.solve(right);
    const Complex force = (moved.transpose() * (dynamic * u))(0);
    const fe2d::ElasticWaves c = fe2d::elastic_waves(model.materials.rock);
    return force.imag() / omega / (box_density * (component == 0 ? c.s : c.p) * model.mesh.contact.distance.back());
}

std::vector<Check> strip_on_rock()
{
    const fe2d::Model model = rock_model(small_dam_on_rock(1.0, RockBoundary::viscous), fe2d::Base::separate);
    const double omega = 6.0 * fe2d::elastic_waves(model.materials.rock).s / (0.5 * model.mesh.contact.distance.back());
    return {{"swaying strip, a0 = 6: dashpot over rho c_s 2b", "-", 1.0, strip_dashpot(model, 0, omega), 0.02,
             Measure::relative},
            {"heaving strip, a0 = 6: dashpot over rho c_p 2b", "-", 1.0, strip_dashpot(model, 1, omega), 0.02,
             Measure::relative}};
}

/// The reference dam on coarse elements with rock of the given density; no damping of its own beyond Rayleigh's.
Scene reference_on_rock(double rock_density, RockBoundary boundary, double width = 300.0, double depth = 100.0)
{
    Scene scene = fe2d::test::sliding_dam(0.77);
    scene.curtain.reset(); // the free field is that of homogeneous rock
    Foundation& rock = *scene.foundation;
    rock.material.density = rock_density;
    rock.mass = rock_density > 0.0 ? RockMass::with_mass : RockMass::massless;
    rock.boundary = boundary;
    rock.width = width;
    rock.depth = depth;
    scene.mesh.rock_size = 12.5;
    return scene;
}

struct DamOnRock {
    double slip = 0.0, crest = 0.0, imbalance = 0.0, radiated = 0.0, damping = 0.0;
};

DamOnRock slide_on_rock(Scene scene, const GroundMotion& motion)
{
    fe2d::RunOptions options = fe2d::test::options_of(scene);
    scene.time.substeps = 0;
    const fe2d::RunResult r = fe2d::EarthquakeRun(scene, options).run(motion);
    DamOnRock result{r.slip, 0.0, r.energy_error, r.history.energy.back().radiated, r.history.energy.back().damping};
    for (const double x : r.history.crest_x) result.crest = std::max(result.crest, std::abs(x));
    return result;
}

std::vector<Check> ground_at_rest_on_rock()
{
    std::vector<Check> checks;
    GroundMotion motion = fe2d::test::sines(1.0, 5.0);
    for (std::vector<double>* a : {&motion.accel_h, &motion.accel_v}) std::fill(a->begin(), a->end(), 0.0);
    for (const RockBoundary boundary : {RockBoundary::fixed, RockBoundary::viscous}) {
        const DamOnRock r = slide_on_rock(reference_on_rock(2650.0, boundary), motion);
        const std::string edges = boundary == RockBoundary::fixed ? "fixed edges" : "viscous edges";
        checks.push_back({edges + ": slip", "m", 0.0, r.slip, 1e-14, Measure::absolute});
        checks.push_back({edges + ": crest", "m", 0.0, r.crest, 1e-12, Measure::absolute});
    }
    return checks;
}

std::vector<Check> massless_limit_of_rock()
{
    const GroundMotion motion = fe2d::test::sines(1.0, 10.0);
    const DamOnRock none = slide_on_rock(reference_on_rock(0.0, RockBoundary::fixed), motion),
                    little = slide_on_rock(reference_on_rock(2.65, RockBoundary::fixed), motion),
                    less = slide_on_rock(reference_on_rock(0.265, RockBoundary::fixed), motion);
    return {{"slip over that on massless rock, a ten-thousandth of the density", "-", 1.0, less.slip / none.slip, 1e-3,
             Measure::relative},
            {"crest over that on massless rock, a ten-thousandth of the density", "-", 1.0, less.crest / none.crest,
             1e-3, Measure::relative},
            {"slip over that on massless rock, a thousandth of the density", "-", 1.0, little.slip / none.slip, 1e-3,
             Measure::relative}};
}

std::vector<Check> size_of_the_box()
{
    const GroundMotion motion = fe2d::test::sines(1.0, 6.0);
    const auto in_box = [&](RockBoundary boundary, double width, double depth) {
        return slide_on_rock(reference_on_rock(2650.0, boundary, width, depth), motion);
    };
    const DamOnRock small = in_box(RockBoundary::viscous, 300.0, 100.0),
                    wide = in_box(RockBoundary::viscous, 600.0, 100.0),
                    deep = in_box(RockBoundary::viscous, 600.0, 200.0),
                    deepest = in_box(RockBoundary::viscous, 600.0, 400.0),
                    stiff = in_box(RockBoundary::fixed, 300.0, 100.0),
                    stiff_deep = in_box(RockBoundary::fixed, 600.0, 200.0);
    double imbalance = 0.0;
    for (const DamOnRock& r : {small, wide, deep, deepest, stiff, stiff_deep})
        imbalance = std::max(imbalance, r.imbalance);
    return {
        {"viscous: slip, 600 x 100 m over 300 x 100 m", "-", 1.0, wide.slip / small.slip, 0.03, Measure::relative},
        {"viscous: crest, 600 x 100 m over 300 x 100 m", "-", 1.0, wide.crest / small.crest, 0.03, Measure::relative},
        {"viscous: slip, 600 x 200 m over 600 x 100 m", "-", 1.0, deep.slip / wide.slip, 0.15, Measure::relative},
        {"viscous: slip, 600 x 400 m over 600 x 200 m", "-", 1.0, deepest.slip / deep.slip, 0.03, Measure::relative},
        {"fixed: slip, 600 x 200 m over 300 x 100 m", "-", 2.0, stiff_deep.slip / stiff.slip, 0.0,
         Measure::lower_bound},
        {"viscous: energy radiated over that damped", "-", 0.1, small.radiated / small.damping, 0.0,
         Measure::lower_bound},
        {"energy that does not close, largest of all runs", "-", 1e-10, imbalance, 0.0, Measure::upper_bound}};
}

/// Largest difference of the crest's motion over its largest.
double crest_difference(const fe2d::History& a, const fe2d::History& b)
{
    double difference = a.rows.size() == b.rows.size() ? 0.0 : std::nan(""), largest = 0.0;
    for (std::size_t k = 0; k < std::min(a.rows.size(), b.rows.size()); ++k) {
        difference = std::max(difference, std::abs(a.rows[k].crest_x - b.rows[k].crest_x));
        largest = std::max(largest, std::abs(b.rows[k].crest_x));
    }
    return difference / largest;
}

std::vector<Check> schemes_on_rock()
{
    fe2d::ModelOptions lumped;
    lumped.mass = fe2d::MassKind::lumped;
    const fe2d::Model model = fe2d::build_model(small_dam_on_rock(4.0, RockBoundary::fixed), lumped);
    const GroundMotion motion = fe2d::test::sines(1.0, 4.0);
    fe2d::TiedRunOptions options;
    options.damping.constants = {1.5, 2e-4};
    options.scheme = fe2d::average_acceleration();
    const auto stepped = [&](double dt) {
        fe2d::TiedRunOptions o = options;
        o.dt = dt;
        o.keep_every = static_cast<int>(std::lround(motion.dt / dt));
        return fe2d::integrate(model, motion, o);
    };
    const fe2d::History modal = fe2d::integrate_modal(model, motion, options, {.modes = 96}),
                        coarse = stepped(motion.dt / 16.0), fine = stepped(motion.dt / 32.0),
                        central = fe2d::integrate_explicit(model, motion, options);
    return {{"crest, average acceleration beside 96 modes", "-", 0.0, crest_difference(fine, modal), 1e-3,
             Measure::absolute},
            {"order of that difference in the step", "-", 2.0,
             std::log2(crest_difference(coarse, modal) / crest_difference(fine, modal)), 0.3, Measure::absolute},
            {"crest, central difference beside 96 modes", "-", 0.0, crest_difference(central, modal), 1e-3,
             Measure::absolute}};
}

} // namespace

void add_fe_rock_cases(Registry& registry)
{
    registry.push_back(
        {"fe2d.rock.free-field",
         "A pulse that the direct method brings into a box of rock comes up, moves the surface as the record says, the "
         "same all "
         "along, and leaves through the dashpots.",
         "d'Alembert's solution of the wave in a half space; Lysmer & Kuhlemeyer (1969)",
         "second order in element and step, 1 % wanted; the wave that has left leaves 1e-5 of itself at most: it meets "
         "the "
         "dashpots at a right angle, what is left is what the lumps of the sides scatter",
         free_field_of_box});
    registry.push_back(
        {"fe2d.rock.direct-method",
         "Motion relative to the free field and the direct method give the same motion of a dam tied to its rock.",
         "effective forces of the incoming wave and of free-field columns on the edges: Zienkiewicz, Bicanic & Shen "
         "(1989); "
         "Løkke & Chopra (2017)",
         "the direct method's waves have the error of the mesh, the other's have none: second order, and 0.1 % with "
         "1.25 m",
         direct_method_of_rock});
    registry.push_back({"fe2d.rock.strip",
                        "A rigid strip on rock with viscous edges, shaken fast, sends plane waves down: its dashpots "
                        "are rho c_s and rho c_p "
                        "times its width.",
                        "high-frequency limit of the strip's radiation damping, Gazetas & Dobry (1984); half width b, "
                        "a0 = omega b/c_s",
                        "edge waves take and give a few per cent around the limit at a0 = 6: 2 %", strip_on_rock});
    registry.push_back(
        {"fe2d.rock.ground-at-rest",
         "With a record of zeros nothing moves on rock with mass: the reactions of the edges go on as loads.",
         "statics on fixed edges",
         "round-off of displacements of some cm, 1e-17 m a step, over 500 steps; slips stay to the last bit",
         ground_at_rest_on_rock});
    registry.push_back({"fe2d.rock.massless-limit",
                        "As the density of rock on fixed edges goes to zero, slip and crest motion become those of "
                        "condensed massless rock.",
                        "CondensedBody: two structures and factors of their own",
                        "the rock's inertia is proportional to the density: a thousandth of 2650 kg/m3 is below a "
                        "thousandth of the dam's",
                        massless_limit_of_rock});
    registry.push_back(
        {"fe2d.rock.schemes",
         "A dam tied to rock with mass on fixed edges moves the same by average acceleration, by "
         "superposition of modes and by central differences; Rayleigh's mass damping acts on the dam alone.",
         "exact in time: superposition of 96 modes, coupled by damping; three solvers of their own",
         "second order in the step of the implicit scheme; modes left out follow statically: 0.1 %", schemes_on_rock});
    registry.push_back(
        {"fe2d.rock.size-of-the-box",
         "The reference dam slides the same in boxes of different size with viscous edges, not with "
         "fixed ones; energy closes, what "
         "leaves the box included.",
         "the box twice as large",
         "width: 3 %; depth: dashpots below a box that is shallow beside the waves (620 m at 3.5 Hz) lack the deeper "
         "rock's "
         "stiffness, 15 % at 100 m and 3 % at 200 m cover it; fixed edges resonate: a factor of two at least",
         size_of_the_box});
}

} // namespace damslip::verification
