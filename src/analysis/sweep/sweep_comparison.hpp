#pragma once

#include "analysis/sweep/sweep_run.hpp"
#include "core/status_count.hpp"

namespace damslip {

/// FE slip against the rigid block's, over the motions of one friction, variant and FE method that both carried to their
/// end, with the vertical component where the record has one. Slips are sizes: those of the two polarities do not cancel.
struct SweepComparison {
    GridIndex at; ///< of the first motion
    std::int64_t motions = 0, static_failures = 0;
    std::optional<double> critical_friction;
    double mean_fe = 0.0, mean_rigid = 0.0, largest_fe = 0.0, largest_rigid = 0.0; ///< [m]
    std::optional<double> ratio_of_means;
    std::optional<double> largest_error; ///< of the time step [m]; none: some motion has none
    StatusCount without;                 ///< FE runs without a slip or an answer
};

/// One for each friction, variant and FE method; the rigid block slides anew.
std::vector<SweepComparison> compare_with_rigid(const Scene& scene, const Grid& grid, const SweepOutcome& outcome);

} // namespace damslip
