#include "analysis/prepare/plane_model.hpp"

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "scene/planes.hpp"
#include "scene/section.hpp"
#include "scene/water.hpp"
#include "sliding/planes/lifts.hpp"
#include "sliding/planes/seam.hpp"
#include "sliding/uplift/uplift.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace damslip {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

} // namespace

std::vector<std::string> plane_names(const Scene& scene)
{
    std::vector<std::string> names{base_plane};
    if (scene.lifts)
        for (const double y : lift_elevations(scene)) names.push_back(sliding::lift_at(scene, y).name);
    for (const Seam& seam : scene.seams) names.push_back(seam.name);
    return names;
}

namespace {

/// The model of a plane's stages. @param length  of what it slides on [m] @param amplification  of the ground's motion [-]
RigidModel model_of(sliding::SlipStages stages, double length, double amplification)
{
    RigidModel model;
    model.block = stages.front().block;
    model.stages = std::move(stages);
    model.downstream = sliding::yield_downstream(model.block);
    // A block that nothing moves stands for a locked chain, whose yield is infinite.
    if (model.downstream.law.constant > 1e8 * model.block.gravity) model.downstream = {{infinite, 0.0}, 0.0};
    model.upstream = sliding::yield_upstream(model.block);
    model.state = sliding::static_state(model.block);
    model.critical_friction = sliding::critical_friction(model.block);
    model.length = length;
    model.amplification = amplification;
    return model;
}

RigidModel model_of(const Scene& scene, const Seam& seam, KeptStatics& kept)
{
    sliding::SeamPlane plane = sliding::seam_plane(scene, seam, {}, *kept.seams.get(scene, seam));
    return plane_model(plane);
}

RigidModel model_of(const Scene& scene, sliding::LiftPlane& lift, KeptStatics& kept)
{
    RigidModel model = plane_model(lift);
    if (!lifts_vibrate(scene)) return model;
    const LiftModes& modes = kept.lifts.get([&] { return lift_modes(scene); });
    model.tied = std::make_shared<const sliding::TiedPart>(modes.part(lift.elevation));
    return model;
}

} // namespace

void restore_lift_joints(Scene& scene, const Scene& given)
{
    const auto of_joint = [](const Anchor& anchor) { return !anchor.joint.empty(); };
    scene.lift_joints = given.lift_joints;
    std::erase_if(scene.anchors, of_joint);
    std::copy_if(given.anchors.begin(), given.anchors.end(), std::back_inserter(scene.anchors), of_joint);
}

RigidModel plane_model(sliding::LiftPlane& lift)
{
    RigidModel model = model_of(std::move(lift.stages), lift.length, lift.mean_amplification);
    model.anchors = lift.anchors;
    return model;
}

RigidModel plane_model(sliding::SeamPlane& seam)
{
    RigidModel model = model_of(std::move(seam.stages), seam.model.chain.blocks[seam.model.chain.dam].length, 1.0);
    model.one_way = !seam.of_block;
    model.critical_friction = seam.holding_friction;
    model.upstream = seam.upstream;
    if (!seam.bodies.empty()) model.bodies = std::make_shared<const std::vector<sliding::SeamStage>>(seam.bodies);
    return model;
}

std::vector<RigidModel> all_models(const Ready& ready)
{
    std::vector<RigidModel> models{ready.rigid_model()};
    if (!ready.scene.lifts && ready.scene.seams.empty()) return models;
    Scene scene = ready.scene;
    restore_lift_joints(scene, ready.given);
    KeptStatics own;
    KeptStatics& statics = ready.statics ? *ready.statics : own;
    if (scene.lifts)
        for (sliding::LiftPlane& lift : sliding::lift_planes(scene, {{"static"}}))
            models.push_back(model_of(scene, lift, statics));
    for (const Seam& seam : scene.seams) models.push_back(model_of(scene, seam, statics));
    return models;
}

RigidModel plane_model(const Scene& scene, const std::string& name, KeptStatics* kept)
{
    KeptStatics own;
    KeptStatics& statics = kept ? *kept : own;
    for (const Seam& seam : scene.seams)
        if (seam.name == name) return model_of(scene, seam, statics);
    if (scene.lifts)
        for (sliding::LiftPlane& lift : sliding::lift_planes(scene, {{"static"}}))
            if (lift.name == name) return model_of(scene, lift, statics);
    const std::vector<std::string> names = plane_names(scene);
    const std::string_view near = nearest(name, names);
    refuse_usage(fmt::format("no plane is named \"{}\".", name), fmt::format("planes: {}", fmt::join(names, ", ")),
                 near.empty() ? "name a [[seam]], a lift of [lifts], or base" : fmt::format("write  {}", near));
}

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
            refuse(scene.file, "contact.sliding = \"finite\" with [lifts].",
                   "sliding = \"small\" where the dam has lift joints",
                   "write  sliding = \"small\" , or  active = \"none\"  in [lifts]");
        const Contact& strength = scene.lifts->strength;
        const bool no_energy = !strength.bond.tension_energy || !strength.bond.shear_energy;
        if (scene.lifts->bonded && (no_energy || scene.time.scheme == TimeScheme::central_difference))
            refuse(
                scene.file,
                no_energy
                    ? "lifts.bond = \"bonded\" without both fracture energies, by finite elements: the mesh would be "
                      "its strength."
                    : "lifts.bond = \"bonded\" with time.scheme = \"central-difference\".",
                no_energy ? "G_I of 100 to 300 and G_II of 1000 to 3000 N/m are usual"
                          : "implicit steps for a bond that breaks",
                no_energy
                    ? "add  fracture_energy_tension_N_m = 200  and  fracture_energy_shear_N_m = 2000  to [lifts], or "
                      "write  active = \"none\""
                    : "write  scheme = \"hht\"  in [time], or  active = \"none\"  in [lifts]");
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

namespace {

/// What finite elements on a seam do not follow.
struct Obstacle {
    bool (*there)(const Scene& scene, const Seam& seam);
    const char *what, *expected, *fix;
};

bool bends(const Seam& seam)
{
    return seam.exit == SeamExit::wedge || seam.points.size() > 2;
}

const Obstacle obstacles[] = {
    {[](const Scene& s, const Seam&) { return !s.foundation || !s.foundation->material.young_modulus; },
     "foundation.young_modulus_GPa is not there", "elastic rock above and below the seam",
     "add  young_modulus_GPa = 20  to [foundation]"},
    {[](const Scene& s, const Seam&) { return s.mesh.file.has_value(); }, "mesh.file is given",
     "the program's own mesh, which has the seam as a line", "delete  file  from [mesh]"},
    {[](const Scene& s, const Seam&) {
         return s.mesh.element == ElementKind::q8 || s.mesh.element == ElementKind::q9 ||
                s.mesh.element == ElementKind::t6;
     },
     "mesh.element is quadratic", "linear elements: q4, q4-incompatible or t3", "delete  element  from [mesh]"},
    {[](const Scene& s, const Seam&) { return s.mesh.rock_contact_size.has_value(); },
     "mesh.rock_contact_size_m is given", "the same nodes on both sides of the seam",
     "delete  rock_contact_size_m  from [mesh]"},
    {[](const Scene& s, const Seam&) { return s.contact.sliding == JointPath::finite; }, "contact.sliding = \"finite\"",
     "sliding = \"small\"", "write  sliding = \"small\"  in [contact]"},
    {[](const Scene& s, const Seam&) { return s.stages.pore_pressure != PorePressure::none; },
     "stages.pore_pressure is given", "water on the boundaries of the blocks: along the seam, in its faces",
     "delete  pore_pressure  from [stages]"},
    {[](const Scene& s, const Seam&) {
         return std::any_of(s.anchors.begin(), s.anchors.end(), [](const Anchor& a) { return a.joint.empty(); });
     },
     "an [[anchor]] crosses the base", "anchors of lift joints: how far those of the base reach down is not known",
     "take the anchor out, or run the base (without --plane)"},
    {[](const Scene& s, const Seam&) { return s.uplift && s.uplift->water.follows(); },
     "uplift.opening follows the joint", "water along the seam that stays as it is", "delete  opening  from [uplift]"},
    {[](const Scene& s, const Seam&) { return s.uplift && s.uplift->model == UpliftModel::seepage; },
     "uplift.model = \"seepage\"", "uplift by a profile: what flows in rock with a seam is not known",
     "write  model = \"linear\"  or another in [uplift]"},
    {[](const Scene& s, const Seam& seam) {
         return seam.uplift == UpliftModel::drains && s.drains && s.drains->lost_at_slip.has_value();
     },
     "drains.lost_at_slip_m is given", "drains that last",
     "delete  lost_at_slip_m  from [drains], or use  damslip screen"},
    {[](const Scene&, const Seam& seam) { return seam.dilation != 0.0 || (seam.wedge && seam.wedge->dilation != 0.0); },
     "it dilates (dilation_deg)", "a seam along which blocks slide without rising",
     "write  dilation_deg = 0 , or use  damslip screen"},
    {[](const Scene&, const Seam& seam) {
         return bends(seam) &&
                std::abs(seam.interface.angle.value_or(90.0 * units::degree) - 90.0 * units::degree) > 1e-9;
     },
     "interface.angle_deg is not 90", "upright interfaces",
     "write  angle_deg = 90  in [seam.interface], or use  damslip screen"},
    {[](const Scene& s, const Seam& seam) {
         const Polyline path = seam_path(s, seam);
         return std::any_of(path.begin() + 1, path.end(), [&](Point p) { return p.x < heel(s.section).x - 1e-9; });
     },
     "its path bends upstream of the dam", "a straight path up to the toe",
     "give a path that is straight up to the toe"},
};

/// In the scene's list, from 1.
std::size_t place_of(const Scene& scene, const Seam& seam)
{
    std::size_t place = 1;
    while (place < scene.seams.size() && scene.seams[place - 1].name != seam.name) ++place;
    return place;
}

void check(const Scene& scene, const Seam& seam)
{
    for (const Obstacle& o : obstacles)
        if (o.there(scene, seam))
            refuse(scene.file,
                   fmt::format("seam[{}] \"{}\" by finite elements (--plane): {}.", place_of(scene, seam), seam.name,
                               o.what),
                   o.expected, o.fix);
}

/// A wedge of one angle that does not stand without an earthquake.
[[noreturn]] void refuse_wedge(const Scene& scene, const Seam& seam)
{
    const double angle = seam.wedge->angles.front();
    const sliding::Chain chain = sliding::seam_model(scene, seam, angle).chain;
    const sliding::ChainBlock& wedge = chain.blocks.back();
    throw InputError(Diagnostic{
        scene.file.string(), 0, 0,
        fmt::format("seam[{}] \"{}\" by finite elements (--plane): its wedge at {:.4g} degrees does not stand without an earthquake. It "
                    "weighs {:.4g} kN/m; water lifts it by {:.4g} kN/m and pushes it by {:.4g} kN/m.",
                    place_of(scene, seam), seam.name, angle / units::degree, 1e-3 * wedge.mass * chain.gravity, 1e-3 * wedge.uplift,
                    1e-3 * chain.interfaces.back().water),
        "a wedge that the body presses on", "write  exit = \"free-face\"  without [seam.wedge], give [drains], or another angle_deg"});
}

const Seam& named_seam(const Scene& scene)
{
    const std::string& name = scene.planes.slides_on;
    std::vector<std::string> names;
    for (const Seam& seam : scene.seams) {
        if (seam.name == name) return seam;
        names.push_back(seam.name);
    }
    if (names.empty())
        refuse_usage(fmt::format("--plane \"{}\", but the scene has no [[seam]].", name), "the name of a seam, or base",
                     "add a [[seam]], or leave --plane out");
    const std::string_view near = nearest(name, names);
    refuse_usage(fmt::format("no seam is named \"{}\".", name),
                 fmt::format("seams: {}; lifts slide beside the base without --plane", fmt::join(names, ", ")),
                 fmt::format("write  --plane \"{}\"", near.empty() ? names.front() : std::string(near)));
}

/// Coulomb's law with what [contact] says for all planes of finite elements.
Contact strength_of(const Contact& of_base, double friction, double cohesion)
{
    Contact strength = of_base;
    strength.friction = friction;
    strength.cohesion = cohesion;
    strength.residual_friction.reset();
    strength.friction_table.clear();
    strength.cohesion_lost_at_slip = false;
    strength.bond = {};
    strength.rate = {};
    return strength;
}

Contact strength_of(const Contact& of_base, const Contact& of_seam)
{
    Contact strength = strength_of(of_base, of_seam.friction, of_seam.cohesion);
    strength.residual_friction = of_seam.residual_friction;
    strength.residual_slip = of_seam.residual_slip;
    strength.residual_path = of_seam.residual_path;
    strength.friction_table = of_seam.friction_table;
    strength.cohesion_lost_at_slip = of_seam.cohesion_lost_at_slip;
    return strength;
}

/// Levels below which the faces of the body are full of water, as the chain of rigid blocks has it.
void add_face_levels(const Scene& scene, const Seam& seam, const sliding::SeamModel& model, SeamBody& body)
{
    const Polyline ground = ground_line(scene);
    const Point first = model.path.front(), last = model.path.back();
    if (scene.reservoir && first.y < ground_level(ground, first.x) - 1e-9) body.crack_level = scene.reservoir->level;
    if (seam.exit != SeamExit::daylight && last.y < ground_level(ground, last.x) - 1e-9)
        body.end_level = std::max(ground_level(ground, last.x), scene.tailwater ? scene.tailwater->level : last.y);
    double along = 0.0;
    for (std::size_t i = 1; i + 1 < model.path.size(); ++i) {
        const Point a = model.path[i - 1], foot = model.path[i];
        along += std::hypot(foot.x - a.x, foot.y - a.y);
        const double pressure = pressure_at(model.pressure, along);
        body.interface_levels.push_back(pressure > 0.0 ? std::optional(foot.y + pressure / water_unit_weight(scene))
                                                       : std::nullopt);
    }
}

SeamBody body_of(const Scene& scene, const Seam& seam, std::optional<double> angle)
{
    const sliding::SeamModel model = sliding::seam_model(scene, seam, angle);
    SeamBody body;
    body.name = seam.name;
    body.path = model.path;
    body.of_seam = seam_path(scene, seam).size() - 1;
    for (std::size_t i = 0; i + 1 < body.path.size(); ++i)
        body.strengths.push_back(i < body.of_seam ? strength_of(scene.contact, seam.strength)
                                                  : strength_of(scene.contact, seam.wedge->friction, seam.wedge->cohesion));
    for (const ProfilePoint& p : model.pressure.points) body.water.push_back({p.distance, p.pressure});
    LiftJoint& base = body.interfaces.emplace_back();
    base.name = "base";
    base.strength = scene.contact;
    if (scene.uplift)
        for (const ProfilePoint& p : sliding::uplift_profile(scene, scene_uplift_state(scene)).points)
            base.pressures.push_back({p.distance, p.pressure});
    const bool rubs = seam.interface.model == InterfaceModel::friction;
    for (std::size_t i = 1; i + 1 < body.path.size(); ++i) {
        LiftJoint face;
        face.name = fmt::format("interface at {:.6g} m", body.path[i].x);
        face.elevation = ground_level(ground_line(scene), body.path[i].x);
        face.strength =
            strength_of(scene.contact, rubs ? seam.interface.friction : 0.0, rubs ? seam.interface.cohesion : 0.0);
        body.interfaces.push_back(std::move(face));
    }
    add_face_levels(scene, seam, model, body);
    return body;
}

} // namespace

Scene with_seam_body(Scene scene)
{
    if (scene.planes.slides_on.empty()) return scene;
    const Seam seam = named_seam(scene);
    check(scene, seam);
    const bool given = seam.wedge && seam.wedge->angles.size() == 1; // contact finds out whether it stands in the earthquake
    if (given && !sliding::seam_plane(scene, seam, {{"static"}}).factors.front().angle) refuse_wedge(scene, seam);
    scene.seam_body =
        body_of(scene, seam, given ? std::optional(seam.wedge->angles.front()) : sliding::seam_plane(scene, seam, {}).angle);
    return scene;
}

} // namespace damslip
