#include "sliding/block/rated_slip.hpp"

#include "sliding/block/roots.hpp"
#include "sliding/block/series.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace damslip::sliding {

double steady_ratio(const RateFriction& law, double rate)
{
    if (!law.active()) return 1.0;
    return law.kinetic_ratio + (1.0 - law.kinetic_ratio) * std::exp(-rate / *law.characteristic_rate);
}

bool lags(const RateFriction& law)
{
    return law.active() && (law.relaxation_time || law.relaxation_slip);
}

RatedStep::RatedStep(const RatedSlip& slip) : slip_(slip)
{
    expand(slip);
}

/// Term by term. With E = exp(-v/v_c): i E_i = -(1/v_c) Σ_j j v_j E_{i-j}; products of series are Cauchy's.
void RatedStep::expand(const RatedSlip& s)
{
    const double k = s.law.kinetic_ratio, v_c = *s.law.characteristic_rate;
    const double per_time = s.law.relaxation_time ? 1.0 / *s.law.relaxation_time : 0.0;
    const double per_slip = s.law.relaxation_slip ? 1.0 / *s.law.relaxation_slip : 0.0;
    const double drive_rate = (s.drive.end - s.drive.now) / s.span,
                 normal_rate = (s.normal.end - s.normal.now) / s.span;
    const bool lag = lags(s.law);
    Series v{}, decay{}, peak{}, steady{}, mu{}, mass{}, accel{};
    v[0] = w_[1] = s.moves ? s.rate : 0.0;
    const int last_term = s.moves ? order - 2 : order; // as far as the length of the step is judged by
    for (int i = 0; i <= last_term; ++i) {
        decay[i] = i == 0 ? std::exp(-v[0] / v_c) : 0.0;
        for (int j = 1; j <= i; ++j) decay[i] -= j * v[j] * decay[i - j] / (v_c * i);
        peak[i] = i == 0 ? s.friction : s.slope * w_[i];
        steady[i] = (i == 0 ? k : 0.0) + (1.0 - k) * decay[i];
        if (!lag) {
            ratio_[i] = steady[i];
        } else if (i == 0) {
            ratio_[0] = s.ratio;
        } else {
            double sum = per_time * (steady[i - 1] - ratio_[i - 1]);
            for (int j = 0; j < i; ++j) sum += per_slip * (steady[j] - ratio_[j]) * v[i - 1 - j];
            ratio_[i] = sum / i;
        }
        for (int j = 0; j <= i; ++j) mu[i] += peak[j] * ratio_[i - j];
        resistance_[i] = mu[i] * s.normal.now + (i > 0 ? mu[i - 1] * normal_rate : 0.0) + (i == 0 ? s.cohesion : 0.0);
        if (!s.moves) continue;
        mass[i] = (i == 0 ? s.mass_tt : 0.0) + s.mass_tn * mu[i];
        double force = (i == 0 ? s.drive.now : i == 1 ? drive_rate : 0.0) - resistance_[i];
        for (int j = 1; j <= i; ++j) force -= mass[j] * accel[i - j];
        accel[i] = force / mass[0];
        if (i == 0 && s.from_rest) accel[0] = std::max(accel[0], 0.0);
        v[i + 1] = accel[i] / (i + 1);
        w_[i + 2] = v[i + 1] / (i + 2);
    }
    // The last two terms stay below round-off of the largest one: of the acceleration, or of r where the block rests.
    const Series& watched = s.moves ? accel : ratio_;
    length_ = length_to_round_off(std::span(watched).first(static_cast<std::size_t>(last_term) + 1), s.span);
}

double RatedStep::path(double h) const
{
    return polynomial(w_, h);
}

double RatedStep::rate(double h) const
{
    return polynomial(derivative(w_), h);
}

double RatedStep::accel(double h) const
{
    return polynomial(derivative(derivative(w_)), h);
}

double RatedStep::ratio(double h) const
{
    return polynomial(ratio_, h);
}

double RatedStep::time_of_stop() const
{
    return first_fall_to_zero(derivative(w_), length_);
}

double RatedStep::time_of_path(double target, double until) const
{
    return bracketed_root([&](double h) { return path(h) - target; }, 0.0, until);
}

double RatedStep::time_of_start(double sign) const
{
    std::vector<double> holds(resistance_.begin(), resistance_.end());
    holds[0] -= sign * slip_.drive.now;
    holds[1] -= sign * (slip_.drive.end - slip_.drive.now) / slip_.span;
    if (holds[0] < 0.0) return 0.0;
    const double h = first_fall_to_zero(holds, length_);
    return h < slip_.span ? h : never;
}

} // namespace damslip::sliding
