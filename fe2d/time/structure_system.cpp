#include "fe2d/time/structure_system.hpp"

#include "fe2d/fluid/fluid_model.hpp"
#include "records/measure/measures.hpp"

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

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// B, or B' with a floor.
SparseMatrix selection(std::span<const Index> unknowns, Index size, const WaterFloor& floor)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (const Index unknown : unknowns) entries.emplace_back(static_cast<Index>(entries.size()), unknown, 1.0);
    for (const Index unknown : floor.unknowns)
        entries.emplace_back(static_cast<Index>(entries.size()), unknown, floor.scale);
    SparseMatrix map(static_cast<Index>(entries.size()), size);
    map.setFromTriplets(entries.begin(), entries.end());
    return map;
}

} // namespace

BaseCoupling::BaseCoupling(std::unique_ptr<MovingBase> base, const StepOperator& dam, std::span<const Index> unknowns,
                           Index size, WaterFloor floor)
    : base_(std::move(base)), floor_(std::move(floor)), constants_(dam.constants()),
      map_(selection(unknowns, size, floor_)), alpha_(constants_.scheme.alpha), dam_(dam.flexibility(map_)),
      force_(VectorXd::Zero(map_.rows())), force_before_(force_)
{
    const MatrixXd& compliance = base_->compliance();
    assert(compliance.rows() == map_.rows());
    if (floor_.unknowns.empty()) {
        factor_.compute(dam_.delassus + (1.0 + alpha_) * compliance);
        return;
    }
    const Index all = map_.rows(), n = base_->floor(), b = all - n;
    assert(n == static_cast<Index>(floor_.unknowns.size()));
    const double w = 1.0 + alpha_, a1 = constants_.a1;
    to_weighted_ = MatrixXd::Zero(all, all);
    to_weighted_.diagonal().head(b).array() = -w;
    to_weighted_.bottomRows(n) = (w * a1) * dam_.delassus.bottomRows(n);
    const MatrixXd of_base = compliance * to_weighted_;
    MatrixXd matrix(all, all);
    matrix.topRows(b) = dam_.delassus.topRows(b) - of_base.topRows(b);
    matrix.bottomRows(n) = -a1 * of_base.bottomRows(n);
    matrix.bottomRightCorner(n, n).diagonal().array() += 1.0;
    with_floor_.compute(matrix);
    pressure_ = pressure_before_ = VectorXd::Zero(n);
}

InterfaceForces BaseCoupling::step_with_floor(const FreeStep& free, const State& before)
{
    const Index n = base_->floor(), b = map_.rows() - n;
    const double w = 1.0 + alpha_, a1 = constants_.a1, a4 = constants_.a4, a5 = constants_.a5;
    const VectorXd own = base_->begin_step(), of_dam = map_ * free.increment,
                   pressure_rate = (map_ * before.acceleration).tail(n), rate = base_->floor_velocity(),
                   acceleration = base_->floor_acceleration();
    VectorXd known(b + n); // p̃ for x = 0
    known << alpha_ * force_.head(b),
        w * (a1 * of_dam.tail(n) - a4 * pressure_ - a5 * pressure_rate) - alpha_ * pressure_;
    const VectorXd moved = own + base_->compliance() * known;
    VectorXd right(b + n);
    right << moved.head(b) - of_dam.head(b), a1 * moved.tail(n) - a4 * rate - a5 * acceleration;
    const VectorXd x = with_floor_.solve(right);
    const VectorXd weighted = known + to_weighted_ * x;
    base_->end_step(weighted);

    InterfaceForces forces{map_.transpose() * x, dam_.response * x};
    const VectorXd step = map_ * (free.increment + w * forces.displacement);
    const VectorXd pressure = a1 * step.tail(n) - a4 * pressure_ - a5 * pressure_rate;
    const VectorXd volume = (x.tail(n) + a4 * rate + a5 * acceleration) / a1;
    floor_work_ = 0.5 * volume.dot(pressure + pressure_);
    numerical_work_ =
        0.5 * alpha_ * (step.head(b).dot(x.head(b) - force_before_.head(b)) - volume.dot(pressure - pressure_before_)) +
        0.5 * step.tail(n).dot(x.tail(n) + rate) - floor_work_;
    force_before_ = force_;
    force_ = x;
    pressure_before_ = pressure_;
    pressure_ = pressure;
    return forces;
}

InterfaceForces BaseCoupling::step(const FreeStep& free, const State& before)
{
    if (!floor_.unknowns.empty()) return step_with_floor(free, before);
    VectorXd gap = base_->begin_step();
    if (alpha_ != 0.0) gap += alpha_ * (base_->compliance() * force_);
    gap -= map_ * free.increment;
    const VectorXd force = factor_.solve(gap);
    base_->end_step(alpha_ * force_ - (1.0 + alpha_) * force);

    InterfaceForces forces{map_.transpose() * force, dam_.response * force};
    const VectorXd step = map_ * (free.increment + (1.0 + alpha_) * forces.displacement);
    numerical_work_ = 0.5 * alpha_ * step.dot(force - force_before_);
    force_before_ = force_;
    force_ = force;
    return forces;
}

namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

/// The corner of `first` size of one matrix and, behind it, another one times a factor.
SparseMatrix corner_and(const SparseMatrix& matrix, Index first, const SparseMatrix& second, double factor)
{
    Triplets entries;
    for (Index j = 0; j < first; ++j)
        for (SparseMatrix::InnerIterator entry(matrix, j); entry; ++entry)
            if (entry.row() < first) entries.emplace_back(entry.row(), j, entry.value());
    for (Index j = 0; j < second.outerSize(); ++j)
        for (SparseMatrix::InnerIterator entry(second, j); entry; ++entry)
            entries.emplace_back(first + entry.row(), first + j, factor * entry.value());
    SparseMatrix result(first + second.rows(), first + second.rows());
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

} // namespace

CoupledEnergy::CoupledEnergy(const CoupledSystem& system, const FluidModel& water,
                             const SparseMatrix& structure_damping)
    : structure_(system.structure_unknowns), mesh_(water.mesh_unknowns)
{
    const double s2 = system.scale * system.scale;
    mass_ = corner_and(system.mass, structure_, water.body_mass, s2);
    stiffness_ = corner_and(system.stiffness, structure_, water.body_stiffness, s2);
    damping_ = corner_and(structure_damping, structure_, SparseMatrix(water.unknowns(), water.unknowns()), 1.0);
    coupling_ = system.damping.topRightCorner(structure_, system.water_unknowns); // -sH
    taken_mass_ = s2 * SparseMatrix((water.mass - water.body_mass).topRows(mesh_));
    taken_damping_ = s2 * SparseMatrix(water.damping.topRows(mesh_));
    taken_stiffness_ = s2 * SparseMatrix((water.stiffness - water.body_stiffness).topRows(mesh_));
}

State CoupledEnergy::view(const State& state) const
{
    State view = state;
    const auto turn = [this](VectorXd& values) {
        values.segment(structure_, mesh_) *= -1.0;
        values.tail(values.size() - structure_ - mesh_).setZero();
    };
    view.momentum = mass_ * state.velocity;
    view.inertia_force = mass_ * state.acceleration;
    view.stiffness_force = stiffness_ * state.displacement;
    view.damping_force = damping_ * state.velocity;
    turn(view.load);
    turn(view.unbalanced);
    turn(view.unbalanced_before);
    return view;
}

InterfaceWork CoupledEnergy::work(const State& before, const State& after) const
{
    const Index water = coupling_.cols();
    const VectorXd step = after.displacement - before.displacement;
    const VectorXd velocity = 0.5 * (before.velocity + after.velocity);
    const VectorXd acceleration = 0.5 * (before.acceleration + after.acceleration).tail(water),
                   potential = 0.5 * (before.displacement + after.displacement).tail(water);
    InterfaceWork work;
    work.radiated =
        step.segment(structure_, mesh_)
            .dot(taken_mass_ * acceleration + taken_damping_ * velocity.tail(water) + taken_stiffness_ * potential);
    work.numerical = step.head(structure_).dot(coupling_ * velocity.tail(water)) -
                     velocity.head(structure_).dot(coupling_ * step.tail(water));
    return work;
}

} // namespace damslip::fe2d
