#pragma once

#include "analysis/accuracy/rung.hpp"
#include "core/status.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace damslip {

enum class RungOutcome {
    done,    ///< there is a slip
    failed,  ///< it ran and has no final slip: see status and remark
    refused, ///< this scene cannot be run so, see the remark
    skipped, ///< would have exceeded the budget
    stopped  ///< Ctrl-C: nothing of it counts
};

/// What a rung gave and what it cost.
struct RungResult {
    Rung rung;
    RungOutcome outcome = RungOutcome::failed;
    Status status = Status::not_resolved; ///< of what ran, the first record that does not come to rest
    std::string remark;                   ///< what the status means here, or why there is none
    std::vector<double> slip;             ///< at the end, of each record, positive downstream [m]; `done` only
    std::vector<double> low, high;        ///< 16 and 84 % of a regression [m]; empty: no band

    // Over all records, processor time: what a user pays who runs this rung alone: the scene read, models made, records
    // run.
    double seconds = 0.0;        ///< median of the repeats [s]; `skipped`: expected
    double set_up_seconds = 0.0; ///< of them, before the first record is run [s]
    int repeats = 0;
    std::optional<double> bytes;          ///< growth of the resident memory to its peak; none: not measured
    std::optional<double> time_step;      ///< the smallest used [s]
    std::optional<std::int64_t> unknowns; ///< of the FE model, the water's included; modes of a reduced run
    std::optional<std::int64_t> steps;    ///< of all records, of the pass that counts
    bool done() const { return outcome == RungOutcome::done; }
    bool ran() const { return outcome == RungOutcome::done || outcome == RungOutcome::failed; }
};

} // namespace damslip
