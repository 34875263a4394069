// VTU files: every byte offset of the header points at a block of the right length.
#include "core/file.hpp"
#include "fe2d/mesh/build_mesh.hpp"
#include "fe2d/output/vtu.hpp"
#include "fe2d/run/run_history.hpp"
#include "fe_scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <regex>

namespace {

using namespace damslip;
using namespace damslip::fe2d;

TEST(FeOutput, vtu_blocks_have_the_announced_places_and_lengths)
{
    const Mesh mesh = build_mesh(test::reference_dam_on_rock());
    const auto path = std::filesystem::temp_directory_path() / "damslip_vtu_test.vtu";
    write_vtu(path, mesh, {{"displacement_m", Eigen::MatrixXd::Constant(2, mesh.node_count(), 0.25)}},
              {{"stress_Pa", Eigen::MatrixXd::Constant(3, mesh.element_count(), -1.0)}});
    const std::string text = read_file(path);
    std::filesystem::remove(path);
    const std::size_t data = text.find("<AppendedData encoding=\"raw\">\n_") + 31;
    const std::vector<std::size_t> lengths{
        24u * mesh.nodes.size(), 32u * mesh.elements.size(), 8u * mesh.elements.size(), mesh.elements.size(),
        24u * mesh.nodes.size(), 8u * mesh.elements.size(),  24u * mesh.elements.size()};
    const std::regex offset("offset=\"([0-9]+)\"");
    std::size_t i = 0;
    for (std::sregex_iterator it(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(data), offset), end;
         it != end; ++it, ++i) {
        ASSERT_LT(i, lengths.size());
        std::uint64_t length = 0;
        std::memcpy(&length, text.data() + data + std::stoull((*it)[1]), sizeof length);
        EXPECT_EQ(length, lengths[i]);
    }
    EXPECT_EQ(i, lengths.size());
    double z = 1.0, x = 0.0; // the third component of a vector is zero
    const std::size_t displacement = data + 8 * 5 + lengths[0] + lengths[1] + lengths[2] + lengths[3];
    std::memcpy(&x, text.data() + displacement, 8);
    std::memcpy(&z, text.data() + displacement + 16, 8);
    EXPECT_EQ(x, 0.25);
    EXPECT_EQ(z, 0.0);
}

TEST(FeOutput, pvd_lists_the_times)
{
    const auto path = std::filesystem::temp_directory_path() / "damslip_pvd_test.pvd";
    write_pvd(path, {{0.0, "fields_0.vtu"}, {0.1, "fields_1.vtu"}});
    const std::string text = read_file(path);
    std::filesystem::remove(path);
    EXPECT_NE(text.find("<DataSet timestep=\"0.1\" part=\"0\" file=\"fields_1.vtu\"/>"), std::string::npos);
}

/// Every element of the mesh is in one part, with the same corners, and the values go with its nodes.
TEST(FeOutput, PartsOfAMeshAreTheMesh)
{
    const Mesh mesh = build_mesh(test::reference_dam_on_rock());
    const MeshPart dam = part_of(mesh, 0, mesh.dam_element_count),
                   rock = part_of(mesh, mesh.dam_element_count, mesh.element_count());
    EXPECT_EQ(dam.mesh.node_count(), mesh.dam_node_count); // the plane is split: no node is in both
    EXPECT_EQ(dam.mesh.node_count() + rock.mesh.node_count(), mesh.node_count());
    EXPECT_EQ(dam.mesh.element_count() + rock.mesh.element_count(), mesh.element_count());
    Eigen::MatrixXd x(1, mesh.node_count());
    for (int node = 0; node < mesh.node_count(); ++node) x(0, node) = mesh.nodes[static_cast<std::size_t>(node)].x;
    for (const MeshPart* part : {&dam, &rock}) {
        const Eigen::MatrixXd here = part->at_nodes(x);
        for (std::size_t e = 0; e < part->elements.size(); ++e) {
            const Element& element = part->mesh.elements[e];
            const auto of_part = corners(part->mesh, element);
            const auto of_mesh = corners(mesh, mesh.elements[static_cast<std::size_t>(part->elements[e])]);
            EXPECT_EQ(of_part, of_mesh);
            for (int i = 0; i < element.size(); ++i)
                EXPECT_EQ(here(0, element.nodes[static_cast<std::size_t>(i)]), of_part[static_cast<std::size_t>(i)].x);
        }
    }
}

TEST(FeOutput, FramesComeBackAsTheyWent)
{
    FrameSpool spool(0.5);
    std::vector<double> kept;
    for (int row = 0; row <= 7; ++row) { // rows at 0.2 s: those at or after 0, 0.5, 1.0 s
        const double time = 0.2 * row;
        if (!spool.due(time)) continue;
        RunFrame frame;
        frame.time = time;
        frame.mean_slip = -time;
        frame.dam = Eigen::VectorXd::Constant(3 + row, 1.0 / (1 + row)); // lengths may differ
        frame.water = Eigen::VectorXd::LinSpaced(4, 0.0, time);
        frame.states = {0.0, 3.0};
        spool.add(frame);
        kept.push_back(time);
    }
    const std::vector<double> due{0.0, 0.2 * 3, 0.2 * 5};
    EXPECT_EQ(kept, due);
    ASSERT_EQ(spool.count(), due.size());
    EXPECT_EQ(spool.last_time(), due.back());
    for (const std::size_t i : {std::size_t{2}, std::size_t{0}, std::size_t{1}}) { // in any order
        const RunFrame frame = spool.read(i);
        const int row = static_cast<int>(std::lround(due[i] / 0.2));
        EXPECT_EQ(frame.time, due[i]);
        EXPECT_EQ(frame.mean_slip, -due[i]);
        EXPECT_EQ(frame.dam, Eigen::VectorXd::Constant(3 + row, 1.0 / (1 + row)));
        EXPECT_EQ(frame.water, Eigen::VectorXd::LinSpaced(4, 0.0, due[i]));
        EXPECT_EQ(frame.states, (std::vector<double>{0.0, 3.0}));
        EXPECT_EQ(frame.rock.size(), 0);
    }
}

} // namespace
