#include "fe2d/model/static_solution.hpp"

#include "core/input_error.hpp"
#include "scene/planes.hpp"
#include "scene/water.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <functional>

namespace damslip::fe2d {

namespace {

/// Forces on the unknowns and the resultant over all nodes from one recipe.
StaticLoad make(std::string name, const Model& model, const std::function<Eigen::VectorXd(const DofMap&)>& recipe)
{
    StaticLoad load{.name = std::move(name), .force = recipe(model.dofs), .resultant = Eigen::Vector2d::Zero()};
    const Eigen::VectorXd all = recipe(all_dofs(model.mesh, 2));
    for (Eigen::Index i = 0; i < all.size(); ++i) load.resultant[i % 2] += all[i];
    return load;
}

StaticLoad water(std::string name, const Model& model, const NodeChain& chain, double level, double unit_weight)
{
    return make(std::move(name), model, [&](const DofMap& dofs) {
        return pressure_load(
            model.mesh, dofs, chain, [&](Point p) { return unit_weight * (level - p.y); }, level);
    });
}

StaticLoad weight(std::string name, const Scene& scene, const Model& model, std::vector<Region> regions)
{
    return make(std::move(name), model, [&](const DofMap& dofs) {
        return gravity_load(model.mesh, dofs, model.materials, scene.gravity, regions);
    });
}

/// Silt thrust 1/2 K_s gamma' h^2 is horizontal: the pressure acts on the face's vertical projection.
StaticLoad silt(const Scene& scene, const Model& model)
{
    const Silt& s = *scene.silt;
    return make("silt", model, [&](const DofMap& dofs) {
        Eigen::VectorXd force = pressure_load(
            model.mesh, dofs, model.mesh.upstream_face,
            [&](Point p) { return s.pressure_coefficient * s.submerged_unit_weight * (s.level - p.y); }, s.level);
        for (int node = 0; node < model.mesh.node_count(); ++node)
            if (const int dof = dofs(node, 1); dof != no_dof) force[dof] = 0.0;
        return force;
    });
}

StaticLoad concentrated(const std::string& name, const Scene& scene, const Model& model, Point at,
                        const Eigen::Vector2d& force, const std::string& key)
{
    return make(name, model, [&](const DofMap& dofs) {
        const auto load = point_load(model.mesh, dofs, at, force);
        if (!load)
            throw InputError(
                Diagnostic{.file = scene.file.string(),
                           .problem = fmt::format("{} acts at ({:g}, {:g}) m, outside the dam.", key, at.x, at.y),
                           .expected = "a point of the section",
                           .fix = "move it to the face or into the dam"});
        return *load;
    });
}

/// Where the upstream face has the height y.
Point on_face(const Mesh& mesh, double y)
{
    const NodeChain& face = mesh.upstream_face;
    for (std::size_t i = 0; i + 1 < face.size(); ++i) {
        const Point a = mesh.nodes[face[i]], b = mesh.nodes[face[i + 1]];
        if (y > a.y || y < b.y) continue;
        return {a.x + (a.y - y) / (a.y - b.y) * (b.x - a.x), y};
    }
    return {mesh.nodes[face.front()].x, y}; // above the crest or below the heel: refused as outside the dam
}

void add_upstream_water(const Scene& scene, const Model& model, StaticLoads& loads)
{
    const double unit_weight = water_unit_weight(scene), level = scene.reservoir->level;
    loads.impounding.push_back(
        water("water on the upstream face", model, model.mesh.upstream_face, level, unit_weight));
    if ((scene.reservoir->floor_pressure || scene.seam_body) && model.mesh.has_rock())
        loads.impounding.push_back(water("water on the reservoir floor", model, model.mesh.floor, level, unit_weight));
}

void add_tailwater(const Scene& scene, const Model& model, StaticLoads& loads)
{
    const double unit_weight = water_unit_weight(scene), level = scene.tailwater->level;
    loads.impounding.push_back(
        water("tailwater on the downstream face", model, model.mesh.downstream_face, level, unit_weight));
    if (((scene.reservoir && scene.reservoir->floor_pressure) || scene.seam_body) && model.mesh.has_rock())
        loads.impounding.push_back(water("tailwater on the ground", model, model.mesh.ground, level, unit_weight));
}

/// What stands on the crest: each side's water once it is above its end of it, the higher of both. A crest that falls to one
/// side is wet from there before the dam is overtopped.
void add_crest_water(const Scene& scene, const Model& model, StaticLoads& loads)
{
    const Mesh& mesh = model.mesh;
    const double upstream = mesh.nodes[mesh.crest.back()].y, downstream = mesh.nodes[mesh.crest.front()].y;
    const double dry = std::min(upstream, downstream);
    double level = dry;
    if (scene.reservoir && !scene.gate && scene.reservoir->level > upstream)
        level = std::max(level, scene.reservoir->level);
    if (scene.tailwater && scene.tailwater->level > downstream) level = std::max(level, scene.tailwater->level);
    const double density = water_density(scene);
    if (level > dry)
        loads.impounding.push_back(water("water on the crest", model, mesh.crest, level, density * scene.gravity));
}

/// Thrust of the gates at the upstream end of the crest, and its moment there as a pressure that is linear over the crest and has no
/// resultant: the piers bring it in.
void add_gates(const Scene& scene, const Model& model, StaticLoads& loads)
{
    const Point sill = model.mesh.nodes[model.mesh.crest.back()], end = model.mesh.nodes[model.mesh.crest.front()];
    const double depth = scene.reservoir->level - sill.y, width = std::hypot(end.x - sill.x, end.y - sill.y);
    if (!(depth > 0.0)) return;
    const double thrust = 0.5 * water_unit_weight(scene) * depth * depth, moment = thrust * depth / 3.0;
    loads.impounding.push_back(concentrated("gates", scene, model, sill, {thrust, 0.0}, "gate"));
    loads.impounding.push_back(make("moment of the gates", model, [&](const DofMap& dofs) {
        return pressure_load(model.mesh, dofs, model.mesh.crest, [&](Point p) {
            const double from_middle = std::hypot(p.x - sill.x, p.y - sill.y) - 0.5 * width;
            return 12.0 * moment / (width * width * width) * from_middle;
        });
    }));
}

} // namespace

StaticLoads static_loads(const Scene& scene, const Model& model)
{
    StaticLoads loads;
    if (scene.seam_body)
        loads.rock.push_back(weight("weight of the rock", scene, model, {Region::rock, Region::block}));
    if (model.locked_stress.size() > 0)
        loads.rock.push_back(make("horizontal stress of the rock", model, [&](const DofMap& dofs) {
            return locked_stress_load(model.mesh, dofs, model.locked_stress);
        }));
    loads.gravity.push_back(weight("weight of the dam", scene, model, {Region::dam}));
    if (!scene.seam_body && scene.stages.gravity == GravityStage::dam_and_rock && model.mesh.has_rock())
        loads.gravity.push_back(weight("weight of the rock", scene, model, {Region::rock, Region::curtain}));
    if (scene.reservoir) add_upstream_water(scene, model, loads);
    if (scene.reservoir && scene.gate) add_gates(scene, model, loads);
    if (scene.tailwater) add_tailwater(scene, model, loads);
    add_crest_water(scene, model, loads);
    if (scene.silt) loads.impounding.push_back(silt(scene, model));
    if (scene.ice)
        loads.impounding.push_back(
            concentrated("ice", scene, model, on_face(model.mesh, scene.ice->level), {scene.ice->force, 0.0}, "ice"));
    for (const PointForce& force : scene.forces)
        loads.impounding.push_back(concentrated(force.name, scene, model, force.at, {force.force_x, force.force_y},
                                                "force \"" + force.name + "\""));
    return loads;
}

Eigen::VectorXd sum_of(const std::vector<StaticLoad>& loads, int unknowns)
{
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(unknowns);
    for (const StaticLoad& load : loads) sum += load.force;
    return sum;
}

PressureProfile lift_water_profile(const Scene& scene, const LiftJoint& joint, double length)
{
    if (!joint.pressures.empty()) {
        PressureProfile profile;
        for (const Point& p : joint.pressures) profile.points.push_back({p.x, p.y});
        return profile;
    }
    if (joint.water == JointWater::none) return {};
    // None between piers.
    const double unit_weight = water_unit_weight(scene) * share_above(scene.section, joint.elevation);
    const double upstream = scene.reservoir ? std::max(0.0, scene.reservoir->level - joint.elevation) : 0.0;
    const double downstream = scene.tailwater ? std::max(0.0, scene.tailwater->level - joint.elevation) : 0.0;
    if (upstream == 0.0 && downstream == 0.0) return {};
    return {{{0.0, unit_weight * upstream}, {length, unit_weight * downstream}}};
}

namespace {

/// Hydrostatic below a level, on both sides of a face.
void add_face_water(const Scene& scene, const Model& model, const SeamLine::Face& face, std::optional<double> level,
                    Eigen::VectorXd& sum)
{
    if (!level) return;
    const double unit_weight = water_unit_weight(scene);
    for (const NodeChain* chain : {&face.upstream, &face.downstream}) {
        if (chain->empty()) continue;
        if (sum.size() == 0) sum = Eigen::VectorXd::Zero(model.dofs.count);
        sum += pressure_load(
            model.mesh, model.dofs, *chain, [&](Point p) { return unit_weight * (*level - p.y); }, *level);
    }
}

} // namespace

Eigen::VectorXd lift_water(const Scene& scene, const Model& model)
{
    const std::vector<LiftJoint> joints = joints_of(scene);
    assert(joints.size() == model.mesh.lifts.size());
    Eigen::VectorXd sum;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const double length = model.mesh.lifts[i].distance.back();
        const PressureProfile profile = lift_water_profile(scene, joints[i], length);
        if (profile.empty()) continue;
        if (sum.size() == 0) sum = Eigen::VectorXd::Zero(model.dofs.count);
        sum += lift_water_load(model.mesh, model.dofs, i, profile);
    }
    if (!scene.seam_body) return sum;
    const SeamLine& seam = *model.mesh.seam;
    add_face_water(scene, model, seam.crack, scene.seam_body->crack_level, sum);
    add_face_water(scene, model, seam.end, scene.seam_body->end_level, sum);
    for (std::size_t i = 0; i < seam.interfaces.size(); ++i)
        add_face_water(scene, model, seam.interfaces[i], scene.seam_body->interface_levels[i], sum);
    return sum;
}

namespace {

Eigen::Vector2d resultant_of(const std::vector<StaticLoad>& loads)
{
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const StaticLoad& load : loads) sum += load.resultant;
    return sum;
}

} // namespace

StaticSolution solve_static(const Scene& scene, const Model& model, const StaticLoads& loads,
                            const SolverOptions& options)
{
    LinearSolver solver(options);
    StaticSolution solution{.solver = solver.factorise(model.stiffness), .stages = {}};
    if (!solution.solver.ok()) return solution;

    const int n = model.dofs.count;
    Eigen::VectorXd elastic = Eigen::VectorXd::Zero(n), reference = Eigen::VectorXd::Zero(n);
    Eigen::Vector2d resultant = Eigen::Vector2d::Zero();
    const auto stage = [&](const char* name, const std::vector<StaticLoad>& list) {
        if (list.empty()) return;
        elastic += solver.solve(sum_of(list, n));
        resultant += resultant_of(list);
        solution.stages.push_back({name, resultant, elastic - reference, elastic});
    };
    stage("gravity", loads.gravity);
    if (scene.stages.geostatic) {
        reference = elastic;
        if (!solution.stages.empty()) solution.stages.back().displacement.setZero();
    }
    stage("impounding", loads.impounding);
    return solution;
}

Eigen::Matrix2Xd base_forces(const Model& model, const Eigen::VectorXd& displacement, const Eigen::VectorXd& dam_load)
{
    const DofMap all = all_dofs(model.mesh, 2);
    const Eigen::VectorXd u = nodal_values(model.dofs, displacement);
    const Eigen::VectorXd internal =
        assemble_vector(model.mesh, all, [&](const Element& element, const Corners& c) -> ElementVector {
            if (element.region != Region::dam) return {};
            const ElementNodes nodes = element.all();
            ElementVector ue(2 * nodes.count);
            for (int i = 0; i < nodes.count; ++i) ue.segment<2>(2 * i) = u.segment<2>(2 * nodes[i]);
            return elastic_stiffness(c, element.size(), element.share * plane_strain_matrix(model.materials.dam),
                                     model.materials.kind, extra_nodes(element)) *
                   ue;
        });
    const std::vector<int>& nodes = model.mesh.contact.dam_nodes;
    Eigen::Matrix2Xd forces(2, static_cast<Eigen::Index>(nodes.size()));
    for (std::size_t i = 0; i < nodes.size(); ++i)
        forces.col(static_cast<Eigen::Index>(i)) =
            internal.segment<2>(2 * nodes[i]) - dam_load.segment<2>(2 * nodes[i]);
    return forces;
}

StressField stress_field(const Mesh& mesh, const DofMap& dofs, const Materials& materials,
                         const Eigen::VectorXd& displacement)
{
    const Eigen::VectorXd u = nodal_values(dofs, displacement);
    StressField field{.nodal = Eigen::Matrix3Xd::Zero(3, mesh.node_count()),
                      .centre = Eigen::Matrix3Xd::Zero(3, mesh.element_count())};
    Eigen::VectorXi elements_at = Eigen::VectorXi::Zero(mesh.node_count());
    for (int e = 0; e < mesh.element_count(); ++e) {
        const Element& element = mesh.elements[e];
        const int size = element.size();
        const ElementNodes nodes = element.all();
        const ExtraNodes extra = extra_nodes(element);
        ElementVector ue(2 * nodes.count);
        for (int i = 0; i < nodes.count; ++i) ue.segment<2>(2 * i) = u.segment<2>(2 * nodes[i]);
        const Eigen::Matrix3d d = plane_strain_matrix(materials.of(element.region));
        const Corners c = corners(mesh, element);
        const auto at_nodes = nodal_stress(c, size, d, materials.kind, ue, extra);
        field.centre.col(e) = centre_stress(c, size, d, materials.kind, ue, extra);
        for (int i = 0; i < nodes.count; ++i) {
            field.nodal.col(nodes[i]) += at_nodes.col(i);
            ++elements_at[nodes[i]];
        }
    }
    for (int n = 0; n < mesh.node_count(); ++n)
        if (elements_at[n] > 0) field.nodal.col(n) /= elements_at[n];
    return field;
}

StressField stress_field(const Model& model, const Eigen::VectorXd& displacement)
{
    StressField field = stress_field(model.mesh, model.dofs, model.materials, displacement);
    const Eigen::VectorXd& locked = model.locked_stress;
    if (locked.size() == 0) return field;
    field.nodal.row(0) += locked.transpose();
    for (int e = 0; e < model.mesh.element_count(); ++e) {
        const Element& element = model.mesh.elements[static_cast<std::size_t>(e)];
        for (int i = 0; i < element.size(); ++i)
            field.centre(0, e) += locked[element.nodes[static_cast<std::size_t>(i)]] / element.size();
    }
    return field;
}

PrincipalStress principal_stress(const Eigen::Vector3d& stress)
{
    const double mean = 0.5 * (stress[0] + stress[1]), half = 0.5 * (stress[0] - stress[1]);
    const double radius = std::hypot(half, stress[2]);
    return {mean + radius, mean - radius, 0.5 * std::atan2(stress[2], half)};
}

} // namespace damslip::fe2d
