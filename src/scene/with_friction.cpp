#include "scene/with_friction.hpp"

#include "core/usage_error.hpp"

#include <algorithm>

namespace damslip {

void set_friction(Scene& scene, double friction)
{
    if (!scene.contact.friction_table.empty())
        refuse_usage("the friction is given twice, by the command line and by contact.friction_table_m of the scene.",
                     "one of them", "take friction_table_m out of the scene to vary the friction");
    if (scene.wedge) {
        std::vector<RockPlane>& planes = scene.wedge->planes;
        const double old = planes.front().friction;
        planes.back().friction = old > 0.0 ? planes.back().friction * (friction / old) : friction;
        planes.front().friction = friction;
    }
    scene.contact.friction = friction;
    if (scene.contact.residual_friction)
        scene.contact.residual_friction = std::min(*scene.contact.residual_friction, friction);
}

Scene with_friction(Scene scene, double friction)
{
    set_friction(scene, friction);
    return scene;
}

} // namespace damslip
