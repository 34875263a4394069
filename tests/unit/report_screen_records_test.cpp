// Charts of many records: nine pulses on a one-way block, whose slips follow by hand (pulse_scene.hpp).
#include "pulse_scene.hpp"

#include "analysis/screen/screening.hpp"
#include "pages/screen/screen_pages.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace damslip {
namespace {

constexpr int pulses = 9;

double plateau(int i)
{
    return 2.0 + 0.5 * i; // [m/s^2]
}

class ScreenRecords : public testing::Test {
protected:
    void SetUp() override
    {
        std::string list = "horizontal\n";
        for (int i = 0; i < pulses; ++i) {
            write_file(folder / fmt::format("pulse{}.csv", i), pulse::record_text(plateau(i)));
            list += fmt::format("pulse{}.csv\n", i);
        }
        write_file(folder / "list.csv", list);
        std::string text =
            "[section]\nheight_m = 50\nbase_m = 40\ncrest_m = 5\n[dam]\ndensity_kg_m3 = 2400\n[contact]\n"
            "friction = 0.15\n[sliding]\ntwo_way = false\n";
        for (int i = 0; i < pulses; ++i)
            text += fmt::format("[[motion.record]]\nname = \"p{0}\"\nhorizontal = \"pulse{0}.csv\"\n", i);
        scene.emplace(SceneText(text, folder / "dam.toml").scene());
        ready.emplace(prepare(*scene, Method::rigid_block));
        screening = run_screening(*ready, 1);
        page = pages::screen_page({*scene, ready->scene, screening, ready->records(), 1});
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    const pages::Chart& chart(const std::string& title) const
    {
        for (const pages::Section& section : page.sections)
            for (const pages::Part& part : section.parts)
                if (const auto* chart = std::get_if<pages::Chart>(&part); chart && chart->title == title) return *chart;
        throw std::out_of_range(title);
    }

    const std::filesystem::path folder = pulse::folder() / "screened";
    std::optional<Scene> scene;
    std::optional<Ready> ready;
    Screening screening;
    pages::Page page;
};

/// Of the worse polarity: pushed against its downstream side the one-way block is not moved, so that it is that of the pulse as it is [mm].
double slip_mm(double mu, int i)
{
    return 1e3 * pulse::slip(mu, plateau(i));
}

// Of nine values the median is the fifth; the band from 16 to 84 % lies between the second and third, the seventh and eighth: ranks 1.28 and 6.72 of 0 to 8.
TEST_F(ScreenRecords, SlipOverFrictionIsTheMedianTheBandAndTheLargest)
{
    const pages::Chart& over_friction = chart("Slip over friction");
    ASSERT_EQ(over_friction.curves.size(), 2u);
    const pages::Curve &median = over_friction.curves[0], &largest = over_friction.curves[1];
    ASSERT_GE(median.x.size(), 10u);
    bool slides = false;
    for (std::size_t k = 0; k < median.x.size(); ++k) {
        const double mu = median.x[k];
        const auto between = [&](double rank) {
            const int below = static_cast<int>(rank);
            return slip_mm(mu, below) + (rank - below) * (slip_mm(mu, below + 1) - slip_mm(mu, below));
        };
        const auto near = [](double value) { return 1e-9 + 1e-6 * value; };
        EXPECT_NEAR(median.y[k], slip_mm(mu, 4), near(slip_mm(mu, 4))) << mu;
        EXPECT_NEAR(median.low[k], between(1.28), near(between(1.28))) << mu;
        EXPECT_NEAR(median.high[k], between(6.72), near(between(6.72))) << mu;
        EXPECT_NEAR(largest.y[k], slip_mm(mu, pulses - 1), near(slip_mm(mu, pulses - 1))) << mu;
        slides |= median.y[k] > 1.0;
    }
    EXPECT_TRUE(slides);
}

// a_y = mu g of a dry horizontal base; the strongest record has the least ratio and comes first.
TEST_F(ScreenRecords, SlipOverTheYieldRatioIsInItsOrder)
{
    const pages::Chart& over_ratio = chart("Slip over a_y/PGA");
    ASSERT_EQ(over_ratio.curves.size(), 1u); // no record has a vertical component
    const pages::Curve& slips = over_ratio.curves[0];
    ASSERT_EQ(slips.x.size(), static_cast<std::size_t>(pulses));
    for (int k = 0; k < pulses; ++k) {
        const int i = pulses - 1 - k;
        const auto at = static_cast<std::size_t>(k);
        EXPECT_NEAR(slips.x[at], 0.15 * scene->gravity / plateau(i), 1e-12);
        EXPECT_NEAR(slips.y[at], slip_mm(0.15, i), 1e-6 * slip_mm(0.15, i) + 1e-9);
    }
}

} // namespace
} // namespace damslip
