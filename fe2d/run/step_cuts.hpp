#pragma once

#include "fe2d/run/contact_stepper.hpp"

#include <optional>
#include <vector>

namespace damslip::fe2d {

/// When a step's contact is not resolved, nothing of it is kept and it is made in two halves, these in halves again,
/// down to this share of it.
inline constexpr int largest_cuts = 4; ///< dt / 2^4

/// Error control of the steps: a step is made in halves, these in halves again, while its local error is larger than
/// wanted.
struct StepControl {
    double local_error = 0.0; ///< of slip and dam of one step [m]; 0: steps stay whole, their errors are only noted
    int largest_cuts = 0;     ///< smallest step dt / 2^k
};

/// Says which steps are made in halves: those whose contact is not resolved, and with control those whose error is too
/// large.
class StepCuts {
public:
    void control(const StepControl& control) { control_ = control; }
    int expected() const; ///< cuts the next step is likely to need: larger steps are not tried
    const std::vector<double>& local_errors() const { return local_errors_; } ///< of the steps made under control [m]

    /// Asked when the contact of a step is known and nothing of the step is kept yet. @param cuts  that led to it
    bool after_contact(const ContactReport& report, int cuts, ContactStepper& step, const StepState& state,
                       DynamicCounts& counts) const;
    /// Asked again when all of the step is known.
    bool after_step(int cuts, const ContactStepper& step, const StepState& state, DynamicCounts& counts);

private:
    std::optional<StepControl> control_;
    int expected_ = 0;
    std::vector<double> local_errors_;
};

} // namespace damslip::fe2d
