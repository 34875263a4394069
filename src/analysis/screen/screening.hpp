#pragma once

#include "analysis/fe/contact_runs.hpp"
#include "analysis/prepare/flexible_mass.hpp"
#include "analysis/prepare/ready.hpp"
#include "analysis/prepare/rigid_model.hpp"
#include "analysis/screen/planes.hpp"
#include "analysis/screen/regression_rows.hpp"
#include "core/parallel.hpp"
#include "core/status.hpp"
#include "sliding/equilibrium/base_state.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"
#include "sliding/flexible/flexible_mode.hpp"

#include <string>
#include <string_view>
#include <vector>

/// What `screen` computes, as data; pages/screen shows it.
namespace damslip {

/// The elastic dam in a screening, for the rigid block is no upper bound of its slip: by reduced finite elements. The steps are half the record's; the error estimate holds what they and the modes leave
/// out, and nothing of the mesh.
struct ElasticScreening {
    std::vector<ContactRun> runs; ///< records x polarities, without histories
    std::string why_not;          ///< one sentence: why runs are missing; empty: none is

    /// Of the worst run; no PASS where runs are missing.
    Verdict verdict(const std::optional<double>& allowable) const;
};

/// The base with its uplift: as the scene gives it, and a second time with a crack where the scene asks for none.
struct BaseRow {
    std::string base; ///< "as given", "cracked base"
    RigidModel model;
    sliding::BaseLimits limits = {}; ///< accelerations up to which the sliding block stands for the dam; empty for a wedge
};

/// Slip of a block that is flexible, by the analyses the scene asks for; with the vertical component where the record has one.
struct FlexibleSlips {
    std::optional<sliding::FlexibleSlide> decoupled, coupled;
    std::optional<sliding::StrainCompatible> column; ///< of a column: its period and damping in this motion
};

/// The slip that is judged, and by which analysis it was found.
struct GoverningSlip {
    const sliding::SlideResult& slide;
    std::string_view method; ///< "rigid", "decoupled", "coupled", "rocking"
    double error;            ///< slip_error(); NaN also where the analysis leaves out what happens: nothing is decided
};

/// One record with one polarity.
struct SlipRow {
    std::string record;
    int polarity = 1;
    double pga = 0.0;                                  ///< of the scaled horizontal component [m/s^2]
    double vertical_pga = 0.0;                         ///< of the vertical one; 0: there is none [m/s^2]
    sliding::SlideResult horizontal;                   ///< without the vertical component
    std::optional<sliding::SlideResult> with_vertical; ///< where the record has one

    std::optional<FlexibleSlips> flexible; ///< where the sliding mass is flexible

    std::optional<sliding::RockingResult>
        rocking; ///< free to rock, too; where the sliding block does not hold, or on request

    std::vector<std::string> broken_premises =
        {}; ///< why the sliding block does not hold for the dam in this motion: no PASS rests on it
    bool leaves_out = false; ///< something that the scene asks for (not_honoured()): no PASS rests on it either
    bool of_dam = false;     ///< elastic, so that the rigid block is no upper bound: "below" in place of PASS

    /// Of the rigid block, with the vertical component where there is one.
    const sliding::SlideResult& rigid() const { return with_vertical ? *with_vertical : horizontal; }
    /// Of the analysis that models the mass best: coupled; decoupled where that alone was asked for, or where the base
    /// opens, which coupled does not follow; of a rigid mass rigid(); rocking where that does not hold.
    GoverningSlip governing() const;
    /// The slip to judge by.
    const sliding::SlideResult& judged() const { return governing().slide; }
};

/// What it takes for the slip to stay within the allowable one, of one record with one polarity.
struct NeededRow {
    std::string record;
    int polarity = 1;
    double peak = 0.0;      ///< k_max g: largest acceleration that drives it downstream [m/s^2]
    double peak_time = 0.0; ///< of the first such sample [s]
    std::optional<double>
        yield; ///< one-way block, horizontal motion: a_y that slips the allowable (yield_for_slip) [m/s^2]
    std::optional<double>
        friction; ///< of the rigid block, with the vertical component where there is one; the least from which on it holds
};
inline constexpr double highest_friction = 3.0; ///< of the search for it [-]: 72 degrees, more than any joint's

/// Of all records and both polarities. Empty without criteria.allowable_slip, for a wedge and for friction over the slip: they
/// have no single friction or no sense up the slope. @param jobs  threads, 0: all cores
std::vector<NeededRow> needed_rows(const Ready& ready, int jobs);

/// Over the records, each with the worse polarity. Records whose worse polarity has no slip are counted by their status.
struct SetStatistics {
    std::string quantity;     ///< "rigid, horizontal", "rigid, with vertical"
    std::size_t n = 0;        ///< records with a slip, lower bounds included
    StatusCount without_slip; ///< the others
    StatusCount lower_bounds; ///< of the n
    double median = 0.0, percentile_16 = 0.0, percentile_84 = 0.0, mean = 0.0, largest = 0.0; ///< [m]; NaN where n is 0
    /// Records that fail against the allowable slip, over those that can be judged [-]
    std::optional<double> share_above_allowable;
    std::string controlling_record; ///< of the largest
};

/// The rigid block above a lift joint.
struct LiftBlock {
    std::string joint;
    double elevation = 0.0; ///< [m]
    double friction = 0.0;
    double normal_force = 0.0, shear_force = 0.0; ///< without earthquake [N/m]
    std::optional<double> sliding_factor;         ///< none: nothing drives the block
    double critical_friction = 0.0;
    double yield_acceleration = 0.0; ///< of the joint, downstream [m/s^2]
};
std::vector<LiftBlock> lift_blocks(const Scene& scene);

/// From this share of the resistance on a joint is judged without its bond, too [-]: a judgement. What cores and tests say of
/// the cohesion of a whole base is rarely worth more.
inline constexpr double judged_bond_share = 1.0 / 3.0;

struct Screening {
    EffectPlan plan;
    std::vector<BaseRow> bases;
    std::vector<sliding::Equilibrium> combinations; ///< limit equilibrium per load combination
    std::vector<sliding::UpliftComparison> uplifts; ///< what each uplift profile asks for
    std::optional<sliding::FlexibleBlock> flexible;
    std::string mass_ratio_words; ///< where the flexible block's mass ratio comes from
    std::vector<SlipRow> slips;
    double bond_share = 0.0; ///< c A' over c A' + mu N' before the earthquake [-]
    std::vector<SlipRow>
        slips_without_bond; ///< the rows once more with c = 0, where bond_share is above judged_bond_share
    std::optional<ElasticScreening> elastic; ///< none: not asked for, or no dam to run, see add_elastic_dam()
    Planes planes; ///< of scenes with [lifts] or [[seam]]; else without rows
    std::vector<RegressionRow> regressions;
    std::vector<SetStatistics> statistics;
    std::vector<NeededRow> needed;     ///< against criteria.allowable_slip; see needed_rows()
    double largest_pga = 0.0;          ///< of all records [m/s^2]
    bool dry_base = false;             ///< there is water on the dam, but no uplift
    double largest_vertical_pga = 0.0; ///< of their vertical components; 0: they have none [m/s^2]
    std::vector<std::string> warnings;
};

/// Some row has the block that rocks and slides.
bool has_rocking(const Screening& screening);

/// Error of the slip that is numerical [m]: none where events are located exactly; NaN for a scheme whose own is not known.
double slip_error(const sliding::SlideResult& slide);

/// The slide's largest slip against the allowable [m].
Verdict judge(const sliding::SlideResult& slide, const std::optional<double>& allowable);

/// The governing slip against the allowable [m]; no PASS where a premise of the slip is broken.
Verdict judge(const SlipRow& row, const std::optional<double>& allowable);

/// Does an analysis with the mass's own vibration judge the row, so that it may say PASS of a dam?
bool vibrates(const SlipRow& row);
/// The verdict in a word: "below" where a rigid block slips less than is allowed, and stands for a dam.
std::string verdict_word(const SlipRow& row, const std::optional<double>& allowable);

/// The one that decides: one that is no answer, else one without a slip, else the larger.
const sliding::SlideResult& worse(const sliding::SlideResult& a, const sliding::SlideResult& b);

/// Of the two rows of record `number` the one with the larger slip without the vertical component.
const SlipRow& worse_horizontal(const Screening& s, std::size_t number);
/// The same with it; null for a record that has none.
const SlipRow* worse_with_vertical(const Screening& s, std::size_t number);
/// The same by the slip that is judged.
const SlipRow& worse_judged(const Screening& s, std::size_t number);

/// Statuses of all slides of a screening.
StatusCount statuses_of(const Screening& screening);

/// When the block that rocks and slides is run beside the sliding one.
enum class RockingRuns { where_sliding_does_not_hold, always };

/// Is the block that vibrates run beside the rigid one?
enum class FlexibleRuns { as_the_scene_says, none };

/// @param ready  for the rigid block @param jobs  threads, 0: all cores
Screening run_screening(const Ready& ready, int jobs = 0,
                        RockingRuns rocking = RockingRuns::where_sliding_does_not_hold,
                        FlexibleRuns flexible = FlexibleRuns::as_the_scene_says);

/// Runs the elastic dam beside the rigid block where there is one to run: no wedge, no rock slope, records, and a block that
/// stands before the earthquake. What cannot be run is said in `why_not`, never thrown.
/// @param ready  that `screening` was made of, for the rigid block; its records are used again @throws Interrupted
void add_elastic_dam(const Ready& ready, int jobs, Watch& watch, Screening& screening);

/// The resultant of the static loads acts outside the base: it tips without any earthquake.
bool overturns(const BaseRow& base);

/// What must hold for the block's slip to be the dam's, and does not in a motion of this peak: the dam tips, or its joint
/// opens and loses its bond, at a smaller acceleration than slides it, and the motion reaches it. One sentence each.
/// @param peak  of the mass [m/s^2], reached both ways
std::vector<std::string> broken_premises(const BaseRow& base, double peak);

/// Those of all rows, each once.
std::vector<std::string> broken_premises(const Screening& screening);

FlexibleSlips slide_flexible(const Scene& scene, const sliding::FlexibleBlock& flexible, const RigidModel& model,
                             const GroundMotion& motion, int polarity,
                             sliding::HistoryOutput history = sliding::HistoryOutput::none);

} // namespace damslip
