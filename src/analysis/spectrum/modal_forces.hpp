#pragma once

#include "analysis/modes/modes.hpp"

#include <Eigen/Core>

#include <functional>
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
/// @param modes  with shapes @throws NotConverged where modes or the static pressure were not found
ModalForces modal_forces(const ModesResult& modes, ModalDirection direction = ModalDirection::horizontal);

} // namespace damslip
