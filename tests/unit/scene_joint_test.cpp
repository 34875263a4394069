// Contact laws, sub-steps and presets in scenes.
#include "scene/read.hpp"
#include "scene/write.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;

Scene joint_scene(const std::string& contact, const std::string& more = {})
{
    return parse_scene("[section]\nheight_m = 62.5\nbase_m = 45\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = "
                       "0.77\n" +
                           contact + more,
                       "dam.toml", FileCheck::skip);
}

TEST(SceneJoint, ExactContactThatOpensIsTheDefault)
{
    const Scene scene = joint_scene("");
    EXPECT_EQ(scene.contact.enforcement, ContactEnforcement::exact);
    EXPECT_EQ(scene.contact.separation, JointOpening::allowed);
    EXPECT_FALSE(scene.contact.tangential_stiffness);
    EXPECT_FALSE(scene.time.substeps);
    EXPECT_EQ(scene.time.slip_tolerance, 0.01);
}

TEST(SceneJoint, LawsAndSubstepsAreRead)
{
    const Scene penalty = joint_scene(
        "separation = \"none\"\nenforcement = \"penalty\"\ntangential_stiffness_GN_m3 = 100\n[time]\nsubsteps = 2\n");
    EXPECT_EQ(penalty.contact.separation, JointOpening::none);
    EXPECT_EQ(penalty.contact.enforcement, ContactEnforcement::penalty);
    EXPECT_EQ(penalty.contact.tangential_stiffness, 1e11);
    EXPECT_EQ(penalty.time.substeps, 2);
    const Scene elastic =
        joint_scene("enforcement = \"slip-tolerance\"\nslip_tolerance = 0.0005\n[time]\nslip_tolerance = 0.001\n");
    EXPECT_EQ(elastic.contact.slip_tolerance, 0.0005);
    EXPECT_EQ(elastic.time.slip_tolerance, 0.001);
}

TEST(SceneJoint, PresetSetsWhatTheFileDoesNot)
{
    const std::string preset = "[analysis]\npreset = \"goldgruber-2015\"\n";
    const Scene scene = joint_scene("", preset);
    EXPECT_EQ(scene.contact.enforcement, ContactEnforcement::slip_tolerance);
    EXPECT_EQ(scene.contact.slip_tolerance, 0.005);
    EXPECT_EQ(scene.contact.separation, JointOpening::none);
    EXPECT_EQ(scene.damping.mass, MassDamping::relative);
    EXPECT_EQ(scene.time.scheme, TimeScheme::hht);
    EXPECT_EQ(scene.time.alpha, -1.0 / 3.0);
    EXPECT_EQ(scene.time.dt, 0.01);
    EXPECT_EQ(scene.time.substeps, 0);

    const std::string rock = "[foundation]\nyoung_modulus_GPa = 30\n";
    const Scene on_rock = joint_scene("", rock + preset);
    EXPECT_EQ(on_rock.foundation->mass, RockMass::massless);
    EXPECT_EQ(on_rock.foundation->boundary, RockBoundary::fixed);
    const Scene heavy =
        joint_scene("", rock + "density_kg_m3 = 2650\nmass = \"with-mass\"\nboundary = \"viscous\"\n" + preset);
    EXPECT_EQ(heavy.foundation->mass, RockMass::with_mass);
    EXPECT_EQ(heavy.foundation->boundary, RockBoundary::viscous);

    const Scene own = joint_scene("enforcement = \"exact\"\nseparation = \"allowed\"\n",
                                  "[time]\nalpha = -0.1\ndt_s = 0.002\nslip_tolerance = 0.02\n[damping]\nmass = "
                                  "\"total\"\n" +
                                      preset);
    EXPECT_EQ(own.contact.enforcement, ContactEnforcement::exact);
    EXPECT_EQ(own.contact.separation, JointOpening::allowed);
    EXPECT_EQ(own.damping.mass, MassDamping::total);
    EXPECT_EQ(own.time.alpha, -0.1);
    EXPECT_EQ(own.time.dt, 0.002);
    EXPECT_FALSE(own.time.substeps);
}

TEST(SceneJoint, ResolvedScenesReadBack)
{
    for (const std::string& text :
         {std::string("[analysis]\npreset = \"goldgruber-2015\"\n"), std::string("[time]\nsubsteps = 3\n"),
          std::string("enforcement = \"penalty\"\ntangential_stiffness_N_m3 = 2e8\n"),
          std::string("enforcement = \"slip-tolerance\"\nslip_tolerance = 0.0005\n")}) {
        const Scene first = joint_scene(text);
        const std::string resolved = resolved_toml(first);
        const Scene second = parse_scene(resolved, "dam.toml", FileCheck::skip);
        EXPECT_EQ(resolved_toml(second), resolved);
        EXPECT_EQ(second.time.alpha, first.time.alpha);
        EXPECT_EQ(second.time.substeps, first.time.substeps);
        EXPECT_EQ(second.contact.slip_tolerance, first.contact.slip_tolerance);
        EXPECT_EQ(second.contact.tangential_stiffness, first.contact.tangential_stiffness);
    }
    const std::string preset = resolved_toml(joint_scene("[analysis]\npreset = \"goldgruber-2015\"\n"));
    for (const char* line : {"separation = \"none\"", "enforcement = \"slip-tolerance\"", "slip_tolerance = 0.005",
                             "substeps = 0", "dt_s = 0.01", "mass = \"relative\""})
        EXPECT_NE(preset.find(line), std::string::npos) << line;
}

} // namespace
