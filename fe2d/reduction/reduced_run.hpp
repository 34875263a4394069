#pragma once

#include "core/status.hpp"
#include "fe2d/reduction/reduced_operator.hpp"
#include "fe2d/run/earthquake_run.hpp"
#include "fe2d/run/ground_input.hpp"
#include "fe2d/run/strength.hpp"

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

namespace damslip::fe2d {

constexpr int default_modes = 12; ///< elastic modes kept when nothing is said: slip within 1 % of the full run's

/// Three more runs on a coarse plane tell how much the modes left out change the slip.
enum class TruncationEstimate { made, left_out };

/// The staged run on few modes of the dam (DamModes): static stages by the full model, earthquake and run-out reduced.
/// Rock, contact law, damping, scheme and ground motion are those of the full run; only the inertia of the dam's modes
/// above the last kept is left out, their flexibility is not. Acoustic water is reduced to shapes of its own (ReducedWater),
/// whose error has a gate and no part in the truncation error.
///
/// Truncation error: the inertia left out, and with it the error, goes with 1/ω² of the first mode left out, and ω²
/// grows in proportion to the number of modes of a plane body (Weyl 1911): e(n) ~ 1/n. Then e = |s(n) - s(N)|/(1 - n/N)
/// with N = 2n ... 4n modes, and with half of them e = |s(n/2) - s(n)|. Slips scatter around that law and either
/// difference may be small by accident: the estimate is their geometric mean, from runs on a coarse plane, where they
/// cost little. With acoustic water attachment modes give fewer modes the most of what they leave out: the estimate is the first
/// one, with 4n modes, alone, on the plane itself and with the largest steps of the run. So it is with laws of the joint and sequences.
class ReducedRun {
public:
    /// @param full  made from the same scene and options; kept by reference
    /// @param modes  elastic modes to keep, >= 1; all when there are no more
    ReducedRun(const EarthquakeRun& full, const Scene& scene, RunOptions options, int modes = default_modes);

    /// As EarthquakeRun::run, without an energy ledger: stages and the state after the earthquake by the full model, history of slip,
    /// crest, ground and forces. RunResult::seconds.model is that of modes and residual flexibility. @param halvings  in place of those of options and scene: uniform steps Δt/2^halvings; the slip
    /// then has no estimate of their error
    RunResult run(const GroundMotion& motion, const std::optional<Contact>& contact = {},
                      const std::optional<int>& halvings = {},
                      TruncationEstimate estimate = TruncationEstimate::made) const;
    /// Asked after each pass of passes(), with all so far: true, and no smaller step is made.
    using Enough = std::function<bool(std::span<const RunResult> passes)>;
    /// Passes with steps of Δt, Δt/2, Δt/4, ... until one does not come to rest, or `enough`: of each the history and the largest
    /// slip. None where nothing can move.
    std::vector<RunResult> passes(const Shaking& shaking, const Enough& enough) const;
    double wanted(const RunResult& run) const; ///< allowed_error() of its slip [m]
    /// Why no run has an answer: a sentence for the user; empty: there is a model.
    const std::vector<Note>& why_not() const { return why_not_; }

private:
    /// What the time loop reads of a motion.
    struct Motion {
        PlayedGround ground; ///< from its start; each pass plays it anew
        double dt = 0.0; ///< of the rows of the history [s]
        int parts = 1;   ///< steps in each
        ContactOptions contact;
        std::optional<int> halvings; ///< of dt, where they are not chosen by the slip
    };
    /// Where the dam stands before it moves.
    struct Start {
        Contact contact;
        Strength strength;   ///< after the static stages
        ContactMemory rest;  ///< of the pairs
        StageResult balance; ///< the last static stage
    };
    /// Systems on a coarse plane, or the reference alone on the plane itself (on_plane_itself()); none where all modes are kept.
    struct Estimators {
        std::unique_ptr<const ReducedModel> kept, fewer, reference;
    };
    /// What the truncation error is measured against: slips of the run's first pass, and the rows in which its events begin.
    struct FirstPass {
        std::vector<double> slip;
        std::vector<std::size_t> rows;
    };
    ReducedSystem system_of(DamModes modes) const;
    double highest_frequency() const; ///< ω up to which pressures are to be right [rad/s]
    std::vector<Note> obstacle() const; ///< of the scene; empty: none
    /// Is the truncation error found on the plane itself? A coarse one has no attachment modes, no laws of the joint and no events.
    bool on_plane_itself() const;
    const Estimators& estimators() const;
    Motion motion_of(const GroundMotion& motion, const std::optional<int>& halvings) const;
    /// The static stages, into `result`.
    Start stand(StaticContact& statics, const Contact& contact, RunResult& result) const;
    /// One pass. @param halvings  -k: with 2^k times the step; of its history the slip alone has the rows of the others
    /// @param strength  gets that at the end
    ReducedState shake_with(int halvings, Motion& motion, const Start& start, Strength& strength, RunResult& result) const;
    /// From rest to the end of the run-out; history, slip and counts go into `result`.
    /// @param balance  the run is watched for sliding by itself; null: it is not
    /// @returns the state at the end
    ReducedState shake(const Motion& motion, const ReducedModel& model, Strength& strength, const ContactMemory& rest,
                       const StageResult* balance, RunResult& result) const;
    /// Passes with halved steps until the slip holds still, or the one pass that is asked for. Where only the side of limits is asked
    /// for the first one has four times the step: for most slips two coarse passes tell it.
    /// @param coarsest  gets the first pass with the step Δt or the one that is asked for
    /// @returns the state at the end of the last one
    ReducedState refine(Motion& motion, Strength& strength, const Start& start, RunResult& result,
                        FirstPass& coarsest) const;
    /// @returns nothing when one of its runs was interrupted
    std::optional<double> truncation_error(const Motion& motion, const Start& start,
                                           const FirstPass& first) const;

    const EarthquakeRun& full_;
    Scene scene_;
    RunOptions options_;
    LoadStages stages_;
    int wanted_;                                ///< elastic modes asked for
    std::shared_ptr<const ReducedWater> water_; ///< null: none
    std::unique_ptr<const ReducedModel> model_;
    std::vector<Note> why_not_; ///< there is no model
    CoarsePlane coarse_;  ///< of the truncation estimate
    mutable std::once_flag estimators_made_;
    mutable Estimators estimators_; ///< made by the first run that estimates
    double seconds_ = 0.0;
};

/// The full run on steps that are larger than its slip needs, and the rest of the way on few modes of the dam:
///
///     s = s_full(Δt/2^L) + s_few(Δt/2^K) - s_few(Δt/2^L),   1 <= L < K
///
/// (defect correction; of two terms of a multilevel sum, Giles 2015, Acta Numerica 24, 259-328). What the step leaves open is
/// contact's, and contact is the same in both: the correction errs by a few hundredths of itself (docs/fe-contact.md, Accuracy in
/// time). The error is what the smallest step leaves open by the slips on few modes, and a tenth of the correction or, where that
/// is more, what few modes and the whole dam differ by at the steps that both have made. L is the least for which it is within
/// time.slip_tolerance. The dam slides farther by the correction as a rigid body; stresses, openings, forces and energy are
/// those of the full run at its steps.
///
/// Where the error is not within the tolerance, or something does not come to rest, the full run goes its own way: steps halved
/// until the slip stays.
class CorrectedRun final : public StepCorrector {
public:
    /// @param full  made from the same scene and options; kept by reference
    CorrectedRun(const EarthquakeRun& full, const Scene& scene, const RunOptions& options);

    /// As EarthquakeRun::run_all; RunResult::correction says what was added.
    std::vector<RunResult> run_all(std::span<const Shaking> shakings) const override;

private:
    struct OnFewModes;
    bool stopped(std::size_t next, std::span<const Shaking> shakings) const;
    std::optional<OnFewModes> on_few_modes(const Shaking& shaking) const; ///< none: they do not settle within the tolerance
    bool correct(const GroundMotion& motion, const OnFewModes& few, RunResult& run) const;

    const EarthquakeRun& full_;
    std::function<RunAnswer(const RunProgress&)> progress_;
    ReducedRun few_;
};

/// For RunOptions::corrector.
std::unique_ptr<const StepCorrector> corrected_run(const EarthquakeRun& full, const Scene& scene, const RunOptions& options);

} // namespace damslip::fe2d
