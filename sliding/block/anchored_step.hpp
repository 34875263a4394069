#pragma once

#include "scene/anchor_bar.hpp"
#include "sliding/block/sloped_slip.hpp"

#include <array>
#include <span>
#include <vector>

namespace damslip::sliding {

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
