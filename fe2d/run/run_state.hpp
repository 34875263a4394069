#pragma once

#include "fe2d/contact/joint_law.hpp"

namespace damslip::fe2d {

/// What an earthquake leaves of the joints of a dam that has come to rest, for the next one to start from. Vectors over all
/// pairs, the base's first.
struct RunState {
    Eigen::VectorXd force;    ///< λ, 2m [N/m]
    Eigen::VectorXd opening;  ///< [m]
    Eigen::VectorXd slip;     ///< sum, positive downstream [m]
    Eigen::VectorXd path;     ///< sum of |slip|, by which strength falls [m]
    Eigen::VectorXd cohesion; ///< left [N/m]
    ContactStates states;
    JointLawState laws = {}; ///< of the laws beside contact and friction (JointLaws::save())

    Eigen::Index pairs() const { return opening.size(); }
};

} // namespace damslip::fe2d
