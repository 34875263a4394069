#include "fe2d/run/contact_ledger.hpp"

#include "fe2d/contact/joint_laws.hpp"
#include "fe2d/run/step_passes.hpp"
#include "fe2d/solver/dense_product.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

ContactLedger::ContactLedger(const StepOperators& operators, const Contact& joint, const StepState& start, StepDam& dam,
                             const StepRock& rock)
    : structure_(operators.structure()), damping_(operators.damping()), slip_damping_(operators.slip_damping()),
      joint_(joint), load_jump_(VectorXd::Zero(2 * structure_.rock_nodes()))
{
    if (structure_.water()) {
        water_ledger_ = std::make_shared<const WaterLedger>(*structure_.water(), structure_.order());
        water_ = water_before_ = water_before2_ = water_instant(start, dam, rock);
    }
    stored_ = stored(start.contact.opening);
    energy_.strain = dam.strain() + rock.strain(start) + stored_;
    if (start.contact.laws.active()) note_laws(start.contact.laws.energy());
    start_ = energy_;
    gather(start, dam, rock, forces_);
    before_ = before2_ = forces_;
}

double ContactLedger::stored(const VectorXd& opening) const
{
    return stored_energy(joint_, structure_.planes().area(), opening);
}

WaterLedger::Instant ContactLedger::water_instant(const StepState& state, const StepDam& dam,
                                                  const StepRock& rock) const
{
    const GroundAcceleration& g = state.ground;
    const Products& products = dam.products();
    // the water has no part in the translations that K u leaves out
    return water_ledger_->instant({state.u, state.v, state.a, products.stiffness_1, products.mass_1, products.mass_2},
                                  rock.floor(), g.velocity_h, g.velocity_v, g.displacement_v);
}

void ContactLedger::gather(const StepState& state, StepDam& dam, const StepRock& rock, Forces& f) const
{
    dam.instant(state, f.dam);
    rock.instant(state, f.rock);
    f.contact = state.contact.force;
    if (!slip_damping_.active()) return;
    f.slip_rate.noalias() = slip_damping_.weights.transpose() * state.rate_t;
    f.mean_velocity.noalias() = slip_damping_.momentum.transpose() * state.v;
}

/// All that passes from rock to dam at one instant: contact forces, and the slip damping that acts like them [N/m].
VectorXd ContactLedger::across(const Forces& f) const
{
    VectorXd force = f.contact;
    if (slip_damping_.active())
        force.tail(structure_.pairs()) -= slip_damping_.weights * (slip_damping_.drag * f.slip_rate - f.mean_velocity);
    return force;
}

void ContactLedger::add_move(const Pairing::Matrix& change, const StepState& state, const StepRock& rock)
{
    load_jump_ = change.transpose() * across(forces_);
    if (rock.water_in_joint().size() > 0) load_jump_ -= change.transpose() * rock.water_in_joint();
    before_.rock.force -= change.transpose() * across(before_);
    rock.instant(state, forces_.rock);
}

/// What the laws of the joint store and spend. Where their force is not linear over the step the trapezoid of its work
/// misses some of it: that is the scheme's.
/// Their mean force of the step is taken off contact_force_.
void ContactLedger::add_laws(const StepState& state, const VectorXd& gap_step)
{
    const JointEnergy now = state.contact.laws.energy();
    const VectorXd force = 0.5 * (state.law_force_before + state.contact.laws.force());
    energy_.numerical -= force.dot(gap_step) + now.taken() - of_laws_.taken();
    note_laws(now);
    contact_force_ -= force;
}

/// Work of the slip damping over the step at the rates of one instant, or of two together.
double ContactLedger::slip_work(const VectorXd& slip_rate, const VectorXd& mean_velocity)
{
    drag_.noalias() = slip_damping_.drag * slip_rate;
    drag_ -= mean_velocity;
    return slip_.dot(drag_) - mean_.dot(slip_rate);
}

void ContactLedger::note_laws(const JointEnergy& now)
{
    of_laws_ = now;
    energy_.joint_stored = now.stored;
    energy_.bond_fracture = now.bond_fracture;
    energy_.anchor_plastic = now.anchor_plastic;
    energy_.anchor_loss = now.anchor_loss;
    energy_.joint_water = now.water;
}

void ContactLedger::add(const StepConstants& c, const StepState& state, const StepChange& step, StepDam& dam,
                        const StepRock& rock)
{
    const double alpha = c.scheme.alpha, gamma = c.scheme.gamma, beta = c.scheme.beta, dt = c.dt;
    const double a_m = damping_.constants.mass, b_k = damping_.constants.stiffness;
    const Index m = structure_.pairs();
    const Products &products = dam.products(), &before = dam.products_before();
    rock.stiffness_step(rock_stiffness_step_);
    const VectorXd& k_dr = rock_stiffness_step_;

    std::swap(before2_, before_);
    std::swap(before_, forces_);
    gather(state, dam, rock, forces_);
    if (structure_.water()) {
        dam_step_ = step.dam;
        structure_.clear_water(dam_step_);
    }
    const VectorXd &du = structure_.water() ? dam_step_ : step.dam, // of the dam
        &dr = step.rock;
    const WorkSums of_dam =
        work_sums({du, forces_.dam.velocity, before_.dam.velocity, before2_.dam.velocity, forces_.dam.accel,
                   before_.dam.accel, forces_.dam.force, before2_.dam.force, forces_.dam.ground, before_.dam.ground,
                   dam.load(), products.stiffness_1, before.stiffness_1, products.mass_1, products.mass_2,
                   before.mass_2, products.dam_mass_1, before.dam_mass_1});
    if (slip_damping_.active()) {
        slip_.noalias() = slip_damping_.weights.transpose() * step.gap.tail(m);
        mean_.noalias() = slip_damping_.momentum.transpose() * du;
    }

    // Over the gap step alone: the opening also changes where the dam has slid to another place on bent rock.
    const VectorXd& opening = state.contact.opening;
    opening_before_ = opening - step.gap.head(m);
    const double to_soft_contact = stored(opening) - stored(opening_before_);
    stored_ += to_soft_contact;

    Energy& e = energy_;
    const RockEnergy of_rock = rock.energy();
    e.kinetic = 0.5 * of_dam.kinetic + of_rock.kinetic;
    e.strain = dam.strain() + rock.strain(state) + stored_;
    const double damping_of_dam = 0.5 * a_m * of_dam.mass_damping + 0.5 * b_k * of_dam.stiffness_damping;
    const double damping_of_rock = 0.5 * b_k * k_dr.dot(forces_.rock.velocity + before_.rock.velocity);
    e.damping += damping_of_dam + damping_of_rock + of_rock.damping - of_rock_.damping;
    e.radiated += of_rock.radiated - of_rock_.radiated;
    if (structure_.edge_damping().nonZeros() > 0) {
        two_velocities_ = forces_.dam.velocity + before_.dam.velocity;
        edges_.noalias() = structure_.edge_damping() * two_velocities_;
        e.radiated += 0.5 * du.dot(edges_);
    }
    if (slip_damping_.active()) {
        rate_ = forces_.slip_rate + before_.slip_rate;
        mean_rate_ = forces_.mean_velocity + before_.mean_velocity;
        e.damping += 0.5 * slip_work(rate_, mean_rate_);
    }
    e.external += of_dam.load + dr.dot(rock.load()) + 0.5 * of_dam.ground;
    contact_force_ = 0.5 * (state.force_before + state.contact.force);
    if (state.contact.laws.active()) add_laws(state, step.gap);
    const VectorXd& force = contact_force_;
    e.contact_normal += force.head(m).dot(step.gap.head(m)) + to_soft_contact; // of it, what is not in `strain`
    if (structure_.slides_far()) {
        e.contact_normal += 0.5 * (1.0 + alpha) * dr.dot(load_jump_);
        load_jump_.setZero();
    }
    e.friction -= force.tail(m).dot(step.gap.tail(m));

    const double half_change = 0.5 * (of_dam.inertia - of_dam.inertia_before);
    const double half_beta = beta - 0.5 * gamma;
    double numerical = -(gamma - 0.5) * of_dam.step_inertia +
                       (gamma - 0.5) * half_beta * dt * dt * of_dam.change_inertia + half_beta * dt * dt * half_change;
    if (alpha != 0.0) {
        const auto work = [&](const Forces& f, double force_of_dam, double rate_of_dam) {
            return force_of_dam + b_k * (rate_of_dam + f.rock.velocity.dot(k_dr)) + dr.dot(f.rock.force) -
                   step.gap.dot(f.contact) + (slip_damping_.active() ? slip_work(f.slip_rate, f.mean_velocity) : 0.0);
        };
        const double now = work(forces_, of_dam.force, of_dam.rate);
        numerical += 0.5 * alpha * (now - work(before2_, of_dam.force_before2, of_dam.rate_before2));
    }
    if (has_landed_) { // the velocity at the start is not the one that the equation of the last step saw
        double work = du.dot(landed_.dam);
        if (structure_.has_rock()) work += dr.dot(landed_.rock);
        if (slip_damping_.active()) work += slip_work(landed_.slip_rate, landed_.mean_velocity);
        numerical -= 0.5 * (1.0 + alpha) * work;
        has_landed_ = false;
    }
    e.numerical += numerical + of_rock.numerical - of_rock_.numerical;
    of_rock_ = of_rock;
    if (structure_.water()) {
        std::swap(water_before2_, water_before_);
        std::swap(water_before_, water_);
        water_ = water_instant(state, dam, rock);
        water_ledger_->add(c, water_before2_, water_before_, water_, e);
    }
    scale_ = std::max({scale_, e.kinetic, std::abs(e.damping), std::abs(e.friction), std::abs(e.external),
                       std::abs(e.contact_normal), std::abs(e.numerical), std::abs(e.radiated), e.joint_stored,
                       e.bond_fracture, e.anchor_plastic, e.anchor_loss, std::abs(e.joint_water)});
}

void ContactLedger::add_landing(const LandingForces& forces, const StepState& state, StepDam& dam, const StepRock& rock)
{
    has_landed_ = true;
    landed_ = forces;
    const double before_landing = energy_.kinetic + energy_.strain;
    gather(state, dam, rock, forces_);
    of_rock_ = rock.energy();
    energy_.kinetic = 0.5 * forces_.dam.velocity.dot(dam.products().mass_1) + of_rock_.kinetic;
    if (structure_.water()) {
        WaterLedger::Instant now = water_instant(state, dam, rock);
        now.jolt = now.force - water_.force;
        now.jolt_rate = now.rate - water_.rate;
        energy_.strain += water_ledger_->compression(now) - water_ledger_->compression(water_);
        energy_.kinetic += water_ledger_->flow(now);
        water_ = std::move(now);
    }
    energy_.impact += landed_.impact;
    energy_.numerical += before_landing - energy_.kinetic - energy_.strain - landed_.impact;
}

namespace {

/// Rows that hold something, of matrices of equal height.
std::vector<Index> filled_rows(std::initializer_list<const SparseMatrix*> matrices)
{
    std::vector<bool> filled(static_cast<std::size_t>((*matrices.begin())->rows()), false);
    for (const SparseMatrix* matrix : matrices)
        for (Index column = 0; column < matrix->outerSize(); ++column)
            for (SparseMatrix::InnerIterator it(*matrix, column); it; ++it)
                if (it.value() != 0.0) filled[static_cast<std::size_t>(it.row())] = true;
    std::vector<Index> rows;
    for (std::size_t i = 0; i < filled.size(); ++i)
        if (filled[i]) rows.push_back(static_cast<Index>(i));
    return rows;
}

Eigen::SparseMatrix<double, Eigen::RowMajor> rows_of(const SparseMatrix& matrix, const std::vector<Index>& rows)
{
    const Eigen::SparseMatrix<double, Eigen::RowMajor> by_row = matrix;
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator it(by_row, rows[i]); it; ++it)
            if (it.value() != 0.0) entries.emplace_back(static_cast<Index>(i), it.col(), it.value());
    Eigen::SparseMatrix<double, Eigen::RowMajor> result(static_cast<Index>(rows.size()), matrix.cols());
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

void add_to_rows(const std::vector<Index>& rows, const VectorXd& values, VectorXd& vector)
{
    for (std::size_t i = 0; i < rows.size(); ++i) vector[rows[i]] += values[static_cast<Index>(i)];
}

} // namespace

WaterLedger::WaterLedger(const WaterBody& body, const NodeOrder& order)
    : mesh_(body.water.mesh_unknowns), floor_(body.water.floor), scale_(body.scale)
{
    const FluidModel& water = body.water;
    const double s = body.scale, s2 = s * s;
    const auto moved = [&](Index old) { return 2 * order.new_node[static_cast<std::size_t>(old / 2)] + old % 2; };
    for (const Index old : body.place) place_.push_back(moved(old));
    std::vector<Eigen::Triplet<double>> entries;
    for (Index column = 0; column < mesh_; ++column)
        for (SparseMatrix::InnerIterator it(body.coupling, column); it; ++it)
            entries.emplace_back(column, moved(it.row()), s * it.value());
    SparseMatrix coupling(mesh_, body.size);
    coupling.setFromTriplets(entries.begin(), entries.end());
    face_rows_ = filled_rows({&coupling});
    for (const Index row : floor_)
        if (std::find(face_rows_.begin(), face_rows_.end(), row) == face_rows_.end()) face_rows_.push_back(row);
    coupling_ = rows_of(coupling, face_rows_);
    const SparseMatrix end_mass = s2 * SparseMatrix((water.mass - water.body_mass).topRows(mesh_)),
                       damping = s2 * SparseMatrix(water.damping.topRows(mesh_)),
                       end_stiffness = s2 * SparseMatrix((water.stiffness - water.body_stiffness).topRows(mesh_));
    boundary_rows_ = filled_rows({&end_mass, &damping, &end_stiffness});
    end_mass_ = rows_of(end_mass, boundary_rows_);
    damping_ = rows_of(damping, boundary_rows_);
    end_stiffness_ = rows_of(end_stiffness, boundary_rows_);
    const auto turned = [&](const VectorXd& load) {
        VectorXd result(mesh_);
        for (Index i = 0; i < mesh_; ++i) result[i] = -load[body.place[static_cast<std::size_t>(i)]];
        return result;
    };
    velocity_x_ = turned(body.velocity_x);
    velocity_y_ = turned(body.velocity_y);
    displacement_y_ = turned(body.displacement_y);
}

VectorXd WaterLedger::water_of(const VectorXd& vector) const
{
    VectorXd result(static_cast<Index>(place_.size()));
    for (std::size_t i = 0; i < place_.size(); ++i) result[static_cast<Index>(i)] = vector[place_[i]];
    return result;
}

VectorXd WaterLedger::on(const std::vector<Index>& rows, const VectorXd& mesh) const
{
    VectorXd result(static_cast<Index>(rows.size()));
    for (std::size_t i = 0; i < rows.size(); ++i) result[static_cast<Index>(i)] = mesh[rows[i]];
    return result;
}

VectorXd WaterLedger::on_floor(const VectorXd& mesh) const
{
    return on(floor_, mesh);
}

WaterLedger::Instant WaterLedger::instant(const Motion& motion, const FloorMotion& floor, double velocity_h,
                                          double velocity_v, double displacement_v) const
{
    const auto turned = [&](const VectorXd& product) {
        VectorXd result(mesh_);
        for (Index i = 0; i < mesh_; ++i) result[i] = -product[place_[static_cast<std::size_t>(i)]];
        return result;
    };
    const auto off = [&](const Rows& of_boundary, const VectorXd& water, VectorXd& product) {
        const VectorXd part = of_boundary * water;
        add_to_rows(boundary_rows_, -part, product);
        return part;
    };
    const VectorXd phi = water_of(motion.z), rate = water_of(motion.v), accel = water_of(motion.a);
    Instant now;
    now.phi = phi.head(mesh_);
    now.rate = rate.head(mesh_);
    now.accel = accel.head(mesh_);
    now.face = coupling_ * motion.z;
    now.face_velocity = coupling_ * motion.v;
    if (!floor_.empty()) {
        now.floor = {scale_ * floor.volume, scale_ * floor.rate};
        for (std::size_t k = 0; k < floor_.size(); ++k) {
            const auto row = std::find(face_rows_.begin(), face_rows_.end(), floor_[k]) - face_rows_.begin();
            now.face[row] += now.floor.volume[static_cast<Index>(k)];
            now.face_velocity[row] += now.floor.rate[static_cast<Index>(k)];
        }
    }
    now.load = -velocity_h * velocity_x_ + velocity_v * velocity_y_ + displacement_v * displacement_y_;

    now.flow = turned(motion.stiffness_z);
    const VectorXd lost = damping_ * rate;
    now.force = now.flow - now.load;
    add_to_rows(boundary_rows_, lost, now.force);
    add_to_rows(face_rows_, now.face_velocity, now.force);
    now.mass_rate = turned(motion.mass_v);
    now.mass_accel = turned(motion.mass_a);
    now.boundary = lost + off(end_stiffness_, phi, now.flow);
    off(end_mass_, rate, now.mass_rate);
    now.boundary += off(end_mass_, accel, now.mass_accel);
    return now;
}

void WaterLedger::add(const StepConstants& c, const Instant& before2, const Instant& before, const Instant& now,
                      Energy& energy) const
{
    const double gamma = c.scheme.gamma, half_beta = c.scheme.beta - 0.5 * gamma, dt2 = c.dt * c.dt;
    const VectorXd step = now.phi - before.phi, mass_change = now.mass_accel - before.mass_accel;
    energy.kinetic += flow(now);
    energy.strain += compression(now);
    energy.radiated += 0.5 * on(boundary_rows_, step).dot(before.boundary + now.boundary);
    energy.external += 0.5 * step.dot(before.load + now.load);
    energy.numerical += -(gamma - 0.5) * step.dot(mass_change) +
                        (gamma - 0.5) * half_beta * dt2 * (now.accel - before.accel).dot(mass_change) +
                        0.5 * half_beta * dt2 * (now.accel.dot(now.mass_accel) - before.accel.dot(before.mass_accel));
    energy.numerical += 0.5 * c.scheme.alpha * step.dot(now.force - before2.force);
    if (before.jolt.size() > 0) energy.numerical -= 0.5 * (1.0 + c.scheme.alpha) * step.dot(before.jolt);
    energy.numerical += 0.5 * (on(face_rows_, step).dot(before.face_velocity + now.face_velocity) -
                               (now.face - before.face).dot(on(face_rows_, before.rate) + on(face_rows_, now.rate)));
    if (floor_.empty()) return;
    const VectorXd volume = now.floor.volume - before.floor.volume; // times the scale
    energy.floor += 0.5 * volume.dot(on_floor(before.rate) + on_floor(now.rate));
    energy.numerical -= 0.5 * c.scheme.alpha * volume.dot(on_floor(now.rate) - on_floor(before2.rate));
    if (before.jolt_rate.size() > 0)
        energy.numerical += 0.5 * (1.0 + c.scheme.alpha) * volume.dot(on_floor(before.jolt_rate));
}

namespace {

/// Rates of the tangential gaps, or accelerations: changed by the impulses, none where held.
void change_tangential(const ContactSolution& jumps, const ContactStates& states, VectorXd& values)
{
    const Index m = values.size();
    values += jumps.displacement.tail(m);
    for (Index i = 0; i < m; ++i)
        if (holds(states, m + i)) values[i] = 0.0;
}

} // namespace

ContactLanding::ContactLanding(const StepOperators& operators, double restitution)
    : structure_(operators.structure()), slip_damping_(operators.slip_damping()), restitution_(restitution)
{
}

std::optional<ContactLanding::Approach> ContactLanding::approach(const StepState& state, const StepRock& rock,
                                                                 double dt)
{
    const ContactStates& states = state.contact.states;
    if (!(restitution_ > 0.0) ||
        !std::all_of(states.begin(), states.end(), [](ContactState s) { return s == ContactState::open; }))
        return std::nullopt;
    const Index m = structure_.pairs();
    Approach approach{dt, {}, {}};
    gap_values(state.a, state.rock_a, state.accel_t, rock, values_);
    approach.accel = values_.head(m);
    gap_values(state.v, state.rock_v, state.rate_t, rock, approach.rate);
    for (Index i = 0; i < m; ++i) {
        const double rate = approach.rate[i];
        const double square = rate * rate - 2.0 * approach.accel[i] * std::max(0.0, state.contact.opening[i]);
        approach.rate[i] = square > 0.0 ? -std::sqrt(square) : std::min(rate, 0.0);
    }
    return approach;
}

/// What leaves the base again, and how fast; nothing where every pair that shut is slow.
std::optional<ContactLanding::Rebound> ContactLanding::rebound(const StepConstants& constants, JointSolver& solver,
                                                               const ContactLaw& law, const Approach& approach,
                                                               const ContactStates& states) const
{
    const Index m = structure_.pairs();
    std::vector<Index> fast;
    for (Index i = 0; i < m; ++i)
        if (states[static_cast<std::size_t>(i)] != ContactState::open &&
            approach.rate[i] < -2.0 * std::abs(approach.accel[i]) * approach.dt)
            fast.push_back(i);
    if (fast.empty()) return std::nullopt;

    // Impulses for one e; pairs that would be pulled stay open. What solves a step gives a0/(1 + α) of an impulse. @returns ΔE
    const double to_impulse = (1.0 + constants.scheme.alpha) / constants.a0;
    Rebound found;
    const auto with = [&](double e) {
        ContactSolution jumps{states, {}, {}};
        VectorXd values = approach.rate;
        for (const Index i : fast) values[i] *= 1.0 + e;
        for (Index k = 0; k <= m; ++k) {
            if (!solver.land(law, values, jumps)) return HUGE_VAL;
            Index worst = 0;
            if (jumps.force.head(m).minCoeff(&worst) >= -1e-9 * jumps.force.head(m).cwiseAbs().maxCoeff()) break;
            jumps.states[static_cast<std::size_t>(worst)] = ContactState::open;
        }
        found.states = jumps.states;
        found.target = VectorXd::Zero(m);
        for (const Index i : fast) found.target[i] = -e * approach.rate[i];
        return to_impulse * jumps.force.dot(approach.rate + 0.5 * jumps.displacement);
    };
    double gain = with(restitution_), low = 0.0, high = restitution_;
    for (int k = 0; gain > 0.0 && k < 40; ++k) {
        const double middle = 0.5 * (low + high);
        gain = with(middle);
        (gain > 0.0 ? high : low) = middle;
    }
    if (gain > 0.0) gain = with(low);
    if (gain > 0.0) return std::nullopt;
    found.loss = -gain;
    return found;
}

/// Contact forces go to zero, accelerations to those of the flight that begins.
void ContactLanding::release(const DynamicOperator& op, JointSolver& solver, StepRock& rock, StepDam& dam,
                             StepState& state)
{
    const StepConstants& c = op.constants();
    force_ = -state.contact.contact_force();
    jumps_ = {state.contact.states, solver.stiffness().llt().solve(c.a0 * force_), c.a0 * force_};
    change_accelerations(op, rock, dam, state);
}

/// Normal and tangential gaps of any motion of dam and rock; the tangential ones are kept by themselves.
void ContactLanding::gap_values(const VectorXd& dam, const VectorXd& rock_values, const VectorXd& tangential,
                                const StepRock& rock, VectorXd& gap)
{
    gap.noalias() = structure_.gaps() * dam;
    if (structure_.has_rock()) {
        on_gaps_.noalias() = rock.trace() * rock_values;
        gap -= on_gaps_;
    }
    gap.tail(tangential.size()) = tangential;
}

/// What forces on the pairs change of dam and rock, through the operator of the step, as its own forces do.
void ContactLanding::change_by(StepRock::Jump of, const DynamicOperator& op, StepRock& rock)
{
    free_.dam.setZero(structure_.dam_unknowns());
    free_.interface.setZero(op.interface_unknowns());
    free_.mean.setZero(structure_.planes().count());
    none_.setZero(2 * structure_.pairs());
    op.finish(free_, jumps_.force, none_, jumps_.displacement, tilde_);
    op.factor().backward(free_.dam);
    rock.jump(of, op, free_, jumps_.displacement, tilde_, rock_);
}

const LandingForces* ContactLanding::land(const DynamicOperator& op, JointSolver& solver, const ContactStates& before,
                                          const ContactLaw& law, StepRock& rock, StepDam& dam, StepState& state,
                                          const std::optional<Approach>& approach)
{
    ContactStates& states = state.contact.states;
    if (!solver.lands(before, states)) return nullptr;
    const bool shuts = solver.shuts(before, states);
    const Index m = structure_.pairs();
    jumps_.states = states;
    gap_values(state.v, state.rock_v, state.rate_t, rock, values_);
    std::optional<Rebound> rebounds;
    if (shuts && approach) rebounds = rebound(op.constants(), solver, law, *approach, states);
    if (rebounds) {
        jumps_.states = rebounds->states;
        values_.head(m) -= rebounds->target;
    }
    if (!(shuts ? solver.land(law, values_, jumps_) : solver.hold(law, values_, jumps_))) return nullptr;
    states = jumps_.states;
    change_by(StepRock::Jump::velocity, op, rock);
    state.v += free_.dam;
    state.rock_v += rock_;
    change_tangential(jumps_, states, state.rate_t);

    forces_.impact = 0.0;
    dam.change_velocity(op.constants(), free_.dam, forces_.dam);
    rock.damping_force(rock_, forces_.rock);
    if (slip_damping_.active()) {
        forces_.slip_rate.noalias() = slip_damping_.weights.transpose() * jumps_.displacement.tail(m);
        forces_.mean_velocity.noalias() = slip_damping_.momentum.transpose() * free_.dam;
    }
    if (rebounds) {
        forces_.impact = rebounds->loss;
        states.assign(states.size(), ContactState::open);
        release(op, solver, rock, dam, state);
    } else if (shuts && !structure_.water()) {
        settle(op, solver, law, rock, dam, state);
    }
    return &forces_;
}

void ContactLanding::settle(const DynamicOperator& op, JointSolver& solver, const ContactLaw& law, StepRock& rock,
                            StepDam& dam, StepState& state)
{
    jumps_.states = state.contact.states;
    gap_values(state.a, state.rock_a, state.accel_t, rock, values_);
    if (!solver.hold(law, values_, jumps_)) return;
    force_ = jumps_.force / op.constants().a0;
    change_accelerations(op, rock, dam, state);
}

/// By force_ on the pairs, and jumps_: accelerations that it gives the gaps, and a0 times it.
void ContactLanding::change_accelerations(const DynamicOperator& op, StepRock& rock, StepDam& dam, StepState& state)
{
    const StepConstants& c = op.constants();
    change_by(StepRock::Jump::acceleration, op, rock);
    state.a += free_.dam;
    state.rock_a += rock_;
    change_tangential(jumps_, state.contact.states, state.accel_t);
    state.contact.force += force_;

    forces_.dam += dam.change_acceleration(c, free_.dam) / (1.0 + c.scheme.alpha);
    forces_.dam.noalias() -= structure_.gaps().transpose() * force_;
    if (!structure_.has_rock()) return;
    by_trace_.noalias() = rock.trace().transpose() * force_;
    forces_.rock += by_trace_;
}

} // namespace damslip::fe2d
