#pragma once

#include "analysis/fe/contact_runs.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// A scene with one thing changed, and the one runner of such variants: `accuracy`, `explain --ablate`, the model spread of `fe`
/// and `assess` choose the scenes and say what their outcomes mean.
namespace damslip {

/// Ways to a slip, from the least effort on.
enum class SlipLevel { regressions, rigid_block, flexible_block, finite_elements };
std::string word(SlipLevel level); ///< "rigid block"

/// One variant under one motion. Empty: its method does not give it.
struct MotionOutcome : MotionName {
    std::string what = {}; ///< the variant, "without uplift", or how its slip was found, "rocking and sliding"
    SlipLevel level = SlipLevel::finite_elements;
    Status status = Status::interrupted;
    std::string message = {};                ///< how it ended, a sentence; empty: at rest, or not run
    std::string why_it_fails = {};           ///< of a rigid block that does not stand before the earthquake
    std::optional<double> slip = {};         ///< at the end, positive downstream, of a run at rest or still sliding [m]
    std::optional<double> largest_slip = {}; ///< on the way, its size, as reported() [m]
    std::optional<double> low = {}, high = {}; ///< of that: by numerical error, or 16 and 84 % of regressions [m]
    std::optional<double> crest = {};        ///< largest |crest - base|, horizontal, since the static state [m]
    std::vector<double> lift_slips = {};     ///< of the lift joints, final, from bottom to top [m]
    std::optional<Effect> without = {};      ///< the effect that is left out; none: another kind of change
    bool still_sliding = false;              ///< when the run-out ended: the slip is a lower bound
    int halvings = 0;                        ///< dt / 2^halvings: the step, or the smallest that corrected it
    double seconds = 0.0;                    ///< of the processor for this run, without the set-up

    /// Why there is no slip: of a rigid block that does not stand its friction beside the one that would hold it.
    const std::string& reason() const { return why_it_fails.empty() ? message : why_it_fails; }
};

/// One variant under all motions.
struct VariantRuns {
    std::vector<MotionOutcome> motions;       ///< in the order of motion_names()
    std::optional<double> yield_acceleration; ///< of the rigid block [m/s^2]
    std::optional<double> critical_friction;  ///< least mu of static equilibrium [-]
    std::optional<double> time_step;          ///< the smallest used [s]
    std::optional<std::int64_t> unknowns;     ///< of the FE model, the water's included; modes of a reduced run
    std::optional<std::int64_t> steps;        ///< of all motions, of the pass that counts
    double set_up_seconds = 0.0;              ///< of the processor

    double run_seconds() const;
    double all_seconds() const { return set_up_seconds + run_seconds(); }
};

struct VariantOptions {
    std::optional<int> modes = {}; ///< FE run on few modes of the dam, without an estimate of those that are left out
    bool rocking = false;          ///< the rigid block is free to rock
    bool all_planes = false;       ///< rigid blocks of lifts and seams beside that of the base: the one that slides furthest
    bool ends_at_failure = false;  ///< motions after the first that does not come to rest are not run
    int repetitions = 1;           ///< of rigid runs of milliseconds, so that the shortest says what they cost
    ProcessorTimeOf seconds_of = ProcessorTimeOf::thread;
    std::function<void(double share)> done = {}; ///< called with how much of the FE runs is done, 0 ... 1; may be empty
};

/// Runs all motions of a scene by the method that it is ready for. By finite elements tied lifts wake and cracks are followed
/// (ContactRuns); what that takes beside the set-up of the last model counts as runs. @throws as the models
VariantRuns run_variant(const Ready& ready, const VariantOptions& options, const Watch& watch);

/// Runs that could not be made.
VariantRuns without_model(Status status, const std::string& why, const std::vector<MotionName>& motions);

/// A scene with one thing changed, for the worst motion.
struct Variant {
    std::string what; ///< "massless rock", "without uplift"
    Scene scene;
    std::optional<Effect> without = {};
};

/// Finite elements with contact on one record, without a second mesh and without histories; those that came to their end.
std::vector<ContactRun> run_record(const Scene& scene, const RecordPair& record, std::optional<int> polarity, Watch& watch);

/// The same of a variant, on record and polarity of the worst run. @param ready  of that run
/// @throws InputError, NotConverged, Interrupted
MotionOutcome run_worst(const Variant& variant, const Ready& ready, const ContactRun& worst, Watch& watch);

/// How far choices of the model lie from the printed slip.
struct ModelSpread {
    std::vector<MotionOutcome> runs; ///< of record and polarity of the worst run; "other polarity" as far as it was run
    std::vector<std::string> not_run;
};

/// The other polarity as far as `runs` has it, then other_models() of the scene.
/// @param ready  of `runs` @param run_them  run those on the record and polarity of the worst run; else they are named as not run
/// @throws InputError, NotConverged, Interrupted
ModelSpread model_spread(const Ready& ready, const std::vector<ContactRun>& runs, bool run_them, Watch& watch);

/// One line for the answer; empty where there is nothing to choose.
std::string spread_line(const ModelSpread& spread, const std::vector<ContactRun>& runs);

} // namespace damslip
