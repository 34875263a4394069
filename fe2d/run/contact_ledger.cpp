#include "fe2d/run/contact_ledger.hpp"

#include "fe2d/contact/joint_solver.hpp"
#include "fe2d/run/step_passes.hpp"

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

} // namespace damslip::fe2d
