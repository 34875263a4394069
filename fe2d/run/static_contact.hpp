#pragma once

#include "fe2d/contact/bond_law.hpp"
#include "fe2d/contact/joint_laws.hpp"
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
/// Nothing but contact holds the dam, so the Schur complement S' of its stiffness on the interface is singular. It has forces
/// f and the gaps x of base and joints (ContactPlanes);
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
        Eigen::VectorXd force;        ///< f: with the joints' common motions eliminated, 2m
        Eigen::VectorXd rock;         ///< f_r
    };
    Reduced reduced(const SplitLoad& load) const;

    const ContactStructure& structure_;
    Pairing::Matrix trace_;            ///< P
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

/// How a static stage went whose bond breaks on the way.
struct StaticPath {
    bool holds = false;        ///< the whole load is carried
    double largest_load = 0.0; ///< t_max: largest share of the stage's load in equilibrium on the way [-]
    int events = 0;            ///< damage updates
    ContactReport contact;     ///< of the last solution
};

/// Follows the damage of the bond while the load of a stage comes, t from 0 to 1 (Rots 2001, sequentially linear analysis):
/// with damage as it is everything but contact is linear; the load is found at which the first pair is as far strained as it
/// is damaged, that pair is damaged a little more, and so on: each state on the way is one of the law, in equilibrium. The load falls by itself where the structure snaps back.
/// @param before, load  λ of gaps that are all zero at t = 0 and t = 1 (StaticOperator::shut_force) [N/m]
/// @param memory  on entry at t = 0; after: at t = 1 where the load is carried, else at t_max
/// @param step  growth of the damage from one state to the next, over the damage [-]
StaticPath follow_damage(JointLawSolver& solver, const Eigen::VectorXd& before, const Eigen::VectorXd& load,
                         const ContactLaw& law, ContactMemory& memory, double step = 0.05);

/// Largest share of a load that a plane carries with the strength of all pairs used at once, by equilibrium of the plane
/// alone: an upper bound of any static answer (Radenkovic 1961). Each pair carries |λ_t| <= A √(c² + mu² f_t²) + mu λ_n, the
/// narrowest line around Coulomb's cone and the bond's ellipse, and λ_n >= -f_t A.
struct PlaneLimit {
    double shear_strength = 0.0;   ///< Σ A √(c² + mu² f_t²) [N/m]
    double tension_strength = 0.0; ///< Σ A f_t [N/m]
    double friction = 0.0;         ///< [-]
    double length = 0.0;           ///< [m]
    double cohesion = 0.0;         ///< Σ c A, of damaged pairs what is left: for the sliding factor [N/m]
};
/// Resultant of a load on a plane.
struct PlaneLoad {
    double normal = 0.0; ///< N', compression positive [N/m]
    double shear = 0.0;  ///< T, downstream [N/m]
    double moment = 0.0; ///< N' times its distance from the upstream end [N m/m]
};
/// @returns smallest t > 0 of the line between both loads at which the plane fails; infinite: none
double limit_load(const PlaneLimit& plane, const PlaneLoad& before, const PlaneLoad& load);

} // namespace damslip::fe2d
