#include "verification/hard/hard_scenes.hpp"

#include "scene/rock_mass.hpp"
#include "verification/cases/fe_run_scenes.hpp"

#include <cmath>

#include <fmt/format.h>

namespace damslip::hard {

namespace {

/// The reference dam at friction 0.70 without curtain, on a rigid base.
Scene dam_on_rigid_base()
{
    Scene scene = soft_dam(0.70);
    scene.curtain.reset();
    scene.foundation.reset();
    return scene;
}

/// The same on massless rock. @param young_modulus  [Pa]
Scene dam_on_rock(double young_modulus)
{
    Scene scene = soft_dam(0.70);
    scene.curtain.reset();
    scene.foundation->material.young_modulus = young_modulus;
    return scene;
}

GroundMotion shaking()
{
    return fe2d::test::sines(2.0, 5.0);
}

/// Goes on by itself though it would stand: a status without slip and verdict.
HardResult walks(const Scene& scene)
{
    const fe2d::RunResult run = fe_run(scene, shaking());
    HardResult result = result_of(run);
    result.value_a = run.run_out.sliding_factor;
    result.value_b = scene.contact.friction / friction_that_holds(scene);
    result.tolerance = 1e-9 * result.value_b;
    if (reported(run.status, run.slip)) result.status += ", with a slip";
    if (judge(run.status, run.slip, 0.0, 1e-3) != Verdict::none) result.status += ", with a verdict";
    if (!(run.run_out.thrust_over_friction >= 1.0))
        result.status += fmt::format(", thrust does {:g} of the friction's work", run.run_out.thrust_over_friction);
    return result;
}

HardResult rests(const Scene& scene)
{
    Scene radiating = with_radiating_rock(scene), wider = radiating;
    wider.foundation->wave_box = 1.4;
    const fe2d::RunResult other = fe_run(wider, shaking());
    return compared(fe_run(radiating, shaking()), other, 0.02 * std::abs(other.slip));
}

} // namespace

void add_self_excited_cases(HardCases& cases)
{
    const auto walking = [&](const char* id, const char* why, std::function<HardResult()> run) {
        cases.push_back({.id = id,
                         .why = why,
                         .quantity = "factor of safety at rest",
                         .unit = "-",
                         .method_a = "FE, at the end of a walk without slip and verdict",
                         .method_b = "rigid block, friction over that which holds",
                         .tolerance = "1e-9: both sum the same loads",
                         .expected_status = word(Status::self_excited),
                         .run = std::move(run)});
    };
    const auto resting = [&](const char* id, const char* why, std::function<HardResult()> run) {
        cases.push_back({.id = id,
                         .why = why,
                         .method_a = "FE, automatic box of waves",
                         .method_b = "FE, box of waves 1.4 times as large",
                         .tolerance = "2 % of the slip: what the edges of the box may decide",
                         .run = std::move(run)});
    };
    walking("hard.self-excited.rigid-base",
            "no wave leaves: with the ground at rest the dam goes on by its thrust, though it would stand",
            [] { return walks(dam_on_rigid_base()); });
    walking("hard.self-excited.stiff-massless-rock",
            "rock of 60 GPa that gives way but keeps every wave: the walk comes from the rock's model alone",
            [] { return walks(dam_on_rock(60e9)); });
    resting("hard.self-excited.radiating-rock", "the dam that walks on a rigid base, on rock of 30 GPa that radiates",
            [] { return rests(dam_on_rock(30e9)); });
    resting("hard.self-excited.stiff-radiating-rock",
            "the dam that walks on stiff massless rock, on the same rock with its mass",
            [] { return rests(dam_on_rock(60e9)); });
}

} // namespace damslip::hard
