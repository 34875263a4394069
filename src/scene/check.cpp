#include "scene/check.hpp"

#include "core/text.hpp"

#include <fmt/format.h>

namespace damslip {

std::string checks::value(const char* key, double x)
{
    return fmt::format("{} = {}", key, shortest(x));
}

void check_consistency(const Scene& scene, Findings& findings, FileCheck files)
{
    if (scene.wedge) {
        checks::check_wedge(scene, findings);
        checks::check_motion(scene, findings, files);
        checks::check_sequence(scene, findings);
        return;
    }
    checks::check_base(scene, findings);
    checks::check_rock(scene, findings);
    checks::check_strength(scene.contact, "contact", findings);
    checks::check_lift_joints(scene, findings);
    checks::check_joint(scene, findings);
    checks::check_planes(scene, findings);
    checks::check_anchors(scene, findings);
    checks::check_water(scene, findings);
    checks::check_motion(scene, findings, files);
    checks::check_sequence(scene, findings);
    checks::check_rate_methods(scene, findings);
    checks::check_flexible_block(scene, findings);
    checks::check_combinations(scene, findings);
    checks::check_fe(scene, findings);
    checks::check_joint_laws(scene, findings);
    checks::check_opening_water(scene, findings);
    checks::check_mesh_file(scene, findings, files);
}

} // namespace damslip
