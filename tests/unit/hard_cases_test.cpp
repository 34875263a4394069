// Every hard case is a ctest test of its own name.
#include "verification/hard/hard_case.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <fstream>
#include <iterator>
#include <ostream>
#include <set>

namespace damslip::hard {

/// Test listings show the id, not the bytes of the case.
void PrintTo(const HardCase& subject, std::ostream* out)
{
    *out << subject.id;
}

} // namespace damslip::hard

namespace {

using namespace damslip::hard;

class Hard : public testing::TestWithParam<HardCase> {};

TEST_P(Hard, holds)
{
    const HardResult r = GetParam().run();
    EXPECT_TRUE(passed(GetParam(), r)) << GetParam().quantity << " by " << GetParam().method_a << " " << r.value_a
                                       << ", by " << GetParam().method_b << " " << r.value_b << ", tolerance "
                                       << r.tolerance << ", complementarity " << r.complementarity.value_or(0.0)
                                       << ", energy closure " << r.energy_closure.value_or(0.0) << ", " << r.status;
}

TEST(HardCases, ThirtyAtLeastAndFewMayEndInAStatus)
{
    const std::set<std::string> may{"hard.friction.one-percent-below",
                                    "hard.friction.zero-with-water",
                                    "hard.rate.rebound-elastic",
                                    "hard.record.nan",
                                    "hard.self-excited.rigid-base",
                                    "hard.self-excited.stiff-massless-rock",
                                    "hard.time.ten-times-too-large",
                                    "hard.time.explicit-above-limit",
                                    "hard.time.central-difference-above-limit"};
    const HardCases cases = all_hard_cases();
    EXPECT_GE(cases.size(), 30u);
    std::set<std::string> ids;
    for (const HardCase& c : cases) {
        EXPECT_TRUE(ids.insert(c.id).second) << c.id;
        EXPECT_EQ(c.expected_status != "at rest", may.contains(c.id)) << c.id;
    }
}

/// @param thorough  those that take half a minute
HardCases cases_that_are(bool thorough)
{
    HardCases cases = all_hard_cases();
    std::erase_if(cases, [&](const HardCase& c) { return (c.id == "hard.time.thousand-times-too-small") != thorough; });
    return cases;
}

std::string test_name(const testing::TestParamInfo<HardCase>& info)
{
    std::string name = info.param.id;
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Hard);
INSTANTIATE_TEST_SUITE_P(cases, Hard, testing::ValuesIn(cases_that_are(false)), test_name);
INSTANTIATE_TEST_SUITE_P(Thorough, Hard, testing::ValuesIn(cases_that_are(true)), test_name);

} // namespace
