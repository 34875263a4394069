#pragma once

#include "cli/progress.hpp"
#include "fe2d/time/run_progress.hpp"

#include <map>
#include <mutex>
#include <thread>

namespace damslip::cli {

/// Runs done, the shares of those under way included, for a progress bar in runs. Each thread has one group of runs
/// under way.
class FeMeter {
public:
    explicit FeMeter(Progress& progress) : progress_(progress) {}

    void begin(std::size_t runs);          ///< a group begins on this thread
    void step(const fe2d::RunProgress& p); ///< a step of one of its runs, or of all in lockstep
    void end();                            ///< it has ended

private:
    struct Group {
        double runs = 0.0, ended = 0.0, share = 0.0; ///< in runs; share: of the run under way
        std::int64_t last_step = 0;
    };
    void show();

    Progress& progress_;
    std::mutex mutex_;
    std::map<std::thread::id, Group> under_way_;
    double done_ = 0.0;
};

} // namespace damslip::cli
