#include "core/parallel.hpp"

#include <gtest/gtest.h>
#include <set>
#include <thread>
#include <vector>

using namespace damslip;

namespace {

/// Until a thread has taken so much processor time.
void work_for(double seconds)
{
    for (const ProcessorClock clock; clock.seconds() < seconds;) {}
}

} // namespace

TEST(ParallelFor, TheCallerIsChargedForAllThreads)
{
    const ProcessorClock clock;
    parallel_for(4, 4, [](std::size_t) { work_for(0.02); });
    EXPECT_GE(clock.seconds(), 0.08);
}

TEST(ParallelFor, TasksOfATaskStayOnItsThread)
{
    std::vector<std::set<std::thread::id>> threads(2);
    std::vector<std::size_t> done(2, 0);
    parallel_for(2, 2, [&](std::size_t outer) {
        parallel_for(8, 8, [&](std::size_t) {
            threads[outer].insert(std::this_thread::get_id());
            ++done[outer];
        });
    });
    for (std::size_t outer = 0; outer < 2; ++outer) {
        EXPECT_EQ(threads[outer].size(), 1u);
        EXPECT_EQ(done[outer], 8u);
    }
}

TEST(ParallelFor, TheUsersNumberOfThreadsHoldsWhereNoneIsGiven)
{
    use_threads(3);
    EXPECT_EQ(thread_count(0), 3);
    EXPECT_EQ(thread_count(2), 2);
    use_threads(0);
    EXPECT_GE(thread_count(0), 1);
}
