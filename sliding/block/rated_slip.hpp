#pragma once

#include "scene/joint_laws.hpp"
#include "sliding/block/line.hpp"

#include <array>

namespace damslip::sliding {

/// Friction over rate and path at one instant, rate >= 0:
///
///     mu(v, S) = mu_s(S) [k + (1 - k) exp(-v / v_c)],   k = mu_k / mu_s
///
/// (an exponential Stribeck curve without its viscous part; Armstrong-Hélouvry et al. 1994, eq. (4)).
/// @param rate  v [m/s] @returns mu/mu_s without any lag [-]
double steady_ratio(const RateFriction& law, double rate);

/// Does friction lag behind its steady value?
bool lags(const RateFriction& law);

/// Slip of a block whose friction depends on rate and path w slipped, seen in the direction of the slip:
///
///     (mass_tt + mu mass_tn) w'' = drive - cohesion - mu normal,   mu = mu_s(S) r
///     no lag:  r = r(w') = k + (1 - k) exp(-w'/v_c);   with it:  r' = (r(w') - r) (1/tau + w'/d)
///
/// with mu_s(S) = friction + slope (w - w_now), which never lags; drive and normal linear over the rest of the interval. The
/// block at rest is w' = 0 with `moves` false: then only r goes on.
struct RatedSlip {
    RateFriction law;
    double mass_tt = 0.0;
    double mass_tn = 0.0; ///< positive: slip acceleration in the direction of slip raises N'
    double cohesion = 0.0;
    double friction = 0.0; ///< mu_s now
    double slope = 0.0;    ///< d mu_s / d w [1/m]
    double ratio = 1.0;    ///< r now, where it lags [-]
    double rate = 0.0;     ///< w' now [m/s], >= 0
    Line drive;            ///< in the direction of slip [N/m]
    Line normal;           ///< N' without slip acceleration [N/m]
    double span = 0.0;     ///< rest of the interval [s]
    bool moves = true;
    bool from_rest = false; ///< just located start: w'' >= 0 now, round-off apart
};

/// One step of at most the span by Taylor series to round-off: its length is chosen so that the last terms are below it.
///
/// A time-stepping scheme with the rate of the end of the step has one answer only for Δt < v_c/(g' Δμ), g' = N'/m. The
/// series solves the equation of motion itself, whose answer is unique as long as the block moves; that it starts from rest
/// where the drive passes mu_s N' + c A', and not before, is the law's.
class RatedStep {
public:
    explicit RatedStep(const RatedSlip& slip);

    double length() const { return length_; } ///< [s]
    double path(double h) const;              ///< w - w_now [m]
    double rate(double h) const;
    double accel(double h) const;
    double ratio(double h) const; ///< r
    double time_of_stop() const;  ///< first zero of the rate in (0, length]; `never`
    double time_of_path(double target, double until) const;
    /// Of a block at rest: first time in [0, length] at which `drive` sign passes the resistance; `never`.
    /// @param sign  1: along `drive`, -1: against it
    double time_of_start(double sign) const;

private:
    static constexpr int order = 26;
    using Series = std::array<double, order + 1>;
    void expand(const RatedSlip& slip);

    RatedSlip slip_;
    double length_ = 0.0;
    Series w_{}, ratio_{}, resistance_{}; // sums of coefficient h^i
};

} // namespace damslip::sliding
