#pragma once

#include "analysis/prepare/ready.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace damslip {

/// What a contact run of a scene condenses, holds and costs. Sizes are those of the run; seconds are measured on a
/// second of strong shaking on this machine, so they differ from call to call.
struct ContactCost {
    struct Part {
        std::string name; ///< "dam at rest, inside eliminated"
        std::int64_t unknowns = 0;
        std::string made; ///< how often
        std::size_t bytes = 0;
    };
    struct OfRecord {
        std::string record;
        std::int64_t steps = 0;    ///< whole ones
        double pass_seconds = 0.0; ///< of one pass with them
    };
    std::vector<Part> parts;           ///< rock, dam at rest, dam in motion, contact problem
    std::int64_t contact_unknowns = 0; ///< what each part becomes
    std::vector<OfRecord> records;     ///< empty: a file is not there, or seconds_per_step is none
    double set_up_seconds = 0.0;
    std::optional<double> seconds_per_step; ///< none: the dam does not stand before the earthquake

    std::size_t set_up_factorisations() const { return parts.size() - 2; } ///< all but dam in motion, contact problem
};

/// @param ready  for finite elements; its records are estimated
ContactCost contact_cost(const Ready& ready);

} // namespace damslip
