#pragma once

#include "fe2d/damping/damping.hpp"
#include "fe2d/fluid/coupled_modes.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/modes/natural_modes.hpp"
#include "fe2d/time/condensation.hpp"
#include "records/record.hpp"

#include <optional>

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

} // namespace damslip::fe2d
