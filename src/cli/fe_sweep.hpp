#pragma once

#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "cli/run_inputs.hpp"

#include <optional>
#include <string>
#include <vector>

namespace damslip::cli {

/// What one FE contact run gives to a sweep. Empty: not computed.
struct FeSlip {
    std::string status = "not run";
    bool good = false;                                ///< ended properly; a recognised static failure does
    std::optional<double> slip, max_slip, slip_error; ///< [m]
    std::optional<double> critical_friction;          ///< least mu of static equilibrium [-]
};

/// Counts of a sweep that do not depend on the number of threads, and processor seconds.
struct FeSweepCounts {
    std::int64_t set_ups = 0; ///< meshes and matrices made
    std::int64_t runs = 0, static_failures = 0, steps = 0, factorisations = 0, unresolved = 0;
    double set_up_seconds = 0.0, static_seconds = 0.0, dynamic_seconds = 0.0;
};

/// FE slips of one scene under several motions with several frictions: mesh, matrices and condensed rock are made once.
/// Threads share the motions, and the frictions of one motion where there are more threads than motions.
/// @param scene  as given, not yet called for by an effect plan
/// @returns slips [motion * friction.size() + friction]
std::vector<FeSlip> fe_slips(const Scene& scene, const std::vector<double>& friction,
                             const std::vector<RecordPair>& records, const std::vector<GroundMotion>& motions, int jobs,
                             Progress& progress, const InterruptGuard& interrupt, FeSweepCounts& counts);

} // namespace damslip::cli
