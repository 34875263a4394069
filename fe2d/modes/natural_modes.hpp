#pragma once

#include "fe2d/model/model.hpp"
#include "fe2d/solver/linear_solver.hpp"

#include <Eigen/Core>
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

/// How the peaks of modes, which do not come at the same instant, make one peak.
enum class ModalRule {
    srss, ///< root of the sum of squares: modes far from each other
    cqc   ///< complete quadratic combination
};

/// Correlation of two modes with the same damping under a broad-banded ground motion [-]; Der Kiureghian (1981), eq. (24)
/// with one damping ratio, r the ratio of the frequencies:
///
///     rho = 8 zeta^2 (1 + r) r^(3/2) / [(1 - r^2)^2 + 4 zeta^2 r (1 + r)^2]
///
/// Equal frequencies: 1. Frequencies far from each other, or no damping: 0.
/// @param f_i, f_j  > 0, in the same unit @param ratio  zeta [-], >= 0
double modal_correlation(double f_i, double f_j, double ratio);

/// Correlations of all modes; for ModalRule::srss the identity.
Eigen::MatrixXd modal_correlations(const Eigen::VectorXd& frequency, double ratio, ModalRule rule);

/// sum_i sum_j rho_ij a_i b_j: the square of a combined peak for a = b; divided by the peak of b, the value of a most
/// likely at the instant of that peak.
double combined_product(const Eigen::VectorXd& a, const Eigen::VectorXd& b, const Eigen::MatrixXd& correlation);

/// Peak of a quantity from those of the modes, >= 0, in its unit.
double combined_peak(const Eigen::VectorXd& modal, const Eigen::MatrixXd& correlation);

} // namespace damslip::fe2d
