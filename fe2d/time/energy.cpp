#include "fe2d/time/energy.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::fe2d {

namespace {

/// D of the class comment.
double numerical_dissipation(const State& before, const State& after, const StepConstants& c)
{
    const Eigen::VectorXd step = after.displacement - before.displacement;
    const Eigen::VectorXd inertia_change = after.inertia_force - before.inertia_force; // M Δa
    const double g = c.scheme.gamma - 0.5, b = c.scheme.beta - 0.5 * c.scheme.gamma, dt2 = c.dt * c.dt;
    const double change_squared = (after.acceleration - before.acceleration).dot(inertia_change);
    const double square_change =
        0.5 * (after.acceleration.dot(after.inertia_force) - before.acceleration.dot(before.inertia_force));
    return -g * step.dot(inertia_change) + g * b * dt2 * change_squared + b * dt2 * square_change +
           0.5 * c.scheme.alpha * step.dot(after.unbalanced - before.unbalanced_before);
}

} // namespace

double Energy::imbalance(const Energy& start) const
{
    return (kinetic - start.kinetic) + (strain - start.strain) + (damping - start.damping) +
           (numerical - start.numerical) + (friction - start.friction) + (radiated - start.radiated) -
           (external - start.external) - (contact_normal - start.contact_normal) + (joint_stored - start.joint_stored) +
           (bond_fracture - start.bond_fracture) + (anchor_plastic - start.anchor_plastic) +
           (anchor_loss - start.anchor_loss) - (joint_water - start.joint_water) + (impact - start.impact);
}

double Energy::scale() const
{
    return std::max({kinetic, strain, std::abs(damping), std::abs(numerical), std::abs(friction), std::abs(radiated),
                     std::abs(external), std::abs(contact_normal), joint_stored, bond_fracture, anchor_plastic,
                     anchor_loss, std::abs(joint_water), std::abs(impact)});
}

EnergyLedger::EnergyLedger(const State& start)
{
    start_.kinetic = 0.5 * start.velocity.dot(start.momentum);
    start_.strain = 0.5 * start.displacement.dot(start.stiffness_force);
    energy_ = start_;
    scale_ = start_.scale();
}

void EnergyLedger::add_step(const State& before, const State& after, const StepConstants& constants,
                            const InterfaceWork& work, const Energy& base)
{
    const Eigen::VectorXd step = after.displacement - before.displacement;
    energy_.kinetic = 0.5 * after.velocity.dot(after.momentum) + base.kinetic;
    energy_.strain = 0.5 * after.displacement.dot(after.stiffness_force) + base.strain;
    energy_.damping +=
        0.5 * step.dot(before.damping_force + after.damping_force) - work.dashpots + base.damping - base_.damping;
    energy_.external += 0.5 * step.dot(before.load + after.load);
    energy_.numerical +=
        numerical_dissipation(before, after, constants) + work.numerical + base.numerical - base_.numerical;
    energy_.friction += work.friction;
    energy_.radiated += work.radiated + work.dashpots + base.radiated - base_.radiated;
    energy_.contact_normal += work.normal;
    energy_.floor += work.floor;
    base_ = base;
    scale_ = std::max(scale_, energy_.scale());
}

} // namespace damslip::fe2d
