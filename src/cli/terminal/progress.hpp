#pragma once

#include "cli/terminal/streams.hpp"

#include <chrono>
#include <mutex>

namespace damslip::cli {

/// How far a command is. On a terminal a bar with percentage and time left, at most ten times a second; elsewhere a
/// line of its own every ten seconds and one at the end, which log files can keep. Silent with --quiet.
class Progress {
public:
    /// @param line_every  of the lines, where there is no terminal
    Progress(const Streams& streams, std::string label, double total,
             std::chrono::milliseconds line_every = std::chrono::seconds(10));
    ~Progress(); ///< end(), where it was not called
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// The last line, now; before what is printed of the results.
    void end();
    /// Names what goes on before the first step, "set-up": the bar and the lines say it at once.
    void phase(const std::string& what);
    void advance(double by); ///< from any thread
    void at(double done);    ///< sets what is done, in the unit of the total; may step back

private:
    void draw_now_and_then();
    void draw();
    void say_line();
    double share() const;
    double seconds_left() const;

    const Streams& streams_;
    std::string label_;
    double total_, done_ = 0;
    std::chrono::milliseconds line_every_;
    std::chrono::steady_clock::time_point start_, drawn_;
    std::mutex mutex_;
    bool shown_ = false, ended_ = false;
};

} // namespace damslip::cli
