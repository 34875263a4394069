#pragma once

#include "fe2d/run/static_contact.hpp"
#include "scene/friction_over_slip.hpp"

#include <vector>

namespace damslip::fe2d {

/// Strength of the pairs during a run: friction that depends on the slip of each pair, cohesion that is lost.
///
/// Changes take effect from the next step on (an error of first order in the step, nothing where strength is constant).
class Strength {
public:
    Strength(const Contact& contact, const Plane& plane); ///< of one plane
    Strength(const Contact& base, const std::vector<LiftJoint>& joints, const ContactPlanes& planes);

    const ContactLaw& law() const { return law_; }
    bool constant() const { return constant_; }
    void follow(const ContactMemory& memory); ///< after a step

private:
    struct Part {
        FrictionOverSlip friction;
        bool cohesion_lost_at_slip;
        Eigen::Index first, pairs;
    };
    void add(const Contact& contact, Eigen::Index first, const Eigen::VectorXd& area);

    std::vector<Part> parts_; ///< by plane
    ContactLaw law_;
    bool constant_ = true;
    Eigen::VectorXd last_slip_, accumulated_; ///< [m]
};

} // namespace damslip::fe2d
