#pragma once

#include "core/stopwatch.hpp"
#include "core/watch.hpp"

namespace damslip {

/// A watch that also ends a computation when its time is over.
/// @tparam Clock  Stopwatch: wall time; ProcessorClock: processor time of the thread that made it
template <class Clock> class BudgetWatchOf final : public Watch {
public:
    /// @param seconds  from now on @param outer  outlives this
    BudgetWatchOf(Watch& outer, double seconds) : outer_(outer), seconds_(seconds) {}

    double left() const { return seconds_ - clock_.seconds(); } ///< [s]
    double spent() const { return clock_.seconds(); }           ///< [s]
    bool over() const { return left() <= 0.0; }
    bool interrupted() const { return outer_.stop_asked(); } ///< by the user, not by the clock

    bool stop_asked() const override { return over() || outer_.stop_asked(); }
    void results_at_hand() override { outer_.results_at_hand(); }
    void begin(const std::string& label, double total) override { outer_.begin(label, total); }
    void phase(const std::string& what) override { outer_.phase(what); }
    void at(double done) override { outer_.at(done); }
    void end() override { outer_.end(); }

private:
    Watch& outer_;
    double seconds_;
    Clock clock_;
};
using BudgetWatch = BudgetWatchOf<Stopwatch>;

} // namespace damslip
