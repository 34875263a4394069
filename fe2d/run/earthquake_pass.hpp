#pragma once

#include "fe2d/run/contact_motion.hpp"
#include "fe2d/run/run_watches.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "fe2d/run/ground_input.hpp"
#include "fe2d/run/stages.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace damslip::fe2d {

/// A slip computed with steps of dt / 2^halvings.
struct SlipAtStep {
    int halvings = 0;
    double slip = 0.0;   ///< at the end [m]
    double change = 0.0; ///< from the slip before, at whatever time it is largest; of the first one 0 [m]
};

/// Order in the step that an estimate relies on at most, whatever the slips show: of hard contact and friction. Slips show 1.75 on
/// average (docs/verification.md, fe.sliding.order-in-step), single ones less.
inline constexpr double contact_order = 1.5;
/// Of what changes at an instant, which falls on a step's end: a bond that breaks, water that enters a joint, strength that follows the
/// slip from one step to the next.
inline constexpr double sudden_order = 1.0;

/// Factors of safety of the grid convergence index (Roache 1994, J. Fluids Eng. 116, 405-413): the error that rests on two slips is
/// three times what their change shows, one that rests on three and the order they show a quarter more.
struct SafetyFactor {
    double of_two = 3.0, of_three = 1.25;
};
inline constexpr SafetyFactor safety_factor;

/// Order p of the error, as c (dt / 2^k)^p, that the changes between the last three slips show, 1 <= p <= largest: contact with
/// moving edges converges with first order at worst. 1 for fewer slips.
/// @param largest  >= 1
double observed_order(std::span<const SlipAtStep> slips, double largest = contact_order);

/// Error of the last of at least two slips, F change / (2^(p (k - j)) - 1) with the observed order p and the factor of safety F [m].
/// The change is that of the whole history: at its end alone errors of several slides may cancel. One that is smaller than the one
/// before by more than the largest order explains is an accident, and counts as large as with that order.
double step_error(std::span<const SlipAtStep> slips, double largest = contact_order);

/// Halvings to try next: one more, or two more after the first two slips when one more cannot bring the error down to what is wanted.
/// @param excess  error over what is wanted, > 1 [-]
int next_halvings(std::span<const SlipAtStep> slips, double excess, double largest = contact_order);

/// Largest difference of two slip histories on the same steps, as far as both go, and of their last values [m].
/// @pre neither is empty
double largest_difference(std::span<const double> a, std::span<const double> b);

void end_events(RunResult& run); ///< the slip of the last event, and what each one changed
std::vector<std::size_t> event_rows(const RunResult& run); ///< the first one of each event in its history; of one record 0

/// The same of runs of several events, each compared from its own first row on: a dam that rests sooner meets the next event
/// sooner. @param a_starts, b_starts  rows, ascending, the first one 0
double largest_difference(std::span<const double> a, std::span<const std::size_t> a_starts, std::span<const double> b,
                          std::span<const std::size_t> b_starts);

/// Reads what a SlideWatch asks for from the contact of a run: thrust and normal force of each plane are those of the static
/// state that the motion starts from, the strength is that of the instant.
class SlideProbe {
public:
    /// @param rest  the last static stage, in equilibrium   @param start  slips of all pairs before the motion [m]
    SlideProbe(const ContactPlanes& planes, const StageResult& rest, const Eigen::VectorXd& start);

    double static_normal_force() const { return balances_.front().normal_force; } ///< of the base [N/m]

    /// The instant of a run that keeps an energy ledger: the work of friction is taken from it.
    SlideInstant instant(const ContactMotion& dynamics, const ContactLaw& law) const;
    /// The instant of a run without a ledger. @param friction  dissipated since the start [J/m]
    SlideInstant instant(double time, const ContactMemory& contact, const ContactLaw& law, double friction) const;

private:
    double sliding_factor(const ContactLaw& law) const;

    const ContactPlanes& planes_;
    std::vector<BaseResultant> balances_; ///< by plane
    std::vector<double> start_;           ///< mean slips by plane [m]
};

/// The steps of a pass: rows of the history, and equal parts of each.
struct PassSteps {
    double row = 0.0;       ///< [s]
    int parts = 1;          ///< steps in a row
    double run_out = 0.0;   ///< at most [s]
    double rest_time = 0.0; ///< without slip, after which the dam is at rest [s]

    double step() const { return row / parts; }   ///< [s]
    long rows(double time) const;                 ///< that reach `time`
    double time(long row_before, int part) const; ///< end of a step [s]
    friend bool operator==(const PassSteps&, const PassSteps&) = default;
};

/// One run through the earthquake with steps of one size: the dam in motion, the ground below it, and what is written of both.
/// Several passes with the same steps go on side by side (EarthquakeRun::shake), each with a ground and an end of its own.
class EarthquakePass {
public:
    /// @param so_far  static stages and, with `before`, the history that goes on
    EarthquakePass(DynamicContact start, PlayedGround ground, const PassSteps& steps, const Strength& at_start,
                   const RunResult& so_far, PairSeries series, double frame_interval,
                   const std::optional<HistoryBefore>& before, SlideWatch watching, const CrackLines& cracks,
                   bool ends_when_lifts_wake);
    EarthquakePass(const EarthquakePass&) = delete; // the recorder points into it
    EarthquakePass& operator=(const EarthquakePass&) = delete;

    bool going() const { return going_; }
    bool makes_steps() const { return going_ && dynamics_.within_reach(); }
    DynamicContact& dynamics() { return dynamics_; }
    DynamicContact::BatchedRun batched(double time) { return {&dynamics_, &strength_.law(), ground_.at(time), {}}; }
    long shown_rows() const { return shown_rows_; } ///< of all samples of the motion
    const Strength& strength() const { return strength_; }

    void after_step();
    /// Writes row n and finds out whether the pass goes on. @param stopped  somebody asked for an end
    void after_row(long n, bool stopped);
    /// What is known when the passes have come to their end.
    RunResult& finish();

private:
    void add_row();
    void look_for_cracks();
    void end(Status status);
    void rest(long n);

    PassSteps steps_;
    DynamicContact dynamics_;
    PlayedGround ground_;
    Strength strength_;
    RunResult result_;
    HistoryRecorder recorder_;
    SlideProbe probe_;
    SlideWatch watch_;
    CrackWatch cracks_;
    double begin_; ///< of its motion [s]
    bool ends_when_lifts_wake_;
    long record_rows_, all_rows_, rest_rows_; ///< to the end of the record; with the run-out; at rest
    long shown_rows_;
    long at_rest_since_ = -1; ///< row, of a sequence with more to come; -1: it moves
    bool going_ = true;
};

/// One motion and strength of several that are run together: its static state, and the result so far.
struct EarthquakeRun::BatchedRun {
    Strength strength;
    ContactMemory memory;
    Contact contact = {}; ///< strength of the base
    const GroundMotion* motion = nullptr;
    StaticState start = {};
    Eigen::VectorXd load = {};   ///< static, on all unknowns, while it shakes [N/m]
    PressureProfile uplift = {}; ///< under the base, part of `load`
    RunResult result = {};
    std::optional<HistoryBefore> before = {};        ///< of a record of a sequence that begins from a static state
    int next = 0;                                    ///< halvings of the next pass; 0: none
    std::vector<std::vector<SlipAtStep>> slips = {}; ///< of the passes, by plane
    double local_error = 0.0;                        ///< of the worst steps of the first pass, for adaptive steps [m]
    std::vector<double> later_errors = {};           ///< the same of the later records of a sequence
    long steps_before = 0, steps_of_all = 0;         ///< of the records before, and of all; 0: of its motion
    std::optional<ChosenSteps> steps = {};           ///< in place of the options'

    /// Do the static stages end in equilibrium?
    bool stands() const { return !result.stages.empty() && result.stages.back().status == StageStatus::ok; }
    double order_in_step() const;           ///< that an estimate of the slip's error relies on at most
    void note_slips(const RunResult& pass); ///< before `pass` becomes `result`
};

} // namespace damslip::fe2d
