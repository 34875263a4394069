// What an allowable slip asks for: the seismic coefficient and the friction, beside closed forms.
#include "analysis/screen/screening.hpp"
#include "scene/read.hpp"
#include "sliding/block/slide_batch.hpp"
#include "sweep_scene.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace damslip::sweep_tests {

namespace {

constexpr double peak = 3.0, length = 0.5; ///< of the triangle below [m/s^2], [s]

/// Begins at its peak and falls to zero as a line. A one-way block with the yield y > peak/2 slips
/// D = 2/3 T^2 (A - y)^3 / A^2 and stops within it, at 2 T (A - y)/A.
GroundMotion falling_triangle()
{
    GroundMotion motion;
    motion.name = "triangle";
    motion.dt = length;
    motion.accel_h = {peak, 0.0, 0.0, 0.0};
    return motion;
}

double slip_of(double yield)
{
    return 2.0 / 3.0 * length * length * std::pow(peak - yield, 3) / (peak * peak);
}

TEST(YieldForSlip, is_the_closed_form_of_a_triangle)
{
    const sliding::SkippingMotion motion(falling_triangle());
    for (const double yield : {1.6, 2.0, 2.9, 2.999}) {
        const std::optional<double> found = sliding::yield_for_slip(motion, slip_of(yield));
        ASSERT_TRUE(found);
        EXPECT_NEAR(*found, yield, 1e-10 * peak) << yield; // the slip is flat near the peak: third root of round-off
    }
    EXPECT_EQ(*sliding::yield_for_slip(motion, 0.0), peak);
    EXPECT_EQ(*sliding::yield_for_slip(motion, 0.0, -1), 0.0); // it never drives the other way
}

TEST(YieldForSlip, a_slip_that_no_yield_reaches_has_none)
{
    GroundMotion motion = falling_triangle();
    motion.accel_h = {peak, -peak, 0.0, 0.0}; // what it gives it takes
    motion.accel_h.resize(200, 0.0);
    const sliding::SkippingMotion shaking(motion);
    EXPECT_FALSE(sliding::yield_for_slip(shaking, 1e4));
    EXPECT_TRUE(sliding::yield_for_slip(shaking, 0.01));
}

/// A dry block that slides one way under the triangle.
Screening screened(const std::string& criteria)
{
    const Scene scene =
        parse_scene("[section]\nheight_m = 10\nbase_m = 20\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = "
                    "0.7\n[sliding]\ntwo_way = false\n" +
                        criteria + "[[motion.record]]\nhorizontal = \"triangle.csv\"\n",
                    "block.toml", FileCheck::skip);
    Record triangle;
    triangle.name = "triangle";
    triangle.dt = length;
    triangle.acceleration = {peak, 0.0, 0.0, 0.0};
    const auto records = std::make_shared<const std::vector<RecordPair>>(
        std::vector<RecordPair>{{scene.motion.records.at(0), triangle, std::nullopt}});
    return run_screening(prepare(scene, Method::rigid_block, records), 1);
}

TEST(Needed, friction_of_a_dry_block_is_its_yield_over_g)
{
    const Screening s = screened("[criteria]\nallowable_slip_mm = 5\n");
    ASSERT_EQ(s.needed.size(), 2u);
    // A record that does not begin at zero gets a zero sample in front: up and down a triangle of 2 T. It slides from u before the peak to
    // q u after it, u = T (A - y)/A, q = 1 + sqrt(2), and D = A u^3/T (1/6 + q/2 + q^2/2 - q^3/6).
    const double q = 1.0 + std::sqrt(2.0), shape = 1.0 / 6.0 + q / 2.0 + q * q / 2.0 - q * q * q / 6.0;
    const double yield = peak - peak / length * std::cbrt(0.005 * length / (peak * shape));
    EXPECT_EQ(s.needed[0].peak, peak);
    EXPECT_NEAR(*s.needed[0].yield, yield, 1e-9);
    EXPECT_NEAR(*s.needed[0].friction, yield / 9.81, 2e-7); // of the bisection
    EXPECT_EQ(s.needed[1].peak, 0.0);                       // reversed it drives nothing downstream
}

TEST(Needed, nothing_without_an_allowable_slip)
{
    EXPECT_TRUE(screened("").needed.empty());
}

TEST_F(SweepScene, FrictionForTheAllowableSlipLiesBetweenTwoOfTheGrid)
{
    write("block.toml", content("block.toml") + "[criteria]\nallowable_slip_mm = 400\n");
    const Answer coarse = sweep({"--friction", "0.08:0.2:0.02", "--method", "rigid"});
    ASSERT_EQ(coarse.code, 0) << coarse.talk;
    EXPECT_NE(coarse.talk.find("Friction for a slip of 400 mm at most"), std::string::npos) << coarse.talk;
    const Answer none = sweep({"--friction", "0.1", "--method", "rigid"});
    EXPECT_EQ(none.talk.find("Friction for a slip"), std::string::npos);
}

TEST_F(SweepScene, FlexibleRowsAreThoseOfScreen)
{
    write("block.toml", content("block.toml") + "[flexible_block]\nperiod_s = 0.3\ndamping = 0.07\n");
    const Answer rows = sweep({"--method", "rigid,decoupled,coupled", "--polarity", "1", "--json"});
    ASSERT_EQ(rows.code, 0) << rows.talk;
    const Answer screened = answer_of({"screen", path("block.toml"), "--json"});
    const auto swept = nlohmann::json::parse(rows.out)["rows"];
    const auto flexible = nlohmann::json::parse(screened.out)["flexible_block"];
    ASSERT_EQ(swept.size(), 6u);
    for (std::size_t record : {0u, 1u}) { // screen has both polarities of each
        const auto& row = flexible[2 * record];
        EXPECT_DOUBLE_EQ(swept[3 * record + 1]["max_slip_m"].get<double>() * 1e3,
                         row["decoupled_max_slip_mm"].get<double>());
        EXPECT_DOUBLE_EQ(swept[3 * record + 2]["max_slip_m"].get<double>() * 1e3,
                         row["coupled_max_slip_mm"].get<double>());
    }
}

TEST_F(SweepScene, PeriodsAndDampingAreAxes)
{
    const Answer rows = sweep({"--method", "rigid,coupled", "--period", "0.2,0.4", "--damping", "0.02,0.1",
                               "--polarity", "1", "--record", path("pulse.csv"), "--json"});
    ASSERT_EQ(rows.code, 0) << rows.talk;
    const auto swept = nlohmann::json::parse(rows.out)["rows"];
    ASSERT_EQ(swept.size(), 8u);
    for (std::size_t i = 0; i < 8; ++i) {
        EXPECT_EQ(swept[i]["period_s"].get<double>(), i < 4 ? 0.2 : 0.4);
        EXPECT_EQ(swept[i]["damping"].get<double>(), i % 4 < 2 ? 0.02 : 0.1);
        if (i % 2 == 0) {
            EXPECT_EQ(swept[i]["max_slip_m"], swept[0]["max_slip_m"]); // the rigid block has no period
        }
    }
    // Each row is that of a scene with these values.
    write("block.toml", content("block.toml") + "[flexible_block]\nperiod_s = 0.4\ndamping = 0.02\n");
    const Answer one = sweep({"--method", "coupled", "--polarity", "1", "--record", path("pulse.csv"), "--json"});
    EXPECT_EQ(nlohmann::json::parse(one.out)["rows"][0]["max_slip_m"], swept[5]["max_slip_m"]);
    // Parts put together have the rows of the whole.
    const std::vector<std::string> grid_of{"--method", "rigid,coupled", "--period",
                                           "0.2,0.4",  "--out",         path("all.csv")};
    ASSERT_EQ(sweep(grid_of).code, 0);
    for (const char* part : {"0/2", "1/2"}) ASSERT_EQ(sweep(with(grid_of, {"--shard", part})).code, 0);
    const Answer merged = answer_of(
        {"sweep", "--merge", path("all.0-of-2.sqlite"), path("all.1-of-2.sqlite"), "--out", path("merged.csv")});
    ASSERT_EQ(merged.code, 0) << merged.talk;
    EXPECT_EQ(content("merged.csv"), content("all.csv"));
}

TEST_F(SweepScene, AFlexibleMethodWithoutAModeIsRefused)
{
    const Answer none = sweep({"--method", "coupled"});
    EXPECT_EQ(none.code, 2);
    EXPECT_NE(none.talk.find("--period 0.2"), std::string::npos) << none.talk;
    const Answer idle = sweep({"--period", "0.2"});
    EXPECT_EQ(idle.code, 2);
    EXPECT_NE(idle.talk.find("add coupled to --method"), std::string::npos) << idle.talk;
}

} // namespace

} // namespace damslip::sweep_tests
