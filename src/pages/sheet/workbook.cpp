#include "pages/sheet/workbook.hpp"

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <ctime>
#include <fmt/format.h>
#include <set>
#include <utility>
#include <xlsxwriter.h>

namespace damslip::pages {

Formula::Formula(double value) : text_(shortest(value)), value_(value), compound_(value < 0.0), constant_(true) {}

Formula::Formula(std::string text, double value, bool compound) : text_(std::move(text)), value_(value), compound_(compound) {}

Formula Formula::combined(const Formula& a, const char* sign, const Formula& b, double value)
{
    return {a.inside() + sign + b.inside(), value};
}

namespace {

Formula call(const char* name, const std::vector<Formula>& arguments, double value)
{
    std::string list;
    for (const Formula& a : arguments) list += (list.empty() ? "" : ",") + a.text();
    return {std::string(name) + "(" + list + ")", value, false};
}

constexpr int name_column = 0, value_column = 1, unit_column = 2, source_column = 3;
constexpr std::time_t no_date = 946684800; // 2000-01-01: the day a sheet is made would make each file another

} // namespace

Formula sqrt(const Formula& a)
{
    return call("SQRT", {a}, std::sqrt(a.value()));
}

Formula abs(const Formula& a)
{
    return call("ABS", {a}, std::abs(a.value()));
}

Formula max(const Formula& a, const Formula& b)
{
    return call("MAX", {a, b}, std::max(a.value(), b.value()));
}

Formula if_greater(const Formula& a, const Formula& b, const Formula& then, const Formula& otherwise)
{
    return {fmt::format("IF({}>{},{},{})", a.text(), b.text(), then.text(), otherwise.text()),
            a.value() > b.value() ? then.value() : otherwise.value(), false};
}

Formula sum(const std::vector<Formula>& terms)
{
    if (terms.empty()) return 0.0;
    double value = 0.0;
    for (const Formula& t : terms) value += t.value();
    return call("SUM", terms, value);
}

struct Workbook::Sheet {
    lxw_workbook* book = nullptr; ///< null: closed
    lxw_worksheet* page = nullptr;
    lxw_format *bold = nullptr, *input = nullptr;
    std::set<std::string> names; ///< in small letters: a spreadsheet does not tell them apart
};

Workbook::Workbook(std::filesystem::path file) : file_(std::move(file)), sheet_(std::make_unique<Sheet>())
{
    if (file_.has_parent_path()) make_folder(file_.parent_path());
    sheet_->book = workbook_new(part().c_str());
    lxw_doc_properties properties = {};
    properties.created = no_date;
    workbook_set_properties(sheet_->book, &properties);
    sheet_->bold = workbook_add_format(sheet_->book);
    format_set_bold(sheet_->bold);
    sheet_->input = workbook_add_format(sheet_->book); // numbers that are given, as against computed ones
    format_set_font_color(sheet_->input, LXW_COLOR_BLUE);
}

Workbook::~Workbook()
{
    if (!sheet_->book) return; // an exception ended it
    workbook_close(sheet_->book);
    std::error_code ignored;
    std::filesystem::remove(part(), ignored);
}

void Workbook::begin(const std::string& wanted)
{
    std::string name;
    for (const char c : wanted.substr(0, 27))
        name += std::string_view("[]:*?/\\'").find(c) == std::string_view::npos && static_cast<unsigned char>(c) < 0x80 ? c : '_';
    const auto small = [](std::string text) {
        for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        return text;
    };
    const std::string plain = name;
    for (int n = 2; !sheet_->names.insert(small(name)).second; ++n) name = fmt::format("{} {}", plain, n);
    sheet_->page = workbook_add_worksheet(sheet_->book, name.c_str());
    worksheet_set_landscape(sheet_->page);
    worksheet_fit_to_pages(sheet_->page, 1, 0); // on paper: as wide as a page, as long as it is
    worksheet_set_column(sheet_->page, name_column, name_column, 44, nullptr);
    worksheet_set_column(sheet_->page, value_column, 9, 16, nullptr);
    row_ = 0;
}

void Workbook::title(const std::string& text)
{
    if (row_ > 0) ++row_;
    words(name_column, text, Bold::yes);
    ++row_;
}

void Workbook::note(const std::string& text)
{
    words(name_column, text);
    ++row_;
}

void Workbook::head(const std::vector<std::string>& columns)
{
    for (std::size_t i = 0; i < columns.size(); ++i) words(static_cast<int>(i), columns[i], Bold::yes);
    ++row_;
}

void Workbook::words(int column, const std::string& text, Bold bold)
{
    worksheet_write_string(sheet_->page, static_cast<lxw_row_t>(row_), static_cast<lxw_col_t>(column), text.c_str(),
                           bold == Bold::yes ? sheet_->bold : nullptr);
}

Formula Workbook::cell(int column, const Formula& value)
{
    const auto row = static_cast<lxw_row_t>(row_);
    const auto col = static_cast<lxw_col_t>(column);
    if (!std::isfinite(value.value()))
        worksheet_write_string(sheet_->page, row, col, "none", nullptr);
    else if (value.constant())
        worksheet_write_number(sheet_->page, row, col, value.value(), sheet_->input);
    else
        worksheet_write_formula_num(sheet_->page, row, col, ("=" + value.text()).c_str(), nullptr, value.value());
    return {fmt::format("{}{}", static_cast<char>('A' + column), row_ + 1), value.value(), false};
}

Formula Workbook::put(const std::string& name, const Formula& value, const std::string& unit, const std::string& source)
{
    words(name_column, name);
    const Formula reference = cell(value_column, value);
    words(unit_column, unit);
    if (!source.empty()) words(source_column, source);
    ++row_;
    return reference;
}

void Workbook::word(const std::string& name, const std::string& text)
{
    words(name_column, name);
    words(value_column, text);
    ++row_;
}

std::vector<Formula> Workbook::row(const std::string& name, const std::vector<Formula>& cells)
{
    words(name_column, name);
    std::vector<Formula> references;
    for (std::size_t i = 0; i < cells.size(); ++i) references.push_back(cell(static_cast<int>(i) + 1, cells[i]));
    ++row_;
    return references;
}

void Workbook::compare(const std::string& name, const Formula& of_sheet, double of_program, const std::string& unit)
{
    if (!std::isfinite(of_program)) { // no shear: no factor
        word(name, "none");
        return;
    }
    words(name_column, name);
    const Formula ours = cell(1, of_sheet), theirs = cell(2, of_program);
    cell(3, abs(ours - theirs) / max(max(abs(ours), abs(theirs)), 1e-300));
    words(4, unit);
    ++row_;
}

void Workbook::close()
{
    lxw_workbook* const book = std::exchange(sheet_->book, nullptr);
    const lxw_error error = workbook_close(book);
    std::error_code failed;
    if (error == LXW_NO_ERROR) std::filesystem::rename(part(), file_, failed);
    if (error != LXW_NO_ERROR || failed)
        throw InputError(Diagnostic{file_.string(), 0, 0,
                                    fmt::format("cannot be written: {}.", failed ? failed.message() : lxw_strerror(error)), {},
                                    "check the folder and its permissions"});
}

} // namespace damslip::pages
