#pragma once

#include "scene/anchor_bar.hpp"
#include "scene/joint_laws.hpp"
#include "sliding/block/roots.hpp"

#include <array>
#include <span>
#include <vector>

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

/// An anchor below a sliding block: the bar and its state. The joint is shut: its stretch depends on the slip alone, so while
/// the block slides one way every change of its state lies at a slip known beforehand.
struct BlockAnchor {
    AnchorBar bar;
    AnchorHistory history;
    int chord = 0; ///< of the dowel's interaction

    explicit BlockAnchor(const AnchorBar& of) : bar(of), history(anchor_at_lock_off(of)) {}

    /// Takes the state that a slide in the direction d (+1 downstream, -1 upstream) from the slip s on begins with.
    void face(double d, double s);
    /// How far along d from s the state changes next [m]; `never`. @pre face(d, s)
    double next_change(double d, double s);
    /// What next_change() was of happens, at the slip s.
    void change(double s, double time);
    /// Goes to a slip without any change of its state in between.
    void go_to(double s);

    double tangential(double s) const; ///< N sin ψ', resists downstream slip [N/m]
    double normal(double s) const;     ///< N cos ψ', presses on the base [N/m]
    double dowel() const;              ///< resistance along the base [N/m]

private:
    enum class Change { none, yields, slack, tight, snaps, chord, turn };
    Change next_ = Change::none;
};

/// Slip of a block on anchors, in the direction of the slip (SlopedSlip's terms), with N_k, ψ'_k and the dowels D_k following
/// s = s_now + d w:
///
///     (mass_tt + mu mass_tn) w'' = drive - d Σ N_k sin ψ'_k - cohesion - Σ D_k - mu (normal + Σ N_k cos ψ'_k)
///
/// without resistance and with mu = 0 in mass and force where the base is open.
struct AnchoredSlip {
    SlopedSlip slip;        ///< drive and normal with the anchors' forces before any slip in them
    double direction = 1.0; ///< d
    double slip_now = 0.0;  ///< s [m]
    bool touching = true;   ///< the base is shut
    double initial_tangential = 0.0, initial_normal = 0.0; ///< the anchors' forces that drive and normal hold [N/m]
};

/// One step of at most the span as a Taylor series of w, to round-off: SlopedStep's way, with the bars' lengths as series too.
class AnchoredStep {
public:
    AnchoredStep(const AnchoredSlip& slip, std::span<const BlockAnchor> anchors);

    double length() const { return length_; } ///< [s]
    double path(double h) const;
    double rate(double h) const;
    double accel(double h) const;
    double time_of_stop() const;
    double time_of_path(double target, double until) const;
    double time_of_contact_change() const; ///< N' of the block that slides freely changes its sign; `never`
    /// Work of anchor k's dowel up to h [J/m].
    double dowel_work(std::size_t k, double h) const;

private:
    static constexpr int order = 26;
    using Series = std::array<double, order + 1>;

    double length_ = 0.0;
    bool touching_ = true;
    Series w_{};                 ///< path
    Series free_normal_{};       ///< N' of the block without resistance
    std::vector<Series> dowels_; ///< D_k
};

} // namespace damslip::sliding
