#include "pages/report/answer.hpp"

#include "core/file.hpp"
#include "core/text.hpp"
#include "core/version.hpp"
#include "pages/report/table_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace damslip::pages {

std::string html_text(std::string_view text)
{
    static const std::map<char, const char*> entities{
        {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}};
    std::string out;
    out.reserve(text.size());
    for (const char c : text)
        if (const auto entity = entities.find(c); entity != entities.end())
            out += entity->second;
        else if (static_cast<unsigned char>(c) >= 0x20 || c == '\t' || c == '\n')
            out += c;
    return out;
}

std::string json_text(std::string_view text)
{
    const std::string quoted =
        nlohmann::json(std::string(text)).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    std::string out;
    out.reserve(quoted.size());
    for (const char c : quoted) {
        if (c == '<')
            out += "\\u003c";
        else
            out += c;
    }
    return out;
}

namespace {

struct JsonOf {
    nlohmann::ordered_json operator()(std::monostate) const { return nullptr; }
    template <class Value>
    nlohmann::ordered_json operator()(const Value& value) const
    {
        return value;
    }
};

} // namespace

nlohmann::ordered_json json_of(const Table& table)
{
    auto rows = nlohmann::ordered_json::array();
    for (const std::vector<Cell>& row : table.rows) {
        auto& object = rows.emplace_back(nlohmann::ordered_json::object());
        for (std::size_t j = 0; j < row.size(); ++j) object[table.columns[j].key] = std::visit(JsonOf{}, row[j]);
    }
    return rows;
}

nlohmann::ordered_json json_header(const std::string& what)
{
    nlohmann::ordered_json j;
    j["schema"] = "damslip." + what + "/1";
    j["program"] = {{"name", "damslip"}, {"version", program_version()}};
    return j;
}

void add_json_number(std::string& out, double value, int digits)
{
    if (!std::isfinite(value)) {
        out += "null";
        return;
    }
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
    out.append(text, end);
}

std::string json_number(const std::optional<double>& value, int digits)
{
    std::string out;
    add_json_number(out, value.value_or(std::numeric_limits<double>::quiet_NaN()), digits);
    return out;
}

std::string json_numbers(const std::vector<double>& values, int digits)
{
    std::string out = "[";
    out.reserve(8 * values.size() + 2);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i) out += ',';
        add_json_number(out, values[i], digits);
    }
    return out + "]";
}

namespace {

constexpr int most_digits = 4;

/// The columns of the answer in brief, without those that have nothing to show.
Table part_of(const Table& table)
{
    Table part{table.title, {}, std::vector<std::vector<Cell>>(table.rows.size()), {}};
    for (std::size_t j = 0; j < table.columns.size(); ++j) {
        const Column& column = table.columns[j];
        const auto empty = [&](const auto& row) { return std::holds_alternative<std::monostate>(row[j]); };
        if (column.brief == Brief::no || std::ranges::all_of(table.rows, empty)) continue;
        part.columns.push_back(column);
        if (!column.brief_heading.empty()) part.columns.back().heading = column.brief_heading;
        for (std::size_t i = 0; i < table.rows.size(); ++i) part.rows[i].push_back(table.rows[i][j]);
    }
    return part;
}

double rounded(double value)
{
    if (value == 0.0 || !std::isfinite(value)) return value;
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) + 1 - most_digits);
    return unit > 1.0 ? std::round(value / unit) * unit : value; // decimals are the column's
}

/// Slips, and all lengths of a table that has millimetres, in millimetres; four digits at most.
void for_a_glance(Table& table)
{
    const bool millimetres = std::ranges::any_of(table.columns, [](const Column& c) {
        return c.unit == "mm" || (c.unit == "m" && c.key.find("slip") != std::string::npos);
    });
    for (std::size_t j = 0; j < table.columns.size(); ++j) {
        Column& column = table.columns[j];
        const double factor = millimetres && column.unit == "m" ? 1e3 : 1.0;
        if (factor != 1.0) column.unit = "mm";
        column.digits = std::min(column.digits, most_digits);
        for (std::vector<Cell>& row : table.rows)
            if (double* value = std::get_if<double>(&row[j])) *value = rounded(*value * factor);
    }
}

/// Cut to so many characters, the last of them an ellipsis.
std::string cut(const std::string& text, std::size_t characters)
{
    if (text_width(text) <= characters) return text;
    std::size_t at = 0, seen = 0;
    while (at < text.size() && seen + 1 < characters) {
        ++at;
        while (at < text.size() && (text[at] & 0xC0) == 0x80) ++at;
        ++seen;
    }
    return text.substr(0, at) + "…";
}

/// Texts shortened, and in the end columns left out, until a line holds the table.
void fit(Table& table)
{
    const auto wanted = [&](std::size_t j) {
        std::size_t most = std::max(text_width(table.columns[j].heading), text_width(table.columns[j].unit));
        for (const auto& row : table.rows) most = std::max(most, text_width(cell_text(row[j], table.columns[j].digits)));
        return most;
    };
    for (;;) {
        constexpr std::size_t least_text = 10;
        std::size_t sum = 0, widest = table.columns.size(), most = least_text;
        for (std::size_t j = 0; j < table.columns.size(); ++j) {
            const std::size_t w = wanted(j);
            sum += w + 2;
            const auto text = [&](const auto& row) { return std::holds_alternative<std::string>(row[j]); };
            if (std::ranges::any_of(table.rows, text) && w > most && text_width(table.columns[j].heading) < w)
                most = w, widest = j;
        }
        if (sum <= brief_columns + 2) return;
        if (widest == table.columns.size()) {
            table.columns.pop_back();
            for (auto& row : table.rows) row.pop_back();
            continue;
        }
        const std::size_t to = std::max(least_text, most - std::min(most, sum - brief_columns - 2));
        for (auto& row : table.rows)
            if (std::string* words = std::get_if<std::string>(&row[widest]))
                *words = cut(visible(*words, LineEnds::replaced), to);
    }
}

/// So many rows, in their order: the first, or those with the largest numbers in the column that ranks.
Table with_rows(const Table& table, std::size_t count)
{
    if (table.rows.size() <= count) return table;
    std::vector<std::size_t> order(table.rows.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto ranks = std::ranges::find(table.columns, Brief::ranks, &Column::brief);
    if (ranks != table.columns.end()) {
        const auto at = static_cast<std::size_t>(ranks - table.columns.begin());
        const auto size = [&](std::size_t i) { // a word in place of a number, "at least 310", is looked at first
            if (const double* value = std::get_if<double>(&table.rows[i][at])) return std::abs(*value);
            return std::holds_alternative<std::string>(table.rows[i][at]) ? HUGE_VAL : -1.0;
        };
        std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return size(a) > size(b); });
    }
    order.resize(count);
    std::ranges::sort(order);
    Table part{table.title, table.columns, {}, {}};
    for (const std::size_t i : order) part.rows.push_back(table.rows[i]);
    return part;
}

/// A sentence in at most so many lines, the last one cut.
std::string lines_of(const std::string& sentence, std::size_t most, const std::string& indent = "")
{
    std::string words; // a path is one word, however long
    for (std::size_t from = 0; from <= sentence.size();) {
        const std::size_t end = std::min(sentence.find(' ', from), sentence.size());
        words += (from ? " " : "") + cut(sentence.substr(from, end - from), brief_columns - text_width(indent) - 2);
        from = end + 1;
    }
    const std::string all = broken_lines(words, indent);
    std::size_t at = 0;
    for (std::size_t k = 0; k < most; ++k) at = std::min(all.find('\n', at), all.size() - 1) + 1;
    if (at >= all.size()) return all;
    const std::size_t begin = at < 2 ? 0 : all.rfind('\n', at - 2) + 1; // of the last line
    const std::string last = all.substr(begin, at - 1 - begin);
    return all.substr(0, begin) + cut(last + " …", brief_columns) + "\n";
}

std::size_t count_lines(const std::string& text)
{
    return static_cast<std::size_t>(std::ranges::count(text, '\n'));
}

/// Without what stands in parentheses.
std::string without_asides(const std::string& sentence)
{
    std::string out;
    int depth = 0;
    for (const char c : sentence) {
        if (c == '(') {
            while (depth == 0 && !out.empty() && out.back() == ' ') out.pop_back();
            ++depth;
        }
        if (depth == 0) out += c;
        if (c == ')') depth = std::max(0, depth - 1);
    }
    return out;
}

/// As many whole clauses as fit; a first clause that is longer is cut.
std::string clauses(const std::string& sentence, std::size_t characters)
{
    std::size_t end = 0;
    for (std::size_t at = 0; at < sentence.size(); ++at) {
        const bool stop = std::string_view(",;.").find(sentence[at]) != std::string_view::npos;
        if (at + 1 != sentence.size() && !(stop && sentence[at + 1] == ' ')) continue;
        const std::size_t here = stop ? at : at + 1;
        if (text_width(sentence.substr(0, here)) > characters) break;
        end = here;
    }
    return end ? sentence.substr(0, end) : cut(sentence, characters);
}

std::string without_stop(std::string text)
{
    while (!text.empty() && (text.back() == '.' || text.back() == '\n')) text.pop_back();
    return text;
}

} // namespace

Answer::Answer(nlohmann::ordered_json header)
    : header_(std::make_shared<const nlohmann::ordered_json>(std::move(header)))
{
}

Answer& Answer::operator+=(const std::string& text)
{
    full_ += text;
    return *this;
}

void Answer::add(const std::string& id, Table table, Places places)
{
    if (places.text && !table.rows.empty())
        full_ += (places.turned ? text_by_columns(table, places.turned) : text(table)) + "\n";
    if (Table part = places.brief ? part_of(table) : Table(); !part.rows.empty() && !part.columns.empty())
        tables_.push_back(std::move(part));
    if (!places.file.empty()) files_.emplace_back(places.file, table);
    if (places.data) data_.emplace_back(id, std::move(table));
}

void Answer::set(const std::string& id, nlohmann::ordered_json value)
{
    data_.emplace_back(id, std::make_shared<const nlohmann::ordered_json>(std::move(value)));
}

nlohmann::ordered_json Answer::json() const
{
    nlohmann::ordered_json j = *header_;
    for (const auto& [id, item] : data_)
        if (const Table* table = std::get_if<Table>(&item))
            j[id] = json_of(*table);
        else
            j[id] = *std::get<Value>(item);
    return j;
}

std::vector<std::pair<std::string, Table>> Answer::tables() const
{
    std::vector<std::pair<std::string, Table>> list;
    for (const auto& [id, item] : data_)
        if (const Table* table = std::get_if<Table>(&item)) list.emplace_back(id, *table);
    return list;
}

void Answer::write(const std::filesystem::path& folder, const std::vector<std::string>& comments) const
{
    write_file(folder / "summary.json", json().dump(2) + "\n");
    for (const auto& [name, table] : files_) write_file(folder / name, csv(table, comments));
}

void Answer::headline(const Headline& headline)
{
    headline_ = headline;
    full_ += headline.sentence + "\n" + headline.verdict + "\n";
}

void Answer::point(const std::string& name, const std::string& sentence)
{
    if (!sentence.empty()) points_.push_back(name.empty() ? sentence : name + ": " + sentence);
}

void Answer::note(const std::string& note)
{
    full_ += "note: " + note + "\n";
    note_in_brief(note);
}

void Answer::notes(const std::string& id, const std::vector<std::string>& notes)
{
    set(id, notes);
    for (const std::string& each : notes) note(each);
}

void Answer::note_in_brief(const std::string& note)
{
    const auto same = [&](const std::string& other) { return without_stop(other) == without_stop(note); };
    if (std::ranges::none_of(notes_, same)) notes_.push_back(note);
}

void Answer::next(const std::string& command)
{
    next_ = command;
}

std::string Answer::line() const
{
    std::string verdict = clauses(without_stop(without_asides(headline_.verdict)), brief_columns / 2);
    if (headline_.outcome == Outcome::fail && verdict.find("FAIL") == std::string::npos) // what fails had no room
        verdict = verdict.empty() ? "FAIL" : "FAIL; " + verdict;
    const std::string sentence = without_stop(without_asides(visible(headline_.sentence, LineEnds::replaced)));
    const std::string begin = verdict.empty() || sentence.empty() ? verdict : verdict + ": ";
    return begin + clauses(sentence, brief_columns - text_width(begin)) + "\n";
}

std::string Answer::in_room(const Room& room, const std::string& files) const
{
    constexpr std::size_t verdict_lines = 2, sentence_lines = 6;
    std::string out;
    if (!headline_.verdict.empty()) out += lines_of(headline_.verdict, verdict_lines);
    if (!headline_.sentence.empty()) out += lines_of(visible(headline_.sentence, LineEnds::replaced), sentence_lines);
    for (std::size_t k = 0; k < std::min(room.tables, tables_.size()); ++k) {
        Table shown = with_rows(tables_[k], room.rows);
        for_a_glance(shown);
        fit(shown);
        shown.title = cut(shown.title, brief_columns);
        if (const std::size_t left_out = tables_[k].rows.size() - shown.rows.size())
            shown.notes.push_back(fmt::format("{} more rows", left_out));
        out += (out.empty() ? "" : "\n") + text(shown);
    }
    if (!out.empty()) out += "\n";
    for (const std::string& point : points_) out += lines_of(visible(point, LineEnds::replaced), room.point_lines);
    const std::size_t notes = std::min(room.notes, notes_.size());
    for (std::size_t k = 0; k < notes; ++k)
        out += lines_of("note: " + visible(notes_[k], LineEnds::replaced), room.note_lines);
    std::string rest = "more: --full prints all tables";
    if (notes < notes_.size()) rest += fmt::format(" and {} more note{}", notes_.size() - notes, notes + 1 < notes_.size() ? "s" : "");
    if (!files.empty()) rest += fmt::format("; {} writes them", files);
    out += rest + "\n";
    if (!next_.empty()) out += cut("next: " + next_, brief_columns) + "\n";
    return out;
}

std::string Answer::brief(const std::string& files) const
{
    constexpr std::size_t most = 1000, few_rows = 6, least_rows = 3;
    Room room{brief_lines, most, 3, tables_.size(), 2};
    // What can wait longest goes first, down to so many.
    const std::vector<std::pair<std::size_t Room::*, std::size_t>> steps{
        {&Room::note_lines, 1},    {&Room::notes, 4},  {&Room::rows, few_rows}, {&Room::tables, 2}, {&Room::notes, 2},
        {&Room::rows, least_rows}, {&Room::tables, 1}, {&Room::point_lines, 1}, {&Room::notes, 0}};
    for (;;) {
        std::string out = in_room(room, files);
        const std::size_t lines = count_lines(out);
        if (lines <= brief_lines) return out;
        if (room.notes > notes_.size()) room.notes = notes_.size();
        const auto step = std::ranges::find_if(steps, [&](const auto& s) { return room.*s.first > s.second; });
        if (step == steps.end()) { // a headline that is longer than any
            std::size_t at = 0;
            for (std::size_t k = 0; k + 1 < brief_lines; ++k) at = out.find('\n', at) + 1;
            return out.substr(0, at) + "more: --full prints the rest\n";
        }
        --(room.*step->first);
        if (step->first == &Room::tables && step->second == 1) room.rows = brief_lines;
    }
}

} // namespace damslip::pages
