#include "pages/screen/lift_joint_table.hpp"

#include "core/units.hpp"
#include "sliding/block/yield.hpp"
#include "sliding/equilibrium/lift_block.hpp"

#include <cmath>

namespace damslip::pages {

Table lift_joint_table(const Scene& scene)
{
    Table t;
    t.title = "Blocks above the lift joints";
    t.columns = {{"joint", "joint", "", 4},
                 {"elevation_m", "elevation", "m", 5},
                 {"friction", "μ", "–", 4},
                 {"normal_force_kN_m", "N'", "kN/m", 6},
                 {"shear_force_kN_m", "T", "kN/m", 6},
                 {"sliding_factor", "sliding factor", "–", 4},
                 {"critical_friction", "critical μ", "–", 6},
                 {"yield_acceleration_m_s2", "a_y downstream", "m/s²", 6},
                 {"yield_coefficient_g", "a_y downstream", "g", 6}};
    for (const LiftJoint& joint : scene.lift_joints) {
        const sliding::RigidBlock block = sliding::lift_block(scene, joint);
        const double normal = sliding::static_normal_force(block), shear = block.horizontal_force;
        const double a_y = sliding::yield_downstream(block).law.constant;
        const double resistance = block.friction * normal + block.cohesion_force;
        t.rows.push_back({joint.name, joint.elevation, block.friction, normal / 1e3, shear / 1e3,
                          shear != 0.0 ? Cell(resistance / std::abs(shear)) : Cell(), sliding::critical_friction(block),
                          a_y, a_y / units::standard_gravity});
    }
    if (!t.rows.empty())
        t.notes.push_back("a_y: acceleration of the joint at which the block above starts to slide; the dam below "
                          "amplifies that of the ground, which `damslip fe` computes.");
    return t;
}

} // namespace damslip::pages
