#pragma once

#include "analysis/screen/given_yield_runs.hpp"
#include "core/table.hpp"
#include "sliding/empirical/regression.hpp"

/// Tables of what is computed without a scene: `slide` and `regress`.
namespace damslip::pages {

Table given_yield_table(const GivenYieldBlock& block, const std::vector<GivenYieldRow>& rows);

/// Of each regression whose inputs are given, the yield coefficient at which its median is the allowable slip [m].
Table allowable_coefficient_table(const sliding::RegressionInputs& inputs, double allowable);

} // namespace damslip::pages
