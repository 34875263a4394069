#pragma once

#include "fe2d/contact/joint_laws.hpp"
#include "fe2d/contact/joint_solver.hpp"
#include "fe2d/run/contact_structure.hpp"

#include <memory>

namespace damslip::fe2d {

/// Everything of one instant that the contact remembers or shows; plane vectors (normal, then tangential).
struct ContactMemory {
    Eigen::VectorXd force; ///< λ [N/m]: all that crosses the joint; effective compression; shear on the dam, positive
                           ///< downstream
    Eigen::VectorXd opening; ///< g_N [m], m values
    Eigen::VectorXd
        slip; ///< accumulated, positive downstream, without the elastic give of a penalty [m], m values; kept exactly while a pair sticks
    Eigen::VectorXd elastic; ///< elastic part of the tangential gaps, on top of `slip`; zero where sticking is rigid
                             ///< [m], m values
    ContactStates states;
    JointLaws laws; ///< with their states; `force` holds their forces, too

    /// λ_c: what contact and friction carry of `force` [N/m].
    Eigen::VectorXd contact_force() const;
    void contact_force(Eigen::VectorXd& carried) const; ///< the same into a vector that is kept

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
    Eigen::VectorXd rock; ///< of the rock's contact nodes, plane; empty for a rigid base [m]
};

/// The static stiffness of everything seen from the pairs, at one place of the dam on the rock.
///
/// Nothing but contact holds the dam, so the Schur complement S of its stiffness on the interface is singular. The
/// joints' common motions y are eliminated (ContactPlanes: q = E x + N y), which leaves forces f and stiffness S' of x;
/// the rock's contact nodes r then carry x = P r + g. With T = PᵀS'P + K_c, F = P K_c⁻¹ Pᵀ and the gaps g
///
///     λ = S'P T⁻¹ (Pᵀf + f_r) - f + V g,   V = (I + S'F)⁻¹ S'   (rigid base: λ = -f + S' g)
///
/// V is singular exactly for motions of the blocks as a whole. This form keeps the digits of V for soft and hard rock.
class StaticOperator {
public:
    /// @param slip  how far the dam has slid, of a structure that slides far [m]
    explicit StaticOperator(const ContactStructure& structure, double slip = 0.0);

    const ContactStructure& structure() const { return structure_; }
    const std::shared_ptr<const Eigen::MatrixXd>& stiffness() const { return stiffness_; } ///< V
    /// λ of gaps that are all zero, 2m [N/m].
    Eigen::VectorXd shut_force(const SplitLoad& load) const;
    /// Displacements that belong to a load and to gaps in equilibrium. @param gap  2m [m]
    StaticState displacements(const SplitLoad& load, const Eigen::VectorXd& gap) const;

private:
    struct Reduced {
        Eigen::VectorXd on_interface; ///< condensed load of the dam, interface [N/m]
        Eigen::VectorXd force;        ///< f: with the joints' common motions eliminated, 2m
        Eigen::VectorXd rock;         ///< f_r
    };
    Reduced reduced(const SplitLoad& load) const;

    const ContactStructure& structure_;
    Pairing::Matrix trace_;            ///< P
    Eigen::MatrixXd joined_;           ///< of y: S_yy⁻¹; empty without lift joints
    Eigen::MatrixXd coupling_;         ///< S_yx
    Eigen::MatrixXd dam_stiffness_;    ///< S'
    Eigen::MatrixXd tied_flexibility_; ///< T⁻¹; empty: rigid base
    std::shared_ptr<const Eigen::MatrixXd> stiffness_;
};

/// Static equilibrium of dam, contact and rock: the contact problem of StaticOperator.
class StaticContact {
public:
    /// @param joint  law of the joints, see JointSolver
    StaticContact(std::shared_ptr<const StaticOperator> linear, const Contact& joint,
                  const ContactOptions& options = {});
    /// @param slip  how far the dam has slid, of a structure that slides far [m]
    explicit StaticContact(const ContactStructure& structure, const Contact& joint = {},
                           const ContactOptions& options = {}, double slip = 0.0);

    /// From the memory of the last stage to equilibrium under the whole load: friction is followed in one step.
    ContactReport solve(const SplitLoad& load, const ContactLaw& law, ContactMemory& memory);

    /// For solutions with laws of the joints beside hard contact and friction.
    JointLawSolver& with_laws();
    const StaticOperator& linear() const { return *linear_; }

    /// Displacements that belong to a load and a memory in equilibrium.
    StaticState displacements(const SplitLoad& load, const ContactMemory& memory) const;

private:
    std::shared_ptr<const StaticOperator> linear_;
    ContactOptions options_;
    JointSolver solver_;
    std::unique_ptr<JointLawSolver> with_laws_; ///< null: none needed so far
};

} // namespace damslip::fe2d
