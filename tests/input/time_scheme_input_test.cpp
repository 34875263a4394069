// What central difference and superposition of modes refuse, each with the reason and a way out.
#include "core/input_error.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "fe2d/time/central_difference.hpp"
#include "fe2d/time/modal_run.hpp"
#include "scene/read.hpp"
#include "verification/exact/reference_scene.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace {

using namespace damslip;

std::string message_of(const std::function<void()>& run)
{
    try {
        run();
    } catch (const InputError& error) {
        return error.what();
    }
    return "(accepted)";
}

std::string scheme_message(const std::string& keys)
{
    return message_of([&keys] {
        parse_scene("[section]\nheight_m = 62.5\nbase_m = 45\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = "
                    "0.77\n[time]\n" +
                        keys,
                    "dam.toml", FileCheck::skip);
    });
}

bool names(const std::string& message, std::initializer_list<const char*> words)
{
    for (const char* word : words)
        if (message.find(word) == std::string::npos) return false;
    return true;
}

Scene dam_on(bool rock)
{
    Scene scene = exact::bare_scene(exact::triangle(30.0, 40.0), 2400.0);
    scene.dam.young_modulus = 2e9;
    scene.contact.friction = 0.8;
    if (rock)
        scene.foundation =
            Foundation{.material = {0.0, 4e9, 0.2}, .mass = RockMass::massless, .width = 90.0, .depth = 40.0};
    scene.mesh.size = 10.0;
    scene.mesh.contact_size = 10.0;
    scene.damping.mass_coefficient = 1.0;
    scene.damping.stiffness_coefficient = 0.0;
    return scene;
}

GroundMotion quiet()
{
    GroundMotion motion;
    motion.dt = 0.01;
    motion.accel_h.assign(5, 0.0);
    return motion;
}

std::string sliding_message(Scene scene)
{
    return message_of([&scene] { fe2d::EarthquakeRun(scene, {}).run(quiet()); });
}

TEST(TimeSchemeInput, KeysOfAnotherScheme)
{
    EXPECT_EQ(scheme_message("scheme = \"modal\"\nalpha = -0.1\n"),
              "dam.toml:10:1: error: time.alpha belongs to time.scheme = \"hht\", but the scheme is \"modal\".\n"
              "  expected: no alpha, gamma or beta\n"
              "  fix:      delete alpha or choose hht");
    EXPECT_TRUE(
        names(scheme_message("scheme = \"central-difference\"\nbeta = 0.25\n"),
              {"dam.toml:10:", "time.gamma and time.beta belong to", "\"central-difference\"", "choose newmark"}));
    EXPECT_TRUE(names(scheme_message("scheme = \"modal\"\nstepping = \"adaptive\"\n"),
                      {"dam.toml:10:", "time.stepping = \"adaptive\" with time.scheme = \"modal\"", "choose hht"}));
    EXPECT_TRUE(names(scheme_message("scheme = \"explicit\"\n"), {"\"central-difference\"", "\"modal\"", "\"auto\""}));
}

TEST(TimeSchemeInput, AlphaAloneMeansHht)
{
    const auto scheme = [](const std::string& keys) {
        return parse_scene("[section]\nheight_m = 62.5\nbase_m = 45\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction "
                           "= 0.77\n" +
                               keys,
                           "dam.toml", FileCheck::skip)
            .time.scheme;
    };
    EXPECT_EQ(scheme("[time]\nalpha = -0.1\n"), TimeScheme::hht);
    EXPECT_EQ(scheme(""), TimeScheme::automatic);
    EXPECT_EQ(scheme("[time]\nscheme = \"auto\"\nalpha = -0.1\n"), TimeScheme::automatic);
}

TEST(TimeSchemeInput, StepAboveTheLimitNamesBothNumbers)
{
    const fe2d::Model model = fe2d::build_model(dam_on(false));
    fe2d::TiedRunOptions options;
    options.dt = 0.01;
    const std::string message = message_of([&] { fe2d::integrate_explicit(model, quiet(), options); });
    EXPECT_TRUE(names(message, {"time.dt_s = 0.01 is above the limit", "at most 0.00", "highest frequency",
                                "leave dt_s out", "scheme = \"hht\""}))
        << message;
    // Stiffness damping tightens it, and the message says what the limit would be without.
    options.dt = 0.002;
    options.damping.constants = {0.0, 0.004};
    EXPECT_TRUE(names(message_of([&] { fe2d::integrate_explicit(model, quiet(), options); }),
                      {"time.dt_s = 0.002 is above", "s without stiffness damping"}));
    Scene sliding = dam_on(false);
    sliding.time.scheme = TimeScheme::central_difference;
    sliding.time.dt = 0.01;
    EXPECT_TRUE(names(sliding_message(sliding), {"time.dt_s = 0.01 is above the limit", "scheme = \"hht\""}));
    options.dt = 0.0003;
    options.damping.constants = {};
    EXPECT_TRUE(
        names(message_of([&] { fe2d::integrate_explicit(model, quiet(), options); }),
              {"time.dt_s = 0.0003 is no whole part of the record's step of 0.01 s", "leave dt_s out for 0.01 s / "}));
}

TEST(TimeSchemeInput, CentralDifferenceAndMasslessRock)
{
    // Whole, the rock is infinitely fast; condensed it is not there.
    const fe2d::Model model = fe2d::build_model(dam_on(true));
    fe2d::TiedRunOptions options;
    EXPECT_EQ(message_of([&] { fe2d::integrate_explicit(model, quiet(), options); }), "(accepted)");
    options.rock = fe2d::RockTreatment::whole;
    EXPECT_TRUE(names(message_of([&] { fe2d::integrate_explicit(model, quiet(), options); }),
                      {"unknowns without mass", "infinite", "mass = \"with-mass\"", "scheme = \"hht\""}));
    Scene sliding = dam_on(true);
    sliding.time.scheme = TimeScheme::central_difference;
    EXPECT_TRUE(names(sliding_message(sliding),
                      {"unknowns without mass", "no step is stable", "fe --base tied", "[foundation]"}));
}

TEST(TimeSchemeInput, CentralDifferenceNeedsHardContactWithoutAcousticWater)
{
    Scene scene = dam_on(false);
    scene.time.scheme = TimeScheme::central_difference;
    EXPECT_EQ(sliding_message(scene), "(accepted)");
    Scene soft = scene;
    soft.contact.enforcement = ContactEnforcement::slip_tolerance;
    EXPECT_TRUE(
        names(sliding_message(soft), {"contact that gives way", "enforcement = \"exact\"", "delete enforcement"}));
    Scene wet = scene;
    wet.reservoir.emplace();
    wet.reservoir->level = 30.0;
    wet.reservoir->length = 70.0;
    wet.reservoir->model = ReservoirModel::acoustic;
    EXPECT_TRUE(names(sliding_message(wet), {"acoustic water", "model = \"added-mass\""}));
    const fe2d::FluidModel water = fe2d::build_fluid(wet);
    const fe2d::Model model = fe2d::build_model(dam_on(false));
    fe2d::TiedRunOptions options;
    options.water = &water;
    EXPECT_TRUE(names(message_of([&] { fe2d::integrate_explicit(model, quiet(), options); }),
                      {"central-difference", "acoustic water", "scheme = \"hht\""}));
    EXPECT_TRUE(names(message_of([&] { fe2d::integrate_modal(model, quiet(), options); }),
                      {"\"modal\"", "acoustic water", "radiates", "scheme = \"hht\""}));
}

TEST(TimeSchemeInput, ModesNeedALinearModelWithRayleighDamping)
{
    Scene scene = dam_on(false);
    scene.time.scheme = TimeScheme::modal;
    EXPECT_TRUE(names(sliding_message(scene), {"\"modal\" with a base that slides", "fe --base tied", "--reduced"}));
    const fe2d::Model model = fe2d::build_model(dam_on(false));
    fe2d::TiedRunOptions options;
    options.damping.constants = {1.0, 0.0};
    options.damping.mass = MassDamping::total;
    EXPECT_TRUE(names(message_of([&] { fe2d::integrate_modal(model, quiet(), options); }),
                      {"total velocity", "not linear between samples", "scheme = \"hht\""}));
}

} // namespace
