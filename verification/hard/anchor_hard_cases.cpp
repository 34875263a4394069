#include "verification/hard/hard_scenes.hpp"

#include "verification/cases/fe_run_scenes.hpp"

#include <cmath>
#include <numbers>

namespace damslip::hard {

namespace {

/// A block whose bars yield, are slack and taut again as it slides to and fro, and snap one after the other.
Scene block_on_snapping_bars()
{
    Scene scene = stiff_block(8.0, 1.0, 0.1);
    const double weight = 8.0 * 1.0 * 2400.0 * 9.81;
    for (const double inclination : {60.0, -45.0}) {
        Anchor bar;
        bar.name = inclination > 0.0 ? "upstream bars" : "downstream bars";
        bar.distance = inclination > 0.0 ? 2.5 : 5.5;
        bar.inclination = inclination * std::numbers::pi / 180.0;
        bar.free_length = 2.0;
        bar.yield_strength = 500e6;
        bar.area = 0.04 * weight / bar.yield_strength;
        bar.prestress = 0.015 * weight;
        bar.rupture_strain = 0.02;
        scene.anchors.push_back(bar);
    }
    return scene;
}

HardResult snapping_bars(bool time_of_rupture)
{
    const Scene scene = block_on_snapping_bars();
    GroundMotion motion = fe2d::test::sines(10.0, 6.0);
    motion.accel_v.clear();
    const sliding::SlideResult rigid = rigid_run(scene, motion);
    const fe2d::RunResult fe = fe_run(scene, motion, 4);
    HardResult result = compared(fe, rigid.slip, 0.02 * rigid.max_slip);
    if (!time_of_rupture) return result;
    const double never = -1.0;
    result.value_a = fe.anchors.front().history.snapped_at.value_or(never);
    result.value_b = rigid.anchors.front().history.snapped_at.value_or(2.0 * never);
    result.tolerance = 0.01;
    return result;
}

} // namespace

void add_anchor_cases(HardCases& cases)
{
    const std::string why =
        "forces vanish at once, in the middle of a slide; before that bars yield, slacken and tighten";
    cases.push_back({.id = "hard.anchor.snaps",
                     .why = why,
                     .method_a = "FE, stiff block",
                     .method_b = "event-located rigid block",
                     .tolerance = "2 % of the largest slip: slides end, and bars snap, at step ends, 0.0006 s",
                     .run = [] { return snapping_bars(false); }});
    cases.push_back({.id = "hard.anchor.snaps-when",
                     .why = why,
                     .quantity = "time at which the upstream bars snap",
                     .unit = "s",
                     .method_a = "FE, stiff block",
                     .method_b = "event-located rigid block",
                     .tolerance = "one sample: the strain follows the slip, whose error is that of the slip",
                     .run = [] { return snapping_bars(true); }});
}

} // namespace damslip::hard
