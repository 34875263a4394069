// Smaller lines of A18: base shear of modes, a column that stays, the default mesh of short blocks, boxes of rock too small.
#include "analysis/spectrum/spectrum_level.hpp"
#include "pages/fe/fe_pages.hpp"
#include "scene/mesh_sizes.hpp"
#include "scene/plausible.hpp"
#include "scene/read.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace {

using namespace damslip;

Scene dam(const std::string& section, const std::string& rest = "")
{
    return parse_scene(section + "[dam]\ndensity_kg_m3 = 2400\nyoung_modulus_GPa = 25\npoisson_ratio = 0.2\n"
                                 "[contact]\nfriction = 1.0\n" +
                           rest,
                       "test.toml");
}

const std::string triangle = "[section]\nheight_m = 40\nbase_m = 32\ncrest_m = 4\n";

TEST(Audit3, A18_BaseShearHasTheMassOfFixedNodes)
{
    const Ready ready = prepare(dam(triangle), Method::finite_elements, std::make_shared<const std::vector<RecordPair>>());
    const SpectrumLevel level = spectrum_level(ready, {{"flat", 0.05, [](double) { return 2.0; }}});
    const SpectrumDemand& row = level.rows.front();
    for (const ModeShare& mode : row.modes)
        EXPECT_NEAR(mode.base_shear, 2.0 * mode.effective_mass, 1e-9 * 2.0 * level.total_mass);
}

TEST(Audit3, A18_StoredInJointsStaysWhereTheBondIsBroken)
{
    fe2d::Energy broken;
    broken.bond_fracture = 100.0;
    const auto columns = pages::energy_columns_of({broken});
    EXPECT_TRUE(std::any_of(columns.begin(), columns.end(),
                            [](const auto& c) { return c.column.key == "joint_stored_J_m"; }));
    for (const auto& c : pages::energy_columns_of({fe2d::Energy{}})) EXPECT_NE(c.column.key, "joint_stored_J_m");
}

TEST(Audit3, A18_ShortBlocksHaveNoTinyElements)
{
    const auto contact = [](const std::string& size) { return mesh_sizes(dam("[section]\n" + size)).contact; };
    EXPECT_DOUBLE_EQ(contact("polygon_m = [[0, 0], [2, 0], [2, 10], [0, 10]]\n"), 0.1);
    EXPECT_DOUBLE_EQ(contact("polygon_m = [[0, 0], [1, 0], [1, 4], [0, 4]]\n"), 0.05);
    EXPECT_DOUBLE_EQ(contact("polygon_m = [[0, 0], [12, 0], [12, 40], [0, 40]]\n"), 0.2);
}

TEST(Audit3, A18_ABoxOfRockBelowTheAutomaticOneIsNoted)
{
    const auto noted = [](const std::string& size) {
        const Scene scene = dam(triangle, "[foundation]\nyoung_modulus_GPa = 30\npoisson_ratio = 0.2\nwidth_m = 200\n"
                                          "depth_m = 80\nwave_box = " +
                                              size + "\n");
        const auto notes = note_texts(scene.notes);
        return std::any_of(notes.begin(), notes.end(),
                           [](const std::string& n) { return n.find("wave_box") != std::string::npos; });
    };
    EXPECT_TRUE(noted("0.7"));
    EXPECT_FALSE(noted("1"));
    EXPECT_FALSE(noted("1.4"));
}

} // namespace
