// Finite elements: the runs of a scene with their histories, as arrays that lie in the result.
#include "module.hpp"

#include "analysis/fe/contact_runs.hpp"
#include "analysis/fe/tied_runs.hpp"
#include "analysis/fe/variants.hpp"
#include "core/input_error.hpp"
#include "pages/fe/fe_pages.hpp"

#include <nlohmann/json.hpp>

namespace damslip::python {

namespace {

/// The runs of a scene, and what the report keeps of them.
struct FeResult final : Result {
    Ready ready;
    std::unique_ptr<ContactRuns> models;
    std::optional<pages::FeReport> report;
    std::vector<ContactRun> runs;
    std::vector<std::string> messages;
    std::string spread;

    pages::FeReport::Input input() const
    {
        return {ready.scene, ready.plan, ready.records(), models->model(), models->rigid(), models->uplift(),
                models->combinations(), models->reduced(), models->traced()};
    }
    const std::optional<double>& allowable() const { return ready.scene.criteria.allowable_slip; }

    pages::Answer answer() const override { return contact_answer(input(), runs, messages, spread); }
    std::string first_table() const override { return "runs"; }
    pages::Page page() const override { return report->page(runs, messages, spread); }
    pages::Headline headline() const override { return pages::fe_headline(ready.scene, runs, models->combinations()); }
};

void compute(const OpenedScene& opened, const FeOptions& options, bool spread, Watch& watch, FeResult& result)
{
    if (opened.scene.wedge)
        refuse_usage("finite elements cannot take a [wedge].", "a scene with a [section]",
                     "scene.screen() gives the slip of the wedge");
    result.ready = prepare(opened.scene, Method::finite_elements, {.joints_of_lifts = !options.reduced, .stop = watch.stop()});
    result.models = std::make_unique<ContactRuns>(result.ready, options, watch);
    result.ready = result.models->ready(); // with the lifts that have woken
    const fe2d::EarthquakeRun& model = result.models->model();
    result.report.emplace(result.input());
    pages::ModelNotes of_model(result.ready.scene, model);
    result.runs = result.models->run([&](ContactRun& r, const GroundMotion& motion) {
        of_model.add(r.record, motion);
        result.report->add(r, motion);
    });
    result.spread = spread_line(model_spread(result.ready, result.runs, spread, watch), result.runs);
    result.messages = pages::contact_messages(result.ready.scene, result.runs, of_model.lines());
}

std::shared_ptr<FeResult> fe(const OpenedScene& opened, std::optional<int> polarity, bool mesh_error, bool spread,
                             bool reduced, std::optional<int> modes, const py::object& progress)
{
    if (modes && (!reduced || *modes < 1 || *modes > 1000))
        refuse_usage("fe(modes): of a reduced run alone.", "1 to 1000 elastic modes, and reduced=True", "leave modes out for 12");
    FeOptions options;
    options.reduced = reduced;
    options.modes = modes;
    options.polarity = polarity;
    options.mesh_error = mesh_error;
    options.pair_histories = true;
    auto result = std::make_shared<FeResult>();
    result->interrupted =
        run_watched(progress, [&](Watch& watch) { compute(opened, options, spread, watch, *result); });
    return result;
}

/// One run, alive as long as the Python object is.
struct FeRun {
    std::shared_ptr<const FeResult> of;
    const ContactRun* run;

    const fe2d::RunHistory& history() const { return run->fe.history; }
};

py::array of_pairs(const FeRun& run, const std::vector<double>& values, const py::object& owner)
{
    const auto pairs = static_cast<py::ssize_t>(run.history().by_pair.pairs);
    return view_of(values.data(), {pairs > 0 ? static_cast<py::ssize_t>(values.size()) / pairs : 0, pairs}, owner);
}

py::array of_vector(const Eigen::VectorXd& values, const py::object& owner)
{
    return view_of(values.data(), {static_cast<py::ssize_t>(values.size())}, owner);
}

template <auto Member>
py::array history_array(const py::object& run)
{
    return view_of(run.cast<const FeRun&>().history().*Member, run);
}

template <auto Member>
py::array pair_history(const py::object& run)
{
    const auto& of = run.cast<const FeRun&>();
    return of_pairs(of, of.history().by_pair.*Member, run);
}

template <auto Member>
py::array pairs_at_end(const py::object& run)
{
    return of_vector(run.cast<const FeRun&>().run->fe.*Member, run);
}

std::optional<double> known(double value)
{
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

void add_histories(py::class_<FeRun>& type)
{
    using H = fe2d::RunHistory;
    using P = fe2d::PairHistory;
    using R = fe2d::RunResult;
    type.def_property_readonly("time", &history_array<&H::time>)
        .def_property_readonly("ground_acceleration", &history_array<&H::ground_h>)
        .def_property_readonly("ground_acceleration_up", &history_array<&H::ground_v>)
        .def_property_readonly("slip_history", &history_array<&H::slip>)
        .def_property_readonly("slip_heel", &history_array<&H::slip_heel>)
        .def_property_readonly("slip_middle", &history_array<&H::slip_middle>)
        .def_property_readonly("slip_toe", &history_array<&H::slip_toe>)
        .def_property_readonly("rocking", &history_array<&H::rocking>)
        .def_property_readonly("crest_x", &history_array<&H::crest_x>)
        .def_property_readonly("normal_force", &history_array<&H::normal_force>)
        .def_property_readonly("shear_force", &history_array<&H::shear_force>)
        .def_property_readonly("open_length", &history_array<&H::open_length>)
        .def_property_readonly("slipping_length", &history_array<&H::slipping_length>)
        .def_property_readonly("largest_opening", &history_array<&H::largest_opening>)
        .def_property_readonly("pair_pressure", &pair_history<&P::pressure>)
        .def_property_readonly("pair_shear", &pair_history<&P::shear>)
        .def_property_readonly("pair_slip", &pair_history<&P::slip>)
        .def_property_readonly("pair_opening", &pair_history<&P::opening>)
        .def_property_readonly("distance", &pairs_at_end<&R::pair_distance>)
        .def_property_readonly("pressure_at_end", &pairs_at_end<&R::pair_pressure>)
        .def_property_readonly("shear_at_end", &pairs_at_end<&R::pair_shear>)
        .def_property_readonly("slip_at_end", &pairs_at_end<&R::pair_slip>)
        .def_property_readonly("opening_at_end", &pairs_at_end<&R::pair_opening>);
}

} // namespace

void add_fe(py::module_& module)
{
    py::class_<FeRun> run(module, "FeRun");
    run.def_property_readonly("record", [](const FeRun& r) { return r.run->record; })
        .def_property_readonly("polarity", [](const FeRun& r) { return r.run->polarity; })
        .def_property_readonly("status", [](const FeRun& r) { return word(r.run->fe.status); })
        .def_property_readonly("message", [](const FeRun& r) { return text_of(r.run->fe.notes); })
        .def_property_readonly("verdict", [](const FeRun& r) { return word(verdict_of(*r.run, r.of->allowable())); })
        .def_property_readonly("slip", [](const FeRun& r) { return reported(r.run->fe.status, r.run->fe.slip); })
        .def_property_readonly("max_slip",
                               [](const FeRun& r) { return reported(r.run->fe.status, r.run->fe.max_slip); })
        .def_property_readonly("slip_error", [](const FeRun& r) { return known(slip_error(*r.run).total); })
        .def_property_readonly("step_error", [](const FeRun& r) { return known(slip_error(*r.run).step); })
        .def_property_readonly("mesh_error", [](const FeRun& r) { return known(slip_error(*r.run).mesh); })
        .def_property_readonly("rigid_slip",
                               [](const FeRun& r) {
                                   return r.run->rigid ? reported(r.run->rigid->status, r.run->rigid->slip)
                                                       : std::nullopt;
                               })
        .def_property_readonly("time_step", [](const FeRun& r) { return r.run->fe.dt; })
        .def_property_readonly("end_time", [](const FeRun& r) { return r.run->fe.end_time; })
        .def_property_readonly("energy_error", [](const FeRun& r) { return r.run->fe.energy_error; });
    add_histories(run);

    py::class_<FeResult, Result, std::shared_ptr<FeResult>>(module, "FeResult")
        .def_property_readonly("runs",
                               [](const std::shared_ptr<FeResult>& r) {
                                   std::vector<FeRun> runs;
                                   for (const ContactRun& run : r->runs) runs.push_back({r, &run});
                                   return runs;
                               })
        .def_property_readonly("worst",
                               [](const std::shared_ptr<FeResult>& r) -> std::optional<FeRun> {
                                   if (r->runs.empty()) return std::nullopt;
                                   return FeRun{r, &worst_of(r->runs)};
                               })
        .def_property_readonly("verdict", [](const FeResult& r) {
            return word(pages::joined_verdict(r.headline(), r.runs, r.allowable()));
        })
        .def_property_readonly(
            "complete",
            [](const FeResult& r) { return !r.interrupted && r.models && r.runs.size() == r.models->whole(); })
        .def_property_readonly("model_spread", [](const FeResult& r) { return r.spread; })
        .def_property_readonly("warnings", [](const FeResult& r) { return r.messages; });

    module.def("_fe", &fe, py::arg("scene"), py::arg("polarity"), py::arg("mesh_error"), py::arg("spread"),
               py::arg("reduced"), py::arg("modes"), py::arg("progress"));
}

} // namespace damslip::python
