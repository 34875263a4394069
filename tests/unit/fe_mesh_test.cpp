// Structured mesher: conformity, areas, split contact plane, grading, curtain, refusals.
#include "core/input_error.hpp"
#include "fe2d/mesh/build_mesh.hpp"
#include "fe2d/mesh/faces.hpp"
#include "fe_scenes.hpp"
#include "scene/section.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace {

using namespace damslip;
using namespace damslip::fe2d;

double element_area(const Mesh& mesh, const Element& element)
{
    const auto p = corners(mesh, element);
    double twice = 0.0;
    for (int i = 0; i < element.size(); ++i) {
        const Point a = p[i], b = p[(i + 1) % element.size()];
        twice += a.x * b.y - b.x * a.y;
    }
    return 0.5 * twice;
}

double region_area(const Mesh& mesh, Region region)
{
    double sum = 0.0;
    for (const Element& element : mesh.elements)
        if (element.region == region) sum += element_area(mesh, element);
    return sum;
}

/// Edges that belong to one element only, with its orientation. In a conforming mesh these are exactly the boundary
/// chains.
std::map<std::pair<int, int>, int> open_edges(const Mesh& mesh)
{
    std::map<std::pair<int, int>, int> edges;
    for (const Element& element : mesh.elements)
        for (int i = 0; i < element.size(); ++i) {
            const int a = element.nodes[i], b = element.nodes[(i + 1) % element.size()];
            if (edges.erase({b, a}) == 0) ++edges[{a, b}];
        }
    return edges;
}

int chain_edges_found(const NodeChain& chain, const std::map<std::pair<int, int>, int>& open)
{
    int found = 0;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) found += static_cast<int>(open.count({chain[i], chain[i + 1]}));
    return found;
}

// Every open edge belongs to one of the named chains, in the counter-clockwise order the chains promise: no hanging
// node anywhere, the joining rows and the curtain's columns included.
void expect_conforming(const Mesh& mesh)
{
    const auto open = open_edges(mesh);
    NodeChain base = mesh.contact.dam_nodes, rock_base = mesh.contact.rock_nodes;
    std::reverse(rock_base.begin(), rock_base.end());
    int found = 0, wanted = 0;
    for (const NodeChain& chain : {base, rock_base, mesh.upstream_face, mesh.downstream_face, mesh.crest, mesh.floor,
                                   mesh.ground, mesh.box_left, mesh.box_right, mesh.box_bottom}) {
        found += chain_edges_found(chain, open);
        wanted += chain.empty() ? 0 : static_cast<int>(chain.size()) - 1;
    }
    EXPECT_EQ(found, wanted);
    EXPECT_EQ(open.size(), static_cast<std::size_t>(found));
}

TEST(FeMesh, reference_dam_on_rock_is_conforming_and_fills_its_areas)
{
    const Scene scene = test::reference_dam_on_rock();
    const Mesh mesh = build_mesh(scene);
    expect_conforming(mesh);
    EXPECT_NEAR(region_area(mesh, Region::dam), 1599.75, 1e-9);
    EXPECT_NEAR(region_area(mesh, Region::curtain), 30.0, 1e-10);
    EXPECT_NEAR(region_area(mesh, Region::rock) + region_area(mesh, Region::curtain), 30000.0, 1e-8);
}

TEST(FeMesh, pairs_of_the_contact_plane_match_and_the_rock_line_goes_on_past_heel_and_toe)
{
    const Mesh mesh = build_mesh(test::reference_dam_on_rock(), {.upstream = 0.5, .downstream = 3.0});
    const ContactPlane& plane = mesh.contact;
    ASSERT_EQ(plane.dam_nodes.size(), plane.rock_nodes.size());
    for (std::size_t i = 0; i < plane.dam_nodes.size(); ++i) {
        EXPECT_NE(plane.dam_nodes[i], plane.rock_nodes[i]);
        EXPECT_EQ(mesh.nodes[plane.dam_nodes[i]], mesh.nodes[plane.rock_nodes[i]]);
        EXPECT_NEAR(mesh.nodes[plane.dam_nodes[i]].x, plane.distance[i], 1e-12);
    }
    EXPECT_LE(plane.rock_distance.front(), -0.5);
    EXPECT_GE(plane.rock_distance.back(), 48.0);
    for (std::size_t i = 0; i + 1 < plane.rock_distance.size(); ++i)
        EXPECT_LE(plane.rock_distance[i + 1] - plane.rock_distance[i],
                  1.0 + 1e-12); // 1 m: the curtain's column; 0.75 m asked for
}

// A curtain of the rock's stiffness is rock, node for node; the flow needs its lines only where it is tighter.
TEST(FeMesh, curtain_of_the_rock_s_stiffness_adds_no_mesh_lines)
{
    Scene scene = test::reference_dam_on_rock();
    const Curtain curtain = *scene.curtain;
    scene.curtain.reset();
    const Mesh without = build_mesh(scene);
    const auto same = [&](const Mesh& mesh) {
        return std::equal(mesh.nodes.begin(), mesh.nodes.end(), without.nodes.begin(), without.nodes.end(),
                          [](Point a, Point b) { return a.x == b.x && a.y == b.y; });
    };
    scene.curtain = curtain;
    EXPECT_FALSE(same(build_mesh(scene)));
    scene.curtain->young_modulus = scene.foundation->material.young_modulus;
    EXPECT_TRUE(same(build_mesh(scene)));
    scene.curtain->poisson_ratio = 0.25;
    EXPECT_FALSE(same(build_mesh(scene)));
    scene.curtain->young_modulus.reset();
    EXPECT_TRUE(same(build_mesh(scene)));
    scene.stages.pore_pressure = PorePressure::effective;
    EXPECT_FALSE(same(build_mesh(scene)));
    scene.curtain->permeability = scene.foundation->permeability;
    EXPECT_TRUE(same(build_mesh(scene)));
}

TEST(FeMesh, curtain_sides_and_foot_are_mesh_lines)
{
    const Mesh mesh = build_mesh(test::reference_dam_on_rock());
    double left = HUGE_VAL, right = -HUGE_VAL, foot = HUGE_VAL;
    for (const Element& element : mesh.elements)
        if (element.region == Region::curtain)
            for (const Point p : corners(mesh, element)) {
                left = std::min(left, p.x);
                right = std::max(right, p.x);
                foot = std::min(foot, p.y);
            }
    EXPECT_NEAR(left, 7.0, 1e-12);
    EXPECT_NEAR(right, 8.0, 1e-12);
    EXPECT_NEAR(foot, -30.0, 1e-12);
}

TEST(FeMesh, quality_of_the_reference_mesh)
{
    const MeshQuality quality = measure_quality(build_mesh(test::reference_dam()));
    EXPECT_EQ(quality.triangles, 0);
    EXPECT_GT(quality.smallest_scaled_jacobian, 0.4);
    EXPECT_GT(quality.smallest_angle, 25.0 * M_PI / 180.0);
    EXPECT_LT(quality.largest_aspect, 4.0);
}

TEST(FeMesh, a_section_that_ends_in_a_point_ends_in_triangles)
{
    Scene scene = test::reference_dam();
    scene.section.polygon = {{0, 0}, {45, 0}, {0, 62.5}};
    const Mesh mesh = build_mesh(scene);
    expect_conforming(mesh);
    EXPECT_NEAR(region_area(mesh, Region::dam), area(scene.section), 1e-9);
    EXPECT_GT(measure_quality(mesh).triangles, 0);
    EXPECT_EQ(mesh.crest.size(), 1u);
}

TEST(FeMesh, both_faces_sloping_with_kinks_of_their_own)
{
    Scene scene = test::reference_dam_on_rock();
    scene.section.polygon = {{0, 0}, {60, 0}, {30, 30}, {20, 45}, {18, 60}, {9, 60}, {8, 40}, {4, 12}};
    const Mesh mesh = build_mesh(scene);
    expect_conforming(mesh);
    EXPECT_NEAR(region_area(mesh, Region::dam), area(scene.section), 1e-9);
    for (const Point kink :
         scene.section.polygon) // each vertex is a node: the area above would not tell a cut corner from a bulge
        EXPECT_TRUE(std::any_of(mesh.nodes.begin(), mesh.nodes.end(),
                                [&](Point p) { return std::hypot(p.x - kink.x, p.y - kink.y) < 1e-9; }));
}

TEST(FeMesh, inclined_base_on_rock)
{
    for (const double toe_y : {-4.0, 3.0}) {
        Scene scene = test::reference_dam_on_rock();
        scene.section.polygon[1].y = toe_y;
        const Mesh mesh = build_mesh(scene);
        expect_conforming(mesh);
        EXPECT_NEAR(region_area(mesh, Region::dam), area(scene.section), 1e-9);
        EXPECT_NEAR(mesh.contact.distance.back(), std::hypot(45.0, toe_y), 1e-12);
        const ContactPlane& plane = mesh.contact;
        for (std::size_t i = 0; i < plane.dam_nodes.size(); ++i) {
            EXPECT_NEAR(mesh.nodes[plane.dam_nodes[i]].x, mesh.nodes[plane.rock_nodes[i]].x, 1e-12);
            EXPECT_NEAR(mesh.nodes[plane.dam_nodes[i]].y, mesh.nodes[plane.rock_nodes[i]].y, 1e-12);
        }
    }
}

TEST(FeMesh, block_with_a_crest_parallel_to_its_inclined_base)
{
    Scene scene = test::reference_dam();
    scene.section.polygon = {{0, 0}, {10, -2}, {10, 3}, {0, 5}};
    const Mesh mesh = build_mesh(scene);
    expect_conforming(mesh);
    EXPECT_NEAR(region_area(mesh, Region::dam), 50.0, 1e-10);
    EXPECT_EQ(measure_quality(mesh).triangles, 0);
}

TEST(FeMesh, triangles_on_request_fill_the_same_areas)
{
    Scene scene = test::reference_dam_on_rock();
    scene.mesh.element = ElementKind::t3;
    const Mesh mesh = build_mesh(scene);
    expect_conforming(mesh);
    EXPECT_EQ(measure_quality(mesh).quadrilaterals, 0);
    EXPECT_NEAR(region_area(mesh, Region::dam), 1599.75, 1e-9);
    EXPECT_EQ(mesh.elements[mesh.dam_element_count - 1].region, Region::dam);
    EXPECT_NE(mesh.elements[mesh.dam_element_count].region, Region::dam);
}

TEST(FeMesh, contact_size_sets_the_number_of_base_elements)
{
    Scene scene = test::reference_dam();
    scene.mesh.contact_size = 0.5;
    EXPECT_EQ(build_mesh(scene).contact.dam_nodes.size(), 91u);
}

// h(d) = h0 + d ln g makes neighbouring sizes differ by exactly g: positions h0 (g^n - 1) / ln g.
TEST(FeMesh, grading_is_geometric_and_its_inverse_is_exact)
{
    const Grading grading{.first = 0.5, .growth = 1.2, .largest = 4.0};
    for (const double d : {0.0, 0.3, 2.0, 19.0, 50.0})
        EXPECT_NEAR(grading.distance_after(grading.elements_to(d)), d, 1e-12 * (1 + d));
    const double a = grading.distance_after(1), b = grading.distance_after(2), c = grading.distance_after(3);
    EXPECT_NEAR((c - b) / (b - a), 1.2, 1e-12);
    const auto positions = graded_positions({0.0, 7.0, 30.0}, grading);
    EXPECT_EQ(std::count(positions.begin(), positions.end(), 7.0), 1);
    EXPECT_EQ(positions.back(), 30.0);
}

// The water's nodes on the face lie on the dam's, the chains close the outline with the water on their left, the area is that of the
// polygon: level x length plus the triangle over an inclined face.
TEST(FeMesh, reservoir_block_sits_on_the_face)
{
    for (const double lean : {0.0, 6.0}) {
        Scene scene = test::reference_dam();
        scene.section.polygon[4].x = lean;
        scene.reservoir = Reservoir{};
        scene.reservoir->level = 57.3;
        scene.reservoir->length = 150.0;
        const ReservoirMesh water = build_reservoir_mesh(scene);
        EXPECT_NEAR(water.depth, 57.3, 1e-9);
        EXPECT_EQ(water.face.size(), 21u);
        for (const int node : water.face) {
            const Point p = water.mesh.nodes[node];
            EXPECT_NEAR(p.x, lean * p.y / 62.5, 1e-9);
        }
        EXPECT_NEAR(region_area(water.mesh, Region::reservoir), 57.3 * 150.0 + 0.5 * 57.3 * lean * 57.3 / 62.5, 1e-8);
        const auto open = open_edges(water.mesh);
        std::size_t found = 0;
        for (const NodeChain& chain : {water.face, water.surface, water.far_end, water.bottom})
            found += static_cast<std::size_t>(chain_edges_found(chain, open));
        EXPECT_EQ(found, open.size());
    }
}

TEST(FeMesh, water_above_the_crest_stands_over_its_upstream_end)
{
    Scene scene = test::reference_dam();
    scene.reservoir = Reservoir{};
    scene.reservoir->level = 66.0;
    const ReservoirMesh water = build_reservoir_mesh(scene);
    EXPECT_NEAR(water.depth, 66.0, 1e-9);
    const bool crest_is_a_node = std::any_of(water.face.begin(), water.face.end(), [&](int node) {
        return water.mesh.nodes[node] == Point{0.0, 62.5};
    });
    EXPECT_TRUE(crest_is_a_node);
    EXPECT_NEAR(region_area(water.mesh, Region::reservoir), 66.0 * 2.4 * 66.0, 1e-8);
}

// A sweep over sections nobody picked by hand: kinks on both faces, batter, inclined base, pointed and wide crests, curtains, levels.
// Each mesh must conform, fill its section and hold every vertex as a node.
TEST(FeMesh, many_sections)
{
    std::uint32_t state = 12345;
    const auto between = [&](double low, double high) {
        state = 1664525u * state + 1013904223u;
        return low + (high - low) * (state >> 8) / 16777216.0;
    };
    for (int k = 0; k < 60; ++k) {
        Scene scene = test::reference_dam();
        const double height = between(5, 200), base = height * between(0.5, 1.2),
                     batter = k % 2 ? base * between(0, 0.2) : 0.0;
        const double crest = k % 5 ? base * between(0.05, 0.3) : 0.0, toe_y = k % 3 ? 0.0 : height * between(-0.1, 0.1);
        const double kink = between(0.2, 0.9), upstream_kink = between(0.2, 0.8), bulge = between(0.9, 1.1);
        const double crest_end = batter + crest;
        scene.section.polygon = {
            {0, 0}, {base, toe_y}, {base + (crest_end - base) * kink * bulge, toe_y + kink * (height - toe_y)}};
        if (crest > 0.0) scene.section.polygon.push_back({crest_end, height});
        scene.section.polygon.push_back({batter, height});
        if (batter > 0.0)
            scene.section.polygon.push_back({batter * std::min(1.0, 1.2 * upstream_kink), upstream_kink * height});
        if (k % 4 < 2) {
            scene.foundation = Foundation{
                .material = {0.0, 30e9, 0.2}, .mass = RockMass::massless, .width = 4.0 * base, .depth = 1.5 * height};
            if (k % 4 == 1)
                scene.curtain = Curtain{.distance = between(0, 0.3) * base,
                                        .depth = between(0.1, 0.6) * height,
                                        .thickness = between(0.3, 2),
                                        .young_modulus = 27e9};
        }
        SCOPED_TRACE(k);
        const Mesh mesh = build_mesh(scene, {.upstream = between(0, 2), .downstream = between(0, 5)});
        expect_conforming(mesh);
        EXPECT_NEAR(region_area(mesh, Region::dam), area(scene.section), 1e-10 * area(scene.section));
        for (const Point v : scene.section.polygon)
            EXPECT_TRUE(std::any_of(mesh.nodes.begin(), mesh.nodes.end(),
                                    [&](Point p) { return std::hypot(p.x - v.x, p.y - v.y) < 1e-9 * height; }));
    }
}

} // namespace
