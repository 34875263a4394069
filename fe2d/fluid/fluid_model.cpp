#include "fe2d/fluid/fluid_model.hpp"

#include "fe2d/element/scalar.hpp"
#include "fe2d/fluid/absorbing_end.hpp"
#include "fe2d/fluid/face_coupling.hpp"

#include <cassert>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

std::vector<int> nodes_without_pressure(const ReservoirMesh& reservoir, const FluidOptions& options)
{
    std::vector<int> fixed;
    const auto add = [&fixed](const NodeChain& chain) { fixed.insert(fixed.end(), chain.begin(), chain.end()); };
    if (options.surface == WaterSurface::free) add(reservoir.surface);
    if (options.far_end == FarEnd::open) add(reservoir.far_end);
    if (options.bottom_reflection == -1.0) add(reservoir.bottom);
    return fixed;
}

/// ∫ value NN dS over a chain.
void add_chain_mass(const Mesh& mesh, const DofMap& dofs, const NodeChain& chain, double value, Triplets& entries)
{
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
        const Point a = mesh.nodes[chain[k]], b = mesh.nodes[chain[k + 1]];
        const double length = std::hypot(b.x - a.x, b.y - a.y);
        for (const int i : {chain[k], chain[k + 1]})
            for (const int j : {chain[k], chain[k + 1]})
                if (dofs(i) != no_dof && dofs(j) != no_dof)
                    entries.emplace_back(dofs(i), dofs(j), value * length * (i == j ? 1.0 / 3.0 : 1.0 / 6.0));
    }
}

EndColumn end_column(const FluidModel& model, double bottom_admittance)
{
    EndColumn column;
    for (const int node : model.reservoir.far_end) {
        column.y.push_back(model.reservoir.mesh.nodes[node].y);
        column.place.push_back(model.dofs(node));
    }
    column.bottom_admittance = bottom_admittance;
    if (model.options.surface == WaterSurface::sloshing)
        column.surface_mass = 1.0 / (model.options.density * model.options.gravity);
    if (model.options.bottom_motion == BottomMotion::ground) column.bottom_load = -1.0;
    return column;
}

SparseMatrix enlarged(const SparseMatrix& matrix, Index size)
{
    SparseMatrix larger = matrix;
    larger.conservativeResize(size, size);
    return larger;
}

SparseMatrix from_triplets(const Triplets& entries, Index size)
{
    SparseMatrix matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

} // namespace

FluidModel build_fluid(ReservoirMesh reservoir, const FluidOptions& options)
{
    assert(options.bottom_reflection >= -1.0 && options.bottom_reflection <= 1.0);
    FluidModel model;
    model.reservoir = std::move(reservoir);
    model.options = options;
    const ReservoirMesh& r = model.reservoir;
    const Region region[] = {Region::reservoir};
    model.dofs = scalar_dofs(r.mesh, region, nodes_without_pressure(r, options));
    model.mesh_unknowns = model.dofs.count;

    const SparseMatrix mass = assemble(r.mesh, model.dofs, [&](const Element& e, const Corners& corners) {
        return scalar_mass_matrix(corners, e.size(), 1.0 / options.bulk_modulus, extra_nodes(e));
    });
    const SparseMatrix stiffness = assemble(r.mesh, model.dofs, [&](const Element& e, const Corners& corners) {
        return scalar_gradient_matrix(corners, e.size(), 1.0 / options.density, extra_nodes(e));
    });

    FluidTriplets boundary;
    Triplets surface;
    if (options.surface == WaterSurface::sloshing)
        add_chain_mass(r.mesh, model.dofs, r.surface, 1.0 / (options.density * options.gravity), surface);
    const double c = options.sound_speed();
    const double admittance = options.bottom_reflection == -1.0 || options.bottom_reflection == 1.0
                                  ? 0.0
                                  : wave_admittance(options.density, c, options.bottom_reflection);
    if (admittance != 0.0 && !options.floor_on_rock)
        add_chain_mass(r.mesh, model.dofs, r.bottom, admittance, boundary.damping);
    if (options.far_end == FarEnd::damper)
        add_chain_mass(r.mesh, model.dofs, r.far_end, 1.0 / (options.density * c), boundary.damping);
    AbsorbingEnd end;
    if (options.far_end == FarEnd::absorbing) {
        end = absorbing_end(end_column(model, admittance), options, model.mesh_unknowns);
        for (const auto& [from, to] :
             {std::pair{&end.entries.mass, &boundary.mass}, std::pair{&end.entries.damping, &boundary.damping},
              std::pair{&end.entries.stiffness, &boundary.stiffness}})
            to->insert(to->end(), from->begin(), from->end());
    }
    model.layer_pressures = end.pressures;
    model.layer_momenta = end.momenta;
    const Index n = model.mesh_unknowns + end.pressures + end.momenta;
    model.body_mass = enlarged(mass, n) + from_triplets(surface, n);
    model.body_stiffness = enlarged(stiffness, n);
    model.mass = model.body_mass + from_triplets(boundary.mass, n);
    model.damping = from_triplets(boundary.damping, n);
    model.stiffness = model.body_stiffness + from_triplets(boundary.stiffness, n);

    if (options.floor_on_rock)
        for (const int node : r.bottom) model.floor.push_back(model.dofs(node));
    model.force_x = boundary_flux(r.mesh, model.dofs, r.face, {1.0, 0.0}, n);
    model.force_y = boundary_flux(r.mesh, model.dofs, r.face, {0.0, 1.0}, n);
    model.flux_x = model.force_x;
    model.flux_y = model.force_y;
    model.end_y = Eigen::VectorXd::Zero(n);
    if (options.bottom_motion == BottomMotion::ground) {
        model.flux_y += boundary_flux(r.mesh, model.dofs, r.bottom, {0.0, 1.0}, n);
        for (const auto& entry : end.acceleration_load) model.flux_y[entry.row()] += entry.value();
        for (const auto& entry : end.velocity_load) model.end_y[entry.row()] += entry.value();
    }
    return model;
}

FluidModel build_fluid(const Scene& scene)
{
    return build_fluid(build_reservoir_mesh(scene), fluid_options(scene));
}

} // namespace damslip::fe2d
