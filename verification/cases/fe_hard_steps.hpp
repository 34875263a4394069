#pragma once

#include "fe2d/run/earthquake_run.hpp"

#include <vector>

namespace damslip::verification {

/// Contact problem of one step of a run, and what the run made of it.
struct StepRecord {
    fe2d::ContactReport report;
    Eigen::VectorXd stuck_force;  ///< λ⁰ [N/m]
    Eigen::VectorXd force;        ///< λ₁ of the run [N/m]
    Eigen::VectorXd displacement; ///< of the run: opening after the step, slip in the step [m]
};

struct StepRecords {
    Eigen::MatrixXd stiffness; ///< V, of all steps [N/m²]
    fe2d::ContactLaw law;
    double normal_force = 0.0; ///< N' at rest [N/m]
    std::vector<StepRecord> steps;
};

/// Runs a scene under a motion of one sample a step and writes down the contact problem of every step but those in
/// which a flight ends. The problems are
/// put together here, from the states before the steps; the run is only asked for its answers.
StepRecords recorded_run(const Scene& scene, const fe2d::RunOptions& options, const GroundMotion& motion);

/// Steps that left Newton's iteration first, then by iterations, hardest first.
std::vector<std::size_t> hardest_steps(const StepRecords& records, std::size_t count);

/// What Lemke's method and the run differ by in one step, as forces over N' [-]; displacements count with V_ii.
struct LemkeDifference {
    bool solved = false;
    double force = 0.0, displacement = 0.0;
};
LemkeDifference compare_with_lemke(const StepRecords& records, std::size_t step);

} // namespace damslip::verification
