#include "scene/effect_plan.hpp"
#include "scene/rock_mass.hpp"
#include "scene/word_rows.hpp"

#include <array>

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
    static const std::vector<EffectRow> rows = rows_of_files<Effect, EffectRow>({
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
    });
    return rows;
}

std::span<const OtherModel> other_models()
{
    static constexpr std::array models{
        OtherModel{"massless rock", "rock=massless", Effect::rock_inertia, rock_radiates, with_massless_rock},
        OtherModel{"radiating rock", "rock=radiating", std::nullopt,
                   [](const Scene& s) {
                       return rock_kind(s) == RockKind::massless && s.time.scheme != TimeScheme::central_difference;
                   },
                   with_radiating_rock},
        OtherModel{"added mass", "", Effect::acoustic_water,
                   [](const Scene& s) { return s.reservoir && s.reservoir->model == ReservoirModel::acoustic; },
                   [](Scene s) {
                       s.reservoir->model = ReservoirModel::added_mass;
                       return s;
                   }},
    };
    return models;
}

const OtherModel* find_other_model(std::string_view level_word)
{
    for (const OtherModel& other : other_models())
        if (!level_word.empty() && other.level_word == level_word) return &other;
    return nullptr;
}

} // namespace damslip
