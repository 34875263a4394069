#include "fe2d/time/structure_system.hpp"

#include "fe2d/fluid/fluid_model.hpp"
#include "records/measure/response_spectrum.hpp"

#include <algorithm>
#include <cassert>
#include <numbers>
#include <numeric>

namespace damslip::fe2d {

using Eigen::Index;

namespace {

SparseMatrix upper_left(const SparseMatrix& matrix, Index size)
{
    return SparseMatrix(matrix.topLeftCorner(size, size));
}

/// Unknowns of the dam that share a stiffness entry with the rock's, ascending.
std::vector<Index> base_unknowns(const SparseMatrix& stiffness, Index dam_count)
{
    std::vector<char> shared(static_cast<std::size_t>(dam_count), 0);
    for (Index column = dam_count; column < stiffness.cols(); ++column)
        for (SparseMatrix::InnerIterator entry(stiffness, column); entry; ++entry)
            if (entry.row() < dam_count) shared[static_cast<std::size_t>(entry.row())] = 1;
    std::vector<Index> unknowns;
    for (Index k = 0; k < dam_count; ++k)
        if (shared[static_cast<std::size_t>(k)]) unknowns.push_back(k);
    return unknowns;
}

/// K of base and rock unknowns without its base-base block, which stays with the dam: condensing it gives what the rock adds.
SparseMatrix rock_stiffness(const SparseMatrix& stiffness, const std::vector<Index>& place, std::size_t base_count)
{
    std::vector<Index> to(static_cast<std::size_t>(stiffness.cols()), -1);
    for (std::size_t k = 0; k < place.size(); ++k) to[static_cast<std::size_t>(place[k])] = static_cast<Index>(k);
    const auto n_base = static_cast<Index>(base_count);
    std::vector<Eigen::Triplet<double>> entries;
    for (const Index column : place)
        for (SparseMatrix::InnerIterator entry(stiffness, column); entry; ++entry) {
            const Index i = to[static_cast<std::size_t>(entry.row())], j = to[static_cast<std::size_t>(column)];
            if (i >= 0 && (i >= n_base || j >= n_base)) entries.emplace_back(i, j, entry.value());
        }
    SparseMatrix rock(static_cast<Index>(place.size()), static_cast<Index>(place.size()));
    rock.setFromTriplets(entries.begin(), entries.end());
    return rock;
}

void condense_rock(const Model& model, double stiffness_coefficient, StructureSystem& structure)
{
    const Index dam_count = dam_dof_count(model.mesh, model.dofs);
    structure.base = base_unknowns(model.stiffness, dam_count);
    structure.rock_place = structure.base;
    for (Index k = dam_count; k < structure.full_size; ++k) structure.rock_place.push_back(k);
    std::vector<Index> kept(structure.base.size());
    std::iota(kept.begin(), kept.end(), 0);
    structure.rock.emplace(rock_stiffness(model.stiffness, structure.rock_place, structure.base.size()), kept);
    structure.solver = structure.rock->report();

    LinearSystem& system = structure.system;
    system.mass = upper_left(system.mass, dam_count);
    system.damping = upper_left(system.damping, dam_count);
    system.stiffness = upper_left(system.stiffness, dam_count);
    structure.damped_mass = upper_left(structure.damped_mass, dam_count);
    if (!structure.solver.ok()) return;
    add_dense_block(system.stiffness, structure.rock->stiffness(), structure.base, 1.0);
    if (stiffness_coefficient != 0.0)
        add_dense_block(system.damping, structure.rock->stiffness(), structure.base, stiffness_coefficient);
}

Eigen::VectorXd rock_part(const StructureSystem& structure, const Eigen::VectorXd& load)
{
    Eigen::VectorXd part = load(structure.rock_place);
    part.head(static_cast<Index>(structure.base.size())).setZero(); // loads on the base stay with the dam
    return part;
}

} // namespace

Eigen::VectorXd StructureSystem::reduce_load(const Eigen::VectorXd& load) const
{
    assert(load.size() == full_size);
    if (!rock) return load;
    Eigen::VectorXd reduced = load.head(system.size());
    reduced(base) += rock->condense_load(rock_part(*this, load));
    return reduced;
}

Eigen::VectorXd StructureSystem::expand(const Eigen::VectorXd& displacement, const Eigen::VectorXd& load) const
{
    if (!rock) return displacement;
    Eigen::VectorXd full(full_size);
    full.head(system.size()) = displacement;
    const Eigen::VectorXd at_base = displacement(base);
    const Eigen::VectorXd below = rock->recover(at_base, rock_part(*this, load));
    full.tail(full_size - system.size()) = below.tail(full_size - system.size());
    return full;
}

StructureSystem structure_system(const Model& model, const RayleighConstants& damping, RockTreatment rock)
{
    StructureSystem structure;
    structure.full_size = model.dofs.count;
    structure.solver.status = SolverStatus::ok;
    structure.damped_mass = model.dam_mass();
    structure.system.mass = model.moving_mass();
    structure.system.stiffness = model.stiffness;
    structure.system.damping = damping.mass * structure.damped_mass;
    structure.system.damping += damping.stiffness * model.stiffness;
    if (model.edge_damping.nonZeros() > 0) structure.system.damping += model.edge_damping;
    if (rock == RockTreatment::condensed && model.mesh.has_rock() && !model.rock_has_mass())
        condense_rock(model, damping.stiffness, structure);
    return structure;
}

LinearSystem dam_on_free_base(const Model& model, const RayleighConstants& damping)
{
    assert(!model.rock_has_mass());
    const Index n = dam_dof_count(model.mesh, model.dofs);
    LinearSystem system;
    system.mass = upper_left(model.moving_mass(), n);
    system.stiffness = upper_left(dam_stiffness_matrix(model.mesh, model.dofs, model.materials), n);
    system.damping = damping.mass * upper_left(model.dam_mass(), n);
    system.damping += damping.stiffness * system.stiffness;
    return system;
}

std::vector<Index> unknowns_of_base(const Model& model)
{
    assert(model.mesh.has_rock() && model.mesh.contact.matching);
    std::vector<Index> unknowns;
    for (const int node : model.mesh.contact.dam_nodes)
        for (const int component : {0, 1}) unknowns.push_back(model.dofs(node, component));
    return unknowns;
}

std::vector<ModalMass> modal_masses(const NaturalModes& modes)
{
    std::vector<ModalMass> masses;
    for (Index k = 0; k < modes.frequency.size(); ++k)
        masses.push_back({2.0 * std::numbers::pi * modes.frequency[k], modes.effective_mass(0, k)});
    return masses;
}

DampingChoice damping_of(const Scene& scene, const Model& model, const GroundMotion& motion)
{
    const int count = modes_needed(scene.damping);
    if (count == 0) return choose_damping(scene.damping, {}, model.total_mass.x(), {});
    const NaturalModes modes = natural_modes(model, count);
    if (modes.frequency.size() == 0) {
        DampingChoice none;
        none.mass = scene.damping.mass;
        none.notes.push_back({NoteKind::no_mode_to_damp, {text_of(modes.solver.note())}});
        return none;
    }
    const SpectralAcceleration spectrum = [&](double frequency, double ratio) {
        return records::peak_absolute_acceleration(motion.accel_h, motion.dt, frequency / (2.0 * std::numbers::pi),
                                                   ratio);
    };
    return choose_damping(scene.damping, modal_masses(modes), model.total_mass.x(), spectrum);
}

CoupledPencil coupled_pencil(const Model& model, const FluidModel& water)
{
    assert(model.added_mass.nonZeros() == 0);
    FluidOptions closed = water.options;
    closed.far_end = FarEnd::closed;
    closed.surface = WaterSurface::free;
    closed.bottom_reflection = 1.0;
    closed.bottom_motion = BottomMotion::still;
    const FluidModel basin = build_fluid(water.reservoir, closed);
    CoupledPencil pencil;
    pencil.stiffness = model.stiffness;
    pencil.mass = model.mass;
    pencil.coupling = face_coupling(model.mesh, model.dofs, basin.reservoir, basin.dofs, basin.unknowns());
    pencil.water_stiffness = basin.stiffness;
    pencil.water_mass = basin.mass;
    pencil.inertia_x = model.inertia_x;
    pencil.inertia_y = model.inertia_y;
    pencil.flux_x = basin.flux_x;
    pencil.flux_y = basin.flux_y;
    pencil.structure_mass = model.total_mass;
    return pencil;
}

std::vector<ModalMass> leading_modal_masses(const CoupledModes& modes, int count)
{
    std::vector<ModalMass> masses;
    for (const Eigen::Index k : leading_modes(modes, count))
        masses.push_back({2.0 * std::numbers::pi * modes.frequency[k], modes.effective_mass(0, k)});
    return masses;
}

DampingChoice damping_of(const Scene& scene, const Model& model, const FluidModel& water, const GroundMotion& motion)
{
    const int count = modes_needed(scene.damping);
    if (count == 0) return choose_damping(scene.damping, {}, model.total_mass.x(), {});
    return damping_of(scene, coupled_modes_up_to(coupled_pencil(model, water), 0.0, count), motion);
}

DampingChoice damping_of(const Scene& scene, const CoupledModes& modes, const GroundMotion& motion)
{
    const SpectralAcceleration spectrum = [&](double frequency, double ratio) {
        return records::peak_absolute_acceleration(motion.accel_h, motion.dt, frequency / (2.0 * std::numbers::pi),
                                                   ratio);
    };
    return choose_damping(scene.damping, leading_modal_masses(modes, modes_needed(scene.damping)), modes.total_mass.x(),
                          spectrum);
}

} // namespace damslip::fe2d
