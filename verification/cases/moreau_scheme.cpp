#include "verification/cases/moreau_scheme.hpp"

#include <algorithm>

namespace damslip::verification {

using Eigen::Index;
using Eigen::VectorXd;

MoreauScheme::MoreauScheme(DenseSystem system, VectorXd friction, double dt, double theta)
    : system_(std::move(system)), friction_(std::move(friction)), dt_(dt), theta_(theta),
      factor_(system_.mass + theta * dt * system_.damping + theta * theta * dt * dt * system_.stiffness),
      response_(factor_.solve(system_.interface_map.transpose())), delassus_(system_.interface_map * response_),
      shut_(static_cast<std::size_t>(friction_.size()))
{
}

void MoreauScheme::start(const VectorXd& displacement, const VectorXd& load)
{
    u_ = displacement;
    v_ = VectorXd::Zero(u_.size());
    load_ = load;
    impulse_ = VectorXd::Zero(delassus_.rows());
}

void MoreauScheme::advance(const VectorXd& load)
{
    const DenseSystem& s = system_;
    const Index m = friction_.size();
    const VectorXd ahead = s.interface_map * (u_ + 0.5 * dt_ * v_);
    for (Index i = 0; i < m; ++i) shut_[static_cast<std::size_t>(i)] = ahead[i] <= 1e-14;

    const VectorXd smooth = s.mass * v_ - dt_ * (1.0 - theta_) * (s.damping * v_) -
                            dt_ * (s.stiffness * (u_ + theta_ * (1.0 - theta_) * dt_ * v_)) +
                            dt_ * (theta_ * load + (1.0 - theta_) * load_);
    const VectorXd free = factor_.solve(smooth);
    free_rates_ = s.interface_map * free;
    gauss_seidel();
    const VectorXd after = free + response_ * impulse_;
    u_ += dt_ * (theta_ * after + (1.0 - theta_) * v_);
    v_ = after;
    load_ = load;
}

/// Pair by pair: opening with the slip held, then slip with the opening held, from the impulses of the last step.
void MoreauScheme::gauss_seidel()
{
    const Index m = friction_.size();
    for (Index i = 0; i < m; ++i)
        if (!shut_[static_cast<std::size_t>(i)]) impulse_[i] = impulse_[m + i] = 0.0;
    double change = 1.0;
    for (int sweep = 0; change > 1e-12 && sweep < 20000; ++sweep) {
        change = 0.0;
        const double scale = std::max(impulse_.head(m).maxCoeff(), 1e-300);
        const auto set = [&](Index k, double value) {
            change = std::max(change, std::abs(value - impulse_[k]) / scale);
            impulse_[k] = value;
        };
        for (Index i = 0; i < m; ++i) {
            if (!shut_[static_cast<std::size_t>(i)]) continue;
            const Index t = m + i;
            set(i, std::max(0.0, impulse_[i] - (free_rates_[i] + delassus_.row(i).dot(impulse_)) / delassus_(i, i)));
            const double stick = impulse_[t] - (free_rates_[t] + delassus_.row(t).dot(impulse_)) / delassus_(t, t);
            const double limit = friction_[i] * impulse_[i];
            set(t, std::clamp(stick, -limit, limit));
        }
    }
}

bool MoreauScheme::all_shut() const
{
    return std::all_of(shut_.begin(), shut_.end(), [](char shut) { return shut != 0; });
}

} // namespace damslip::verification
