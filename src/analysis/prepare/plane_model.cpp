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

RigidModel plane_model(sliding::SlipStages stages, double length, double amplification, bool one_way)
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
    model.one_way = one_way;
    return model;
}

RigidModel plane_model(const Scene& scene, const std::string& name)
{
    for (const Seam& seam : scene.seams)
        if (seam.name == name) {
            sliding::SeamPlane plane = sliding::seam_plane(scene, seam, {{"static"}});
            RigidModel model =
                plane_model(std::move(plane.stages), plane.model.chain.blocks[plane.model.chain.dam].length, 1.0, true);
            model.critical_friction = plane.holding_friction;
            return model;
        }
    if (scene.lifts)
        for (sliding::LiftPlane& lift : sliding::lift_planes(scene, {{"static"}}))
            if (lift.name == name) return plane_model(std::move(lift.stages), lift.length, lift.mean_amplification, false);
    const std::vector<std::string> names = plane_names(scene);
    const std::string_view near = nearest(name, names);
    refuse_usage(fmt::format("no plane is named \"{}\".", name), fmt::format("planes: {}", fmt::join(names, ", ")),
                 near.empty() ? "name a [[seam]], a lift of [lifts], or base" : fmt::format("write  {}", near));
}

} // namespace damslip
