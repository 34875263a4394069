#include "analysis/accuracy/regression_rungs.hpp"

#include "core/units.hpp"
#include "sliding/empirical/regression.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numbers>

namespace damslip {

namespace {

constexpr std::size_t shown = 3;

/// Standard deviation of ln D.
double natural_sigma(const sliding::RegressionResult& r)
{
    return r.regression->logarithm == sliding::Logarithm::decimal ? r.sigma * std::numbers::ln10 : r.sigma;
}

std::vector<sliding::RegressionResult> results_of(const Ready& ready, const RecordPair& record, const RigidModel& model)
{
    const double period = ready.scene.regressions.period;
    return sliding::evaluate_all(regression_inputs(record, ready.motion(record), model, period));
}

std::optional<RegressionSlip> ensemble_slip(const Scene& scene, const std::vector<sliding::RegressionResult>& results)
{
    std::vector<sliding::RegressionWeight> weights;
    for (const RegressionWeightKey& key : scene.regressions.weights)
        if (sliding::find_regression(key.model)) weights.push_back({key.model, key.weight});
    const sliding::Ensemble e = sliding::weighted_ensemble(results, weights);
    if (!e.median_cm) return std::nullopt;
    RegressionSlip slip{*e.median_cm * units::cm, {}, {}, fmt::format("{} regressions", e.members.size())};
    if (e.low_cm) slip.low = *e.low_cm * units::cm;
    if (e.high_cm) slip.high = *e.high_cm * units::cm;
    return slip;
}

} // namespace

std::optional<RegressionSlip> regression_slip(const std::string& id, const Ready& ready, const RecordPair& record,
                                              const RigidModel& model)
{
    const std::vector<sliding::RegressionResult> results = results_of(ready, record, model);
    if (id == "ensemble") return ensemble_slip(ready.scene, results);
    for (const sliding::RegressionResult& r : results) {
        if (r.regression->id != id || !sliding::valid(r)) continue;
        RegressionSlip slip{*r.median_cm * units::cm, {}, {}, ""};
        if (r.minus_sd_cm) slip.low = *r.minus_sd_cm * units::cm;
        if (r.plus_sd_cm) slip.high = *r.plus_sd_cm * units::cm;
        return slip;
    }
    return std::nullopt;
}

std::vector<std::string> best_regressions(const Scene& scene, const Records& pairs)
{
    const Ready ready = prepare(scene, Method::rigid_block, pairs);
    const std::vector<RecordPair>& records = ready.records();
    const RigidModel model = ready.rigid_model();
    if (model.state != sliding::StaticState::at_rest || records.empty()) return {};
    std::map<std::string_view, std::pair<std::size_t, double>> seen; // id -> records it is valid for, largest scatter
    bool ensemble = true;
    for (const RecordPair& record : records) {
        const auto results = results_of(ready, record, model);
        ensemble = ensemble && ensemble_slip(ready.scene, results);
        for (const sliding::RegressionResult& r : results) {
            if (!sliding::valid(r) || r.sigma <= 0.0 || r.regression->use != sliding::EnsembleUse::estimate) continue;
            auto& [count, scatter] = seen[r.regression->id];
            ++count;
            scatter = std::max(scatter, natural_sigma(r));
        }
    }
    std::vector<std::pair<double, std::string>> order;
    for (const auto& [id, value] : seen)
        if (value.first == records.size()) order.emplace_back(value.second, std::string(id));
    std::sort(order.begin(), order.end());
    std::vector<std::string> ids;
    for (std::size_t i = 0; i < std::min(shown, order.size()); ++i) ids.push_back(order[i].second);
    if (ensemble) ids.push_back("ensemble");
    return ids;
}

} // namespace damslip
