// Scenes that cannot be meshed, and the exact words their users read.
#include "core/input_error.hpp"
#include "fe2d/assembly/assemble.hpp"
#include "fe2d/mesh/build_mesh.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;

Scene meshable()
{
    Scene scene;
    scene.file = "dam.toml";
    scene.section.polygon = {{0, 0}, {45, 0}, {12, 51.5}, {12, 62.5}, {0, 62.5}};
    scene.dam = {2500.0, 25e9, 0.17};
    scene.foundation =
        Foundation{.material = {0.0, 30e9, 0.2}, .mass = RockMass::massless, .width = 300.0, .depth = 100.0};
    scene.curtain = Curtain{.distance = 7.0, .depth = 30.0, .thickness = 1.0, .young_modulus = 27e9};
    return scene;
}

std::string mesh_message(const Scene& scene)
{
    try {
        fe2d::build_mesh(scene);
    } catch (const InputError& error) {
        return error.what();
    }
    return "(meshed)";
}

TEST(FeMeshInput, the_scene_itself_is_fine)
{
    EXPECT_EQ(mesh_message(meshable()), "(meshed)");
}

TEST(FeMeshInput, a_horizontal_step_names_its_vertices)
{
    Scene scene = meshable();
    scene.section.polygon = {{0, 0}, {45, 0}, {20, 40}, {12, 40}, {12, 62.5}, {0, 62.5}};
    EXPECT_EQ(mesh_message(scene),
              "dam.toml: error: section.polygon: the downstream face does not rise between vertex 3 (20, 40) and "
              "vertex 4 (12, 40).\n"
              "  expected: both faces rising from the base to the crest\n"
              "  fix:      give a step a slope, for example 1 mm of rise, or mesh the section with an imported mesh");
}

TEST(FeMeshInput, clockwise_section)
{
    Scene scene = meshable();
    scene.section.polygon = {{0, 0}, {0, 62.5}, {12, 62.5}, {12, 51.5}, {45, 0}};
    EXPECT_NE(mesh_message(scene).find("section.polygon is not counter-clockwise."), std::string::npos)
        << mesh_message(scene);
}

TEST(FeMeshInput, sections_without_two_faces)
{
    Scene scene = meshable();
    scene.section.polygon = {{0, 0}, {45, 0}};
    EXPECT_NE(mesh_message(scene).find("section.polygon has 2 vertices."), std::string::npos) << mesh_message(scene);
    scene.section.polygon = {{0, 0}, {45, 50}, {12, 40}}; // the toe is the highest point
    EXPECT_NE(mesh_message(scene).find("vertex 2 (45, 50) is heel or toe and the highest point."), std::string::npos)
        << mesh_message(scene);
}

TEST(FeMeshInput, a_lift_joint_above_the_crest)
{
    Scene scene = meshable();
    LiftJoint joint;
    joint.elevation = 62.5;
    scene.lift_joints.push_back(joint);
    const std::string text = mesh_message(scene);
    EXPECT_NE(text.find("lift_joint.elevation_m = 62.5 is not between base and crest on both faces."),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("above 0 m and below 62.5 m"), std::string::npos) << text;
}

TEST(FeMeshInput, crossing_faces_are_refused_with_the_place)
{
    Scene scene = meshable();
    scene.section.polygon = {{0, 0}, {45, 0}, {-2, 30}, {12, 51.5}, {12, 62.5}, {0, 62.5}};
    const std::string text = mesh_message(scene);
    EXPECT_NE(text.find("section.polygon cannot be meshed: the element at ("), std::string::npos) << text;
    EXPECT_NE(text.find("m in the dam is"), std::string::npos) << text;
    EXPECT_NE(text.find("look at vertices"), std::string::npos) << text;
}

TEST(FeMeshInput, box_too_small_for_base_or_curtain)
{
    Scene scene = meshable();
    scene.foundation->width = 46.0;
    EXPECT_EQ(mesh_message(scene), "dam.toml: error: foundation.width_m = 46 is too small.\n"
                                   "  expected: at least 49.5 m: base, sliding path on both sides and one element\n"
                                   "  fix:      use about 5 base lengths or more");
    scene = meshable();
    scene.foundation->depth = 25.0;
    EXPECT_EQ(mesh_message(scene), "dam.toml: error: curtain.depth_m = 30 does not end inside the foundation.\n"
                                   "  expected: more than 0 and less than 25 m (foundation.depth_m = 25)\n"
                                   "  fix:      make the foundation deeper");
    scene = meshable();
    scene.curtain->distance = 44.5;
    EXPECT_EQ(mesh_message(scene),
              "dam.toml: error: curtain.distance_m = 44.5 with curtain.thickness_m = 1 is not below the base.\n"
              "  expected: distance + thickness within the base of 45 m\n"
              "  fix:      move the curtain between heel and toe");
}

TEST(FeMeshInput, finite_elements_need_a_modulus)
{
    Scene scene = meshable();
    scene.foundation->material.young_modulus.reset();
    try {
        fe2d::materials_of(scene);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(), "dam.toml: error: foundation.young_modulus is missing.\n"
                                   "  expected: a number > 0; finite elements need it (concrete: 20 to 35 GPa)\n"
                                   "  fix:      add  young_modulus_GPa = ...  to [foundation]");
    }
}

} // namespace
