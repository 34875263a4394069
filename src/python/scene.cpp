// Scenes, screening and natural modes of dam and rock.
#include "module.hpp"

#include "analysis/modes/modes.hpp"
#include "analysis/screen/screening.hpp"
#include "core/input_error.hpp"
#include "pages/modes/modes_pages.hpp"
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

namespace {

struct ModesAnswer final : Result {
    Scene given;
    std::optional<ModesResult> found;

    pages::Answer answer() const override { return pages::modes_answer(given, *found); }
    std::string first_table() const override { return "modes"; }
    pages::Headline headline() const override
    {
        return {given.title + ": " + std::to_string(found->modes.frequency.size()) + " modes", pages::Outcome::none,
                ""};
    }
    pages::Page page() const override
    {
        pages::Page page;
        page.title = given.title;
        page.headline = headline();
        pages::Section section{"Modes", {}, pages::Fold::open};
        for (auto& [name, table] : answer().tables()) section.parts.push_back(pages::rows_part(std::move(table)));
        page.sections.push_back(std::move(section));
        return page;
    }
};

std::shared_ptr<ModesAnswer> modes(const OpenedScene& opened, std::optional<int> count, bool transfer,
                                   const py::object& progress)
{
    if (opened.scene.wedge)
        refuse_usage("a wedge has no modes: it is rigid.", "a scene with a [section]", "scene.screen() gives its slip");
    if (count && *count < 1) refuse_usage("modes(count < 1).", "1 or more modes", "leave count out for 10");
    auto answer = std::make_shared<ModesAnswer>();
    answer->given = opened.scene;
    answer->interrupted = run_watched(progress, [&](Watch& watch) {
        const Ready ready = prepare(opened.scene, Method::finite_elements, {.stop = watch.stop()});
        answer->found.emplace(compute_modes(ready, {count, transfer}));
    });
    return answer;
}

} // namespace

void add_modes(py::module_& module)
{
    py::class_<ModesAnswer, Result, std::shared_ptr<ModesAnswer>>(module, "ModesResult")
        .def_property_readonly("frequencies",
                               [](const py::object& self) {
                                   const auto& f = self.cast<const ModesAnswer&>().found->modes.frequency;
                                   return view_of(f.data(), {static_cast<py::ssize_t>(f.size())}, self);
                               })
        .def_property_readonly("complete", [](const ModesAnswer& r) { return r.found->complete(); });
    module.def("_modes", &modes, py::arg("scene"), py::arg("count"), py::arg("transfer"), py::arg("progress"));
}

} // namespace damslip::python
