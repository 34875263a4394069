// What accuracy costs on one scene.
#include "opened_scene.hpp"
#include "result.hpp"
#include "watched.hpp"

#include "analysis/accuracy/accuracy.hpp"
#include "core/input_error.hpp"
#include "pages/accuracy/accuracy_pages.hpp"

#include <nlohmann/json.hpp>

#include <cmath>

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

} // namespace damslip::python
