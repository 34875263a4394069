// Regressions in `screen`: the weighted median under those of each record, weights and period from the scene.
#include "analysis/screen/screening.hpp"
#include "core/input_error.hpp"
#include "records/measure/measures.hpp"
#include "scene/read.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace {

using namespace damslip;
using namespace damslip;

const double omega = 4.0 * std::acos(-1.0);

/// 3 m/s^2 at 2 Hz over 5 s; peaks fall on samples.
Record ten_cycles()
{
    Record sine;
    sine.name = "sine", sine.dt = 0.0125;
    for (int k = 0; k <= 400; ++k) sine.acceleration.push_back(3.0 * std::sin(omega * sine.dt * k));
    return sine;
}

/// A dry block on friction 0.1 (k_y = 0.1 * 9.81/9.80665) under these ten cycles.
std::vector<RegressionRow> regression_rows_of(const std::string& tables, const std::string& of_record = "")
{
    Scene scene =
        parse_scene("[section]\nheight_m = 10\nbase_m = 8\n[dam]\ndensity_kg_m3 = 2500\n[contact]\nfriction = 0.1\n" +
                        tables + "[[motion.record]]\nhorizontal = \"sine.csv\"\n" + of_record,
                    "block.toml", FileCheck::skip);
    const Record sine = ten_cycles();
    const auto records = std::make_shared<const std::vector<RecordPair>>(
        std::vector<RecordPair>{{scene.motion.records.at(0), sine, std::nullopt}});
    return run_screening(prepare(scene, Method::rigid_block, records), 1).regressions;
}

const RegressionRow* row_named(const std::vector<RegressionRow>& rows, const std::string& model)
{
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const RegressionRow& r) { return r.model == model; });
    return row == rows.end() ? nullptr : &*row;
}

} // namespace

TEST(ScreenRegressions, weighted_median_is_the_last_row)
{
    const auto rows = regression_rows_of("");
    ASSERT_FALSE(rows.empty());
    EXPECT_EQ(rows.back().model, "weighted median");
    EXPECT_GT(*rows.back().median, 0.0);
    EXPECT_LT(*rows.back().low, *rows.back().high);
    EXPECT_NE(rows.back().remark.find("equal weights"), std::string::npos) << rows.back().remark;
}

TEST(ScreenRegressions, weights_of_the_scene)
{
    const auto rows = regression_rows_of("[[regressions.weight]]\nmodel = \"jibson-2007-ratio\"\nweight = 1\n"
                                         "[[regressions.weight]]\nmodel = \"ambraseys-menu-1988\"\nweight = 3\n");
    const RegressionRow *a = row_named(rows, "Ambraseys & Menu 1988"), *b = row_named(rows, "Jibson 2007 (6)");
    ASSERT_TRUE(a && b);
    // The quantile of the mixture: 0.75 Phi(log10(D/a)/0.30) + 0.25 Phi(log10(D/b)/0.51) = 1/2.
    const auto phi = [](double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); };
    EXPECT_NEAR(0.75 * phi(std::log10(*rows.back().median / *a->median) / 0.30) +
                    0.25 * phi(std::log10(*rows.back().median / *b->median) / 0.51),
                0.5, 1e-12);
    EXPECT_DOUBLE_EQ(*a->weight, 0.75);
    EXPECT_DOUBLE_EQ(*b->weight, 0.25);
    EXPECT_EQ(rows.back().remark, "of 2, weights of the scene");
    EXPECT_THROW(regression_rows_of("[[regressions.weight]]\nmodel = \"jibson-207\"\n"), InputError);
}

// A magnitude calls the models that ask for one; a period those of flexible masses.
TEST(ScreenRegressions, magnitude_and_period)
{
    const auto bare = regression_rows_of("");
    EXPECT_EQ(row_named(bare, "Bray & Travasarou 2007")->status, "needs magnitude");
    EXPECT_FALSE(row_named(bare, "Bray & Travasarou 2007")->median);
    const auto rigid = regression_rows_of("", "magnitude = 6.5\n");
    EXPECT_EQ(row_named(rigid, "Bray & Travasarou 2007")->status, "valid");
    EXPECT_EQ(row_named(rigid, "Bray & Macedo 2019, general")->status, "needs period");
    const auto flexible = regression_rows_of("[regressions]\nperiod_s = 0.3\n", "magnitude = 6.5\n");
    EXPECT_TRUE(row_named(flexible, "Bray & Macedo 2019, general")->median);
    EXPECT_TRUE(row_named(flexible, "Rathje & Antonakos 2011, PGA, M")->median);
    // The oscillators of 0.39 and 0.45 s are near the 0.5 s of the motion: more slip than of the rigid mass.
    EXPECT_GT(*row_named(flexible, "Bray & Travasarou 2007")->median,
              *row_named(rigid, "Bray & Travasarou 2007")->median);
}

// N_eq sine cycles of a_max and T_m with the record's Arias intensity: N_eq T_m is the record's 5 s, less the share (2 +
// cos w h)/3 that the polygon through the samples keeps of the integral of a^2. Yegian's D is a_max N_eq T_m^2 10^f(r).
TEST(ScreenRegressions, equivalent_cycles_of_a_sine)
{
    const auto rows = regression_rows_of("");
    const RegressionRow* row = row_named(rows, "Yegian et al. 1991");
    ASSERT_TRUE(row);
    const double t_m = *records::measure(ten_cycles()).mean_period;
    EXPECT_NEAR(t_m, 0.5, 0.02); // finite in time: some width in frequency
    const double r = 0.981 / 3.0, kept = (2.0 + std::cos(omega * 0.0125)) / 3.0;
    const double f = 0.22 - 10.12 * r + 16.38 * r * r - 11.48 * r * r * r;
    EXPECT_NEAR(*row->median / (3.0 * 5.0 * kept * t_m * std::pow(10.0, f)), 1.0, 1e-12);
}
