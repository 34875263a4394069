#include "core/csv.hpp"
#include "core/input_error.hpp"
#include "pages/report/page.hpp"
#include "pages/report/table_text.hpp"
#include "result.hpp"

#include <nlohmann/json_fwd.hpp>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <string>
#include <utility>
#include <vector>

namespace damslip::python {

namespace py = pybind11;

/// What every result has: the tables of its command by their names in the JSON object, this object, and the report.
class Result {
public:
    virtual ~Result() = default;
    virtual std::vector<std::pair<std::string, Table>> tables() const = 0; ///< the one people look at first
    virtual std::string json() const = 0; ///< text of the object that the command prints with --json
    virtual pages::Page page() const = 0; ///< of the report
    virtual pages::Headline headline() const = 0;
    bool interrupted = false; ///< Ctrl-C: what is there is what was finished
};

/// Values that lie in a result, without a copy: the array keeps the result alive and cannot be written to.
/// @param owner  the Python object of the result
template <class Value>
py::array view_of(const Value* values, std::vector<py::ssize_t> shape, const py::object& owner)
{
    py::array view = py::array_t<Value>(std::move(shape), values, owner);
    view.attr("flags").attr("writeable") = false;
    return view;
}

inline py::array view_of(const std::vector<double>& values, const py::object& owner)
{
    return view_of(values.data(), {static_cast<py::ssize_t>(values.size())}, owner);
}

// The parts of the module, each with its classes.
void add_errors(py::module_& module);
void add_results(py::module_& module); ///< Table, Result
void add_scene(py::module_& module);   ///< Scene, ScreenResult
void add_fe(py::module_& module);
void add_modes(py::module_& module);
void add_sweep(py::module_& module);
void add_accuracy(py::module_& module);
void add_fragility(py::module_& module);

// Tables and what all results have in common.

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
        std::erase_if(section.parts,
                      [](const pages::Part& part) { return !std::holds_alternative<pages::Chart>(part); });
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
    switch (headline.outcome) {
    case pages::Outcome::pass:
        return "pass";
    case pages::Outcome::fail:
        return "fail";
    case pages::Outcome::unresolved:
        return "unresolved";
    case pages::Outcome::none:
        break;
    }
    return "none";
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
                                   py::dict tables;
                                   for (auto& [name, table] : result.tables())
                                       tables[py::str(name)] = py::cast(std::move(table));
                                   return tables;
                               })
        .def("json_text", [](const Result& result) { return result.json() + "\n"; })
        .def("report", [](const Result& result) { return pages::page_html(result.page()); })
        .def("_charts", [](const Result& result) { return pages::page_html(charts_of(result.page())); })
        .def_property_readonly("sentence", [](const Result& result) { return result.headline().sentence; })
        .def_property_readonly("outcome", [](const Result& result) { return outcome_word(result.headline()); })
        .def_readonly("interrupted", &Result::interrupted);
}

// Errors of the library as exceptions of Python; their classes are in python/damslip/errors.py.

namespace {

py::list as_dictionaries(const std::vector<Diagnostic>& diagnostics)
{
    py::list list;
    for (const Diagnostic& d : diagnostics) {
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

} // namespace damslip::python
