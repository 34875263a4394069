#include "fe2d/run/step_rock.hpp"

#include "fe2d/run/dense_product.hpp"

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
        VectorXd constant(op.rock_step()->rock().interface());
        constant << load_, -scale * ((alpha + w * c.a4) * on_floor(state.v) + w * c.a5 * on_floor(state.a));
        motion_->begin(*op.rock_step(), constant);
        return;
    }
    if (!structure_.has_rock()) return;
    const StepConstants& c = op.constants();
    const double w = 1.0 + c.scheme.alpha, cv = c.scheme.alpha + w * c.a4, ca = w * c.a5, b_k = stiffness_damping_;
    free_ = (rest_ - state.rock + (b_k * cv) * state.rock_v + (b_k * ca) * state.rock_a) / (w * (1.0 + c.a1 * b_k));
}

VectorXd StepRock::on_floor(const VectorXd& dam) const
{
    VectorXd values(static_cast<Index>(structure_.floor().size()));
    for (Index k = 0; k < values.size(); ++k) values[k] = dam[structure_.floor()[static_cast<std::size_t>(k)]];
    return values;
}

void StepRock::load_water(const DynamicOperator& op, VectorXd& dam) const
{
    if (!op.has_floor()) return;
    const StepConstants& c = op.constants();
    const double alpha = c.scheme.alpha, w = 1.0 + alpha, scale = structure_.water()->scale;
    const Index floor = op.rock_step()->rock().floor;
    const VectorXd load =
        op.floor_factor() * motion_->free_step().tail(floor) -
        scale * ((alpha + w * c.a4) * motion_->velocity().tail(floor) + w * c.a5 * motion_->acceleration().tail(floor));
    for (Index k = 0; k < floor; ++k) dam[structure_.floor()[static_cast<std::size_t>(k)]] += load[k];
}

/// What forces on the pairs, and the floor's pressures with them, are on the interface of radiating rock.
VectorXd StepRock::weighted_force(const DynamicOperator& op, const DynamicOperator::Free& dam,
                                  const VectorXd& tilde) const
{
    VectorXd force = -(trace_.transpose() * tilde);
    if (!op.has_floor()) return force;
    VectorXd with_floor(op.rock_step()->rock().interface());
    with_floor << force, op.floor_factor() * op.on_floor(dam.interface);
    return with_floor;
}

VectorXd StepRock::free_gap() const
{
    if (!structure_.has_rock()) return {};
    if (motion_) return trace_ * motion_->free_step().head(trace_.cols());
    return trace_ * free_;
}

FloorMotion StepRock::floor() const
{
    const auto rows = static_cast<Index>(structure_.floor().size());
    if (!motion_ || rows == 0) return {};
    return {motion_->displacement().tail(rows), motion_->velocity().tail(rows)};
}

VectorXd StepRock::step(const DynamicOperator& op, const DynamicOperator::Free& dam, const VectorXd& gap,
                        const VectorXd& tilde)
{
    if (!structure_.has_rock()) return {};
    if (motion_) {
        motion_->finish(weighted_force(op, dam, tilde));
        return motion_->step().head(trace_.cols());
    }
    if (structure_.matching()) return opposite(dam, gap);
    return free_ - op.rock_share() * (structure_.rock_flexibility() * (trace_.transpose() * tilde));
}

VectorXd StepRock::jump(Jump of, const DynamicOperator& op, const DynamicOperator::Free& dam, const VectorXd& gap,
                        const VectorXd& tilde)
{
    if (!structure_.has_rock()) return {};
    if (motion_) {
        const VectorXd force = weighted_force(op, dam, tilde);
        const VectorXd jump = of == Jump::velocity ? motion_->jump_velocity(force) : motion_->jump_acceleration(force);
        return jump.head(trace_.cols());
    }
    if (structure_.matching()) return opposite(dam, gap);
    return -op.rock_share() * (structure_.rock_flexibility() * (trace_.transpose() * tilde));
}

/// The rock's nodes follow from the gaps.
VectorXd StepRock::opposite(const DynamicOperator::Free& dam, const VectorXd& gap) const
{
    return trace_.transpose() * VectorXd(structure_.planes().gaps() * dam.interface - gap);
}

void StepRock::end_step(const DynamicState& state)
{
    if (motion_) return;
    force_before_ = force_;
    if (structure_.has_rock()) set_product(structure_.rock_stiffness(), state.rock, force_);
}

VectorXd StepRock::damping_force(const VectorXd& velocity) const
{
    if (!structure_.has_rock()) return {};
    if (motion_) return VectorXd::Zero(velocity.size());
    return stiffness_damping_ * (structure_.rock_stiffness() * velocity);
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
