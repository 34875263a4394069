#include "fe2d/contact/joint_law.hpp"

#include "fe2d/solver/dense_product.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double settled = 1e-12; ///< changes of mu below this are none [-]
/// The change of friction falls by the factor ρ(V_tt⁻¹D) with each solution: this many are enough up to a factor of 0.75, and
/// half a step has less than half of it.
constexpr int most_corrections = 100;

} // namespace

RateFrictionLaw::RateFrictionLaw(Index pairs, std::vector<RateFrictionPart> parts)
    : parts_(std::move(parts)), ratio_(VectorXd::Ones(pairs)), rate_(VectorXd::Zero(pairs))
{
}

void RateFrictionLaw::begin(const JointStart& start)
{
    dt_ = start.dt;
    rate_slope_ = start.rate_slope;
    rate_known_ = start.rate_known;
    stiffness_ = start.stiffness;
    strength_ = start.strength ? start.strength->friction : VectorXd::Ones(ratio_.size());
    trial_ = dt_ > 0.0 ? ratio_ : VectorXd::Ones(ratio_.size()); // a static stage knows no rate
    rate_then_ = slope_ = VectorXd::Zero(ratio_.size());
    solutions_ = 0;
}

void RateFrictionLaw::add(JointTerms& terms) const
{
    for (const RateFrictionPart& part : parts_)
        terms.strength.friction.segment(part.first, part.pairs).array() *=
            trial_.segment(part.first, part.pairs).array();
}

RateFrictionLaw::Value RateFrictionLaw::value(const RateFriction& law, double start, double rate) const
{
    const double decay = std::exp(-rate / *law.characteristic_rate);
    const double steady = law.kinetic_ratio + (1.0 - law.kinetic_ratio) * decay;
    const double steady_slope = -(1.0 - law.kinetic_ratio) * decay / *law.characteristic_rate;
    if (!law.relaxation_time && !law.relaxation_slip) return {steady, steady_slope};
    const double per_time = law.relaxation_time ? 1.0 / *law.relaxation_time : 0.0;
    const double per_slip = law.relaxation_slip ? 1.0 / *law.relaxation_slip : 0.0;
    const double left = std::exp(-(per_time + rate * per_slip) * dt_);
    return {steady + (start - steady) * left, steady_slope * (1.0 - left) - (start - steady) * left * per_slip * dt_};
}

JointFit RateFrictionLaw::revise(const ContactSolution& solution)
{
    if (!(dt_ > 0.0)) return JointFit::fits;
    double change = 0.0;
    for (const RateFrictionPart& part : parts_)
        for (Index i = part.first; i < part.first + part.pairs; ++i) {
            const ContactState state = solution.states[static_cast<std::size_t>(i)];
            slope_[i] = rate_then_[i] = 0.0;
            if (state == ContactState::open) continue;
            const double slip = solution.displacement[ratio_.size() + i];
            const double rate = is_slip(state) ? std::abs(rate_slope_ * slip + rate_known_[i]) : 0.0;
            const Value now = value(part.law, ratio_[i], rate);
            rate_then_[i] = rate;
            if (is_slip(state)) slope_[i] = value(part.law, ratio_[i], std::min(rate, rate_[i])).slope;
            change = std::max(change, strength_[i] * std::abs(now.ratio - trial_[i]));
            trial_[i] = now.ratio;
        }
    if (change <= settled) return unique(solution) ? JointFit::fits : JointFit::too_far;
    return ++solutions_ < most_corrections && std::isfinite(change) ? JointFit::changed : JointFit::too_far;
}

/// Is V_tt - D positive definite on the slipping pairs? With the slopes of the way through the step.
bool RateFrictionLaw::unique(const ContactSolution& solution) const
{
    if (!stiffness_) return true;
    const Index m = ratio_.size();
    std::vector<Index> slipping;
    bool weakens = false;
    for (Index i = 0; i < m; ++i)
        if (is_slip(solution.states[static_cast<std::size_t>(i)])) {
            slipping.push_back(m + i);
            weakens = weakens || slope_[i] < 0.0;
        }
    if (!weakens) return true;
    MatrixXd left = (*stiffness_)(slipping, slipping);
    for (std::size_t k = 0; k < slipping.size(); ++k) {
        const Index i = slipping[k] - m, place = static_cast<Index>(k);
        left(place, place) += std::max(0.0, solution.force[i]) * strength_[i] * slope_[i] * rate_slope_;
    }
    return left.llt().info() == Eigen::Success;
}

void RateFrictionLaw::end(const ContactSolution&)
{
    ratio_ = trial_;
    rate_ = rate_then_;
    stiffness_ = nullptr;
}

} // namespace damslip::fe2d
