// A rock wedge as a scene: what the commands say of examples/rock_wedge.toml and of small wedges.
#include "cli/program.hpp"
#include "scene/read.hpp"
#include "scene/rock_wedge.hpp"
#include "scene/write.hpp"
#include "source_dir.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unistd.h>

namespace {

using namespace damslip;
using WedgeJson = nlohmann::json;

const std::string wedge_example = std::string(source_dir()) + "/examples/rock_wedge.toml";

/// A wedge on two equal planes 45 degrees steep, open to the north, given by volume and areas.
const std::string symmetric_wedge_text = R"([wedge]
density_kg_m3 = 2500
volume_m3 = 10
[[wedge.plane]]
dip_deg = 45
dip_direction_deg = 35
friction_deg = 40
area_m2 = 8
[[wedge.plane]]
dip_deg = 45
dip_direction_deg = 325
friction_deg = 40
area_m2 = 8
)";

class WedgeScene : public testing::Test {
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / ("damslip_wedge_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder);
        std::ofstream(folder / "pulse.csv") << "time_s,accel_m_s2\n0,0\n0.5,6\n1,0\n1.5,-6\n2,0\n";
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::string scene(const std::string& text)
    {
        const std::string file = (folder / "wedge.toml").string();
        std::ofstream(file) << text;
        return file;
    }
    /// Exit code; what was said is in `said`.
    int run(std::vector<std::string> arguments)
    {
        std::ostringstream out, talk;
        const int code = cli::run_program(arguments, out, talk, false);
        said = out.str();
        told = talk.str();
        return code;
    }
    WedgeJson screened(const std::string& file, std::vector<std::string> more = {})
    {
        more.insert(more.begin(), {"screen", file, "--json", "--quiet"});
        EXPECT_EQ(run(more), 0) << told;
        return WedgeJson::parse(said);
    }

    std::filesystem::path folder;
    std::string said, told;
};

TEST_F(WedgeScene, ScreenFindsTheWayOfSliding)
{
    const WedgeJson j = screened(wedge_example);
    const WedgeJson& still = j["wedge"][0];
    EXPECT_EQ(still["mode"], "both planes, along their line");
    EXPECT_NEAR(still["factor_of_safety"].get<double>(), 1.34194, 5e-6);
    EXPECT_NEAR(still["trend_deg"].get<double>(), 157.7324, 1e-4);
    EXPECT_NEAR(still["plunge_deg"].get<double>(), 31.1965, 1e-4);
    EXPECT_EQ(j["wedge"][1]["state"], "without cohesion");
    EXPECT_LT(j["wedge"][1]["factor_of_safety"].get<double>(), 1.0);
    EXPECT_NEAR(j["planes"][0]["area_m2"].get<double>(), 885.141, 1e-3);
    // The records drive it its own way by default; the least of all azimuths is below that yield, the way back above.
    const double along = j["yield"][0]["yield_acceleration_m_s2"], least = j["yield"][2]["yield_acceleration_m_s2"];
    EXPECT_NEAR(along, 1.398637, 1e-6);
    EXPECT_LE(least, along);
    EXPECT_GT(least, 0.9 * along);
    const WedgeJson& row = j["displacements"][0];
    EXPECT_GT(row["slip_h_mm"].get<double>(), 1.0);
    EXPECT_GT(row["slip_hv_mm"].get<double>(), 1.0);
    EXPECT_NE(row["slip_hv_mm"], row["slip_h_mm"]);
    EXPECT_EQ(row["upstream_slip_mm"].get<double>(), 0.0);
    EXPECT_FALSE(j.contains("limit_equilibrium"));
}

// Turned by 70 degrees with its motion the same wedge does the same; turned without it, it does not.
TEST_F(WedgeScene, SlipFollowsTheDirectionOfTheMotion)
{
    const std::string record = "[[motion.record]]\nhorizontal = \"pulse.csv\"\n";
    const auto slip = [&](double turn, const std::string& azimuth) {
        std::string text = symmetric_wedge_text + record;
        const auto put = [&](const std::string& from, double to) {
            text.replace(text.find(from), from.size(), "dip_direction_deg = " + std::to_string(to));
        };
        put("dip_direction_deg = 35", 35 + turn);
        put("dip_direction_deg = 325", std::fmod(325 + turn, 360.0));
        text.insert(text.find("volume"), azimuth);
        return screened(scene(text))["displacements"][0]["slip_h_mm"].get<double>();
    };
    const double along = slip(0, "");
    EXPECT_GT(along, 1.0);
    EXPECT_NEAR(slip(70, ""), along, 1e-9 * along);
    EXPECT_NEAR(slip(70, "motion_azimuth_deg = 70\n"), along, 1e-9 * along);
    EXPECT_LT(slip(0, "motion_azimuth_deg = 60\n"), 0.9 * along);
}

TEST_F(WedgeScene, FrictionOfTheCommandLineIsThatOfTheFirstPlane)
{
    const std::string file = scene(symmetric_wedge_text);
    const WedgeJson own = screened(file), half = screened(file, {"--friction", "0.41954981558864"}); // tan 40 deg / 2
    EXPECT_NEAR(half["wedge"][0]["factor_of_safety"].get<double>(),
                0.5 * own["wedge"][0]["factor_of_safety"].get<double>(), 1e-12);
    EXPECT_NEAR(half["planes"][1]["friction"].get<double>(), 0.41954981558864, 1e-12);
    EXPECT_EQ(half["wedge"][0]["result"],
              own["wedge"][0]["factor_of_safety"].get<double>() < 2 ? "SLIDES STATICALLY" : "stands");
}

TEST_F(WedgeScene, ForcesAndWaterAct)
{
    const auto factor = [&](const std::string& more) {
        return screened(scene(symmetric_wedge_text + more))["wedge"][0]["factor_of_safety"].get<double>();
    };
    const double dry = factor("");
    EXPECT_GT(factor("[[wedge.force]]\nforce_kN = 50\ntrend_deg = 180\nplunge_deg = 10\n"), dry); // an anchor holds it
    EXPECT_LT(factor("[[wedge.force]]\nforce_kN = 50\ntrend_deg = 0\nplunge_deg = 0\n"), dry);
    EXPECT_LT(factor("water_pressure_kPa = 5\n"), dry); // of the last plane
    // 10 m3 weigh 245 kN: 40 kPa on 8 m2 of each plane carry them.
    std::string floats = symmetric_wedge_text + "water_pressure_kPa = 40\n";
    floats.insert(floats.find("[[wedge.plane]]\ndip_deg = 45\ndip_direction_deg = 325"), "water_pressure_kPa = 40\n");
    const WedgeJson j = screened(scene(floats));
    EXPECT_EQ(j["wedge"][0]["mode"], "lifts off both planes");
    EXPECT_EQ(j["wedge"][0]["result"], "LIFTS");
}

TEST_F(WedgeScene, LostCohesionIsLostAtTheFirstSlip)
{
    std::string text = symmetric_wedge_text + "cohesion_kPa = 2\n[[motion.record]]\nhorizontal = \"pulse.csv\"\n";
    const double lost = screened(scene(text))["displacements"][0]["slip_h_mm"];
    text.insert(text.find("volume"), "cohesion_lost_at_slip = false\n");
    const double kept = screened(scene(text))["displacements"][0]["slip_h_mm"];
    EXPECT_GT(kept, 0.0);
    EXPECT_GT(lost, 1.05 * kept);
}

TEST_F(WedgeScene, ReportHasStereonetSlipHistoryAndAzimuths)
{
    ASSERT_EQ(run({"screen", wedge_example, "--out", folder.string(), "--quiet"}), 0) << told;
    std::ifstream file(folder / "report.html");
    const std::string page((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    for (const char* part : {"Stereonet", "The wedge in its slope", "The wedge slides", "EC8, 3 m/s2: slip",
                             "yield acceleration with vertical motion", "Yield acceleration over the direction",
                             "Slip over friction", "Regressions beside the rigid block"})
        EXPECT_NE(page.find(part), std::string::npos) << part;
    EXPECT_EQ(page.find("Limit equilibrium"), std::string::npos);
    // The resolved scene gives the same again.
    const WedgeJson again = screened((folder / "scene.resolved.toml").string()), first = screened(wedge_example);
    EXPECT_EQ(again["displacements"], first["displacements"]);
    EXPECT_EQ(again["scene"]["hash"], first["scene"]["hash"]);
}

TEST_F(WedgeScene, ExplainNamesItsEffects)
{
    ASSERT_EQ(run({"explain", wedge_example, "--json"}), 0) << told;
    int on = 0;
    const WedgeJson explained = WedgeJson::parse(said);
    for (const WedgeJson& row : explained["effects"]) {
        on += row["on"].get<bool>();
        if (row["effect"] == "uplift") {
            EXPECT_EQ(row["reason"], "wedge.water = \"full\"");
        }
        if (row["effect"] == "silt") {
            EXPECT_EQ(row["reason"], "a rock wedge has none");
        }
    }
    EXPECT_EQ(on, 5); // water, cohesion, two planes, vertical motion, run-out
}

TEST_F(WedgeScene, SweepOverFriction)
{
    const std::string file = scene(symmetric_wedge_text + "[[motion.record]]\nhorizontal = \"pulse.csv\"\n");
    ASSERT_EQ(run({"sweep", file, "--friction-deg", "38,40,44", "--polarity", "1", "--json", "--quiet"}), 0) << told;
    const WedgeJson rows = WedgeJson::parse(said)["rows"];
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_GT(rows[0]["slip_m"].get<double>(), rows[1]["slip_m"].get<double>());
    EXPECT_GT(rows[1]["slip_m"].get<double>(), rows[2]["slip_m"].get<double>());
    EXPECT_NEAR(rows[1]["slip_m"].get<double>(), 1e-3 * screened(file)["displacements"][0]["slip_h_mm"].get<double>(),
                1e-12);
}

TEST_F(WedgeScene, CommandsOfASectionRefuseItWithWords)
{
    for (const std::vector<std::string>& command : {std::vector<std::string>{"fe", wedge_example},
                                                    {"accuracy", wedge_example},
                                                    {"modes", wedge_example},
                                                    {"explain", wedge_example, "--ablate"},
                                                    {"explain", wedge_example, "--method", "fe"}}) {
        EXPECT_EQ(run(command), 3) << command.front();
        EXPECT_NE(told.find("cannot take a [wedge]: it has no section"), std::string::npos) << told;
    }
    EXPECT_EQ(run({"sweep", wedge_example, "--method", "fe"}), 2);
    EXPECT_NE(told.find("cannot take a [wedge]"), std::string::npos) << told;
    EXPECT_EQ(run({"sweep", wedge_example, "--level", "3"}), 2);
}

// A cube's corner: planes 45/90 and 45/270 ... any tetrahedron: its volume by its base and height.
TEST_F(WedgeScene, ShapeOfASimpleWedge)
{
    // Planes 45 degrees steep to east and west meet in a level line, tilted here by a face: line along the y axis cannot come out.
    RockWedge w;
    w.height = 10.0;
    w.face_dip = std::atan(2.0); // falls 2 m per metre to the north
    w.face_dip_direction = 0.0;
    w.planes.resize(2);
    // The line plunges 45 degrees to the north in the plane x = 0; normals (+-1, 1, 1)/sqrt 3.
    w.planes[0].dip = w.planes[1].dip = std::acos(1.0 / std::sqrt(3.0));
    w.planes[0].dip_direction = std::atan2(1.0, 1.0);
    w.planes[1].dip_direction = std::atan2(-1.0, 1.0);
    const auto s = wedge_shape(w);
    ASSERT_TRUE(s);
    // Crest at z = 10, y = -5; top at y = -10; half width at the crest: x = y + z = 5. Volume (1/3)(1/2 10 5) 10.
    EXPECT_NEAR(s->top[1], -10.0, 1e-12);
    EXPECT_NEAR(std::abs(s->first_crest[0]), 5.0, 1e-12);
    EXPECT_NEAR(s->volume, 250.0 / 3.0, 1e-11);
    EXPECT_NEAR(s->first_area, s->second_area, 1e-11);
    EXPECT_NEAR(s->first_area, 0.5 * std::sqrt(50.0 * 50.0 + 50.0 * 50.0 + 50.0 * 50.0), 1e-11); // |top x crest|/2
    w.face_dip = std::atan(0.9); // flatter than the line: it does not come out
    EXPECT_FALSE(wedge_shape(w));
}

} // namespace
