// Meshes through Gmsh files and back: the same mesh.
#include "fe2d/gmsh/gmsh.hpp"
#include "fe2d/mesh/import_mesh.hpp"
#include "fe2d/mesh/mesh.hpp"
#include "fe_scenes.hpp"
#include "scene/read.hpp"
#include "scene/write.hpp"
#include "source_dir.hpp"
#include "verification/cases/mixed_mesh.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;
using namespace damslip::fe2d;
using test::reference_dam;
using test::reference_dam_on_rock;

Scene coarse_mesh(Scene scene, double size = 5.0)
{
    scene.mesh.size = scene.mesh.contact_size = size;
    return scene;
}

Mesh through_file(const Mesh& mesh, const Scene& scene, GmshVersion version, BaseNodes base = BaseNodes::twice)
{
    return import_mesh(parse_gmsh(gmsh_text(export_mesh(mesh, base), version), "dam.msh"), scene).mesh;
}

void expect_distances(const std::vector<double>& a, const std::vector<double>& b)
{
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-12);
}

/// Same nodes, elements and boundaries, number by number; distances along the base are measured anew.
void expect_same_mesh(const Mesh& a, const Mesh& b)
{
    EXPECT_TRUE(a.nodes == b.nodes);
    ASSERT_EQ(a.element_count(), b.element_count());
    for (int e = 0; e < a.element_count(); ++e) {
        EXPECT_EQ(a.elements[e].nodes, b.elements[e].nodes) << e;
        EXPECT_EQ(a.elements[e].region, b.elements[e].region) << e;
    }
    EXPECT_EQ(a.dam_node_count, b.dam_node_count);
    EXPECT_EQ(a.dam_element_count, b.dam_element_count);
    EXPECT_EQ(a.contact.dam_nodes, b.contact.dam_nodes);
    EXPECT_EQ(a.contact.rock_nodes, b.contact.rock_nodes);
    EXPECT_EQ(a.contact.matching, b.contact.matching);
    EXPECT_EQ(a.contact.rock_line, b.contact.rock_line);
    expect_distances(a.contact.distance, b.contact.distance);
    expect_distances(a.contact.rock_node_distance, b.contact.rock_node_distance);
    expect_distances(a.contact.rock_distance, b.contact.rock_distance);
    ASSERT_EQ(a.lifts.size(), b.lifts.size());
    for (std::size_t i = 0; i < a.lifts.size(); ++i) {
        EXPECT_EQ(a.lifts[i].lower_nodes, b.lifts[i].lower_nodes);
        EXPECT_EQ(a.lifts[i].upper_nodes, b.lifts[i].upper_nodes);
        expect_distances(a.lifts[i].distance, b.lifts[i].distance);
    }
    EXPECT_EQ(a.upstream_face, b.upstream_face);
    EXPECT_EQ(a.downstream_face, b.downstream_face);
    EXPECT_EQ(a.crest, b.crest);
    EXPECT_EQ(a.floor, b.floor);
    EXPECT_EQ(a.ground, b.ground);
    EXPECT_EQ(a.box_left, b.box_left);
    EXPECT_EQ(a.box_bottom, b.box_bottom);
    EXPECT_EQ(a.box_right, b.box_right);
}

TEST(FeGmsh, AMeshComesBackAsItWas)
{
    Scene inclined = coarse_mesh(reference_dam_on_rock());
    inclined.section.polygon[1] = {45, -3};
    Scene pointed = coarse_mesh(reference_dam());
    pointed.section.polygon = {{0, 0}, {45, 0}, {0, 62.5}};
    Scene joints = coarse_mesh(reference_dam_on_rock());
    joints.lift_joints.push_back({.name = "low", .elevation = 20.0, .strength = {}});
    joints.lift_joints.push_back({.name = "high", .elevation = 40.0, .strength = {}});
    Scene apart = coarse_mesh(reference_dam_on_rock());
    apart.mesh.rock_contact_size = 3.3;
    for (const Scene& scene :
         {coarse_mesh(reference_dam()), coarse_mesh(reference_dam_on_rock()), inclined, pointed, joints, apart}) {
        const Mesh mesh = build_mesh(scene);
        for (const GmshVersion version : {GmshVersion::v2_2, GmshVersion::v4_1})
            expect_same_mesh(through_file(mesh, scene, version), mesh);
    }
}

TEST(FeGmsh, BothVersionsSayTheSame)
{
    const GmshFile file =
        verification::mixed_mesh(export_mesh(build_mesh(coarse_mesh(reference_dam_on_rock())), BaseNodes::shared));
    const GmshFile a = parse_gmsh(gmsh_text(file, GmshVersion::v2_2), "dam.msh"),
                   b = parse_gmsh(gmsh_text(file, GmshVersion::v4_1), "dam.msh");
    ASSERT_EQ(a.nodes.size(), file.nodes.size());
    for (std::size_t n = 0; n < a.nodes.size(); ++n) {
        EXPECT_EQ(a.nodes[n].tag, b.nodes[n].tag);
        EXPECT_EQ(a.nodes[n].at, b.nodes[n].at);
        EXPECT_EQ(a.nodes[n].at, file.nodes[n].at); // bit for bit through the text
    }
    ASSERT_EQ(a.elements.size(), file.elements.size());
    for (std::size_t e = 0; e < a.elements.size(); ++e) {
        EXPECT_EQ(a.elements[e].tag, b.elements[e].tag);
        EXPECT_EQ(a.elements[e].shape, b.elements[e].shape);
        EXPECT_EQ(a.elements[e].nodes, b.elements[e].nodes);
        EXPECT_EQ(a.elements[e].groups, b.elements[e].groups);
    }
    expect_same_mesh(import_mesh(a, coarse_mesh(reference_dam_on_rock())).mesh,
                     import_mesh(b, coarse_mesh(reference_dam_on_rock())).mesh);
}

TEST(FeGmsh, SharedNodesOfTheBaseAreSplit)
{
    const Scene scene = coarse_mesh(reference_dam_on_rock());
    const Mesh own = build_mesh(scene), mesh = through_file(own, scene, GmshVersion::v4_1, BaseNodes::shared);
    EXPECT_EQ(mesh.node_count(), own.node_count());
    EXPECT_TRUE(mesh.contact.matching);
    ASSERT_EQ(mesh.contact.rock_nodes.size(), mesh.contact.dam_nodes.size());
    for (std::size_t i = 0; i < mesh.contact.dam_nodes.size(); ++i) {
        EXPECT_LT(mesh.contact.dam_nodes[i], mesh.dam_node_count);
        EXPECT_GE(mesh.contact.rock_nodes[i], mesh.dam_node_count);
        EXPECT_EQ(mesh.nodes[mesh.contact.dam_nodes[i]], mesh.nodes[mesh.contact.rock_nodes[i]]);
    }
}

TEST(FeGmsh, AnIrregularMeshIsPutInOrder)
{
    const Scene scene = coarse_mesh(reference_dam_on_rock());
    const GmshFile file = verification::mixed_mesh(export_mesh(build_mesh(scene), BaseNodes::shared));
    const ImportedMesh imported = import_mesh(file, scene);
    EXPECT_EQ(imported.summary.unused, 1);
    EXPECT_EQ(imported.summary.joined, 0);
    EXPECT_NEAR(imported.summary.flipped, 0.5 * imported.mesh.element_count(), 20);
    double area = 0.0;
    for (int e = 0; e < imported.mesh.dam_element_count; ++e) {
        const Element& element = imported.mesh.elements[e];
        const auto p = corners(imported.mesh, element);
        for (int i = 0; i < element.size(); ++i) {
            const Point a = p[i], b = p[(i + 1) % element.size()];
            area += 0.5 * (a.x * b.y - b.x * a.y); // counter-clockwise: positive
        }
    }
    EXPECT_NEAR(area, 45 * 51.5 / 2 + 12 * 51.5 / 2 + 12 * 11, 1e-9); // trapezium to the kink, rectangle above
}

TEST(FeGmsh, NodesAtOnePlaceAreOneInABodyAndTwoAcrossTheBase)
{
    // Surfaces meshed apart: every element of the file has nodes of its own, those of the lines too.
    const Scene scene = coarse_mesh(reference_dam_on_rock());
    const Mesh own = build_mesh(scene);
    const GmshFile file = export_mesh(own, BaseNodes::shared);
    GmshFile apart = file;
    apart.nodes.clear();
    for (GmshElement& e : apart.elements)
        for (int i = 0; i < node_count(e.shape); ++i) {
            apart.nodes.push_back(file.nodes[e.nodes[i]]);
            apart.nodes.back().tag = static_cast<std::int64_t>(apart.nodes.size());
            e.nodes[i] = static_cast<int>(apart.nodes.size()) - 1;
        }
    const ImportedMesh imported = import_mesh(apart, scene);
    EXPECT_EQ(imported.mesh.node_count(), own.node_count());
    EXPECT_EQ(imported.mesh.contact.dam_nodes.size(), own.contact.dam_nodes.size());
    EXPECT_TRUE(imported.mesh.contact.matching);
}

TEST(FeGmsh, RockIsLeftOutWithoutAFoundation)
{
    Scene with_rock = coarse_mesh(reference_dam_on_rock());
    with_rock.curtain.reset(); // its sides would be columns of the dam too
    const Scene without = coarse_mesh(reference_dam());
    expect_same_mesh(through_file(build_mesh(with_rock), without, GmshVersion::v4_1), build_mesh(without));
}

TEST(FeGmsh, UnitsOfTheFile)
{
    Scene feet = coarse_mesh(reference_dam());
    const Mesh own = build_mesh(feet);
    GmshFile file = export_mesh(own);
    for (GmshNode& node : file.nodes) node.at = {node.at.x / 0.3048, node.at.y / 0.3048};
    feet.mesh.file_unit = 0.3048;
    const Mesh mesh = import_mesh(file, feet).mesh;
    for (int n = 0; n < own.node_count(); ++n) {
        EXPECT_NEAR(mesh.nodes[n].x, own.nodes[n].x, 1e-12);
        EXPECT_NEAR(mesh.nodes[n].y, own.nodes[n].y, 1e-12);
    }
}

TEST(FeGmsh, TheResolvedSceneNamesTheFile)
{
    const Scene scene = parse_scene("[section]\nheight_m = 62.5\nbase_m = 45\n[dam]\ndensity_kg_m3 = 2500\n[contact]\n"
                                    "friction = 0.7\n[mesh]\nfile = \"dam.msh\"\nfile_unit_ft = 1\n",
                                    "scenes/dam.toml", FileCheck::skip);
    EXPECT_EQ(scene.mesh.file, std::filesystem::path("scenes/dam.msh"));
    EXPECT_EQ(scene.mesh.file_unit, 0.3048);
    const std::string resolved = resolved_toml(scene, RecordPaths::file_names);
    EXPECT_NE(resolved.find("file = \"dam.msh\"\nfile_unit_m = 0.3048\n"), std::string::npos) << resolved;
    EXPECT_EQ(resolved.find("growth"), std::string::npos);
    EXPECT_EQ(resolved_toml(parse_scene(resolved, "dam.toml", FileCheck::skip), RecordPaths::file_names), resolved);
}

TEST(FeGmsh, TheExampleOfGmshItself)
{
    const Scene scene = read_scene(std::string(source_dir()) + "/examples/imported_mesh/dam.toml");
    const ImportedMesh imported = import_mesh(scene);
    EXPECT_EQ(imported.summary.version, "4.1");
    EXPECT_EQ(imported.summary.unused, 0);
    EXPECT_TRUE(imported.mesh.contact.matching);
    EXPECT_EQ(imported.mesh.contact.dam_nodes.size(), 31u);
    int triangles = 0;
    for (const Element& e : imported.mesh.elements) triangles += e.size() == 3;
    EXPECT_EQ(triangles, 204);
}

} // namespace
