#include "analysis/screen/regression_rows.hpp"

#include "core/input_error.hpp"
#include "core/units.hpp"
#include "sliding/flexible/flexible_mode.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip {

namespace {

/// The scene's weights. @throws InputError for an id that no regression has.
std::vector<sliding::RegressionWeight> regression_weights(const Scene& scene)
{
    std::vector<sliding::RegressionWeight> weights;
    for (const RegressionWeightKey& key : scene.regressions.weights) {
        if (!sliding::find_regression(key.model)) {
            std::string ids;
            for (const sliding::Regression& r : sliding::regressions())
                ids += (ids.empty() ? "" : ", ") + std::string(r.id);
            refuse(scene.file, fmt::format("regressions.weight.model = \"{}\" is not known.", key.model), ids,
                   "write one of these");
        }
        weights.push_back({key.model, key.weight});
    }
    return weights;
}

std::optional<double> metres(const std::optional<double>& value_cm)
{
    return value_cm ? std::optional<double>(*value_cm * units::cm) : std::nullopt;
}

RegressionRow regression_row(const std::string& record, const sliding::RegressionResult& r)
{
    RegressionRow row;
    row.record = record;
    row.id = r.regression->id;
    row.model = r.regression->name;
    row.median = metres(r.median_cm), row.low = metres(r.minus_sd_cm), row.high = metres(r.plus_sd_cm);
    row.nonzero_median = metres(r.nonzero_median_cm);
    row.zero_probability = r.zero_probability;
    row.valid = sliding::valid(r);
    row.status = sliding::reason(r);
    if (r.status != sliding::RegressionStatus::missing_input) row.remark = r.remark; // which the status names
    return row;
}

/// 16, 50 and 84 % of the weighted distribution; no numbers where no regression is valid.
RegressionRow ensemble_row(const std::string& record, const sliding::Ensemble& e, bool weights_given)
{
    RegressionRow row;
    row.record = record;
    row.id = weighted_median_id;
    row.model = "weighted median";
    row.valid = e.median_cm.has_value();
    row.status = row.valid ? "valid" : "no regression valid";
    row.remark = "no regression valid here";
    if (!row.valid) return row;
    row.median = metres(e.median_cm), row.low = metres(e.low_cm), row.high = metres(e.high_cm);
    row.remark = fmt::format("of {}, {}", e.members.size(), weights_given ? "weights of the scene" : "equal weights");
    if (weights_given && e.weight_left_out > 0.0)
        row.remark += fmt::format("; {:.3g} % of the weight on others", 100.0 * e.weight_left_out);
    return row;
}

} // namespace

std::vector<RegressionRow> regression_rows(const std::string& record, const sliding::RegressionInputs& inputs,
                                           const std::vector<sliding::RegressionWeight>& weights)
{
    const std::vector<sliding::RegressionResult> results = sliding::evaluate_all(inputs);
    const sliding::Ensemble ensemble = sliding::weighted_ensemble(results, weights);
    std::vector<RegressionRow> rows;
    for (const sliding::RegressionResult& r : results) {
        rows.push_back(regression_row(record, r));
        const auto member = std::find(ensemble.members.begin(), ensemble.members.end(), r.regression->id);
        if (member != ensemble.members.end())
            rows.back().weight = ensemble.weights[static_cast<std::size_t>(member - ensemble.members.begin())];
        else if (rows.back().valid && rows.back().remark.empty())
            rows.back().remark = "not weighted";
    }
    rows.push_back(ensemble_row(record, ensemble, !weights.empty()));
    return rows;
}

std::vector<RegressionRow> regression_rows(const Scene& scene, const RigidModel& model,
                                           const std::vector<RecordPair>& records)
{
    const std::vector<sliding::RegressionWeight> weights = regression_weights(scene);
    std::vector<RegressionRow> rows;
    for (const RecordPair& pair : records) {
        auto inputs = regression_inputs(pair, ground_motion(scene, pair), model, scene.regressions.period);
        const bool stands = model.state == sliding::StaticState::at_rest;
        if (!stands) inputs.yield_coefficient = 0.0; // no regression is of a block that floats or slides upstream
        for (RegressionRow& row : regression_rows(pair.files.name, inputs, weights)) {
            if (!stands && row.id != weighted_median_id) row.status = word(sliding::status_of(model.state));
            rows.push_back(std::move(row));
        }
    }
    return rows;
}

std::optional<double> yield_coefficient_for(const sliding::Regression& regression, sliding::RegressionInputs inputs,
                                            double slip)
{
    constexpr double settled = 1e-9, least = 1e-4;
    double low = least;
    for (const sliding::ValidityRange& range : regression.validity)
        if (range.input == sliding::RegressionInput::yield_coefficient) low = std::max(low, range.low);
    double high = std::max(low, inputs.pga_g);
    const auto median = [&](double yield) {
        inputs.yield_coefficient = yield;
        return sliding::evaluate(regression, inputs).median_cm;
    };
    const std::optional<double> most = median(low);
    if (!most || *most < slip / units::cm) return std::nullopt;
    const auto slips_more = [&](double yield) { return median(yield).value_or(0.0) * units::cm > slip; };
    while (slips_more(high) && high < 100.0) high *= 2.0; // a mass that vibrates asks for more than the ground has
    while (high - low > settled) {
        const double middle = 0.5 * (low + high);
        (slips_more(middle) ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

namespace {

GivenYieldRow given_yield_run(const GivenYieldBlock& block, const sliding::SlipStages& stages,
                              const GroundMotion& motion, const std::string& method)
{
    GivenYieldRow row;
    row.record = motion.name;
    row.method = method;
    row.pga = row.largest_acceleration = peak_of(motion.accel_h);
    if (method != "rigid") {
        row.mode = block.flexible;
        if (block.column) {
            const sliding::StrainCompatible found =
                strain_compatible(*block.column, motion, block.flexible->mass_ratio);
            row.mode = found.block;
            row.settled = found.settled;
        }
        row.largest_acceleration = 0.0;
    }
    sliding::SlideOptions options;
    options.sliding.two_way = block.two_way;
    for (const int polarity : {1, -1}) {
        options.polarity = polarity;
        sliding::SlideResult& slide = polarity > 0 ? row.normal : row.inverse;
        if (!row.mode) {
            slide = sliding::slide(motion, stages, options);
            continue;
        }
        sliding::FlexibleSlide found = method == "coupled"
                                           ? sliding::slide_coupled(motion, stages, *row.mode, options)
                                           : sliding::slide_decoupled(motion, stages, *row.mode, options);
        row.largest_acceleration = std::max(row.largest_acceleration, found.peak_acceleration);
        slide = std::move(found.slide);
    }
    if (!row.settled) row.normal.status = row.inverse.status = Status::not_resolved;
    return row;
}

} // namespace

Status GivenYieldRow::status() const
{
    const int one = status_row(normal.status).exit_code, other = status_row(inverse.status).exit_code;
    if (one != other) return worse_exit_code(one, other) == one ? normal.status : inverse.status;
    return normal.status == Status::at_rest ? inverse.status : normal.status;
}

std::vector<GivenYieldRow> given_yield_runs(const GivenYieldBlock& block, const std::vector<GroundMotion>& motions,
                                            const std::vector<std::string>& methods)
{
    const sliding::SlipStages stages = sliding::stages_of_yield(block.yield);
    std::vector<GivenYieldRow> rows;
    for (const GroundMotion& motion : motions) {
        GroundMotion horizontal = motion;
        horizontal.accel_v.clear();
        for (const std::string& method : methods) {
            rows.push_back(given_yield_run(block, stages, horizontal, method));
            rows.back().yield = block.yield.front().yield;
        }
    }
    return rows;
}

} // namespace damslip
