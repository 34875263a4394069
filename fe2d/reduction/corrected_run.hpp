#pragma once

#include "fe2d/reduction/reduced_run.hpp"

#include <span>
#include <vector>

namespace damslip::fe2d {

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
