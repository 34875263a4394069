#include "fe2d/time/energy.hpp"

#include <algorithm>
#include <cassert>
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

GroundHistory::GroundHistory(const GroundMotion& motion) : dt_(motion.dt)
{
    assert(dt_ > 0.0 && (motion.accel_v.empty() || motion.accel_v.size() == motion.accel_h.size()));
    GroundState now;
    const auto advance = [this](double& displacement, double velocity, double a, double b) {
        displacement += dt_ * (velocity + dt_ * (a / 3.0 + b / 6.0)); // acceleration linear from a to b
    };
    for (std::size_t k = 0; k < motion.accel_h.size(); ++k) {
        const double h = motion.accel_h[k], v = motion.accel_v.empty() ? 0.0 : motion.accel_v[k];
        if (k > 0) {
            advance(now.displacement_h, now.velocity_h, now.accel_h, h);
            advance(now.displacement_v, now.velocity_v, now.accel_v, v);
            now.velocity_h += 0.5 * dt_ * (now.accel_h + h);
            now.velocity_v += 0.5 * dt_ * (now.accel_v + v);
        }
        now.accel_h = h;
        now.accel_v = v;
        samples_.push_back(now);
    }
    duration_ = samples_.empty() ? 0.0 : dt_ * static_cast<double>(samples_.size() - 1);
}

GroundState GroundHistory::at(double time) const
{
    if (samples_.empty() || time < 0.0) return {};
    double position = time / dt_;
    const double whole = std::round(position); // a step that divides dt falls on samples up to round-off
    if (std::abs(position - whole) < 1e-9 * std::max(1.0, whole)) position = whole;
    const auto last = static_cast<double>(samples_.size() - 1);
    if (position > last) {
        const GroundState& end = samples_.back();
        const double since = (position - last) * dt_;
        return {0.0,
                0.0,
                end.velocity_h,
                end.velocity_v,
                end.displacement_h + since * end.velocity_h,
                end.displacement_v + since * end.velocity_v};
    }
    const auto k = static_cast<std::size_t>(position);
    const GroundState& a = samples_[k];
    const double share = position - static_cast<double>(k);
    if (share == 0.0) return a;
    const GroundState& b = samples_[k + 1];
    GroundState state;
    state.accel_h = a.accel_h + share * (b.accel_h - a.accel_h);
    state.accel_v = a.accel_v + share * (b.accel_v - a.accel_v);
    state.velocity_h = a.velocity_h + 0.5 * share * dt_ * (a.accel_h + state.accel_h);
    state.velocity_v = a.velocity_v + 0.5 * share * dt_ * (a.accel_v + state.accel_v);
    const double step = share * dt_;
    state.displacement_h = a.displacement_h + step * (a.velocity_h + step * (a.accel_h / 3.0 + state.accel_h / 6.0));
    state.displacement_v = a.displacement_v + step * (a.velocity_v + step * (a.accel_v / 3.0 + state.accel_v / 6.0));
    return state;
}

void GroundLoad::evaluate(const GroundState& ground, Eigen::VectorXd& load) const
{
    load = still + ground.accel_h * mass_x - ground.accel_v * mass_y;
    if (damped_x.size() > 0) load += ground.velocity_h * damped_x - ground.velocity_v * damped_y;
    if (velocity_x.size() > 0)
        load +=
            -ground.velocity_h * velocity_x + ground.velocity_v * velocity_y + ground.displacement_v * displacement_y;
}

} // namespace damslip::fe2d
