#pragma once

#include "analysis/sweep/sweep_run.hpp"

namespace damslip::pages {

/// FE slip against the rigid block's, over the motions of each friction, variant and FE method.
Table comparison(const Scene& scene, const Grid& grid, const SweepOutcome& outcome);

/// Counts that show how much was made once; the same for any number of threads.
Table count_table(const FeSweepCounts& counts);

} // namespace damslip::pages
