#include "hard/hard_scenes.hpp"

#include "scene/section.hpp"
#include "verification/fe_run_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace damslip::hard {

namespace {

/// The stiff dam, dry and on stiff rock, pushed at the crest until only `share` of its base is shut.
HardResult open_base(double least_open, double most_open, double force, double pga)
{
    Scene scene = stiff_dam(0.8);
    scene.reservoir.reset();
    scene.uplift.reset();
    scene.curtain.reset();
    scene.mesh.contact_size = 1.5;
    scene.forces.push_back({"push", {0.0, 62.5}, force, 0.0});
    scene = with_friction_over(scene, 1.02);
    const GroundMotion motion = fe2d::test::sines(pga, 6.0);
    const sliding::SlideResult rigid = rigid_run(scene, motion);
    const fe2d::RunResult run = fe_run(scene, motion);
    HardResult result = compared(run, rigid.slip, fine_share * std::abs(rigid.slip) + 1e-6);
    const double open = run.stages.back().open_length / base_length(scene.section);
    if (!(open >= least_open && open <= most_open)) result.status = "open: " + std::to_string(open) + " of the base";
    return result;
}

} // namespace

void add_opening_cases(HardCases& cases)
{
    const std::string rigid = "event-located rigid block";
    cases.push_back({.id = "hard.opening.half-base",
                     .why = "half of the base is open before the shaking starts, and the tip of the opening wanders",
                     .method_a = "FE, moduli x 1e4",
                     .method_b = rigid,
                     .tolerance = "1 %: slides end at step ends; friction does not care which pairs carry N'",
                     .run = [] { return open_base(0.4, 0.6, 13.0e6, 0.6); }});
    cases.push_back({.id = "hard.opening.toe-only",
                     .why = "a few pairs at the toe carry everything",
                     .method_a = "FE, moduli x 1e4",
                     .method_b = rigid,
                     .tolerance = "1 %: as above",
                     .run = [] { return open_base(0.85, 0.99, 17.1e6, 0.3); }});
}

} // namespace damslip::hard
