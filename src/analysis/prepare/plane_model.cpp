#include "analysis/prepare/plane_model.hpp"

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "sliding/planes/lifts.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
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

RigidModel plane_model(sliding::LiftPlane& lift)
{
    return model_of(std::move(lift.stages), lift.length, lift.mean_amplification);
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
    scene.lift_joints = ready.given.lift_joints; // they replace lifts
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

} // namespace damslip
