#pragma once

#include "fe2d/model/model.hpp"
#include "fe2d/solver/linear_solver.hpp"

#include <string>

namespace damslip::fe2d {

enum class ModesStatus {
    ok,
    solver_failed, ///< the stiffness could not be factorised; `solver` says why
    not_converged, ///< fewer modes than asked for have converged; those that have are given
    no_mass        ///< nothing has mass
};

/// Undamped natural modes K phi = omega^2 M phi, lowest first, mass-normalised (phi^T M phi = 1), largest entry
/// positive. Unknowns without mass (massless rock) take part statically; they add no modes.
struct NaturalModes {
    ModesStatus status = ModesStatus::ok;
    SolverReport solver;
    Eigen::VectorXd frequency;        ///< f [Hz]
    Eigen::MatrixXd shape;            ///< one column per mode, length dofs.count [kg^-1/2 m^1/2]
    Eigen::Matrix2Xd participation;   ///< Gamma = phi^T M r for a translation r in x (row 0) and y (row 1)
    Eigen::Matrix2Xd effective_mass;  ///< Gamma^2 [kg/m]
    Eigen::Matrix2Xd effective_share; ///< effective mass over the total mass in that direction, added mass included [-]
    int operator_applications = 0;    ///< solves of the iteration
};

/// @param count  modes wanted, >= 1; fewer come back where there are fewer unknowns with mass
/// Lanczos with implicit restarts (Spectra) on L^T K^-1 L with M = L L^T, from a fixed start vector: same model, same
/// bits.
NaturalModes natural_modes(const Model& model, int count, const SolverOptions& options = {});

} // namespace damslip::fe2d
