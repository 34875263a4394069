#include "analysis/prepare/lift_joints.hpp"

#include "core/input_error.hpp"
#include "scene/planes.hpp"
#include "sliding/planes/lifts.hpp"
#include "sliding/uplift/uplift.hpp"

#include <algorithm>
#include <cmath>

namespace damslip {

namespace {

void sort(std::vector<LiftJoint>& joints)
{
    std::sort(joints.begin(), joints.end(),
              [](const LiftJoint& a, const LiftJoint& b) { return a.elevation < b.elevation; });
}

LiftJoint made_lift(const Scene& scene, double elevation)
{
    LiftJoint joint = sliding::lift_at(scene, elevation);
    if (joint.water == JointWater::none) return joint;
    const Scene part = sliding::scene_above_made_lift(scene, joint);
    for (const ProfilePoint& p : sliding::uplift_profile(part, scene_uplift_state(part)).points)
        joint.pressures.push_back({p.distance, scene.lifts->uplift_share * p.pressure});
    return joint;
}

} // namespace

void check_traced(const Scene& scene)
{
    if (scene.dam.crack != BodyCrack::traced) return;
    const auto refuse_with = [&](bool wrong, const char* problem, const char* expected, const char* fix) {
        if (wrong) refuse(scene.file, std::string("dam.crack = \"traced\" ") + problem, expected, fix);
    };
    refuse_with(!scene.dam.tensile_strength, "without dam.tensile_strength_MPa.", "the strength of the concrete",
                "add  tensile_strength_MPa = 2.0  to [dam]");
    refuse_with(scene.mesh.file.has_value(), "with mesh.file: the mesh is made anew along each path.",
                "the mesh of the program", "delete  file  in [mesh], or write  crack = \"none\"");
    refuse_with(scene.seam_body.has_value(), "on a seam.", "a dam on its base", "run without --plane");
    refuse_with(!scene.section.thickness.empty(), "with section.thickness.", "a section of one thickness",
                "write  crack = \"none\"  in [dam]");
    refuse_with(scene.contact.sliding == JointPath::finite, "with contact.sliding = \"finite\".",
                "sliding = \"small\" where the dam has joints", "write  sliding = \"small\"  in [contact]");
    refuse_with(scene.time.scheme == TimeScheme::central_difference, "with time.scheme = \"central-difference\".",
                "scheme = \"hht\"", "write  scheme = \"hht\"  in [time]");
    refuse_with(!scene.motion.sequence.empty(), "with a sequence.", "each record by itself",
                "write  crack = \"none\"  in [dam]");
}

Scene with_joints_of_lifts(Scene scene)
{
    if (!scene.lifts || scene.mesh.file) return scene;
    if (scene.lifts->active != ActiveLifts::none) {
        if (scene.contact.sliding == JointPath::finite)
            throw InputError(Diagnostic{scene.file.string(), 0, 0, "contact.sliding = \"finite\" with [lifts].",
                                        "sliding = \"small\" where the dam has lift joints",
                                        "write  sliding = \"small\" , or  active = \"none\"  in [lifts]"});
        const Contact& strength = scene.lifts->strength;
        const bool no_energy = !strength.bond.tension_energy || !strength.bond.shear_energy;
        if (scene.lifts->bonded && (no_energy || scene.time.scheme == TimeScheme::central_difference))
            throw InputError(Diagnostic{
                scene.file.string(), 0, 0,
                no_energy ? "lifts.bond = \"bonded\" without both fracture energies, by finite elements: the mesh would be "
                            "its strength."
                          : "lifts.bond = \"bonded\" with time.scheme = \"central-difference\".",
                no_energy ? "G_I of 100 to 300 and G_II of 1000 to 3000 N/m are usual" : "implicit steps for a bond that breaks",
                no_energy ? "add  fracture_energy_tension_N_m = 200  and  fracture_energy_shear_N_m = 2000  to [lifts], or "
                            "write  active = \"none\""
                          : "write  scheme = \"hht\"  in [time], or  active = \"none\"  in [lifts]"});
        const bool all = scene.lifts->active == ActiveLifts::all;
        std::vector<LiftJoint> made;
        for (const double y : lift_elevations(scene))
            if (std::none_of(scene.lift_joints.begin(), scene.lift_joints.end(),
                             [y](const LiftJoint& j) { return std::abs(j.elevation - y) < same_level; }))
                made.push_back(made_lift(scene, y));
        std::vector<LiftJoint>& joints = all ? scene.lift_joints : scene.tied_lifts;
        joints.insert(joints.end(), made.begin(), made.end());
        sort(joints);
    }
    scene.lifts.reset();
    return scene;
}

Scene with_awake_lifts(Scene scene, const std::vector<std::string>& names)
{
    std::vector<LiftJoint> asleep;
    for (LiftJoint& lift : scene.tied_lifts)
        (std::find(names.begin(), names.end(), lift.name) != names.end() ? scene.lift_joints : asleep)
            .push_back(std::move(lift));
    scene.tied_lifts = std::move(asleep);
    sort(scene.lift_joints);
    return scene;
}

} // namespace damslip
