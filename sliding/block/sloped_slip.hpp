#pragma once

#include "sliding/block/line.hpp"

#include <array>

namespace damslip::sliding {

/// Slip of a block whose friction changes linearly with the path w slipped, seen in the direction of the slip:
///
///     (mass_tt + mu mass_tn) w'' = drive - cohesion - mu normal,     mu = friction + slope (w - w_now),
///
/// drive and normal linear over the rest of the interval.
struct SlopedSlip {
    double mass_tt = 0.0;
    double mass_tn = 0.0; ///< positive: slip acceleration in the direction of slip raises N'
    double cohesion = 0.0;
    double friction = 0.0;  ///< now
    double slope = 0.0;     ///< d mu / d w [1/m]
    double rate = 0.0;      ///< w' now [m/s], >= 0
    Line drive;             ///< in the direction of slip [N/m]
    Line normal;            ///< N' without slip acceleration [N/m]
    double span = 0.0;      ///< rest of the interval [s]
    bool from_rest = false; ///< just located start: w'' >= 0 now, round-off apart
};

/// One step of at most the span: w - w_now, w' and w'' at any time inside it.
class SlopedStep {
public:
    explicit SlopedStep(const SlopedSlip& slip);

    double length() const { return length_; } ///< [s]; shorter than the span when the friction changes fast
    bool closed_form() const { return closed_form_; }
    double path(double h) const;
    double rate(double h) const;
    double accel(double h) const;
    double time_of_stop() const; ///< first zero of the rate in (0, length]; `never`
    double
    time_of_path(double target,
                 double until) const; ///< when w - w_now = target, before `until` where it is known to be reached

private:
    void set_closed_form(const SlopedSlip& slip);
    void set_series(const SlopedSlip& slip);

    static constexpr int order = 26;
    bool closed_form_ = false;
    double length_ = 0.0;
    double rate_ = 0.0, accel_ = 0.0, drift_ = 0.0,
           kappa_ = 0.0;                // closed form: w'' = accel + drift h + kappa (w - w_now)
    std::array<double, order + 1> w_{}; // series: w - w_now = sum of w_[i] h^i
};

} // namespace damslip::sliding
