#include "fe2d/run/strength.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;

Strength::Strength(const Contact& contact, const Plane& plane) : contact_(contact)
{
    const Index m = plane.pairs();
    law_ = uniform_law(m, friction_at(0.0));
    law_.cohesion = contact.cohesion * plane.area;
    constant_ = (contact.cohesion == 0.0 || !contact.cohesion_lost_at_slip) && !contact.residual_friction &&
                contact.friction_table.empty();
    last_slip_ = accumulated_ = Eigen::VectorXd::Zero(m);
}

double Strength::friction_at(double slip) const
{
    const auto& table = contact_.friction_table;
    if (!table.empty()) {
        if (slip <= table.front().x) return table.front().y;
        for (std::size_t k = 0; k + 1 < table.size(); ++k)
            if (slip < table[k + 1].x && contact_.residual_path == Interpolation::steps)
                return table[k].y;
            else if (slip < table[k + 1].x)
                return table[k].y + (slip - table[k].x) / (table[k + 1].x - table[k].x) * (table[k + 1].y - table[k].y);
        return table.back().y;
    }
    if (!contact_.residual_friction || slip <= 0.0) return contact_.friction;
    if (slip >= contact_.residual_slip) return *contact_.residual_friction;
    if (contact_.residual_path == Interpolation::steps) return contact_.friction;
    return contact_.friction + slip / contact_.residual_slip * (*contact_.residual_friction - contact_.friction);
}

void Strength::follow(const ContactMemory& memory)
{
    if (constant_) return;
    for (Index i = 0; i < law_.pairs(); ++i) {
        accumulated_[i] += std::abs(memory.slip[i] - last_slip_[i]);
        last_slip_[i] = memory.slip[i];
        law_.friction[i] = friction_at(accumulated_[i]);
        const ContactState state = memory.states[static_cast<std::size_t>(i)];
        if (contact_.cohesion_lost_at_slip && state != ContactState::stick) law_.cohesion[i] = 0.0;
    }
}

} // namespace damslip::fe2d
