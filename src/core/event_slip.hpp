#pragma once

#include <string>

namespace damslip {

/// What one event of a sequence of motions adds to the slip.
struct EventSlip {
    std::string name;
    double start = 0.0, end = 0.0; ///< of its samples [s]
    double slip = 0.0;             ///< sum when the next one begins, positive downstream [m]
    double change = 0.0;           ///< by this event, its run to rest included [m]
};

} // namespace damslip
