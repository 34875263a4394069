#pragma once

#include "analysis/accuracy/climb.hpp"
#include "analysis/accuracy/judge.hpp"
#include "analysis/accuracy/rung_runner.hpp"

namespace damslip {

/// What accuracy costs on one scene: every rung with its slip, seconds and bytes, and what they say about each other.
struct Accuracy {
    std::vector<RungResult> rungs;
    Judgement judgement; ///< names the cheapest rung within the tolerance
};

/// Climbs the ladder with all records of the scene. @param tolerance  share of the slip [-]
/// @throws InputError, Interrupted as read_records(); what a rung cannot do is its result
Accuracy measure_accuracy(const Scene& scene, double tolerance, Effort effort, const Watch& watch);

} // namespace damslip
