#include "fe2d/run/strength.hpp"

#include "scene/joint_bond.hpp"

#include <algorithm>
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
    Part part{friction, std::nullopt, first, area.size(), {}};
    if (breaks_by_energy(contact)) {
        law_.cohesion.segment(first, area.size()).setZero();
    } else {
        law_.cohesion.segment(first, area.size()) = contact.cohesion * area;
        if (contact.cohesion != 0.0 && contact.cohesion_lost_at_slip) part.loss = bond_loss(contact);
        if (part.loss == BondLoss::together) part.cohesion = contact.cohesion * area;
    }
    if (!friction.constant() || part.loss) constant_ = false;
    parts_.push_back(std::move(part));
    if (first == 0) base_area_ = area;
    broken_.assign(static_cast<std::size_t>(law_.pairs()), 0);
    last_slip_ = accumulated_ = Eigen::VectorXd::Zero(law_.pairs());
}

void Strength::note_cracks(const ContactStates& states)
{
    const std::size_t base = static_cast<std::size_t>(base_area_.size());
    const auto open = [&](std::size_t i) { return states[i] == ContactState::open; };
    const auto area = [&](std::size_t i) { return base_area_[static_cast<Index>(i)]; };
    CrackLengths now;
    for (std::size_t i = 0; i < base && open(i); ++i) now.upstream += area(i);
    for (std::size_t i = base; i > 0 && open(i - 1); --i) now.downstream += area(i - 1);
    opened_ = {std::max(opened_.upstream, now.upstream), std::max(opened_.downstream, now.downstream)};
    for (std::size_t i = 0; i < broken_.size(); ++i)
        if (states[i] != ContactState::stick) broken_[i] = 1;
}

void Strength::lose_broken()
{
    for (Part& part : parts_)
        for (Index i = part.first; part.loss && i < part.first + part.pairs; ++i) {
            if (!broken_[static_cast<std::size_t>(i)]) continue;
            law_.cohesion[i] = 0.0;
            if (part.cohesion.size() > 0) part.cohesion[i - part.first] = 0.0;
        }
}

void Strength::follow(const ContactMemory& memory)
{
    note_cracks(memory.states);
    if (constant_) return;
    for (Part& part : parts_) {
        if (part.loss == BondLoss::together && part.cohesion.size() > 0 && lose_together(part, memory))
            part.cohesion.resize(0);
        for (Index i = part.first; i < part.first + part.pairs; ++i) {
            accumulated_[i] += std::abs(memory.slip[i] - last_slip_[i]);
            last_slip_[i] = memory.slip[i];
            law_.friction[i] = part.friction.at(accumulated_[i]);
            const ContactState state = memory.states[static_cast<std::size_t>(i)];
            if (part.loss == BondLoss::pairs && state != ContactState::stick) law_.cohesion[i] = 0.0;
            if (part.loss == BondLoss::together) {
                const bool holds = part.cohesion.size() > 0 && state != ContactState::open;
                law_.cohesion[i] = holds ? part.cohesion[i - part.first] : 0.0;
            }
        }
    }
}

/// |Σλ_t| over all closed pairs of a plane against μΣλ_n + c A_closed. Each pair is within its own strength, so the plane has
/// reached it only when every closed pair slips, up to round-off.
bool Strength::lose_together(const Part& part, const ContactMemory& memory) const
{
    double shear = 0.0, strength = 0.0;
    for (Index i = part.first; i < part.first + part.pairs; ++i) {
        if (memory.states[static_cast<std::size_t>(i)] == ContactState::open) continue;
        shear += memory.force[law_.pairs() + i];
        strength += law_.friction[i] * std::max(0.0, memory.force[i]) + part.cohesion[i - part.first];
    }
    return std::abs(shear) >= strength * (1.0 - 1e-9);
}

void Strength::save(RunState& state) const
{
    Strength left = *this;
    left.lose_broken();
    state.path = accumulated_;
    state.cohesion = left.law_.cohesion;
}

void Strength::restore(const RunState& state)
{
    accumulated_ = state.path;
    last_slip_ = state.slip;
    law_.cohesion = state.cohesion;
    for (Part& part : parts_) {
        if (part.cohesion.size() > 0 && (state.cohesion.segment(part.first, part.pairs).array() == 0.0).all())
            part.cohesion.resize(0);
        for (Index i = part.first; i < part.first + part.pairs; ++i) {
            const auto at = static_cast<std::size_t>(i);
            law_.friction[i] = part.friction.at(accumulated_[i]);
            broken_[at] = part.loss && state.cohesion[i] == 0.0;
            // A bond that is lost together acts again where the joint has shut, until the plane reaches its strength.
            if (part.cohesion.size() > 0 && state.states[at] != ContactState::open)
                law_.cohesion[i] = part.cohesion[i - part.first];
        }
    }
}

} // namespace damslip::fe2d
