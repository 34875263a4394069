#pragma once

#include "analysis/fragility/fragility_plan.hpp"
#include "analysis/sweep/result_store.hpp"
#include "analysis/sweep/sweep_axes.hpp"
#include "core/parallel.hpp"

#include <array>

namespace damslip {

/// What many runs gave: eight bytes for each figure that any of them has, one byte for status and RowResults' good. Histories, slips after events and
/// anchors are not kept. A rigid block has four figures: 33 bytes a run.
class PackedRows {
public:
    explicit PackedRows(std::size_t size = 0) : state_(size, 0) {}

    std::size_t size() const { return state_.size(); }
    std::size_t finished() const; ///< how many there are
    bool has(std::size_t id) const { return state_[id] != 0; }
    const std::optional<FinishedRow> operator[](std::size_t id) const; ///< none: not run
    void put(const FinishedRow& row); ///< in its place, its id. From one thread at a time

private:
    std::uint8_t state_of(const FinishedRow& row);

    std::vector<std::uint8_t> state_; ///< 0: not run; else 1 + place of the status, and bad_run where it is not good
    std::vector<std::string> statuses_;
    std::array<std::vector<double>, row_numbers.size()> figures_; ///< in the order of row_numbers; empty: no run has it
};

/// What became of the samples of a plan.
struct FragilityRuns {
    PackedRows rows;           ///< by id of sample; empty: not run
    std::vector<double> yield; ///< downstream yield acceleration of each draw's rigid block [m/s^2]; NaN: not known
    std::size_t wanted = 0, found = 0; ///< asked for; taken from the store
    double seconds = 0.0;              ///< processor time of those run here
    std::size_t set_ups = 0;           ///< rigid models, or finite-element models, made
    std::set<std::string> failures;    ///< why models could not be made, a sentence each

    std::size_t finished() const { return rows.finished(); }
    bool complete() const { return finished() == wanted; }
};

/// Ids of samples, ascending.
using SampleIds = PlannedList<std::size_t>;

/// Whether FragilityRuns::yield is kept, eight bytes a draw, or left empty.
enum class Yields { kept, dropped };

/// None are finished.
FragilityRuns no_runs(const FragilityPlan& plan, std::size_t wanted, Yields yields = Yields::kept);

/// Takes those of the ids first ... last that a store has.
void take_finished(const ResultStore& store, std::size_t first, std::size_t last, FragilityRuns& runs);

/// All that the samples depend on: the scene, the records, the plan.
SweepIdentity fragility_identity(const FragilityPlan& plan, const SceneText& text, const std::string& method);

/// Runs samples by the rigid block or by finite elements (SweepMethod of kind rigid, rigid_vertical, rocking, finite_elements).
///
/// Rigid: the seepage of draws that differ in strength and density alone is solved once, and so is what stands below draws that differ in
/// friction alone. Finite elements: mesh and matrices of draws that differ in friction alone are made once; all frictions that meet the
/// same motion go through the earthquake together; on few modes (fe-reduced) one after the other. The answers do not depend on the number of threads, nor on which samples are wanted.
/// Memory grows by FragilityRuns and the plan alone. @param kept  nullptr: none
/// @throws InputError where the values of a draw make no scene
FragilityRuns run_fragility(const FragilityPlan& plan, const SceneText& text, const SweepMethod& method,
                            const SampleIds& wanted, ResultStore* kept, int jobs, Watch& watch,
                            Yields yields = Yields::kept);

/// Wall time that the threads of this program have spent in the solvers of run_fragility() so far, one added to the other: set-up and steps of finite
/// elements, sliding and rocking blocks [s].
double seconds_in_solvers();

/// Ids 0 ... n - 1 of a plan, or those of a part of it: equal runs of draws.
SampleIds wanted_samples(const FragilityPlan& plan, const Shard& shard = {});

} // namespace damslip
