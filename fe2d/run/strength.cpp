#include "fe2d/run/strength.hpp"

#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;

Strength::Strength(const Contact& contact, const Plane& plane) : law_(uniform_law(plane.pairs(), 0.0))
{
    law_.separation = contact.separation;
    add(contact, 0, plane.area);
}

Strength::Strength(const Contact& base, const std::vector<LiftJoint>& joints, const ContactPlanes& planes)
    : law_(uniform_law(planes.pairs(), 0.0))
{
    law_.separation = base.separation; // [contact] says it for all planes
    add(base, 0, planes.base().area);
    for (Index k = 1; k < planes.count(); ++k)
        add(joints[static_cast<std::size_t>(k - 1)].strength, planes.first(k), planes[k].area);
}

void Strength::add(const Contact& contact, Index first, const Eigen::VectorXd& area)
{
    const FrictionOverSlip friction(contact);
    law_.friction.segment(first, area.size()).setConstant(friction.at(0.0));
    law_.cohesion.segment(first, area.size()) = contact.cohesion * area;
    if (!friction.constant() || (contact.cohesion != 0.0 && contact.cohesion_lost_at_slip)) constant_ = false;
    parts_.push_back({friction, contact.cohesion_lost_at_slip, first, area.size()});
    last_slip_ = accumulated_ = Eigen::VectorXd::Zero(law_.pairs());
}

void Strength::follow(const ContactMemory& memory)
{
    if (constant_) return;
    for (const Part& part : parts_)
        for (Index i = part.first; i < part.first + part.pairs; ++i) {
            accumulated_[i] += std::abs(memory.slip[i] - last_slip_[i]);
            last_slip_[i] = memory.slip[i];
            law_.friction[i] = part.friction.at(accumulated_[i]);
            const ContactState state = memory.states[static_cast<std::size_t>(i)];
            if (part.cohesion_lost_at_slip && state != ContactState::stick) law_.cohesion[i] = 0.0;
        }
}

} // namespace damslip::fe2d
