#include "analysis/accuracy/model_level_runner.hpp"

#include "analysis/accuracy/accuracy.hpp"
#include "analysis/fe/mesh_error.hpp"
#include "analysis/prepare/ready.hpp"
#include "core/units.hpp"
#include "scene/joint_bond.hpp"
#include "scene/rock_mass.hpp"
#include "scene/water.hpp"
#include "sliding/empirical/regression.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace damslip {

namespace {

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

/// In centimetres, as regressions are published.
MotionOutcome regression_outcome(double median, const std::optional<double>& low, const std::optional<double>& high,
                                 const std::string& message)
{
    MotionOutcome outcome;
    outcome.level = SlipLevel::regressions;
    outcome.status = Status::at_rest;
    outcome.message = message;
    outcome.slip = median * units::cm;
    if (low) outcome.low = *low * units::cm;
    if (high) outcome.high = *high * units::cm;
    return outcome;
}

std::optional<MotionOutcome> ensemble_slip(const Scene& scene, const std::vector<sliding::RegressionResult>& results)
{
    std::vector<sliding::RegressionWeight> weights;
    for (const RegressionWeightKey& key : scene.regressions.weights)
        if (sliding::find_regression(key.model)) weights.push_back({key.model, key.weight});
    const sliding::Ensemble e = sliding::weighted_ensemble(results, weights);
    if (!e.median_cm) return std::nullopt;
    return regression_outcome(*e.median_cm, e.low_cm, e.high_cm, fmt::format("{} regressions", e.members.size()));
}

/// Slip by one regression, or by all that are valid together: the median, P(D = 0) counted, or the weighted median, with
/// 16 and 84 % where a sigma is published; the message is for the ensemble how many.
/// @param id  of a regression, or "ensemble". Nothing where it is not valid here.
std::optional<MotionOutcome> regression_slip(const std::string& id, const Ready& ready, const RecordPair& record,
                                             const RigidModel& model)
{
    const std::vector<sliding::RegressionResult> results = results_of(ready, record, model);
    if (id == "ensemble") return ensemble_slip(ready.scene, results);
    for (const sliding::RegressionResult& r : results) {
        if (r.regression->id == id && sliding::valid(r))
            return regression_outcome(*r.median_cm, r.minus_sd_cm, r.plus_sd_cm, "");
    }
    return std::nullopt;
}

/// The three regressions with the smallest published scatter among those that are valid for all records, and
/// "ensemble"; best first. Scatter is chosen by, not closeness to any result. Empty: none is valid, or the block slides
/// statically.
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
    for (std::size_t i = 0; i < std::min<std::size_t>(3, order.size()); ++i) ids.push_back(order[i].second);
    if (ensemble) ids.push_back("ensemble");
    return ids;
}

/// A line of /proc/self/status, "VmRSS:   1234 kB" [bytes].
std::optional<double> status_bytes(const std::string& name)
{
    std::ifstream status("/proc/self/status");
    std::string word;
    double kilobytes = 0.0;
    while (status >> word)
        if (word == name + ":" && status >> kilobytes) return 1024.0 * kilobytes;
    return std::nullopt;
}

bool reset_peak()
{
    std::ofstream clear("/proc/self/clear_refs");
    clear << "5"; // proc(5): the peak becomes the present size
    clear.flush();
    return clear.good();
}

/// Growth of the process' resident memory from when this object was made to the peak since. Linux only: the peak is
/// reset through /proc/self/clear_refs. Memory that the allocator kept from before is handed back first, so that it does
/// not hide what is used anew.
class PeakMemory {
public:
    PeakMemory()
    {
#ifdef __GLIBC__
        malloc_trim(0);
#endif
        if (reset_peak()) before_ = status_bytes("VmRSS");
    }
    std::optional<double> bytes() const ///< none: this system does not say
    {
        const std::optional<double> peak = status_bytes("VmHWM");
        if (!before_ || !peak) return std::nullopt;
        return std::max(0.0, *peak - *before_);
    }

private:
    std::optional<double> before_;
};

std::string first_line(const std::string& text)
{
    return text.substr(0, text.find('\n'));
}

/// FE models from poor to rich: what the scene's reservoir.model calls for, and the poorer one below it.
std::vector<ModelLevelWater> waters_of(const Scene& scene, std::vector<std::string>& left_out)
{
    if (!has_water(scene)) return {ModelLevelWater::dry};
    switch (scene.reservoir->model) {
    case ReservoirModel::hydrostatic:
        left_out.push_back(
            "Added mass and acoustic water are not in this hierarchy of models: reservoir.model = \"hydrostatic\".");
        return {ModelLevelWater::hydrostatic};
    case ReservoirModel::added_mass:
        left_out.push_back("Acoustic water is not in this hierarchy of models: reservoir.model = \"added-mass\"; with "
                           "\"auto\" it is.");
        return {ModelLevelWater::added_mass};
    case ReservoirModel::acoustic:
    case ReservoirModel::automatic:
        break;
    }
    return {ModelLevelWater::added_mass, ModelLevelWater::acoustic};
}

bool can_reduce(const Scene& scene, std::vector<std::string>& left_out)
{
    const std::optional<Diagnostic> why_not = why_not_reducible(scene);
    if (why_not)
        left_out.push_back("Reduced runs are not in this hierarchy of models: " + first_line(why_not->problem));
    return !why_not;
}

std::vector<double> other_alphas(const TimeOptions& time)
{
    std::vector<double> alphas{0.0, -0.05, -0.3};
    if (time.scheme == TimeScheme::hht || time.scheme == TimeScheme::automatic) std::erase(alphas, time.alpha);
    return alphas;
}

bool linear_elements(ElementKind kind)
{
    return kind == ElementKind::q4_incompatible || kind == ElementKind::q4 || kind == ElementKind::t3;
}

double coarsest_mesh(const Scene& scene)
{
    const double elements = elements_on_base(scene);
    double factor = 1.0;
    while (factor < 4.0 && elements / (2.0 * factor) >= least_elements) factor *= 2.0;
    return factor;
}

} // namespace

ModelLevelRunner::ModelLevelRunner(Scene scene, Records records, double read_seconds, const Watch& watch)
    : scene_(std::move(scene)), records_(std::move(records)), read_seconds_(read_seconds), watch_(watch)
{
}

ModelLevelResult ModelLevelRunner::run(const ModelLevel& model_level) const
{
    ModelLevelResult result;
    result.model_level = model_level;
    const PeakMemory memory;
    const ProcessorClock clock(ProcessorTimeOf::process);
    try {
        if (model_level.family == ModelLevelFamily::regression)
            run_regression(model_level, result);
        else
            run_model(model_level, result);
    } catch (const Interrupted& stop) {
        result.status = Status::interrupted;
        result.remark = stop.what();
    } catch (const InputError& error) {
        result.status = Status::refused;
        result.remark = first_line(error.diagnostics().front().problem);
    } catch (const NotConverged& error) {
        result.status = Status::not_resolved;
        result.remark = first_line(error.diagnostic().problem);
    }
    if (!result.done()) result.motions.clear(); // of some motions only
    result.seconds = read_seconds_ + clock.seconds();
    result.set_up_seconds += read_seconds_;
    result.bytes = memory.bytes();
    result.repeats = 1;
    return result;
}

void ModelLevelRunner::run_regression(const ModelLevel& model_level, ModelLevelResult& result) const
{
    const ProcessorClock clock(ProcessorTimeOf::process);
    const Ready ready = prepare(scene_, Method::rigid_block, records_);
    const RigidModel model = ready.rigid_model();
    result.set_up_seconds = clock.seconds();
    bool banded = true;
    for (const RecordPair& pair : ready.records()) {
        const std::optional<MotionOutcome> slip = regression_slip(model_level.regression, ready, pair, model);
        if (!slip) {
            result.status =
                model.state == sliding::StaticState::at_rest ? Status::refused : sliding::status_of(model.state);
            result.remark = "no valid value for record " + pair.files.name;
            return;
        }
        result.status = Status::at_rest;
        result.motions.insert(result.motions.end(), polarities_of(scene_).size(), *slip); // regressions know no polarity
        result.remark = slip->message;
        banded = banded && slip->low && slip->high;
    }
    if (!banded)
        for (MotionOutcome& motion : result.motions) motion.low = motion.high = std::nullopt;
}

void ModelLevelRunner::run_model(const ModelLevel& model_level, ModelLevelResult& result) const
{
    const ProcessorClock clock(ProcessorTimeOf::process);
    const Ready ready = prepare(scene_of(scene_, model_level),
                                model_level.family == ModelLevelFamily::rigid ? Method::rigid_block : Method::finite_elements,
                                records_, {.stop = watch_.stop()});
    const double seconds = clock.seconds();
    // Without an estimate of the modes left out: the hierarchy compares with the run that has all of them.
    static_cast<VariantRuns&>(result) = run_variant(ready,
                                                    {.modes = model_level.modes,
                                                     .rocking = model_level.scheme == RigidScheme::rocking,
                                                     .ends_at_failure = true,
                                                     .seconds_of = ProcessorTimeOf::process},
                                                    watch_);
    result.set_up_seconds += seconds;
    if (result.motions.empty()) return;
    result.status = result.motions.back().status;
    result.remark = result.motions.back().message;
}

/// In some motion the block tips before it slides.
bool ModelLevelRunner::rocks_first() const
{
    const VariantRuns runs = run_variant(prepare(scene_, Method::rigid_block, records_), {}, watch_);
    return std::any_of(runs.motions.begin(), runs.motions.end(),
                       [](const MotionOutcome& o) { return o.status == Status::rocks_first; });
}

double ModelLevelRunner::least_seconds(const ModelLevel& model_level) const
{
    constexpr double per_operation = 1e-10; // [s], of n³ in dense factors
    if (model_level.family != ModelLevelFamily::finite_elements || scene_.mesh.file) return 0.0;
    return per_operation * std::pow(2.0 * elements_on_base(scene_of(scene_, model_level)), 3.0);
}

HierarchyFacts ModelLevelRunner::facts() const
{
    HierarchyFacts facts;
    facts.rocks = rocks_first();
    facts.vertical = std::any_of(records_->begin(), records_->end(), [](const RecordPair& p) { return p.vertical; });
    if (!facts.vertical)
        facts.left_out.push_back("No model level with vertical motion: the records have none that counts.");
    facts.slammer = scene_.sliding.scheme == SlidingScheme::slammer;
    facts.regressions = best_regressions(scene_, records_);
    if (facts.regressions.empty()) facts.left_out.push_back("No regression is valid for all records.");
    if (!scene_.dam.young_modulus) {
        facts.left_out.push_back("No finite elements: dam.young_modulus_GPa is not given.");
        return facts;
    }
    facts.radiates = rock_radiates(scene_);
    for (const OtherModel& other : other_models())
        if (!other.level_word.empty() && other.concerns(scene_)) facts.other_models.emplace_back(other.level_word);
    facts.waters = waters_of(scene_, facts.left_out);
    facts.reducible = can_reduce(scene_of(scene_, parse_model_level("fe-added-mass:dt").value()), facts.left_out);
    facts.alphas = other_alphas(scene_.time);
    fe2d::RunOptions run;
    set_corrector(scene_, run);
    facts.corrects_steps = static_cast<bool>(run.corrector);
    facts.own_settings = scene_.time.substeps || with_exact_contact(scene_);
    facts.quadratic = linear_elements(scene_.mesh.element);
    if (!facts.quadratic)
        facts.left_out.push_back(
            "Quadratic elements are not tried beside the scene's, which are quadratic themselves.");
    facts.coarsest = coarsest_mesh(scene_);
    return facts;
}

} // namespace damslip
