#pragma once

#include "analysis/accuracy/rung_result.hpp"

#include <span>
#include <vector>

/// What the rungs say about each other. No model is run here.
namespace damslip {

/// The slip that the rungs of one model tend to, and how fast.
struct ModelLimit {
    std::string model;        ///< model_of the rungs
    std::vector<double> slip; ///< of each record [m]
    /// What the extrapolation itself cannot resolve, of each record: half of what it adds [m].
    std::vector<double> open;
    /// Observed orders, of the controlling record: in the step, the element size, the penalty's inverse and the number of
    /// modes [-].
    std::optional<double> order_step, order_mesh, order_penalty, order_modes;
    bool mesh_known = false; ///< there are at least two meshes; else the limit is that of the scene's mesh
};

/// One rung beside the others, by record the worst.
struct RungVerdict {
    /// Estimate of what steps, elements, penalty and modes leave open: |slip - limit of the model|, at least the limit's
    /// `open` [m]. Nothing for regressions and models with one rung.
    std::optional<double> error;
    std::optional<double> model_difference; ///< limit of the model (slip, where it has none) - that of the top's [m]
    std::optional<double> off_top;          ///< slip - top's [m]
    /// (|slip - top's| + top's error) / |top's slip| [-], slips below `least_slip` taken as that; nothing without an
    /// error of the top.
    std::optional<double> deviation;
    bool front = false; ///< no rung as fast or faster deviates less
};

struct Judgement {
    std::optional<std::size_t> top; ///< of the results; none: no rung is done
    std::size_t record = 0;         ///< whose figures in metres are shown: the largest slip of the top rung
    std::vector<ModelLimit> models; ///< of FE models with at least two steps
    std::vector<RungVerdict> rungs; ///< by result
    /// A rung above the top that ran and has no final slip: what the top says is then in doubt, and none is chosen.
    std::optional<std::size_t> contradiction;
    std::optional<double> top_error;   ///< over the top's slip, the worst record [-]
    std::optional<std::size_t> choice; ///< cheapest rung within the tolerance; none: the top is not within it either
};

inline constexpr double least_slip = 1e-4; ///< [m]: relative deviations of smaller slips mean nothing

Judgement judge_rungs(const std::vector<RungResult>& results, double tolerance);

/// The rung with the fewest seconds among those whose deviation is within the tolerance; of equals the first. A larger
/// tolerance admits all rungs that a smaller one does, so it never names a slower one.
std::optional<std::size_t> cheapest_within(std::span<const double> seconds,
                                           std::span<const std::optional<double>> deviation, double tolerance);

/// Pareto front: rungs such that none that is at least as fast deviates less, nor one as little and faster.
std::vector<bool> pareto_front(std::span<const double> seconds, std::span<const std::optional<double>> deviation);

} // namespace damslip
