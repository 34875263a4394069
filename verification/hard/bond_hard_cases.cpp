#include "verification/hard/hard_scenes.hpp"

#include "records/transform/transform.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace damslip::hard {

namespace {

/// A stiff block whose bond, a third of its strength, is as brittle as glass, and a half sine that passes that strength by
/// `share` at its peak, on one sample.
HardResult breaks_at_the_peak(double share)
{
    const double base = 8.0, density = 2400.0, width = 1e-6; // slip that breaks the bond [m]
    Scene scene = stiff_block(base, 1.0, 0.4);
    scene.contact.cohesion = 2.0 * density; // 2 m/s² of its mass
    scene.contact.bond.shear_energy = 0.5 * scene.contact.cohesion * width;
    const double strength = 0.4 * scene.gravity + 2.0, peak = (1.0 + share) * strength;
    GroundMotion motion = silence(4.0);
    for (int k = 50; k <= 130; ++k) motion.accel_h[k] = peak * std::sin(std::numbers::pi * (k - 50) / 80.0);
    return against_rigid(scene, motion, 0.02);
}

/// A brittle bond on the reference dam; without it the heel of the static state is open for 4 m.
Scene bonded_dam(double contact_size)
{
    Scene scene = soft_dam(0.6);
    scene.mesh.contact_size = contact_size;
    scene.contact.cohesion = 200e3;
    scene.contact.bond.shear_energy = 30.0;
    scene.contact.bond.tensile_strength = 100e3;
    scene.contact.bond.tension_energy = 3.0;
    return scene;
}

/// Slip of the static state, after the bond has unzipped from the heel and come to a stop.
HardResult unzips_at_the_heel()
{
    const GroundMotion still = silence(0.1);
    const fe2d::RunResult coarse = fe_run(bonded_dam(1.0), still), fine_mesh = fe_run(bonded_dam(0.5), still);
    HardResult result = result_of(coarse);
    if (coarse.status != Status::at_rest || fine_mesh.status != Status::at_rest) {
        result.status += ", with half the elements " + word(fine_mesh.status);
        return result;
    }
    result.value_a = coarse.stages.back().slip;
    result.value_b = fine_mesh.stages.back().slip;
    result.tolerance = 0.03 * std::abs(result.value_b);
    if (!(coarse.stages.back().open_length > 3.0)) result.status = "the heel holds";
    return result;
}

/// The heel opens by millimetres and shuts on its water within one step: what the water's own energy does not account for,
/// over its largest part.
HardResult shuts_within_a_step()
{
    Scene scene = soft_dam(0.7);
    scene.uplift->model = UpliftModel::linear;
    scene.uplift->points.clear();
    scene.uplift->water.opening = OpeningWater::reynolds;
    scene.uplift->water.clearance = 5e-3;
    scene = with_friction_over(scene, 2.0);
    const fe2d::RunResult run = fe_run(scene, fe2d::test::sines(2.0, 6.0), 1);
    HardResult result = compared(run, 0.0, 1e-9);
    if (!run.base_water) {
        result.status = "no water";
        return result;
    }
    const fe2d::JointFlowWork& w = run.base_water->flow;
    result.value_a = std::abs(w.imbalance()) / std::max({std::abs(w.walls), std::abs(w.ends), w.viscous, w.cavities});
    if (!(run.base_water->largest.upstream > 5.0)) result.status = "never open";
    if (run.base_water->least_pressure < scene.uplift->water.cavitation * (1.0 + 1e-12))
        result.status = "below the pressure of cavitation";
    return result;
}

/// The second record is at its full strength on its first sample.
HardResult slides_at_once()
{
    const Scene scene = stiff_dam(0.8);
    const GroundMotion first = push(2.2, 0.6, 2.0, 0.5);
    GroundMotion second = push(2.2, 0.4, 1.0, 0.0);
    second.accel_h.front() = 2.2;
    const GroundMotion both = records::one_after_the_other({first, second}, 0.0);
    const sliding::SlideResult rigid = rigid_run(scene, both);
    const fe2d::RunResult run = fe_run(scene, both);
    HardResult result = compared(run, 0.0, 0.0);
    if (rigid.events.size() != 2 || run.events.size() != 2) {
        result.status = "the second record was not run";
        return result;
    }
    result.value_a = run.events.back().change;
    result.value_b = rigid.events.back().change;
    result.tolerance = fine_share * result.value_b;
    return result;
}

} // namespace

void add_bond_cases(HardCases& cases)
{
    cases.push_back({.id = "hard.bond.breaks-at-the-peak",
                     .why = "the record passes the bond's strength by 1 % at its peak; a third of the resistance is "
                            "gone after a thousandth of a millimetre, and the dam slides",
                     .method_a = "FE, stiff block with a bond that breaks by its energy",
                     .method_b = "event-located rigid block that loses its cohesion at first slip",
                     .tolerance = "2 %: the bond breaks, and slides end, at step ends, 0.0025 s",
                     .run = [] { return breaks_at_the_peak(0.01); }});
    cases.push_back({.id = "hard.bond.snap-back",
                     .why = "a brittle bond unzips from the heel under the static load, and stops where the base is "
                            "pressed",
                     .quantity = "slip in the static state",
                     .method_a = "FE, elements of 1 m on the base",
                     .method_b = "the same, of 0.5 m",
                     .tolerance = "3 %: strength at the tip is lowered to what elements of 1 m carry, energy kept",
                     .run = unzips_at_the_heel});
    cases.push_back({.id = "hard.water.shuts-within-a-step",
                     .why =
                         "steps so long that the heel shuts on its water in one: an incompressible film takes all of "
                         "the rate, cavities close with a knock",
                     .quantity = "imbalance of the water's own energy over its largest part",
                     .unit = "-",
                     .method_a = "FE with thin flow in the joint, 0.005 s",
                     .method_b = "the flow's balance, step by step",
                     .tolerance = "1e-9: round-off of all steps",
                     .run = shuts_within_a_step});
    cases.push_back({.id = "hard.sequence.slides-at-once",
                     .why = "the second record is at its full strength on its first sample",
                     .quantity = "slip of the second record",
                     .method_a = "FE, moduli x 1e4",
                     .method_b = "event-located rigid block",
                     .tolerance = "1 %: slides end at step ends, 0.0025 s of 0.25 s",
                     .run = slides_at_once});
}

} // namespace damslip::hard
