#pragma once

#include "scene/joint_laws.hpp"

#include <optional>
#include <string>

namespace damslip {

/// Unit vector along a bar, from the joint's lower side to its upper one.
struct BarDirection {
    double normal = 0.0; ///< part across the joint, positive where it opens [-]
    double along = 0.0;  ///< part along the joint, positive downstream [-]
};

/// A row of anchors as a straight bar across a joint: elastic, then perfectly plastic, until it snaps. Rigid block and finite
/// elements share it; per metre of dam length. With opening g and slip s since it was put in
///
///     l = √((L cos ψ + g)² + (L sin ψ + s)²),   strain = P₀/(E A) + (l - L)/L
///     N = E A (strain - plastic strain), at most f_y A, at least 0
///
/// and on what is above the joint the force -N d, d the unit vector along the bar. From the rupture strain on N = 0 for good.
///
/// A grouted bar also resists across its axis, F <= A f_y/√3 (the shear strength of steel by von Mises) with
/// (N/N_y)² + (F/F_y)² <= 1. Of F counts what it adds against slip: its part along the joint, less the friction that its part
/// across the joint takes away, F (cos ψ - μ |sin ψ|), at least 0, both ways.
struct AnchorBar {
    std::string name;
    double length = 0.0;                  ///< L [m]
    double sine = 0.0, cosine = 1.0;      ///< of ψ [-]
    double axial_stiffness = 0.0;         ///< E A [N/m]
    double yield_force = 0.0;             ///< f_y A [N/m]
    double prestress = 0.0;               ///< P₀ [N/m]
    std::optional<double> rupture_strain; ///< [-]; none: it does not snap
    double dowel = 0.0;                   ///< largest dowel resistance along the joint [N/m]; 0: none

    double stiffness() const { return axial_stiffness / length; } ///< E A/L, of its stretch [N/m²]
    double yield_strain() const { return yield_force / axial_stiffness; }
    double stretch(double gap, double slip) const; ///< l - L [m]
    double strain(double stretch) const { return prestress / axial_stiffness + stretch / length; }
    BarDirection direction(double gap, double slip) const;
    /// Stretch from no force to the yield force, and to rupture, of a bar that holds its prestress [m].
    double stretch_to_yield() const { return (yield_force - prestress) / stiffness(); }
    /// Slip that brings it from its prestress to yield, joint shut, downstream or upstream, whichever comes first [m].
    double slip_to_yield() const;
};

/// @param friction  of the joint, peak: for what the dowel adds
AnchorBar anchor_bar(const Anchor& anchor, double friction);

/// The dowel's interaction as a polygon inscribed in the circle (N/N_y)² + (F/F_y)² = 1, so that the resistance is linear in N
/// from corner to corner: at most 3e-4 of its radius inside.
struct DowelChord {
    double from = 0.0, to = 1.0;            ///< N/N_y of its corners
    double constant = 1.0, per_share = 0.0; ///< F/F_y = constant + per_share N/N_y
};
inline constexpr int dowel_chords = 32;
DowelChord dowel_chord(int number);
/// F/F_y of a bar with N/N_y = share [-].
double dowel_share(double share);

enum class AnchorState { elastic, yields, slack, snapped };

/// What a bar has come to. The one place where strains become forces.
struct AnchorHistory {
    AnchorState state = AnchorState::elastic;
    double force = 0.0;          ///< N now [N/m]
    double stretch = 0.0;        ///< now [m]
    double plastic_strain = 0.0; ///< [-]
    double largest_force = 0.0;
    double largest_stretch = 0.0;     ///< as long as it holds
    std::optional<double> snapped_at; ///< [s]
    double plastic_work = 0.0;        ///< by yielding and by the dowel [J/m]
    double loss = 0.0;                ///< stored when it snapped [J/m]

    /// E A (strain - plastic strain), whatever the state [N/m].
    double trial_force(const AnchorBar& bar, double at_stretch) const
    {
        return bar.axial_stiffness * (bar.strain(at_stretch) - plastic_strain);
    }
    /// State that the stretch asks for. A bar that has snapped stays so; rupture itself is the caller's event.
    AnchorState state_at(const AnchorBar& bar, double at_stretch) const;
    /// Goes to a stretch; plastic strain grows where it yields. @pre not beyond its rupture
    void stretch_to(const AnchorBar& bar, double to);
    void snap(const AnchorBar& bar, double time);
    double stored(const AnchorBar& bar) const { return 0.5 * force * force / bar.stiffness(); } ///< N²L/(2EA) [J/m]
};

/// As it is put in: with its prestress.
AnchorHistory anchor_at_lock_off(const AnchorBar& bar);

/// An anchor after a run.
struct AnchorOutcome {
    std::string name;
    AnchorHistory history;
    double yield_force = 0.0; ///< [N/m]
    double stored = 0.0;      ///< [J/m]
};

} // namespace damslip
