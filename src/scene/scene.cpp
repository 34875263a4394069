#include "scene/scene.hpp"

#include "scene/check.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace damslip {

Scene::Scene() = default;
Scene::Scene(const Scene&) = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(const Scene&) = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

namespace {

/// Water in a tension crack presses but hardly moves; it seeps out along the plane, whose pressure falls to zero at the
/// toe (Hoek & Bray 1981).
void fill_crack_water(Scene& scene, const Findings& findings)
{
    if (!findings.given("reservoir.model")) scene.reservoir->model = ReservoirModel::hydrostatic;
    if (!scene.uplift) scene.uplift.emplace().model = UpliftModel::linear;
}

/// "lift joint 2", where the file has no name for it.
template <class List>
void name_by_number(List& list, const char* what)
{
    for (std::size_t i = 0; i < list.size(); ++i)
        if (list[i].name.empty()) list[i].name = fmt::format("{} {}", what, i + 1);
}

template <class List>
void name_forces(List& forces)
{
    for (auto& force : forces)
        if (force.name.empty()) force.name = "force";
}

} // namespace

void fill_defaults(Scene& scene, const Findings& findings)
{
    if (scene.wedge) {
        name_by_number(scene.wedge->planes, "plane");
        name_forces(scene.wedge->forces);
        if (!scene.wedge->planes.empty())
            scene.contact.friction = scene.wedge->planes.front().friction; // see with_friction
        return;
    }
    const double base = base_length(scene.section);
    if (scene.reservoir && findings.given("section.slope_height")) fill_crack_water(scene, findings);
    if (scene.reservoir) {
        if (!findings.given("reservoir.level")) scene.reservoir->level = crest_level(scene.section);
        if (!findings.given("reservoir.length")) {
            const double depths = scene.reservoir->far_end == FarEnd::absorbing ? 1.0 : 2.4;
            scene.reservoir->length = std::max(depths * scene.reservoir->level, 1e-3);
        }
    }
    if (scene.ice && !findings.given("ice.level"))
        scene.ice->level = scene.reservoir ? scene.reservoir->level : crest_level(scene.section);
    if (findings.given("time.alpha") && !findings.given("time.scheme")) scene.time.scheme = TimeScheme::hht;
    if (scene.foundation) {
        if (!findings.given("foundation.width")) scene.foundation->width = base * 20.0 / 3.0;
        if (!findings.given("foundation.depth"))
            scene.foundation->depth = std::max(base * 20.0 / 9.0, scene.curtain ? 2 * scene.curtain->depth : 0.0);
    }
    const bool water = scene.reservoir || scene.tailwater;
    if (!scene.uplift && water && (scene.curtain || scene.drains))
        scene.uplift.emplace().model = scene.curtain ? UpliftModel::seepage : UpliftModel::drains;
    else if (scene.uplift && !findings.given("uplift.model"))
        scene.uplift->model = !scene.uplift->points.empty() ? UpliftModel::points
                              : scene.curtain               ? UpliftModel::seepage
                              : scene.drains                ? UpliftModel::drains
                                                            : UpliftModel::linear;
    name_forces(scene.forces);
    name_by_number(scene.lift_joints, "lift joint");
    name_by_number(scene.seams, "seam");
    name_by_number(scene.anchors, "anchor");
    for (std::size_t i = 0; i < scene.seams.size(); ++i) {
        Seam& seam = scene.seams[i];
        const std::string label = fmt::format("seam[{}]", i + 1);
        if (!findings.given(label + ".exit") && seam.wedge) seam.exit = SeamExit::wedge;
        if (!findings.given(label + ".uplift"))
            seam.uplift = !seam.uplift_points.empty() ? UpliftModel::points
                          : scene.drains              ? UpliftModel::drains
                                                      : UpliftModel::linear;
    }
    for (std::size_t i = 0; i < scene.anchors.size(); ++i) {
        Anchor& anchor = scene.anchors[i];
        if (anchor.prestress == 0.0 && !findings.given(fmt::format("anchor[{}].limit_force", i + 1)))
            anchor.limit_force = AnchorForceRule::yield;
    }
}

} // namespace damslip
