#include "analysis/prepare/ready.hpp"
#include "analysis/screen/regression_rows.hpp"
#include "program_answer.hpp"
#include "records/read/read_record.hpp"
#include "scene/read.hpp"
#include "sliding/block/slide_batch.hpp"
#include "source_dir.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <numbers>
#include <unistd.h>

namespace damslip {
namespace {

GroundMotion waves_of_yield()
{
    GroundMotion motion;
    motion.name = "waves";
    motion.dt = 0.01;
    for (int i = 0; i < 1200; ++i) {
        const double t = i * motion.dt;
        motion.accel_h.push_back(3.0 * std::exp(-0.1 * (t - 5) * (t - 5)) *
                                 (std::sin(9 * t) + 0.4 * std::sin(31 * t + 1)));
    }
    return motion;
}

TEST(GivenYield, OneNumberIsTheBlockOfConstantYield)
{
    const GroundMotion motion = waves_of_yield();
    const std::vector<GivenYieldRow> rows = given_yield_runs({{{0.0, 0.9}}, {}, {}, false}, {motion}, {"rigid"});
    sliding::ConstantYieldOptions options;
    for (const int polarity : {1, -1}) {
        options.polarity = polarity;
        const double slip =
            sliding::slide_constant_yield(motion.accel_h, motion.dt, 0.9, options).slip;
        EXPECT_GT(slip, 0.01);
        EXPECT_NEAR((polarity > 0 ? rows[0].normal : rows[0].inverse).slip, slip, 1e-14 * slip); // two summations
    }
    EXPECT_EQ(rows[0].mean_slip(), 0.5 * (rows[0].normal.slip + rows[0].inverse.slip));
}

TEST(GivenYield, YieldOfASceneGivenDirectlySlidesAsTheScene)
{
    // Dam with water, uplift and added mass: on a level base only its yield rules how far it slides horizontally.
    const Scene scene = read_scene(std::filesystem::path(source_dir()) / "examples/reference_dam_profile.toml");
    const Ready ready = prepare(scene, Method::rigid_block);
    const RigidModel model = ready.rigid_model();
    GroundMotion motion = ready.motion(ready.records().front());
    motion.accel_v.clear();
    sliding::SlideOptions options;
    options.sliding = scene.sliding;
    const GivenYieldBlock block{{{0.0, model.downstream.law.constant}}, {}, {}, false};
    const std::vector<GivenYieldRow> rows = given_yield_runs(block, {motion}, {"rigid"});
    for (const int polarity : {1, -1}) {
        options.polarity = polarity;
        options.sliding.two_way = false;
        const double slip = sliding::slide(motion, model.stages, options).slip;
        EXPECT_GT(slip, 1e-4);
        EXPECT_NEAR((polarity > 0 ? rows[0].normal : rows[0].inverse).slip, slip, 1e-11 * slip); // rounding of a_y
    }
}

TEST(GivenYield, YieldThatGrowsWithSlipStopsTheBlockAsAnOscillator)
{
    // s'' = A - (y0 + k s): s = (A - y0)/k (1 - cos(sqrt(k) t)). After half a period, pi/sqrt(k), it rests at 2 (A - y0)/k,
    // where its yield is 2 A - y0 > A. k = pi^2/4: 2 s.
    const double k = std::numbers::pi * std::numbers::pi / 4, a = 1.5, y0 = 1.0;
    GroundMotion push;
    push.dt = 0.1;
    push.accel_h.assign(31, a);
    const double far = 10.0;
    const GivenYieldBlock block{{{0.0, y0}, {far, y0 + k * far}}, {}, {}, false};
    const GivenYieldRow row = given_yield_runs(block, {push}, {"rigid"}).front();
    EXPECT_EQ(row.normal.status, Status::at_rest);
    EXPECT_NEAR(row.normal.slip, 2 * (a - y0) / k, 1e-9);
    EXPECT_NEAR(row.normal.last_slip_time, 2.0, 1e-6); // the rate falls to zero there
    EXPECT_EQ(row.inverse.slip, 0.0);                  // one way
}

TEST(GivenYield, AFlatTableIsOneNumber)
{
    const GroundMotion motion = waves_of_yield();
    sliding::FlexibleBlock mode;
    mode.period = 0.3;
    for (const std::string method : {"rigid", "decoupled", "coupled"}) {
        const double one = given_yield_runs({{{0.0, 0.9}}, mode, {}, false}, {motion}, {method}).front().normal.slip;
        const double flat =
            given_yield_runs({{{0.0, 0.9}, {0.01, 0.9}, {0.5, 0.9}}, mode, {}, false}, {motion}, {method})
                .front()
                .normal.slip;
        EXPECT_NEAR(flat, one, 1e-9 * one) << method; // stages end inside steps
        EXPECT_GT(one, 0.01);
    }
}

TEST(GivenYield, WeakerWithSlipSlidesFarther)
{
    const GroundMotion motion = waves_of_yield();
    const double strong = given_yield_runs({{{0.0, 1.0}}, {}, {}, false}, {motion}, {"rigid"}).front().normal.slip;
    const double weak = given_yield_runs({{{0.0, 0.6}}, {}, {}, false}, {motion}, {"rigid"}).front().normal.slip;
    const double between =
        given_yield_runs({{{0.0, 1.0}, {0.05, 0.6}}, {}, {}, false}, {motion}, {"rigid"}).front().normal.slip;
    EXPECT_LT(strong, between);
    EXPECT_LT(between, weak);
}

TEST(GivenYield, BadPointsAreRefused)
{
    EXPECT_THROW(sliding::stages_of_yield({}), InputError);
    EXPECT_THROW(sliding::stages_of_yield({{0.1, 1.0}}), InputError);
    EXPECT_THROW(sliding::stages_of_yield({{0.0, -1.0}}), InputError);
    EXPECT_THROW(sliding::stages_of_yield({{0.0, std::nan("")}}), InputError);
    EXPECT_THROW(sliding::stages_of_yield({{0.0, 1.0}, {0.2, 1.0}, {0.1, 1.0}}), InputError);
}

/// A folder with a record of one pulse each way and tables of yields.
class SlideCommand : public testing::Test {
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / ("damslip_slide_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder);
        std::ofstream(folder / "pulse.csv") << "time_s,accel_m_s2\n0,0\n1,2\n2,0\n3,-1.5\n4,0\n5,0\n";
        std::ofstream(folder / "good.csv") << "slip_mm,yield_g\n0,0.1\n50,0.08\n";
        std::ofstream(folder / "late.csv") << "slip_mm,yield_g\n10,0.1\n50,0.08\n";
        std::ofstream(folder / "back.csv") << "slip_mm,yield_g\n0,0.1\n50,0.08\n20,0.07\n";
    }
    void TearDown() override { std::filesystem::remove_all(folder); }
    std::string file(const std::string& name) const { return (folder / name).string(); }
    std::filesystem::path folder;
};

TEST_F(SlideCommand, PrintsBothWaysAndTheirMean)
{
    const ProgramAnswer a = answer_of({"slide", "--yield-m-s2", "0.981", "--record", file("pulse.csv"), "--json"});
    ASSERT_EQ(a.code, 0) << a.talk;
    const auto row = nlohmann::json::parse(a.out)["rows"][0];
    const double slip = row["slip_mm"], inverse = row["slip_inverse_mm"];
    EXPECT_GT(slip, inverse);
    EXPECT_GT(inverse, 0.0);
    EXPECT_NEAR(row["slip_mean_mm"].get<double>(), 0.5 * (slip + inverse), 1e-12 * slip);
}

// Each of a list is the run with it alone.
TEST_F(SlideCommand, SeveralYields)
{
    const auto rows = [&](const std::string& yield) {
        const ProgramAnswer a =
            answer_of({"slide", "--yield-g", yield, "--record", file("pulse.csv"), "--period-s", "0.3", "--json"});
        EXPECT_EQ(a.code, 0) << a.talk;
        return nlohmann::json::parse(a.out)["rows"];
    };
    const auto both = rows("0.05:0.1:0.05"), first = rows("0.05"), second = rows("0.1");
    ASSERT_EQ(both.size(), first.size() + second.size());
    for (std::size_t i = 0; i < first.size(); ++i) {
        EXPECT_EQ(both[i], first[i]);
        EXPECT_EQ(both[first.size() + i], second[i]);
        EXPECT_GT(first[i]["slip_mm"], second[i]["slip_mm"]);
    }
}

TEST_F(SlideCommand, ATableLetsItSlideFarther)
{
    const auto slip = [&](std::vector<std::string> more) {
        more.insert(more.begin(), "slide");
        more.insert(more.end(), {"--record", file("pulse.csv"), "--json"});
        const ProgramAnswer a = answer_of(more);
        EXPECT_EQ(a.code, 0) << a.talk;
        return nlohmann::json::parse(a.out)["rows"][0]["slip_mm"].get<double>();
    };
    EXPECT_GT(slip({"--yield-table", file("good.csv")}), slip({"--yield-g", "0.1"}));
    EXPECT_LT(slip({"--yield-table", file("good.csv")}), slip({"--yield-g", "0.08"}));
}

// The same yield in other units, in the other order, and under a comment as numpy writes it.
TEST_F(SlideCommand, HeadingsOfATableSayItsUnits)
{
    const auto rows = [&](const std::string& text) {
        std::ofstream(folder / "table.csv") << text;
        const ProgramAnswer a =
            answer_of({"slide", "--yield-table", file("table.csv"), "--record", file("pulse.csv"), "--json"});
        EXPECT_EQ(a.code, 0) << a.talk;
        const auto row = a.code == 0 ? nlohmann::json::parse(a.out)["rows"][0] : nlohmann::json();
        return row.is_null() ? 0.0 : row["slip_mm"].get<double>();
    };
    const double slip = rows("slip_mm,yield_g\n0,0.1\n50,0.08\n");
    EXPECT_GT(slip, 1.0);
    for (const char* text :
         {"0,0.1\n50.0,0.08\n", "slip,yield\n0,0.1\n50,0.08\n", "yield_g,slip_mm\n0.1,0\n0.08,50\n",
          "slip_m,yield_m_s2\n0,0.980665\n0.05,0.784532\n", "Slip [cm];a_y (cm/s2)\n0;98.0665\n5;78.4532\n",
          "# of mine\n# slip_m a_y_g\n0 0.1\n0.05 0.08\n", "block A\nslip_m,k_y\n0,0.1\n0.05,0.08\n"})
        EXPECT_NEAR(rows(text), slip, 1e-9 * slip) << text;
}

TEST_F(SlideCommand, WrongInputIsRefusedWithItsPlace)
{
    const auto says = [&](const std::vector<std::string>& words, const std::string& what) {
        const ProgramAnswer a = answer_of(words);
        EXPECT_NE(a.code, 0);
        EXPECT_NE(a.talk.find(what), std::string::npos) << a.talk;
    };
    const std::string record = file("pulse.csv");
    says({"slide", "--yield-table", file("late.csv"), "--record", record}, "late.csv:2");
    says({"slide", "--yield-table", file("back.csv"), "--record", record}, "back.csv:4");
    const auto table_says = [&](const std::string& text, const std::string& what) {
        std::ofstream(folder / "table.csv") << text;
        says({"slide", "--yield-table", file("table.csv"), "--record", record}, what);
    };
    table_says("slip_in,yield_g\n0,0.1\n50,0.08\n", "table.csv:1: error: 'slip_in,yield_g' is no heading of a yield");
    table_says("slip_mm,yield_kPa\n0,0.1\n50,0.08\n", "table.csv:1: error:");
    table_says("slip_mm,slip_m\n0,0.1\n50,0.08\n", "table.csv:1: error:");
    table_says("slip in m and yield in m/s2\n0,1.2\n0.05,0.8\n", "table.csv:1: error:");
    table_says("slip_m,yield_m_s2\n0,120\n0.05,0.8\n", "table.csv:2:3: error: a yield acceleration of 120 m/s2.");
    says({"slide", "--record", record}, "--yield-g");
    says({"slide", "--yield-g", "0.1,11", "--record", record}, "--yield-g 11 is not allowed");
    says({"slide", "--yield-g", "0.1,nan", "--record", record}, "--yield-g");
    says({"slide", "--yield-g", "0.1", "--yield-m-s2", "1", "--record", record}, "--yield-table");
    says({"slide", "--yield-g", "0.1"}, "--record FILE");
    says({"slide", "--yield-g", "0.1", "--record", record, "--method", "coupled"}, "--period-s");
    says({"slide", "--yield-g", "0.1", "--record", record, "--damping", "0.1"}, "--damping without a period");
}

} // namespace
} // namespace damslip
