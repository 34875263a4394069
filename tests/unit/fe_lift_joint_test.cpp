// Lift joints in the mesh and the unknowns: nodes twice, faces through both, tied = uncracked.
#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/mesh/build_mesh.hpp"
#include "fe2d/mesh/faces.hpp"
#include "fe2d/model/model.hpp"
#include "fe_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace {

using namespace damslip;
using namespace damslip::fe2d;

LiftJoint lift_at(double elevation)
{
    LiftJoint joint;
    joint.name = "joint";
    joint.elevation = elevation;
    joint.strength.friction = 0.8;
    return joint;
}

Scene cracked(Scene scene, const std::vector<double>& elevations)
{
    for (const double y : elevations) scene.lift_joints.push_back(lift_at(y));
    return scene;
}

double lift_mesh_area(const Mesh& mesh, int first, int last)
{
    double twice = 0.0;
    for (int e = first; e < last; ++e) {
        const auto p = corners(mesh, mesh.elements[e]);
        const int n = mesh.elements[e].size();
        for (int i = 0; i < n; ++i) twice += p[i].x * p[(i + 1) % n].y - p[(i + 1) % n].x * p[i].y;
    }
    return 0.5 * twice;
}

/// A chain goes through a joint by its two nodes, which are neighbours in it.
void expect_passes(const NodeChain& chain, int first, int second)
{
    const auto at = std::find(chain.begin(), chain.end(), first);
    ASSERT_NE(at, chain.end());
    ASSERT_NE(at + 1, chain.end());
    EXPECT_EQ(*(at + 1), second);
}

void expect_joint(const Mesh& mesh, const LiftPlane& lift, double elevation)
{
    ASSERT_GE(lift.lower_nodes.size(), 2u);
    ASSERT_EQ(lift.lower_nodes.size(), lift.upper_nodes.size());
    ASSERT_EQ(lift.lower_nodes.size(), lift.distance.size());
    for (std::size_t i = 0; i < lift.lower_nodes.size(); ++i) {
        const Point p = mesh.nodes[lift.lower_nodes[i]];
        EXPECT_NE(lift.lower_nodes[i], lift.upper_nodes[i]);
        EXPECT_EQ(p, mesh.nodes[lift.upper_nodes[i]]); // the same bits
        EXPECT_NEAR(p.y, elevation, 1e-12);
        EXPECT_NEAR(lift.distance[i], p.x - mesh.nodes[lift.lower_nodes.front()].x, 1e-13);
        if (i) {
            EXPECT_GT(lift.distance[i], lift.distance[i - 1]);
        }
    }
    expect_passes(mesh.upstream_face, lift.upper_nodes.front(), lift.lower_nodes.front());
    expect_passes(mesh.downstream_face, lift.lower_nodes.back(), lift.upper_nodes.back());
    // No element has nodes of both sides.
    const std::set<int> lower(lift.lower_nodes.begin(), lift.lower_nodes.end());
    const std::set<int> upper(lift.upper_nodes.begin(), lift.upper_nodes.end());
    for (const Element& element : mesh.elements) {
        int below = 0, above = 0;
        for (int i = 0; i < element.size(); ++i) {
            below += static_cast<int>(lower.count(element.nodes[i]));
            above += static_cast<int>(upper.count(element.nodes[i]));
        }
        EXPECT_TRUE(below == 0 || above == 0);
    }
}

TEST(FeLiftJoint, SplitsTheMeshOnARowAndChangesNothingElse)
{
    for (const ElementKind kind : {ElementKind::q4_incompatible, ElementKind::t3}) {
        Scene plain = test::reference_dam_on_rock();
        plain.mesh.element = kind;
        const Mesh whole = build_mesh(plain), split = build_mesh(cracked(plain, {51.5}));
        ASSERT_EQ(split.lifts.size(), 1u);
        const LiftPlane& lift = split.lifts.front();
        expect_joint(split, lift, 51.5);
        const int twice = static_cast<int>(lift.upper_nodes.size());
        EXPECT_EQ(split.dam_node_count, whole.dam_node_count + twice); // 51.5 m is a kink: a row of nodes anyway
        EXPECT_EQ(split.node_count(), whole.node_count() + twice);
        EXPECT_EQ(split.element_count(), whole.element_count());
        EXPECT_EQ(split.dam_element_count, whole.dam_element_count);
        EXPECT_EQ(split.upstream_face.size(), whole.upstream_face.size() + 1);
        EXPECT_NEAR(lift_mesh_area(split, 0, split.dam_element_count), 1599.75, 1e-9);
        EXPECT_NEAR(lift.distance.back(), 12.0, 1e-12);
        for (int e = 0; e < whole.element_count(); ++e) {
            const auto a = corners(whole, whole.elements[e]), b = corners(split, split.elements[e]);
            for (int i = 0; i < 4; ++i) ASSERT_NEAR(std::hypot(a[i].x - b[i].x, a[i].y - b[i].y), 0.0, 1e-11);
        }
    }
}

TEST(FeLiftJoint, SeveralJointsFromTheBottomUp)
{
    const Scene scene = cracked(test::reference_dam_on_rock(), {8.0, 30.3, 51.5, 57.0});
    const Mesh mesh = build_mesh(scene);
    ASSERT_EQ(mesh.lifts.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) expect_joint(mesh, mesh.lifts[i], scene.lift_joints[i].elevation);
    EXPECT_NEAR(lift_mesh_area(mesh, 0, mesh.dam_element_count), 1599.75, 1e-9);
    EXPECT_GT(measure_quality(mesh).smallest_scaled_jacobian, 0.3);
}

// Elements along a joint whose bond breaks by its energy are a quarter of E' G/f^2 or shorter (Bazant & Oh 1983), at one joint and at
// three; the dam is still filled once, and the mesh conforms: no stress in a body that only moves is seen by the other tests.
TEST(FeLiftJoint, MeshesABondByItsProcessZone)
{
    for (const std::vector<double>& elevations :
         {std::vector<double>{51.5}, std::vector<double>{30.0, 51.5}, std::vector<double>{20.0, 23.0, 51.5}}) {
        Scene scene = cracked(test::reference_dam_on_rock(), elevations);
        for (LiftJoint& joint : scene.lift_joints) {
            joint.strength.bond.loss = BondLoss::fracture;
            joint.strength.bond.tensile_strength = 2.4e6;
            joint.strength.bond.tension_energy = 200.0;
        }
        const double size = lift_mesh_size(scene, scene.lift_joints.front());
        const double modulus = *scene.dam.young_modulus / (1.0 - scene.dam.poisson_ratio * scene.dam.poisson_ratio);
        EXPECT_NEAR(size, modulus * 200.0 / (4.0 * 2.4e6 * 2.4e6), 1e-12 * size);
        const Mesh mesh = build_mesh(scene);
        ASSERT_EQ(mesh.lifts.size(), elevations.size());
        for (std::size_t i = 0; i < elevations.size(); ++i) {
            expect_joint(mesh, mesh.lifts[i], elevations[i]);
            const std::vector<double>& at = mesh.lifts[i].distance;
            for (std::size_t k = 1; k < at.size(); ++k) EXPECT_LT(at[k] - at[k - 1], 1.05 * size); // columns are not quite even
            EXPECT_LT(at.back() / static_cast<double>(at.size() - 1), size * (1.0 + 1e-9));
        }
        EXPECT_NEAR(lift_mesh_area(mesh, 0, mesh.dam_element_count), 1599.75, 1e-9);
        EXPECT_GT(measure_quality(mesh).smallest_scaled_jacobian, 0.2);
    }
}

// The base dips 5 degrees and the crest rises: rows between them are blended, the joint is level all the same.
TEST(FeLiftJoint, IsLevelAboveAnInclinedBase)
{
    Scene scene = test::reference_dam();
    scene.section.polygon = {
        {0, 0}, {45, -45 * std::tan(5 * std::acos(-1.0) / 180)}, {12, 51.5}, {12, 62.5}, {0, 62.5}};
    const Scene split = cracked(scene, {20.0, 51.5});
    const Mesh mesh = build_mesh(split), whole = build_mesh(scene);
    ASSERT_EQ(mesh.lifts.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) expect_joint(mesh, mesh.lifts[i], split.lift_joints[i].elevation);
    EXPECT_NEAR(lift_mesh_area(mesh, 0, mesh.dam_element_count), lift_mesh_area(whole, 0, whole.dam_element_count),
                1e-9);
}

TEST(FeLiftJoint, TiedNodesShareTheirUnknownsSeparateOnesDoNot)
{
    const Scene plain = test::reference_dam_on_rock(), scene = cracked(plain, {30.3, 51.5});
    const Mesh mesh = build_mesh(scene);
    const DofMap tied = displacement_dofs(mesh, Base::tied), separate = displacement_dofs(mesh, Base::separate);
    int pairs = 0;
    for (const LiftPlane& lift : mesh.lifts)
        for (std::size_t i = 0; i < lift.upper_nodes.size(); ++i, ++pairs)
            for (const int c : {0, 1}) {
                EXPECT_EQ(tied(lift.upper_nodes[i], c), tied(lift.lower_nodes[i], c));
                EXPECT_NE(separate(lift.upper_nodes[i], c), separate(lift.lower_nodes[i], c));
            }
    EXPECT_EQ(separate.count, tied.count + 2 * pairs + 2 * static_cast<int>(mesh.contact.dam_nodes.size()));
    EXPECT_EQ(dam_dof_count(mesh, separate), 2 * mesh.dam_node_count);
    EXPECT_EQ(dam_dof_count(mesh, tied), 2 * (mesh.dam_node_count - pairs));
    EXPECT_EQ(*std::max_element(tied.dofs.begin(), tied.dofs.end()) + 1, tied.count); // no gaps
}

// 51.5 m is a row of both meshes: with the joint tied they are the same structure, loads and water included. Round-off
// of solves with a condition number of 1e6 is all that may differ.
TEST(FeLiftJoint, TiedModelIsTheUncrackedDam)
{
    Scene plain = test::reference_dam_on_rock();
    plain.reservoir = Reservoir{.level = 60.0};
    plain.tailwater = Tailwater{.level = 54.0};
    plain.silt = Silt{.level = 55.0, .submerged_unit_weight = 9000.0, .pressure_coefficient = 0.5};
    plain.ice = Ice{.force = 1e5, .level = 51.5};
    const Scene scene = cracked(plain, {51.5});
    ModelOptions options;
    options.added_mass = [](Point p, double) { return 875.0 * std::sqrt(60.0 * std::max(0.0, 60.0 - p.y)); };
    const Model whole = build_model(plain, options), tied = build_model(scene, options);
    ASSERT_EQ(whole.dofs.count, tied.dofs.count);
    EXPECT_NEAR(tied.total_mass[0], whole.total_mass[0], 1e-10 * whole.total_mass[0]);
    EXPECT_NEAR(tied.inertia_x.sum(), whole.inertia_x.sum(), 1e-10 * whole.inertia_x.sum());
    EXPECT_EQ(tied.counts.unknowns, whole.counts.unknowns);
    EXPECT_EQ(tied.counts.nonzeros, whole.counts.nonzeros);
    const StaticSolution a = solve_static(plain, whole, static_loads(plain, whole));
    const StaticSolution b = solve_static(scene, tied, static_loads(scene, tied));
    ASSERT_EQ(a.stages.size(), b.stages.size());
    const Eigen::VectorXd &u = a.stages.back().displacement, &v = b.stages.back().displacement;
    ASSERT_TRUE(v.allFinite());
    for (const int n : {0, 1}) {
        const int p = whole.mesh.crest[static_cast<std::size_t>(n)], q = tied.mesh.crest[static_cast<std::size_t>(n)];
        for (const int c : {0, 1})
            EXPECT_NEAR(v[tied.dofs(q, c)], u[whole.dofs(p, c)], 1e-10 * u.cwiseAbs().maxCoeff());
    }
    EXPECT_NEAR(v.norm(), u.norm(), 1e-10 * u.norm());
    EXPECT_NEAR((b.stages.back().resultant - a.stages.back().resultant).norm(), 0.0,
                1e-10 * a.stages.back().resultant.norm());
}

Eigen::Vector3d lift_resultant(const Mesh& mesh, const DofMap& dofs, const std::vector<int>& nodes,
                               const Eigen::VectorXd& load)
{
    Eigen::Vector3d sum = Eigen::Vector3d::Zero(); // x, y, moment about the upstream end, counter-clockwise
    for (const int n : nodes) {
        const double fx = load[dofs(n, 0)], fy = load[dofs(n, 1)];
        sum += Eigen::Vector3d(fx, fy, (mesh.nodes[n].x - mesh.nodes[nodes.front()].x) * fy);
    }
    return sum;
}

// Water at 60 m over a joint at 51.5 m, dry downstream: a triangle of 8.5 m head over 12 m, 1/2 p L up at L/3 from the
// upstream face; with 3 m of tailwater over the joint a trapezoid. Both faces, equal and opposite; nothing when tied.
TEST(FeLiftJoint, WaterPressesOnBothFacesWithTheResultantOfItsProfile)
{
    Scene scene = cracked(test::reference_dam_on_rock(), {51.5});
    scene.reservoir = Reservoir{.level = 60.0};
    const Mesh mesh = build_mesh(scene);
    const LiftPlane& lift = mesh.lifts.front();
    const DofMap separate = displacement_dofs(mesh, Base::separate), tied = displacement_dofs(mesh, Base::tied);
    EXPECT_TRUE(lift_water_profile(scene, scene.lift_joints[0], 12.0).empty()); // water = none
    scene.lift_joints[0].water = JointWater::linear;
    for (const double tail : {0.0, 3.0}) {
        scene.tailwater = Tailwater{.level = 51.5 + tail};
        const double p = 9810.0 * 8.5, q = 9810.0 * tail, length = 12.0;
        const PressureProfile profile = lift_water_profile(scene, scene.lift_joints[0], length);
        ASSERT_EQ(profile.points.size(), 2u);
        EXPECT_NEAR(profile.points[0].pressure, p, 1e-9);
        EXPECT_NEAR(profile.points[1].pressure, q, 1e-9);
        const Eigen::VectorXd load = lift_water_load(mesh, separate, 0, profile);
        const Eigen::Vector3d up = lift_resultant(mesh, separate, lift.upper_nodes, load);
        EXPECT_NEAR(up[0], 0.0, 1e-9);
        EXPECT_NEAR(up[1], 0.5 * (p + q) * length, 1e-12 * p * length);
        EXPECT_NEAR(up[2], (p + 2 * q) * length * length / 6, 1e-12 * p * length * length);
        EXPECT_NEAR((up + lift_resultant(mesh, separate, lift.lower_nodes, load)).norm(), 0.0, 1e-9 * up.norm());
        EXPECT_NEAR(lift_water_load(mesh, tied, 0, profile).norm(), 0.0, 1e-9 * load.norm());
    }
    scene.reservoir->level = 51.5;
    scene.tailwater->level = 20.0;
    EXPECT_TRUE(lift_water_profile(scene, scene.lift_joints[0], 12.0).empty()); // dry on both faces
}

} // namespace
