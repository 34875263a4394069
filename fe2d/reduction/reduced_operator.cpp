#include "fe2d/reduction/reduced_operator.hpp"

#include "core/parallel.hpp"
#include "fe2d/reduction/reduced_run.hpp"
#include "fe2d/run/earthquake_pass.hpp"
#include "fe2d/solver/dense_product.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

ReducedSystem::ReducedSystem(const ContactStructure& structure, DamModes kept, const RunDamping& run_damping,
                             const ReducedRock* radiating, std::shared_ptr<const ReducedWater> reduced_water,
                             double highest)
    : modes(std::move(kept)), dam_modes(modes.count()), water(std::move(reduced_water)), flexibility(modes.residual),
      damping(run_damping), weights(structure.plane().weights())
{
    if (water) add_water();
    if (radiating)
        add_rock(*radiating, highest);
    else if (structure.has_rock())
        flexibility += structure.rock_flexibility();
    const SlipDamping slip(structure, damping);
    mean_motion = VectorXd::Zero(modes.count());
    if (!slip.active()) return;
    slip_damping = slip.drag(0, 0);
    mean_motion = modes.momentum * (damping.constants.mass / slip_damping); // m̂ = M r / (k'/a_M)
}

void ReducedSystem::add_water()
{
    const Index shapes = water->pressures();
    const MatrixXd pressures = water->face.leftCols(shapes),
                   attached = modes.attach(modes.face_residual, pressures, -water->mass.topLeftCorner(shapes, shapes),
                                           flexibility);
    water_begin = modes.count();
    water_mass = SymmetricProduct(water->mass);
    water_stiffness = SymmetricProduct(water->stiffness);
    of_face = MatrixXd::Zero(water_begin, water->count());
    of_face.topLeftCorner(dam_modes, shapes) = -modes.face * pressures;
    of_face.bottomLeftCorner(attached.rows(), shapes) = -attached;
    modes.lengthen(water->count());
}

void ReducedSystem::add_rock(const ReducedRock& rock, double highest)
{
    const Index base = rock.base(), floor = rock.floor, count = rock.count();
    modes.lengthen(count);
    modes.omega2.tail(count) = rock.stiffness;
    modes.on_plane.rightCols(count) = -rock.modes.topRows(base);
    radiation = rock.damping;
    MatrixXd residual = rock.residual.topLeftCorner(base, base);
    if (floor > 0 && water) {
        constexpr double stiffer = 10.0; // than what answers at the highest frequency
        const Index shapes = water->pressures();
        const MatrixXd pressures = water->floor.leftCols(shapes), soft = rock.residual.bottomRightCorner(floor, floor);
        const FaceResidual rest{
            soft, soft / std::pow(stiffer * highest, 2), -rock.residual.topRightCorner(base, floor), {}};
        const MatrixXd attached = modes.attach(rest, pressures, -water->mass.topLeftCorner(shapes, shapes), residual);
        const Index all = count + attached.rows();
        of_floor = MatrixXd::Zero(all, water->count());
        of_floor.topLeftCorner(count, shapes) = -rock.modes.bottomRows(floor).transpose() * pressures;
        of_floor.bottomLeftCorner(attached.rows(), shapes) = -attached;
        radiation.conservativeResizeLike(MatrixXd::Zero(all, all));
    }
    flexibility += residual;
}

PlaneShapes::PlaneShapes(const ReducedSystem& system)
    : dam(system.water ? system.water_begin : system.modes.count() - system.rock_modes())
{
    constexpr double least = 1e-8;
    const MatrixXd& on_plane = system.modes.on_plane;
    to_dam = TransposedProduct(on_plane.leftCols(dam));
    if (system.rock_modes() == 0) return;
    MatrixXd left = on_plane.rightCols(system.rock_modes());
    ports.resize(left.rows(), 0);
    Index count = 0, largest = 0;
    double norm = left.colwise().norm().maxCoeff(&largest);
    for (const double first = norm; count < left.rows() && norm > least * first; ++count) { // Gram-Schmidt
        VectorXd port = left.col(largest) / norm;
        port -= ports * (ports.transpose() * port);
        port.normalize();
        ports.conservativeResize(left.rows(), count + 1);
        ports.col(count) = port;
        left -= port * (port.transpose() * left).eval();
        norm = left.colwise().norm().maxCoeff(&largest);
    }
    ports.conservativeResizeLike(MatrixXd::Zero(left.rows(), count + count % 2)); // TransposedProduct takes two rows at a time
    rock = ports.transpose() * on_plane.rightCols(system.rock_modes());
    to_ports = TransposedProduct(ports);
    to_rock = TransposedProduct(rock);
}

namespace {

/// Of a symmetric matrix. @param definite  positive definite, else quasi-definite
MatrixXd inverse_of(const MatrixXd& matrix, bool definite)
{
    MatrixXd inverse;
    if (definite) {
        inverse = matrix.llt().solve(MatrixXd::Identity(matrix.rows(), matrix.cols()));
    } else {
        const VectorXd scale = matrix.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
        inverse = scale.asDiagonal() * matrix * scale.asDiagonal();
        inverse = (scale.asDiagonal() * inverse.partialPivLu().inverse() * scale.asDiagonal()).eval();
    }
    return 0.5 * (inverse + inverse.transpose());
}

} // namespace

ReducedOperator::ReducedOperator(const Plane& plane, const ReducedSystem& system, const PlaneShapes& shapes,
                                 const StepConstants& constants)
    : system_(system), shapes_(shapes), constants_(constants)
{
    const double w = 1.0 + constants.scheme.alpha, a_m = system.damping.constants.mass,
                 stretch = w * (1.0 + constants.a1 * system.damping.constants.stiffness);
    const Index m = plane.pairs();
    const MatrixXd& on_plane = system.modes.on_plane;
    massless_factor_ = 1.0 / stretch;
    const Index rock = system.rock_modes(), bodies = on_plane.cols() - rock;
    const Index dam = system.water ? system.water_begin : bodies;
    const VectorXd without_damping = constants.a0 + stretch * system.modes.omega2.array();
    MatrixXd of_dam = (w * constants.a1 * a_m) * system.modes.dam_mass.topLeftCorner(dam, dam);
    of_dam.diagonal() += without_damping.head(dam);
    const MatrixXd soft_dam = inverse_of(of_dam, true), dam_moves = on_plane.leftCols(dam) * soft_dam; // Φ d⁻¹ of the dam alone
    dam_ = SymmetricProduct(soft_dam);
    to_dam_steps_ = TransposedProduct(dam_moves);
    MatrixXd flexibility = massless_factor_ * system.flexibility;
    flexibility.noalias() += dam_moves * on_plane.leftCols(dam).transpose();
    MatrixXd soft_rock;
    if (rock > 0) {
        MatrixXd of_rock = (w * constants.a1 * a_m) * system.modes.dam_mass.bottomRightCorner(rock, rock);
        of_rock.diagonal() += without_damping.tail(rock);
        of_rock += w * constants.a1 * system.radiation;
        soft_rock = inverse_of(of_rock, true);
        rock_ = SymmetricProduct(soft_rock);
        to_rock_steps_ = TransposedProduct(shapes.rock * soft_rock);
        flexibility.noalias() += on_plane.rightCols(rock) * soft_rock * on_plane.rightCols(rock).transpose();
    }
    if (system.water) {
        const Index shown = system.water->pressures();
        MatrixXd of_water = constants.a0 * system.water->mass + (w * constants.a1) * system.water->damping + w * system.water->stiffness;
        const MatrixXd face = (w * constants.a1) * system.of_face.leftCols(shown);
        dam_per_pressure_ = soft_dam * face;
        of_water.topLeftCorner(shown, shown) -= face.transpose() * dam_per_pressure_;
        MatrixXd gaps = on_plane.leftCols(dam) * dam_per_pressure_;
        if (system.of_floor.size() > 0) {
            const MatrixXd floor = (w * constants.a1) * system.of_floor.leftCols(shown);
            rock_per_pressure_ = soft_rock * floor;
            of_water.topLeftCorner(shown, shown) -= floor.transpose() * rock_per_pressure_;
            gaps += on_plane.rightCols(rock) * rock_per_pressure_;
        }
        dam_to_pressures_ = dam_per_pressure_.transpose();
        rock_to_pressures_ = rock_per_pressure_.transpose();
        const MatrixXd soft_water = inverse_of(of_water, false);
        water_ = SymmetricProduct(soft_water);
        water_per_pressure_ = soft_water.leftCols(shown);
        gaps_to_pressures_ = -gaps.transpose();
        flexibility.noalias() += gaps * soft_water.topLeftCorner(shown, shown) * gaps.transpose();
    }
    MatrixXd stiffness = flexibility.llt().solve(MatrixXd::Identity(2 * m, 2 * m)); // W⁻¹
    stiffness = (0.5 * (stiffness + stiffness.transpose())).eval();
    stiff_modes_ = stiffness * on_plane.leftCols(shapes.dam);
    if (rock > 0) stiff_ports_ = stiffness * shapes.ports;
    if (system.slips_damped()) {
        k_ = w * constants.a1 * system.slip_damping;
        Work work;
        soften(system.mean_motion, work, softened_motion_);
        z_ = on_plane * softened_motion_;
        zeta_ = softened_motion_.dot(system.mean_motion);
        // EᵀW⁻¹E, E = I - k z ωᵀ: three rank-one terms
        const VectorXd w_z = stiffness * z_;
        const double z_w_z = z_.dot(w_z);
        stiffness.rightCols(m) -= k_ * w_z * system.weights.transpose();
        stiffness.bottomRows(m) -= k_ * system.weights * w_z.transpose();
        stiffness.bottomRightCorner(m, m) +=
            (k_ * k_ * z_w_z + k_ * (1.0 - k_ * zeta_)) * system.weights * system.weights.transpose();
        stiffness = (0.5 * (stiffness + stiffness.transpose())).eval();
    }
    stiffness /= w;
    stiffness_ = std::make_shared<const MatrixXd>(std::move(stiffness));
}

void ReducedOperator::soften(const VectorXd& load, Work& work, VectorXd& step) const
{
    const Index dam = dam_.rows(), rock = rock_.rows(), water = water_.rows();
    step.setZero(load.size());
    dam_.add(load.head(dam), step.head(dam), work.room);
    if (rock > 0) rock_.add(load.tail(rock), step.tail(rock), work.room);
    if (water == 0) return;
    work.pressures.setZero(dam_to_pressures_.rows());
    add_product(dam_to_pressures_, load.head(dam), work.pressures);
    if (rock_to_pressures_.size() > 0) add_product(rock_to_pressures_, load.tail(rock), work.pressures);
    work.water = load.segment(dam, water);
    work.water.head(work.pressures.size()) -= work.pressures;
    work.moved.setZero(water);
    water_.add(work.water, work.moved, work.room);
    push(work, step);
}

/// Adds the water's motion, work.moved, and what its pressures do to dam and rock.
void ReducedOperator::push(Work& work, VectorXd& step) const
{
    const Index dam = dam_.rows();
    step.segment(dam, work.moved.size()) += work.moved;
    work.pressures = -work.moved.head(dam_per_pressure_.cols());
    add_product(dam_per_pressure_, work.pressures, step.head(dam));
    if (rock_per_pressure_.size() > 0) add_product(rock_per_pressure_, work.pressures, step.tail(rock_.rows()));
}

namespace {

/// sum += (U A)ᵀ x, of Uᵀ and Aᵀ. @param ports, part  work space
void add_through_ports(const TransposedProduct& to_ports, Index count, const TransposedProduct& from_ports, const VectorXd& x,
                       VectorXd& ports, VectorXd& part, Eigen::Ref<VectorXd> sum)
{
    ports.setZero(count);
    to_ports.add(x, ports);
    part.setZero(sum.size());
    from_ports.add(ports, part);
    sum += part;
}

} // namespace

void ReducedOperator::stuck_force(const VectorXd& load, const VectorXd& rates, const VectorXd& massless, const VectorXd& known,
                                  Work& work, VectorXd& stuck) const
{
    const double w = 1.0 + constants_.scheme.alpha;
    const Index rock = system_.rock_modes();
    work.modal.setZero(load.size());
    shapes_.to_dam.add(massless, work.modal);
    if (rock > 0)
        add_through_ports(shapes_.to_ports, shapes_.ports.cols(), shapes_.to_rock, massless, work.ports, work.rock,
                          work.modal.tail(rock));
    work.modal = load - work.modal;
    soften(work.modal, work, work.free);
    work.free += rates;
    stuck = massless;
    add_product(stiff_modes_, work.free.head(shapes_.dam), stuck);
    if (rock > 0) {
        work.ports.setZero(shapes_.ports.cols());
        add_product(shapes_.rock, work.free.tail(rock), work.ports);
        add_product(stiff_ports_, work.ports, stuck);
    }
    if (system_.slips_damped()) {
        work.mean = softened_motion_.dot(load) + system_.mean_motion.dot(rates);
        stuck.tail(system_.weights.size()) += (k_ * (work.mean - z_.dot(stuck))) * system_.weights;
    }
    stuck = (known - stuck) / w;
}

void ReducedOperator::finish(const VectorXd& massless, const VectorXd& known, const VectorXd& force, double slip,
                             Work& work, VectorXd& modal_step, VectorXd& massless_step) const
{
    VectorXd& tilde = work.plane;
    tilde = (1.0 + constants_.scheme.alpha) * force - known;
    if (system_.slips_damped()) { // as in DynamicOperator::finish
        const VectorXd& weights = system_.weights;
        const Index m = weights.size();
        tilde.tail(m) -= (k_ * (slip - work.mean - k_ * zeta_ * slip)) * weights;
        const double z_tilde = z_.dot(tilde) / (1.0 - k_ * z_.tail(m).dot(weights));
        tilde.tail(m) += (k_ * z_tilde) * weights;
    }
    tilde += massless;
    modal_step = work.free;
    to_dam_steps_.add(tilde, modal_step);
    if (rock_.rows() > 0)
        add_through_ports(shapes_.to_ports, shapes_.ports.cols(), to_rock_steps_, tilde, work.ports, work.rock,
                          modal_step.tail(rock_.rows()));
    if (water_.rows() > 0) {
        work.water.setZero(gaps_to_pressures_.rows());
        add_product(gaps_to_pressures_, tilde, work.water);
        work.moved.setZero(water_.rows());
        add_product(water_per_pressure_, work.water, work.moved);
        push(work, modal_step);
    }
    if (system_.slips_damped()) modal_step += (k_ * slip) * softened_motion_;
    massless_step = massless_factor_ * tilde;
}

ReducedModel::ReducedModel(Plane plane, ReducedSystem system, const Scheme& scheme)
    : plane_(std::move(plane)), system_(std::move(system)), shapes_(system_), scheme_(scheme)
{
}

const ReducedOperator& ReducedModel::at(double dt) const
{
    const std::scoped_lock lock(mutex_);
    auto& slot = operators_[dt];
    if (!slot) slot = std::make_unique<const ReducedOperator>(plane_, system_, shapes_, step_constants(scheme_, dt));
    return *slot;
}

CoarsePlane::CoarsePlane(const Plane& plane, int groups) : coarse_(plane)
{
    const Index m = plane.pairs(), count = std::clamp<Index>(groups, 1, m);
    mean_ = MatrixXd::Zero(count, m);
    for (Index i = 0; i < m; ++i) mean_(i * count / m, i) = plane.area[i];
    coarse_.area = mean_.rowwise().sum();
    mean_ = (coarse_.area.cwiseInverse().asDiagonal() * mean_).eval();
    coarse_.distance = mean_ * plane.distance;
    both_ = MatrixXd::Zero(2 * count, 2 * m);
    both_.topLeftCorner(count, m) = both_.bottomRightCorner(count, m) = mean_;
}

std::size_t CoarsePlane::group_of(Index pair) const
{
    return static_cast<std::size_t>(pair * mean_.rows() / mean_.cols());
}

ReducedSystem CoarsePlane::coarsened(const ReducedSystem& system) const
{
    ReducedSystem result = system;
    result.modes.on_plane = both_ * system.modes.on_plane;
    result.modes.residual = MatrixXd();
    result.modes.residual_crest = both_ * system.modes.residual_crest;
    result.flexibility = both_ * system.flexibility * both_.transpose();
    result.weights = coarse_.weights();
    return result;
}

ContactMemory CoarsePlane::shut(const ContactMemory& memory) const
{
    const Index m = mean_.cols(), count = mean_.rows();
    ContactMemory result(count);
    for (Index i = 0; i < m; ++i) {
        const auto group = static_cast<Index>(group_of(i));
        result.force[group] += memory.force[i];
        result.force[count + group] += memory.force[m + i];
    }
    result.slip = mean_ * memory.slip;
    return result;
}

ReducedContact::ReducedContact(const ReducedModel& model, const ContactMemory& rest, const Contact& joint,
                               const ContactOptions& options)
    : model_(model), plane_(model.plane()), system_(model.system()), joint_(joint), options_(options),
      rest_force_(rest.force), rest_slip_(rest.slip), normal_force_(rest.force.head(plane_.pairs()).sum()),
      no_force_(VectorXd::Zero(2 * plane_.pairs()))
{
    state_.q = state_.q_v = state_.q_a = VectorXd::Zero(system_.modes.count());
    state_.p = state_.p_v = state_.p_a = state_.gap_v = state_.gap_a = no_force_;
    state_.contact = rest;
}

ReducedContact::Step& ReducedContact::step_of(double dt)
{
    const auto found = steps_.find(dt);
    if (found != steps_.end()) return found->second;
    const ReducedOperator& shared = model_.at(dt);
    ++counts_.factorisations;
    return steps_
        .emplace(dt, Step{&shared, std::make_unique<JointSolver>(shared.stiffness(), plane_.area, joint_, options_)})
        .first->second;
}

/// b without the force of the damping, the rates that make it (ReducedOperator), π and the known contact-like forces;
/// DynamicContact::right_hand_side in modal amplitudes since rest.
void ReducedContact::right_hand_side(const StepConstants& c, const GroundAcceleration& ground)
{
    const double alpha = c.scheme.alpha, w = 1.0 + alpha, cv = alpha + w * c.a4, ca = w * c.a5;
    const double b_k = system_.damping.constants.stiffness;
    const double h = w * ground.h - alpha * state_.ground.h, v = w * ground.v - alpha * state_.ground.v;
    const ReducedState& s = state_;
    const double drag_h = w * ground.drag_h - alpha * state_.ground.drag_h,
                 drag_v = w * ground.drag_v - alpha * state_.ground.drag_v;
    const double per_rate = 1.0 / (w * c.a1);
    rates_ = (per_rate * cv) * s.q_v + (per_rate * ca) * s.q_a;
    inertia_ = (c.a2 - c.a0 * per_rate * cv) * s.q_v + (c.a3 - c.a0 * per_rate * ca) * s.q_a;
    strain_ = -s.q - w * rates_;
    load_ = inertia_ + system_.modes.omega2.cwiseProduct(strain_);
    const auto of_dam = [&](const VectorXd& vector) { return vector.head(system_.dam_modes); }; // the others have zeros
    load_.head(system_.dam_modes) += h * of_dam(system_.modes.ground_x) - v * of_dam(system_.modes.ground_y) +
                                     drag_h * of_dam(system_.modes.dam_x) - drag_v * of_dam(system_.modes.dam_y);
    if (const ReducedWater* water = system_.water.get()) {
        const auto of_water = [&](auto& vector) { return vector.segment(system_.water_begin, water->count()); };
        const auto weighted = [&](double GroundAcceleration::*part) {
            return w * ground.*part - alpha * state_.ground.*part;
        };
        auto load = of_water(load_);
        load.setZero();
        system_.water_mass.add(of_water(inertia_), load, work_.room);
        system_.water_stiffness.add(of_water(strain_), load, work_.room);
        load += weighted(&GroundAcceleration::displacement_v) * water->displacement_y -
                weighted(&GroundAcceleration::velocity_h) * water->velocity_x +
                weighted(&GroundAcceleration::velocity_v) * water->velocity_y;
    }
    massless_ = (b_k * cv) * s.p_v + (b_k * ca) * s.p_a - s.p;
    known_ = alpha * s.contact.force + rest_force_;
    if (!system_.slips_damped()) return;
    const Index m = plane_.pairs();
    const double slip = cv * system_.weights.dot(s.gap_v.tail(m)) + ca * system_.weights.dot(s.gap_a.tail(m));
    const double mean = system_.mean_motion.dot(rates_) / per_rate;
    load_ -= (system_.slip_damping * slip) * system_.mean_motion;
    known_.tail(m) -= (system_.slip_damping * (slip - mean)) * system_.weights;
}

/// As ContactStepper: the same joint, seen from another dam.
ContactReport ReducedContact::solve_laws(Step& step, const ContactLaw& law)
{
    const ContactMemory& memory = state_.contact;
    if (!step.with_laws) step.with_laws = law_solver(step.contact->shared_stiffness(), memory.laws, options_);
    const StepConstants& c = step.shared->constants();
    const Index m = plane_.pairs();
    laws_ = memory.laws;
    const JointStart start{c.dt,          memory.opening, memory.slip,
                           memory.states, c.a1,           -c.a4 * state_.gap_v.tail(m) - c.a5 * state_.gap_a.tail(m)};
    return laws_.solve(*step.with_laws, stuck_, start, law, solution_);
}

ContactReport ReducedContact::in_halves(double dt, const GroundAcceleration& ground, const ContactLaw& law, int cuts)
{
    const ContactReport first = advance(0.5 * dt, middle_of(state_.ground, ground, dt), law, cuts + 1);
    ContactReport second = advance(0.5 * dt, ground, law, cuts + 1);
    second.path = std::max(first.path, second.path);
    return second;
}

ContactReport ReducedContact::advance(double dt, const GroundAcceleration& ground, const ContactLaw& law, int cuts)
{
    if (passes_over(cuts, state_.contact.laws)) return in_halves(dt, ground, law, cuts);
    Step& step = step_of(dt);
    const ReducedOperator& op = *step.shared;
    const StepConstants& c = op.constants();
    const Index m = plane_.pairs();
    ContactMemory& memory = state_.contact;
    memory.contact_force(force_before_);
    slip_before_ = memory.slip;
    states_before_ = memory.states;
    right_hand_side(c, ground);
    op.stuck_force(load_, rates_, massless_, known_, work_, stuck_);
    subtract_columns(step.contact->stiffness(), memory.opening, stuck_);

    const Stopwatch before;
    solution_.states = memory.states;
    solution_.force = memory.force;
    elastic_ = memory.elastic;
    const bool laws = memory.laws.active();
    const ContactReport report = laws ? solve_laws(step, law) : step.contact->solve(stuck_, law, memory.elastic, solution_);
    counts_.contact_seconds += before.seconds();
    if (laws && !report.resolved() && cuts < most_cuts(memory.laws)) {
        ++counts_.halved;
        return in_halves(dt, ground, law, cuts);
    }

    gap_step_ = solution_.displacement;
    gap_step_.head(m) -= memory.opening;
    gap_step_.tail(m) += memory.elastic - elastic_;
    const double slip = system_.weights.dot(gap_step_.tail(m));
    op.finish(massless_, known_, solution_.force, slip, work_, modal_step_, massless_step_);

    const auto update = [&](const VectorXd& change, VectorXd& velocity, VectorXd& acceleration) {
        for (Index i = 0; i < change.size(); ++i) {
            const double v = velocity[i], a = acceleration[i];
            velocity[i] = c.a1 * change[i] - c.a4 * v - c.a5 * a;
            acceleration[i] = c.a0 * change[i] - c.a2 * v - c.a3 * a;
        }
    };
    state_.q += modal_step_;
    state_.p += massless_step_;
    update(modal_step_, state_.q_v, state_.q_a);
    update(massless_step_, state_.p_v, state_.p_a);
    update(gap_step_, state_.gap_v, state_.gap_a);
    memory.force = solution_.force;
    memory.states = solution_.states;
    memory.opening = solution_.displacement.head(m);
    memory.slip += solution_.displacement.tail(m);
    if (laws) {
        laws_.end();
        std::swap(memory.laws, laws_);
    }
    state_.time += dt;
    state_.ground = ground;
    land(step, law);
    memory.contact_force(force_after_);
    friction_ -= 0.5 * (force_before_.tail(m) + force_after_.tail(m)).dot(memory.slip - slip_before_);

    counts_.contact_iterations += report.iterations;
    counts_.add(report, report.residual * stuck_.cwiseAbs().maxCoeff() / normal_force_);
    return report;
}

/// Changes of modes and massless body by the forces of jumps_, into modal_step_ and massless_step_.
void ReducedContact::change_by(const Step& step)
{
    const double slip = system_.weights.dot(jumps_.displacement.tail(plane_.pairs()));
    no_load_work_.free.setZero(system_.modes.count());
    step.shared->finish(no_force_, no_force_, jumps_.force, slip, no_load_work_, modal_step_, massless_step_);
}

/// DynamicContact::land() and settle() in modal amplitudes.
void ReducedContact::land(Step& step, const ContactLaw& law)
{
    ContactStates& states = state_.contact.states;
    if (!step.contact->lands(states_before_, states)) return;
    const bool shuts = step.contact->shuts(states_before_, states);
    jumps_.states = states;
    if (!(shuts ? step.contact->land(law, state_.gap_v, jumps_) : step.contact->hold(law, state_.gap_v, jumps_))) return;
    states = jumps_.states;
    ++counts_.landings;
    change_by(step);
    state_.q_v += modal_step_;
    state_.p_v += massless_step_;
    state_.gap_v += jumps_.displacement;
    if (!shuts || !step.contact->hold(law, state_.gap_a, jumps_)) return;
    change_by(step);
    state_.q_a += modal_step_;
    state_.p_a += massless_step_;
    state_.gap_a += jumps_.displacement;
    state_.contact.force += jumps_.force / step.shared->constants().a0;
}

double ReducedContact::mean_slip() const
{
    return system_.weights.dot(state_.contact.slip - rest_slip_);
}

double ReducedContact::crest() const
{
    return system_.modes.crest.dot(state_.q) + system_.modes.residual_crest.dot(state_.p);
}

namespace {

/// Modes of the estimate's reference: four times as many, or twice where that would cost more than the run.
int reference_modes(int modes)
{
    return std::max(2 * modes, std::min(4 * modes, 64));
}

} // namespace

const ReducedRun::Estimators& ReducedRun::estimators() const
{
    std::call_once(estimators_made_, [this] {
        if (model_->system().modes.complete) return;
        DamModes reference = dam_modes(full_.structure(), reference_modes(wanted_));
        if (!reference.regular) return;
        if (on_plane_itself()) {
            estimators_.reference = std::make_unique<const ReducedModel>(
                model_->plane(), system_of(std::move(reference)), scheme_of(scene_.time));
            return;
        }
        const auto coarse = [&](const ReducedSystem& system) {
            return std::make_unique<const ReducedModel>(coarse_.plane(), coarse_.coarsened(system),
                                                        scheme_of(scene_.time));
        };
        estimators_.kept = coarse(model_->system());
        estimators_.fewer = coarse(system_of(reference.first(3 + wanted_ / 2)));
        estimators_.reference = coarse(system_of(std::move(reference)));
    });
    return estimators_;
}

std::optional<double> ReducedRun::truncation_error(const Motion& motion, const Start& start,
                                                   const FirstPass& first) const
{
    if (model_->system().modes.complete) return 0.0;
    const Estimators& systems = estimators();
    if (!systems.reference) return std::numeric_limits<double>::quiet_NaN(); // the modes beyond did not converge
    const double modes = static_cast<double>(model_->system().dam_modes - 3);
    const double more = static_cast<double>(systems.reference->system().dam_modes - 3);
    if (on_plane_itself()) {
        Motion coarsest = motion;
        coarsest.parts = 1 << motion.halvings.value_or(0);
        Strength strength(start.contact, model_->plane());
        strength.follow(start.rest);
        RunResult result;
        shake(coarsest, *systems.reference, strength, start.rest, nullptr, result);
        if (result.status == Status::interrupted) return std::nullopt;
        const double to_more = largest_difference(first.slip, first.rows, result.history.slip, event_rows(result));
        return systems.reference->system().modes.complete ? to_more : to_more / (1.0 - modes / more);
    }
    const ContactMemory memory = coarse_.shut(start.rest);
    Motion coarse_motion = motion;
    coarse_motion.contact.landing = Landing::ringing; // few pairs land together: jolts that the full plane has not
    bool interrupted = false;
    const auto slips = [&](const ReducedModel& model) {
        Strength strength(start.contact, coarse_.plane());
        strength.follow(memory);
        RunResult result;
        shake(coarse_motion, model, strength, memory, nullptr, result);
        interrupted = interrupted || result.status == Status::interrupted;
        return result.history.slip;
    };
    const double fewer = static_cast<double>(systems.fewer->system().dam_modes - 3);
    const std::vector<double> kept = slips(*systems.kept);
    const double to_more = largest_difference(kept, slips(*systems.reference));
    if (interrupted) return std::nullopt;
    if (systems.reference->system().modes.complete) return to_more;
    if (fewer < 1.0) return to_more / (1.0 - modes / more); // one mode: none to compare with, n^-1 as if the slower
    const double from_fewer = largest_difference(slips(*systems.fewer), kept);
    if (interrupted) return std::nullopt;
    // The error as n^-p: both differences tell it, and their ratio tells p.
    const auto gone = [&](double p) { return 1.0 - std::pow(modes / more, p); };
    const auto gained = [&](double p) { return std::pow(modes / fewer, p) - 1.0; };
    double slow = 1.0, fast = 2.0; // of modes whose frequencies grow as n^1/2; of smooth loads
    for (int k = 0; k < 40; ++k) {
        const double p = 0.5 * (slow + fast);
        (from_fewer * gone(p) > to_more * gained(p) ? slow : fast) = p;
    }
    return std::sqrt(to_more / gone(slow) * from_fewer / gained(slow));
}

} // namespace damslip::fe2d
