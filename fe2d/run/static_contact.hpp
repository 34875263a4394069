#pragma once

#include "fe2d/contact/joint_solver.hpp"
#include "fe2d/run/contact_structure.hpp"

namespace damslip::fe2d {

/// Everything of one instant that the contact remembers or shows; plane vectors (normal, then tangential).
struct ContactMemory {
    Eigen::VectorXd force;   ///< λ [N/m]: effective compression; shear on the dam, positive downstream
    Eigen::VectorXd opening; ///< g_N [m], m values
    Eigen::VectorXd
        slip; ///< accumulated, positive downstream, without the elastic give of a penalty [m], m values; kept exactly while a pair sticks
    Eigen::VectorXd elastic; ///< elastic part of the tangential gaps, on top of `slip`; zero where sticking is rigid
                             ///< [m], m values
    ContactStates states;

    explicit ContactMemory(Eigen::Index pairs = 0)
        : force(Eigen::VectorXd::Zero(2 * pairs)), opening(Eigen::VectorXd::Zero(pairs)),
          slip(Eigen::VectorXd::Zero(pairs)), elastic(Eigen::VectorXd::Zero(pairs)),
          states(static_cast<std::size_t>(pairs), ContactState::stick)
    {
    }
};

/// Displacements at rest.
struct StaticState {
    Eigen::VectorXd dam;  ///< of the dam, in its node order [m]
    Eigen::VectorXd rock; ///< of the rock's contact nodes, plane [m]
};

/// Static equilibrium of dam, contact and rock. Nothing but contact holds the dam, so its stiffness is singular; but
/// with all pairs tied dam and rock together are not. From there (S: the dam's Schur complement, T = S + K_c, g: gaps)
///
///     λ = f_r - K_c T⁻¹ (f_d + f_r) + V g,   V = K_c - K_c T⁻¹ K_c   (rigid base: λ = -f_d + S g)
///
/// V is singular exactly for the motions of the dam as a whole. Where the dam has slid far, u_dam = P u_rock + g
/// (Pairing), T = PᵀS P + K_c and V = S - S P T⁻¹ PᵀS.
class StaticContact {
public:
    /// @param slip  how far the dam has slid, of a structure that slides far [m]
    explicit StaticContact(const ContactStructure& structure, const ContactOptions& options = {}, double slip = 0.0);

    /// From the memory of the last stage to equilibrium under the whole load: friction is followed in one step.
    ContactReport solve(const SplitLoad& load, const ContactLaw& law, ContactMemory& memory);

    /// Displacements that belong to a load and a memory in equilibrium.
    StaticState displacements(const SplitLoad& load, const ContactMemory& memory) const;

private:
    Eigen::VectorXd condensed(const SplitLoad& load) const;
    Eigen::VectorXd tied(const Eigen::VectorXd& on_base, const SplitLoad& load) const; ///< rock, all pairs shut

    const ContactStructure& structure_;
    Pairing::Matrix trace_;            ///< P; empty: the identity
    Eigen::MatrixXd dam_stiffness_;    ///< S on the plane, where P is not the identity
    Eigen::MatrixXd tied_flexibility_; ///< T⁻¹; empty: rigid base
    std::unique_ptr<JointSolver> solver_;
};

} // namespace damslip::fe2d
