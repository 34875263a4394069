#pragma once

#include "analysis/assess/assess.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/page.hpp"

/// What an assessment is going to do, for whoever has to agree to it before it runs; and what came of it.
namespace damslip::pages {

/// The parts in their order: motions, why, estimated seconds. @param done  adds what each took and what came out; null: not run
Table work_plan_table(const WorkPlan& plan, const Assessment* done = nullptr);

/// What is judged: quantity, required value, by which model, source.
Table judgement_table(const Ready& ready);

/// Purpose, models in order, premises, judgement, what is left out, cost, values to agree on.
Page work_plan_page(const WorkPlan& plan, const Scene& given);
Answer work_plan_answer(const WorkPlan& plan, const Scene& given);

} // namespace damslip::pages
