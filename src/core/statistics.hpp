#pragma once

#include "core/status.hpp"

#include <string>
#include <vector>

namespace damslip {

/// Value below which the share q of the sorted samples lies, linear between order statistics (Hyndman & Fan 1996, type 7).
double percentile(std::vector<double> samples, double q);

/// What one event of a sequence of motions adds to the slip.
struct EventSlip {
    std::string name;
    double start = 0.0, end = 0.0; ///< of its samples [s]
    double slip = 0.0;             ///< sum when the next one begins, positive downstream [m]
    double change = 0.0;           ///< by this event, its run to rest included [m]
    Status status =
        Status::at_rest; ///< of the run until the next event begins; the last event has that of the whole run
};

/// The statuses of events by that of the whole run: those before the last came to rest, but where the block or dam has slid
/// further than `length` [m] the run is over. @returns the name of the event in which it ends without a slip; empty: in none
std::string judge_events(Status whole, double length, std::vector<EventSlip>& events);

} // namespace damslip
