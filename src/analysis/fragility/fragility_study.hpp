#pragma once

#include "analysis/fragility/capacity_roots.hpp"
#include "analysis/fragility/conditioned_plan.hpp"
#include "analysis/fragility/fragility_plan.hpp"
#include "analysis/fragility/fragility_runs.hpp"
#include "probability/fit.hpp"
#include "records/suite/suite.hpp"

#include <functional>

/// What the accuracy of a probability costs: the 95 % interval of P(D > d) at one level, by several estimators and numbers of runs, over the
/// processor time each took.
namespace damslip {

/// One estimate.
struct IntervalPoint {
    std::string estimator;          ///< "plain", "Latin hypercube", "Sobol'"
    std::size_t runs = 0;           ///< of the model whose P is asked for
    double seconds = 0.0;           ///< processor time of all of it [s]
    double p = 0.0;                 ///< P(D > d)
    probability::Interval interval; ///< 95 %, error of the draws, the suite taken as the population
    std::optional<double>
        gain;           ///< variance of plain Monte Carlo for the same seconds over this one's [-]; none: plain itself
    std::string remark; ///< why there is no answer; empty: there is one
    bool done() const { return remark.empty(); }
};

struct IntervalCost {
    LimitInput limit;                  ///< the first of the scene
    double level = 0.0;                ///< intensity [SI]
    std::string method;                ///< "rigid-v", "fe"
    std::vector<IntervalPoint> points; ///< by estimator, then by runs
};

struct IntervalCostOptions {
    std::string method;          ///< whose P is asked for
    std::string rigid;           ///< "rigid-v": the block that finds the level where none is given
    std::optional<double> level; ///< [SI]; none: where P is nearest to 0.1 by the rigid block
    std::size_t runs = 4096;     ///< of the largest estimate; a quarter, a sixteenth ... of it before
    std::size_t sizes = 4;
    std::size_t step = 4;        ///< ratio of neighbouring sizes
    std::size_t replicates = 16; ///< of Latin hypercubes and Sobol' points
    double budget = 300.0;       ///< processor time of all together [s]; what would exceed it is left out, and named
    int jobs = 1;
};

/// Estimators side by side. All variables are drawn as if they varied from earthquake to earthquake (aleatory): the mean of P is the same. Each
/// estimate is run by itself, but for prefixes of plain Monte Carlo with finite elements, which take their share of the longest one's time.
/// @throws InputError where nothing is drawn, for a level that records reach only by a factor beyond suite.max_scale
IntervalCost interval_cost(const FragilityInput& input, const ShakingSuite& suite, const SceneText& text,
                           const NumberInFile& written, const IntervalCostOptions& options, Watch& watch);

/// Adds the gain of each point over plain Monte Carlo, whose half-width falls with the root of the time, through its longest run.
void compare_with_plain(std::vector<IntervalPoint>& points);

/// What a run's own first draws would have given at one level: the interval after a half, a quarter ... of its draws; of dependent draws after so many
/// replicates. Times are known of a run in one go alone. Empty: there are too few.
std::vector<IntervalPoint> own_prefixes(const FragilityPlan& plan, const FragilityRuns& runs, const LimitInput& limit,
                                        std::size_t level);

/// A scene, what is asked of it, its records and the method: everything that is fixed before the first run.
struct FragilityStudy {
    SceneText text;
    Scene scene;
    FragilityInput input;
    ShakingSuite suite;
    const SweepMethod& method;
    NumberInFile written;                           ///< SceneText::written()
    std::optional<probability::HazardCurve> hazard; ///< SI

    bool finite_elements() const { return method.kind == SweepKind::finite_elements; }
    /// Runs per level where nobody says how many.
    std::size_t usual_samples() const { return finite_elements() ? 128 : 1024; }
    FragilityPlan plan(std::size_t samples, std::uint32_t stream = 0) const;
    /// Of rigid runs the answer asks for yields where it finds the roots of an incremental dynamic analysis.
    Yields yields() const
    {
        return finite_elements() || input.intensity.design == FragilityDesign::ida ? Yields::kept : Yields::dropped;
    }
    const SweepMethod& rigid() const; ///< the rigid block that goes with the records
};

/// check_fragility(), then reads and measures the records. @param method  rigid, rigid-v, fe, fe-exact ...; empty: rigid-v where a record has a vertical component,
/// else rigid
/// @throws InputError, also for a limit that the method does not give, and a hazard curve of another measure or apart from the levels; UsageError for a method that is none of a fragility
FragilityStudy open_fragility(SceneText text, Scene scene, FragilityInput input, const std::string& method);

/// Records may be scaled beyond suite.max_scale; they are listed.
void allow_any_scaling(FragilityInput& input);

/// What a few runs say of a budget; their answers are thrown away.
struct BudgetPilot {
    std::size_t runs = 0;         ///< of the pilot, two a level
    double seconds_per_run = 0.0; ///< processor time
    std::size_t samples =
        1; ///< runs per level that the budget pays for, the pilot's time taken off it, a tenth of it at most
};

/// @param budget  processor seconds
BudgetPilot pilot_of_budget(const FragilityStudy& study, double budget, int jobs, Watch& watch);

enum class Conditioning { automatic, on, off };

/// A plan whose runs draw friction only where the rigid block, corrected by a pilot, does not know whether the dam slides too far; none where friction
/// is drawn for each run: automatic conditions finite elements of scenes without epistemic variables, for which no bands are asked.
/// @param aim  ConditioningSizes::aim
/// @throws a refusal where it is asked for and cannot be
std::optional<ConditionedPlan> condition_on_friction(const FragilityStudy& study, Conditioning asked,
                                                     std::size_t samples, int jobs, Watch& watch,
                                                     std::optional<double> aim = std::nullopt);

/// What is computed beside the runs.
struct FragilityExtras {
    std::size_t rows = 128; ///< of each sample of the shares; 0: none
    int jobs = 0;           ///< threads; 0: all cores
};

/// What the runs say.
struct FragilityAnswer {
    FragilityEstimate estimate;
    std::optional<FragilityCauses> causes;
    const ConditionedPlan* conditioned = nullptr; ///< as given; nullptr: friction is drawn
    std::vector<IntervalPoint> own_cost; ///< intervals of the run's own first draws at the level with P nearest to 0.1
    std::vector<std::pair<LimitInput, std::vector<NeededYield>>> needed_yields; ///< of limits of slip
    std::vector<std::string> notes;
    bool answered = true; ///< false: more than 5 % of the runs of a limit have no answer
};

/// Probabilities and rates, and what P comes from. Of runs that are not complete, the estimate alone:
/// what was not run counts as missing.
FragilityAnswer answer_fragility(const FragilityStudy& study, const FragilityPlan& plan, const FragilityRuns& runs,
                                 const FragilityExtras& extras, Watch& watch,
                                 const ConditionedPlan* conditioned = nullptr);

/// T_1 of the dam on its rock with the water that moves with it, for SA(T1) [s]. @throws InputError, NotConverged
double first_period_of(const Scene& scene);

/// The records of [suite] files, or those of the scene where it names none, measured. Files: a folder, a glob, or a CSV with the columns
/// horizontal and, as far as they are wanted, vertical, other_horizontal, event, weight, magnitude, scale; or a list of seeds. Their measures are
/// kept in its folder (records/suite/suite.hpp). Intensities are as the scene scales the records. Each is an event of its own, of weight 1,
/// unless the lists say else. The geometric mean is that of both horizontal components, with one factor on both; of a record that has no
/// other it is that of the one.
/// @throws InputError for files that are missing or cannot be read, for a CSV with other columns, for a record without any
/// shaking, for the same record twice
ShakingSuite suite_of_input(const Scene& scene, const FragilityInput& input);

} // namespace damslip
