#pragma once

#include "analysis/assess/assess.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/page.hpp"

#include <nlohmann/json_fwd.hpp>

/// The assessment as the one report that is handed in.
namespace damslip::pages {

/// Slip of every level under every record, and the finite elements' variants.
Table level_table(const Assessment& a);
Table assumption_table(const Assessment& a);

/// What the numbers say together, a sentence each; each from a result.
std::vector<std::string> governing_sentences(const Assessment& a);
std::vector<std::string> disagreement_sentences(const Assessment& a);
std::vector<std::string> mover_sentences(const Assessment& a);
std::vector<std::string> after_sentences(const Assessment& a);
/// Effects that are off: those that the scene does not name, or those that a choice of scene or method takes off.
std::vector<std::string> not_named(const Assessment& a);
std::vector<std::string> taken_off(const Assessment& a);

Headline assess_headline(const Assessment& a);

/// @param given  the scene as read @param plan  what was to be done; the page says what came of it
Page assess_page(const Assessment& a, const Scene& given, const WorkPlan& plan);
Answer assess_answer(const Assessment& a, const Scene& given);

} // namespace damslip::pages
