#pragma once

#include "fe2d/contact/joint_law.hpp"
#include "fe2d/contact/joint_laws.hpp"
#include "fe2d/contact/joint_water.hpp"
#include "fe2d/run/contact_planes.hpp"
#include "fe2d/run/static_contact.hpp"
#include "scene/joint_bond.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <vector>

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

/// Strength of the pairs during a run: friction that depends on the slip of each pair, cohesion that is lost pair by pair or
/// of a whole plane together. Cohesion that takes work to break is a law of its own (BondLaw): none here.
///
/// Changes take effect from the next step on (an error of first order in the step, nothing where strength is constant).
class Strength {
public:
    Strength(const Contact& contact, const Plane& plane); ///< of one plane
    /// @param joints  joints_of() the scene @param segments  of a base that is the path of a seam; of its first `base` counts
    Strength(const Contact& base, const std::vector<LiftJoint>& joints, const ContactPlanes& planes,
             const std::vector<Contact>& segments = {});

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
    std::vector<char> broken_;  ///< pairs that have opened or slipped
    Eigen::VectorXd base_area_; ///< [m]
    CrackLengths opened_;
    Eigen::VectorXd last_slip_, accumulated_; ///< [m]
};

/// The laws that base and lift joints have beside hard contact and Coulomb's friction; none where the scene names none.
/// @param base  strength of the base, in place of the scene's
JointLaws joint_laws(const Scene& scene, const Contact& base, const ContactPlanes& planes);

/// @throws InputError  where friction that falls with the rate does not lag behind it
void check_friction_over_rate(const Scene& scene);
/// @throws InputError  where landings of a dam by finite elements cannot have a restitution
void check_rebounds(const Scene& scene);

} // namespace damslip::fe2d
