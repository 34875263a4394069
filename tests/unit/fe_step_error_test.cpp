// Error in the step from slips with several steps.
#include "fe2d/run/earthquake_pass.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

using namespace damslip::fe2d;

std::vector<SlipAtStep> of_order(double p, std::initializer_list<int> halvings)
{
    std::vector<SlipAtStep> slips;
    for (const int k : halvings) {
        const double slip = 1.0 + 0.3 * std::exp2(-p * k);
        slips.push_back({k, slip, slips.empty() ? 0.0 : std::abs(slip - slips.back().slip)});
    }
    return slips;
}

TEST(FeStepError, FindsOrderAndErrorOfAPowerOfTheStep)
{
    for (const double p : {1.0, 1.3, contact_order})
        for (const auto& halvings : {std::initializer_list<int>{0, 1, 2}, {0, 1, 3}, {1, 3, 4}}) {
            const std::vector<SlipAtStep> slips = of_order(p, halvings);
            EXPECT_NEAR(observed_order(slips), p, 1e-9);
            EXPECT_NEAR(step_error(slips), 1.25 * (slips.back().slip - 1.0), 1e-9);
        }
}

TEST(FeStepError, DoesNotRelyOnMoreThanTheUsualOrderNorOnLessThanOne)
{
    EXPECT_NEAR(observed_order(of_order(3.0, {0, 1, 2})), contact_order, 1e-9);
    EXPECT_NEAR(observed_order(of_order(0.5, {0, 1, 2})), 1.0, 1e-9);
    // First order: the finer one errs by the change; three times that.
    const std::vector<SlipAtStep> two = of_order(contact_order, {0, 1});
    EXPECT_DOUBLE_EQ(step_error(two), 3.0 * std::abs(two[0].slip - two[1].slip));
    const std::vector<SlipAtStep> still{{0, 0.7, 0.0}, {1, 0.7, 0.0}, {2, 0.7, 0.0}};
    EXPECT_EQ(step_error(still), 0.0);
}

// Two slips that agree after one far off: of the change before, an order of 1.5 leaves a 2^1.5th.
TEST(FeStepError, DoesNotBelieveASuddenAgreement)
{
    const std::vector<SlipAtStep> sudden{{0, 0.5, 0.0}, {1, 0.7, 0.2}, {2, 0.7, 0.0}};
    EXPECT_NEAR(step_error(sudden), 1.25 * 0.2 * std::exp2(-1.5) / (std::exp2(1.5) - 1.0), 1e-12);
    const std::vector<SlipAtStep> cubic = of_order(3.0, {0, 1, 2});
    EXPECT_GT(step_error(cubic), cubic.back().slip - 1.0);
}

// Where a bond breaks the changes scatter: a third that is a tenth of the second counts as half of it.
TEST(FeStepError, OfSuddenJointsFallsWithFirstOrderAtMost)
{
    const std::vector<SlipAtStep> smooth = of_order(1.5, {0, 1, 2});
    EXPECT_EQ(observed_order(smooth, sudden_order), 1.0);
    const std::vector<SlipAtStep> scatter{{0, 0.5, 0.0}, {1, 0.7, 0.2}, {2, 0.68, 0.02}};
    EXPECT_DOUBLE_EQ(step_error(scatter, sudden_order), 1.25 * 0.1);
    EXPECT_LT(step_error(scatter), 0.05);
}

// Two slides whose errors cancel at the end: the histories are 0.1 apart in between.
TEST(FeStepError, IsOfTheWholeHistory)
{
    const std::vector<double> coarse{0.0, 0.4, 1.0}, fine{0.0, 0.5, 1.0}, longer{0.0, 0.5, 1.0, 1.3};
    EXPECT_DOUBLE_EQ(largest_difference(coarse, fine), 0.1);
    EXPECT_DOUBLE_EQ(largest_difference(coarse, longer), 0.3); // of what they come to
    const std::vector<SlipAtStep> slips{{0, 1.0, 0.0}, {1, 1.0, largest_difference(coarse, fine)}};
    EXPECT_DOUBLE_EQ(step_error(slips), 3.0 * 0.1);
}

// The second event begins a row later in the second run; its slips are the same.
TEST(FeStepError, ComparesEventsFromTheirOwnBegin)
{
    const std::vector<double> a{0.0, 0.5, 0.5, 0.9}, b{0.0, 0.5, 0.5, 0.5, 0.9};
    const std::vector<std::size_t> a_starts{0, 2}, b_starts{0, 3};
    EXPECT_DOUBLE_EQ(largest_difference(a, a_starts, b, b_starts), 0.0);
    EXPECT_DOUBLE_EQ(largest_difference(a, b), 0.4);
}

// After two slips that are 1 apart the error is 3. The best that a third can show is 1.25 * 2^-1.5 / (2^1.5 - 1), a 12.4th of it;
// with first order 1.25 / 2, a 4.8th.
TEST(FeStepError, SkipsAPassThatCannotBeGoodEnough)
{
    const std::vector<SlipAtStep> two = of_order(contact_order, {0, 1}), three = of_order(contact_order, {0, 1, 2});
    EXPECT_EQ(next_halvings(two, 12.0), 2);
    EXPECT_EQ(next_halvings(two, 13.0), 3);
    EXPECT_EQ(next_halvings(two, 4.7, sudden_order), 2);
    EXPECT_EQ(next_halvings(two, 4.9, sudden_order), 3);
    EXPECT_EQ(next_halvings(three, 2.0), 3);
    EXPECT_EQ(next_halvings(three, 50.0), 3);
}

} // namespace
