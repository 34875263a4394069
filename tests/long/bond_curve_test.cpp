// Slip over cohesion does not depend on the mesh (docs/joints-bond.md).
#include "analysis/prepare/ready.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "scene/read.hpp"
#include "source_dir.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace {

using namespace damslip;

const char* const bonded_sections[] = {
    "[section]\nheight_m = 62.5\nbase_m = 45\ncrest_m = 12\nneck_m = 11\n[dam]\ndensity_kg_m3 = "
    "2500\nyoung_modulus_GPa = 25\n"
    "poisson_ratio = 0.17\n[foundation]\nyoung_modulus_GPa = 30\npoisson_ratio = 0.2\nwidth_m = 300\ndepth_m = 100\n"
    "[drains]\ndistance_m = 7\nefficiency = 0.5\n[reservoir]\nlevel_m = 58\nmodel = \"added-mass\"\n"
    "[contact]\nfriction = 0.77\n",
    "[section]\npolygon_m = [[0, 0], [70, 0], [19.25, 66.5], [14.8, 103], [0, 103]]\n[dam]\ndensity_kg_m3 = 2643\n"
    "young_modulus_GPa = 31\npoisson_ratio = 0.2\n[foundation]\nyoung_modulus_GPa = 28\npoisson_ratio = 0.2\nwidth_m = "
    "400\n"
    "depth_m = 150\n[drains]\ndistance_m = 8\nefficiency = 0.5\n[reservoir]\nlevel_m = 96.5\nmodel = \"added-mass\"\n"
    "[contact]\nfriction = 0.85\n"};

/// Slip of one dam with one cohesion [m]; NaN where it did not come to rest.
double slip_with(const char* section, double cohesion_kPa, double contact_size)
{
    std::string text = section;
    if (cohesion_kPa > 0.0)
        text += fmt::format("cohesion_kPa = {}\ntensile_strength_kPa = {}\nfracture_energy_shear_N_m = 1500\n"
                            "fracture_energy_tension_N_m = 150\n",
                            cohesion_kPa, 0.5 * cohesion_kPa);
    const std::string records = std::string(source_dir()) + "/records/data/";
    text += fmt::format("[mesh]\ncontact_size_m = {}\n[motion]\npolarity = 1\n[[motion.record]]\nname = \"EC8\"\n"
                        "horizontal = \"{}ec8_3.0_h.csv\"\nvertical = \"{}ec8_3.0_v.csv\"\n",
                        contact_size, records, records);
    const Scene scene = parse_scene(text, "bonded.toml");
    const Watch nobody;
    const Ready ready = prepare(scene, Method::finite_elements);
    fe2d::RunOptions options = ready.run_options(nobody);
    options.rock_cache = std::filesystem::temp_directory_path() / "damslip-bond-curve"; // one rock for each mesh
    const fe2d::EarthquakeRun run(ready.scene, options);
    const fe2d::RunResult result = run.run(ready.motion(ready.records().front()));
    return result.status == Status::at_rest ? result.slip : std::nan("");
}

class BondCurve : public testing::TestWithParam<const char*> {};

// 5 % between two meshes: each run's error of the step is 1 % at most, and so is what the docs' table has between meshes.
TEST_P(BondCurve, SlipDoesNotDependOnTheMesh)
{
    struct Case {
        double cohesion_kPa, coarse, fine; ///< fine: elements of a quarter of the process zone at most [m]
    };
    for (const auto& [cohesion, coarse, fine] :
         {Case{0.0, 2.0, 1.0}, {170.0, 2.0, 1.0}, {500.0, 2.0, 1.0}, {1000.0, 2.0, 1.0}}) {
        const double of_coarse = slip_with(GetParam(), cohesion, coarse),
                     of_fine = slip_with(GetParam(), cohesion, fine);
        EXPECT_GT(of_fine, 0.05) << cohesion << " kPa: a dam that does not slide tells nothing";
        EXPECT_NEAR(of_coarse, of_fine, 0.05 * of_fine) << cohesion << " kPa";
    }
}

// 2 MPa needs elements of 1.06 m. The strength that longer ones are given is another bond: 2 m miss the slip by a third.
TEST(StrongBond, SlipDoesNotDependOnElementsThatCarryIt)
{
    const double wide = slip_with(bonded_sections[0], 2000.0, 2.0), coarse = slip_with(bonded_sections[0], 2000.0, 1.0),
                 fine = slip_with(bonded_sections[0], 2000.0, 0.5);
    EXPECT_GT(fine, 0.05);
    EXPECT_NEAR(coarse, fine, 0.05 * fine);
    EXPECT_GT(wide, 1.2 * fine) << "elements that are too long pass: is the note still needed?";
}

INSTANTIATE_TEST_SUITE_P(Dams, BondCurve, testing::ValuesIn(bonded_sections),
                         [](const auto& info) { return info.index == 0 ? "Reference" : "HighDam"; });

} // namespace
