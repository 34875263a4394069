#include "verification/hard/hard_scenes.hpp"

#include "fe2d/mesh/build_mesh.hpp"
#include "fe2d/mesh/faces.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace damslip::hard {

namespace {

using fe2d::test::sines;

HardResult rigid_rock()
{
    Scene on_rock = soft_dam(0.75), on_plane;
    on_rock.curtain.reset();
    on_plane = on_rock;
    on_rock.foundation->material.young_modulus = 1e6 * *on_rock.dam.young_modulus;
    on_plane.foundation.reset();
    const GroundMotion motion = sines(1.0, 6.0);
    const fe2d::RunResult plane = fe_run(on_plane, motion);
    return compared(fe_run(on_rock, motion), plane, 1e-4 * plane.max_slip);
}

HardResult rigid_concrete()
{
    const auto dam = [](double contrast) {
        Scene scene = soft_dam(0.2);
        scene.reservoir.reset(); // under a thrust, a dam that rings on rock without radiation walks on for ever
        scene.uplift.reset();
        scene.dam.young_modulus = contrast * *scene.foundation->material.young_modulus;
        scene.damping.second_mode = 3; // the three on the rock's give: the fourth is 1e3 times faster
        return scene;
    };
    const GroundMotion motion = sines(3.0, 6.0);
    const fe2d::RunResult limit = fe_run(dam(1e4), motion);
    return compared(fe_run(dam(1e6), motion), limit, 1e-3 * limit.max_slip);
}

HardResult soft_curtain()
{
    Scene with = stiff_dam(0.7);
    with.curtain->young_modulus = 1e-6 * *with.foundation->material.young_modulus;
    return against_rigid(with, sines(1.0, 6.0));
}

/// A curtain 1 mm thick: one pair's share of the base, and a column of the rock down to 30 m, are 1 mm wide.
HardResult thin_curtain()
{
    Scene scene = stiff_dam(0.7);
    scene.curtain->thickness = 1e-3;
    scene.mesh.contact_size = 5.0;
    scene.mesh.growth = 2.0;
    scene.mesh.size = 20.0;
    scene.foundation->depth = 160.0;
    const fe2d::MeshQuality quality = fe2d::measure_quality(fe2d::build_mesh(scene));
    HardResult result = against_rigid(scene, sines(1.0, 6.0));
    if (!(quality.smallest_edge < 1.001e-3 && quality.largest_edge > 20.0))
        result.status = fmt::format("edges of {:g} to {:g} m", quality.smallest_edge, quality.largest_edge);
    return result;
}

HardResult skewed()
{
    Scene scene = stiff_dam(0.7);
    scene.curtain.reset();
    scene.section.polygon = {{0, 0}, {60, 0}, {72, 40}, {74, 62.5}, {66, 62.5}, {50, 40}};
    scene.reservoir->level = 10.0;
    scene.uplift.reset();
    const fe2d::MeshQuality quality = fe2d::measure_quality(fe2d::build_mesh(scene));
    HardResult result = against_rigid(with_friction_over(scene, 1.1), sines(1.0, 6.0));
    const double degrees = quality.smallest_angle * 180.0 / std::numbers::pi;
    if (degrees > 40.0) result.status = fmt::format("smallest angle {:.1f} degrees", degrees);
    return result;
}

HardResult incompressible_rock()
{
    const auto dam = [](double poisson_ratio) {
        Scene scene = soft_dam(0.7);
        scene.curtain->poisson_ratio = poisson_ratio;
        scene.foundation->material.poisson_ratio = poisson_ratio;
        return scene;
    };
    const GroundMotion motion = sines(1.0, 6.0);
    const fe2d::RunResult limit = fe_run(dam(0.49999), motion);
    return compared(fe_run(dam(0.499), motion), limit, 0.025 * limit.max_slip);
}

} // namespace

void add_stiffness_cases(HardCases& cases)
{
    const std::string step = "1 %: slides end at step ends, 0.0025 s of 0.25 s";
    cases.push_back(
        {.id = "hard.stiffness.rock-a-million-times-stiffer",
         .why = "contrast 1e6 in one matrix; the dam's nodes hit almost rigid ground",
         .method_a = "FE, rock of 1e6 times the dam's modulus",
         .method_b = "FE on a rigid base",
         .tolerance = "1e-4 of the largest slip: give of the rock 1e-6, times the pairs that switch a step later",
         .run = rigid_rock});
    cases.push_back(
        {.id = "hard.stiffness.dam-a-million-times-stiffer",
         .why = "contrast 1e6 the other way: the dam's own give is lost in round-off of the rock's",
         .method_a = "FE, dam of 1e6 times the rock's modulus",
         .method_b = "FE, dam of 1e4 times the rock's modulus",
         .tolerance =
             "1e-3 of the largest slip: give of the dam 1e-4, times the pairs that switch a step later; energy to "
             "1e-7: round-off of a stiffness 1e6 times that of the forces",
         .energy_closure = 1e-7,
         .run = rigid_concrete});
    cases.push_back({.id = "hard.stiffness.soft-curtain",
                     .why = "a column of the rock a million times softer than its neighbours carries part of the base",
                     .method_a = "FE, moduli x 1e4 but for the curtain",
                     .method_b = "event-located rigid block",
                     .tolerance = step,
                     .run = soft_curtain});
    cases.push_back(
        {.id = "hard.mesh.one-millimetre-and-twenty-metres",
         .why = "sizes 1 to 2e4 in one mesh: areas of the pairs and stiffnesses of their rows differ as much",
         .method_a = "FE, moduli x 1e4, curtain of 1 mm",
         .method_b = "event-located rigid block",
         .tolerance = step,
         .run = thin_curtain});
    cases.push_back({.id = "hard.mesh.skewed",
                     .why = "a section that leans downstream: sheared elements everywhere, N' near the toe",
                     .method_a = "FE, moduli x 1e4",
                     .method_b = "event-located rigid block",
                     .tolerance = step,
                     .run = skewed});
    cases.push_back({.id = "hard.stiffness.incompressible-rock",
                     .why = "Poisson's ratio 0.499: elements that lock would turn rock to steel",
                     .method_a = "FE, 0.499",
                     .method_b = "FE, 0.49999",
                     .tolerance =
                         "2.5 %: the slip changes in proportion to 1 - 2 nu, the rock's give in volume: 0.02 (nu = "
                         "0.49) takes 8 % of it, "
                         "0.002 a tenth, and the step 1 %; elements that lock would have 500 times the stiffness",
                     .run = incompressible_rock});
}

} // namespace damslip::hard
