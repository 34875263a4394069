#pragma once

#include "analysis/fragility/fragility_runs.hpp"
#include "probability/annual_rate.hpp"
#include "probability/cloud_fit.hpp"
#include "probability/fit.hpp"

#include <cstddef>
#include <vector>

namespace damslip {

struct ConditionedPlan;

/// What one run says of one limit.
enum class LimitAnswer {
    survives,
    fails,
    missing, ///< nothing is known: not converged, self-excited, still sliding below the limit, not run
    static_failure
};

/// Of slip, not of the opening of the base or of what it holds after the earthquake: those are of full finite-element runs.
bool is_of_slip(const LimitInput& limit);

/// A run still sliding whose largest slip exceeds the limit is a failure; what slid off its base, too. @param row  none: not run
LimitAnswer answer_to(const LimitInput& limit, const std::optional<FinishedRow>& row);

/// One limit at one level.
struct LevelEstimate {
    double x = 0.0; ///< intensity [SI]
    /// Runs, of the suite's weights: counted ones (all that are asked for, but of "given-standing" those that do not stand), failures,
    /// missing ones among the counted.
    double n = 0.0, z = 0.0, missing = 0.0;
    double p_low = 0.0, p_high = 0.0; ///< missing runs as survivals, as failures; equal where none is missing
    double p = 0.0;                   ///< midway
    double se = 0.0;                  ///< standard error of p by the draws, from the replicates; of one replicate 0
    /// 95 %: error of the draws, the suite taken as the population. Of random draws Wilson's; of others from the replicates (Student's t); of one
    /// replicate with lack of knowledge by clusters, as its runs share their epistemic and their inner draws (Cameron, Gelbach & Miller 2011).
    /// From the lower end of p_low to the upper end of p_high.
    probability::Interval sampling;
    probability::ClusterInterval records;             ///< 95 %, error of the records: clusters by event drawn anew
    std::optional<probability::EpistemicBands> bands; ///< of lack of knowledge; none: no such variable
    std::optional<double> fitted;                     ///< of the lognormal curve, or of the cloud
};

/// Place of the level whose P is nearest to `p`, of equals the first. @param levels  not empty
std::size_t level_nearest(const std::vector<LevelEstimate>& levels, double p);

/// Rate of D > d per year.
struct LimitRate {
    std::optional<probability::AnnualRate> fitted; ///< of the lognormal curve; none: there is none, or it does not hold
    probability::AnnualRate raw;                   ///< of the stripes, P linear in ln x
    probability::AnnualRate raw_low, raw_high;     ///< the same with missing runs as survivals, as failures
    bool growing = true; ///< P over the levels, as far as the draws tell; false: it is 0 ... 1 outside them
    /// 95 % of raw.lower, from the replicates; where they do not differ, or there is one: of all lower and of all upper ends of the P's intervals
    probability::Interval sampling;
    probability::ClusterInterval records; ///< 95 % of raw, clusters by event
    std::vector<double> bands;            ///< of raw over the epistemic draws, at band_levels; empty: none
    /// What the runs and the hazard curve leave open: from missing runs as survivals and P = 0 below the levels to missing runs as failures, P of the
    /// lowest level below it and P = 1 above the highest. Every output takes the rate from here.
    probability::Interval bounds() const { return {raw_low.lower, raw_high.upper}; }
};

struct LimitEstimate {
    LimitInput limit;
    std::vector<LevelEstimate> levels;
    probability::LognormalFit fit;                      ///< by the counts of the stripes
    std::optional<probability::CapacityFit> capacities; ///< of an incremental dynamic analysis
    std::size_t came_back = 0;                          ///< capacities whose record survives a level above again
    /// Capacities between two levels, by the slip's root (capacities_by_roots()); none: all are the first level above the limit.
    std::optional<std::size_t> capacity_roots;
    std::optional<probability::CloudFit> cloud;
    std::optional<LimitRate> rate;
    double missing_share() const; ///< of all counted runs
};

struct FragilityEstimate {
    std::vector<LimitEstimate> limits;
    double p_static = 0.0;                       ///< share of the draws that do not stand without an earthquake
    std::map<std::string, std::size_t> statuses; ///< how often each came up
    std::size_t clusters = 0;                    ///< events
};

/// One draw under one record over the levels of an incremental dynamic analysis, by ids of samples. One that fails statically has none.
struct CapacityBracket {
    std::optional<std::size_t> below; ///< the level before `first`; none: `first` is the lowest
    std::optional<std::size_t> first; ///< first level at which the limit is passed; none: it never is
    bool came_back = false;           ///< survives a higher level again
};
std::vector<CapacityBracket> capacity_brackets(const FragilityPlan& plan, const FragilityRuns& runs,
                                               const LimitInput& limit);

/// One level of a limit by its first samples alone. @param kept  asked of each sample of the level and its place there, until it says no
/// @param replicates  that those are of
LevelEstimate estimate_first(const FragilityPlan& plan, const FragilityRuns& runs, const LimitInput& limit,
                             std::size_t level, std::size_t replicates,
                             const std::function<bool(const FragilitySample&, std::size_t place)>& kept);

/// @param hazard  nullptr: no rates. Its intensities in SI @param all_events  rate of all its earthquakes, if known
/// @param conditioned  how the runs were drawn where friction was conditioned on (its plan is `plan`); nullptr: every run counts as its weight
FragilityEstimate estimate_fragility(const FragilityPlan& plan, const FragilityRuns& runs,
                                     const probability::HazardCurve* hazard, std::optional<double> all_events,
                                     const ConditionedPlan* conditioned = nullptr);

/// Counts of one cell: weights of counted, failing and missing runs. P is z / n.
struct RunCount {
    double n = 0.0, z = 0.0, missing = 0.0;
    void add(const RunCount& c, double times = 1.0)
    {
        n += times * c.n;
        z += times * c.z;
        missing += times * c.missing;
    }
    double low() const { return n > 0.0 ? z / n : 0.0; }              ///< missing runs survive
    double high() const { return n > 0.0 ? (z + missing) / n : 0.0; } ///< missing runs fail
    double middle() const { return 0.5 * (low() + high()); }
};

/// The count of `times` runs that end alike. @param fails  probability that a run that stands fails the limit
RunCount count_of(bool stands, double fails, StaticFailure rule, double times);
RunCount count_of(LimitAnswer answer, StaticFailure rule, double weight);

/// Counts of one limit: by level and then by replicate, event, epistemic draw, and inner draw (which all epistemic draws of a replicate share).
struct LimitCounts {
    std::vector<RunCount> all;
    std::vector<std::vector<RunCount>> replicate, cluster, outer, inner;

    explicit LimitCounts(const FragilityPlan& plan) : LimitCounts(plan, plan.levels, plan.replicates) {}
    LimitCounts(const FragilityPlan& plan, std::size_t levels, std::size_t replicates);
    void add(const FragilitySample& s, std::size_t level, std::size_t replicate_of_run, const RunCount& c);

private:
    std::vector<std::size_t> event_of_; ///< of each record
    std::size_t inner_each_;            ///< inner draws of a replicate
};

} // namespace damslip
