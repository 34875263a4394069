#pragma once

#include "analysis/accuracy/judge.hpp"

/// The drawing of the ladder: deviation from the top rung over seconds.
namespace damslip::pages {

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
