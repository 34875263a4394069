// Gmsh files that are wrong, and the words their users read: every way in which a file is refused, on a dam of two elements on a
// rock of six.
#include "core/input_error.hpp"
#include "fe2d/gmsh/gmsh.hpp"
#include "fe2d/mesh/import_mesh.hpp"
#include "scene/read.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;
using namespace damslip::fe2d;

// 9   8 . . .  y = 2      dam 2 m x 2 m: elements 4, 5 (lower and upper half)
// 10 11        y = 1
// 1-2-3-4      y = 0      rock -2 ... 4 m, 2 m deep: elements 6 ... 8
// 5-6-7-12     y = -2
const std::string good_2_2 = "$MeshFormat\n"
                             "2.2 0 8\n"
                             "$EndMeshFormat\n"
                             "$PhysicalNames\n"
                             "3\n"
                             "1 3 \"base\"\n"
                             "2 1 \"dam\"\n"
                             "2 2 \"rock\"\n"
                             "$EndPhysicalNames\n"
                             "$Nodes\n" // 10
                             "12\n"
                             "1 -2 0 0\n"
                             "2 0 0 0\n"
                             "3 2 0 0\n"
                             "4 4 0 0\n"
                             "5 -2 -2 0\n"
                             "6 0 -2 0\n"
                             "7 2 -2 0\n"
                             "12 4 -2 0\n"
                             "8 2 2 0\n" // 20
                             "9 0 2 0\n"
                             "10 0 1 0\n"
                             "11 2 1 0\n"
                             "$EndNodes\n"
                             "$Elements\n"
                             "6\n"
                             "3 1 2 3 1 2 3\n"
                             "4 3 2 1 1 2 3 11 10\n"
                             "5 3 2 1 1 10 11 8 9\n"
                             "6 3 2 2 2 5 6 2 1\n" // 30
                             "7 3 2 2 2 6 7 3 2\n"
                             "8 3 2 2 2 7 12 4 3\n"
                             "$EndElements\n";

const std::string good_4_1 = "$MeshFormat\n"
                             "4.1 0 8\n"
                             "$EndMeshFormat\n"
                             "$PhysicalNames\n"
                             "3\n"
                             "1 3 \"base\"\n"
                             "2 1 \"dam\"\n"
                             "2 2 \"rock\"\n"
                             "$EndPhysicalNames\n"
                             "$Entities\n" // 10
                             "0 1 2 0\n"
                             "1 0 0 0 2 0 0 1 -3 0\n"
                             "1 0 0 0 2 2 0 1 1 0\n"
                             "2 -2 -2 0 4 0 0 1 2 1 1\n"
                             "$EndEntities\n"
                             "$Nodes\n"
                             "2 12 1 12\n"
                             "2 2 0 8\n"
                             "1\n2\n3\n4\n5\n6\n7\n12\n" // 19 ... 26
                             "-2 0 0\n0 0 0\n2 0 0\n4 0 0\n-2 -2 0\n0 -2 0\n2 -2 0\n4 -2 0\n"
                             "2 1 1 4\n" // 35
                             "8\n9\n10\n11\n"
                             "2 2 0 0 0\n0 2 0 0 0\n0 1 0 0 0\n2 1 0 0 0\n" // parametric: u, v follow
                             "$EndNodes\n"
                             "$Elements\n" // 45
                             "3 6 3 8\n"
                             "1 1 1 1\n"
                             "3 2 3\n"
                             "2 1 3 2\n"
                             "4 2 3 11 10\n" // 50
                             "5 10 11 8 9\n"
                             "2 2 3 3\n"
                             "6 5 6 2 1\n"
                             "7 6 7 3 2\n"
                             "8 7 12 4 3\n"
                             "$EndElements\n";

Scene small_dam()
{
    Scene scene;
    scene.file = "dam.toml";
    scene.section.polygon = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
    scene.dam = {2500.0, 25e9, 0.17};
    scene.foundation = Foundation{.material = {0.0, 30e9, 0.2}, .mass = RockMass::massless, .width = 6.0, .depth = 2.0};
    return scene;
}

std::string gmsh_message(const std::string& text, const Scene& scene = small_dam())
{
    try {
        import_mesh(parse_gmsh(text, "dam.msh"), scene);
    } catch (const InputError& error) {
        return error.what();
    }
    return "(imported)";
}

std::string gmsh_changed(std::string text, const std::string& from, const std::string& to)
{
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

struct WrongGmsh {
    std::string from, to; ///< in the good file
    std::string problem;  ///< start of the message
};

void expect_refused(const std::string& good, const std::vector<WrongGmsh>& cases)
{
    for (const WrongGmsh& wrong : cases) {
        const std::string found = gmsh_message(gmsh_changed(good, wrong.from, wrong.to));
        EXPECT_TRUE(found.starts_with(wrong.problem)) << found << "\n  for " << wrong.from << " -> " << wrong.to;
        EXPECT_NE(found.find("\n  expected: "), std::string::npos) << found;
        EXPECT_NE(found.find("\n  fix:      "), std::string::npos) << found;
    }
}

TEST(FeGmshInput, the_files_themselves_are_fine)
{
    EXPECT_EQ(gmsh_message(good_2_2), "(imported)");
    EXPECT_EQ(gmsh_message(good_4_1), "(imported)");
}

TEST(FeGmshInput, format)
{
    expect_refused(good_2_2,
                   {{"$MeshFormat", "solid dam", "dam.msh:1: error: the file does not start with $MeshFormat"},
                    {"2.2 0 8", "2.2 1 8", "dam.msh:2: error: the mesh is a binary file."},
                    {"2.2 0 8", "4 0 8", "dam.msh:2: error: version 4 of the Gmsh format is not read."},
                    {"2.2 0 8", "1 0 8", "dam.msh:2: error: version 1 of the Gmsh format is not read."},
                    {"2.2 0 8", "2.2 0 4", "dam.msh:2: error: size of a number = 4 is not allowed."},
                    {"2.2 0 8", "2.2 0", "dam.msh:2: error: size of a number in bytes is missing"},
                    {"2.2 0 8", "2.2 0 8 9", "dam.msh:2: error: \"9\" is too much in the line \"2.2 0 8 9\"."},
                    {"$Nodes", "$Nodez", "dam.msh:10: error: section $Nodez is not known."},
                    {"$Nodes", "$PartitionedEntities", "dam.msh:10: error: the mesh is partitioned."},
                    {"$EndPhysicalNames\n", "$EndPhysicalNames\nhello\n",
                     "dam.msh:10: error: a section was to start here, not \"hello\"."}});
    EXPECT_EQ(gmsh_message("$MeshFormat\n4.1 1 8\n\x01\x00\x00\x00\n$EndMeshFormat\n"),
              "dam.msh:2: error: the mesh is a binary file.\n"
              "  expected: ASCII: file type 0\n"
              "  fix:      write it with  gmsh -2 -format msh41  or  -format msh22  (ASCII, not binary)");
    EXPECT_TRUE(gmsh_message("").starts_with("dam.msh: error: the file does not start with $MeshFormat"))
        << gmsh_message("");
    const std::string format = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    EXPECT_TRUE(gmsh_message(format).starts_with("dam.msh:3: error: section $Nodes is missing."))
        << gmsh_message(format);
    const std::string twice = good_2_2 + "$Nodes\n0\n$EndNodes\n";
    EXPECT_TRUE(gmsh_message(twice).starts_with("dam.msh:34: error: section $Nodes is given twice."))
        << gmsh_message(twice);
}

TEST(FeGmshInput, names)
{
    expect_refused(
        good_2_2,
        {{"1 3 \"base\"", "1 3 base", "dam.msh:6: error: physical name = base is not allowed."},
         {"1 3 \"base\"", "1 3 \"base", "dam.msh:6: error: physical name = \"base is not allowed."},
         {"1 3 \"base\"", "2 1 \"base\"",
          "dam.msh:7: error: the physical group 1 \"dam\" of dimension 2 is named in line 6"},
         {"\"dam\"", "\"Dam\"", "dam.msh:7: error: physical surface \"Dam\" is not known. Did you mean \"dam\"?"},
         {"\"dam\"", "\"water\"", "dam.msh:7: error: physical surface \"water\" is not known."},
         {"\"base\"", "\"bse\"", "dam.msh:6: error: physical line \"bse\" is not known. Did you mean \"base\"?"},
         {"\"base\"", "\"somewhere\"", "dam.msh: error: there is no physical line \"base\"."},
         {"\"rock\"", "\"dam:lower\"", "dam.msh: error: the mesh has no rock, but dam.toml has a [foundation]."},
         {"\"dam\"", "\"rock:upper\"", "dam.msh: error: the mesh has no dam."},
         {"5 3 2 1 1 10", "5 3 2 0 1 10", "dam.msh:29: error: element 5 is in no physical surface with a name."},
         {"5 3 2 1 1 10", "5 3 2 7 1 10", "dam.msh:29: error: element 5 is in no physical surface with a name."}});
    expect_refused(good_4_1, {{"2 -2 -2 0 4 0 0 1 2 1 1", "2 -2 -2 0 4 0 0 2 2 1 1 1",
                               "dam.msh:53: error: element 6 belongs to two bodies"}});
}

TEST(FeGmshInput, nodes)
{
    expect_refused(
        good_2_2, {{"3 2 0 0", "3 2 0", "dam.msh:14: error: z is missing: the line \"3 2 0\" ends too early."},
                   {"3 2 0 0", "3 2 nan 0", "dam.msh:14: error: y = nan is not allowed."},
                   {"3 2 0 0", "3 2 1e999 0", "dam.msh:14: error: y = 1e999 is not allowed."},
                   {"3 2 0 0", "3 2e7 0 0", "dam.msh:14: error: node 3 has the coordinate 2e+07."},
                   {"3 2 0 0", "x 2 0 0", "dam.msh:14: error: node tag = x is not allowed."},
                   {"3 2 0 0", "0 2 0 0", "dam.msh:14: error: node tag = 0 is not allowed."},
                   {"3 2 0 0", "3.5 2 0 0", "dam.msh:14: error: node tag = 3.5 is not allowed."},
                   {"3 2 0 0", "2 2 0 0", "dam.msh:14: error: node tag 2 is given twice."},
                   {"3 2 0 0", "3 2 0 1", "dam.msh:14: error: node 3 has z = 1, the first one 0."},
                   {"12\n1 -2", "13\n1 -2", "dam.msh:24: error: node tag = $EndNodes is not allowed."},
                   {"12\n1 -2", "11\n1 -2", "dam.msh:23: error: $Nodes goes on after as many entries as it announces."},
                   {"12\n1 -2", "-1\n1 -2", "dam.msh:11: error: number of nodes = -1 is not allowed."}});
    expect_refused(
        good_4_1,
        {{"2 12 1 12", "2 13 1 12", "dam.msh:43: error: the blocks of $Nodes hold 12 entries, its first line says 13."},
         {"2 12 1 12", "2 11 1 12", "dam.msh:35: error: number of nodes in the block = 4 is not allowed."},
         {"2 1 1 4", "2 1 0 4", "dam.msh:40: error: \"0 0\" is too much in the line \"2 2 0 0 0\"."},
         {"2 2 0 8", "2 2 2 8", "dam.msh:18: error: parametric = 2 is not allowed."}});
}

TEST(FeGmshInput, elements)
{
    expect_refused(
        good_2_2,
        {{"4 3 2 1 1 2 3 11 10", "4 16 2 1 1 2 3 11 10 4 5 6 7",
          "dam.msh:28: error: element 4 has type 16: 8-node quadrilateral of second order."},
         {"4 3 2 1 1 2 3 11 10", "4 4 2 1 1 2 3 11 10", "dam.msh:28: error: element 4 has type 4: 4-node tetrahedron."},
         {"4 3 2 1 1 2 3 11 10", "4 5 2 1 1 1 2 3 4 5 6 7 8",
          "dam.msh:28: error: element 4 has type 5: 8-node hexahedron."},
         {"4 3 2 1 1 2 3 11 10", "4 6 2 1 1 1 2 3 4 5 6", "dam.msh:28: error: element 4 has type 6: 6-node prism."},
         {"4 3 2 1 1 2 3 11 10", "4 7 2 1 1 1 2 3 4 5", "dam.msh:28: error: element 4 has type 7: 5-node pyramid."},
         {"4 3 2 1 1 2 3 11 10", "4 8 2 1 1 1 2 3",
          "dam.msh:28: error: element 4 has type 8: 3-node line of second order."},
         {"4 3 2 1 1 2 3 11 10", "4 9 2 1 1 1 2 3 4 5 6",
          "dam.msh:28: error: element 4 has type 9: 6-node triangle of second order."},
         {"4 3 2 1 1 2 3 11 10", "4 10 2 1 1 1 2 3 4 5 6 7 8 9",
          "dam.msh:28: error: element 4 has type 10: 9-node quadrilateral of second order."},
         {"4 3 2 1 1 2 3 11 10", "4 20 2 1 1 1 2 3 4 5 6 7 8 9",
          "dam.msh:28: error: element 4 has type 20: no line, triangle or quadrilateral of first order."},
         {"4 3 2 1 1 2 3 11 10", "4 3 2 1 1 2 3 11", "dam.msh:28: error: node tag is missing"},
         {"4 3 2 1 1 2 3 11 10", "4 3 2 1 1 2 3 11 99", "dam.msh:28: error: node 99 of the element is not in $Nodes."},
         {"4 3 2 1 1 2 3 11 10", "4 3 2 1 1 2 3 3 10", "dam.msh:28: error: element 4 has node 3 twice."},
         {"4 3 2 1 1 2 3 11 10", "4 3 2 1 1 2 11 3 10",
          "dam.msh:28: error: element 4 of the dam at (0, 0) m is folded or re-entrant"},
         {"4 3 2 1 1 2 3 11 10", "4 2 2 1 1 1 2 3", "dam.msh:28: error: element 4 of the dam at (-2, 0) m is flat"},
         {"5 3 2 1 1 10 11 8 9", "5 3 2 1 1 2 3 8 9",
          "dam.msh:29: error: this element of the dam and the one of line 28 overlap"},
         {"6\n3 1 2", "7\n3 1 2", "dam.msh:33: error: element tag = $EndElements is not allowed."},
         {"$EndElements\n", "", "dam.msh:32: error: the file ends inside $Elements."}});
    expect_refused(
        good_4_1,
        {{"2 1 3 2\n", "2 9 3 2\n", "dam.msh:49: error: entity 9 of dimension 2 is not in $Entities."},
         {"3 6 3 8", "3 7 3 8", "dam.msh:55: error: the blocks of $Elements hold 6 entries, its first line says 7."},
         {"2 -2 -2 0 4 0 0 1 2 1 1", "1 -2 -2 0 4 0 0 1 2 1 1",
          "dam.msh:14: error: entity 1 of dimension 2 is given twice."}});
}

TEST(FeGmshInput, not_the_section_of_the_scene)
{
    const auto with_section = [](Polyline polygon) {
        Scene scene = small_dam();
        scene.section.polygon = std::move(polygon);
        return gmsh_message(good_2_2, scene);
    };
    EXPECT_EQ(
        with_section({{0, 0}, {2.1, 0}, {2, 2}, {0, 2}}),
        "dam.msh: error: the toe of the mesh is at (2, 0) m, that of the scene's section at (2.1, 0) m.\n"
        "  expected: the same place within 0.001 of the base: 0.0021 m\n"
        "  fix:      the heel is the origin, x points downstream; where the unit of the file is not the metre give "
        "mesh.file_unit_m; or correct section");
    const std::string leaning = with_section({{0, 0}, {2, 0}, {1.5, 2}, {0, 2}});
    EXPECT_TRUE(leaning.starts_with(
        "dam.msh: error: the outline of the dam has a node at (2, 1) m, 0.243 m off the scene's section."))
        << leaning;
    EXPECT_TRUE(with_section({{0, 0}, {2, 0}, {2, 2}, {1, 2.5}, {0, 2}})
                    .starts_with("dam.msh: error: the dam of the mesh has an area of 4 m2"))
        << with_section({{0, 0}, {2, 0}, {2, 2}, {1, 2.5}, {0, 2}});
    Scene feet = small_dam();
    feet.mesh.file_unit = 0.3048;
    EXPECT_TRUE(gmsh_message(good_2_2, feet).starts_with("dam.msh: error: the toe of the mesh is at (0.6096, 0) m"))
        << gmsh_message(good_2_2, feet);
}

TEST(FeGmshInput, outlines)
{
    expect_refused(good_2_2,
                   {{"3 1 2 3 1 2 3", "3 1 2 3 1 10 11",
                     "dam.msh: error: no edge of the physical line \"base\" is on the outline of the dam."},
                    {"3 1 2 3 1 2 3", "3 1 2 3 1 9 10", "dam.msh: error: the heel of the mesh is at (0, 2) m"},
                    {"8 3 2 2 2 7 12 4 3", "8 2 2 2 2 7 4 3",
                     "dam.msh: error: the outline of the rock is not understood at (2, -2) m"},
                    {"7 3 2 2 2 6 7 3 2", "7 2 2 2 2 6 7 3",
                     "dam.msh:31: error: parts of the rock touch only in the point (0, -2) m."},
                    {"7 3 2 2 2 6 7 3 2\n", "7 15 2 2 2 1\n", "dam.msh: error: the rock has more than one outline"}});
    std::string gap = gmsh_changed(gmsh_changed(good_2_2, "12\n1 -2", "13\n13 1 -1 0\n1 -2"), "6\n3 1 2",
                                   "8\n3 1 2"); // below the base
    gap = gmsh_changed(gap, "7 3 2 2 2 6 7 3 2", "7 2 2 2 2 6 7 13\n9 2 2 2 2 7 3 13\n10 2 2 2 2 6 13 2");
    EXPECT_TRUE(gmsh_message(gap).starts_with(
        "dam.msh: error: the rock does not follow the base: between toe and heel its outline "
        "goes through (1, -1) m."))
        << gmsh_message(gap);
    const std::string crest =
        gmsh_changed(gmsh_changed(good_2_2, "3\n1 3", "4\n1 4 \"crest\"\n1 3"), "6\n3 1 2", "7\n1 1 2 4 4 11 8\n3 1 2");
    EXPECT_TRUE(gmsh_message(crest).starts_with("dam.msh: error: physical line \"crest\" does not fit: the edge"))
        << gmsh_message(crest);
}

TEST(FeGmshInput, lift_joints)
{
    Scene scene = small_dam();
    scene.lift_joints.push_back({.name = "lift", .elevation = 1.0, .strength = {}});
    EXPECT_EQ(gmsh_message(good_2_2, scene), "(imported)");
    scene.lift_joints.front().elevation = 1.5;
    EXPECT_TRUE(gmsh_message(good_2_2, scene)
                    .starts_with("dam.msh:29: error: this element lies across the lift joint \"lift\" at 1.5 m."))
        << gmsh_message(good_2_2, scene);
}

TEST(FeGmshInput, finite_sliding_needs_a_straight_surface)
{
    Scene scene = small_dam();
    scene.contact.sliding = JointPath::finite;
    EXPECT_EQ(gmsh_message(good_2_2, scene), "(imported)"); // 1 m on both sides by default, 2 m are there
    try {
        import_mesh(parse_gmsh(good_2_2, "dam.msh"), scene, {.upstream = 1.0, .downstream = 5.0});
        ADD_FAILURE() << "imported";
    } catch (const InputError& error) {
        EXPECT_EQ(std::string(error.what())
                      .find("dam.msh: error: the rock surface goes on straight 2 m upstream of the heel "
                            "and 2 m downstream of the toe."),
                  0u)
            << error.what();
    }
}

std::string scene_message(const std::string& mesh)
{
    try {
        parse_scene("[section]\nheight_m = 62.5\nbase_m = 45\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = "
                    "0.7\n[mesh]\n" +
                        mesh,
                    "dam.toml", FileCheck::must_exist);
    } catch (const InputError& error) {
        return error.what();
    }
    return "(read)";
}

TEST(FeGmshInput, keys)
{
    EXPECT_EQ(scene_message("file_unit_m = 0.001\n"),
              "dam.toml:9:1: error: mesh.file_unit_m is given without mesh.file.\n"
              "  expected: both, or neither\n"
              "  fix:      add  file = \"dam.msh\"  or delete file_unit_m");
    EXPECT_NE(
        scene_message("file = \"nowhere.msh\"\n").find("dam.toml:9:1: error: mesh.file: there is no file nowhere.msh."),
        std::string::npos)
        << scene_message("file = \"nowhere.msh\"\n");
    for (const char* key : {"size_m", "contact_size_m", "rock_contact_size_m", "growth"}) {
        const std::string found = scene_message("file = \"nowhere.msh\"\n" + std::string(key) + " = 1.5\n");
        EXPECT_NE(found.find("mesh." + std::string(key) + " is given together with mesh.file = \"nowhere.msh\"."),
                  std::string::npos)
            << found;
    }
}

} // namespace
