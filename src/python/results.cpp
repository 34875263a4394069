// Tables and what all results have in common.
#include "result.hpp"

#include "pages/report/page.hpp"
#include "pages/report/table_text.hpp"

#include <nlohmann/json.hpp>

namespace damslip::python {

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

} // namespace damslip::python
