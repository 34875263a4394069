#include "fe2d/model/lift_water.hpp"

#include "scene/water.hpp"

#include <algorithm>
#include <cassert>

namespace damslip::fe2d {

PressureProfile lift_water_profile(const Scene& scene, const LiftJoint& joint, double length)
{
    if (joint.water == JointWater::none) return {};
    const double unit_weight = water_unit_weight(scene);
    const double upstream = scene.reservoir ? std::max(0.0, scene.reservoir->level - joint.elevation) : 0.0;
    const double downstream = scene.tailwater ? std::max(0.0, scene.tailwater->level - joint.elevation) : 0.0;
    if (upstream == 0.0 && downstream == 0.0) return {};
    return {{{0.0, unit_weight * upstream}, {length, unit_weight * downstream}}};
}

Eigen::VectorXd lift_water(const Scene& scene, const Model& model)
{
    assert(scene.lift_joints.size() == model.mesh.lifts.size());
    Eigen::VectorXd sum;
    for (std::size_t i = 0; i < scene.lift_joints.size(); ++i) {
        const double length = model.mesh.lifts[i].distance.back();
        const PressureProfile profile = lift_water_profile(scene, scene.lift_joints[i], length);
        if (profile.empty()) continue;
        if (sum.size() == 0) sum = Eigen::VectorXd::Zero(model.dofs.count);
        sum += lift_water_load(model.mesh, model.dofs, i, profile);
    }
    return sum;
}

} // namespace damslip::fe2d
