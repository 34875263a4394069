#pragma once

#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/fluid/coupled_system.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/solver/dense_product.hpp"
#include "fe2d/time/condensation.hpp"
#include "fe2d/time/energy.hpp"
#include "fe2d/time/linear_integrator.hpp"
#include "records/record.hpp"

#include <memory>
#include <optional>
#include <span>

namespace damslip::fe2d {

enum class RockTreatment {
    condensed, ///< massless rock reduced exactly to its nodes on the base; rock with mass stays whole
    whole      ///< all unknowns kept: for comparison
};

/// The linear system of a model whose dam is tied to its base, and the way back to the model's unknowns. Kept are the dam's
/// unknowns, base included; the rock's follow them without a law of their own where it is massless (CondensedBody).
struct StructureSystem {
    LinearSystem system;
    SparseMatrix damped_mass;             ///< mass a_M acts on: the dam's, without added mass and rock [kg/m]
    std::optional<CondensedBody> rock;    ///< of base and rock unknowns, kept: those of the base
    std::vector<Eigen::Index> base;       ///< unknowns of the base in the system
    Eigen::Index full_size = 0;           ///< unknowns of the model
    std::vector<Eigen::Index> rock_place; ///< model unknown of each unknown of `rock`
    SolverReport solver;                  ///< of the condensation; ok where there was none

    Eigen::VectorXd
    reduce_load(const Eigen::VectorXd& load) const; ///< constant loads of the model on the system's unknowns
    /// Displacements of all model unknowns; `load` is the constant load they started from, on the model's unknowns.
    Eigen::VectorXd expand(const Eigen::VectorXd& displacement, const Eigen::VectorXd& load) const;
};

/// Assembles M, C = a_M M_s + b_K K and K. On a tied base nothing slips, so damping of the deformation only and of the relative
/// velocity are the same.
StructureSystem structure_system(const Model& model, const RayleighConstants& damping,
                                 RockTreatment rock = RockTreatment::condensed);

/// The same of the dam alone with a free base: what lies below it is a body of its own (MovingBase). Its unknowns are
/// those of a model with massless rock whose rock is condensed.
LinearSystem dam_on_free_base(const Model& model, const RayleighConstants& damping);

/// Unknowns of the base, (x, y) by node, heel to toe.
/// @pre a tied base on rock
std::vector<Eigen::Index> unknowns_of_base(const Model& model);

/// Damping of a scene: modes of the model for the frequencies, the horizontal motion for modified Rayleigh.
DampingChoice damping_of(const Scene& scene, const Model& model, const GroundMotion& motion);

/// Frequencies [rad/s] and horizontal effective masses.
std::vector<ModalMass> modal_masses(const NaturalModes& modes);

/// Undamped dam on its tied base and water for real modes: the far end closed, the bottom rigid and still, the surface p = 0 (sloshing modes
/// lie far below the dam's). The modes of water that radiates are complex; real modes ignore that.
CoupledPencil coupled_pencil(const Model& model, const FluidModel& water);

/// Frequencies [rad/s] and horizontal effective masses of the `count` leading modes (leading_modes), lowest first.
std::vector<ModalMass> leading_modal_masses(const CoupledModes& modes, int count);

/// Damping of a scene with acoustic water. "Mode n" of damping.rayleigh_modes is the n-th of the leading modes: modes of the water alone
/// would shift the count with the length of the reservoir.
DampingChoice damping_of(const Scene& scene, const Model& model, const FluidModel& water, const GroundMotion& motion);
/// @param modes  with as many leading ones as the damping needs
DampingChoice damping_of(const Scene& scene, const CoupledModes& modes, const GroundMotion& motion);

/// A floor of acoustic water that belongs to the moving base (MovingBase::floor()).
struct WaterFloor {
    std::vector<Eigen::Index> unknowns; ///< φ of its nodes in the system of dam and water, far end to heel; empty: none
    double scale = 0.0;                 ///< s, p = s φ̇ (CoupledSystem)
};

/// A dam tied to a moving base. Both make equal steps of the base's unknowns: with λ of the base on the dam beyond what it is at
/// rest, p = -λ, and B Δu* , Δr* the steps without λ₁ of either body,
///
///     B Δu* + W_d λ₁ = Δr* - W_r [(1 + α) λ₁ - α λ₀]
///     [W_d + (1 + α) W_r] λ₁ = Δr* + α W_r λ₀ - B Δu*,        W_d = (1 + α) B A⁻¹ Bᵀ
///
/// W_d is positive definite, W_r is not negative: one Cholesky factor per step size.
///
/// Where the water's floor is the base's, its rates v̇ are forces on the water as λ are on the dam, B' = [B; E] with E = s on φ, and its
/// pressures p = E ż are forces on the base: with x = (λ₁, v̇₁), W' = (1 + α) B' A⁻¹ B'ᵀ and Newmark's a1, a4, a5
///
///     B Δu = B Δu* + W'_b x,   p̃ = (α λ₀ - (1 + α) λ₁,  (1 + α) p₁ - α p₀),   p₁ = a1 E Δu - a4 p₀ - a5 ṗ₀,   E Δu = E Δu* + W'_f x
///     Δr = Δr* + W_r p̃,   B Δu = Δr_b,   v̇₁ = a1 Δr_f - a4 v̇₀ - a5 v̈₀
///
/// solved by one small LU factor.
class BaseCoupling {
public:
    /// @param dam  step of the dam with a free base, and of what goes along with it (water); ok(). Kept by reference
    /// @param unknowns  of the base in that system, in the order of `base`
    /// @param size  of that system
    BaseCoupling(std::unique_ptr<MovingBase> base, const StepOperator& dam, std::span<const Eigen::Index> unknowns,
                 Eigen::Index size, WaterFloor floor = {});

    bool ok() const { return !floor_.unknowns.empty() || factor_.info() == Eigen::Success; }
    /// Makes the step of the base, whose forces take the dam along.
    InterfaceForces step(const FreeStep& free, const State& before);
    /// ½ α (λ₁ - λ₋₁)ᵀ Δu of the last step [J/m]: a part of the work between the bodies that EnergyLedger has among the
    /// dam's numerical dissipation with the opposite sign.
    double numerical_work() const { return numerical_work_; }
    double floor_work() const { return floor_work_; } ///< of the water on the floor, last step [J/m]
    const MovingBase& base() const { return *base_; }

private:
    InterfaceForces step_with_floor(const FreeStep& free, const State& before);

    std::unique_ptr<MovingBase> base_;
    WaterFloor floor_;
    StepConstants constants_;
    SparseMatrix map_; ///< B
    double alpha_;
    InterfaceFlexibility dam_;
    Eigen::LLT<Eigen::MatrixXd> factor_;
    Eigen::MatrixXd to_weighted_; ///< p̃ by x, with a floor
    Eigen::PartialPivLU<Eigen::MatrixXd> with_floor_;
    Eigen::VectorXd pressure_, pressure_before_; ///< p₀, p₋₁ [Pa]
    Eigen::VectorXd force_, force_before_;       ///< λ₀, λ₋₁ of the step to come [N/m]
    double numerical_work_ = 0.0, floor_work_ = 0.0;
};

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
