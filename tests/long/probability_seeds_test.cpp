#include "verification/cases/probability_seeds.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace damslip::verification;

namespace {

// 3000 intervals of a true 95 %: 0.95 +- 0.004. 93.5 ... 96.5 % is passed by it and by none of 93 %.
void expect_covers(const SeedStudy& s)
{
    EXPECT_GE(s.covered, 0.935 * s.seeds);
    EXPECT_LE(s.covered, 0.965 * s.seeds);
}

} // namespace

TEST(ProbabilitySeeds, TwoLevelHasNoBiasAndCoversWithAGoodCheapModel)
{
    const SeedStudy s = study_two_level(3000, 100, CheapModel::good, SuiteOf::all_records);
    EXPECT_LE(std::abs(s.mean - s.exact), s.bound());
    EXPECT_NEAR(s.mean_se / s.sd, 1.0, 0.1); // calibration is refitted in each fold: 10 % at n = 100
    expect_covers(s);
}

TEST(ProbabilitySeeds, TwoLevelHasNoBiasAndCoversWithAWorthlessOne)
{
    const SeedStudy s = study_two_level(3000, 100, CheapModel::worthless, SuiteOf::all_records);
    EXPECT_LE(std::abs(s.mean - s.exact), s.bound());
    expect_covers(s);
}

TEST(ProbabilitySeeds, TwoLevelHasNoBiasOverTenRecordsOfStrongEffect)
{
    const SeedStudy s = study_two_level(3000, 100, CheapModel::good, SuiteOf::ten_records);
    EXPECT_LE(std::abs(s.mean - s.exact), s.bound());
    EXPECT_GE(s.mean_se, 0.9 * s.sd); // balanced records scatter less than the formula of independent ones says
}
