// Natural modes of dam and rock.
#include "opened_scene.hpp"
#include "result.hpp"
#include "watched.hpp"

#include "analysis/modes/modes.hpp"
#include "core/input_error.hpp"
#include "pages/modes/modes_pages.hpp"

#include <nlohmann/json.hpp>

namespace damslip::python {

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
