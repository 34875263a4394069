#pragma once

#include "analysis/assess/assess.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/page.hpp"

namespace damslip::pages {

/// The assessment as the one report that is handed in. @param a  of `given`, the scene as read @param plan  what was to be done; the page
/// says what came of it
Page assess_page(const Assessment& a, const Scene& given, const WorkPlan& plan);
Answer assess_answer(const Assessment& a, const Scene& given);
Headline assess_headline(const Assessment& a);

/// What the numbers say of levels that disagree, a sentence each.
std::vector<std::string> disagreement_sentences(const Assessment& a);

/// What an assessment is going to do, for whoever has to agree to it before it runs: purpose, models in order, premises, judgement, what
/// is left out, cost, values to agree on.
Page work_plan_page(const WorkPlan& plan, const Scene& given);
Answer work_plan_answer(const WorkPlan& plan, const Scene& given);

/// The parts in their order: motions, why, estimated seconds. @param done  adds what each took and what came out; null: not run
Table work_plan_table(const WorkPlan& plan, const Assessment* done = nullptr);

/// What is judged: quantity, required value, by which model, source.
Table judgement_table(const Ready& ready);

} // namespace damslip::pages
