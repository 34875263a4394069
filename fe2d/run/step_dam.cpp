#include "fe2d/run/step_dam.hpp"

namespace damslip::fe2d {

using Eigen::VectorXd;

namespace {

bool drags(const GroundAcceleration& ground)
{
    return ground.drag_h != 0.0 || ground.drag_v != 0.0;
}

/// The load of the ground's acceleration but for drag, computed where it is assigned.
auto inertia(const ContactStructure& structure, const GroundAcceleration& ground)
{
    return ground.h * structure.inertia_x() - ground.v * structure.inertia_y();
}

} // namespace

StepDam::StepDam(const StepOperators& operators, VectorXd load, const DynamicState& start)
    : operators_(operators), structure_(operators.structure()), damping_(operators.damping()), load_(std::move(load))
{
    multiply(step_constants(operators.scheme(), 1.0), start); // at rest the step size does not matter
}

void StepDam::multiply(const StepConstants& c, const DynamicState& state)
{
    const double w = 1.0 + c.scheme.alpha, b = damping_.constants.stiffness;
    combined_ = (b * (c.scheme.alpha + w * c.a4)) * state.v + (b * w * c.a5) * state.a;
    structure_.clear_water(combined_);
    structure_.take_off_translations(state.u, deformation_);
    operators_.products().multiply({deformation_, combined_, state.v, state.a}, products_);
    products_.dam_mass_1 = products_.mass_1;
    products_.dam_mass_2 = products_.mass_2;
    structure_.leave_dam_mass(products_.dam_mass_1, state.v);
    structure_.leave_dam_mass(products_.dam_mass_2, state.a);
    structure_.clear_water(deformation_);
}

void StepDam::prepare(const StepConstants& c, const DynamicState& state)
{
    if (c.dt == dt_) return;
    if (dt_ != 0.0) multiply(c, state);
    dt_ = c.dt;
}

void StepDam::end_step(const StepConstants& c, const DynamicState& state)
{
    std::swap(before_, products_);
    multiply(c, state);
}

/// What the moving ground does to the dam and its added mass. Relative to the ground, which accelerates by (-a_h, +a_v),
/// the load is -M r_x (-a_h) - M r_y a_v; the velocity that damping feels is (-v_h, +v_v), too.
VectorXd StepDam::ground_force(const GroundAcceleration& ground) const
{
    VectorXd force = inertia(structure_, ground);
    if (drags(ground)) force += ground.drag_h * structure_.dam_inertia_x() - ground.drag_v * structure_.dam_inertia_y();
    return force;
}

void StepDam::right_hand_side(const StepConstants& c, const DynamicState& state, const GroundAcceleration& ground,
                              VectorXd& b) const
{
    const double alpha = c.scheme.alpha, w = 1.0 + alpha, cv = alpha + w * c.a4, ca = w * c.a5;
    const double a_m = damping_.constants.mass;
    if (drags(ground) || drags(state.ground))
        b = load_ + w * ground_force(ground) - alpha * ground_force(state.ground);
    else
        b = load_ + w * inertia(structure_, ground) - alpha * inertia(structure_, state.ground);
    b = b - products_.stiffness_1 + products_.stiffness_2 + c.a2 * products_.mass_1 + c.a3 * products_.mass_2 +
        (a_m * cv) * products_.dam_mass_1 + (a_m * ca) * products_.dam_mass_2;
    if (structure_.gyrates()) b += structure_.gyration() * VectorXd(cv * state.v + ca * state.a);
    if (!structure_.water()) return;
    const auto weighted = [&](double GroundAcceleration::*part) {
        return w * ground.*part - alpha * state.ground.*part;
    };
    b += weighted(&GroundAcceleration::displacement_v) * structure_.displacement_y() -
         weighted(&GroundAcceleration::velocity_h) * structure_.velocity_x() +
         weighted(&GroundAcceleration::velocity_v) * structure_.velocity_y();
}

VectorXd StepDam::change_velocity(const StepConstants& c, const VectorXd& change)
{
    VectorXd stiffness_change, mass_change;
    operators_.products().multiply(change, stiffness_change, mass_change);
    structure_.clear_water(stiffness_change); // damping is the dam's
    VectorXd dam_mass_change = mass_change;
    structure_.leave_dam_mass(dam_mass_change, change);
    VectorXd damping = damping_.constants.mass * dam_mass_change + damping_.constants.stiffness * stiffness_change;
    if (structure_.gyrates()) damping += structure_.gyration() * change;
    structure_.clear_water(damping);
    products_.mass_1 += mass_change;
    products_.dam_mass_1 += dam_mass_change;
    products_.stiffness_2 +=
        damping_.constants.stiffness * (c.scheme.alpha + (1.0 + c.scheme.alpha) * c.a4) * stiffness_change;
    return damping;
}

VectorXd StepDam::change_acceleration(const StepConstants& c, const VectorXd& change)
{
    VectorXd stiffness_change, mass_change;
    operators_.products().multiply(change, stiffness_change, mass_change);
    products_.mass_2 += mass_change;
    products_.stiffness_2 += damping_.constants.stiffness * (1.0 + c.scheme.alpha) * c.a5 * stiffness_change;
    VectorXd dam_mass_change = mass_change;
    structure_.leave_dam_mass(dam_mass_change, change);
    products_.dam_mass_2 += dam_mass_change;
    return mass_change;
}

void StepDam::instant(const DynamicState& state, Instant& now) const
{
    now.ground = ground_force(state.ground);
    now.force = damping_.constants.mass * products_.dam_mass_1 + products_.stiffness_1 - load_ - now.ground;
    now.velocity = state.v;
    now.accel = state.a;
    if (structure_.gyrates()) now.force += structure_.gyration() * state.v;
    for (VectorXd* vector : {&now.force, &now.velocity, &now.accel}) structure_.clear_water(*vector);
}

} // namespace damslip::fe2d
