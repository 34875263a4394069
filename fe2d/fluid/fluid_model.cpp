#include "fe2d/fluid/fluid_model.hpp"

#include "fe2d/element/elastic.hpp"
#include "fe2d/fluid/coupled_system.hpp"
#include "scene/rock_mass.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <utility>

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

double FluidOptions::sound_speed() const
{
    return std::sqrt(bulk_modulus / density);
}

FluidOptions fluid_options(const Scene& scene)
{
    assert(scene.reservoir);
    const Reservoir& water = *scene.reservoir;
    FluidOptions options;
    options.density = water.density;
    options.bulk_modulus = water.bulk_modulus;
    options.gravity = scene.gravity;
    options.surface = water.surface;
    options.far_end = water.far_end;
    options.bottom_motion = water.bottom_motion;
    options.bottom_reflection =
        water.bottom_density && water.bottom_modulus
            ? reflection_of_bottom(water.density, options.sound_speed(), *water.bottom_density, *water.bottom_modulus)
            : water.bottom_reflection;
    if (water.floor == ReservoirFloor::rock && scene.foundation) options.bottom_reflection = rock_reflection(scene);
    options.floor_on_rock = floor_on_rock(scene);
    return options;
}

double wave_admittance(double density, double sound_speed, double reflection)
{
    return (1.0 - reflection) / ((1.0 + reflection) * density * sound_speed);
}

double reflection_of_bottom(double density, double sound_speed, double bottom_density, double bottom_modulus)
{
    const double impedance = std::sqrt(bottom_modulus * bottom_density), water = density * sound_speed;
    return (impedance - water) / (impedance + water);
}

namespace {

/// An edge of one side, going up.
struct Edge {
    int lower = 0, upper = 0, mid = -1; ///< nodes; mid: of a quadratic edge
    Point a, b;                         ///< places of the lower and the upper one

    double share_of_upper(double y) const { return (y - a.y) / (b.y - a.y); }
    std::array<std::pair<int, double>, 3> shape(double t) const ///< nodes with N at a share t of the way up
    {
        if (mid < 0) return {{{lower, 1.0 - t}, {upper, t}, {-1, 0.0}}};
        return {{{lower, (1.0 - t) * (1.0 - 2.0 * t)}, {upper, t * (2.0 * t - 1.0)}, {mid, 4.0 * t * (1.0 - t)}}};
    }
};

std::vector<Edge> edges_upwards(const Mesh& mesh, const NodeChain& chain)
{
    std::vector<Edge> edges;
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
        int lower = chain[k], upper = chain[k + 1];
        if (mesh.nodes[lower].y > mesh.nodes[upper].y) std::swap(lower, upper);
        edges.push_back({lower, upper, mid_node(mesh, lower, upper), mesh.nodes[lower], mesh.nodes[upper]});
    }
    return edges;
}

} // namespace

SparseMatrix face_coupling(const Mesh& structure, const DofMap& displacements, const ReservoirMesh& water,
                           const DofMap& pressures, Index unknowns)
{
    std::vector<Eigen::Triplet<double>> entries;
    const std::vector<Edge> dam = edges_upwards(structure, structure.upstream_face);
    for (const Edge& wet : edges_upwards(water.mesh, water.face)) {
        const Eigen::Vector2d normal(1.0, -(wet.b.x - wet.a.x) / (wet.b.y - wet.a.y)); // n dS/dy
        for (const Edge& dry : dam) {
            const double low = std::max(wet.a.y, dry.a.y), high = std::min(wet.b.y, dry.b.y);
            if (!(high > low)) continue;
            for (const double sign : {-1.0, 1.0}) { // two points of Gauss: exact for linear N_f times quadratic N_s
                const double weight = 0.5 * (high - low), y = 0.5 * (low + high) + sign * weight / std::sqrt(3.0);
                const double eta = wet.share_of_upper(y), xi = dry.share_of_upper(y);
                for (const auto& [pressure_node, n_f] : {std::pair{wet.lower, 1.0 - eta}, std::pair{wet.upper, eta}})
                    for (const auto& [dam_node, n_s] : dry.shape(xi))
                        for (const int c : {0, 1}) {
                            if (dam_node < 0) continue;
                            const int row = displacements(dam_node, c), column = pressures(pressure_node);
                            if (row != no_dof && column != no_dof)
                                entries.emplace_back(row, column, weight * n_s * n_f * normal[c]);
                        }
            }
        }
    }
    SparseMatrix coupling(displacements.count, unknowns);
    coupling.setFromTriplets(entries.begin(), entries.end());
    return coupling;
}

Eigen::VectorXd boundary_flux(const Mesh& water, const DofMap& pressures, const NodeChain& chain,
                              const Eigen::Vector2d& direction, Index unknowns)
{
    Eigen::VectorXd flux = Eigen::VectorXd::Zero(unknowns);
    for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
        const Point a = water.nodes[chain[k]], b = water.nodes[chain[k + 1]];
        const double through = direction.x() * (b.y - a.y) - direction.y() * (b.x - a.x);
        for (const int node : {chain[k], chain[k + 1]})
            if (pressures(node) != no_dof) flux[pressures(node)] += 0.5 * through;
    }
    return flux;
}

} // namespace damslip::fe2d
