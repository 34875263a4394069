#pragma once

#include "analysis/prepare/ready.hpp"
#include "core/table.hpp"

#include <optional>

namespace damslip {

/// What a contact run of a scene condenses, holds and costs. Sizes are those of the run; seconds are measured on a
/// second of strong shaking on this machine, so they differ from call to call.
struct ContactCost {
    Table parts;   ///< rock, dam, contact problem: unknowns, what they become, how often, bytes
    Table records; ///< of each record: steps and seconds of a pass with whole steps; empty: a file is not there
    double set_up_seconds = 0.0;
    std::optional<double> seconds_per_step; ///< none: the dam does not stand before the earthquake
};

/// @param ready  for finite elements
ContactCost contact_cost(const Ready& ready);

} // namespace damslip
