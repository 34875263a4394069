#include "scene/first_joint_law.hpp"

#include "scene/joint_bond.hpp"
#include "scene/opening_water.hpp"

#include <fmt/format.h>

namespace damslip {

std::string first_joint_law(const Scene& s)
{
    if (breaks_by_energy(s.contact)) return "contact.bond = \"fracture\"";
    for (std::size_t i = 0; i < s.lift_joints.size(); ++i)
        if (breaks_by_energy(s.lift_joints[i].strength))
            return fmt::format("lift_joint[{}].bond = \"fracture\"", i + 1);
    if (s.contact.rate.active()) return "contact.kinetic_friction_ratio";
    for (std::size_t i = 0; i < s.lift_joints.size(); ++i)
        if (s.lift_joints[i].strength.rate.active()) return fmt::format("lift_joint[{}].kinetic_friction_ratio", i + 1);
    if (!s.anchors.empty()) return "[[anchor]]";
    if (s.uplift && s.uplift->water.follows())
        return s.uplift->water.opening != OpeningWater::unchanged ? "uplift.opening" : "uplift.after";
    if (drains_shear_off(s)) return "drains.lost_at_slip_m";
    return {};
}

} // namespace damslip
