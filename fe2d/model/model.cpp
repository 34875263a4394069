#include "fe2d/model/model.hpp"

#include "core/input_error.hpp"
#include "fe2d/model/edge_dashpots.hpp"
#include "scene/rock_mass.hpp"

#include <fmt/format.h>

#include <algorithm>

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
    check_facing(scene, model, options.base);
    model.dofs = displacement_dofs(model.mesh, options.base, options.edges);
    model.stiffness = stiffness_matrix(model.mesh, model.dofs, model.materials);
    model.mass_kind = options.mass;
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

} // namespace damslip::fe2d
