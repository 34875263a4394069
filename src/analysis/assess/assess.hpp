#pragma once

#include "analysis/ablation/ablation.hpp"
#include "analysis/screen/screening.hpp"
#include "analysis/spectrum/spectrum_level.hpp"
#include "core/parallel.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

/// Every level of effort on one dam, and what they say together.
namespace damslip {

inline constexpr const char* rigid_dam = "rigid dam on rigid rock"; ///< variant of the finite elements, as the rigid block's

/// What did not fit or could not be run.
struct LeftOut {
    std::string what, why;
};

/// Two levels more than three times apart, and the assumption that lies between them.
struct Disagreement {
    MotionOutcome lower, higher;
    std::optional<MotionOutcome> closest; ///< the run of finite elements nearest to the other level; none: none was run
    bool explains = false;                ///< that run is nearer to the other level than to the full finite elements
};

/// The value to use.
struct Recommendation {
    SlipLevel level = SlipLevel::finite_elements;
    std::string record;
    int polarity = 1;
    double slip = 0.0;            ///< [m]
    double low = 0.0, high = 0.0; ///< [m]
    bool error_known = true;      ///< false: low and high hold the models alone
    std::string from;             ///< what the range is made of, words
};

/// What the assessment asks for.
struct AssessOptions {
    double budget = 120.0; ///< wall time [s]; what does not fit is left out and named
    int jobs = 0;          ///< threads of the quick levels, 0: all cores
};

/// Parts of an assessment, in the order of their effort.
enum class AssessPart { rigid_block, flexible_block, finite_elements, spectrum, rigid_effects, variants };

/// One part before it runs.
struct PlannedPart {
    AssessPart part = AssessPart::rigid_block;
    std::size_t runs = 0;                  ///< motions that it follows; variants: one run each
    std::optional<double> seconds = {};    ///< wall time, from what a short piece of it took here; none: not known
    std::string left_out = {};             ///< why it cannot run; empty: it can
    bool fits = true;                      ///< the budget holds it and all before it
};

/// What an assessment would do, with what it would cost. Nothing but short pieces has run.
struct WorkPlan {
    Ready ready;               ///< of the rigid block
    std::optional<Ready> fe;   ///< none: finite elements cannot take the scene
    std::string rock_change;   ///< as of Assessment
    std::vector<PlannedPart> parts;
    double budget = 0.0; ///< [s]

    double seconds() const; ///< of all parts that fit [s]
};

/// @param given  as of assess() @throws InputError
WorkPlan plan_work(const Scene& given, const AssessOptions& options, Watch& watch);

struct Assessment {
    Ready ready;                       ///< of the rigid block
    Screening screening;               ///< limit equilibrium, regressions, rigid block
    std::optional<Screening> flexible; ///< the same with the first mode as a flexible block; none: it could not be made
    std::optional<SpectrumLevel> spectrum;
    std::optional<AblationRuns> rigid_ablation; ///< of rigid_plan
    std::optional<AblationPlan> rigid_plan;

    std::optional<Ready> fe;                ///< what the finite elements ran; none: they cannot take the scene
    std::string rock_change;                ///< of the scene, where it says massless rock; empty: as it says
    std::vector<ContactRun> runs;           ///< finite elements, those that came to their end
    ModelSpread spread;                     ///< on the worst record
    std::vector<MotionOutcome> assumptions; ///< the same with one assumption changed
    std::vector<LeftOut> left_out;
    std::map<AssessPart, double> seconds_of; ///< wall time of each part that began [s]
    bool interrupted = false; ///< by the user: nothing is recommended
    double seconds = 0.0;     ///< wall time

    std::vector<MotionOutcome> levels; ///< of each level and record the worse polarity; 0: of both
    std::vector<Disagreement> disagreements;
    std::optional<Recommendation> recommended;
    Verdict slip_verdict = Verdict::none;
    Verdict verdict = Verdict::none; ///< of the slip, FAIL where a check or a lift or seam fails
    std::string verdict_reason;      ///< of the slip's
};

/// Runs the levels in their order: limit equilibrium, regressions and blocks, response spectrum, finite elements on radiating
/// rock with the scene's water on all records and both polarities, then their variants on the worst record, while the
/// budget lasts. A flexible block that would take more than a tenth of the budget comes after the finite elements, if then.
/// Numbers do not depend on the budget, only which of them are there.
/// @param given  with a [section] and a record @throws InputError
Assessment assess(const Scene& given, const AssessOptions& options, Watch& watch);

/// Fills levels, disagreements, recommended and verdict from the runs.
void judge_assessment(Assessment& a);

inline constexpr double disagreement_factor = 3.0; ///< from which on the reason is asked for [-]

/// The run of the recommended value. @pre a.runs is not empty
const ContactRun& governing_run(const Assessment& a);

/// exit_no_answer where the user interrupted it, a run has no answer, or nothing is recommended of a dam that does not fail.
int exit_code_of(const Assessment& a);

/// A watch that also ends a computation when its time is over.
/// @tparam Clock  Stopwatch: wall time; ProcessorClock: processor time of the thread that made it
template <class Clock>
class BudgetWatchOf final : public Watch {
public:
    /// @param seconds  from now on @param outer  outlives this
    BudgetWatchOf(Watch& outer, double seconds) : outer_(outer), seconds_(seconds) {}

    double left() const { return seconds_ - clock_.seconds(); } ///< [s]
    double spent() const { return clock_.seconds(); }           ///< [s]
    bool over() const { return left() <= 0.0; }
    bool interrupted() const { return outer_.stop_asked(); } ///< by the user, not by the clock

    bool stop_asked() const override { return over() || outer_.stop_asked(); }
    void results_at_hand() override { outer_.results_at_hand(); }
    void begin(const std::string& label, double total) override { outer_.begin(label, total); }
    void phase(const std::string& what) override { outer_.phase(what); }
    void at(double done) override { outer_.at(done); }
    void end() override { outer_.end(); }

private:
    Watch& outer_;
    double seconds_;
    Clock clock_;
};
using BudgetWatch = BudgetWatchOf<Stopwatch>;

} // namespace damslip
