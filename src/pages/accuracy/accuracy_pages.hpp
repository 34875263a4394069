#pragma once

#include "analysis/accuracy/accuracy.hpp"
#include "analysis/prepare/records.hpp"
#include "core/csv.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/page.hpp"

#include <nlohmann/json_fwd.hpp>

namespace damslip::pages {

struct AccuracyReportInput {
    const Scene& scene;
    const std::vector<RecordPair>& records;
    const std::vector<RungResult>& results;
    const Judgement& judgement;
    double tolerance;
    std::string command;               ///< that runs the chosen rung; empty: none is chosen
    std::vector<std::string> messages; ///< what is left out and why

    std::vector<MotionName> motions() const { return motion_names(scene, records); }
};

Answer accuracy_answer(const AccuracyReportInput& input);

/// The rungs as a CSV file, with what is finished.
std::string accuracy_csv(const Scene& scene, const std::vector<RungResult>& results, const Judgement& judgement);

/// One rung alone.
Answer one_rung_answer(const RungResult& result, const std::vector<MotionName>& motions);

/// The ladder as a page: the answer, error against seconds, convergence of each model, the tables.
Page accuracy_page(const AccuracyReportInput& input);

/// What a figure of this scene is called.
std::string figure_title(const Scene& scene, const std::vector<RecordPair>& records);

/// One row per rung: slip, what is open, difference of models, deviation from the top rung, cost.
Table rung_table(const std::vector<RungResult>& results, const Judgement& judgement);

/// Those that no rung as fast beats, the finest first.
Table front_table(const std::vector<RungResult>& results, const Judgement& judgement);

/// One row per model with two rungs at least: its limit and the orders in which its rungs tend to it.
Table model_table(const std::vector<RungResult>& results, const Judgement& judgement);

/// Slip of every rung for every motion [m], for files.
Table slip_table(const std::vector<RungResult>& results, const std::vector<MotionName>& motions);

/// Slips of one rung, by motion.
Table one_rung_table(const RungResult& result, const std::vector<MotionName>& motions);

/// Did some rung run, and every one that did find that the dam does not stand without an earthquake? That is an answer.
bool all_fail_statically(const std::vector<RungResult>& results);

/// "slip 40.8 mm, 0.8 % off the finest rung, in 0.3 s" of the cheapest rung within the tolerance, or why there is none.
std::string choice_sentence(const std::vector<RungResult>& results, const Judgement& judgement, double tolerance);

/// The drawing of the ladder: deviation from the top rung over seconds.

enum class FigureStyle {
    page,      ///< colours of the report page it stands in
    standalone ///< a file of its own, colours included, for light and dark
};

/// Both axes logarithmic. A dot for each rung, the Pareto front as steps with its rungs named, the tolerance, and what
/// the top rung itself leaves open. An <svg> element; empty where no rung has a deviation.
std::string cost_figure(const std::vector<RungResult>& results, const Judgement& judgement, double tolerance,
                        const std::string& title, FigureStyle style);

/// Kinds of rungs told apart by colour.
enum class RungKind { regression, rigid, reduced, finite_elements, variant, acoustic, quadratic, other_rock };
RungKind kind_of(const Rung& rung);
std::string kind_name(RungKind kind, const std::vector<RungResult>& results);

} // namespace damslip::pages
