#pragma once

#include <cstddef>
#include <functional>

namespace damslip {

/// Number of threads for a --jobs value: 0 means all cores.
int thread_count(int jobs);

/// Runs task(0) ... task(n - 1) on `jobs` threads (0: all cores). Each task writes its own place only, so results do
/// not depend on the number of threads. The first exception (by task index) is rethrown after all threads have ended.
void parallel_for(std::size_t n, int jobs, const std::function<void(std::size_t)>& task);

} // namespace damslip
