#include "verification/cases/modules.hpp"

#include "fe2d/run/earthquake_run.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/equilibrium/base_state.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <cmath>
#include <numbers>

namespace damslip::verification {

namespace {

using Eigen::Index;
using Eigen::VectorXd;
using fe2d::EarthquakeRun;
using fe2d::RunOptions;
using fe2d::RunResult;
using std::numbers::pi;

/// Slip of the dam with all moduli times 1e4 beside the rigid block's, both polarities.
std::vector<Check> rigid_limit(fe2d::RayleighConstants damping)
{
    std::vector<Check> checks;
    const GroundMotion motion = fe2d::test::sines(1.0);
    for (const double friction : {0.77, 0.70, 0.66}) {
        Scene scene = fe2d::test::sliding_dam(friction, 1e4, 3.0);
        RunOptions options = fe2d::test::options_of(scene);
        scene.time.substeps = 3; // 0.00125 s
        options.damping = damping;
        const EarthquakeRun run(scene, options);
        for (const bool flip : {false, true}) {
            const GroundMotion ground = flip ? fe2d::test::flipped(motion) : motion;
            const RunResult result = run.run(ground);
            const double rigid = sliding::slide(ground, sliding::make_rigid_block(scene)).slip;
            checks.push_back({"slip, mu = " + std::to_string(friction).substr(0, 4) + (flip ? ", flipped" : ""), "m",
                              rigid, result.slip, 0.01, Measure::relative});
            checks.push_back({"unresolved steps", "-", 0.5, static_cast<double>(result.counts.unresolved), 0.0,
                              Measure::upper_bound});
            checks.push_back({"complementarity residual over N'", "-", 1e-8, result.counts.largest_residual, 0.0,
                              Measure::upper_bound});
        }
    }
    return checks;
}

/// A rectangular block of the given base and height on a rigid plane, heel at the origin.
Scene block_scene(double base, double height, double friction, double inclination = 0.0)
{
    const double c = std::cos(inclination), s = std::sin(inclination);
    Scene scene = exact::bare_scene(
        {{0, 0}, {base * c, -base * s}, {base * c + height * s, -base * s + height * c}, {height * s, height * c}},
        2400.0);
    scene.dam.young_modulus = 30e9;
    scene.dam.poisson_ratio = 0.0;
    scene.contact.friction = friction;
    scene.mesh.size = base / 6.0;
    scene.mesh.contact_size = base / 8.0;
    scene.damping.method = DampingMethod::none;
    return scene;
}

std::vector<Check> patch()
{
    const Scene scene = block_scene(8.0, 4.0, 0.5);
    const EarthquakeRun run(scene, {});
    fe2d::StaticContact statics(run.structure());
    fe2d::Strength strength(scene.contact, run.structure().plane());
    fe2d::ContactMemory memory(run.structure().plane().pairs());
    run.statics(statics, strength, memory);
    const Index m = run.structure().plane().pairs();
    const VectorXd normal = memory.force.head(m).cwiseQuotient(run.structure().plane().area);
    const VectorXd shear = memory.force.tail(m).cwiseQuotient(run.structure().plane().area);
    const double pressure = 2400.0 * 9.81 * 4.0;
    return {
        {"largest pressure", "Pa", pressure, normal.maxCoeff(), 1e-12, Measure::relative},
        {"smallest pressure", "Pa", pressure, normal.minCoeff(), 1e-12, Measure::relative},
        {"largest shear over pressure", "-", 1e-12, shear.cwiseAbs().maxCoeff() / pressure, 0.0, Measure::upper_bound}};
}

std::vector<Check> incline()
{
    std::vector<Check> checks;
    for (const double degrees : {-8.0, 8.0, 15.0}) {
        Scene scene = block_scene(8.0, 1.0, 0.5, degrees * pi / 180.0);
        scene.dam.young_modulus = 30e12;
        RunOptions options;
        scene.time.substeps = 2;
        GroundMotion pulse = fe2d::test::sines(6.0, 6.0, 9);
        const RunResult result = EarthquakeRun(scene, options).run(pulse);
        const sliding::SlideResult rigid = sliding::slide(pulse, sliding::make_rigid_block(scene));
        checks.push_back({"slip, dip " + std::to_string(static_cast<int>(degrees)) + " deg", "m", rigid.slip,
                          result.slip, 0.01, Measure::relative});
    }
    return checks;
}

std::vector<Check> energy_and_creep()
{
    Scene scene = fe2d::test::sliding_dam(0.70);
    RunOptions options = fe2d::test::options_of(scene);
    scene.time.substeps = 0;
    const RunResult result = EarthquakeRun(scene, options).run(fe2d::test::sines(1.0));
    const fe2d::Energy& e = result.history.energy.back();
    GroundMotion rest = fe2d::test::sines(1.0, 100.0, 5, 0.1);
    for (auto* a : {&rest.accel_h, &rest.accel_v}) std::fill(a->begin(), a->end(), 0.0);
    Contact contact = scene.contact;
    contact.friction = result.stages.back().critical_friction / 0.95;
    const RunResult still = EarthquakeRun(scene, options).run(rest, contact);
    return {{"energy imbalance over the input", "-", 1e-10, result.energy_error, 0.0, Measure::upper_bound},
            {"friction + damping + numerical + strain change", "J/m", e.external + e.contact_normal,
             e.friction + e.damping + e.numerical + e.kinetic + e.strain - result.history.energy.front().strain, 1e-10,
             Measure::relative},
            {"slip in 100 s at 95 % of the static limit", "m", 1e-12, still.max_slip, 0.0, Measure::upper_bound}};
}

} // namespace

void add_fe_contact_cases(Registry& registry)
{
    registry.push_back({"fe.contact.patch", "A block on a rigid plane presses uniformly.",
                        "linear elasticity, nu = 0: p = rho g H everywhere, no shear",
                        "exact for linear displacement and lumped edge areas: round-off", patch});
    registry.push_back(
        {"fe.contact.rigid-limit-undamped",
         "The dam with moduli times 1e4 slides as the rigid block, vertical motion and uplift included.",
         "event-located rigid block, Newmark (1965), Goldgruber (2015) eq. (4-1), (4-3)",
         "1 %: friction switches at step ends, first order in the step of 0.00125 s; slips from 2 mm to 0.5 m",
         [] { return rigid_limit({}); }});
    registry.push_back({"fe.contact.rigid-limit-damped",
                        "Damping of the deformation only does not brake the sliding: 5 % damping, same slip.",
                        "event-located rigid block", "1 %, as undamped", [] {
                            return rigid_limit(fe2d::rayleigh_constants(0.05, 2.0 * pi * 360.0, 2.0 * pi * 1500.0));
                        }});
    registry.push_back({"fe.contact.incline", "A stiff block on an inclined plane slides as the rigid block.",
                        "event-located rigid block, base inclined", "1 %: first order in the step of 0.0025 s",
                        incline});
    registry.push_back({"fe.contact.energy-and-creep",
                        "The energy of a sliding dam closes, and a dam at rest below its limit does not creep.",
                        "balance of energy; Coulomb's law",
                        "1e-10 of the input: round-off of 2000 steps; sticking pairs keep their slip exactly",
                        energy_and_creep});
}

} // namespace damslip::verification
