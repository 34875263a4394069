#pragma once

#include <ctime>

namespace damslip {

enum class ProcessorTimeOf { thread, process }; ///< the calling thread, or all threads of the program

/// Processor time since it was made: what a run costs, whatever else the machine does.
class ProcessorClock {
public:
    explicit ProcessorClock(ProcessorTimeOf whose = ProcessorTimeOf::thread)
        : clock_(whose == ProcessorTimeOf::thread ? CLOCK_THREAD_CPUTIME_ID : CLOCK_PROCESS_CPUTIME_ID), start_(now())
    {
    }
    double seconds() const { return now() - start_; } ///< [s]

private:
    double now() const
    {
        std::timespec t{};
        clock_gettime(clock_, &t);
        return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
    }
    clockid_t clock_;
    double start_;
};

} // namespace damslip
