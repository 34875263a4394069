#pragma once

#include "fe2d/run/static_contact.hpp"
#include "scene/scene.hpp"

namespace damslip::fe2d {

/// Strength of the pairs during a run: friction that depends on the slip of each pair, cohesion that is lost.
///
/// Changes take effect from the next step on (an error of first order in the step, nothing where strength is constant).
class Strength {
public:
    Strength(const Contact& contact, const Plane& plane);

    const ContactLaw& law() const { return law_; }
    void set_separation(Separation separation) { law_.separation = separation; }
    bool constant() const { return constant_; }
    void follow(const ContactMemory& memory); ///< after a step

private:
    double friction_at(double accumulated_slip) const;

    Contact contact_;
    ContactLaw law_;
    bool constant_;
    Eigen::VectorXd last_slip_, accumulated_; ///< [m]
};

} // namespace damslip::fe2d
