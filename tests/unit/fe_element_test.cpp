// Elements: patch tests, rigid modes, masses.
#include "fe2d/assembly/assemble.hpp"
#include "fe2d/element/elastic.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace {

using namespace damslip;
using namespace damslip::fe2d;

constexpr ElasticMaterial concrete{2500.0, 25e9, 0.17};

/// 0.24 x 0.12 patch of five distorted quadrilaterals (MacNeal & Harder 1985, Finite Elements in Analysis and Design 1,
/// 3-20).
Mesh macneal_patch()
{
    Mesh mesh;
    mesh.nodes = {{0, 0}, {0.24, 0}, {0.24, 0.12}, {0, 0.12}, {0.04, 0.02}, {0.18, 0.03}, {0.16, 0.08}, {0.08, 0.08}};
    mesh.elements = {{{0, 1, 5, 4}, Region::dam},
                     {{1, 2, 6, 5}, Region::dam},
                     {{2, 3, 7, 6}, Region::dam},
                     {{3, 0, 4, 7}, Region::dam},
                     {{4, 5, 6, 7}, Region::dam}};
    mesh.dam_node_count = 8;
    mesh.dam_element_count = 5;
    return mesh;
}

Mesh triangulated(Mesh mesh)
{
    std::vector<Element> triangles;
    for (const Element& e : mesh.elements) {
        triangles.push_back({{e.nodes[0], e.nodes[1], e.nodes[2], -1}, e.region});
        triangles.push_back({{e.nodes[0], e.nodes[2], e.nodes[3], -1}, e.region});
    }
    mesh.elements = triangles;
    return mesh;
}

/// u = a linear field without symmetry; prescribed on the four outer nodes, solved for the four inner ones.
Eigen::Vector2d linear_field(Point p)
{
    return {1e-3 * (p.x + 0.5 * p.y), 1e-3 * (p.y - 0.3 * p.x)};
}

struct PatchErrors {
    double displacement = 0.0, stress = 0.0;
};

PatchErrors patch_errors(const Mesh& mesh, Q4Kind kind)
{
    const Materials materials{.dam = concrete, .rock = {}, .curtain = {}, .block = {}, .kind = kind};
    const Eigen::MatrixXd k = stiffness_matrix(mesh, all_dofs(mesh, 2), materials);
    Eigen::VectorXd exact(16);
    for (int i = 0; i < 8; ++i) exact.segment<2>(2 * i) = linear_field(mesh.nodes[i]);
    Eigen::VectorXd u = exact;
    u.tail(8) = k.bottomRightCorner(8, 8).ldlt().solve(-k.bottomLeftCorner(8, 8) * exact.head(8));

    const Eigen::Matrix3d d = plane_strain_matrix(concrete);
    const Eigen::Vector3d stress = d * Eigen::Vector3d(1e-3, 1e-3, 0.2e-3);
    PatchErrors errors{.displacement = (u - exact).lpNorm<Eigen::Infinity>() / exact.lpNorm<Eigen::Infinity>()};
    for (const Element& e : mesh.elements) {
        ElementVector ue(2 * e.size());
        for (int i = 0; i < e.size(); ++i) ue.segment<2>(2 * i) = u.segment<2>(2 * e.nodes[i]);
        const auto nodal = nodal_stress(corners(mesh, e), e.size(), d, kind, ue);
        for (int i = 0; i < e.size(); ++i)
            errors.stress = std::max(errors.stress, (nodal.col(i) - stress).lpNorm<Eigen::Infinity>() / stress.norm());
    }
    return errors;
}

// Irons' patch test: a linear displacement field prescribed around a distorted patch must come out inside it exactly,
// with constant stress. Round-off only: condition of the 8 x 8 inner block is about 30, so 1e-13 leaves two digits of
// room.
TEST(FeElement, patch_test_distorted)
{
    for (const Q4Kind kind : {Q4Kind::plain, Q4Kind::incompatible}) {
        const PatchErrors errors = patch_errors(macneal_patch(), kind);
        EXPECT_LT(errors.displacement, 1e-13);
        EXPECT_LT(errors.stress, 1e-13);
    }
    const PatchErrors triangles = patch_errors(triangulated(macneal_patch()), Q4Kind::plain);
    EXPECT_LT(triangles.displacement, 1e-13);
    EXPECT_LT(triangles.stress, 1e-13);
}

// A single rectangular element in pure bending: u_x = x y / R, u_y = -x^2/(2R) - nu' y^2/(2R) is reproduced exactly by
// the incompatible modes (energy M^2/(2 E' I)), while the bilinear element is too stiff by the factor 1 + (1 - nu')/2
// (a/b)^2 of its aspect ratio.
TEST(FeElement, incompatible_modes_bend_a_rectangle_exactly)
{
    const Corners c{Point{0, -0.5}, Point{4, -0.5}, Point{4, 0.5}, Point{0, 0.5}};
    const double e_plane = 25e9 / (1 - 0.17 * 0.17), curvature = 1e-4;
    ElementVector u(8);
    for (int i = 0; i < 4; ++i) u.segment<2>(2 * i) << curvature * (c[i].x - 2.0) * c[i].y, 0.0;
    const auto energy = [&](Q4Kind kind) {
        return 0.5 * u.dot(elastic_stiffness(c, 4, plane_strain_matrix(concrete), kind) * u);
    };
    const double exact = 0.5 * e_plane * (1.0 / 12.0) * curvature * curvature * 4.0;
    EXPECT_NEAR(energy(Q4Kind::incompatible) / exact, 1.0, 1e-13);
    const double nu = 0.17 / (1 - 0.17); // of the equivalent plane stress
    const double locking = (1.0 + 0.5 * (1.0 - nu) * 16.0) / (1.0 - nu * nu);
    EXPECT_NEAR(energy(Q4Kind::plain) / exact, locking, 1e-12 * locking);
}

// Three zero eigenvalues (two translations, one rotation), all others clearly positive: no spurious mode.
TEST(FeElement, stiffness_has_exactly_three_rigid_modes)
{
    const Corners quad{Point{0, 0}, Point{2, 0.2}, Point{1.7, 1.5}, Point{-0.2, 1.0}};
    const Eigen::Matrix3d d = plane_strain_matrix(concrete);
    for (const auto& [size, kind] : {std::pair{4, Q4Kind::plain}, {4, Q4Kind::incompatible}, {3, Q4Kind::plain}}) {
        const Eigen::VectorXd values =
            Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(elastic_stiffness(quad, size, d, kind)).eigenvalues();
        EXPECT_LT(values.head(3).cwiseAbs().maxCoeff(), 1e-14 * values.maxCoeff() * 10);
        EXPECT_GT(values[3], 1e-2 * values.maxCoeff());
    }
}

// A rigid translation carries the whole mass in either form: rho A.
TEST(FeElement, masses_sum_to_density_times_area)
{
    const Corners quad{Point{0, 0}, Point{2, 0.2}, Point{1.7, 1.5}, Point{-0.2, 1.0}};
    double area = 0.0;
    for (int i = 0; i < 4; ++i) area += 0.5 * (quad[i].x * quad[(i + 1) % 4].y - quad[(i + 1) % 4].x * quad[i].y);
    for (const MassKind kind : {MassKind::consistent, MassKind::lumped}) {
        const ElementMatrix m = elastic_mass(quad, 4, 1000.0, kind);
        EXPECT_NEAR(m.sum(), 2.0 * 1000.0 * area, 1e-10 * area * 1000.0);
        EXPECT_NEAR(m(0, 1), 0.0, 0.0);
        EXPECT_GT(m.diagonal().minCoeff(), 0.0);
    }
    EXPECT_NEAR(scalar_mass_matrix(quad, 4, 1.0).sum(), area, 1e-13);
    EXPECT_NEAR(body_force(quad, 4, {0.0, -9.81}).sum(), -9.81 * area, 1e-12);
}

// Scalar patch: the energy of a linear field is that of its gradient.
TEST(FeElement, energy_of_a_linear_field_is_exact)
{
    const Corners quad{Point{0, 0}, Point{2, 0.2}, Point{1.7, 1.5}, Point{-0.2, 1.0}};
    ElementVector h(4);
    for (int i = 0; i < 4; ++i) h[i] = 3.0 * quad[i].x - 2.0 * quad[i].y + 1.0;
    EXPECT_NEAR(h.dot(scalar_gradient_matrix(quad, 4, 2.0) * h), 2.0 * 13.0 * scalar_mass_matrix(quad, 4, 1.0).sum(),
                1e-11);
}

// Plane stress mapped to plane strain: D must be E/(1-nu^2) [1 nu; nu 1; (1-nu)/2].
TEST(FeElement, plane_stress_equivalent_gives_the_plane_stress_matrix)
{
    const Eigen::Matrix3d d = plane_strain_matrix(plane_stress_equivalent({0.0, 1.0, 1.0 / 3.0}));
    EXPECT_NEAR(d(0, 0), 1.125, 1e-14);
    EXPECT_NEAR(d(0, 1), 0.375, 1e-14);
    EXPECT_NEAR(d(2, 2), 0.375, 1e-14);
}

} // namespace
