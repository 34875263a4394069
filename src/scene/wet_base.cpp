#include "scene/wet_base.hpp"

#include "scene/section.hpp"

#include <algorithm>

namespace damslip {

bool water_on_dam(const Scene& scene)
{
    if (scene.section.polygon.empty()) return false; // a wedge
    const double toe_y = toe(scene.section).y;
    if (scene.reservoir && scene.reservoir->level > 0.0) return true;
    if (scene.tailwater && scene.tailwater->level > toe_y) return true;
    return std::any_of(scene.combinations.begin(), scene.combinations.end(), [&](const Combination& c) {
        return c.reservoir_level.value_or(0.0) > 0.0 || c.tailwater_level.value_or(toe_y) > toe_y;
    });
}

bool base_taken_as_dry(const Scene& scene)
{
    return water_on_dam(scene) && (!scene.uplift || scene.uplift->model == UpliftModel::none);
}

} // namespace damslip
