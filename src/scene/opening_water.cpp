#include "scene/opening_water.hpp"

#include "scene/uplift_row.hpp"

#include <algorithm>

namespace damslip {

const std::vector<std::pair<std::string, OpeningWater>>& opening_waters()
{
    static const std::vector<std::pair<std::string, OpeningWater>> words{{"unchanged", OpeningWater::unchanged},
                                                                         {"zero", OpeningWater::zero},
                                                                         {"full", OpeningWater::full},
                                                                         {"mouth", OpeningWater::mouth},
                                                                         {"reynolds", OpeningWater::reynolds}};
    return words;
}

const std::string& word(OpeningWater rule)
{
    return std::find_if(opening_waters().begin(), opening_waters().end(),
                        [rule](const auto& entry) { return entry.second == rule; })
        ->first;
}

bool drains_shear_off(const Scene& scene)
{
    if (!scene.uplift || !scene.drains || !scene.drains->lost_at_slip) return false;
    const UpliftModel model = scene.uplift->model;
    return model == UpliftModel::drains || model == UpliftModel::seepage || uplift_row(model).by_drains;
}

bool base_water_changes(const Scene& scene)
{
    return (scene.uplift && scene.uplift->water.follows()) || drains_shear_off(scene);
}

} // namespace damslip
