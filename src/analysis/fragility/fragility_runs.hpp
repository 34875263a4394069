#pragma once

#include "analysis/fragility/fragility_plan.hpp"
#include "analysis/sweep/sweep_journal.hpp"
#include "analysis/sweep/sweep_method.hpp"
#include "core/watch.hpp"

namespace damslip {

/// What became of the samples of a plan.
struct FragilityRuns {
    std::vector<std::optional<FinishedRow>> rows; ///< by id of sample; empty: not run
    std::vector<double> yield; ///< downstream yield acceleration of each draw's rigid block [m/s^2]; NaN: not asked for
    std::size_t wanted = 0, found = 0; ///< asked for; taken from the journal
    double seconds = 0.0;              ///< processor time of those run here
    std::size_t set_ups = 0;           ///< rigid models, or finite-element models, made
    std::set<std::string> failures;    ///< why models could not be made, a sentence each

    std::size_t finished() const;
    bool complete() const { return finished() == wanted; }
};

/// All that the samples depend on: the scene, the records, the plan.
SweepIdentity fragility_identity(const FragilityPlan& plan, const SceneText& text, const std::string& method);

/// Runs samples by the rigid block or by finite elements (SweepMethod of kind rigid, rigid_vertical, rocking, finite_elements).
///
/// Rigid: the seepage of draws that differ in strength and density alone is solved once, and so is what stands below draws that differ in
/// friction alone. Finite elements: mesh and matrices of draws that differ in friction alone are made once; all frictions that meet the
/// same motion go through the earthquake together; on few modes (fe-reduced) one after the other. The answers do not depend on the number of threads, nor on which samples are wanted.
/// @param wanted  ids, ascending
/// @param journal  nullptr: none
/// @throws InputError where the values of a draw make no scene
FragilityRuns run_fragility(const FragilityPlan& plan, const SceneText& text, const SweepMethod& method,
                            const std::vector<std::size_t>& wanted, Journal* journal, int jobs, Watch& watch);

/// Wall time that the threads of this program have spent in the solvers of run_fragility() so far, one added to the other: set-up and steps of finite
/// elements, sliding and rocking blocks [s].
double seconds_in_solvers();

/// Ids 0 ... n - 1 of a plan, or those of a part of it: equal runs of draws.
std::vector<std::size_t> wanted_samples(const FragilityPlan& plan, const Shard& shard = {});

} // namespace damslip
