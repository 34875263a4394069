#pragma once

#include "fe2d/damping/low_rank.hpp"

#include <Eigen/SparseCore>

namespace damslip::fe2d {

/// Mass-proportional damping that resists the deformation of the dam but not its sliding:
///
///     C_M = a_M (I - r wᵀ)ᵀ M (I - r wᵀ) = a_M M + U S Uᵀ,   U = [w, M r],   S = a_M [rᵀM r, -1; -1, 0]
///
/// r is the horizontal rigid translation of the dam, wᵀu̇ its mean slip rate over the rock (weights: dam base minus
/// rock, each side by contact area). C_M is positive semi-definite. Under uniform slip, u̇ = s r with wᵀr = 1, the force
/// is exactly zero; on a tied base wᵀu̇ = 0 and C_M acts as a_M M, so the damping of the tied modes does not change.
/// Against Hall (2006), who shows what mass-proportional damping does to a sliding dam. Rigid motion of the dam
/// together with the rock stays damped.
///
/// @returns U S Uᵀ; a_M M belongs to the sparse part of C.
/// @param mass  the mass that is damped (the dam's own), n x n
/// @param rigid_translation  r, n: 1 on horizontal unknowns of the dam, 0 elsewhere
/// @param slip_weights  w, n, with wᵀr = 1
LowRank deformation_only_correction(double mass_coefficient, const Eigen::SparseMatrix<double>& mass,
                                    const Eigen::VectorXd& rigid_translation, const Eigen::VectorXd& slip_weights);

} // namespace damslip::fe2d
