// The flexible block: judged by its own slip, its decoupled slip exact, its limits and words true.
#include "analysis/screen/screening.hpp"
#include "pages/screen/screen_pages.hpp"
#include "program_answer.hpp"
#include "scene/read.hpp"
#include "sliding/flexible/flexible_mode.hpp"
#include "verification/exact/flexible_slip.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <unistd.h>

namespace {

using namespace damslip;
using FlexibleAnswer = nlohmann::json;

/// A level block on friction 0.12 under some seconds of a fading 2.5 Hz wave, asked through `screen`.
class AuditedFlexible : public testing::Test {
protected:
    void SetUp() override
    {
        folder = std::filesystem::temp_directory_path() / ("damslip_audit_flexible_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder);
        std::ofstream h(folder / "h.csv"), v(folder / "v.csv");
        h << "time_s,accel_m_s2\n";
        v << "time_s,accel_m_s2\n";
        for (int k = 0; k <= 500; ++k) {
            const double rise = std::sin(std::numbers::pi * k / 500.0);
            h << 0.01 * k << "," << 3.0 * rise * std::sin(0.16 * k) << "\n";
            v << 0.01 * k << "," << -12.0 * rise * std::sin(0.23 * k) << "\n";
        }
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    std::string scene(const std::string& tables, const std::string& of_record = "")
    {
        const std::string file = (folder / "block.toml").string();
        std::ofstream(file) << "[section]\nheight_m = 20\nbase_m = 40\ncrest_m = 40\n[dam]\ndensity_kg_m3 = 2000\n"
                            << "[contact]\nfriction = 0.12\n[[motion.record]]\nhorizontal = \"h.csv\"\n"
                            << of_record << tables;
        return file;
    }
    FlexibleAnswer screened(const std::string& file, std::vector<std::string> more = {})
    {
        std::vector<std::string> arguments{"screen", file, "--json", "--quiet"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const ProgramAnswer answer = answer_of(arguments);
        EXPECT_EQ(answer.code, 0) << answer.talk;
        return FlexibleAnswer::parse(answer.out);
    }
    static std::string allowable(double mm) { return "[criteria]\nallowable_slip_mm = " + std::to_string(mm) + "\n"; }

    std::filesystem::path folder;
};

/// Horizontal mass 1 on a level base, g = 10 m/s^2.
sliding::SlipStages audited_block(double yield)
{
    sliding::RigidBlock block;
    block.mass = 1.0;
    block.gravity = 10.0;
    block.friction = 0.1 * yield;
    return {{0.0, block, 0.0}};
}

/// Three sines of no common period within 6 s, `dt` apart.
GroundMotion audited_motion(double dt)
{
    GroundMotion motion;
    motion.dt = dt;
    for (double t = 0.0; t < 6.0; t += dt) {
        const double rise = std::sin(std::numbers::pi * t / 6.0);
        motion.accel_h.push_back(rise * rise *
                                 (2.0 * std::sin(9.1 * t) + 1.3 * std::sin(23.7 * t) + std::sin(3.3 * t)));
    }
    return motion;
}

// Softer than rigid and slipping farther: between both slips the rigid one would pass.
TEST_F(AuditedFlexible, A12_coupled_slip_is_judged)
{
    const std::string block = "[flexible_block]\nperiod_s = 0.25\n";
    const FlexibleAnswer row = screened(scene(block))["flexible_block"][0];
    const double rigid = row["rigid_max_slip_mm"], coupled = row["coupled_max_slip_mm"];
    EXPECT_TRUE(row["verdict"].is_null());
    ASSERT_GT(coupled, 1.2 * rigid);
    const FlexibleAnswer judged = screened(scene(block + allowable(0.5 * (rigid + coupled))));
    EXPECT_EQ(judged["flexible_block"][0]["judged_by"], "coupled");
    EXPECT_EQ(judged["flexible_block"][0]["verdict"], "FAIL");
    EXPECT_EQ(judged["displacements"][0]["verdict"], "judged by coupled");
    EXPECT_EQ(screened(scene(block + allowable(1.01 * coupled)))["flexible_block"][0]["verdict"], "PASS");
}

// And the other way round: a soft block that a rigid one would fail.
TEST_F(AuditedFlexible, A12_rigid_slip_is_not_judged)
{
    const std::string block = "[flexible_block]\nperiod_s = 0.6\n";
    const FlexibleAnswer row = screened(scene(block))["flexible_block"][0];
    const double rigid = row["rigid_max_slip_mm"], coupled = row["coupled_max_slip_mm"];
    ASSERT_LT(1.2 * coupled, rigid);
    const FlexibleAnswer judged = screened(scene(block + allowable(0.5 * (rigid + coupled))));
    EXPECT_EQ(judged["flexible_block"][0]["verdict"], "PASS");
}

TEST_F(AuditedFlexible, A12_decoupled_judges_alone)
{
    const std::string block = "[flexible_block]\nperiod_s = 0.4\nmode = \"decoupled\"\n";
    const FlexibleAnswer row = screened(scene(block))["flexible_block"][0];
    const double slip = row["decoupled_max_slip_mm"];
    const FlexibleAnswer judged = screened(scene(block + allowable(0.99 * slip)));
    EXPECT_EQ(judged["flexible_block"][0]["judged_by"], "decoupled");
    EXPECT_EQ(judged["flexible_block"][0]["verdict"], "FAIL");
    EXPECT_EQ(judged["displacements"][0]["verdict"], "judged by decoupled");
}

// The coupled analysis keeps the block on its base: where it opens, decoupled judges, or nothing is decided.
TEST_F(AuditedFlexible, A12_an_opening_base_is_not_judged_by_coupled)
{
    const std::string vertical = "vertical = \"v.csv\"\n", generous = allowable(1e5);
    const FlexibleAnswer both = screened(scene("[flexible_block]\nperiod_s = 0.25\n" + generous, vertical));
    ASSERT_GT(both["displacements"][0]["lift_offs"].get<int>(), 0);
    EXPECT_EQ(both["flexible_block"][0]["judged_by"], "decoupled");
    EXPECT_EQ(both["flexible_block"][0]["verdict"], "PASS");
    const FlexibleAnswer coupled =
        screened(scene("[flexible_block]\nperiod_s = 0.4\nmode = \"coupled\"\n" + generous, vertical));
    EXPECT_EQ(coupled["flexible_block"][0]["verdict"], "undecided");
    EXPECT_NE(coupled["warnings"].dump().find("the base opens, which the coupled analysis does not follow"),
              std::string::npos);
}

TEST_F(AuditedFlexible, A12_headline_names_the_analysis)
{
    const std::string out = (folder / "out").string();
    const std::string block = "[flexible_block]\nperiod_s = 0.25\n";
    const FlexibleAnswer row = screened(scene(block))["flexible_block"][0];
    const double between = 0.5 * (row["rigid_max_slip_mm"].get<double>() + row["coupled_max_slip_mm"].get<double>());
    screened(scene(block + allowable(between)), {"--out", out});
    std::ifstream page(out + "/report.html"), csv(out + "/flexible_block.csv");
    const std::string html{std::istreambuf_iterator<char>(page), {}}, table{std::istreambuf_iterator<char>(csv), {}};
    EXPECT_NE(html.find("flexible block, coupled)"), std::string::npos);
    EXPECT_NE(html.find("Largest slip, coupled"), std::string::npos);
    EXPECT_NE(html.find("FAIL"), std::string::npos);
    EXPECT_EQ(html.find("PASS"), std::string::npos);
    EXPECT_NE(table.find("FAIL"), std::string::npos);
}

// Against steps of fourth order a 64th of a radian long, until the vibration has faded: stiff to soft, the yield near the peak included, where chords
// of k were up to a per cent low. 1e-6 is what events are located within.
TEST(Audit, A13_decoupled_is_exact)
{
    for (const double dt : {0.005, 0.02}) {
        const GroundMotion motion = audited_motion(dt);
        for (const double period : {0.02, 0.08, 0.3, 0.7, 2.0, 12.0}) {
            sliding::FlexibleBlock block;
            block.period = period;
            sliding::SlideOptions options;
            options.sliding.two_way = false;
            const double peak = sliding::slide_decoupled(motion, audited_block(50.0), block, options).peak_acceleration;
            for (const double share : {0.2, 0.6, 0.9})
                for (const int polarity : {1, -1}) {
                    options.polarity = polarity;
                    const exact::FlexibleSlipCase c{2.0 * std::numbers::pi / period, block.damping_ratio,
                                                    block.mass_ratio, share * peak};
                    std::vector<double> accel = motion.accel_h;
                    for (double& a : accel) a *= polarity;
                    const double expected =
                        exact::slip_decoupled_by_steps(c, accel, dt, std::min(60.0, 25.0 * period), 64.0);
                    const double slip =
                        sliding::slide_decoupled(motion, audited_block(share * peak), block, options).slide.slip;
                    EXPECT_NEAR(slip, expected, 1e-6 * expected + 1e-12)
                        << "dt " << dt << " T " << period << " yield/peak " << share << " polarity " << polarity;
                }
        }
    }
}

// Both ways, with vertical motion that opens the base, cohesion lost and friction that falls with slip: no closed oracle, but
// the same ground in samples a 32nd as far apart is the same ground.
TEST(Audit, A13_decoupled_does_not_depend_on_the_samples)
{
    GroundMotion coarse = audited_motion(0.02);
    for (std::size_t k = 0; k < coarse.accel_h.size(); ++k)
        coarse.accel_v.push_back(9.0 * std::sin(0.11 * static_cast<double>(k)) *
                                 std::sin(0.01 * static_cast<double>(k)));
    GroundMotion fine;
    fine.dt = coarse.dt / 32.0;
    for (std::size_t k = 0; k + 1 < coarse.accel_h.size(); ++k)
        for (int i = 0; i < 32; ++i) {
            const double part = i / 32.0;
            fine.accel_h.push_back(coarse.accel_h[k] + part * (coarse.accel_h[k + 1] - coarse.accel_h[k]));
            fine.accel_v.push_back(coarse.accel_v[k] + part * (coarse.accel_v[k + 1] - coarse.accel_v[k]));
        }
    fine.accel_h.push_back(coarse.accel_h.back());
    fine.accel_v.push_back(coarse.accel_v.back());
    sliding::SlipStages stages = audited_block(1.0);
    stages[0].block.cohesion_force = 0.3;
    stages[0].block.base_inclination = 0.02;
    sliding::SlipStage falling = stages[0];
    falling.block.cohesion_force = 0.0;
    falling.friction_slope = -2.0;
    sliding::SlipStage residual = falling;
    residual.from_slip = 0.02;
    residual.friction_slope = 0.0;
    residual.block.friction -= 0.04;
    stages.push_back(falling);
    stages.push_back(residual);
    for (const LiftOff lift_off : {LiftOff::no_friction, LiftOff::ballistic})
        for (const double period : {0.1, 0.6, 4.0}) {
            sliding::FlexibleBlock block;
            block.period = period;
            sliding::SlideOptions options;
            options.sliding.lift_off = lift_off;
            const auto a = sliding::slide_decoupled(coarse, stages, block, options),
                       b = sliding::slide_decoupled(fine, stages, block, options);
            EXPECT_GT(a.slide.downstream_slip, 0.005);
            EXPECT_NEAR(a.slide.downstream_slip, b.slide.downstream_slip, 2e-6 * b.slide.downstream_slip) << period;
            EXPECT_NEAR(a.slide.upstream_slip, b.slide.upstream_slip, 2e-6 * b.slide.downstream_slip) << period;
            EXPECT_NEAR(a.peak_acceleration, b.peak_acceleration, 1e-8 * b.peak_acceleration) << period;
            EXPECT_EQ(a.slide.status, b.slide.status);
        }
}

TEST_F(AuditedFlexible, A13_scheme_is_of_the_rigid_block_alone)
{
    const std::string file = scene("[flexible_block]\nperiod_s = 0.25\n");
    const FlexibleAnswer exact = screened(file), slammer = screened(file, {"--scheme", "slammer"});
    const FlexibleAnswer &a = exact["flexible_block"][0], &b = slammer["flexible_block"][0];
    EXPECT_NE(a["rigid_max_slip_mm"], b["rigid_max_slip_mm"]);
    EXPECT_EQ(a["decoupled_max_slip_mm"], b["decoupled_max_slip_mm"]);
    EXPECT_EQ(a["coupled_max_slip_mm"], b["coupled_max_slip_mm"]);
    EXPECT_NE(slammer["warnings"].dump().find("is the rigid block's"), std::string::npos);
}

// A landslide mass may have 20 s. Ever softer, k is that of the rest of the mass that the mode leaves, and decoupled less than
// coupled by it: no bound.
TEST_F(AuditedFlexible, A13_long_periods_are_taken)
{
    const std::string file = scene("[flexible_block]\nperiod_s = 20\n");
    screened(file);
    EXPECT_NE(answer_of({"screen", file}).out.find("a period this long: one mode says little"), std::string::npos);
    EXPECT_EQ(answer_of({"screen", scene("[flexible_block]\nperiod_s = 0.25\n")}).out.find("a period this long"),
              std::string::npos);
    EXPECT_EQ(answer_of({"screen", scene("[flexible_block]\nperiod_s = 101\n")}).code, 3);

    const GroundMotion motion = audited_motion(0.01);
    sliding::FlexibleBlock block;
    block.period = 1e4;
    const double yield = 0.1, rest = 1.0 - block.mass_ratio;
    const double slip = sliding::slide(motion, audited_block(yield / rest)).max_slip;
    EXPECT_NEAR(sliding::slide_coupled(motion, audited_block(yield), block).slide.max_slip, slip, 4e-3 * slip);
    EXPECT_NEAR(sliding::slide_decoupled(motion, audited_block(yield), block).slide.max_slip, rest * slip, 4e-3 * slip);
}

// What sliding leaves of the peak is the yield where it may slide both ways; one way nothing limits it the other way.
TEST(Audit, A13_peak_average_is_the_yield_only_both_ways)
{
    const GroundMotion motion = audited_motion(0.01);
    sliding::FlexibleBlock block;
    block.period = 0.3;
    sliding::SlideOptions options;
    const double yield = 0.8;
    EXPECT_NEAR(sliding::slide_coupled(motion, audited_block(yield), block, options).peak_acceleration, yield, 1e-9);
    options.sliding.two_way = false;
    EXPECT_GT(sliding::slide_coupled(motion, audited_block(yield), block, options).peak_acceleration, 1.5 * yield);
}

// No damping: at the end of the run-out the block may rest for a moment, but its vibration goes on moving it.
TEST(Audit, A13_a_block_that_still_vibrates_is_not_at_rest)
{
    const GroundMotion motion = audited_motion(0.01);
    sliding::FlexibleBlock block;
    block.period = 0.7;
    block.damping_ratio = 0.0;
    sliding::SlideOptions options;
    for (const double run_out : {1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6}) {
        options.sliding.run_out_max = run_out;
        const auto r = sliding::slide_decoupled(motion, audited_block(0.2), block, options);
        EXPECT_EQ(r.slide.status, Status::sliding_at_end) << run_out;
    }
}

} // namespace
