#include "fe2d/run/step_cuts.hpp"

#include <algorithm>

namespace damslip::fe2d {

int StepCuts::expected() const
{
    return control_ ? std::min(expected_, control_->largest_cuts) : 0;
}

bool StepCuts::after_contact(const ContactReport& report, int cuts, ContactStepper& step, const StepState& state,
                             DynamicCounts& counts) const
{
    const int more = control_ ? control_->largest_cuts : 0;
    if (!report.resolved() && cuts < largest_cuts + more) {
        ++counts.halved;
        return true;
    }
    if (cuts >= more || control_->local_error == 0.0 || step.slip_error(state) <= control_->local_error) return false;
    ++counts.refined;
    return true;
}

bool StepCuts::after_step(int cuts, const ContactStepper& step, const StepState& state, DynamicCounts& counts)
{
    if (!control_) return false;
    const double error = step.dam_error(state);
    if (cuts < control_->largest_cuts && control_->local_error > 0.0 && error > control_->local_error) {
        ++counts.refined;
        return true;
    }
    local_errors_.push_back(error);
    // twice the step has eight times the error
    expected_ = 8.0 * error > control_->local_error ? cuts : std::max(0, cuts - 1);
    return false;
}

} // namespace damslip::fe2d
