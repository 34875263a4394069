#include "fe2d/run/step_dam.hpp"

#include "fe2d/run/step_passes.hpp"

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
void StepDam::ground_force(const GroundAcceleration& ground, VectorXd& force) const
{
    force = inertia(structure_, ground);
    if (drags(ground)) force += ground.drag_h * structure_.dam_inertia_x() - ground.drag_v * structure_.dam_inertia_y();
}

void StepDam::right_hand_side(const StepConstants& c, const DynamicState& state, const GroundAcceleration& ground,
                              VectorXd& b)
{
    const double alpha = c.scheme.alpha, w = 1.0 + alpha, cv = alpha + w * c.a4, ca = w * c.a5;
    const double a_m = damping_.constants.mass;
    if (drags(ground) || drags(state.ground)) {
        ground_force(ground, ground_);
        ground_force(state.ground, ground_before_);
        b = load_ + w * ground_ - alpha * ground_before_;
    } else {
        ground_load(alpha, state.ground, ground, load_, structure_.inertia_x(), structure_.inertia_y(), b);
    }
    add_to_load(products_.stiffness_1, products_.stiffness_2,
                {{c.a2, products_.mass_1},
                 {c.a3, products_.mass_2},
                 {a_m * cv, products_.dam_mass_1},
                 {a_m * ca, products_.dam_mass_2}},
                b);
    if (structure_.gyrates()) {
        motion_ = cv * state.v + ca * state.a;
        gyration_.noalias() = structure_.gyration() * motion_;
        b += gyration_;
    }
    if (!structure_.water()) return;
    const auto weighted = [&](double GroundAcceleration::*part) {
        return w * ground.*part - alpha * state.ground.*part;
    };
    b += weighted(&GroundAcceleration::displacement_v) * structure_.displacement_y() -
         weighted(&GroundAcceleration::velocity_h) * structure_.velocity_x() +
         weighted(&GroundAcceleration::velocity_v) * structure_.velocity_y();
}

void StepDam::change_velocity(const StepConstants& c, const VectorXd& change, VectorXd& damping)
{
    operators_.products().multiply(change, stiffness_change_, mass_change_);
    structure_.clear_water(stiffness_change_); // damping is the dam's
    dam_mass_change_ = mass_change_;
    structure_.leave_dam_mass(dam_mass_change_, change);
    damping = damping_.constants.mass * dam_mass_change_ + damping_.constants.stiffness * stiffness_change_;
    if (structure_.gyrates()) {
        gyration_.noalias() = structure_.gyration() * change;
        damping += gyration_;
    }
    structure_.clear_water(damping);
    products_.mass_1 += mass_change_;
    products_.dam_mass_1 += dam_mass_change_;
    products_.stiffness_2 +=
        damping_.constants.stiffness * (c.scheme.alpha + (1.0 + c.scheme.alpha) * c.a4) * stiffness_change_;
}

const VectorXd& StepDam::change_acceleration(const StepConstants& c, const VectorXd& change)
{
    operators_.products().multiply(change, stiffness_change_, mass_change_);
    products_.mass_2 += mass_change_;
    products_.stiffness_2 += damping_.constants.stiffness * (1.0 + c.scheme.alpha) * c.a5 * stiffness_change_;
    dam_mass_change_ = mass_change_;
    structure_.leave_dam_mass(dam_mass_change_, change);
    products_.dam_mass_2 += dam_mass_change_;
    return mass_change_;
}

void StepDam::instant(const DynamicState& state, Instant& now)
{
    if (drags(state.ground)) {
        ground_force(state.ground, now.ground);
        now.force = damping_.constants.mass * products_.dam_mass_1 + products_.stiffness_1 - load_ - now.ground;
    } else {
        instant_forces(state.ground, damping_.constants.mass, structure_.inertia_x(), structure_.inertia_y(),
                       products_.dam_mass_1, products_.stiffness_1, load_, now.ground, now.force);
    }
    now.velocity = state.v;
    now.accel = state.a;
    if (structure_.gyrates()) {
        gyration_.noalias() = structure_.gyration() * state.v;
        now.force += gyration_;
    }
    for (VectorXd* vector : {&now.force, &now.velocity, &now.accel}) structure_.clear_water(*vector);
}

} // namespace damslip::fe2d
