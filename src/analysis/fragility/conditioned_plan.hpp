#pragma once

#include "analysis/fragility/fragility_runs.hpp"
#include "analysis/fragility/fragility_estimate.hpp"
#include "probability/annual_rate.hpp"
#include "probability/distribution.hpp"

#include <optional>

namespace damslip {

/// What the rigid block predicts of the part of the law of friction that a run was drawn from, and what the run stands for.
struct FrictionCell {
    double weight = 0.0;       ///< share of its level that the run stands for, over the number of runs of its replicate
    bool stands = true;        ///< without an earthquake
    std::vector<double> fails; ///< P(D > d) of each limit, of a dam that stands; one number for the whole cell
};

/// Runs of finite elements to learn from how far the rigid block is off. Their answers are not part of the estimate.
struct ConditioningPilot {
    std::size_t runs = 0;
    double seconds = 0.0;            ///< processor time
    std::vector<double> correlation; ///< of prediction and answer, of each limit, on the pilot's own runs
    std::vector<double>
        spread; ///< of ln mu at which the dam fails, about what is predicted (logistic, its scale), of each limit
};

/// Runs of a fragility that draws friction only where it matters.
///
/// Of each draw of all other variables, record, polarity and level the rigid block tells the friction mu* below which it slides more than the limit.
/// One-way, D falls with mu: P = F_mu(mu*), and nothing is left to draw (exact()). With finite elements a logit fitted to a pilot turns mu* into a
/// probability h of failing; the law of mu is cut into cells about it, and few runs are drawn from all cells of a level and replicate with a
/// probability proportional to their share pi and to what is not known there, s = pi sqrt(h (1 - h) + floor): at equal distances along the sum of s
/// (Madow 1949), friction at random within its cell. With weight w = pi / (m q), q = s / sum s,
///     p = sum pi h + sum w (f - h),
/// which is unbiased whatever h, mu* and the cells are, as they are fixed before the first run that counts.
struct ConditionedPlan {
    FragilityPlan plan;               ///< of the runs
    std::vector<FrictionCell> cells;  ///< of each sample of the plan; empty: exact()
    std::vector<LimitCounts> counts;  ///< of each limit, as predicted: sum pi h
    std::vector<std::size_t> runs_at; ///< finite-element runs of each level
    double p_static = 0.0;            ///< as predicted
    double rigid_seconds = 0.0;       ///< processor time of finding mu*
    std::size_t motions = 0;          ///< draws of the other variables with record, polarity and level
    std::size_t exceptions = 0;       ///< of the motions, those whose P is not F(mu*)
    ConditioningPilot pilot;
    std::vector<std::string> notes; ///< a sentence each
    bool exact() const { return cells.empty(); }
};

/// Why friction cannot be left undrawn, a sentence; empty: it can. It has to be a continuous variable of its own, `contact.friction` alone, independent of
/// the others, with records scaled to levels (stripes).
std::string why_not_conditioned(const FragilityInput& input);

struct ConditioningSizes {
    std::size_t runs =
        1280; ///< finite-element runs at all levels together, the pilot's not counted; at least two a replicate and level
    std::size_t pilot = 128;  ///< of it; at least 48
    std::size_t motions = 64; ///< draws of what else is drawn per level, at least; of records alone the whole suite
    int jobs = 0;             ///< threads
    /// How much a level matters beside its own coefficient of variation: the part of the annual rate that a P of 1 there would add [1/a]; empty: not asked
    std::vector<double> weight_of_level;
    /// The probability that has to be known best: most of the runs go to the level whose predicted P of the first limit is nearest to it, by its
    /// logarithm; none: half of them for the same coefficient of variation at all levels, half for the annual rate.
    std::optional<double> aim;
};

/// The rigid block's plan, exact where it slides one way. Runs of the plan it returns, one a motion, are at mu* of the first limit.
/// @param rigid  rigid or rigid-v
ConditionedPlan condition_rigid(const FragilityInput& input, const ShakingSuite& suite, const SceneText& text,
                                const NumberInFile& written, const SweepMethod& rigid, const ConditioningSizes& sizes,
                                Watch& watch);

/// The plan for finite elements: runs the rigid block and the pilot.
/// @throws Interrupted where the watch asks to stop
ConditionedPlan condition_finite_elements(const FragilityInput& input, const ShakingSuite& suite, const SceneText& text,
                                          const NumberInFile& written, const SweepMethod& rigid,
                                          const SweepMethod& method, const ConditioningSizes& sizes, Watch& watch);

/// Counts of a limit with what the runs say put in: predicted plus weighted differences.
LimitCounts counts_of(const ConditionedPlan& conditioned, const FragilityRuns& runs, std::size_t limit);

/// Share of the law that does not stand without an earthquake.
double static_share(const ConditionedPlan& conditioned, const FragilityRuns& runs);

/// dLambda / dP of each level, P linear in ln x between them [1/a].
std::vector<double> rate_of_levels(const probability::HazardCurve& hazard, std::span<const double> levels);

} // namespace damslip
