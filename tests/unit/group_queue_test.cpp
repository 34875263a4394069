// Who takes which groups of runs.
#include "analysis/fe/contact_runs.hpp"

#include <gtest/gtest.h>

namespace {

using namespace damslip;

TEST(GroupQueue, HandsOutEachGroupOnceInOrder)
{
    GroupQueue queue({0, 0, 1}, 1);
    EXPECT_EQ(queue.next(), 0U);
    EXPECT_EQ(queue.next(), 1U);
    EXPECT_EQ(queue.next(), 2U);
    EXPECT_EQ(queue.next(), std::nullopt);
}

TEST(GroupQueue, MoreAreOfTheSameModelAndNoMoreThanAskedFor)
{
    GroupQueue queue({0, 1, 0, 0, 0, 0}, 1);
    const std::size_t first = *queue.next();
    EXPECT_EQ(queue.more_of(first, 4), (std::vector<std::size_t>{2, 3, 4}));
    EXPECT_EQ(queue.next(), 1U);
    EXPECT_EQ(queue.next(), 5U);
    EXPECT_EQ(queue.next(), std::nullopt);
}

TEST(GroupQueue, NothingMoreWhereRunsDoNotGainByGoingTogether)
{
    GroupQueue queue({0, 0}, 1);
    const std::size_t first = *queue.next();
    EXPECT_TRUE(queue.more_of(first, 1).empty());
    EXPECT_TRUE(queue.more_of(first, 0).empty()); // four frictions and more fill the pass by themselves
    EXPECT_EQ(queue.next(), 1U);
}

// Five groups and two threads: three for the first, two for the second.
TEST(GroupQueue, LeavesOtherThreadsTheirShare)
{
    GroupQueue queue({0, 0, 0, 0, 0}, 2);
    const std::size_t first = *queue.next(), second = *queue.next();
    EXPECT_EQ(queue.more_of(first, 4).size(), 1U); // of three left and its own, half
    EXPECT_EQ(queue.more_of(second, 4).size(), 1U);
    EXPECT_EQ(queue.next(), 4U);
}

} // namespace
