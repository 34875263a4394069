#pragma once

#include "fe2d/run/dynamic_contact.hpp"
#include "fe2d/run/stages.hpp"
#include "verification/cases/moreau_scheme.hpp"

#include <optional>

namespace damslip::verification {

enum class SmallDamBase { rigid, rock };

/// A triangular dam with 30 m of water in front of it, friction 0.7, stiffness damping of about 5 % in the first mode.
Scene small_dam_scene(SmallDamBase base);

/// A scene small enough for dense matrices, in static equilibrium, for DynamicContact and MoreauScheme. Unknowns: the
/// dam's, then those of the rock's contact nodes in the plane. Damping: the scene's b_K alone.
class SmallDam {
public:
    explicit SmallDam(Scene scene);
    SmallDam(const SmallDam&) = delete;
    SmallDam& operator=(const SmallDam&) = delete;

    const fe2d::Mesh& mesh() const { return model_.mesh; }
    const fe2d::Plane& plane() const { return structure_->plane(); }
    Eigen::Index pairs() const { return plane().pairs(); }
    double friction() const { return scene_.contact.friction; }
    Eigen::VectorXd weights() const { return plane().weights(); }
    fe2d::ContactLaw law() const { return fe2d::uniform_law(pairs(), friction()); }
    Eigen::VectorXd start() const { return joined(start_.dam, start_.rock); }
    Eigen::VectorXd load(const fe2d::GroundAcceleration& ground) const;
    /// @param radiating  rock of the motion on the plane; null: the massless one
    fe2d::DynamicContact dynamics(const fe2d::Scheme& scheme,
                                  std::shared_ptr<const fe2d::ReducedRock> radiating = {}) const;
    DenseSystem dense() const;

private:
    Eigen::VectorXd joined(const Eigen::VectorXd& dam, const Eigen::VectorXd& rock) const;
    double damping() const { return *scene_.damping.stiffness_coefficient; }

    Scene scene_;
    fe2d::Model model_;
    std::optional<fe2d::ContactStructure> structure_;
    fe2d::SplitLoad load_;
    fe2d::ContactMemory memory_;
    fe2d::StaticState start_;
};

} // namespace damslip::verification
