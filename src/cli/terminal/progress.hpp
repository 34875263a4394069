#pragma once

#include "cli/terminal/streams.hpp"

#include <chrono>
#include <cstddef>
#include <mutex>

namespace damslip::cli {

/// A bar with percentage and time left on a terminal, at most ten times a second; silent otherwise.
class Progress {
public:
    Progress(const Streams& streams, std::string label, std::size_t total);
    ~Progress();
    void advance(std::size_t by = 1); ///< from any thread
    void at(double done);             ///< sets what is done, in the unit of the total; may step back

private:
    void draw_now_and_then();
    void draw();

    const Streams& streams_;
    std::string label_;
    double total_, done_ = 0;
    std::chrono::steady_clock::time_point start_, drawn_;
    std::mutex mutex_;
    bool shown_ = false;
};

} // namespace damslip::cli
