#pragma once

#include <cstddef>
#include <functional>

namespace damslip {

/// What 0 means among values of --jobs, for the whole program: all cores, or fewer where the user says so.
/// @param jobs  >= 0
void use_threads(int jobs);

/// Number of threads for a --jobs value; 0: use_threads().
int thread_count(int jobs);

/// Runs task(0) ... task(n - 1) on `jobs` threads (0: use_threads()). Each task writes its own place only, so results do
/// not depend on the number of threads. A task that calls this again shares its own thread among its tasks.
/// What the threads take is counted as the caller's (ProcessorClock).
/// The first exception (by task index) is rethrown after all threads have ended.
void parallel_for(std::size_t n, int jobs, const std::function<void(std::size_t)>& task);

} // namespace damslip
