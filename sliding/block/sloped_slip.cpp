#include "sliding/block/sloped_slip.hpp"

#include "sliding/block/roots.hpp"
#include "sliding/block/series.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace damslip::sliding {
namespace {

/// Sum over j of z^j/(2j+k)! : k = 0 is cosh(sqrt z) or cos(sqrt -z), k = 1 is sinh(sqrt z)/sqrt z or sin(sqrt -z)/sqrt
/// -z, and so on. For |z| <= 1 the sum has no cancellation to speak of, and unlike the sines it does not lose digits
/// for z -> 0.
double sine_sum(int k, double z)
{
    double term = 1.0;
    for (int i = 2; i <= k; ++i) term /= i;
    double sum = term;
    for (int i = k + 1; std::abs(term) > 1e-18 * std::abs(sum); i += 2) {
        term *= z / (static_cast<double>(i) * (i + 1));
        sum += term;
    }
    return sum;
}

} // namespace

SlopedStep::SlopedStep(const SlopedSlip& slip)
{
    closed_form_ = slip.mass_tn == 0.0 && slip.normal.now == slip.normal.end;
    if (closed_form_)
        set_closed_form(slip);
    else
        set_series(slip);
}

void SlopedStep::set_closed_form(const SlopedSlip& slip)
{
    rate_ = slip.rate;
    accel_ = (slip.drive.now - slip.cohesion - slip.friction * slip.normal.now) / slip.mass_tt;
    if (slip.from_rest) accel_ = std::max(accel_, 0.0);
    drift_ = (slip.drive.end - slip.drive.now) / slip.span / slip.mass_tt;
    kappa_ = -slip.slope * slip.normal.now / slip.mass_tt;
    length_ = slip.span;
    if (std::abs(kappa_) * length_ * length_ > 1.0) length_ = 1.0 / std::sqrt(std::abs(kappa_));
}

void SlopedStep::set_series(const SlopedSlip& slip)
{
    // w_0 = 0, w_1 = rate. With D = mass_tt + mass_tn mu and right side r = drive - cohesion - mu normal, D w'' = r
    // term by term: A_i = (r_i - sum_{j=1..i} D_j A_{i-j}) / D_0 and w_{i+2} = A_i / ((i+2)(i+1)).
    std::array<double, order + 1> mu{}, D{}, A{};
    const double drive_rate = (slip.drive.end - slip.drive.now) / slip.span;
    const double normal_rate = (slip.normal.end - slip.normal.now) / slip.span;
    w_[1] = slip.rate;
    for (int i = 0; i + 2 <= order; ++i) {
        mu[i] = i == 0 ? slip.friction : slip.slope * w_[i];
        D[i] = (i == 0 ? slip.mass_tt : 0.0) + slip.mass_tn * mu[i];
        double r = -mu[i] * slip.normal.now - (i > 0 ? mu[i - 1] * normal_rate : 0.0);
        if (i == 0) r += slip.drive.now - slip.cohesion;
        if (i == 1) r += drive_rate;
        for (int j = 1; j <= i; ++j) r -= D[j] * A[i - j];
        A[i] = r / D[0];
        if (i == 0 && slip.from_rest) A[0] = std::max(A[0], 0.0);
        w_[i + 2] = A[i] / (static_cast<double>(i + 2) * (i + 1));
    }
    length_ = length_to_round_off(std::span(A).first(order - 1), slip.span);
}

double SlopedStep::path(double h) const
{
    if (!closed_form_) return polynomial(w_, h);
    const double z = kappa_ * h * h;
    return h * (rate_ * sine_sum(1, z) + h * (accel_ * sine_sum(2, z) + h * drift_ * sine_sum(3, z)));
}

double SlopedStep::rate(double h) const
{
    if (!closed_form_) return polynomial(derivative(w_), h);
    const double z = kappa_ * h * h;
    return rate_ * sine_sum(0, z) + h * (accel_ * sine_sum(1, z) + h * drift_ * sine_sum(2, z));
}

double SlopedStep::accel(double h) const
{
    if (!closed_form_) return polynomial(derivative(derivative(w_)), h);
    const double z = kappa_ * h * h;
    return accel_ * sine_sum(0, z) + h * (drift_ + kappa_ * rate_) * sine_sum(1, z);
}

double SlopedStep::time_of_stop() const
{
    if (!closed_form_) {
        const std::vector<double> rate = derivative(w_);
        return first_fall_to_zero(rate, length_);
    }
    if (rate_ == 0.0 && (accel_ < 0.0 || (accel_ == 0.0 && drift_ <= 0.0))) return 0.0;
    // w'' is a combination of cosine and sine (or hyperbolic) over less than half a period: at most one sign change, so
    // the rate has one turn.
    double turn = length_;
    if ((accel(0.0) > 0.0) != (accel(length_) > 0.0))
        turn = bracketed_root([this](double h) { return accel(h); }, 0.0, length_);
    const auto rate_at = [this](double h) { return rate(h); };
    if (rate_ > 0.0 && rate(turn) <= 0.0) return bracketed_root(rate_at, 0.0, turn);
    if (rate(turn) > 0.0 && rate(length_) <= 0.0) return bracketed_root(rate_at, turn, length_);
    return never;
}

double SlopedStep::time_of_path(double target, double until) const
{
    return bracketed_root([&](double h) { return path(h) - target; }, 0.0, until);
}

} // namespace damslip::sliding
