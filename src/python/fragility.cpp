// How likely the dam slides too far: curves, and every run as arrays that lie in the result.
#include "module.hpp"

#include "analysis/fragility/fragility_study.hpp"
#include "core/input_error.hpp"
#include "pages/fragility/fragility_pages.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fmt/format.h>
#include <map>

namespace damslip::python {

namespace {

/// Runs of a scene's fragility, with what they say.
struct FragilityResult final : Result {
    std::optional<FragilityStudy> study;
    std::optional<ConditionedPlan> conditioned; ///< friction is not drawn for each run
    FragilityPlan plan;
    FragilityRuns runs;
    FragilityAnswer estimated;
    std::vector<FragilitySample> samples; ///< of the plan, for arrays to lie on
    std::vector<double> slip, max_slip;   ///< of each run [m]; NaN: none

    pages::FragilityView view() const { return {*study, plan, runs, estimated}; }

    pages::Answer answer() const override { return pages::fragility_answer(view()); }
    std::vector<std::pair<std::string, Table>> tables() const override
    {
        std::vector<std::pair<std::string, Table>> all = answer().tables();
        all.emplace_back("rate_parts", pages::rate_part_table(view()));
        all.emplace_back("samples", pages::sample_table(view()));
        return all;
    }
    std::string first_table() const override { return "probabilities"; }
    pages::Page page() const override { return pages::fragility_page(view()); }
    pages::Headline headline() const override { return page().headline; }
};

/// What is asked for beyond the scene's tables.
struct Asked {
    std::string tables; ///< TOML in place of the scene's
    std::string method;
    std::optional<std::size_t> samples;
    Conditioning conditioning = Conditioning::automatic;
    FragilityExtras extras;
};

void compute(const OpenedScene& opened, const Asked& asked, Watch& watch, FragilityResult& result)
{
    const SceneText text = opened.changes.empty() ? *opened.text : opened.text->set(opened.changes);
    FragilityInput input = fragility_input_of(*opened.written, asked.tables, text.file());
    result.study.emplace(open_fragility(text, opened.scene, std::move(input), asked.method));
    const FragilityStudy& study = *result.study;
    const std::size_t samples = asked.samples.value_or(study.usual_samples());
    result.conditioned = condition_on_friction(study, asked.conditioning, samples, asked.extras.jobs, watch);
    const ConditionedPlan* const by_friction = result.conditioned ? &*result.conditioned : nullptr;
    result.plan = by_friction ? by_friction->plan : study.plan(samples);
    for (const FragilitySample& sample : result.plan.samples) result.samples.push_back(sample);
    result.runs = run_fragility(result.plan, study.text, study.method, wanted_samples(result.plan), nullptr,
                                asked.extras.jobs, watch);
    result.estimated = answer_fragility(study, result.plan, result.runs, asked.extras, watch, by_friction);
    const auto number = [](const std::optional<double>& value) { return value.value_or(std::nan("")); };
    for (std::size_t id = 0; id < result.runs.rows.size(); ++id) {
        const std::optional<FinishedRow> row = result.runs.rows[id];
        result.slip.push_back(row ? number(row->results.slip) : std::nan(""));
        result.max_slip.push_back(row ? number(row->results.max_slip) : std::nan(""));
    }
}

std::shared_ptr<FragilityResult> fragility(const OpenedScene& opened, const std::string& tables,
                                           const std::string& method, std::optional<std::size_t> samples,
                                           std::size_t share_rows, const std::string& conditioning, int jobs,
                                           const py::object& progress)
{
    if (samples && *samples == 0)
        refuse_usage("samples=0 is not allowed.", "runs per level, at least 1", "leave it out: 1024, or 128 of fe");
    const std::map<std::string, Conditioning> words{
        {"auto", Conditioning::automatic}, {"on", Conditioning::on}, {"off", Conditioning::off}};
    const auto word = words.find(conditioning);
    if (word == words.end())
        refuse_usage(fmt::format("conditioning=\"{}\" is not allowed.", conditioning), "auto, on, off",
                     "leave it out: auto");
    const Asked asked{tables, method, samples, word->second, {share_rows, jobs}};
    auto result = std::make_shared<FragilityResult>();
    result->interrupted = run_watched(progress, [&](Watch& watch) { compute(opened, asked, watch, *result); });
    return result;
}

/// One limit, alive as long as the Python object is.
struct FragilityCurve {
    std::shared_ptr<const FragilityResult> of;
    const LimitEstimate* limit;
};

/// One number of each entry of a list, where it lies.
template <class Value, class Entry>
py::array column_of(const std::vector<Entry>& entries, const Value* first, const py::object& owner)
{
    py::array view(py::dtype::of<Value>(), {static_cast<py::ssize_t>(entries.size())},
                   {static_cast<py::ssize_t>(sizeof(Entry))}, first, owner);
    view.attr("flags").attr("writeable") = false;
    return view;
}

template <auto Member>
py::array of_levels(const py::object& curve)
{
    const std::vector<LevelEstimate>& levels = curve.cast<const FragilityCurve&>().limit->levels;
    return column_of(levels, levels.empty() ? nullptr : &(levels.front().*Member), curve);
}

template <auto End>
py::array interval_of_levels(const py::object& curve)
{
    const std::vector<LevelEstimate>& levels = curve.cast<const FragilityCurve&>().limit->levels;
    return column_of(levels, levels.empty() ? nullptr : &(levels.front().sampling.*End), curve);
}

template <auto Member>
py::array of_samples(const py::object& result)
{
    const std::vector<FragilitySample>& samples = result.cast<const FragilityResult&>().samples;
    return column_of(samples, samples.empty() ? nullptr : &(samples.front().*Member), result);
}

std::optional<double> of_fit(const FragilityCurve& curve, double probability::LognormalCurve::*member)
{
    const probability::LognormalFit& fit = curve.limit->fit;
    return fit.method == probability::FitMethod::none ? std::nullopt : std::optional(fit.curve.*member);
}

/// Values of a variable, of each run.
py::list drawn(const FragilityResult& r, const std::string& name)
{
    const std::vector<RandomVariable>& variables = r.plan.variables();
    for (std::size_t v = 0; v < variables.size(); ++v) {
        if (variables[v].name != name) continue;
        py::list values;
        for (const FragilitySample& sample : r.plan.samples)
            values.append(py::cast(r.plan.draws[sample.draw].values[v]));
        return values;
    }
    throw py::key_error("no variable " + name);
}

} // namespace

void add_fragility(py::module_& module)
{
    using S = FragilitySample;
    using L = LevelEstimate;
    using I = probability::Interval;
    using Curve = probability::LognormalCurve;
    py::class_<FragilityCurve>(module, "FragilityCurve")
        .def_property_readonly("limit", [](const FragilityCurve& c) { return c.limit->limit.text; })
        .def_property_readonly("allowable", [](const FragilityCurve& c) { return c.limit->limit.value; })
        .def_property_readonly("intensity", &of_levels<&L::x>)
        .def_property_readonly("probability", &of_levels<&L::p>)
        .def_property_readonly("probability_low", &of_levels<&L::p_low>)
        .def_property_readonly("probability_high", &of_levels<&L::p_high>)
        .def_property_readonly("lower", &interval_of_levels<&I::lower>)
        .def_property_readonly("upper", &interval_of_levels<&I::upper>)
        .def_property_readonly("runs", &of_levels<&L::n>)
        .def_property_readonly("failures", &of_levels<&L::z>)
        .def_property_readonly("median", [](const FragilityCurve& c) { return of_fit(c, &Curve::median); })
        .def_property_readonly("beta", [](const FragilityCurve& c) { return of_fit(c, &Curve::beta); })
        .def_property_readonly("rate", [](const FragilityCurve& c) -> std::optional<std::pair<double, double>> {
            if (!c.limit->rate) return std::nullopt;
            const probability::Interval bounds = c.limit->rate->bounds();
            return std::pair(bounds.lower, bounds.upper);
        });

    py::class_<FragilityResult, Result, std::shared_ptr<FragilityResult>>(module, "FragilityResult")
        .def_property_readonly("curves",
                               [](const std::shared_ptr<FragilityResult>& r) {
                                   std::vector<FragilityCurve> curves;
                                   for (const LimitEstimate& limit : r->estimated.estimate.limits)
                                       curves.push_back({r, &limit});
                                   return curves;
                               })
        .def_property_readonly("complete", [](const FragilityResult& r) { return !r.interrupted && r.runs.complete(); })
        .def_property_readonly("finished", [](const FragilityResult& r) { return r.runs.finished(); })
        .def("__len__", [](const FragilityResult& r) { return r.plan.samples.size(); })
        .def_property_readonly("method", [](const FragilityResult& r) { return r.study->method.id; })
        .def_property_readonly("measure", [](const FragilityResult& r) { return r.study->input.intensity.text; })
        .def_property_readonly("share_not_standing",
                               [](const FragilityResult& r) { return r.estimated.estimate.p_static; })
        .def_property_readonly("warnings", [](const FragilityResult& r) { return r.estimated.notes; })
        .def_property_readonly("records",
                               [](const FragilityResult& r) {
                                   std::vector<std::string> names;
                                   for (const RecordPair& pair : *r.plan.suite.pairs) names.push_back(pair.files.name);
                                   return names;
                               })
        .def_property_readonly("intensity", &of_samples<&S::x>)
        .def_property_readonly("level", &of_samples<&S::level>)
        .def_property_readonly("record", &of_samples<&S::record>)
        .def_property_readonly("polarity", &of_samples<&S::polarity>)
        .def_property_readonly("factor", &of_samples<&S::factor>)
        .def_property_readonly("draw", &of_samples<&S::draw>)
        .def_property_readonly("slip",
                               [](const py::object& r) { return view_of(r.cast<const FragilityResult&>().slip, r); })
        .def_property_readonly(
            "max_slip", [](const py::object& r) { return view_of(r.cast<const FragilityResult&>().max_slip, r); })
        .def_property_readonly("variables",
                               [](const FragilityResult& r) {
                                   std::vector<std::string> names;
                                   for (const RandomVariable& v : r.plan.variables()) names.push_back(v.name);
                                   return names;
                               })
        .def("drawn", &drawn, py::arg("variable"));
    module.def("_fragility", &fragility, py::arg("scene"), py::arg("tables"), py::arg("method"), py::arg("samples"),
               py::arg("share_rows"), py::arg("conditioning"), py::arg("jobs"), py::arg("progress"));
}

} // namespace damslip::python
