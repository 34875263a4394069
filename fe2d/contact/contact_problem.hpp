#pragma once

#include "scene/scene.hpp"

#include <Eigen/Core>
#include <vector>

/// Contact with Coulomb friction between m pairs of nodes as a small dense problem: everything linear (structure, rock,
/// inertia, damping) has been eliminated. Vectors of length 2m: the m normal components first, then the m tangential
/// ones.
namespace damslip::fe2d {

/// State of one pair of nodes of a contact plane. g_N: opening, s: slip in the step, positive downstream; λ_n: contact
/// force pressing the two sides apart (effective compression), λ_t: shear force on the upper side, positive downstream.
enum class ContactState : unsigned char {
    stick,           ///< g_N = 0, s = 0, |λ_t| <= c + mu λ_n
    slip_downstream, ///< g_N = 0, s > 0, λ_t = -(c + mu λ_n)
    slip_upstream,   ///< g_N = 0, s < 0, λ_t = +(c + mu λ_n)
    open,            ///< g_N > 0, λ_n = 0, λ_t = 0; water pressure, a load, stays
    pulled           ///< without separation only: g_N = 0, λ_n < 0, λ_t = 0
};

using ContactStates = std::vector<ContactState>; ///< one per pair

inline bool is_slip(ContactState state)
{
    return state == ContactState::slip_downstream || state == ContactState::slip_upstream;
}

/// Strength of the pairs, and whether the joint opens: g_N >= 0, λ_n >= 0. With JointOpening::none g_N = 0, λ_n of any sign,
/// and pairs in tension carry no shear: a modelling shortcut that lowers the slip, because the compressed pairs then carry
/// more than the resultant.
struct ContactLaw {
    Eigen::VectorXd friction; ///< Coulomb mu of each pair [-], >= 0
    Eigen::VectorXd cohesion; ///< c times the pair's area [N/m], >= 0
    JointOpening separation = JointOpening::allowed;

    Eigen::Index pairs() const { return friction.size(); }
    /// c + mu λ_n, of a pair in compression [N/m].
    double strength(Eigen::Index pair, double normal_force) const
    {
        return cohesion[pair] + friction[pair] * (normal_force > 0.0 ? normal_force : 0.0);
    }
};

/// The law of m equal pairs.
ContactLaw uniform_law(Eigen::Index pairs, double friction, double cohesion_force = 0.0);

/// Contact forces follow the displacements across the plane:
///
///     λ = λ⁰ + V x,   x = (opening g_N, slip s of this step)
///
/// V is the stiffness of the structure seen from the plane, symmetric, positive semi-definite [N/m²]; λ⁰ are the forces
/// that would hold all pairs shut and stuck. The Delassus form g = g* + W λ is the same with V = W⁻¹, λ⁰ = -V g*. This
/// form also exists for a dam that nothing but contact holds (statics): V is then singular, W does not exist.
struct ContactProblem {
    const Eigen::MatrixXd& stiffness;   ///< V
    const Eigen::VectorXd& stuck_force; ///< λ⁰ [N/m]
    const ContactLaw& law;
};

/// A solution, or the state of an iteration.
struct ContactSolution {
    ContactStates states;         ///< m; on entry to a solver: where to start
    Eigen::VectorXd displacement; ///< x [m]
    Eigen::VectorXd force;        ///< λ [N/m]
};

/// How far a pair is from its state's inequalities, as a force [N/m]; displacements count with the pair's own stiffness
/// V_ii. Zero when they hold.
double violation(const ContactProblem& problem, const ContactSolution& solution, Eigen::Index pair);

/// Largest violation of the contact conditions, whatever the states say (they are re-derived from force and
/// displacement): the natural residual of g_N >= 0 ⟂ λ_n >= 0 and of Coulomb's law [N/m].
double complementarity_residual(const ContactProblem& problem, const ContactSolution& solution);

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

/// Sweeps over the pairs, each solved exactly for its own opening and slip with the others held: always moves towards
/// a solution, slowly. Gives the Newton iteration a new start where it cycles. Ends early when a sweep changes no state
/// and no force by more than `tolerance` [N/m].
/// @returns sweeps made
int gauss_seidel(const ContactProblem& problem, ContactSolution& solution, int sweeps, double tolerance);

} // namespace damslip::fe2d
