#pragma once

#include <ctime>

namespace damslip::cli {

/// Processor time of the calling thread since this object was made: what a run costs, whatever else the machine does.
class ProcessorClock {
public:
    double seconds() const { return now() - start_; } ///< [s]

private:
    static double now()
    {
        std::timespec t{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
        return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
    }
    double start_ = now();
};

} // namespace damslip::cli
