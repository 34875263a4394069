#include "core/text.hpp"
#include "pages/report/table_text.hpp"

#include <bit>
#include <cmath>

namespace damslip::pages {

namespace {

void add_csv_field(std::string& out, const Cell& cell)
{
    struct Show {
        std::string& out;
        void operator()(std::monostate) const {}
        void operator()(double v) const
        {
            if (std::isfinite(v)) append_shortest(out, v);
        }
        void operator()(std::int64_t v) const { out += std::to_string(v); }
        void operator()(const std::string& v) const { out += csv_cell(v); }
        void operator()(bool v) const { out += v ? "true" : "false"; }
    };
    std::visit(Show{out}, cell);
}

/// Of the same text: zeros of both signs are told apart.
bool same_cell(const Cell& a, const Cell& b)
{
    if (a.index() != b.index()) return false;
    if (const double* x = std::get_if<double>(&a))
        return std::bit_cast<std::uint64_t>(*x) == std::bit_cast<std::uint64_t>(std::get<double>(b));
    return a == b;
}

} // namespace

std::string csv_head(const std::vector<Column>& columns, const std::vector<std::string>& comments)
{
    std::string out;
    for (const std::string& comment : comments) out += "# " + visible(comment, LineEnds::replaced) + "\n";
    for (std::size_t j = 0; j < columns.size(); ++j) {
        if (j) out += ',';
        add_csv_field(out, columns[j].key); // the name of a variable may be a key
    }
    return out + "\n";
}

void CsvLines::add(const std::vector<Cell>& row, std::string& out)
{
    last_.resize(row.size());
    for (std::size_t j = 0; j < row.size(); ++j) {
        if (j) out += ',';
        if (std::holds_alternative<std::monostate>(row[j])) continue;
        Field& field = last_[j];
        if (!same_cell(row[j], field.cell)) {
            field.cell = row[j];
            if (j > 0 && same_cell(row[j], row[j - 1])) {
                field.text = last_[j - 1].text;
            } else {
                field.text.clear();
                add_csv_field(field.text, row[j]);
            }
        }
        out += field.text;
    }
    out += '\n';
}

} // namespace damslip::pages
