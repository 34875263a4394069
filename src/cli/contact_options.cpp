#include "cli/contact_options.hpp"

#include "cli/fe_inputs.hpp"
#include "cli/usage_error.hpp"
#include "fe2d/time/structure_system.hpp"

#include <fmt/format.h>

namespace damslip::cli {

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
    if (!scene.lift_joints.empty())
        throw UsageError(
            Diagnostic{scene.file.string(), 0, 0,
                       fmt::format("{} [[lift_joint]]: runs with sliding lift joints are not computed yet.",
                                   scene.lift_joints.size()),
                       "no [[lift_joint]], or an uncracked dam: --base tied",
                       "delete the [[lift_joint]], or run  damslip fe --base tied"});
    if (scene.mesh.rock_contact_size && scene.contact.sliding == JointPath::small)
        throw UsageError(Diagnostic{scene.file.string(), 0, 0,
                                    "mesh.rock_contact_size_m with contact.sliding = \"small\" is not computed yet.",
                                    "sliding = \"finite\", or facing nodes",
                                    "write  sliding = \"finite\"  in [contact], or delete rock_contact_size_m"});
    fe2d::RunOptions options;
    options.added_mass = added_mass_law(scene);
    sliding::UpliftState water = sliding::scene_uplift_state(scene);
    options.uplift = uplift_polyline(scene, water, seepage.profile_of(scene));
    water.drains = sliding::DrainState::ineffective; // after the earthquake
    water.curtain = sliding::CurtainState::damaged;
    options.uplift_after = uplift_polyline(scene, water, seepage.profile_of(scene));
    if (scene.damping.method == DampingMethod::modified_rayleigh &&
        !records.empty()) { // by the first record's horizontal component
        fe2d::ModelOptions tied;
        tied.added_mass = options.added_mass;
        options.damping =
            fe2d::damping_of(scene, fe2d::build_model(scene, tied), ground_motion(scene, records.front())).constants;
    }
    return options;
}

} // namespace damslip::cli
