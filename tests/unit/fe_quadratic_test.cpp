// Quadratic elements: what the mesh gives them, masses, loads and coupling on quadratic faces, cells of the output.
#include "core/file.hpp"
#include "fe2d/element/elastic.hpp"
#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/output/vtu.hpp"
#include "fe2d/run/contact_planes.hpp"
#include "fe_scenes.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>

namespace {

using namespace damslip;
using namespace damslip::fe2d;

constexpr ElementKind quadratic_kinds[] = {ElementKind::q8, ElementKind::q9, ElementKind::t6};

Scene coarse_dam(ElementKind kind)
{
    Scene scene = fe2d::test::reference_dam_on_rock();
    scene.mesh.element = kind;
    scene.mesh.size = 6.0;
    scene.mesh.contact_size = 5.0;
    return scene;
}

// Every edge has one node in its middle, the same for both elements beside it, but those of the contact plane and of the sliding path,
// which have none; the dam's nodes come before the rock's; the places are those of the linear mesh.
TEST(FeQuadratic, every_edge_but_those_of_the_contact_plane_has_its_middle_node)
{
    for (const ElementKind kind : quadratic_kinds) {
        const Mesh mesh = build_mesh(coarse_dam(kind));
        const bool triangles = kind == ElementKind::t6;
        const Mesh linear = build_mesh(coarse_dam(triangles ? ElementKind::t3 : ElementKind::q4));
        std::set<std::pair<int, int>> contact;
        for (const std::vector<int>* nodes : {&mesh.contact.dam_nodes, &mesh.contact.rock_line})
            for (std::size_t i = 0; i + 1 < nodes->size(); ++i)
                contact.insert(std::minmax({(*nodes)[i], (*nodes)[i + 1]}));
        ASSERT_EQ(mesh.element_count(), linear.element_count());
        std::vector<int> used(mesh.nodes.size(), 0);
        for (int e = 0; e < mesh.element_count(); ++e) {
            const Element& element = mesh.elements[e];
            const auto p = corners(mesh, element), q = corners(linear, linear.elements[e]);
            EXPECT_EQ(element.centre >= 0, kind == ElementKind::q9 && element.size() == 4);
            for (int i = 0; i < element.size(); ++i) {
                EXPECT_EQ(p[i].x, q[i].x);
                EXPECT_EQ(p[i].y, q[i].y);
                const int a = element.nodes[i], b = element.nodes[(i + 1) % element.size()];
                EXPECT_EQ(element.mid[i] < 0, contact.contains(std::minmax({a, b})));
                EXPECT_EQ(element.mid[i], mid_node(mesh, a, b));
                EXPECT_EQ(element.mid[i], mid_node(mesh, b, a));
                if (element.mid[i] < 0) continue;
                EXPECT_EQ(mesh.nodes[element.mid[i]].x, 0.5 * (mesh.nodes[a].x + mesh.nodes[b].x));
                EXPECT_EQ(mesh.nodes[element.mid[i]].y, 0.5 * (mesh.nodes[a].y + mesh.nodes[b].y));
            }
            for (const int node : element.all()) {
                ++used[node];
                EXPECT_EQ(node < mesh.dam_node_count, e < mesh.dam_element_count);
            }
        }
        EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);
        EXPECT_EQ(mid_node(mesh, mesh.crest.front(), mesh.contact.dam_nodes.front()), -1);
        for (std::size_t i = 0; i < mesh.contact.dam_nodes.size(); ++i) { // the planes' nodes moved with the rock
            const Point a = mesh.nodes[mesh.contact.dam_nodes[i]], b = mesh.nodes[mesh.contact.rock_nodes[i]];
            EXPECT_EQ(a.x, b.x);
            EXPECT_EQ(a.y, b.y);
        }
        EXPECT_EQ(with_mid_nodes(mesh, mesh.box_bottom).size(), 2 * mesh.box_bottom.size() - 1);
    }
}

// Shape functions sum to one, their derivatives to zero, and each is one at its own node and zero at the others, for every set of
// nodes an element can have.
TEST(FeQuadratic, shape_functions_of_every_set_of_nodes)
{
    const Corners quad{Point{0, 0}, Point{2, 0.2}, Point{1.7, 1.5}, Point{-0.2, 1.0}};
    const double place[2][9][2] = {{{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}},
                                   {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, 0}}};
    for (const int size : {3, 4})
        for (int set = 1; set < (size == 3 ? 8 : 32); ++set) {
            ExtraNodes extra;
            std::vector<int> nodes;
            for (int i = 0; i < size; ++i) nodes.push_back(i);
            for (int i = 0; i < size; ++i) {
                extra.mid[i] = (set >> i & 1) != 0;
                if (extra.mid[i]) nodes.push_back(size + i);
            }
            extra.centre = (set & 16) != 0;
            if (extra.centre) nodes.push_back(8);
            for (std::size_t n = 0; n < nodes.size(); ++n) {
                const double* at = place[size - 3][nodes[n]];
                const QuadraticPoint point = quadratic_point(quad, size, extra, at[0], at[1]);
                for (std::size_t i = 0; i < nodes.size(); ++i)
                    EXPECT_NEAR(point.shape[static_cast<int>(i)], i == n ? 1.0 : 0.0, 1e-15);
                EXPECT_NEAR(point.gradient.rowwise().sum().norm(), 0.0, 1e-14);
            }
        }
}

// Rigid motions do no work, and nothing else: three zero eigenvalues.
TEST(FeQuadratic, stiffness_has_three_rigid_motions)
{
    const Corners quad{Point{0, 0}, Point{2, 0.2}, Point{1.7, 1.5}, Point{-0.2, 1.0}};
    const Eigen::Matrix3d d = plane_strain_matrix({2500.0, 25e9, 0.17});
    for (const int size : {3, 4})
        for (int set = 1; set < (size == 3 ? 8 : 32); ++set) {
            ExtraNodes extra;
            for (int i = 0; i < size; ++i) extra.mid[i] = (set >> i & 1) != 0;
            extra.centre = (set & 16) != 0;
            const Eigen::MatrixXd k = elastic_stiffness(quad, size, d, Q4Kind::incompatible, extra);
            const Eigen::VectorXd w = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues();
            for (int i = 0; i < 3; ++i) EXPECT_NEAR(w[i] / w[w.size() - 1], 0.0, 1e-14);
            EXPECT_GT(w[3] / w[w.size() - 1], 1e-3);
        }
}

// M r of a translation is the inertia vector, for the consistent and the lumped matrix; both have the dam's mass, the lumped one is
// diagonal and positive, also at the corners, where row sums of Q8 are negative.
TEST(FeQuadratic, masses)
{
    for (const ElementKind kind : quadratic_kinds) {
        const Scene scene = coarse_dam(kind);
        const Mesh mesh = build_mesh(scene);
        const Materials materials = materials_of(scene);
        const DofMap all = all_dofs(mesh, 2);
        Eigen::VectorXd x = Eigen::VectorXd::Zero(all.count);
        for (int n = 0; n < mesh.node_count(); ++n) x[all(n, 0)] = 1.0;
        for (const MassKind mass : {MassKind::consistent, MassKind::lumped}) {
            const SparseMatrix m = mass_matrix(mesh, all, materials, mass);
            const Eigen::VectorXd inertia = inertia_vector(mesh, all, materials, {1.0, 0.0}, mass);
            EXPECT_LT((m * x - inertia).norm(), 1e-12 * inertia.norm());
            EXPECT_NEAR(inertia.sum(), 2500.0 * 1599.75, 1e-6);
            if (mass == MassKind::consistent) continue;
            const Eigen::VectorXd diagonal = m.diagonal();
            EXPECT_NEAR(diagonal.sum(), m.sum(), 1e-6);
            EXPECT_GT(diagonal.head(2 * mesh.dam_node_count).minCoeff(), 0.0);
        }
    }
}

// Weight, water on both faces and on the rock's surface: resultant and moment about the heel are those of the linear mesh; a level between
// two nodes and a downstream face that leans.
TEST(FeQuadratic, loads_have_the_resultants_of_the_linear_mesh)
{
    const auto resultants = [](ElementKind kind) {
        Scene scene = coarse_dam(kind);
        scene.reservoir = Reservoir{.level = 57.3};
        scene.reservoir->floor_pressure = true;
        scene.tailwater = Tailwater{.level = 9.7};
        const Model model = build_model(scene, {.base = Base::separate});
        const StaticLoads loads = static_loads(scene, model);
        std::map<std::string, Eigen::Vector3d> sums;
        for (const auto* list : {&loads.gravity, &loads.impounding})
            for (const StaticLoad& load : *list) {
                Eigen::Vector3d& sum = sums.try_emplace(load.name, Eigen::Vector3d::Zero()).first->second;
                for (int n = 0; n < model.mesh.node_count(); ++n) {
                    const Point p = model.mesh.nodes[n];
                    const int x = model.dofs(n, 0), y = model.dofs(n, 1);
                    const double fx = x == no_dof ? 0.0 : load.force[x], fy = y == no_dof ? 0.0 : load.force[y];
                    sum += Eigen::Vector3d(fx, fy, p.x * fy - p.y * fx);
                }
            }
        return sums;
    };
    const auto linear = resultants(ElementKind::q4);
    EXPECT_EQ(linear.size(), 5u);
    for (const ElementKind kind : quadratic_kinds) {
        const auto sums = resultants(kind);
        for (const auto& [name, sum] : linear) {
            // The rock's sides take what little of the surface pressure falls on their fixed corner; it differs by kind.
            const bool rock = name.find("floor") != std::string::npos || name.find("ground") != std::string::npos;
            if (rock)
                EXPECT_NEAR(sums.at(name)[1], sum[1], 1e-12 * std::abs(sum[1])) << name;
            else
                EXPECT_LT((sums.at(name) - sum).norm(), 1e-12 * sum.norm()) << name;
        }
    }
}

// The pressure (level - y) is in the water's space: what the coupling makes of it is the consistent load of that pressure on the dam's
// quadratic face, node by node.
TEST(FeQuadratic, acoustic_coupling_is_the_consistent_load)
{
    for (const ElementKind kind : quadratic_kinds) {
        Scene scene = fe2d::test::reference_dam();
        scene.mesh.element = kind;
        scene.mesh.size = 4.3; // no row of the dam meets one of the water
        scene.mesh.contact_size = 4.0;
        scene.reservoir = Reservoir{};
        scene.reservoir->level = 57.0;
        scene.reservoir->length = 60.0;
        scene.reservoir->model = ReservoirModel::acoustic;
        FluidOptions options = fluid_options(scene);
        options.surface = WaterSurface::sloshing; // every node has a pressure
        options.far_end = FarEnd::closed;
        const FluidModel water = build_fluid(build_reservoir_mesh(scene), options);
        const Mesh mesh = build_mesh(scene);
        const DofMap all = all_dofs(mesh, 2);
        Eigen::VectorXd p(water.unknowns());
        for (std::size_t n = 0; n < water.reservoir.mesh.nodes.size(); ++n)
            p[water.dofs(static_cast<int>(n))] = 57.0 - water.reservoir.mesh.nodes[n].y;
        const Eigen::VectorXd coupled = face_coupling(mesh, all, water.reservoir, water.dofs, water.unknowns()) * p;
        const Eigen::VectorXd load = pressure_load(
            mesh, all, mesh.upstream_face, [](Point at) { return 57.0 - at.y; }, 57.0);
        EXPECT_LT((coupled - load).norm(), 1e-12 * load.norm());
        EXPECT_NEAR(load.sum(), 0.5 * 57.0 * 57.0, 1e-9);
    }
}

// Added mass: the matrix times a translation is the inertia, whose sum is the integral of the law over the wet face.
TEST(FeQuadratic, added_mass_on_a_quadratic_face)
{
    for (const ElementKind kind : quadratic_kinds) {
        const Mesh mesh = build_mesh(coarse_dam(kind));
        const DofMap all = all_dofs(mesh, 2);
        const AddedMassLaw law = [](Point p, double) { return 1000.0 * (58.0 - p.y); };
        const SparseMatrix m = added_mass_matrix(mesh, all, mesh.upstream_face, law, 58.0);
        Eigen::VectorXd x = Eigen::VectorXd::Zero(all.count);
        for (int n = 0; n < mesh.node_count(); ++n) x[all(n, 0)] = 1.0;
        const Eigen::VectorXd inertia = added_mass_inertia(mesh, all, mesh.upstream_face, law, 58.0, {1.0, 0.0});
        EXPECT_LT((m * x - inertia).norm(), 1e-12 * inertia.norm());
        EXPECT_NEAR(inertia.sum(), 500.0 * 58.0 * 58.0, 1e-6);
    }
}

// Middle nodes and centres belong to the block their element is in.
TEST(FeQuadratic, blocks_above_a_joint_take_their_middle_nodes_along)
{
    for (const ElementKind kind : quadratic_kinds) {
        Scene scene = coarse_dam(kind);
        LiftJoint joint;
        joint.elevation = 40.0;
        scene.lift_joints.push_back(joint);
        const Mesh mesh = build_mesh(scene);
        const ContactPlanes planes(mesh);
        for (int n = 0; n < mesh.dam_node_count; ++n)
            if (std::abs(mesh.nodes[n].y - 40.0) > 1e-9) {
                EXPECT_EQ(planes.above(1)[n] != 0, mesh.nodes[n].y > 40.0);
            }
    }
}

// Cell types and the length of the connectivity: quadratic cells where all edges are, polygons at the contact plane.
TEST(FeQuadratic, vtu_cells)
{
    for (const ElementKind kind : quadratic_kinds) {
        const Mesh mesh = build_mesh(coarse_dam(kind));
        const auto path = std::filesystem::temp_directory_path() / "damslip_vtu_quadratic_test.vtu";
        write_vtu(path, mesh, {}, {});
        const std::string text = read_file(path);
        std::filesystem::remove(path);
        const std::size_t data = text.find("<AppendedData encoding=\"raw\">\n_") + 31;
        const auto block = [&text, data](const std::string& name) {
            const std::size_t header = text.find("offset=\"", text.find("Name=\"" + name + "\"")) + 8;
            const char* at = text.data() + data + std::stoull(text.substr(header, 20));
            std::uint64_t length = 0;
            std::memcpy(&length, at, sizeof length);
            return std::pair{at + sizeof length, length};
        };
        const auto connectivity = block("connectivity"), offsets = block("offsets"), types = block("types");
        std::int64_t last = 0;
        std::memcpy(&last, offsets.first + offsets.second - 8, 8);
        EXPECT_EQ(static_cast<std::uint64_t>(8 * last), connectivity.second);
        ASSERT_EQ(types.second, mesh.elements.size());
        const int whole = kind == ElementKind::q8 ? 23 : kind == ElementKind::q9 ? 28 : 22;
        int polygons = 0;
        for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
            const Element& element = mesh.elements[e];
            bool complete = true;
            for (int i = 0; i < element.size(); ++i) complete = complete && element.mid[i] >= 0;
            polygons += !complete;
            EXPECT_EQ(types.first[e], complete ? whole : 7);
        }
        EXPECT_GT(polygons, 0);
    }
}

} // namespace
