#include "pages/report/page_html.hpp"

#include "pages/report/escape.hpp"
#include "pages/report/table_text.hpp"

namespace damslip::pages {

namespace {

constexpr std::size_t long_text = 40; ///< a sentence, which may be broken into lines [bytes]

/// Words of verdict and state columns that have to be seen at once; sentences.
std::string cell_class(const Cell& cell)
{
    if (is_number(cell)) return " class=\"number\"";
    const auto* word = std::get_if<std::string>(&cell);
    if (!word) return "";
    if (*word == "PASS" || word->starts_with("PASS ")) return " class=\"pass\"";
    if (*word == "FAIL" || word->starts_with("FAIL ") || *word == "UNRESOLVED" || *word == "SLIDES STATICALLY" ||
        *word == "SLIDES UPSTREAM" || *word == "FLOATS")
        return " class=\"fail\"";
    return word->size() > long_text ? " class=\"sentence\"" : "";
}

std::string cell_html(const Cell& cell, int digits)
{
    return "<td" + cell_class(cell) + ">" + html_text(cell_text(cell, digits)) + "</td>";
}

std::string heading_html(const Column& column)
{
    std::string out = html_text(column.heading);
    if (!column.unit.empty() && column.unit != "–")
        out += " <span class=\"unit\">" + html_text(column.unit) + "</span>";
    return out;
}

std::string by_rows(const Table& given)
{
    const Table table = verdict_after(given, 1); // where a narrow screen shows it without scrolling
    std::string out = "<thead><tr>";
    for (std::size_t j = 0; j < table.columns.size(); ++j) {
        const bool number = !table.rows.empty() && is_number(table.rows.front()[j]);
        out += std::string("<th scope=\"col\"") + (number ? " class=\"number\"" : "") + ">" +
               heading_html(table.columns[j]) + "</th>";
    }
    out += "</tr></thead>\n<tbody>\n";
    for (const auto& row : table.rows) {
        out += "<tr>";
        for (std::size_t j = 0; j < row.size(); ++j) out += cell_html(row[j], table.columns[j].digits);
        out += "</tr>\n";
    }
    return out + "</tbody>";
}

std::string by_columns(const Table& table, std::size_t labels)
{
    std::string out = "<thead>\n";
    for (std::size_t j = 0; j < table.columns.size(); ++j) {
        const bool head = j < labels;
        if (j == labels) out += "</thead>\n<tbody>\n";
        out += "<tr><th scope=\"row\">" + heading_html(table.columns[j]) + "</th>";
        for (const auto& row : table.rows)
            out += head ? "<th scope=\"col\" class=\"number\">" +
                              html_text(cell_text(row[j], table.columns[j].digits)) + "</th>"
                        : "<td class=\"number\">" + html_text(cell_text(row[j], table.columns[j].digits)) + "</td>";
        out += "</tr>\n";
    }
    return out + (table.columns.size() > labels ? "</tbody>" : "</thead>");
}

} // namespace

std::string table_html(const TablePart& part, const std::string& section)
{
    const Table& table = part.table;
    const std::string title = html_text(table.title);
    // The frame scrolls where the table is wider than the page, so it takes the keyboard's focus.
    std::string body = "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"" + title + "\"><table>\n" +
                       (part.layout == Layout::rows ? by_rows(table) : by_columns(table, part.labels)) +
                       "\n</table></div>\n";
    for (const std::string& note : table.notes) body += "<p class=\"note\">" + html_text(note) + "</p>\n";
    for (const std::string& definition : part.definitions)
        body += "<p class=\"note\">" + html_text(definition) + "</p>\n";
    if (part.fold == Fold::folded)
        return "<details class=\"part\"><summary>" + title + "</summary>\n" + body + "</details>\n";
    return "<div class=\"part\">" + (title.empty() || table.title == section ? "" : "<h3>" + title + "</h3>\n") + body +
           "</div>\n";
}

} // namespace damslip::pages
