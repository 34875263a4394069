#pragma once

#include "core/watch.hpp"
#include "fe2d/time/run_progress.hpp"

#include <functional>
#include <map>
#include <mutex>
#include <thread>

namespace damslip {

/// Runs done, the shares of those under way included, for a progress bar in runs. Each thread has one group of runs
/// under way.
class FeMeter {
public:
    explicit FeMeter(Watch& watch) : watch_(watch) {}

    void begin(std::size_t runs);          ///< a group begins on this thread
    void more(std::size_t runs);           ///< join the group of this thread
    void step(const fe2d::RunProgress& p); ///< a step of all its runs, in lockstep
    void reached(double share);            ///< of the group, 0 ... 1
    void end();                            ///< it has ended

private:
    struct Group {
        double runs = 0.0, share = 0.0;
    };
    void show();

    Watch& watch_;
    std::mutex mutex_;
    std::map<std::thread::id, Group> under_way_;
    double done_ = 0.0;
};

/// RunOptions::reducing_rock of a run that is watched: names the phase where the box of waves is so large that its reduction
/// takes a good part of a minute. @param watch  outlives it; a part of it has begun
std::function<void(int unknowns)> tell_of_large_box(Watch& watch);

} // namespace damslip
