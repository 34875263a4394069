#include "fe2d/run/step_rock.hpp"

#include "fe2d/solver/dense_product.hpp"

#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

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
    VectorXd gap = structure_.planes().gaps() * state.u.tail(2 * structure_.interface());
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

} // namespace damslip::fe2d
