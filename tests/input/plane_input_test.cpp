// Lifts and seams that cannot be: where they lie, and what they lack.
#include "core/input_error.hpp"
#include "scene/planes.hpp"
#include "scene/read.hpp"
#include "scene/scene_text.hpp"
#include "scene/write.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;

const std::string plane_dam = "[section]\nheight_m = 60\nbase_m = 45\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = 0.77\n";
const std::string plane_rock = "[foundation]\nyoung_modulus_GPa = 20\ndensity_kg_m3 = 2650\n";

Scene plane_scene(const std::string& more)
{
    return parse_scene(plane_dam + more, "dam.toml", FileCheck::skip);
}

std::string plane_message(const std::string& more)
{
    try {
        plane_scene(more);
    } catch (const InputError& error) {
        return error.what();
    }
    return "(accepted)";
}

std::string lifts_message(const std::string& keys)
{
    return plane_message("[lifts]\nfriction = 0.8\n" + keys);
}

std::string seam_message(const std::string& keys)
{
    return plane_message(plane_rock + "[[seam]]\nfriction = 0.5\n" + keys);
}

bool says(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

TEST(PlaneInput, LiftsByModesNeedADamAndARecord)
{
    const std::string said = lifts_message("spacing_m = 3\namplification = \"modes\"\n");
    EXPECT_TRUE(says(said, "without dam.young_modulus_GPa")) << said;
    EXPECT_TRUE(says(said, "without a record")) << said;
    EXPECT_TRUE(says(lifts_message("spacing_m = 3\namplification = \"modes\"\nexponent = 2\n"),
                     "a key of lifts.amplification = \"power\" is given"));
}

TEST(PlaneInput, LiftsLieInsideTheSection)
{
    EXPECT_EQ(lifts_message("elevations_m = [3, 61]\n"),
              "dam.toml:10:1: error: lifts.elevations_m: 61 m at place 2 is outside the section.\n"
              "  expected: above the base at 0 m and below the crest at 60 m\n"
              "  fix:      move the lift, or delete it");
    EXPECT_TRUE(says(lifts_message("elevations_m = [0]\n"), "lifts.elevations_m: 0 m at place 1 is outside"));
    EXPECT_TRUE(says(lifts_message("elevations_m = [6, 3]\n"), "has 3 at place 2, not above 6."));
    EXPECT_TRUE(says(lifts_message("spacing_m = 3\nto_m = 70\n"), "lifts.to_m = 70 is outside the section."));
    EXPECT_TRUE(says(lifts_message("spacing_m = 80\n"), "lifts.spacing_m = 80 leaves no lift inside the section."));
    EXPECT_TRUE(says(lifts_message("spacing_mm = 3\n"), "makes 20000 lifts."));
    EXPECT_TRUE(says(lifts_message("elevations_m = 3\n"), "a list of numbers [a, b, ...]"));
    EXPECT_EQ(lifts_message("spacing_m = 3\n"), "(accepted)");
}

TEST(PlaneInput, LiftsSayWhereTheyAreOnce)
{
    EXPECT_EQ(lifts_message(""),
              "dam.toml:8:1: error: [lifts] has neither spacing_m nor elevations_m.\n"
              "  expected: one of the two\n"
              "  fix:      add  spacing_m = 3  to [lifts]");
    EXPECT_TRUE(says(lifts_message("spacing_m = 3\nelevations_m = [3]\n"), "spacing_m and lifts.elevations_m are both given."));
    EXPECT_TRUE(says(plane_message("[lifts]\nspacing_m = 3\n"), "lifts.friction is missing."));
}

TEST(PlaneInput, BondedLiftsHaveBothStrengths)
{
    EXPECT_EQ(lifts_message("spacing_m = 3\nbond = \"bonded\"\ncohesion_kPa = 500\n"),
              "dam.toml:11:1: error: lifts.bond = \"bonded\" with lifts.cohesion_kPa = 500 and lifts.tensile_strength_kPa "
              "= 0.\n"
              "  expected: both above 0 for bonded lifts\n"
              "  fix:      add  tensile_strength_kPa = 500  to [lifts], or write  bond = \"jointed\"");
    EXPECT_TRUE(says(lifts_message("spacing_m = 3\ncohesion_MPa = 0.5\n"), "lifts.cohesion_kPa = 500 with lifts.bond = \"jointed\""));
    EXPECT_EQ(lifts_message("spacing_m = 3\nbond = \"bonded\"\ncohesion_kPa = 500\ntensile_strength_kPa = 400\n"), "(accepted)");
}

TEST(PlaneInput, LiftWaterAndAmplificationHaveTheirKeys)
{
    EXPECT_TRUE(says(lifts_message("spacing_m = 3\nuplift = \"drains\"\n"), "fix:      add  drains_distance_m = 3  to [lifts]"));
    EXPECT_TRUE(says(lifts_message("spacing_m = 3\ndrains_distance_m = 3\n"), "lifts.uplift is not \"drains\""));
    EXPECT_TRUE(says(lifts_message("spacing_m = 3\namplification = \"power\"\n"), "without lifts.crest_amplification"));
    EXPECT_TRUE(says(lifts_message("spacing_m = 3\namplification = \"points\"\n"), "without lifts.amplification_points_m"));
    EXPECT_TRUE(says(lifts_message("spacing_m = 3\namplification = \"points\"\namplification_points_m = [[0, 1], [0, 2]]\n"),
                    "has the height 0 at place 2."));
}

TEST(PlaneInput, SeamNeedsRockThatWeighs)
{
    EXPECT_EQ(plane_message("[[seam]]\nfriction = 0.5\ndepth_m = 8\nexit = \"free-face\"\n"),
              "dam.toml:8:1: error: seam[1] needs the weight of the rock above it, but foundation.density_kg_m3 is not "
              "there.\n"
              "  expected: the density of saturated rock: 1900 ... 3100 kg/m3 is usual\n"
              "  fix:      add  [foundation]  with young_modulus_GPa = 20  and  density_kg_m3 = 2650");
    EXPECT_TRUE(says(plane_message("[foundation]\nyoung_modulus_GPa = 20\n[[seam]]\nfriction = 0.5\ndepth_m = 8\nexit = \"free-face\"\n"),
                    "fix:      add  density_kg_m3 = 2650  to [foundation]"));
}

TEST(PlaneInput, SeamHasOnePath)
{
    EXPECT_TRUE(says(seam_message(""), "seam[1] has neither points_m nor depth_m."));
    EXPECT_TRUE(says(seam_message("depth_m = 8\npoints_m = [[0, -8], [45, -8]]\n"), "seam[1].points_m and seam[1].depth_m are both given."));
    EXPECT_TRUE(says(seam_message("points_m = [[0, -8], [0, -9]]\n"), "has x = 0 at place 2, not downstream of 0."));
    EXPECT_TRUE(says(seam_message("points_m = [[0, -8], [30, -8]]\n"), "ends at x = 30, under the dam."));
    EXPECT_TRUE(says(seam_message("points_m = [[-3, -8], [45, -8]]\n"), "comes down at x = 0."));
    EXPECT_TRUE(says(seam_message("heel = \"floor\"\npoints_m = [[-20, -1], [45, -8]]\n"), "the reservoir floor is at 0 m there."));
}

TEST(PlaneInput, SeamLiesBelowBaseAndGround)
{
    EXPECT_EQ(seam_message("points_m = [[0, -8], [40, 2], [60, 2]]\nexit = \"free-face\"\n"),
              "dam.toml:13:1: error: seam[1] lies above the base at (40, 2): that is at 0 m there.\n"
              "  expected: a path below the base\n"
              "  fix:      lower the point");
    EXPECT_TRUE(says(seam_message("points_m = [[0, -8], [60, 2]]\n"), "lies above the ground at (60, 2): that is at 0 m there."));
}

TEST(PlaneInput, SeamDoesNotCutTheDam)
{
    EXPECT_EQ(seam_message("points_m = [[0, -8], [20, -8], [60, 0]]\n"),
              "dam.toml:13:1: error: seam[1] bends under the dam, at (20, -8): with interface.angle_deg = 90 the face up "
              "from there meets the base 20 m from the heel and cuts the dam in two.\n"
              "  expected: a bend beyond the toe at 45 m, or a face that leaves the dam whole: interface.angle_deg of at "
              "most 17.7447\n"
              "  fix:      write  angle_deg = 17.7  in [seam.interface], or straighten the seam under the dam");
    EXPECT_EQ(seam_message("points_m = [[0, -8], [20, -8], [60, 0]]\n[seam.interface]\nangle_deg = 17.7\n"), "(accepted)");
    EXPECT_TRUE(says(seam_message("depth_m = 8\n[seam.wedge]\nfriction_deg = 40\nangle_deg = 25\n[seam.interface]\nangle_deg = 120\n"),
                    "bends under the dam, at (45, -8)"));
}

TEST(PlaneInput, SeamHasAnExit)
{
    EXPECT_EQ(seam_message("depth_m = 8\n"),
              "dam.toml:11:1: error: seam[1] ends in the rock without exit, at (45, -8): the ground is 8 m above it.\n"
              "  expected: a path that comes to the ground, a wedge that it pushes up, or a face that holds nothing\n"
              "  fix:      add  [seam.wedge]  with its friction, write  exit = \"free-face\" , or extend points_m to the ground");
    EXPECT_EQ(seam_message("depth_m = 8\nexit = \"free-face\"\n"), "(accepted)");
    EXPECT_EQ(seam_message("depth_m = 8\ndip_deg = -5\n"), "(accepted)"); // it rises to the ground, 46 m below the toe
    EXPECT_TRUE(says(seam_message("depth_m = 8\nexit = \"wedge\"\n"), "seam[1].exit = \"wedge\" without [seam.wedge]."));
    EXPECT_TRUE(says(seam_message("depth_m = 8\nexit = \"free-face\"\n[seam.wedge]\nfriction = 0.8\n"),
                    "seam[1].exit = \"free-face\" with [seam.wedge]."));
}

TEST(PlaneInput, WedgeIsBelowItsLock)
{
    EXPECT_EQ(seam_message("depth_m = 8\n[seam.wedge]\nfriction_deg = 40\nangle_deg = 40\n[seam.interface]\nmodel = \"friction\"\nfriction_deg = 20\n"),
              "dam.toml:16:1: error: seam[1].wedge.angle_deg = 40 is beyond the lock: with friction angles of 40 (wedge) and "
              "20 (interface) degrees a wedge of 30 degrees or more cannot be pushed up.\n"
              "  expected: an angle below 30 deg\n"
              "  fix:      write an angle below 30 deg, or less friction");
    const std::string wedge = "depth_m = 8\n[seam.wedge]\nfriction_deg = 40\n";
    EXPECT_TRUE(says(seam_message(wedge + "search_deg = [50, 60]\n"), "is beyond the lock"));
    EXPECT_TRUE(says(seam_message(wedge + "search_deg = [30, 20]\n"), "two angles between 0 and 90, the smaller first"));
    EXPECT_TRUE(says(seam_message(wedge + "search_deg = [30]\n"), "a list of two numbers [a, b]"));
    EXPECT_TRUE(says(seam_message(wedge + "angle_deg = 25\nangles_deg = [20, 25]\n"), "are both given"));
    EXPECT_EQ(seam_message(wedge), "(accepted)");
    EXPECT_TRUE(says(seam_message(wedge + "dilation_deg = 45\n"),
                    "seam[1].wedge.dilation_deg = 45 is above the friction angle, 40 degrees"));
    EXPECT_TRUE(says(seam_message("depth_m = 8\nexit = \"free-face\"\ndilation_deg = 30\n"), "at most 26.5651 deg"));
}

TEST(PlaneInput, SeamTablesAgree)
{
    EXPECT_TRUE(says(seam_message("depth_m = 8\nexit = \"free-face\"\n[seam.interface]\nfriction = 0.3\n"), "but its model is \"smooth\""));
    EXPECT_TRUE(says(seam_message("depth_m = 8\nexit = \"free-face\"\n[seam.interface]\nmodel = \"friction\"\n"), "without interface.friction"));
    EXPECT_TRUE(says(seam_message("depth_m = 8\nexit = \"free-face\"\nuplift = \"points\"\n"), "without uplift_points_m"));
    EXPECT_TRUE(says(seam_message("depth_m = 8\nexit = \"free-face\"\nuplift = \"drains\"\n"), "without [drains]"));
    EXPECT_TRUE(says(seam_message("depth_m = 8\nexit = \"free-face\"\nname = \"base\"\n"), "two planes are named \"base\""));
    EXPECT_TRUE(says(seam_message("depth_m = 8\nexit = \"free-face\"\nwedge = 3\n"), "unknown key seam[1].wedge"));
    EXPECT_TRUE(says(seam_message("depth_m = 8\n[seam.wedge]\nfrction = 0.8\n"), "unknown key seam[1].wedge.frction. Did you mean seam[1].wedge.friction?"));
    EXPECT_TRUE(says(plane_message("[wedge]\n[[seam]]\nfriction = 0.5\n"), "[seam] has no place in a scene of a [wedge]."));
}

/// Resolved scenes and the keys of other programs know the tables inside a seam.
TEST(PlaneInput, TablesInsideSeamsAreWrittenAndSet)
{
    const std::string text = plane_dam + plane_rock +
                             "ground_m = [[-10, 0], [0, 0], [45, 0], [80, 3]]\nk0 = 0.8\n"
                             "[lifts]\nfriction = 0.8\nelevations_ft = [10, 20]\n"
                             "[[seam]]\nname = \"clay\"\nfriction = 0.5\ndepth_m = 8\n"
                             "[seam.wedge]\nfriction_deg = 40\nangles_deg = [20, 25]\n"
                             "[[seam]]\nfriction = 0.6\ndepth_m = 12\ndip_deg = 2\n"
                             "[seam.wedge]\nfriction = 0.8\nsearch_deg = [5, 40]\n"
                             "[seam.interface]\nmodel = \"friction\"\nfriction_deg = 20\n";
    const Scene scene = parse_scene(text, "dam.toml", FileCheck::skip);
    ASSERT_EQ(scene.seams.size(), 2u);
    EXPECT_EQ(scene.seams[0].wedge->angles.size(), 2u);
    EXPECT_TRUE(scene.seams[1].wedge->angles.empty());
    EXPECT_EQ(scene.seams[1].exit, SeamExit::wedge);
    EXPECT_EQ(scene.seams[1].name, "seam 2");
    EXPECT_DOUBLE_EQ(scene.lifts->elevations[1], 6.096);
    const std::string resolved = resolved_toml(scene);
    const Scene again = parse_scene(resolved, "dam.toml", FileCheck::skip);
    EXPECT_EQ(resolved_toml(again), resolved);
    EXPECT_EQ(again.seams[1].wedge->search_from, scene.seams[1].wedge->search_from);
    EXPECT_EQ(again.seams[0].wedge->angles, scene.seams[0].wedge->angles);
    EXPECT_EQ(again.seams[1].interface, scene.seams[1].interface);
    EXPECT_EQ(again.foundation->k0, scene.foundation->k0);

    const SceneText keys(text, "dam.toml");
    EXPECT_EQ(keys.canonical("seam[1].wedge.friction_deg"), "seam[clay].wedge.friction");
    const KeyChange changes[]{{"seam[clay].wedge.friction", 0.7}, {"seam[seam 2].friction", 0.4}, {"lifts.friction", 0.9}};
    EXPECT_THROW(keys.with(changes), InputError); // the second seam has no name in the file
    const KeyChange named[]{{"seam[clay].wedge.friction", 0.7}, {"seam[2].friction", 0.4}, {"lifts.friction", 0.9}};
    const Scene changed = keys.with(named);
    EXPECT_EQ(changed.seams[0].wedge->friction, 0.7);
    EXPECT_EQ(changed.seams[1].strength.friction, 0.4);
    EXPECT_EQ(changed.lifts->strength.friction, 0.9);
}

TEST(PlaneInput, TheStressOfTheRockIsForASeam)
{
    EXPECT_EQ(plane_message(plane_rock + "k0 = 1.5\n"),
              "dam.toml:11:1: error: foundation.k0 = 1.5 is given, but the scene has no [[seam]].\n"
              "  expected: the stress of the rock before the dam decides on a [[seam]] by  fe --plane  only\n"
              "  fix:      add a [[seam]], or delete k0");
    const auto with = [](const std::string& k0) {
        return plane_message(plane_rock + "k0 = " + k0 + "\n[[seam]]\nfriction = 0.5\ndepth_m = 8\nexit = \"free-face\"\n");
    };
    EXPECT_EQ(with("1.5"), "(accepted)");
    EXPECT_TRUE(says(with("-0.2"), "dam.toml:11:6: error: foundation.k0 = -0.2 is not allowed.")) << with("-0.2");
    EXPECT_TRUE(says(with("-0.2"), "0 ... 10")) << with("-0.2");
}

TEST(PlaneInput, LiftsStandAtTheirSpacing)
{
    const Scene scene = plane_scene("[lifts]\nfriction = 0.8\nspacing_m = 7.5\nto_m = 45\n");
    const std::vector<double> expected{7.5, 15, 22.5, 30, 37.5, 45};
    EXPECT_EQ(lift_elevations(scene), expected);
}

} // namespace
