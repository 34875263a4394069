#include "fe2d/reduction/reduced_run.hpp"
#include "fe2d/run/step_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace damslip::fe2d {

namespace {

/// Modes of the estimate's reference: four times as many, or twice where that would cost more than the run.
int reference_modes(int modes)
{
    return std::max(2 * modes, std::min(4 * modes, 64));
}

} // namespace

const ReducedRun::Estimators& ReducedRun::estimators() const
{
    std::call_once(estimators_made_, [this] {
        if (model_->system().modes.complete) return;
        DamModes reference = dam_modes(full_.structure(), reference_modes(wanted_));
        if (!reference.regular) return;
        const auto coarse = [&](const ReducedSystem& system) {
            return std::make_unique<const ReducedModel>(coarse_.plane(), coarse_.coarsened(system),
                                                        scheme_of(scene_.time));
        };
        estimators_.kept = coarse(model_->system());
        estimators_.fewer = coarse(system_of(reference.first(3 + wanted_ / 2)));
        estimators_.reference = coarse(system_of(std::move(reference)));
    });
    return estimators_;
}

std::optional<double> ReducedRun::truncation_error(const Motion& motion, const Start& start) const
{
    if (model_->system().modes.complete) return 0.0;
    const Estimators& systems = estimators();
    if (!systems.kept) return std::numeric_limits<double>::quiet_NaN(); // the modes beyond did not converge
    const ContactMemory memory = coarse_.shut(start.rest);
    Motion coarse_motion = motion;
    coarse_motion.contact.landing = Landing::ringing; // few pairs land together: jolts that the full plane has not
    bool interrupted = false;
    const auto slips = [&](const ReducedModel& model) {
        Strength strength(start.contact, coarse_.plane());
        strength.follow(memory);
        ReducedResult result;
        shake(coarse_motion, model, strength, memory, nullptr, result);
        interrupted = interrupted || result.status == Status::interrupted;
        return result.history.slip;
    };
    const double modes = static_cast<double>(systems.kept->system().dam_modes - 3);
    const double more = static_cast<double>(systems.reference->system().dam_modes - 3);
    const double fewer = static_cast<double>(systems.fewer->system().dam_modes - 3);
    const std::vector<double> kept = slips(*systems.kept);
    const double to_more = largest_difference(kept, slips(*systems.reference));
    if (interrupted) return std::nullopt;
    if (systems.reference->system().modes.complete) return to_more;
    if (fewer < 1.0) return to_more / (1.0 - modes / more); // one mode: none to compare with, n^-1 as if the slower
    const double from_fewer = largest_difference(slips(*systems.fewer), kept);
    if (interrupted) return std::nullopt;
    // The error as n^-p: both differences tell it, and their ratio tells p.
    const auto gone = [&](double p) { return 1.0 - std::pow(modes / more, p); };
    const auto gained = [&](double p) { return std::pow(modes / fewer, p) - 1.0; };
    double slow = 1.0, fast = 2.0; // of modes whose frequencies grow as n^1/2; of smooth loads
    for (int k = 0; k < 40; ++k) {
        const double p = 0.5 * (slow + fast);
        (from_fewer * gone(p) > to_more * gained(p) ? slow : fast) = p;
    }
    return std::sqrt(to_more / gone(slow) * from_fewer / gained(slow));
}

} // namespace damslip::fe2d
