// A step allocates no memory once its work space is there: what it needs is kept by the stepper, the ledger and the solvers.
#include "step_allocations.hpp"

#include <gtest/gtest.h>

namespace damslip::test {
namespace {

TEST(StepAllocations, TheCounterCounts)
{
    const long before = allocations();
    std::vector<double> values(100);
    EXPECT_EQ(allocations(), before + 1);
    values.resize(200);
    EXPECT_EQ(allocations(), before + 2);
}

/// Landings, changing sets of states and slip are among the steps counted; the first ten make operators and work space.
void expect_none(CountedRun which)
{
    constexpr std::size_t first_steps = 10;
    const StepAllocations counted = count_allocations(which, 4.0, 2.5, 10.0);
    ASSERT_GT(counted.by_step.size(), 900u);
    EXPECT_GT(counted.slip, 1e-3);
    for (std::size_t k = first_steps; k < counted.by_step.size(); ++k)
        EXPECT_EQ(counted.by_step[k], 0) << "in step " << k + 2;
}

TEST(StepAllocations, NoneOnMasslessRock)
{
    expect_none(CountedRun::massless);
}

TEST(StepAllocations, NoneOnRadiatingRock)
{
    expect_none(CountedRun::radiating);
}

TEST(StepAllocations, NoneInTheReducedRun)
{
    expect_none(CountedRun::reduced);
}

} // namespace
} // namespace damslip::test
