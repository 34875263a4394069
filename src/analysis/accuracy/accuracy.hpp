#pragma once

#include "analysis/accuracy/hierarchy.hpp"
#include "analysis/accuracy/model_level_runner.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <span>
#include <vector>

/// What the model levels say about each other. No model is run here.
namespace damslip {

/// The slip that the model levels of one model tend to, and how fast.
struct ModelLimit {
    std::string model;        ///< model_of the model levels
    std::vector<double> slip; ///< of each motion [m]
    /// What the extrapolation itself cannot resolve, of each motion: half of what it adds [m].
    std::vector<double> open;
    /// Observed orders, of the controlling motion: in the step, the element size, the penalty's inverse and the number of
    /// modes [-].
    std::optional<double> order_step, order_mesh, order_penalty, order_modes;
    bool mesh_known = false; ///< there are at least two meshes; else the limit is that of the scene's mesh
};

/// One model level beside the others, by motion the worst.
struct ModelLevelVerdict {
    /// Estimate of what steps, elements, penalty and modes leave open: |slip - limit of the model|, at least the limit's
    /// `open` [m]. Nothing for regressions and models with one model level.
    std::optional<double> error;
    std::optional<double> model_difference; ///< limit of the model (slip, where it has none) - that of the top's [m]
    std::optional<double> off_top;          ///< slip - top's [m]
    /// (|slip - top's| + top's error) / |top's slip| [-], slips below `least_slip` taken as that; nothing without an
    /// error of the top.
    std::optional<double> deviation;
    bool front = false; ///< no model level as fast or faster deviates less
};

struct Judgement {
    std::optional<std::size_t> top; ///< of the results; none: no model level is done
    std::size_t motion = 0;         ///< whose figures in metres are shown: the largest slip of the top model level
    std::vector<ModelLimit> models; ///< of FE models with at least two steps
    std::vector<ModelLevelVerdict> model_levels; ///< by result
    /// A model level above the top that ran and has no final slip: what the top says is then in doubt, and none is chosen.
    std::optional<std::size_t> contradiction;
    std::optional<double> top_error;   ///< over the top's slip, the worst motion [-]
    std::optional<std::size_t> choice; ///< cheapest model level within the tolerance; none: the top is not within it either
};

inline constexpr double least_slip = 1e-4; ///< [m]: relative deviations of smaller slips mean nothing

Judgement judge_model_levels(const std::vector<ModelLevelResult>& results, double tolerance);

/// The model level with the fewest seconds among those whose deviation is within the tolerance; of equals the first. A larger
/// tolerance admits all model levels that a smaller one does, so it never names a slower one.
std::optional<std::size_t> cheapest_within(std::span<const double> seconds,
                                           std::span<const std::optional<double>> deviation, double tolerance);

/// Pareto front: model levels such that none that is at least as fast deviates less, nor one as little and faster.
std::vector<bool> pareto_front(std::span<const double> seconds, std::span<const std::optional<double>> deviation);

/// What accuracy costs on one scene: every model level with its slip, seconds and bytes, and what they say about each other.
struct Accuracy {
    std::vector<ModelLevelResult> model_levels;
    Judgement judgement; ///< names the cheapest model level within the tolerance
};

/// Runs the hierarchy with all records of the scene. @param tolerance  share of the slip [-]
/// @throws InputError, Interrupted as read_records(); what a model level cannot do is its result
Accuracy measure_accuracy(const Scene& scene, double tolerance, Effort effort, const Watch& watch);

/// The scene that a model level runs; `fe` and `screen` run it alone to the same slip.
Scene scene_of(const Scene& scene, const ModelLevel& model_level);

/// What a sequence of refined results says about its limit.

/// Orders an extrapolation relies on: contact with moving edges is of first order at worst, the schemes and elements
/// of second at best.
inline constexpr double least_order = 1.0, largest_order = 2.0;

/// Order p of e_k = c r^(-p k), from the last three values v_k = v + e_k: ln(|v1 - v0| / |v2 - v1|) / ln r. Nothing for
/// fewer values or where the last two agree. It is what the values show, whatever that is.
/// @param ratio  r of sizes from one value to the next, > 1 [-]
std::optional<double> observed_order(std::span<const double> values, double ratio = 2.0);

/// The same where the limit is known: ln(|e1| / |e2|) / ln r of the last two errors.
std::optional<double> order_of_errors(std::span<const double> errors, double ratio);

/// Observed orders of sequences that converge as they should, accidents allowed for: outside, values are not yet, or not
/// only, following the power law that extrapolation rests on.
inline constexpr double lowest_plausible_order = 0.5, highest_plausible_order = 2.5;

struct Limit {
    double value = 0.0;
    double correction = 0.0;     ///< value - last value of the sequence
    std::optional<double> order; ///< observed

    bool plausible() const { return !order || (*order >= lowest_plausible_order && *order <= highest_plausible_order); }
};

/// Richardson's extrapolation (Richardson 1911; Roache 1998) of values from coarse to fine, each size 1/ratio of the one
/// before: v + (v_n - v_(n-1)) / (r^p - 1) with the observed order, held between least_order and largest_order.
/// @param elsewhere  order observed in another sequence, for two values; none: first order. Nothing for fewer values.
std::optional<Limit> extrapolated(std::span<const double> values, double ratio = 2.0,
                                  const std::optional<double>& elsewhere = {});

} // namespace damslip
