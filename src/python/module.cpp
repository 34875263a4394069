// The Python module damslip._core: the library of src/analysis with the tables, objects and reports of src/pages. The package python/damslip is
// around it. Here: errors of the library as exceptions of Python, tables and what all results have in common, and computations that Ctrl-C ends.
#include "module.hpp"

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/version.hpp"
#include "pages/report/page.hpp"
#include "pages/report/table_text.hpp"
#include "scene/read.hpp"

#include <nlohmann/json.hpp>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

namespace damslip::python {

namespace {

py::list as_dictionaries(const std::vector<Diagnostic>& diagnostics)
{
    py::list list;
    for (const Diagnostic& given : diagnostics) {
        const Diagnostic d = with_line(given);
        py::dict entry;
        entry["file"] = d.file;
        entry["line"] = d.line;
        entry["column"] = d.column;
        entry["problem"] = d.problem;
        entry["expected"] = d.expected;
        entry["fix"] = d.fix;
        list.append(entry);
    }
    return list;
}

void raise(const char* name, const char* text, const std::vector<Diagnostic>& diagnostics)
{
    const py::object type = py::module_::import("damslip.errors").attr(name);
    PyErr_SetObject(type.ptr(), type(text, as_dictionaries(diagnostics)).ptr());
}

} // namespace

void add_errors(py::module_&)
{
    py::register_exception_translator([](std::exception_ptr error) {
        try {
            if (error) std::rethrow_exception(error);
        } catch (const UsageError& e) {
            raise("UsageError", e.what(), e.diagnostics());
        } catch (const InputError& e) {
            raise("InputError", e.what(), e.diagnostics());
        } catch (const NotConverged& e) {
            raise("NotConverged", e.what(), {e.diagnostic()});
        } catch (const Interrupted&) {
            PyErr_SetNone(PyExc_KeyboardInterrupt);
        }
    });
}

namespace {

std::vector<std::string> keys_of(const Table& table)
{
    std::vector<std::string> keys;
    for (const Column& column : table.columns) keys.push_back(column.key);
    return keys;
}

/// By column key the values of the rows; None for nothing.
py::dict columns_of(const Table& table)
{
    py::dict columns;
    for (std::size_t j = 0; j < table.columns.size(); ++j) {
        py::list values;
        for (const std::vector<Cell>& row : table.rows) values.append(py::cast(row[j]));
        columns[py::str(table.columns[j].key)] = values;
    }
    return columns;
}

/// The report's charts alone: a notebook shows them below answer and table.
pages::Page charts_of(pages::Page page)
{
    std::vector<pages::Section> sections;
    for (pages::Section& section : page.sections) {
        std::erase_if(section.parts, [](const pages::Part& part) {
            return !std::holds_alternative<pages::Chart>(part);
        });
        section.fold = pages::Fold::open;
        if (!section.parts.empty()) sections.push_back(std::move(section));
    }
    page.sections = std::move(sections);
    page.headline = {};
    page.key_figures.clear();
    page.provenance.clear();
    page.warnings.clear();
    return page;
}

std::string outcome_word(const pages::Headline& headline)
{
    constexpr std::array words{"none", "pass", "fail", "unresolved"}; // in the order of the enumeration
    return words[static_cast<std::size_t>(headline.outcome)];
}

} // namespace

void add_results(py::module_& module)
{
    py::class_<Table>(module, "Table")
        .def_readonly("title", &Table::title)
        .def_readonly("notes", &Table::notes)
        .def_property_readonly("keys", &keys_of)
        .def_property_readonly("headings",
                               [](const Table& table) {
                                   std::vector<std::string> headings;
                                   for (const Column& c : table.columns) headings.push_back(c.heading);
                                   return headings;
                               })
        .def_property_readonly("units",
                               [](const Table& table) {
                                   std::vector<std::string> units;
                                   for (const Column& c : table.columns) units.push_back(c.unit);
                                   return units;
                               })
        .def("to_dict", &columns_of)
        .def("csv", [](const Table& table) { return pages::csv(table); })
        .def("__len__", [](const Table& table) { return table.rows.size(); })
        .def("__str__", [](const Table& table) { return pages::text(table); });

    py::class_<Result, std::shared_ptr<Result>>(module, "Result")
        .def_property_readonly("tables",
                               [](const Result& result) {
                                   const auto all = result.tables();
                                   const std::string first = result.first_table();
                                   py::dict tables;
                                   for (const bool is_first : {true, false})
                                       for (const auto& [name, table] : all)
                                           if ((name == first) == is_first) tables[py::str(name)] = py::cast(table);
                                   return tables;
                               })
        .def("json_text", [](const Result& result) { return result.answer().json().dump(2) + "\n"; })
        .def("report", [](const Result& result) { return pages::page_html(result.page()); })
        .def("_charts", [](const Result& result) { return pages::page_html(charts_of(result.page())); })
        .def_property_readonly("sentence", [](const Result& result) { return result.headline().sentence; })
        .def_property_readonly("outcome", [](const Result& result) { return outcome_word(result.headline()); })
        .def_readonly("interrupted", &Result::interrupted);
}

namespace {

/// What the computation says from its threads, and whether it shall end.
class CalledWatch final : public Watch {
public:
    struct Reached {
        std::string label;
        double done = 0.0, total = 0.0;
    };

    bool stop_asked() const override { return stop_; }
    void begin(const std::string& label, double total) override
    {
        const std::lock_guard lock(mutex_);
        reached_ = {label, 0.0, total};
    }
    void at(double done) override
    {
        const std::lock_guard lock(mutex_);
        reached_.done = done;
    }

    void stop() { stop_ = true; }
    Reached reached() const
    {
        const std::lock_guard lock(mutex_);
        return reached_;
    }
    void work_is_over()
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
        ended_.notify_all();
    }
    bool over_within(std::chrono::milliseconds time)
    {
        std::unique_lock lock(mutex_);
        return ended_.wait_for(lock, time, [this] { return over_; });
    }

private:
    std::atomic<bool> stop_ = false;
    mutable std::mutex mutex_;
    std::condition_variable ended_;
    Reached reached_;
    bool over_ = false;
};

/// Ctrl-C, or an error of the progress function, as it stands in Python.
std::optional<py::error_already_set> look_at_python(const py::object& progress, const CalledWatch& watch)
{
    if (PyErr_CheckSignals() != 0) return py::error_already_set();
    if (progress.is_none()) return std::nullopt;
    try {
        const CalledWatch::Reached reached = watch.reached();
        progress(reached.label, reached.done, reached.total);
    } catch (py::error_already_set& error) {
        return error;
    }
    return std::nullopt;
}

} // namespace

bool run_watched(const py::object& progress, const std::function<void(Watch&)>& work)
{
    CalledWatch watch;
    std::exception_ptr failure;
    std::optional<py::error_already_set> raised;
    {
        const py::gil_scoped_release free;
        std::thread worker([&] {
            try {
                work(watch);
            } catch (...) {
                failure = std::current_exception();
            }
            watch.work_is_over();
        });
        while (!watch.over_within(std::chrono::milliseconds(50))) {
            const py::gil_scoped_acquire held;
            if (raised) continue;
            raised = look_at_python(progress, watch);
            if (raised) watch.stop();
        }
        worker.join();
    }
    if (raised && !raised->matches(PyExc_KeyboardInterrupt)) throw *raised;
    if (raised && failure) throw *raised;
    if (failure) std::rethrow_exception(failure);
    return raised.has_value();
}

} // namespace damslip::python

PYBIND11_MODULE(_core, module)
{
    using namespace damslip::python;
    module.doc() = "How far a concrete gravity dam slides in an earthquake.";
    module.attr("__version__") = damslip::program_version();
    damslip::use_cache_folder(damslip::user_cache_folder()); // as the program does
    add_errors(module);
    add_results(module);
    add_scene(module);
    add_fe(module);
    add_modes(module);
    add_sweep(module);
    add_accuracy(module);
    add_fragility(module);
}
