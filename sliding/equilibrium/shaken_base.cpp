#include "sliding/equilibrium/shaken_base.hpp"

#include "scene/section.hpp"
#include "sliding/uplift/unchanged_uplift.hpp"

#include <algorithm>

namespace damslip::sliding {

PressureProfile without_new_crack(const BaseState& state, const Crack& crack)
{
    const CrackedBase& before = state.base;
    const double length = state.frame.length;
    const bool same = crack.side == before.crack.side;
    const double dry_from = crack.side == Side::heel ? (same ? before.crack.length : 0.0) : length - crack.length;
    const double dry_to = crack.side == Side::heel ? crack.length : length - (same ? before.crack.length : 0.0);
    if (dry_to <= dry_from) return before.profile;
    PressureProfile out;
    out.points = part(before.profile, 0.0, dry_from);
    out.points.push_back({dry_from, 0.0});
    out.points.push_back({dry_to, 0.0});
    for (const ProfilePoint& p : part(before.profile, dry_to, length)) out.points.push_back(p);
    return out;
}

std::vector<Load> earthquake_loads(const Scene& scene, const AddedMassIntegral& water, double a_h, double a_v)
{
    const double mass = dam_mass(scene);
    const Point at = centroid(scene.section);
    std::vector<Load> loads;
    loads.push_back(
        {LoadKind::inertia, "inertia of the dam", {force_at(at, mass * a_h, 0.0), force_at(at, 0.0, -mass * a_v)}});
    if (water.xx > 0.0) loads.push_back({LoadKind::hydrodynamic, "hydrodynamic", hydrodynamic_force(water, -a_h, a_v)});
    return loads;
}

CrackedBase shaken_base(const Scene& scene, const StaticCase& static_case, const BaseState& before, const Force& load,
                        const SeepageProfile& seepage)
{
    const BaseLoad total = base_load(before.frame, load);
    const double length = before.frame.length;
    switch (static_case.crack) {
    case CrackRule::none:
        break;
    case CrackRule::fixed_static: {
        CrackedBase base = uncracked_base(total, length, before.base.profile);
        base.crack = before.base.crack;
        base.status = before.base.status;
        base.compressed_length = length - base.crack.length;
        base.compressed_side = before.base.compressed_side;
        return base;
    }
    case CrackRule::seismic_unchanged:
        return cracked_base_unchanged(total, length, before.base.profile);
    case CrackRule::seismic_zero:
        return cracked_base(total, length,
                            [&](const Crack& crack) { return without_new_crack(before, crack); });
    case CrackRule::seismic_full:
        return cracked_base(total, length, crack_uplift(scene, static_case.uplift, static_case.uplift_factor, seepage),
                            before.base.crack, crack_events(scene));
    }
    CrackedBase base = uncracked_base(total, length, before.base.profile);
    base.crack = before.base.crack;
    return base;
}

UpliftResultant uplift_of_empty_joint(const BaseState& before, Side opens)
{
    const double length = before.frame.length;
    return resultant(without_new_crack(before, {opens, length}));
}

std::optional<UpliftResultant> uplift_of_open_joint(const Scene& scene, const StaticCase& static_case,
                                                    const BaseState& before, Side opens, const SeepageProfile& seepage)
{
    if (!scene.uplift || scene.uplift->model == UpliftModel::none) return std::nullopt;
    const Crack through{opens, before.frame.length};
    switch (scene.uplift->water.opening) {
    case OpeningWater::zero:
        return uplift_of_empty_joint(before, opens);
    case OpeningWater::full:
    case OpeningWater::mouth:
        return resultant(crack_uplift(scene, static_case.uplift, static_case.uplift_factor, seepage)(through));
    case OpeningWater::unchanged:
    case OpeningWater::reynolds:
        break;
    }
    return std::nullopt;
}

BaseState with_open_joint(const Scene& scene, const StaticCase& static_case, const BaseState& before, Side opens,
                          const SeepageProfile& seepage)
{
    BaseState state = before;
    if (const auto uplift = uplift_of_open_joint(scene, static_case, before, opens, seepage))
        state.base.uplift = *uplift;
    return state;
}

double bonded_length(const BaseState& before, const CrackedBase& base)
{
    const double length = before.frame.length;
    const Crack &a = before.base.crack, &b = base.crack;
    const double lost = a.side == b.side ? std::max(a.length, b.length) : a.length + b.length;
    return std::max(0.0, length - lost);
}

} // namespace damslip::sliding
