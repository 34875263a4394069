#pragma once

#include "core/table.hpp"
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

/// Uplift and critical friction of each model.
Table uplift_comparison_table(const std::vector<UpliftComparison>& all);

} // namespace damslip::sliding
