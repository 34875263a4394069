#include "fe2d/run/step_parts.hpp"

#include "fe2d/run/step_passes.hpp"
#include "fe2d/solver/dense_product.hpp"

#include <cassert>
#include <cmath>

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

using Eigen::Index;

namespace {

constexpr double update_share = 0.01; ///< slip after which P is made anew, of the smallest element [-]

} // namespace

StepRock::StepRock(const StepOperators& operators, const SplitLoad& load, const DynamicState& start)
    : structure_(operators.structure()),
      stiffness_damping_(operators.damping().constants.stiffness), surface_{{}, load.rock, load.joint},
      trace_(structure_.trace(0.0))
{
    rest_ = force_ = force_before_ = VectorXd::Zero(2 * structure_.rock_nodes());
    if (operators.radiating()) {
        motion_.emplace(*operators.radiating());
        held_ = structure_.rock_stiffness() * start.rock;
    } else if (structure_.has_rock()) {
        force_ = structure_.rock_stiffness() * start.rock;
    }
    find_load();
    if (!structure_.slides_far()) return;
    geometric_rest_ = VectorXd::Zero(structure_.pairs());
    geometric_rest_ = opening(start) - start.contact.opening;
}

void StepRock::find_load()
{
    load_ = structure_.rock_load(surface_, trace_);
    if (motion_)
        load_ -= held_;
    else if (structure_.has_rock())
        rest_ = structure_.rock_flexibility() * load_;
}

double StepRock::slip(const DynamicState& state) const
{
    return structure_.planes().mean(0, state.contact.slip);
}

VectorXd StepRock::opening(const DynamicState& state) const
{
    const Index m = structure_.pairs(), base = structure_.plane().pairs();
    VectorXd gap = structure_.gaps() * state.u;
    gap.head(base) -= structure_.pairing().weights(slip(state)) * state.rock.head(structure_.rock_nodes());
    return gap.head(m) - geometric_rest_;
}

std::optional<Pairing::Matrix> StepRock::follow(const DynamicState& state)
{
    const double now = slip(state);
    if (!(std::abs(now - trace_slip_) > update_share * structure_.pairing().smallest_element())) return std::nullopt;
    const Pairing::Matrix trace = structure_.trace(now);
    Pairing::Matrix change = trace - trace_;
    trace_ = trace;
    trace_slip_ = now;
    ++place_;
    find_load();
    return change;
}

void StepRock::begin_step(const DynamicOperator& op, const DynamicState& state)
{
    if (motion_) {
        if (!op.has_floor()) {
            motion_->begin(*op.rock_step(), load_);
            return;
        }
        const StepConstants& c = op.constants();
        const double alpha = c.scheme.alpha, w = 1.0 + alpha, scale = structure_.water()->scale;
        constant_.resize(op.rock_step()->rock().interface());
        constant_.head(load_.size()) = load_;
        for (Index k = 0; k < constant_.size() - load_.size(); ++k)
            constant_[load_.size() + k] =
                -scale * ((alpha + w * c.a4) * on_floor(state.v, k) + w * c.a5 * on_floor(state.a, k));
        motion_->begin(*op.rock_step(), constant_);
        return;
    }
    if (!structure_.has_rock()) return;
    const StepConstants& c = op.constants();
    const double w = 1.0 + c.scheme.alpha, cv = c.scheme.alpha + w * c.a4, ca = w * c.a5, b_k = stiffness_damping_;
    free_ = (rest_ - state.rock + (b_k * cv) * state.rock_v + (b_k * ca) * state.rock_a) / (w * (1.0 + c.a1 * b_k));
}

double StepRock::on_floor(const VectorXd& dam, Index k) const
{
    return dam[structure_.floor()[static_cast<std::size_t>(k)]];
}

void StepRock::load_water(const DynamicOperator& op, VectorXd& dam) const
{
    if (!op.has_floor()) return;
    const StepConstants& c = op.constants();
    const double alpha = c.scheme.alpha, w = 1.0 + alpha, scale = structure_.water()->scale;
    const Index floor = op.rock_step()->rock().floor;
    const auto free = motion_->free_step().tail(floor), velocity = motion_->velocity().tail(floor),
               acceleration = motion_->acceleration().tail(floor);
    for (Index k = 0; k < floor; ++k)
        dam[structure_.floor()[static_cast<std::size_t>(k)]] +=
            op.floor_factor() * free[k] - scale * ((alpha + w * c.a4) * velocity[k] + w * c.a5 * acceleration[k]);
}

/// What forces on the pairs, and the floor's pressures with them, are on the interface of radiating rock.
const VectorXd& StepRock::weighted_force(const DynamicOperator& op, const DynamicOperator::Free& dam,
                                         const VectorXd& tilde)
{
    on_rock_.noalias() = trace_.transpose() * tilde;
    weighted_.resize(op.rock_step()->rock().interface());
    weighted_.head(on_rock_.size()) = -on_rock_;
    if (op.has_floor())
        weighted_.tail(weighted_.size() - on_rock_.size()) = op.floor_factor() * op.on_floor(dam.interface);
    return weighted_;
}

const VectorXd& StepRock::free_gap()
{
    if (motion_)
        free_gap_.noalias() = trace_ * motion_->free_step().head(trace_.cols());
    else if (structure_.has_rock())
        free_gap_.noalias() = trace_ * free_;
    return free_gap_;
}

FloorMotion StepRock::floor() const
{
    const auto rows = static_cast<Index>(structure_.floor().size());
    if (!motion_ || rows == 0) return {};
    return {motion_->displacement().tail(rows), motion_->velocity().tail(rows)};
}

void StepRock::step(const DynamicOperator& op, const DynamicOperator::Free& dam, const VectorXd& gap,
                    const VectorXd& tilde, VectorXd& change)
{
    if (!structure_.has_rock()) return;
    if (motion_) {
        motion_->finish(weighted_force(op, dam, tilde));
        change = motion_->step().head(trace_.cols());
    } else if (structure_.matching()) {
        opposite(dam, gap, change);
    } else {
        by_compliance(op.rock_share(), tilde, change);
        change = free_ - change;
    }
}

void StepRock::jump(Jump of, const DynamicOperator& op, const DynamicOperator::Free& dam, const VectorXd& gap,
                    const VectorXd& tilde, VectorXd& change)
{
    if (!structure_.has_rock()) return;
    if (motion_) {
        const VectorXd& force = weighted_force(op, dam, tilde);
        change = (of == Jump::velocity ? motion_->jump_velocity(force) : motion_->jump_acceleration(force))
                     .head(trace_.cols());
    } else if (structure_.matching()) {
        opposite(dam, gap, change);
    } else {
        by_compliance(-op.rock_share(), tilde, change);
    }
}

/// share K_c⁻¹ Pᵀ λ̃
void StepRock::by_compliance(double share, const VectorXd& tilde, VectorXd& change)
{
    on_rock_.noalias() = trace_.transpose() * tilde;
    change.noalias() = (share * structure_.rock_flexibility()) * on_rock_;
}

/// The rock's nodes follow from the gaps.
void StepRock::opposite(const DynamicOperator::Free& dam, const VectorXd& gap, VectorXd& change)
{
    on_pairs_.noalias() = structure_.planes().gaps() * dam.interface;
    on_pairs_ -= gap;
    change.noalias() = trace_.transpose() * on_pairs_;
}

void StepRock::end_step(const DynamicState& state)
{
    if (motion_) return;
    force_before_ = force_;
    if (structure_.has_rock()) set_product(structure_.rock_stiffness(), state.rock, force_);
}

void StepRock::damping_force(const VectorXd& velocity, VectorXd& force) const
{
    if (!structure_.has_rock()) return;
    if (motion_)
        force.setZero(velocity.size());
    else
        force.noalias() = (stiffness_damping_ * structure_.rock_stiffness()) * velocity;
}

void StepRock::instant(const DynamicState& state, BodyInstant& now) const
{
    now.force = force_ - load_;
    now.velocity = state.rock_v;
}

double StepRock::strain(const DynamicState& state) const
{
    return motion_ ? motion_->energy().strain : 0.5 * state.rock.dot(force_);
}

StepOperators::StepOperators(const ContactStructure& structure, const RunDamping& damping, const Scheme& scheme,
                             std::shared_ptr<const ReducedRock> radiating)
    : structure_(structure), damping_(damping), scheme_(scheme), radiating_(std::move(radiating)),
      slip_damping_(structure, damping), products_(structure.stiffness(), structure.mass())
{
    assert(!radiating_ || radiating_->base() == 2 * structure.rock_nodes());
}

const DynamicOperator& StepOperators::at(double dt)
{
    const std::scoped_lock lock(mutex_);
    auto& slot = operators_[dt];
    if (!slot)
        slot = std::make_unique<const DynamicOperator>(structure_, damping_, slip_damping_, step_constants(scheme_, dt),
                                                       radiating_.get());
    return *slot;
}

int StepOperators::made() const
{
    const std::scoped_lock lock(mutex_);
    return static_cast<int>(operators_.size());
}

} // namespace damslip::fe2d
