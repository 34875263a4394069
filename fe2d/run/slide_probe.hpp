#pragma once

#include "fe2d/run/contact_motion.hpp"
#include "fe2d/run/slide_watch.hpp"
#include "fe2d/run/stages.hpp"

#include <vector>

namespace damslip::fe2d {

/// Reads what a SlideWatch asks for from the contact of a run: thrust and normal force of each plane are those of the static
/// state that the motion starts from, the strength is that of the instant.
class SlideProbe {
public:
    /// @param rest  the last static stage, in equilibrium   @param start  slips of all pairs before the motion [m]
    SlideProbe(const ContactPlanes& planes, const StageResult& rest, const Eigen::VectorXd& start);

    double static_normal_force() const { return balances_.front().normal_force; } ///< of the base [N/m]

    /// The instant of a run that keeps an energy ledger: the work of friction is taken from it.
    SlideInstant instant(const ContactMotion& dynamics, const ContactLaw& law) const;
    /// The instant of a run without a ledger. @param friction  dissipated since the start [J/m]
    SlideInstant instant(double time, const ContactMemory& contact, const ContactLaw& law, double friction) const;

private:
    double sliding_factor(const ContactLaw& law) const;

    const ContactPlanes& planes_;
    std::vector<BaseResultant> balances_; ///< by plane
    std::vector<double> start_;           ///< mean slips by plane [m]
};

/// What friction takes in one step [J/m], by the mean of the forces at its two ends.
double friction_work(const ContactMemory& before, const ContactMemory& after);

} // namespace damslip::fe2d
