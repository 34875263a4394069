#include "fe2d/run/step_rock.hpp"

#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double update_share = 0.01; ///< slip after which P is made anew, of the smallest element [-]

} // namespace

StepRock::StepRock(const ContactStructure& structure, const RunDamping& damping, const SplitLoad& load,
                   const DynamicState& start)
    : structure_(structure), stiffness_damping_(damping.constants.stiffness), surface_{{}, load.rock, load.joint},
      trace_(structure.trace(0.0))
{
    rest_ = force_ = VectorXd::Zero(2 * structure.rock_nodes());
    find_load();
    if (structure.has_rock()) force_ = structure.rock_stiffness() * start.rock;
    if (!structure.slides_far()) return;
    geometric_rest_ = VectorXd::Zero(structure.pairs());
    geometric_rest_ = opening(start) - start.contact.opening;
}

void StepRock::find_load()
{
    load_ = structure_.rock_load(surface_, trace_);
    if (structure_.has_rock()) rest_ = structure_.rock_flexibility() * load_;
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

void StepRock::begin_step(const StepConstants& c, const DynamicState& state)
{
    if (!structure_.has_rock()) return;
    const double w = 1.0 + c.scheme.alpha, cv = c.scheme.alpha + w * c.a4, ca = w * c.a5, b_k = stiffness_damping_;
    free_ = (rest_ - state.rock + (b_k * cv) * state.rock_v + (b_k * ca) * state.rock_a) / (w * (1.0 + c.a1 * b_k));
}

VectorXd StepRock::free_gap() const
{
    return structure_.has_rock() ? VectorXd(trace_ * free_) : VectorXd();
}

VectorXd StepRock::step(const DynamicOperator& op, const DynamicOperator::Free& dam, const VectorXd& gap,
                        const VectorXd& tilde) const
{
    if (!structure_.has_rock() || structure_.matching()) return jump(op, dam, gap, tilde);
    return free_ - op.rock_share() * (structure_.rock_flexibility() * (trace_.transpose() * tilde));
}

VectorXd StepRock::jump(const DynamicOperator& op, const DynamicOperator::Free& dam, const VectorXd& gap,
                        const VectorXd& tilde) const
{
    if (!structure_.has_rock()) return {};
    if (!structure_.matching())
        return -op.rock_share() * (structure_.rock_flexibility() * (trace_.transpose() * tilde));
    const VectorXd opposite = structure_.planes().gaps() * dam.interface - gap; // the rock's nodes follow from the gaps
    return trace_.transpose() * opposite;
}

void StepRock::end_step(const DynamicState& state)
{
    force_before_ = force_;
    if (structure_.has_rock()) force_.noalias() = structure_.rock_stiffness() * state.rock;
}

VectorXd StepRock::damping_force(const VectorXd& velocity) const
{
    if (!structure_.has_rock()) return {};
    return stiffness_damping_ * (structure_.rock_stiffness() * velocity);
}

void StepRock::instant(const DynamicState& state, BodyInstant& now) const
{
    now.force = force_ - load_;
    now.velocity = state.rock_v;
}

} // namespace damslip::fe2d
