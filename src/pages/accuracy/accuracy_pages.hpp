#pragma once

#include "analysis/accuracy/accuracy.hpp"
#include "analysis/prepare/records.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/page.hpp"

namespace damslip::pages {

struct AccuracyReportInput {
    const Scene& scene;
    const std::vector<RecordPair>& records;
    const std::vector<ModelLevelResult>& results;
    const Judgement& judgement;
    double tolerance;
    std::string command;               ///< that runs the chosen model level; empty: none is chosen
    std::vector<std::string> messages; ///< what is left out and why

    std::vector<MotionName> motions() const { return motion_names(scene, records); }
};

Answer accuracy_answer(const AccuracyReportInput& input);

/// The model levels as a CSV file, with what is finished.
std::string accuracy_csv(const Scene& scene, const std::vector<ModelLevelResult>& results, const Judgement& judgement);

/// One model level alone.
Answer one_model_level_answer(const ModelLevelResult& result, const std::vector<MotionName>& motions);

/// The hierarchy as a page: the answer, error against seconds, convergence of each model, the tables.
Page accuracy_page(const AccuracyReportInput& input);

/// What a figure of this scene is called.
std::string figure_title(const Scene& scene, const std::vector<RecordPair>& records);

/// One row per model level: slip, what is open, difference of models, deviation from the top model level, cost.
Table model_level_table(const std::vector<ModelLevelResult>& results, const Judgement& judgement);

/// One row per model with two model levels at least: its limit and the orders in which its model levels tend to it.
Table model_table(const std::vector<ModelLevelResult>& results, const Judgement& judgement);

/// Did some model level run, and every one that did find that the dam does not stand without an earthquake? That is an answer.
bool all_fail_statically(const std::vector<ModelLevelResult>& results);

/// "slip 40.8 mm, 0.8 % off the finest model level, in 0.3 s" of the cheapest model level within the tolerance, or why there is none.
std::string choice_sentence(const std::vector<ModelLevelResult>& results, const Judgement& judgement, double tolerance);

/// The drawing of the hierarchy: deviation from the top model level over seconds.

enum class FigureStyle {
    page,      ///< colours of the report page it stands in
    standalone ///< a file of its own, colours included, for light and dark
};

/// Both axes logarithmic. A dot for each model level, the Pareto front as steps with its model levels named, the tolerance, and what
/// the top model level itself leaves open. An <svg> element; empty where no model level has a deviation.
std::string cost_figure(const std::vector<ModelLevelResult>& results, const Judgement& judgement, double tolerance,
                        const std::string& title, FigureStyle style);

/// Kinds of model levels told apart by colour.
enum class ModelLevelKind { regression, rigid, reduced, finite_elements, variant, acoustic, quadratic, other_rock };
ModelLevelKind kind_of(const ModelLevel& model_level);
std::string kind_name(ModelLevelKind kind, const std::vector<ModelLevelResult>& results);

} // namespace damslip::pages
