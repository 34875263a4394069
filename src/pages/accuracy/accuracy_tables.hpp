#pragma once

#include "analysis/accuracy/judge.hpp"
#include "analysis/prepare/records.hpp"
#include "core/table.hpp"

namespace damslip::pages {

/// One row per rung: slip, what is open, difference of models, deviation from the top rung, cost.
Table rung_table(const std::vector<RungResult>& results, const Judgement& judgement);

/// One row per model with two rungs at least: its limit and the orders in which its rungs tend to it.
Table model_table(const std::vector<RungResult>& results, const Judgement& judgement);

/// Slip of every rung for every record [m], for files.
Table slip_table(const std::vector<RungResult>& results, const std::vector<RecordPair>& records);

/// Slips of one rung, by record.
Table one_rung_table(const RungResult& result, const std::vector<RecordPair>& records);

/// Did some rung run, and every one that did find that the dam does not stand without an earthquake? That is an answer.
bool all_fail_statically(const std::vector<RungResult>& results);

/// "slip 40.8 mm, 0.8 % off the finest rung, in 0.3 s" of the cheapest rung within the tolerance, or why there is none.
std::string choice_sentence(const std::vector<RungResult>& results, const Judgement& judgement, double tolerance);

} // namespace damslip::pages
