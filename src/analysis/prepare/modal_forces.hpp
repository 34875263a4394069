#pragma once

#include "fe2d/fluid/coupled_modes.hpp"
#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/modes/natural_modes.hpp"

#include <Eigen/Core>
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

} // namespace damslip
