#include "fe2d/run/strength.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;

double friction_at(const Contact& contact, double slip)
{
    const auto& table = contact.friction_table;
    if (!table.empty()) {
        if (slip <= table.front().x) return table.front().y;
        for (std::size_t k = 0; k + 1 < table.size(); ++k)
            if (slip < table[k + 1].x && contact.residual_path == Interpolation::steps)
                return table[k].y;
            else if (slip < table[k + 1].x)
                return table[k].y + (slip - table[k].x) / (table[k + 1].x - table[k].x) * (table[k + 1].y - table[k].y);
        return table.back().y;
    }
    if (!contact.residual_friction || slip <= 0.0) return contact.friction;
    if (slip >= contact.residual_slip) return *contact.residual_friction;
    if (contact.residual_path == Interpolation::steps) return contact.friction;
    return contact.friction + slip / contact.residual_slip * (*contact.residual_friction - contact.friction);
}

Strength::Strength(const Contact& contact, const Plane& plane) : law_(uniform_law(plane.pairs(), 0.0))
{
    add(contact, 0, plane.area);
}

Strength::Strength(std::vector<Contact> contacts, const ContactPlanes& planes) : law_(uniform_law(planes.pairs(), 0.0))
{
    for (Index k = 0; k < planes.count(); ++k)
        add(contacts[static_cast<std::size_t>(k)], planes.first(k), planes[k].area);
}

void Strength::add(const Contact& contact, Index first, const Eigen::VectorXd& area)
{
    parts_.push_back({contact, first, area.size()});
    law_.friction.segment(first, area.size()).setConstant(friction_at(contact, 0.0));
    law_.cohesion.segment(first, area.size()) = contact.cohesion * area;
    if ((contact.cohesion != 0.0 && contact.cohesion_lost_at_slip) || contact.residual_friction ||
        !contact.friction_table.empty())
        constant_ = false;
    last_slip_ = accumulated_ = Eigen::VectorXd::Zero(law_.pairs());
}

void Strength::follow(const ContactMemory& memory)
{
    if (constant_) return;
    for (const Part& part : parts_)
        for (Index i = part.first; i < part.first + part.pairs; ++i) {
            accumulated_[i] += std::abs(memory.slip[i] - last_slip_[i]);
            last_slip_[i] = memory.slip[i];
            law_.friction[i] = friction_at(part.contact, accumulated_[i]);
            const ContactState state = memory.states[static_cast<std::size_t>(i)];
            if (part.contact.cohesion_lost_at_slip && state != ContactState::stick) law_.cohesion[i] = 0.0;
        }
}

} // namespace damslip::fe2d
