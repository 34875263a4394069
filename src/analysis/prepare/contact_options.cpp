#include "analysis/prepare/contact_options.hpp"

#include "analysis/prepare/fe_inputs.hpp"
#include "fe2d/time/coupled_structure.hpp"
#include "fe2d/time/structure_system.hpp"
#include "scene/rock_mass.hpp"

namespace damslip {

namespace {

/// Pressure along the base for the FE joint, x = distance [m], y = pressure [Pa].
Polyline uplift_polyline(const Scene& scene, const sliding::UpliftState& state, const sliding::SeepageProfile& seepage)
{
    Polyline profile;
    if (!scene.uplift) return profile;
    for (const sliding::ProfilePoint& p : sliding::uplift_profile(scene, state, {}, seepage).points)
        profile.push_back({p.distance, p.pressure});
    return profile;
}

} // namespace

fe2d::RunOptions contact_options(const Scene& scene, const std::vector<RecordPair>& records, SeepageSource& seepage)
{
    fe2d::RunOptions options;
    options.added_mass = added_mass_law(scene);
    sliding::UpliftState water = sliding::scene_uplift_state(scene);
    options.uplift = uplift_polyline(scene, water, seepage.profile_of(scene));
    if (has_water_in_rock(scene))
        options.water_in_rock = [scene](const fe2d::Model& model) { return water_in_rock(scene, model); };
    water.drains = sliding::DrainState::ineffective; // after the earthquake
    water.curtain = sliding::CurtainState::damaged;
    options.uplift_after = uplift_polyline(scene, water, seepage.profile_of(scene));
    if (scene.damping.method == DampingMethod::modified_rayleigh &&
        !records.empty()) { // by the first record's horizontal component
        fe2d::ModelOptions tied;
        tied.added_mass = options.added_mass;
        const fe2d::Model model = fe2d::build_model(with_massless_rock(scene), tied);
        const GroundMotion motion = ground_motion(scene, records.front());
        const bool acoustic = scene.reservoir && scene.reservoir->model == ReservoirModel::acoustic;
        options.damping = acoustic ? fe2d::damping_of(scene, model, fe2d::build_fluid(scene), motion).constants
                                   : fe2d::damping_of(scene, model, motion).constants;
    }
    return options;
}

} // namespace damslip
