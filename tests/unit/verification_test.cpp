// Every registered verification case is a ctest test of its own name.
#include "verification/cases/registry.hpp"

#include <gtest/gtest.h>

#include <iterator>
#include <ostream>

namespace damslip::verification {

/// Test listings show the id, not the bytes of the case.
void PrintTo(const Case& subject, std::ostream* out)
{
    *out << subject.id;
}

} // namespace damslip::verification

namespace {

using damslip::verification::Case;

class Verification : public testing::TestWithParam<Case> {};

TEST_P(Verification, holds)
{
    for (const auto& check : GetParam().run())
        EXPECT_TRUE(check.passed()) << check.quantity << " [" << check.unit << "]: computed " << check.computed
                                    << ", expected " << check.expected << ", error " << check.error() << ", tolerance "
                                    << check.tolerance;
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Verification);
INSTANTIATE_TEST_SUITE_P(cases, Verification, testing::ValuesIn(damslip::verification::all_cases()),
                         [](const testing::TestParamInfo<Case>& info) {
                             std::string name = info.param.id;
                             for (char& c : name)
                                 if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                             return name;
                         });

} // namespace
