#include "fe2d/run/static_relaxation.hpp"

#include "fe2d/contact/anchor_law.hpp"
#include "fe2d/run/dynamic_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace damslip::fe2d {

using Eigen::VectorXd;

namespace {

constexpr double steps_per_period = 40.0;
constexpr double least_damping_ratio = 0.05; ///< of the first mode [-]
constexpr int still_periods = 5;             ///< without slip: at rest
constexpr int most_periods = 400;
constexpr double still = 1e-8;         ///< largest slip of a pair within a period of a dam at rest [m]
constexpr double still_kinetic = 1e-4; ///< kinetic energy of a dam at rest, over the largest on the way [-]
/// Mean slip beyond which a dam whose rate grows slides away [m]; with anchors their longest free length, if that is more: a bar
/// across the joint tightens with the square of the slip.
constexpr double far = 0.1;
constexpr int growing_periods = 5; ///< for so long

/// What one period brought.
struct PeriodWatch {
    VectorXd slip;
    double mean = 0.0, rate = 0.0;
    int still_for = 0, growing_for = 0;

    /// @param now  slips of all pairs [m] @param mean_now  the largest mean of a plane since the start [m]
    /// @param away  slip beyond which nothing tightens any more [m]
    void add(const VectorXd& now, double mean_now, double away, bool calm)
    {
        still_for = calm && (now - slip).cwiseAbs().maxCoeff() <= still ? still_for + 1 : 0;
        const double rate_now = std::abs(mean_now - mean);
        growing_for = mean_now > away && rate_now >= rate ? growing_for + 1 : 0;
        slip = now;
        mean = mean_now;
        rate = rate_now;
    }
};

double largest_mean(const ContactPlanes& planes, const VectorXd& slip)
{
    double largest = 0.0;
    for (Eigen::Index k = 0; k < planes.count(); ++k) largest = std::max(largest, std::abs(planes.mean(k, slip)));
    return largest;
}

Release relax(const std::shared_ptr<StepOperators>& operators, const SplitLoad& load, const StaticState& start,
               const ContactLaw& law, const Contact& joint, const ContactOptions& options, double dt,
               ContactMemory& memory)
{
    DynamicContact motion(operators, load, start, memory, joint, options);
    const ContactPlanes& planes = operators->structure().planes();
    const VectorXd& slip = motion.state().contact.slip;
    PeriodWatch watch;
    watch.slip = slip;
    double fastest = 0.0;
    Release release;
    for (int period = 0; period < most_periods && watch.growing_for < growing_periods; ++period) {
        for (int step = 0; step < static_cast<int>(steps_per_period); ++step) {
            motion.advance(dt, {}, law);
            if (!motion.within_reach()) return release;
        }
        const double kinetic = motion.energy().kinetic;
        fastest = std::max(fastest, kinetic);
        const auto* anchors = motion.state().contact.laws.find<AnchorLaw>();
        const double away = std::max(far, anchors ? anchors->reach() : 0.0);
        watch.add(slip, largest_mean(planes, slip - memory.slip), away, kinetic <= still_kinetic * fastest);
        release.lost = motion.energy().damping + motion.energy().numerical + motion.energy().radiated;
        if (watch.still_for < still_periods) continue;
        memory = motion.state().contact;
        release.rests = true;
        return release;
    }
    return release;
}

} // namespace

double first_period(double height, double young_modulus)
{
    return 381.0 * height / std::sqrt(young_modulus);
}

Relaxation relaxation_of(const ContactStructure& structure, const RunDamping& damping, const Scheme& scheme,
                const ReducedRock* radiating, const Contact& joint, const ContactOptions& options, double period)
{
    RunDamping stiffness_alone = damping;
    stiffness_alone.constants.mass = 0.0;
    stiffness_alone.constants.stiffness =
        std::max(damping.constants.stiffness, least_damping_ratio * period / std::numbers::pi);
    const double dt = period / steps_per_period;
    // Made when they are needed first: most stages hold.
    auto operators = std::make_shared<std::shared_ptr<StepOperators>>();
    return
        [=, &structure](const SplitLoad& load, const StaticState& start, const ContactLaw& law, ContactMemory& memory) {
            if (!*operators)
                *operators = std::make_shared<StepOperators>(
                    structure, stiffness_alone, scheme,
                    std::shared_ptr<const ReducedRock>(std::shared_ptr<const ReducedRock>(), radiating));
            return relax(*operators, load, start, law, joint, options, dt, memory);
        };
}

} // namespace damslip::fe2d
