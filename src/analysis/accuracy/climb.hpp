#pragma once

#include "analysis/accuracy/ladder.hpp"

#include <functional>

namespace damslip {

struct ClimbOptions {
    LadderOptions ladder;
    int repeats = 3;              ///< of a rung at most, >= 1; see repeated_enough
    std::optional<double> budget; ///< processor time for all rungs and repeats together [s]; none: no end
};

/// What the climb asks for and tells.
struct ClimbCalls {
    std::function<RungResult(const Rung&)> run;               ///< once
    std::function<double(const Rung&)> least_seconds = {};    ///< of a rung whose neighbours say nothing; empty: 0 [s]
    std::function<bool()> interrupted;                        ///< empty: never
    std::function<void(const Rung&)> begins;                  ///< empty: nobody listens
    std::function<void(const std::vector<RungResult>&)> ends; ///< after each rung, all results so far; may be empty
};

/// A rung is repeated while it has taken less than this in all, so one of a second is run three times and one of two
/// seconds once.
inline constexpr double repeat_seconds = 3.5;

/// Climbs the ladder of a scene. Rungs that would exceed the budget by what they are expected to take, or that it ends, are `skipped` and
/// stay in the list; so do those that fail. An interrupt ends the climb; what was finished is kept, the rung under way is
/// not.
std::vector<RungResult> climb(const LadderFacts& facts, const ClimbOptions& options, const ClimbCalls& calls);

/// One rung, repeated: the seconds are the median.
RungResult run_repeatedly(const Rung& rung, int repeats, const ClimbCalls& calls);

} // namespace damslip
