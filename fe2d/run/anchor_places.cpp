#include "fe2d/run/anchor_places.hpp"

#include "scene/friction_over_slip.hpp"

#include <algorithm>

namespace damslip::fe2d {

std::unique_ptr<AnchorLaw> anchors_on(const Scene& scene, const ContactPlanes& planes)
{
    if (scene.anchors.empty()) return nullptr;
    std::vector<PlacedAnchor> all;
    for (const Anchor& anchor : scene.anchors) {
        Eigen::Index index = 0;
        if (!anchor.joint.empty()) {
            const auto joint = std::find_if(scene.lift_joints.begin(), scene.lift_joints.end(),
                                            [&](const LiftJoint& j) { return j.name == anchor.joint; });
            index = 1 + (joint - scene.lift_joints.begin());
        }
        const Contact& contact =
            index == 0 ? scene.contact : scene.lift_joints[static_cast<std::size_t>(index - 1)].strength;
        const Plane& plane = planes[index];
        const double at = plane.distance[0] + anchor.distance;
        Eigen::Index i = 0;
        while (i + 2 < plane.pairs() && plane.distance[i + 1] < at) ++i;
        double share = 0.0;
        if (plane.pairs() > 1)
            share = std::clamp((at - plane.distance[i]) / (plane.distance[i + 1] - plane.distance[i]), 0.0, 1.0);
        all.push_back({anchor_bar(anchor, FrictionOverSlip(contact).peak()), planes.first(index) + i, share});
    }
    return std::make_unique<AnchorLaw>(std::move(all), planes.pairs());
}

} // namespace damslip::fe2d
