// Pore pressure as forces: the total and the effective form are the same.
#include "fe2d/assembly/assemble.hpp"
#include "fe2d/mesh/build_mesh.hpp"
#include "fe2d/seepage/seepage.hpp"
#include "fe_scenes.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;
using Eigen::VectorXd;

Scene wet_dam(ElementKind kind)
{
    Scene scene = fe2d::test::reference_dam_on_rock();
    scene.reservoir = Reservoir{.level = 62.5};
    scene.tailwater = Tailwater{.level = 4.0};
    scene.mesh.element = kind;
    scene.mesh.size = 4.0;
    return scene;
}

struct Fields {
    fe2d::Mesh mesh;
    VectorXd pressure;
};

Fields fields(const Scene& scene)
{
    const auto result = fe2d::solve_seepage_on(fe2d::build_mesh(scene), scene, scene_uplift_state(scene));
    return {result.mesh, fe2d::excess_pore_pressure(result.field.head, result.unit_weight)};
}

// Divergence theorem in every element; the forces are of the order of γ_w h times an element side. Displacements of the
// dam on the rock follow: the same to round-off of the solution (condition about 1e6).
TEST(FeSeepageForces, total_and_effective_form_give_the_same_field)
{
    for (const ElementKind kind : {ElementKind::q4_incompatible, ElementKind::q4, ElementKind::t3, ElementKind::q8,
                                   ElementKind::q9, ElementKind::t6}) {
        const Scene scene = wet_dam(kind);
        const Fields f = fields(scene);
        for (const fe2d::Base base : {fe2d::Base::tied, fe2d::Base::separate}) {
            const fe2d::DofMap dofs = fe2d::displacement_dofs(f.mesh, base);
            const VectorXd total = fe2d::pore_pressure_loads(f.mesh, dofs, f.pressure, PorePressure::total);
            const VectorXd effective = fe2d::pore_pressure_loads(f.mesh, dofs, f.pressure, PorePressure::effective);
            EXPECT_LT((total - effective).cwiseAbs().maxCoeff(), 1e-12 * total.cwiseAbs().maxCoeff());
            EXPECT_GT(total.norm(), 0.0);
            if (base == fe2d::Base::separate) continue; // the dam floats
            fe2d::LinearSolver solver;
            ASSERT_TRUE(solver.factorise(fe2d::stiffness_matrix(f.mesh, dofs, fe2d::materials_of(scene))).ok());
            const VectorXd a = solver.solve(total), b = solver.solve(effective);
            EXPECT_LT((a - b).norm(), 1e-11 * a.norm());
        }
    }
}

// Still water at the heel's level and nothing else: no excess pressure, no force. Uniform excess pressure in an
// unloaded block: every rock node of the inside is in balance in form (a); form (b) has no force at all.
TEST(FeSeepageForces, uniform_pressure_does_nothing_inside)
{
    const Fields f = fields(wet_dam(ElementKind::q4));
    const fe2d::DofMap dofs = fe2d::displacement_dofs(f.mesh, fe2d::Base::separate);
    const VectorXd uniform = VectorXd::Constant(f.mesh.node_count(), 1e5);
    const VectorXd body = fe2d::seepage_body_force(f.mesh, dofs, uniform);
    EXPECT_LT(body.cwiseAbs().maxCoeff(), 1e-8);
    const VectorXd total = fe2d::pore_pressure_force(f.mesh, dofs, uniform);
    for (int node = f.mesh.dam_node_count; node < f.mesh.node_count(); ++node) {
        const Point p = f.mesh.nodes[node];
        if (p.y > -1e-6 || p.y < -99.0) continue;
        for (int c : {0, 1})
            if (dofs(node, c) != fe2d::no_dof) {
                ASSERT_LT(std::abs(total[dofs(node, c)]), 1e-8 * 1e5);
            }
    }
    EXPECT_EQ(fe2d::excess_pore_pressure(VectorXd::Zero(3), 9810.0).norm(), 0.0);
}

// The resultant of uplift on the dam is its integral; on a tied base it cancels against the rock's face.
TEST(FeSeepageForces, uplift_on_both_faces)
{
    const Fields f = fields(wet_dam(ElementKind::q4));
    const fe2d::DofMap apart = fe2d::displacement_dofs(f.mesh, fe2d::Base::separate);
    const VectorXd force = fe2d::pore_pressure_loads(f.mesh, apart, f.pressure, PorePressure::none);
    double up = 0.0, down = 0.0, integral = 0.0;
    const auto& contact = f.mesh.contact;
    for (std::size_t i = 0; i < contact.dam_nodes.size(); ++i) {
        up += force[apart(contact.dam_nodes[i], 1)];
        down += force[apart(contact.rock_nodes[i], 1)];
        if (i > 0)
            integral += 0.5 * (f.pressure[contact.rock_nodes[i]] + f.pressure[contact.rock_nodes[i - 1]]) *
                        (contact.distance[i] - contact.distance[i - 1]);
    }
    EXPECT_NEAR(up, integral, 1e-12 * integral);
    EXPECT_NEAR(down, -integral, 1e-12 * integral);
    const fe2d::DofMap tied = fe2d::displacement_dofs(f.mesh, fe2d::Base::tied);
    EXPECT_LT(fe2d::pore_pressure_loads(f.mesh, tied, f.pressure, PorePressure::none).norm(), 1e-9 * integral);
}

} // namespace
