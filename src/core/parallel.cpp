#include "core/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace damslip {

namespace {

std::atomic<int> threads_of_all{0};      ///< 0: all cores
thread_local bool beside_others = false; ///< a task of parallel_for on several threads

} // namespace

void use_threads(int jobs)
{
    threads_of_all = jobs;
}

int thread_count(int jobs)
{
    if (jobs == 0) jobs = threads_of_all;
    return jobs > 0 ? jobs : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

void parallel_for(std::size_t n, int jobs, const std::function<void(std::size_t)>& task)
{
    std::vector<std::exception_ptr> failures(n);
    std::atomic<std::size_t> next{0};
    std::atomic<double> taken{0.0}; // by the other threads [s]
    const std::size_t count =
        beside_others ? 1 : std::min<std::size_t>(n, static_cast<std::size_t>(thread_count(jobs)));
    const auto work = [&] {
        for (std::size_t i; (i = next.fetch_add(1)) < n;) {
            try {
                task(i);
            } catch (...) {
                failures[i] = std::current_exception();
            }
        }
    };
    const auto work_beside = [&] {
        const ProcessorClock clock;
        beside_others = true;
        work();
        taken += clock.seconds();
    };
    if (count < 2) {
        work();
    } else {
        std::vector<std::thread> threads;
        try {
            for (std::size_t t = 1; t < count; ++t) threads.emplace_back(work_beside);
        } catch (const std::system_error&) { // no more threads to be had: those there are do it
        }
        beside_others = true;
        work();
        beside_others = false;
        for (std::thread& t : threads) t.join();
        ProcessorClock::charge(taken);
    }
    for (const std::exception_ptr& failure : failures)
        if (failure) std::rethrow_exception(failure);
}

} // namespace damslip
