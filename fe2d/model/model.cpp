#include "fe2d/model/model.hpp"

#include "core/input_error.hpp"
#include "scene/planes.hpp"
#include "scene/rock_mass.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
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

} // namespace damslip::fe2d
