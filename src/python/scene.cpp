// A scene, and its screening.
#include "opened_scene.hpp"
#include "result.hpp"

#include "analysis/screen/screening.hpp"
#include "pages/scene/scene_pages.hpp"
#include "pages/screen/screen_pages.hpp"
#include "scene/plausible.hpp"
#include "scene/write.hpp"
#include "sliding/equilibrium/limit_equilibrium.hpp"

#include <nlohmann/json.hpp>

namespace damslip::python {

namespace {

/// A screening with what it was made from.
struct ScreenResult final : Result {
    Ready ready;
    Screening screening;

    ScreenResult(Ready made, int jobs, RockingRuns rocking, bool rigid_only)
        : ready(std::move(made)), screening(run_screening(ready, jobs, rocking))
    {
        Watch silent;
        if (!rigid_only) add_elastic_dam(ready, jobs, silent, screening);
        for (std::string& note : pages::screen_notes(ready)) screening.warnings.push_back(std::move(note));
    }

    const std::optional<double>& allowable() const { return ready.scene.criteria.allowable_slip; }
    pages::ScreenReportInput input() const { return {ready.given, ready.scene, screening, ready.records()}; }

    pages::Answer answer() const override { return pages::screen_answer(input()); }
    std::string first_table() const override { return "displacements"; }
    pages::Page page() const override { return pages::screen_page(input()); }
    pages::Headline headline() const override { return pages::screen_headline(ready.scene, screening); }
};

/// One record with one polarity, alive as long as the Python object is.
struct Slip {
    std::shared_ptr<const ScreenResult> of;
    const SlipRow* row;
};

OpenedScene with(const OpenedScene& scene, const std::vector<std::pair<std::string, KeyValue>>& keys)
{
    std::vector<KeyChange> changes = scene.changes;
    for (const auto& [key, value] : keys) {
        const std::string name = scene.text->canonical(key);
        std::erase_if(changes, [&](const KeyChange& c) { return scene.text->canonical(c.key) == name; });
        changes.push_back({key, value});
    }
    return {scene.text, scene.written, std::move(changes)};
}

std::shared_ptr<ScreenResult> screen(const OpenedScene& opened, int jobs, bool rocking, bool rigid_only)
{
    PrepareOptions options;
    options.flexible_modes = true;
    return std::make_shared<ScreenResult>(prepare(opened.scene, Method::rigid_block, options), jobs,
                                          rocking ? RockingRuns::always : RockingRuns::where_sliding_does_not_hold,
                                          rigid_only);
}

std::optional<double> slip_of(const Slip& slip)
{
    return reported(slip.row->judged().status, slip.row->judged().slip);
}

} // namespace

void add_scene(py::module_& module)
{
    py::class_<OpenedScene>(module, "Scene")
        .def(py::init([](const std::string& text, const std::string& file) {
                 return OpenedScene(std::make_shared<SceneText>(text, file), std::make_shared<std::string>(text), {});
             }),
             py::arg("text"), py::arg("file"))
        .def_static("read", [](const std::string& file) { return OpenedScene(std::filesystem::path(file)); })
        .def("_with", &with)
        .def("keys", [](const OpenedScene& s) { return s.text->keys(); })
        .def("words", [](const OpenedScene& s, const std::string& key) { return s.text->words(key); })
        .def_property_readonly("title", [](const OpenedScene& s) { return s.scene.title; })
        .def_property_readonly("file", [](const OpenedScene& s) { return s.scene.file.string(); })
        .def_property_readonly("notes", [](const OpenedScene& s) { return note_texts(s.scene.notes); })
        .def_property_readonly("allowable_slip", [](const OpenedScene& s) { return s.scene.criteria.allowable_slip; })
        .def("resolved", [](const OpenedScene& s) { return resolved_toml(s.scene); })
        .def("_screen", &screen, py::arg("jobs"), py::arg("rocking"), py::arg("rigid_only"), py::call_guard<py::gil_scoped_release>());

    py::class_<Slip>(module, "Slip")
        .def_property_readonly("record", [](const Slip& s) { return s.row->record; })
        .def_property_readonly("polarity", [](const Slip& s) { return s.row->polarity; })
        .def_property_readonly("pga", [](const Slip& s) { return s.row->pga; })
        .def_property_readonly("vertical_pga", [](const Slip& s) { return s.row->vertical_pga; })
        .def_property_readonly("slip", &slip_of)
        .def_property_readonly("max_slip",
                               [](const Slip& s) { return reported(s.row->judged().status, s.row->judged().max_slip); })
        .def_property_readonly("method", [](const Slip& s) { return std::string(s.row->governing().method); })
        .def_property_readonly("status", [](const Slip& s) { return word(s.row->judged().status); })
        .def_property_readonly("verdict", [](const Slip& s) { return verdict_word(*s.row, s.of->allowable()); });

    py::class_<ScreenResult, Result, std::shared_ptr<ScreenResult>>(module, "ScreenResult")
        .def_property_readonly(
            "yield_acceleration",
            [](const ScreenResult& r) { return r.screening.bases.front().model.downstream.law.constant; })
        .def_property_readonly("critical_friction",
                               [](const ScreenResult& r) { return r.screening.bases.front().model.critical_friction; })
        .def_property_readonly("slips",
                               [](const std::shared_ptr<ScreenResult>& r) {
                                   std::vector<Slip> slips;
                                   for (const SlipRow& row : r->screening.slips) slips.push_back({r, &row});
                                   return slips;
                               })
        .def_property_readonly("warnings", [](const ScreenResult& r) { return r.screening.warnings; });
}

} // namespace damslip::python
