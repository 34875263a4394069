#pragma once

#include "fe2d/time/linear_integrator.hpp"

namespace damslip::fe2d {

/// Work of the interface forces over one step, by the caller who knows their directions [J/m]. They must sum up to
/// ½ (λ₀ + λ₁)ᵀ B Δu = normal - friction - radiated - numerical, else the ledger does not close.
struct InterfaceWork {
    double friction = 0.0;  ///< dissipated by sliding, positive
    double normal = 0.0;    ///< done by contact pressure on opening and closing, positive when it drives the structure
    double radiated = 0.0;  ///< carried away through absorbing boundaries, positive
    double dashpots = 0.0;  ///< what part of the work of C v is: it counts as radiated, not as damping
    double numerical = 0.0; ///< lost by the scheme in the coupling of dam and water (CoupledEnergy), positive
    double floor = 0.0;     ///< done by water on the rock below it: Energy::floor
};

/// Energies per metre of dam length [J/m], of the motion relative to the ground. Kinetic and strain are of the state,
/// the rest is summed over the steps from the start.
struct Energy {
    double kinetic = 0.0;        ///< ½ vᵀ M v
    double strain = 0.0;         ///< ½ uᵀ K u, and what soft normal contact stores
    double damping = 0.0;        ///< C v, dissipated
    double numerical = 0.0;      ///< dissipated by the scheme (gained, when negative); computed from the states
    double friction = 0.0;       ///< dissipated
    double radiated = 0.0;       ///< left the model
    double external = 0.0;       ///< done by R: static loads and ground motion
    double contact_normal = 0.0; ///< done by contact pressures beyond what soft contact stores or gives back

    // Of the joints' laws beside contact and friction; zero without them.
    double joint_stored = 0.0;   ///< in bonds and anchors
    double bond_fracture = 0.0;  ///< spent on breaking bonds
    double anchor_plastic = 0.0; ///< spent on yielding anchors
    double anchor_loss = 0.0;    ///< stored in anchors that snapped
    double joint_water = 0.0;    ///< done by water that follows the opening, beyond its pressure before
    double impact = 0.0;         ///< lost in landings

    /// Done by the water's pressure on the rock below it (reservoir.floor = "rock"): what the floor takes from the water's
    /// waves and gives to the rock. It passes within the model and is no part of the balance.
    double floor = 0.0;

    /// Δ(kinetic + strain) + damping + numerical + friction + radiated - external - contact_normal since the start
    /// [J/m].
    double imbalance(const Energy& start) const;
    /// Largest of the terms so far, the scale of the imbalance [J/m].
    double scale() const;
};

/// Energy balance of a run, kept step by step. Every term is computed from the states before and after, none as the
/// remainder, so the balance closes only if the steps satisfy the equations of motion and the scheme's assumptions.
///
/// Sum the equation of motion of two successive steps, M a₁ = -(1+α)F₁ + αF₀ and M a₀ = -(1+α)F₀ + αF₋₁, with
/// F = C v + K u - R - Bᵀλ, half each, and multiply by Δuᵀ. With means (·)_m of the step and Newmark's assumptions in
/// the form Δv = Δt a_m + (γ-½)Δt Δa and Δu = Δt v_m + (β-γ/2)Δt² Δa the left side is Δuᵀ M a_m = Δ(½vᵀMv) plus terms
/// in Δa, so that
///
///     Δ(½vᵀMv + ½uᵀKu) + ΔuᵀC v_m + D = ΔuᵀR_m + Δuᵀ(Bᵀλ)_m
///     D = -(γ-½) ΔuᵀMΔa + (γ-½)(β-γ/2)Δt² ΔaᵀMΔa + (β-γ/2)Δt² Δ(½aᵀMa) + (α/2) Δuᵀ(F₁ - F₋₁)
///
/// D = 0 for average acceleration; β < γ/2 stores (β-γ/2)Δt² ½aᵀMa and gives it back; α < 0 dissipates.
/// F₋₁ of the first step is F₀, which is right for a start in equilibrium.
class EnergyLedger {
public:
    explicit EnergyLedger(const State& start);

    /// Adds the step from `before` to `after`. The scheme and step are those the step was made with.
    /// @param base  energies of the body that the interface forces come from (MovingBase): their work is in it then, and
    ///              `work` has none
    void add_step(const State& before, const State& after, const StepConstants& constants,
                  const InterfaceWork& work = {}, const Energy& base = {});

    const Energy& energy() const { return energy_; }
    double imbalance() const { return energy_.imbalance(start_); } ///< [J/m]
    double largest_scale() const { return scale_; }                ///< largest term of any step so far [J/m]

private:
    Energy start_, energy_, base_;
    double scale_ = 0.0;
};

} // namespace damslip::fe2d
