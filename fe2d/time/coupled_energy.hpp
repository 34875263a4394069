#pragma once

#include "fe2d/fluid/coupled_system.hpp"
#include "fe2d/time/energy.hpp"

namespace damslip::fe2d {

/// States of a CoupledSystem as the energy ledger wants them.
///
/// The water's equations stand in the symmetric system with the sign reversed, so zᵀMz is no energy. Multiplied by Δzᵀ S, S = 1 on the
/// structure, -1 on the mesh's pressures and 0 in the layers of an absorbing end, they add up:
///
///     ½ u̇ᵀM u̇ + ½ ψᵀL_b ψ (kinetic)  +  ½ uᵀK u + ½ pᵀQ_b p (strain)
///
/// with Q_b, L_b of the water in the mesh. What its boundaries take, Δψᵀ[(Q - Q_b) ψ̈ + A ψ̇ + (L - L_b) ψ] on the mesh's rows, is radiated:
/// into the bottom, a damper, the layers. The coupling -ΔuᵀH p + ΔψᵀHᵀu̇ vanishes in continuous time and for the trapezoid; what another
/// scheme leaves of it is numerical dissipation.
class CoupledEnergy {
public:
    /// The matrices are those the coupled system was made of.
    CoupledEnergy(const CoupledSystem& system, const FluidModel& water, const SparseMatrix& structure_damping);

    State view(const State& state) const;
    InterfaceWork work(const State& before, const State& after) const; ///< of states, not of views

private:
    Eigen::Index structure_, mesh_;
    SparseMatrix mass_, stiffness_, damping_; ///< of the energies; damping of the structure, larger matrices' size
    SparseMatrix coupling_;                   ///< of M z̈ + G ż + K z: the sH of G
    SparseMatrix taken_mass_, taken_damping_,
        taken_stiffness_; ///< rows of the mesh's pressures of what the boundaries take
};

} // namespace damslip::fe2d
