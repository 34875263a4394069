#include "fe2d/run/dynamic_contact.hpp"

#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

WaterLedger::Instant DynamicContact::water_instant() const
{
    const GroundAcceleration& g = state_.ground;
    // the water has no part in the translations that K u leaves out
    return water_ledger_->instant(
        {state_.u, state_.v, state_.a, products_.stiffness_1, products_.mass_1, products_.mass_2}, g.velocity_h,
        g.velocity_v, g.displacement_v);
}

void DynamicContact::start_ledger()
{
    if (structure_.water()) {
        water_ledger_ = std::make_shared<const WaterLedger>(*structure_.water(), structure_.order());
        water_ = water_before_ = water_before2_ = water_instant();
    }
    stored_ = stored_energy(options_, structure_.planes().area(), state_.contact.opening);
    energy_.strain = 0.5 * (deformation_.dot(products_.stiffness_1) + state_.rock.dot(rock_force_)) + stored_;
    energy_start_ = energy_;
    energy_scale_ = 0.0;
    gather_forces(forces_);
    forces_before_ = forces_before2_ = forces_;
}

void DynamicContact::gather_forces(Forces& f) const
{
    f.ground = ground_force(state_.ground);
    f.dam = damping_.constants.mass * products_.dam_mass_1 + products_.stiffness_1 - load_.dam - f.ground;
    f.v = state_.v;
    f.a = state_.a;
    if (structure_.gyrates()) f.dam += structure_.gyration() * state_.v;
    if (structure_.water()) { // of the dam; the water keeps its own ledger
        for (VectorXd* vector : {&f.dam, &f.v, &f.a}) structure_.clear_water(*vector);
    }
    f.rock = rock_force_ - rock_load_;
    f.rock_v = state_.rock_v;
    f.contact = state_.contact.force;
    if (!slip_damping_.active()) return;
    f.slip_rate = slip_damping_.weights.transpose() * rate_t_;
    f.mean_velocity = slip_damping_.momentum.transpose() * state_.v;
}

/// The ledger of EnergyLedger with its products arranged for the split system. K Δu, M Δa, ... are differences of
/// products of the states; vᵀKΔu stands for ΔuᵀKv.
void DynamicContact::add_energy(const StepConstants& c, const VectorXd& gap_step, const VectorXd& force_before)
{
    const double alpha = c.scheme.alpha, gamma = c.scheme.gamma, beta = c.scheme.beta, dt = c.dt;
    const double a_m = damping_.constants.mass, b_k = damping_.constants.stiffness;
    const Index m = structure_.pairs();
    rock_force_before_ = rock_force_;
    if (structure_.has_rock()) rock_force_.noalias() = structure_.rock_stiffness() * state_.rock;
    const VectorXd k_du = products_.stiffness_1 - before_.stiffness_1, k_dr = rock_force_ - rock_force_before_;

    std::swap(forces_before2_, forces_before_);
    std::swap(forces_before_, forces_);
    gather_forces(forces_);
    const VectorXd &v0 = forces_before_.v, &v1 = forces_.v, &a0 = forces_before_.a, &a1 = forces_.a;
    VectorXd du = du_; // of the dam
    structure_.clear_water(du);
    structure_.clear_water(deformation_);

    VectorXd slip, mean; // by plane
    if (slip_damping_.active()) {
        slip = slip_damping_.weights.transpose() * gap_step.tail(m);
        mean = slip_damping_.momentum.transpose() * du;
    }
    // Work of the slip damping at the rates of one instant, or of two together.
    const auto slip_work = [&](const VectorXd& slip_rate, const VectorXd& mean_velocity) {
        return slip.dot(slip_damping_.drag * slip_rate - mean_velocity) - mean.dot(slip_rate);
    };

    // Over the gap step alone: the opening also changes where the dam has slid to another place on bent rock.
    const VectorXd& area = structure_.planes().area();
    const VectorXd& opening = state_.contact.opening;
    const double stored =
        stored_energy(options_, area, opening) - stored_energy(options_, area, opening - gap_step.head(m));
    stored_ += stored;

    Energy& e = energy_;
    e.kinetic = 0.5 * v1.dot(products_.mass_1);
    e.strain = 0.5 * (deformation_.dot(products_.stiffness_1) + state_.rock.dot(rock_force_)) + stored_;
    e.damping += 0.5 * a_m * du.dot(products_.dam_mass_1 + before_.dam_mass_1) + 0.5 * b_k * k_du.dot(v1 + v0) +
                 0.5 * b_k * k_dr.dot(forces_.rock_v + forces_before_.rock_v);
    if (structure_.edge_damping().nonZeros() > 0) {
        const VectorXd velocity = v1 + v0;
        e.radiated += 0.5 * du.dot(structure_.edge_damping() * velocity);
    }
    if (slip_damping_.active())
        e.damping += 0.5 * slip_work(forces_.slip_rate + forces_before_.slip_rate,
                                     forces_.mean_velocity + forces_before_.mean_velocity);
    e.external += du.dot(load_.dam) + dr_.dot(rock_load_) + 0.5 * du.dot(forces_.ground + forces_before_.ground);
    const VectorXd force = 0.5 * (force_before + state_.contact.force);
    e.contact_normal += force.head(m).dot(gap_step.head(m)) + stored; // of soft contact, what is not in `strain`
    if (structure_.slides_far()) {
        e.contact_normal += 0.5 * (1.0 + alpha) * dr_.dot(load_jump_);
        load_jump_.setZero();
    }
    e.friction -= force.tail(m).dot(gap_step.tail(m));

    const double du_m_da = du.dot(products_.mass_2 - before_.mass_2);
    const double da_m_da = (a1 - a0).dot(products_.mass_2 - before_.mass_2);
    const double half_change = 0.5 * (a1.dot(products_.mass_2) - a0.dot(before_.mass_2));
    const double half_beta = beta - 0.5 * gamma;
    double numerical =
        -(gamma - 0.5) * du_m_da + (gamma - 0.5) * half_beta * dt * dt * da_m_da + half_beta * dt * dt * half_change;
    if (alpha != 0.0) {
        const auto work = [&](const Forces& f) {
            return du.dot(f.dam) + b_k * (f.v.dot(k_du) + f.rock_v.dot(k_dr)) + dr_.dot(f.rock) -
                   gap_step.dot(f.contact) + (slip_damping_.active() ? slip_work(f.slip_rate, f.mean_velocity) : 0.0);
        };
        numerical += 0.5 * alpha * (work(forces_) - work(forces_before2_));
    }
    if (landed_.pending) { // the velocity at the start is not the one that the equation of the last step saw
        double work = du.dot(landed_.dam);
        if (structure_.has_rock()) work += dr_.dot(landed_.rock);
        if (slip_damping_.active()) work += slip_work(landed_.slip_rate, landed_.mean_velocity);
        numerical -= 0.5 * (1.0 + alpha) * work;
        landed_.pending = false;
    }
    e.numerical += numerical;
    if (structure_.water()) {
        std::swap(water_before2_, water_before_);
        std::swap(water_before_, water_);
        water_ = water_instant();
        water_ledger_->add(c, water_before2_, water_before_, water_, e);
    }
    energy_scale_ = std::max({energy_scale_, e.kinetic, std::abs(e.damping), std::abs(e.friction), std::abs(e.external),
                              std::abs(e.contact_normal), std::abs(e.numerical), std::abs(e.radiated)});
}

} // namespace damslip::fe2d
