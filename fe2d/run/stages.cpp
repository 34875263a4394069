#include "fe2d/run/stages.hpp"

#include "core/defect.hpp"
#include "fe2d/model/lift_water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

BaseResultant base_resultant(const ContactStructure& structure, const VectorXd& ordered_load, Index index)
{
    const Mesh& mesh = structure.model().mesh;
    const VectorXd dam_load = structure.order().to_old(ordered_load);
    const Plane& plane = structure.planes()[index];
    const std::vector<char>& above = structure.planes().above(index);
    const int first = index == 0 ? mesh.contact.dam_nodes.front()
                                 : mesh.lifts[static_cast<std::size_t>(index - 1)].upper_nodes.front();
    const Point end = mesh.nodes[first];
    Eigen::Vector2d force = Eigen::Vector2d::Zero();
    double moment = 0.0; // about the upstream end, counter-clockwise
    for (int node = 0; node < mesh.dam_node_count; ++node) {
        if (!above[static_cast<std::size_t>(node)]) continue;
        const double fx = dam_load[2 * node], fy = dam_load[2 * node + 1];
        force += Eigen::Vector2d(fx, fy);
        moment += (mesh.nodes[node].x - end.x) * fy - (mesh.nodes[node].y - end.y) * fx;
    }
    // N' acts upwards at `position` and balances the moment of the loads: position N' = -moment.
    const double normal = -plane.normal.dot(force);
    return {normal, plane.tangent.dot(force), normal != 0.0 ? -moment / normal : 0.0};
}

LoadStages load_stages(const Scene& scene, const Model& model, const PressureProfile& uplift, const VectorXd& in_rock)
{
    const StaticLoads loads = static_loads(scene, model);
    LoadStages stages;
    VectorXd sum = sum_of(loads.gravity, model.dofs.count);
    stages.names.push_back("gravity");
    stages.loads.push_back(sum);
    if (!loads.impounding.empty()) {
        sum += sum_of(loads.impounding, model.dofs.count);
        stages.names.push_back("water");
        stages.loads.push_back(sum);
    }
    const VectorXd in_joints = lift_water(scene, model);
    stages.before_uplift = sum;
    if (in_joints.size() > 0) stages.before_uplift += in_joints;
    if (in_rock.size() > 0) stages.before_uplift += in_rock;
    if (!uplift.empty() || in_joints.size() > 0 || in_rock.size() > 0) {
        stages.names.push_back("uplift");
        stages.loads.push_back(uplift.empty() ? stages.before_uplift : load_with(stages, model, uplift));
    }
    return stages;
}

VectorXd load_with(const LoadStages& stages, const Model& model, const PressureProfile& uplift)
{
    if (uplift.empty()) return stages.last();
    VectorXd sum = stages.before_uplift;
    for (const ContactSide side : {ContactSide::dam, ContactSide::rock})
        if (side == ContactSide::dam || !defect(Defect::uplift_on_one_face))
            sum += uplift_load(model.mesh, model.dofs, uplift, side);
    return sum;
}

void let_water_ride(const ContactStructure& structure, const PressureProfile& uplift, SplitLoad& load)
{
    if (!structure.slides_far() || uplift.empty()) return;
    const Model& model = structure.model();
    const VectorXd on_dam = uplift_load(model.mesh, model.dofs, uplift, ContactSide::dam);
    const VectorXd on_rock = uplift_load(model.mesh, model.dofs, uplift, ContactSide::rock);
    const VectorXd dam = structure.to_order(on_dam);
    load.joint = -(structure.planes().gaps() * dam.tail(2 * structure.interface()));
    load.rock -= structure.split(on_rock).rock;
}

namespace {

StageStatus judge(const BaseResultant& r, double resistance, double length)
{
    if (!(r.normal_force > 0.0)) return StageStatus::floats;
    if (std::abs(r.shear_force) > resistance) return StageStatus::slides;
    if (r.position < 0.0 || r.position > length) return StageStatus::overturns;
    return StageStatus::ok;
}

std::string plane_name(const ContactStructure& structure, Index index)
{
    if (index == 0) return "base";
    const Mesh& mesh = structure.model().mesh;
    const int node = mesh.lifts[static_cast<std::size_t>(index - 1)].upper_nodes.front();
    return fmt::format("lift joint at {:.6g} m", mesh.nodes[node].y - mesh.nodes[mesh.contact.dam_nodes.front()].y);
}

/// Resultants against the strength of the whole plane: cohesion on all of it, the weakest friction.
PlaneBalance balance(const ContactStructure& structure, Index index, const VectorXd& dam_load, const ContactLaw& law)
{
    const Index first = structure.planes().first(index), pairs = structure.planes()[index].pairs();
    PlaneBalance result;
    result.plane = plane_name(structure, index);
    result.resultant = base_resultant(structure, dam_load, index);
    const double normal = result.resultant.normal_force, shear = std::abs(result.resultant.shear_force);
    const double cohesion = law.cohesion.segment(first, pairs).sum(),
                 resistance = law.friction.segment(first, pairs).minCoeff() * normal + cohesion;
    result.critical_friction = std::max(0.0, shear - cohesion) / normal;
    // A balance of the loads on the dam alone: round-off of sums of order N' is not a shear force.
    result.sliding_factor =
        shear > 1e-12 * std::abs(normal) ? resistance / shear : std::numeric_limits<double>::infinity();
    result.status = judge(result.resultant, resistance, structure.planes()[index].length());
    return result;
}

void read_state(const ContactPlanes& planes, Index index, const ContactMemory& memory, PlaneBalance& result)
{
    const Index first = planes.first(index);
    const Plane& plane = planes[index];
    result.slip = planes.mean(index, memory.slip);
    for (Index i = 0; i < plane.pairs(); ++i) {
        const ContactState state = memory.states[static_cast<std::size_t>(first + i)];
        if (state == ContactState::open) result.open_length += plane.area[i];
        if (is_slip(state)) result.slipping_length += plane.area[i];
    }
}

} // namespace

StageResult solve_stage(StaticContact& statics, const ContactStructure& structure, const std::string& name,
                        const SplitLoad& load, Strength& strength, ContactMemory& memory)
{
    const ContactPlanes& planes = structure.planes();
    const ContactLaw& law = strength.law();
    StageResult result;
    result.name = name;
    static_cast<PlaneBalance&>(result) = balance(structure, 0, load.dam, law);
    result.base_fails = result.status != StageStatus::ok;
    for (Index k = 1; k < planes.count(); ++k) {
        result.lifts.push_back(balance(structure, k, load.dam, law));
        if (result.status == StageStatus::ok) result.status = result.lifts.back().status;
    }
    if (result.status != StageStatus::ok) return result;

    ContactMemory trial = memory;
    result.contact = statics.solve(load, law, trial);
    if (!result.contact.resolved()) {
        result.status = StageStatus::not_resolved;
        return result;
    }
    memory = std::move(trial);
    strength.follow(memory);
    read_state(planes, 0, memory, result);
    for (Index k = 1; k < planes.count(); ++k)
        read_state(planes, k, memory, result.lifts[static_cast<std::size_t>(k - 1)]);
    return result;
}

Status status_of(StageStatus stage)
{
    switch (stage) {
    case StageStatus::slides:
        return Status::static_failure;
    case StageStatus::floats:
        return Status::floats;
    case StageStatus::overturns:
        return Status::overturns;
    case StageStatus::ok:
    case StageStatus::not_resolved:
        break;
    }
    return Status::not_resolved;
}

std::string StageResult::text() const
{
    const PlaneBalance* weakest = this; // the base where it fails, else the first joint that does
    for (const PlaneBalance& lift : lifts)
        if (!base_fails && weakest == this && lift.status != StageStatus::ok) weakest = &lift;
    const bool is_base = weakest == this;
    const BaseResultant& r = weakest->resultant;
    const std::string forces =
        fmt::format("N' = {:.5g} MN/m, T = {:.5g} MN/m", 1e-6 * r.normal_force, 1e-6 * r.shear_force);
    const std::string body = is_base ? "the dam" : "what is above the " + weakest->plane;
    switch (status) {
    case StageStatus::ok:
        return fmt::format("{}: in equilibrium, {}, mean slip {:.3g} mm, open length {:.3g} m, mu needed {:.5f}.", name,
                           forces, 1e3 * slip, open_length, critical_friction);
    case StageStatus::slides:
        return fmt::format("{}: {} slides without any earthquake, {}: it holds with mu >= {:.5f}.", name, body, forces,
                           weakest->critical_friction);
    case StageStatus::floats:
        return fmt::format("{}: {} floats, {}: uplift exceeds all weight.", name, body, forces);
    case StageStatus::overturns:
        return fmt::format("{}: {} overturns, {}: the resultant acts {:.5g} m from the {}, outside the {}.", name, body,
                           forces, r.position, is_base ? "heel" : "upstream face", is_base ? "base" : "joint");
    case StageStatus::not_resolved:
        return fmt::format(
            "{}: not resolved: the solver found no contact state in {} iterations, which says nothing of the dam; "
            "{}, mu needed by these resultants {:.5f}.",
            name, contact.iterations, forces, critical_friction);
    }
    return {};
}

} // namespace damslip::fe2d
