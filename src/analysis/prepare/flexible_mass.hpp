#pragma once

#include "analysis/prepare/rigid_model.hpp"
#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/fluid/coupled_system.hpp"
#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/model/model.hpp"
#include "scene/scene.hpp"
#include "sliding/flexible/flexible_mode.hpp"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace damslip {

/// Which way the ground moves.
enum class ModalDirection { horizontal, vertical };

/// What a response spectrum needs of the modes: equivalent static forces on the unknowns of the model.
struct ModalForces {
    Eigen::VectorXd frequency;      ///< [Hz]
    Eigen::VectorXd effective_mass; ///< Gamma^2 [kg/m]
    Eigen::MatrixXd force; ///< by columns Gamma K phi / omega^2: force of a mode under S_a = 1 m/s^2 [N/m per m/s^2]
    Eigen::MatrixXd displacement; ///< Gamma phi / omega^2: the same for displacements [m per m/s^2]
    Eigen::VectorXd residual;     ///< force under 1 m/s^2 on all that the modes leave [N/m per m/s^2]
    double residual_mass =
        0.0; ///< its sum along the ground motion, fixed nodes included: total mass less the effective masses [kg/m]
    double total_mass = 0.0; ///< [kg/m]
};

/// Modes of a ground motion in one direction. The acoustic water's part of a force is the pressure of the mode on the face: with
/// K phi = omega^2 M phi + H p the elastic force holds both.
/// @param coupled, water  in place of `modes`; null: no acoustic water @throws NotConverged where there is no mode or no pressure
ModalForces modal_forces(const Scene& scene, const fe2d::Model& model, const fe2d::NaturalModes& modes,
                         const fe2d::CoupledModes* coupled, const fe2d::FluidModel* water, ModalDirection direction);

[[noreturn]] void refuse_modes(const Scene& scene, const std::string& what);

/// Where the unknowns of a model act.
struct Unknown {
    Point at;
    int component = -1; ///< 0: x, 1: y
};
std::vector<Unknown> unknowns_of(const fe2d::Model& model);

/// The sliding mass as one mode on its base.
/// Anchors, friction over the rate, rebounds, a sequence: the flexible block does not follow them. Beside [flexible_block] they are refused.
bool has_laws_of_rigid_blocks(const Scene& scene);

/// What the scene asks for beside the rigid block: [flexible_block], or regressions.period_s alone with all defaults; nothing for
/// a rigid mass, and where the scene has anchors, friction over the rate, rebounds or a sequence, which a flexible block does not follow.
/// Of a column without its strain. @pre period and mass ratio "modes" are found: resolve_flexible_modes
std::optional<sliding::FlexibleBlock> flexible_block(const Scene& scene);

/// The column of [flexible_block] under a motion: its period and damping, with reference_strain those of its strain. Nothing where the
/// block is no column.
std::optional<sliding::StrainCompatible> column_under(const Scene& scene, const sliding::FlexibleBlock& flexible,
                                                      const GroundMotion& motion);

/// Where the mass ratio comes from: "mass ratio 0.811: uniform shear column".
std::string mass_ratio_words(const Scene& scene);

/// Slip of the model that vibrates, with the scene's [sliding] options; with the checks that slide_model() makes of a rigid one.
/// @param method  decoupled or coupled, not both
sliding::FlexibleSlide slide_model(const Scene& scene, const sliding::FlexibleBlock& flexible, const RigidModel& model,
                                   const GroundMotion& motion, int polarity, FlexibleMethod method,
                                   sliding::HistoryOutput history = sliding::HistoryOutput::none);

/// flexible_block.period_s = "modes": period and mass ratio of the mode with the largest horizontal effective mass among the
/// first five of the tied finite-element model with added mass, put into the scene. @returns a sentence with the numbers;
/// empty where the scene does not ask for it
/// @throws NotConverged where the modes were not found
std::string resolve_flexible_modes(Scene& scene);

} // namespace damslip
