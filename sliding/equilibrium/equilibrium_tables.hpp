#pragma once

#include "core/csv.hpp"
#include "sliding/equilibrium/combinations.hpp"

#include <vector>

/// Results of the limit equilibrium as tables for people and files.
namespace damslip::sliding {

/// One row per load, sum and uplift of one combination: Fx, Fy [kN/m], moment about the heel [kN m/m].
Table load_table(const Equilibrium& e);

/// One row per combination: levels, seismic coefficients, N', T, U, factors, resultant, stresses, crack, accelerations.
Table equilibrium_table(const std::vector<Equilibrium>& all);

/// One row per check of each combination: value, required value, PASS / FAIL / no criterion, source.
Table verdict_table(const std::vector<Equilibrium>& all);

/// For people: a row for each combination that is judged, a column for each check: "FAIL 2.950 / 3".
Table check_matrix(const std::vector<Equilibrium>& all);

/// The checks that fail, the strongest answer of the combinations: "usual 2.95 < 3.0; post-MCE, cracked 1.01 < 1.1";
/// empty: all hold, or none is required.
std::string failed_checks(const std::vector<Equilibrium>& all);
/// "2.95 < 3.0", with as many digits as tell the two apart. @param required  least value, or largest where `value` is above it
std::string unmet_words(double value, double required);

/// Uplift and critical friction of each model.
Table uplift_comparison_table(const std::vector<UpliftComparison>& all);

} // namespace damslip::sliding
