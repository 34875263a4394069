#include "verification/hard/hard_scenes.hpp"

#include "fe2d/modes/modes_and_damping.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <cmath>
#include <numbers>

namespace damslip::hard {

namespace {

using fe2d::test::sines;

/// The stiff dam with other levels, against the rigid block.
HardResult levels(double upstream, double tailwater)
{
    Scene scene = stiff_dam(0.7);
    scene.reservoir->level = upstream;
    scene.uplift->model = UpliftModel::linear;
    scene.uplift->points.clear();
    if (tailwater > 0.0) scene.tailwater = Tailwater{tailwater};
    return against_rigid(with_friction_over(scene, 1.1), sines(1.0, 6.0));
}

HardResult empty()
{
    Scene none = soft_dam(0.3), empty = none;
    none.reservoir.reset();
    none.uplift.reset();
    empty.reservoir->level = 0.0;
    empty.uplift->model = UpliftModel::linear;
    empty.uplift->points.clear();
    const GroundMotion motion = sines(2.0, 6.0);
    const fe2d::RunResult limit = fe_run(none, motion);
    return compared(fe_run(empty, motion), limit, 1e-12 * limit.max_slip);
}

HardResult curtain(double distance, double ratio)
{
    Scene scene = stiff_dam(0.7);
    scene.curtain->distance = distance;
    scene.uplift->model = UpliftModel::curtain;
    scene.uplift->points.clear();
    scene.uplift->curtain_ratio = ratio;
    return against_rigid(with_friction_over(scene, 1.1), sines(1.0, 6.0));
}

Scene acoustic_dam()
{
    Scene scene = soft_dam(0.7);
    scene.reservoir->model = ReservoirModel::acoustic;
    scene.reservoir->length = 62.5;
    scene.reservoir->far_end = FarEnd::absorbing;
    scene.reservoir->mesh_size = 6.25;
    return scene;
}

/// c/4h made equal to the dam's first frequency: the same water in a channel of one and of two depths before its end.
HardResult resonance()
{
    Scene scene = acoustic_dam(), dry = scene;
    dry.reservoir.reset();
    const double first = fe2d::natural_modes(fe2d::build_model(dry), 1).frequency[0];
    const double speed = 4.0 * scene.reservoir->level * first;
    scene.reservoir->bulk_modulus = scene.reservoir->density * speed * speed;
    scene.reservoir->bottom_motion = BottomMotion::still;
    Scene longer = scene;
    longer.reservoir->length = 125.0;
    const GroundMotion motion = sines(1.0, 6.0);
    const fe2d::RunResult limit = fe_run(longer, motion, 1);
    return compared(fe_run(scene, motion, 1), limit, 0.02 * limit.max_slip);
}

HardResult soft_bottom()
{
    Scene scene = acoustic_dam(), nearly = scene;
    scene.reservoir->bottom_reflection = -1.0;
    nearly.reservoir->bottom_reflection = -1.0 + 1e-6;
    const GroundMotion motion = sines(1.0, 6.0);
    const fe2d::RunResult limit = fe_run(nearly, motion, 1);
    return compared(fe_run(scene, motion, 1), limit, 1e-3 * limit.max_slip);
}

/// The heel opens by millimetres and shuts on the water that has run in; a film of 0.2 mm is a hundred times stiffer than the
/// dam. Steps of 0.0025 s against halves of them.
HardResult full_joint()
{
    Scene scene = soft_dam(0.7);
    scene.uplift->model = UpliftModel::linear;
    scene.uplift->points.clear();
    scene.uplift->water.opening = OpeningWater::reynolds;
    scene.uplift->water.clearance = 5e-3;
    scene = with_friction_over(scene, 2.0);
    const GroundMotion motion = sines(2.0, 6.0);
    const fe2d::RunResult finer = fe_run(scene, motion, fine + 3), run = fe_run(scene, motion, fine + 2);
    HardResult result = compared(run, finer, 0.05 * finer.max_slip);
    if (!run.base_water || !(run.base_water->largest.upstream > 5.0)) result.status = "never open";
    return result;
}

} // namespace

void add_water_cases(HardCases& cases)
{
    const std::string rigid = "event-located rigid block", fe = "FE, moduli x 1e4";
    const std::string step = "1 %: slides end at step ends, 0.0025 s of 0.25 s";
    cases.push_back({.id = "hard.water.empty",
                     .why = "a reservoir with nothing in it: loads, added mass and uplift of zero length",
                     .method_a = "FE, level 0",
                     .method_b = "FE, no reservoir",
                     .tolerance = "1e-12: round-off, static stages of water and uplift without any load come first",
                     .run = empty});
    cases.push_back({.id = "hard.water.overtopped",
                     .why = "water 2.5 m above the crest: pressure does not start at zero on the face",
                     .method_a = fe,
                     .method_b = rigid,
                     .tolerance = step,
                     .run = [] { return levels(65.0, 0.0); }});
    cases.push_back({.id = "hard.water.tailwater-above-upstream",
                     .why = "the dam is pushed and slides upstream; uplift falls from toe to heel",
                     .method_a = fe,
                     .method_b = rigid,
                     .tolerance = step,
                     .run = [] { return levels(10.0, 45.0); }});
    const std::string why = "uplift jumps where the curtain is: ";
    cases.push_back({.id = "hard.water.curtain-at-heel",
                     .why = why + "at the first pair",
                     .method_a = fe,
                     .method_b = rigid,
                     .tolerance = step,
                     .run = [] { return curtain(0.0, 1.0 / 3.0); }});
    cases.push_back({.id = "hard.water.curtain-at-toe",
                     .why = why + "at the last pair",
                     .method_a = fe,
                     .method_b = rigid,
                     .tolerance = step,
                     .run = [] { return curtain(44.0, 1.0 / 3.0); }});
    cases.push_back({.id = "hard.water.curtain-ratio-zero",
                     .why = why + "to nothing behind it",
                     .method_a = fe,
                     .method_b = rigid,
                     .tolerance = step,
                     .run = [] { return curtain(7.0, 0.0); }});
    cases.push_back({.id = "hard.water.curtain-ratio-one",
                     .why = why + "not at all, full pressure behind it",
                     .method_a = fe,
                     .method_b = rigid,
                     .tolerance = step,
                     .run = [] { return curtain(7.0, 1.0); }});
    cases.push_back({.id = "hard.water.resonance",
                     .why = "the reservoir's first frequency is the dam's: only radiation limits the pressure",
                     .method_a = "FE, acoustic water of one depth",
                     .method_b = "FE, acoustic water of two depths",
                     .tolerance = "2 %: what an absorbing end sends back near the cut-off frequency, where it is worst",
                     .run = resonance});
    cases.push_back({.id = "hard.water.reflection-minus-one",
                     .why = "alpha_bottom = -1: the bottom's admittance is infinite",
                     .method_a = "FE, -1",
                     .method_b = "FE, -1 + 1e-6",
                     .tolerance = "1e-3: the admittance of 2e6 leaves pressures of 1e-6 of the rigid bottom's",
                     .run = soft_bottom});
    cases.push_back({.id = "hard.water.joint-full",
                     .why = "the heel opens, fills and shuts: water in 5 mm is far stiffer than the dam, and cavities "
                            "close with a knock",
                     .method_a = "FE with thin flow in the joint, 0.000625 s",
                     .method_b = "the same, 0.0003125 s",
                     .tolerance = "5 %: first order in the step, as the flow takes w³ at its start",
                     .run = full_joint});
}

} // namespace damslip::hard
