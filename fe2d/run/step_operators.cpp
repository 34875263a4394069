#include "fe2d/run/step_operators.hpp"

#include <cassert>

namespace damslip::fe2d {

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
