#include "sliding/equilibrium/lift_block.hpp"

#include "sliding/equilibrium/base_state.hpp"

#include <algorithm>
#include <cassert>

namespace damslip::sliding {

namespace {

/// The polygon's part at and above the level y, counter-clockwise, first its upstream end on the level.
Polyline part_above(const Polyline& polygon, double y)
{
    Polyline part;
    const auto add = [&part](Point p) {
        if (part.empty() || part.back() != p) part.push_back(p);
    };
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        if (a.y >= y) add(a);
        if ((a.y < y) != (b.y < y)) add({a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x), y});
    }
    if (part.size() > 1 && part.front() == part.back()) part.pop_back();
    const auto more_upstream = [y](Point a, Point b) { return (a.y == y) != (b.y == y) ? a.y == y : a.x < b.x; };
    std::rotate(part.begin(), std::min_element(part.begin(), part.end(), more_upstream), part.end());
    assert(part.size() > 2 && part[1].y == y && part[1].x > part[0].x);
    return part;
}

/// A level above the joint instead of the heel; nothing left when it is below.
template <class Water>
void lower_level(std::optional<Water>& water, double by)
{
    if (!water) return;
    water->level -= by;
    if (!(water->level > 0.0)) water.reset();
}

} // namespace

Scene scene_above(const Scene& scene, const LiftJoint& joint)
{
    Scene part = scene;
    const double y = joint.elevation;
    part.section.polygon = part_above(scene.section.polygon, y);
    const double x = part.section.polygon.front().x;
    for (Point& p : part.section.polygon) p = {p.x - x, p.y - y};
    part.contact = joint.strength;
    part.lift_joints.clear();
    part.combinations.clear();
    part.foundation.reset();
    part.curtain.reset();
    part.drains.reset();
    lower_level(part.reservoir, y);
    lower_level(part.tailwater, y);
    lower_level(part.silt, y);
    lower_level(part.ice, y);
    std::erase_if(part.forces, [y](const PointForce& f) { return f.at.y < y; });
    for (PointForce& f : part.forces) f.at = {f.at.x - x, f.at.y - y};
    std::erase_if(part.anchors, [&joint](const Anchor& a) { return a.joint != joint.name; });
    for (Anchor& anchor : part.anchors) anchor.joint.clear();
    part.uplift.reset();
    if (joint.water == JointWater::linear) part.uplift.emplace().model = UpliftModel::linear;
    return part;
}

RigidBlock lift_block(const Scene& scene, const LiftJoint& joint)
{
    RigidBlock block = make_rigid_block(scene_above(scene, joint));
    Scene wet = scene;
    wet.section.polygon = part_above(scene.section.polygon, joint.elevation);
    const AddedMassIntegral water =
        scene_added_mass(wet, scene.reservoir ? std::optional(scene.reservoir->level) : std::nullopt);
    block.added_mass = {water.xx, water.xy, water.yy};
    return block;
}

} // namespace damslip::sliding
