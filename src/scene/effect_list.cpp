#include "scene/effect_plan.hpp"

#include <cassert>

namespace damslip {

// The files of rows. A new effect is a row of one of them, or a file with a function like these and its lines here; new
// files come last, so that the places of the named effects stay.
std::vector<EffectRow> load_effects();
std::vector<EffectRow> uplift_effects();
std::vector<EffectRow> water_effects();
std::vector<EffectRow> strength_effects();
std::vector<EffectRow> motion_effects();
std::vector<EffectRow> rock_effects();
std::vector<EffectRow> contact_effects();
std::vector<EffectRow> joint_effects();
std::vector<EffectRow> anchor_effects();
std::vector<EffectRow> opening_water_effects();
std::vector<EffectRow> rate_effects();
std::vector<EffectRow> plane_effects();

std::span<const EffectRow> effect_rows()
{
    static const std::vector<EffectRow> rows = [] {
        std::vector<EffectRow> all;
        for (auto* topic : {
                 load_effects,
                 uplift_effects,
                 water_effects,
                 strength_effects,
                 motion_effects,
                 rock_effects,
                 contact_effects,
                 joint_effects,
                 anchor_effects,
                 opening_water_effects,
                 rate_effects,
                 plane_effects,
             })
            for (EffectRow& row : topic()) {
                assert(!row.named || *row.named == Effect(all.size()));
                all.push_back(std::move(row));
            }
        return all;
    }();
    return rows;
}

} // namespace damslip
