#include "scene/water.hpp"

#include "scene/section.hpp"

#include <algorithm>

namespace damslip {

bool has_water(const Scene& scene)
{
    return scene.reservoir && scene.reservoir->level > 0.0;
}

bool is_acoustic(const Scene& scene)
{
    return has_water(scene) && scene.reservoir->model == ReservoirModel::acoustic;
}

double water_density(const Scene& scene)
{
    return scene.reservoir ? scene.reservoir->density : Reservoir{}.density;
}

double water_unit_weight(const Scene& scene)
{
    return water_density(scene) * scene.gravity;
}

bool water_on_dam(const Scene& scene)
{
    if (scene.section.polygon.empty()) return false; // a wedge
    const double toe_y = toe(scene.section).y;
    if (has_water(scene)) return true;
    if (scene.tailwater && scene.tailwater->level > toe_y) return true;
    return std::any_of(scene.combinations.begin(), scene.combinations.end(), [&](const Combination& c) {
        return c.reservoir_level.value_or(0.0) > 0.0 || c.tailwater_level.value_or(toe_y) > toe_y;
    });
}

bool base_taken_as_dry(const Scene& scene)
{
    return water_on_dam(scene) && (!scene.uplift || scene.uplift->model == UpliftModel::none);
}

UpliftState scene_uplift_state(const Scene& scene)
{
    UpliftState state;
    if (scene.reservoir) state.reservoir_level = scene.reservoir->level;
    if (scene.tailwater) state.tailwater_level = scene.tailwater->level;
    return state;
}

double rock_permeability(const Scene& scene)
{
    return scene.foundation ? scene.foundation->permeability : Foundation{}.permeability;
}

bool curtain_changes_stiffness(const Scene& scene)
{
    if (!scene.curtain || !scene.foundation || !scene.curtain->young_modulus) return false;
    const Material& rock = scene.foundation->material;
    return *scene.curtain->young_modulus != rock.young_modulus || scene.curtain->poisson_ratio != rock.poisson_ratio;
}

bool curtain_changes_flow(const Scene& scene)
{
    return scene.curtain && scene.curtain->intact && scene.curtain->permeability != rock_permeability(scene);
}

} // namespace damslip
