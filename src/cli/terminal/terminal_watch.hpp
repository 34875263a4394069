#pragma once

#include "cli/terminal/interrupt.hpp"
#include "cli/terminal/progress.hpp"
#include "core/watch.hpp"

#include <optional>

namespace damslip::cli {

/// A computation that the command line started: a bar on the terminal or lines in a log file, ended by Ctrl-C.
class TerminalWatch final : public Watch {
public:
    /// @param streams  outlive this
    explicit TerminalWatch(const Streams& streams) : streams_(streams) {}

    bool stop_asked() const override { return interrupt_.interrupted(); }
    void results_at_hand() override { interrupt_.results_at_hand(); }
    void begin(const std::string& label, double total) override { progress_.emplace(streams_, label, total); }
    void phase(const std::string& what) override
    {
        if (progress_) progress_->phase(what);
    }
    void at(double done) override { progress_->at(done); }
    void end() override { progress_.reset(); }

private:
    const Streams& streams_;
    InterruptGuard interrupt_;
    std::optional<Progress> progress_; ///< of the part under way
};

} // namespace damslip::cli
