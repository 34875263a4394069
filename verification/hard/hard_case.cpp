#include "verification/hard/hard_case.hpp"

#include <cmath>

namespace damslip::hard {

bool passed(const HardCase& subject, const HardResult& result)
{
    const auto within = [](const std::optional<double>& value, double bound) { return !value || *value <= bound; };
    return std::abs(result.value_a - result.value_b) <= result.tolerance &&
           within(result.complementarity, largest_complementarity) &&
           within(result.energy_closure, subject.energy_closure) && result.status == subject.expected_status;
}

HardCases all_hard_cases()
{
    HardCases cases;
    add_friction_cases(cases);
    add_opening_cases(cases);
    add_stiffness_cases(cases);
    add_time_cases(cases);
    add_record_cases(cases);
    add_water_cases(cases);
    add_law_cases(cases);
    add_self_excited_cases(cases);
    add_anchor_cases(cases);
    add_rate_cases(cases);
    add_bond_cases(cases);
    return cases;
}

} // namespace damslip::hard
