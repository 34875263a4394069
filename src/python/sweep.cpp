// Sweeps, and what accuracy costs on one scene.
#include "module.hpp"

#include "analysis/accuracy/accuracy.hpp"
#include "analysis/sweep/sweep_run.hpp"
#include "cli/input/make_axes.hpp"
#include "core/input_error.hpp"
#include "pages/accuracy/accuracy_pages.hpp"
#include "pages/sweep/sweep_pages.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numeric>

namespace damslip::python {

namespace {

struct AccuracyResult final : Result {
    Scene scene;
    Records records;
    double tolerance = 0.0;
    Accuracy found;

    pages::AccuracyReportInput input() const
    {
        return {scene, *records, found.model_levels, found.judgement, tolerance, "", {}};
    }
    pages::Answer answer() const override { return pages::accuracy_answer(input()); }
    std::string first_table() const override { return "rungs"; }
    pages::Page page() const override { return pages::accuracy_page(input()); }
    pages::Headline headline() const override
    {
        return {pages::choice_sentence(found.model_levels, found.judgement, tolerance), pages::Outcome::none, ""};
    }
};

std::shared_ptr<AccuracyResult> accuracy(const OpenedScene& opened, double tolerance, bool quick,
                                         const py::object& progress)
{
    if (!(tolerance > 0.0 && std::isfinite(tolerance)))
        refuse_usage("this tolerance is not allowed.", "a share of the slip > 0", "for 2 % write  tolerance=0.02");
    if (opened.scene.wedge)
        refuse_usage("accuracy cannot take a [wedge]: its slip is exact for its record.", "a scene with a [section]",
                     "scene.screen() gives it");
    auto result = std::make_shared<AccuracyResult>();
    result->scene = opened.scene;
    result->tolerance = tolerance;
    result->interrupted = run_watched(progress, [&](Watch& watch) {
        result->records = load_records(result->scene, Method::finite_elements);
        result->found = measure_accuracy(result->scene, tolerance, quick ? Effort::quick : Effort::full, watch);
    });
    return result;
}

} // namespace

void add_accuracy(py::module_& module)
{
    py::class_<AccuracyResult, Result, std::shared_ptr<AccuracyResult>>(module, "AccuracyResult")
        .def_property_readonly("choice", [](const AccuracyResult& r) -> std::optional<std::string> {
            if (!r.found.judgement.choice) return std::nullopt;
            return model_level_id(r.found.model_levels[*r.found.judgement.choice].model_level);
        });
    module.def("_accuracy", &accuracy, py::arg("scene"), py::arg("tolerance"), py::arg("quick"), py::arg("progress"));
}

namespace {

struct SweepResult final : Result {
    std::optional<Sweep> sweep;
    std::optional<Grid> grid;
    SweepOutcome outcome;
    Table rows, compared;
    pages::SweepView seen; ///< of the rows

    std::vector<std::size_t> wanted() const
    {
        std::vector<std::size_t> ids(sweep->tasks.rows());
        std::iota(ids.begin(), ids.end(), std::size_t{0});
        return ids;
    }
    pages::SweepReportInput input() const
    {
        std::vector<SlipHistory> histories;
        for (const std::size_t id : wanted()) {
            const FinishedRow* row = outcome.find(id);
            histories.push_back(row ? row->history : SlipHistory{});
        }
        return {&sweep->scene, rows, seen, compared, outcome.fe, *sweep->records, {}, std::move(histories)};
    }
    pages::Answer answer() const override { return pages::sweep_answer(input()); }
    std::string first_table() const override { return "rows"; }
    pages::Page page() const override { return pages::sweep_page(input()); }
    pages::Headline headline() const override
    {
        return {fmt::format("{} of {} rows", outcome.rows.size(), outcome.wanted), pages::Outcome::none, ""};
    }
};

/// Values of the axes as texts: "0.7,0.8"; checked as those of the command line are.
Axes axes_from(const std::map<std::string, std::string>& texts, const Scene& scene)
{
    cli::SweepArguments a;
    const std::map<std::string, std::string*> places{{"friction", &a.friction},
                                                     {"friction_deg", &a.friction_deg},
                                                     {"level", &a.level},
                                                     {"uplift", &a.uplift},
                                                     {"opening_water", &a.opening_water},
                                                     {"reservoir", &a.reservoir},
                                                     {"size", &a.size},
                                                     {"scale", &a.scale},
                                                     {"polarity", &a.polarity},
                                                     {"method", &a.method}};
    for (const auto& [axis, text] : texts) {
        const auto place = places.find(axis);
        if (place != places.end()) {
            *place->second = text;
            continue;
        }
        std::vector<std::string> known;
        for (const auto& [name, unused] : places) known.push_back(name);
        const std::string_view near = nearest(axis, known);
        refuse_usage(fmt::format("sweep has no axis {}.", axis), fmt::format("one of {}", fmt::join(known, ", ")),
                     near.empty() ? "vary other keys with scene.with_()" : fmt::format("write  {}", near));
    }
    return cli::make_axes(a, scene);
}

std::shared_ptr<SweepResult> sweep(const OpenedScene& opened, const std::map<std::string, std::string>& axes, int jobs,
                                   const py::object& progress)
{
    Scene scene = opened.scene;
    const Axes values = axes_from(axes, scene);
    scene.notes.insert(scene.notes.end(), values.notes.begin(), values.notes.end());
    if (scene.motion.records.empty())
        refuse_usage("there is no record to sweep over.", "a [[motion.record]] in the scene", "add one to the scene");
    const TaskList tasks = make_tasks(values, motion_count(scene));
    constexpr std::size_t most_rows = 1'000'000; // all are held in memory
    if (tasks.rows() > most_rows)
        refuse_usage(fmt::format("the grid has {} rows.", tasks.rows()), "at most 1 million",
                     "split it, or run  damslip sweep  on the command line, which takes 20 million");
    auto result = std::make_shared<SweepResult>();
    result->interrupted = run_watched(progress, [&](Watch& watch) {
        result->sweep.emplace(Sweep{scene, values, tasks, load_records(scene, Method::rigid_block)});
        const Sweep& all = *result->sweep;
        check_fe_scenes(all);
        result->grid.emplace(make_grid(all.scene, all.axes, all.tasks, all.records, jobs));
        result->outcome = run_sweep(all, *result->grid, result->wanted(), nullptr, jobs, watch);
        result->rows = pages::sweep_table(*result->grid, result->wanted(), result->outcome);
        result->seen = pages::sweep_view(*result->grid, result->wanted(), result->outcome);
        if (result->outcome.fe)
            result->compared =
                pages::comparison_table(*result->grid, compare_with_rigid(all.scene, *result->grid, result->outcome));
    });
    return result;
}

} // namespace

void add_sweep(py::module_& module)
{
    py::class_<SweepResult, Result, std::shared_ptr<SweepResult>>(module, "SweepResult")
        .def_property_readonly("complete", [](const SweepResult& r) { return r.outcome.complete(); })
        .def_property_readonly("finished", [](const SweepResult& r) { return r.outcome.rows.size(); })
        .def("__len__", [](const SweepResult& r) { return r.outcome.wanted; });
    module.def("_sweep", &sweep, py::arg("scene"), py::arg("axes"), py::arg("jobs"), py::arg("progress"));
}

} // namespace damslip::python
