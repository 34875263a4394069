#include "scene/opening_water.hpp"

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

} // namespace damslip
