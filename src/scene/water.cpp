#include "scene/water.hpp"

#include "scene/section.hpp"
#include "scene/uplift_models.hpp"

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

namespace {

bool seeps_through_rock(const Scene& scene)
{
    return scene.stages.pore_pressure != PorePressure::none && scene.foundation.has_value();
}

} // namespace

bool drains_lower_uplift(const Scene& scene)
{
    return scene.drains && ((scene.uplift && reads_drains(scene.uplift->model)) ||
                            std::any_of(scene.seams.begin(), scene.seams.end(),
                                        [](const Seam& seam) { return seam.uplift == UpliftModel::drains; }));
}

bool drains_are_read(const Scene& scene)
{
    return drains_lower_uplift(scene) ||
           (scene.drains && (seeps_through_rock(scene) ||
                             (scene.uplift && scene.uplift->water.opening == OpeningWater::reynolds)));
}

bool curtain_is_read(const Scene& scene, bool depth_given)
{
    if (!scene.curtain) return false;
    const bool measures_rock = scene.foundation && !depth_given && scene.foundation->depth == 2 * scene.curtain->depth;
    const bool measures_drains = scene.drains && !scene.drains->depth && drains_lower_uplift(scene);
    const UpliftModel model = scene.uplift ? scene.uplift->model : UpliftModel::none;
    return model == UpliftModel::curtain || model == UpliftModel::seepage || curtain_changes_stiffness(scene) ||
           seeps_through_rock(scene) || measures_rock || measures_drains;
}

} // namespace damslip
