#pragma once

#include "core/input_error.hpp"

#include <chrono>
#include <cstddef>
#include <ctime>
#include <functional>
#include <string>

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

/// Asked between the parts of a long computation: does the user want it to end? Empty: never. Called from any thread.
using StopAsked = std::function<bool()>;

/// The way out of a computation that has nothing to return yet.
/// @param where  what was going on: "the set-up of the finite elements"
/// @throws Interrupted
inline void stop_if_asked(const StopAsked& asked, const char* where)
{
    if (asked && asked()) throw Interrupted(where);
}

/// Whoever waits for a long computation: is notified how far it is, and asked whether it shall end. All members may be
/// called from any thread. This one is silent and never ends anything; a program derives its own.
class Watch {
public:
    virtual ~Watch() = default;

    /// Shall the computation end? Asked at every step; what is finished is kept.
    virtual bool stop_asked() const { return false; }

    /// Results exist that nobody but the computation holds: a stop has to wait for it from now on.
    virtual void results_at_hand() {}

    /// A part of the computation begins. @param total  what at() counts up to
    virtual void begin(const std::string& /*label*/, double /*total*/) {}
    virtual void phase(const std::string& /*what*/) {} ///< what goes on before the first step: "set-up"
    virtual void at(double /*done*/) {}                ///< in the unit of the total; may step back
    virtual void end() {}                              ///< of the part

    /// stop_asked() as the function that solvers take. @pre this outlives it
    StopAsked stop() const
    {
        return [this] { return stop_asked(); };
    }
};

/// Wall-clock time since it was made.
class Stopwatch {
public:
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); } ///< [s]

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

enum class ProcessorTimeOf { thread, process }; ///< the calling thread and what worked for it, or all threads of the program

/// Processor time since it was made: what a run costs, whatever else the machine does.
class ProcessorClock {
public:
    explicit ProcessorClock(ProcessorTimeOf whose = ProcessorTimeOf::thread) : whose_(whose), start_(now()) {}
    double seconds() const { return now() - start_; } ///< [s]

    /// What other threads took for the calling one, which waited for them (parallel_for) [s].
    static void charge(double seconds) { charged_ += seconds; }

private:
    double now() const
    {
        const bool thread = whose_ == ProcessorTimeOf::thread;
        std::timespec t{};
        clock_gettime(thread ? CLOCK_THREAD_CPUTIME_ID : CLOCK_PROCESS_CPUTIME_ID, &t);
        return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec) + (thread ? charged_ : 0.0);
    }
    static inline thread_local double charged_ = 0.0;
    ProcessorTimeOf whose_;
    double start_;
};

} // namespace damslip
