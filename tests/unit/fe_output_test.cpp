// VTU files: every byte offset of the header points at a block of the right length.
#include "core/file.hpp"
#include "fe2d/mesh/build_mesh.hpp"
#include "fe2d/output/vtu.hpp"
#include "fe_scenes.hpp"

#include <gtest/gtest.h>

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

} // namespace
