#pragma once

#include "fe2d/contact/contact_problem.hpp"

namespace damslip::fe2d {

/// Linear complementarity problem w = M z + q, w >= 0, z >= 0, w^T z = 0.
struct LcpResult {
    bool solved = false; ///< false: ended on a ray or at the pivot limit
    int pivots = 0;
    Eigen::VectorXd z;
};

/// Lemke's method (Cottle, Pang & Stone 1992, section 4.4) on a dense tableau, covering vector of ones. O(n²) a pivot.
LcpResult lemke(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& q, int pivot_limit);

/// The contact problem as a complementarity problem of 4m unknowns with the Delassus operator W = V⁻¹, g* = -W λ⁰
/// (Stewart & Trinkle 1996; Anitescu & Potra 1997, in increments of slip):
///
///     0 <= λ_n ⟂ g_N >= 0,   0 <= λ⁺ ⟂ σ + s >= 0,   0 <= λ⁻ ⟂ σ - s >= 0,   0 <= σ ⟂ c + mu λ_n - λ⁺ - λ⁻ >= 0
///
/// with λ_t = λ⁺ - λ⁻. Its matrix is copositive, so Lemke's method ends with a solution, and one exists. It shares
/// nothing with the Newton iteration but V and λ⁰: a last resort, and a check. Separation allowed and V regular only.
/// @returns false when V is singular or round-off ends the method early; `solution` is untouched then.
bool solve_by_lemke(const ContactProblem& problem, ContactSolution& solution, int& pivots);

} // namespace damslip::fe2d
