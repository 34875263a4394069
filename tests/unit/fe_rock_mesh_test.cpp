// The rock's side of the contact plane with an element size of its own.
#include "fe2d/assembly/assemble.hpp"
#include "fe2d/mesh/faces.hpp"
#include "fe2d/model/model.hpp"
#include "fe_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace damslip;
using namespace damslip::fe2d;

Scene rock_scene(double rock_size)
{
    Scene scene = test::reference_dam_on_rock();
    scene.mesh.contact_size = 0.75;
    if (rock_size > 0.0) scene.mesh.rock_contact_size = rock_size;
    return scene;
}

TEST(FeRockMesh, HasItsOwnNodesFromHeelToToe)
{
    for (const double size : {1.125, 0.5, 1.0 / std::acos(-1.0), 3.0}) {
        const Mesh mesh = build_mesh(rock_scene(size), {.upstream = 0.5, .downstream = 3.0});
        const ContactPlane& plane = mesh.contact;
        EXPECT_FALSE(plane.matching);
        ASSERT_EQ(plane.rock_nodes.size(), plane.rock_node_distance.size());
        EXPECT_EQ(plane.dam_nodes.size(), 60u); // 9 + 1 + 49 elements between heel, curtain and toe
        // The curtain's sides, 7 and 8 m from the heel, are nodes of the rock in any case.
        const double elements = std::max(1.0, std::round(7 / size)) + std::max(1.0, std::round(1 / size)) +
                                std::max(1.0, std::round(37 / size));
        EXPECT_EQ(static_cast<double>(plane.rock_nodes.size()), elements + 1) << size;
        EXPECT_EQ(mesh.nodes[plane.rock_nodes.front()], mesh.nodes[plane.dam_nodes.front()]);
        EXPECT_EQ(mesh.nodes[plane.rock_nodes.back()], mesh.nodes[plane.dam_nodes.back()]);
        EXPECT_EQ(plane.rock_node_distance.front(), plane.distance.front());
        EXPECT_EQ(plane.rock_node_distance.back(), plane.distance.back());
        for (std::size_t i = 0; i < plane.rock_nodes.size(); ++i)
            EXPECT_NEAR(mesh.nodes[plane.rock_nodes[i]].x, plane.rock_node_distance[i], 1e-12);
        // The rock's nodes are those of the line of the whole plane between heel and toe.
        EXPECT_NE(std::search(plane.rock_line.begin(), plane.rock_line.end(), plane.rock_nodes.begin(),
                              plane.rock_nodes.end()),
                  plane.rock_line.end());
        EXPECT_LE(plane.rock_distance.front(), -0.5);
        EXPECT_GE(plane.rock_distance.back(), 48.0);
        EXPECT_GT(measure_quality(mesh).smallest_scaled_jacobian, 0.3);
    }
}

TEST(FeRockMesh, FacesTheDamNodeByNodeUnlessTheSceneSaysOtherwise)
{
    const ContactPlane plane = build_mesh(rock_scene(0.0)).contact;
    EXPECT_TRUE(plane.matching);
    EXPECT_EQ(plane.rock_node_distance, plane.distance);
}

// The pressure of the water in the joint is the same function on both sides: equal and opposite forces and moments,
// whatever the nodes; and those of the profile, 1/2 (7 + 45) p: exact integrals, round-off only.
TEST(FeRockMesh, UpliftOnBothSidesIsEqualAndOpposite)
{
    const double p = 6e5;
    const PressureProfile profile{{{0.0, p}, {7.0, p}, {7.0, 0.4 * p}, {45.0, 0.0}}};
    const double force = 7 * p + 0.5 * 38 * 0.4 * p;
    const double moment = p * 7 * 3.5 + 0.5 * 38 * 0.4 * p * (7 + 38.0 / 3);
    for (const double size : {0.0, 1.125, 1.0 / std::acos(-1.0)}) {
        Scene scene = rock_scene(size);
        scene.curtain.reset();
        const Mesh mesh = build_mesh(scene);
        const DofMap dofs = displacement_dofs(mesh, Base::separate);
        const auto resultant = [&](ContactSide side, const std::vector<int>& nodes) {
            const Eigen::VectorXd load = uplift_load(mesh, dofs, profile, side);
            Eigen::Vector3d sum = Eigen::Vector3d::Zero();
            for (const int n : nodes)
                sum += Eigen::Vector3d(load[dofs(n, 0)], load[dofs(n, 1)], mesh.nodes[n].x * load[dofs(n, 1)]);
            return sum;
        };
        const Eigen::Vector3d on_dam = resultant(ContactSide::dam, mesh.contact.dam_nodes);
        const Eigen::Vector3d on_rock = resultant(ContactSide::rock, mesh.contact.rock_nodes);
        EXPECT_NEAR(on_dam[1], force, 1e-12 * force);
        EXPECT_NEAR(on_dam[2], moment, 1e-12 * moment);
        EXPECT_NEAR((on_dam + on_rock).norm(), 0.0, 1e-12 * moment);
    }
}

// A tied base shares the unknowns of facing nodes: the model is that of the scene without the key.
TEST(FeRockMesh, TiedModelsKeepFacingNodes)
{
    const Model own = build_model(rock_scene(1.125)), facing = build_model(rock_scene(0.0));
    EXPECT_TRUE(own.mesh.contact.matching);
    EXPECT_EQ(own.dofs.count, facing.dofs.count);
    EXPECT_EQ((own.stiffness - facing.stiffness).norm(), 0.0);
    const Model separate = build_model(rock_scene(1.125), {.base = Base::separate});
    EXPECT_FALSE(separate.mesh.contact.matching);
}

} // namespace
