#include "fe2d/run/step_operators.hpp"

namespace damslip::fe2d {

StepOperators::StepOperators(const ContactStructure& structure, const RunDamping& damping, const Scheme& scheme)
    : structure_(structure), damping_(damping), scheme_(scheme), slip_damping_(structure, damping),
      products_(structure.stiffness(), structure.mass())
{
}

const DynamicOperator& StepOperators::at(double dt)
{
    const std::scoped_lock lock(mutex_);
    auto& slot = operators_[dt];
    if (!slot)
        slot =
            std::make_unique<const DynamicOperator>(structure_, damping_, slip_damping_, step_constants(scheme_, dt));
    return *slot;
}

int StepOperators::made() const
{
    const std::scoped_lock lock(mutex_);
    return static_cast<int>(operators_.size());
}

} // namespace damslip::fe2d
