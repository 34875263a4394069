#pragma once

#include "fe2d/contact/bond_law.hpp"
#include "fe2d/run/static_contact.hpp"

namespace damslip::fe2d {

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
