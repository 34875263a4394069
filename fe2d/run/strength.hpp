#pragma once

#include "fe2d/contact/joint_water.hpp"
#include "fe2d/run/run_state.hpp"
#include "fe2d/run/static_contact.hpp"
#include "scene/friction_over_slip.hpp"

#include <optional>
#include <vector>

namespace damslip::fe2d {

/// Strength of the pairs during a run: friction that depends on the slip of each pair, cohesion that is lost pair by pair or
/// of a whole plane together. Cohesion that takes work to break is a law of its own (BondLaw): none here.
///
/// Changes take effect from the next step on (an error of first order in the step, nothing where strength is constant).
class Strength {
public:
    Strength(const Contact& contact, const Plane& plane); ///< of one plane
    Strength(const Contact& base, const std::vector<LiftJoint>& joints, const ContactPlanes& planes);

    const ContactLaw& law() const { return law_; }
    bool constant() const { return constant_; }
    void follow(const ContactMemory& memory); ///< after a step
    /// After the earthquake: cohesion that slip destroys is gone where a pair has opened or slipped, though it sticks again.
    void lose_broken();
    /// Longest stretches of the base that were open at one time, from heel and toe [m].
    const CrackLengths& opened() const { return opened_; }
    void save(RunState& state) const; ///< path, and the cohesion that is left
    void restore(const RunState& state);

private:
    struct Part {
        FrictionOverSlip friction;
        std::optional<BondLoss> loss; ///< of cohesion; none: it stays
        Eigen::Index first, pairs;
        Eigen::VectorXd cohesion; ///< of the pairs, where it is lost together [N/m]; empty: lost
    };
    void add(const Contact& contact, Eigen::Index first, const Eigen::VectorXd& area);
    bool lose_together(const Part& part, const ContactMemory& memory) const;
    void note_cracks(const ContactStates& states);

    std::vector<Part> parts_; ///< by plane
    ContactLaw law_;
    bool constant_ = true;
    std::vector<char> broken_; ///< pairs that have opened or slipped
    Eigen::VectorXd base_area_; ///< [m]
    CrackLengths opened_;
    Eigen::VectorXd last_slip_, accumulated_; ///< [m]
};

} // namespace damslip::fe2d
