#include "fe2d/model/model.hpp"

#include "core/input_error.hpp"
#include "scene/planes.hpp"
#include "scene/rock_mass.hpp"
#include "scene/section.hpp"
#include "scene/water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <utility>

namespace damslip::fe2d {

namespace {

/// Non-zeros of the stiffness matrix of the dam alone.
std::int64_t dam_nonzeros(const Model& model)
{
    return assemble(model.mesh, model.dofs,
                    [&](const Element& element, const Corners&) -> ElementMatrix {
                        if (element.region != Region::dam) return {};
                        const int unknowns = 2 * element.all().count;
                        return ElementMatrix::Ones(unknowns, unknowns);
                    })
        .nonZeros();
}

ModelCounts count(const Model& model)
{
    const Mesh& mesh = model.mesh;
    const std::int64_t dam_unknowns = dam_dof_count(mesh, model.dofs), dam_stiffness = dam_nonzeros(model);
    const std::int64_t dam_mass = std::min<std::int64_t>(model.mass.nonZeros(), dam_stiffness);
    const auto curtain = std::count_if(mesh.elements.begin(), mesh.elements.end(),
                                       [](const Element& e) { return e.region == Region::curtain; });
    ModelCounts counts;
    counts.add({"dam", mesh.dam_element_count, dam_unknowns, dam_stiffness + dam_mass});
    if (mesh.has_rock())
        counts.add({"foundation", mesh.element_count() - mesh.dam_element_count - curtain,
                    model.dofs.count - dam_unknowns,
                    model.stiffness.nonZeros() - dam_stiffness + model.mass.nonZeros() - dam_mass});
    if (curtain > 0) counts.add({"curtain", curtain, 0, 0});
    if (model.added_mass.nonZeros() > 0) counts.add({"added mass", 0, 0, model.added_mass.nonZeros()});
    return counts;
}

void assemble_water(const Scene& scene, const AddedMassLaw& law, Model& model)
{
    model.added_mass.resize(model.dofs.count, model.dofs.count);
    if (!scene.reservoir || !law) return;
    const double level = scene.reservoir->level;
    const NodeChain& face = model.mesh.upstream_face;
    model.added_mass = added_mass_matrix(model.mesh, model.dofs, face, law, level);
    model.inertia_x += added_mass_inertia(model.mesh, model.dofs, face, law, level, {1.0, 0.0});
    model.inertia_y += added_mass_inertia(model.mesh, model.dofs, face, law, level, {0.0, 1.0});
    const DofMap all = all_dofs(model.mesh, 2);
    for (const int c : {0, 1}) {
        const Eigen::Vector2d direction = Eigen::Vector2d::Unit(c);
        const Eigen::VectorXd water = added_mass_inertia(model.mesh, all, face, law, level, direction);
        for (int i = c; i < water.size(); i += 2) model.total_mass[c] += water[i];
    }
}

/// Imported sides have the nodes they have.
void check_facing(const Scene& scene, const Model& model, Base base)
{
    const ContactPlane& plane = model.mesh.contact;
    if (base != Base::tied || plane.matching) return;
    throw InputError(Diagnostic{
        .file = scene.mesh.file ? scene.mesh.file->string() : scene.file.string(),
        .problem = fmt::format("the {} nodes of the dam's base and the {} of the rock's do not face each other.",
                               plane.dam_nodes.size(), plane.rock_nodes.size()),
        .expected = "the same nodes on both sides for a tied base, which natural modes and damping by modes have",
        .fix = "let dam and rock share the curve from heel to toe; or give damping.mass_coefficient_1_s and "
               "damping.stiffness_coefficient_s and run with contact"});
}

void assemble_mass(const Scene& scene, const ModelOptions& options, Model& model)
{
    const int n = model.dofs.count;
    const Materials dam = without_rock_density(model.materials);
    model.mass = mass_matrix(model.mesh, model.dofs, dam, options.mass);
    model.rock_mass.resize(n, n);
    model.edge_damping.resize(n, n);
    model.loaded = dam;
    if (!rock_is_boxed(scene)) return;
    Materials rock = model.materials;
    rock.dam.density = 0.0;
    model.rock_mass = mass_matrix(model.mesh, model.dofs, rock, options.mass);
    model.mass += model.rock_mass;
    if (options.edges == RockEdges::free)
        model.edge_damping = edge_dashpots(model.mesh, model.dofs, model.materials.rock);
    else
        model.loaded = model.materials;
}

/// What k0 adds to the horizontal stress of elastic rock between fixed sides, under the weight of the column above.
Eigen::VectorXd locked_stress(const Scene& scene, const Model& model)
{
    const Material& rock = scene.foundation->material;
    const double elastic = rock.poisson_ratio / (1.0 - rock.poisson_ratio), more = *scene.foundation->k0 - elastic;
    const Polyline ground = ground_line(scene);
    Eigen::VectorXd stress = Eigen::VectorXd::Zero(model.mesh.node_count());
    for (const Element& element : model.mesh.elements)
        if (element.region != Region::dam)
            for (const int node : element.all()) {
                const Point p = model.mesh.nodes[static_cast<std::size_t>(node)];
                stress[node] = -more * rock.density * scene.gravity * std::max(0.0, ground_level(ground, p.x) - p.y);
            }
    return stress;
}

/// A tied base shares the unknowns of facing nodes.
Scene with_facing_nodes(Scene scene)
{
    scene.mesh.rock_contact_size.reset();
    return scene;
}

} // namespace

Model build_model(const Scene& scene, const ModelOptions& options)
{
    return build_model_on(build_mesh(options.base == Base::tied ? with_facing_nodes(scene) : scene, options.extension),
                          scene, options);
}

Model build_model_on(Mesh mesh, const Scene& scene, const ModelOptions& options)
{
    Model model;
    model.materials = materials_of(scene);
    model.mesh = std::move(mesh);
    set_shares(model.mesh, scene.section, scene.lift_joints);
    check_facing(scene, model, options.base);
    model.dofs = displacement_dofs(model.mesh, options.base, options.edges);
    model.stiffness = stiffness_matrix(model.mesh, model.dofs, model.materials);
    model.mass_kind = options.mass;
    if (scene.seam_body && scene.foundation->k0) model.locked_stress = locked_stress(scene, model);
    assemble_mass(scene, options, model);
    model.inertia_x = inertia_vector(model.mesh, model.dofs, model.loaded, {1.0, 0.0}, options.mass);
    model.inertia_y = inertia_vector(model.mesh, model.dofs, model.loaded, {0.0, 1.0}, options.mass);
    const Eigen::VectorXd all = inertia_vector(model.mesh, all_dofs(model.mesh, 2), model.loaded, {1.0, 0.0});
    model.total_mass.setConstant(all.sum());
    assemble_water(scene, options.added_mass, model);
    model.counts = count(model);
    return model;
}

SparseMatrix Model::moving_mass() const
{
    return mass + added_mass;
}

SparseMatrix Model::dam_mass() const
{
    return rock_mass.nonZeros() > 0 ? SparseMatrix(mass - rock_mass) : mass;
}

void ModelCounts::add(EffectCount effect)
{
    constexpr std::int64_t entry_bytes = sizeof(double) + sizeof(int), vectors = 4;
    effect.bytes =
        entry_bytes * effect.nonzeros + vectors * static_cast<std::int64_t>(sizeof(double)) * effect.unknowns;
    elements += effect.elements;
    unknowns += effect.unknowns;
    nonzeros += effect.nonzeros;
    bytes += effect.bytes;
    effects.push_back(std::move(effect));
}

ElasticWaves elastic_waves(const ElasticMaterial& material)
{
    const double e = material.young_modulus, nu = material.poisson_ratio, rho = material.density;
    return {std::sqrt(e * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu) * rho)), std::sqrt(e / (2.0 * (1.0 + nu) * rho))};
}

SparseMatrix edge_dashpots(const Mesh& mesh, const DofMap& dofs, const ElasticMaterial& rock)
{
    const ElasticWaves c = elastic_waves(rock);
    Eigen::VectorXd diagonal = Eigen::VectorXd::Zero(dofs.count);
    const auto add = [&](const NodeChain& chain, int across) {
        for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
            const Point a = mesh.nodes[static_cast<std::size_t>(chain[i])],
                        b = mesh.nodes[static_cast<std::size_t>(chain[i + 1])];
            const double length = std::hypot(b.x - a.x, b.y - a.y);
            const int mid = mid_node(mesh, chain[i], chain[i + 1]);
            const double share = mid < 0 ? 0.5 : 1.0 / 6.0; // row sums of the edge's mass matrix
            for (const auto& [node, part] :
                 {std::pair{chain[i], share}, {chain[i + 1], share}, {mid, 1.0 - 2.0 * share}})
                for (const int component : {0, 1}) {
                    if (node < 0) continue;
                    if (const int dof = dofs(node, component); dof != no_dof)
                        diagonal[dof] += part * length * rock.density * (component == across ? c.p : c.s);
                }
        }
    };
    add(mesh.box_left, 0);
    add(mesh.box_right, 0);
    add(mesh.box_bottom, 1);
    std::vector<Eigen::Triplet<double>> entries;
    for (int dof = 0; dof < dofs.count; ++dof)
        if (diagonal[dof] != 0.0) entries.emplace_back(dof, dof, diagonal[dof]);
    SparseMatrix matrix(dofs.count, dofs.count);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

HeldStart held_edges(const Model& fixed, const Model& free, const Eigen::VectorXd& displacement,
                     const Eigen::VectorXd& load)
{
    const Eigen::Index n = free.dofs.count;
    HeldStart start{Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
    for (std::size_t i = 0; i < free.dofs.dofs.size(); ++i) {
        const int from = fixed.dofs.dofs[i], to = free.dofs.dofs[i];
        if (from == no_dof || to == no_dof) continue;
        start.displacement[to] = displacement[from];
        start.load[to] = load[from];
    }
    const Eigen::VectorXd internal = free.stiffness * start.displacement;
    for (std::size_t i = 0; i < free.dofs.dofs.size(); ++i)
        if (const int to = free.dofs.dofs[i]; to != no_dof && fixed.dofs.dofs[i] == no_dof)
            start.load[to] = internal[to];
    return start;
}

Eigen::VectorXd without_edges(const Model& fixed, const Model& free, const Eigen::VectorXd& displacement)
{
    Eigen::VectorXd result = Eigen::VectorXd::Zero(fixed.dofs.count);
    for (std::size_t i = 0; i < fixed.dofs.dofs.size(); ++i)
        if (const int to = fixed.dofs.dofs[i]; to != no_dof) result[to] = displacement[free.dofs.dofs[i]];
    return result;
}

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
