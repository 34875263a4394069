#include "fe2d/run/step_dam.hpp"

namespace damslip::fe2d {

using Eigen::VectorXd;

namespace {

constexpr int steps_to_follow = 64; ///< without numerical damping round-off grows from step to step

/// The products that follow a step, all but those of M_dam, entry by entry: one pass over the vectors.
struct FollowingRows {
    const double *change, *mass_change, *stiffness, *mass_1, *mass_2; ///< of the step; of the state before it
    double *of_velocity, *of_accel, *new_stiffness, *new_combined, *new_mass_1, *new_mass_2;
    double velocity_share, accel_share; ///< of K v and K a in K y

    [[gnu::always_inline]] inline void update(const StepConstants& c, Eigen::Index rows) const
    {
        const double *const __restrict k = change, *const __restrict m = mass_change, *const __restrict ku = stiffness,
                                *const __restrict mv = mass_1, *const __restrict ma = mass_2;
        double *const __restrict kv = of_velocity, *const __restrict ka = of_accel, *const __restrict ku_new = new_stiffness,
                      *const __restrict ky = new_combined, *const __restrict mv_new = new_mass_1,
                                *const __restrict ma_new = new_mass_2;
        const double a0 = c.a0, a1 = c.a1, a2 = c.a2, a3 = c.a3, a4 = c.a4, a5 = c.a5, of_v = velocity_share,
                     of_a = accel_share;
#pragma GCC ivdep
        for (Eigen::Index i = 0; i < rows; ++i) {
            const double v = kv[i], a = ka[i], v_new = a1 * k[i] - a4 * v - a5 * a, a_new = a0 * k[i] - a2 * v - a3 * a;
            kv[i] = v_new;
            ka[i] = a_new;
            ky[i] = of_v * v_new + of_a * a_new;
            ku_new[i] = ku[i] + k[i];
            mv_new[i] = a1 * m[i] - a4 * mv[i] - a5 * ma[i];
            ma_new[i] = a0 * m[i] - a2 * mv[i] - a3 * ma[i];
        }
    }
};

void update_rows(const FollowingRows& rows, const StepConstants& c, Eigen::Index count)
{
    rows.update(c, count);
}

#if DAMSLIP_HAS_AVX2
DAMSLIP_AVX2 void update_rows_avx2(const FollowingRows& rows, const StepConstants& c, Eigen::Index count)
{
    rows.update(c, count);
}
#endif

bool drags(const GroundAcceleration& ground)
{
    return ground.drag_h != 0.0 || ground.drag_v != 0.0;
}

} // namespace

StepDam::StepDam(const StepOperators& operators, VectorXd load, const DynamicState& start)
    : operators_(operators), structure_(operators.structure()), damping_(operators.damping()), load_(std::move(load))
{
    multiply_all(step_constants(operators.scheme(), 1.0), start); // at rest the step size does not matter
}

void StepDam::multiply_all(const StepConstants& c, const DynamicState& state)
{
    if (!follows()) return multiply(c, state);
    structure_.take_off_translations(state.u, deformation_);
    operators_.products().multiply({deformation_, state.v, state.v, state.a}, products_);
    of_velocity_.swap(products_.stiffness_2);
    VectorXd mass_product;
    operators_.products().multiply(state.a, of_accel_, mass_product);
    combine(c);
    take_dam_mass(state);
    followed_ = 0;
}

/// K y of the products K v and K a.
void StepDam::combine(const StepConstants& c)
{
    const double w = 1.0 + c.scheme.alpha, b = damping_.constants.stiffness;
    products_.stiffness_2 = (b * (c.scheme.alpha + w * c.a4)) * of_velocity_ + (b * w * c.a5) * of_accel_;
}

void StepDam::take_dam_mass(const DynamicState& state)
{
    products_.dam_mass_1 = products_.mass_1;
    products_.dam_mass_2 = products_.mass_2;
    structure_.leave_dam_mass(products_.dam_mass_1, state.v);
    structure_.leave_dam_mass(products_.dam_mass_2, state.a);
}

/// K, M and M_dam times a change of which A_d times it is `load`.
void StepDam::multiply_change(const StepConstants& c, const VectorXd& change, const VectorXd& load)
{
    if (follows())
        operators_.products().multiply_mass(change, mass_change_);
    else
        operators_.products().multiply(change, stiffness_change_, mass_change_);
    dam_mass_change_ = mass_change_;
    structure_.leave_dam_mass(dam_mass_change_, change);
    if (!follows()) return;
    const double w = 1.0 + c.scheme.alpha, of_dam = w * c.a1 * damping_.constants.mass,
                 share = 1.0 / (w * (1.0 + c.a1 * damping_.constants.stiffness));
    stiffness_change_ = share * (load - c.a0 * mass_change_ - of_dam * dam_mass_change_);
}

/// Products of the new state from those of the last one, which stand in before_.
void StepDam::follow(const StepConstants& c, const StepChange& change)
{
    multiply_change(c, change.dam, change.load);
    const double w = 1.0 + c.scheme.alpha, b = damping_.constants.stiffness;
    const Eigen::Index count = stiffness_change_.size();
    for (VectorXd* of_new : {&products_.stiffness_1, &products_.stiffness_2, &products_.mass_1, &products_.mass_2})
        of_new->resize(count);
    const FollowingRows rows{stiffness_change_.data(),     mass_change_.data(),          before_.stiffness_1.data(),
                             before_.mass_1.data(),        before_.mass_2.data(),        of_velocity_.data(),
                             of_accel_.data(),             products_.stiffness_1.data(), products_.stiffness_2.data(),
                             products_.mass_1.data(),      products_.mass_2.data(),      b * (c.scheme.alpha + w * c.a4),
                             b * w * c.a5};
#if DAMSLIP_HAS_AVX2
    if (vector_level() == VectorLevel::avx2)
        update_rows_avx2(rows, c, count);
    else
#endif
        update_rows(rows, c, count);
    ++followed_;
}

void StepDam::multiply(const StepConstants& c, const DynamicState& state)
{
    const double w = 1.0 + c.scheme.alpha, b = damping_.constants.stiffness;
    combined_ = (b * (c.scheme.alpha + w * c.a4)) * state.v + (b * w * c.a5) * state.a;
    structure_.clear_water(combined_);
    structure_.take_off_translations(state.u, deformation_);
    operators_.products().multiply({deformation_, combined_, state.v, state.a}, products_);
    take_dam_mass(state);
    structure_.clear_water(deformation_);
}

void StepDam::prepare(const StepConstants& c, const DynamicState& state)
{
    if (c.dt == dt_) return;
    if (follows())
        combine(c);
    else if (dt_ != 0.0)
        multiply(c, state);
    dt_ = c.dt;
}

void StepDam::end_step(const StepConstants& c, const DynamicState& state, const StepChange& change)
{
    std::swap(before_, products_);
    if (!follows() || followed_ == steps_to_follow) return multiply_all(c, state);
    follow(c, change);
    structure_.take_off_translations(state.u, deformation_);
    take_dam_mass(state);
}

/// What the moving ground does to the dam and its added mass. Relative to the ground, which accelerates by (-a_h, +a_v),
/// the load is -M r_x (-a_h) - M r_y a_v; the velocity that damping feels is (-v_h, +v_v), too.
VectorXd StepDam::ground_force(const GroundAcceleration& ground) const
{
    VectorXd force = ground.h * structure_.inertia_x() - ground.v * structure_.inertia_y();
    if (drags(ground)) force += ground.drag_h * structure_.dam_inertia_x() - ground.drag_v * structure_.dam_inertia_y();
    return force;
}

void StepDam::right_hand_side(const StepConstants& c, const DynamicState& state, const GroundAcceleration& ground,
                              VectorXd& b) const
{
    const double alpha = c.scheme.alpha, w = 1.0 + alpha, cv = alpha + w * c.a4, ca = w * c.a5;
    const double a_m = damping_.constants.mass;
    const auto without_drag = [this](const GroundAcceleration& g) {
        return g.h * structure_.inertia_x() - g.v * structure_.inertia_y();
    };
    if (drags(ground) || drags(state.ground))
        b = load_ + w * ground_force(ground) - alpha * ground_force(state.ground);
    else
        b = load_ + w * without_drag(ground) - alpha * without_drag(state.ground);
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

VectorXd StepDam::change_velocity(const StepConstants& c, const VectorXd& change, const VectorXd& load)
{
    multiply_change(c, change, load);
    structure_.clear_water(stiffness_change_); // damping is the dam's
    VectorXd damping = damping_.constants.mass * dam_mass_change_ + damping_.constants.stiffness * stiffness_change_;
    if (structure_.gyrates()) damping += structure_.gyration() * change;
    structure_.clear_water(damping);
    products_.mass_1 += mass_change_;
    products_.dam_mass_1 += dam_mass_change_;
    products_.stiffness_2 +=
        damping_.constants.stiffness * (c.scheme.alpha + (1.0 + c.scheme.alpha) * c.a4) * stiffness_change_;
    if (follows()) of_velocity_ += stiffness_change_;
    return damping;
}

VectorXd StepDam::change_acceleration(const StepConstants& c, const VectorXd& change, const VectorXd& load)
{
    multiply_change(c, change, load);
    products_.mass_2 += mass_change_;
    products_.stiffness_2 += damping_.constants.stiffness * (1.0 + c.scheme.alpha) * c.a5 * stiffness_change_;
    products_.dam_mass_2 += dam_mass_change_;
    if (follows()) of_accel_ += stiffness_change_;
    return mass_change_;
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
