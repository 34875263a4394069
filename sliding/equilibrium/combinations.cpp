#include "sliding/equilibrium/combinations.hpp"

#include "core/units.hpp"
#include "scene/section.hpp"
#include "scene/uplift_row.hpp"
#include "sliding/block/yield.hpp"
#include "sliding/equilibrium/criteria.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::sliding {

namespace {

Combination named(const char* name, CombinationKind kind)
{
    Combination c;
    c.name = name;
    c.kind = kind;
    return c;
}

bool tension(const Equilibrium& e)
{
    return std::min(e.heel_stress, e.toe_stress) < 0.0 || e.zone == ResultantZone::outside;
}

/// The rule of the report "with crack".
CrackRule crack_rule(const Scene& scene, const Combination& c)
{
    const CrackRule rule = scene.uplift ? scene.uplift->crack : CrackRule::none;
    const bool shaken = c.k_h != 0.0 || c.k_v != 0.0;
    if (!shaken) return CrackRule::fixed_static;
    return rule == CrackRule::none || rule == CrackRule::fixed_static ? CrackRule::seismic_unchanged : rule;
}

} // namespace

std::vector<Combination> combinations(const Scene& scene, const PeakGround& peak)
{
    if (!scene.combinations.empty()) return scene.combinations;
    std::vector<Combination> out{named("usual", CombinationKind::usual)};
    if (scene.drains) {
        out.push_back(named("drains ineffective", CombinationKind::unusual));
        out.back().drains_effective = false;
    }
    if (scene.ice) {
        out.push_back(named("ice", CombinationKind::unusual));
        out.back().ice = true;
    }
    if (peak.a_h != 0.0 || peak.a_v != 0.0) {
        Combination c = named("seismic", CombinationKind::extreme);
        c.ice = scene.ice.has_value();
        c.k_h = std::abs(peak.a_h) / units::standard_gravity;
        c.k_v = peak.a_v / units::standard_gravity;
        out.push_back(c);
    }
    Combination after = named("post-seismic", CombinationKind::post_seismic);
    after.ice = scene.ice.has_value();
    after.drains_effective = after.curtain_intact = false;
    after.residual_strength = true;
    out.push_back(after);
    return out;
}

std::vector<Equilibrium> evaluate_combinations(const Scene& scene, const PeakGround& peak,
                                               const SeepageProfile& seepage)
{
    std::vector<Equilibrium> out;
    Crack opened;
    for (Combination c : combinations(scene, peak)) {
        const Requirements required = requirements(scene, c);
        const bool rule_given = c.crack.has_value(), after = c.kind == CombinationKind::post_seismic;
        if (!rule_given) c.crack = CrackRule::none;
        out.push_back(evaluate(scene, c, required, {seepage, rule_given && after ? opened : Crack{}}));
        if (!rule_given && (tension(out.back()) || (after && opened.length > 0.0))) {
            c.crack = crack_rule(scene, c);
            out.push_back(evaluate(scene, c, required, {seepage, opened}));
        }
        if (c.kind == CombinationKind::extreme) opened = out.back().base.crack;
    }
    return out;
}

std::vector<UpliftComparison> compare_uplift(const Scene& scene, const SeepageProfile& seepage)
{
    Scene variant = scene;
    if (!variant.uplift) variant.uplift.emplace();
    std::vector<UpliftModel> models{UpliftModel::none, UpliftModel::linear};
    if (scene.curtain) models.push_back(UpliftModel::curtain);
    if (scene.drains) models.push_back(UpliftModel::drains);
    if (!variant.uplift->points.empty()) models.push_back(UpliftModel::points);
    if (seepage) models.push_back(UpliftModel::seepage);
    for (std::size_t i = 0; i < uplift_rows().size(); ++i)
        if (const UpliftRow& row = uplift_rows()[i]; row.profile && has_what_it_needs(scene, row))
            models.push_back(UpliftModel(i));

    std::vector<UpliftComparison> out;
    for (const UpliftModel model : models) {
        variant.uplift->model = model;
        StaticCase static_case = scene_static_case(variant);
        static_case.crack = CrackRule::none;
        const BaseState state = base_state(variant, static_case, seepage);
        const RigidBlock block = make_rigid_block(variant, state, static_case.loads.reservoir_level);
        out.push_back({model, state.base.profile, state.base.uplift, critical_friction(block)});
    }
    return out;
}

} // namespace damslip::sliding
