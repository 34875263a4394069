#pragma once

#include "analysis/fe/contact_run.hpp"
#include "core/watch.hpp"

#include <string>
#include <vector>

/// The elastic dam in a screening: the rigid block is no upper bound of its slip.
namespace damslip {

/// Slips by reduced finite elements. The steps are half the record's; the error estimate holds what they and the modes leave
/// out, and nothing of the mesh.
struct ElasticScreening {
    std::vector<ContactRun> runs; ///< records x polarities, without histories
    std::string why_not;          ///< one sentence: why runs are missing; empty: none is

    /// Of the worst run; no PASS where runs are missing.
    Verdict verdict(const std::optional<double>& allowable) const;
};

/// Runs the dam of a screening under its records. What cannot be run is said in `why_not`, never thrown.
/// @param ready  for the rigid block; its records are used again
/// @throws Interrupted
ElasticScreening screen_elastic(const Ready& ready, int jobs, Watch& watch);

} // namespace damslip
