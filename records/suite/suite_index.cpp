#include "records/suite/suite_index.hpp"

#include "core/csv.hpp"
#include "core/file.hpp"
#include "core/number.hpp"
#include "records/measure/response_spectrum.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

namespace damslip::records {

namespace {

struct Column {
    const char* name;
    double Measures::*value;
};

constexpr Column measure_columns[] = {{"duration_s", &Measures::duration},
                                      {"PGA_m_s2", &Measures::pga},
                                      {"PGA_time_s", &Measures::pga_time},
                                      {"PGV_m_s", &Measures::pgv},
                                      {"PGD_m", &Measures::pgd},
                                      {"final_velocity_m_s", &Measures::final_velocity},
                                      {"final_displacement_m", &Measures::final_displacement},
                                      {"arias_m_s", &Measures::arias_intensity},
                                      {"CAV_m_s", &Measures::cumulative_velocity},
                                      {"D5_75_s", &Measures::duration_5_75},
                                      {"D5_95_s", &Measures::duration_5_95}};
constexpr const char* mean_period_column = "mean_period_s"; ///< "none" of a record without one
constexpr const char* none = "none";

std::string spectrum_column(double period)
{
    return fmt::format("SA({})_m_s2", shortest(period));
}

std::string checksum(const Record& record)
{
    std::string bytes((record.acceleration.size() + 1) * sizeof(double), '\0');
    std::memcpy(bytes.data(), &record.dt, sizeof(double));
    std::memcpy(bytes.data() + sizeof(double), record.acceleration.data(), record.acceleration.size() * sizeof(double));
    return sha256(bytes);
}

/// What of a name a table of commas can hold.
std::string plain(std::string name)
{
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == ',' || c == '\n' || c == '"' || c == '#'; }, ' ');
    return name;
}

} // namespace

SuiteIndex::SuiteIndex(const std::filesystem::path& folder)
{
    if (folder.empty()) return;
    file_ = folder / ".damslip-index.csv";
    read();
}

void SuiteIndex::read()
{
    std::error_code error;
    if (!std::filesystem::is_regular_file(file_, error)) return;
    CsvTable table;
    try {
        table = parse_csv(read_file(file_));
    } catch (const InputError&) {
        return; // cannot be read: measured anew
    }
    const std::vector<std::string>& names = table.heading.cells;
    if (names.size() < 2 || names[0] != "record" || names[1] != "checksum") return;
    for (const CsvLine& row : table.rows) {
        if (row.cells.size() != names.size()) continue; // cut off
        Line line{row.cells[0], {}};
        for (std::size_t k = 2; k < names.size(); ++k) {
            const std::string& cell = row.cells[k];
            if (cell == none || parse_whole_number_text(cell)) line.cells.emplace(names[k], cell);
        }
        lines_.insert_or_assign(row.cells[1], std::move(line));
    }
}

SuiteIndex::Line& SuiteIndex::line_of(const Record& record)
{
    Line& line = lines_[checksum(record)];
    if (line.record.empty()) line.record = plain(record.name);
    return line;
}

Measures SuiteIndex::measures(const Record& record)
{
    Line& line = line_of(record);
    Measures measures;
    bool known = line.cells.contains(mean_period_column);
    for (const Column& column : measure_columns) {
        const auto found = line.cells.find(column.name);
        known = known && found != line.cells.end() && found->second != none;
        if (known) measures.*column.value = *parse_whole_number_text(found->second);
    }
    if (known) {
        const std::string& period = line.cells.at(mean_period_column);
        if (period != none) measures.mean_period = parse_whole_number_text(period);
        return measures;
    }
    measures = measure(record);
    ++computed_;
    for (const Column& column : measure_columns)
        line.cells.insert_or_assign(column.name, shortest(measures.*column.value));
    line.cells.insert_or_assign(mean_period_column, measures.mean_period ? shortest(*measures.mean_period) : none);
    return measures;
}

std::vector<double> SuiteIndex::spectrum(const Record& record, std::span<const double> periods)
{
    Line& line = line_of(record);
    std::vector<double> values(periods.size(), 0.0), missing;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < periods.size(); ++i) {
        const auto found = line.cells.find(spectrum_column(periods[i]));
        const auto value = found == line.cells.end() ? std::nullopt : parse_whole_number_text(found->second);
        if (value)
            values[i] = *value;
        else {
            missing.push_back(periods[i]);
            places.push_back(i);
        }
    }
    if (missing.empty()) return values;
    const ResponseSpectrum spectrum = response_spectrum(record.acceleration, record.dt, missing, 0.05);
    computed_ += missing.size();
    for (std::size_t k = 0; k < missing.size(); ++k) {
        const double value = spectrum.points[k].pseudo_acceleration;
        values[places[k]] = value;
        line.cells.insert_or_assign(spectrum_column(missing[k]), shortest(value));
    }
    return values;
}

void SuiteIndex::keep() const
{
    if (computed_ == 0 || file_.empty()) return;
    std::vector<std::string> names;
    for (const Column& column : measure_columns) names.emplace_back(column.name);
    names.emplace_back(mean_period_column);
    std::map<double, std::string> spectrum; // by period
    for (const auto& [sum, line] : lines_)
        for (const auto& [name, value] : line.cells)
            if (name.starts_with("SA("))
                if (const auto period = parse_whole_number_text(name.substr(3, name.find(')') - 3)))
                    spectrum.emplace(*period, name);
    for (const auto& [period, name] : spectrum) names.push_back(name);
    std::string text = "# measures of the records of this folder, kept by damslip; may be deleted at any time\n"
                       "record,checksum";
    for (const std::string& name : names) text += "," + name;
    text += "\n";
    for (const auto& [sum, line] : lines_) {
        text += line.record + "," + sum;
        for (const std::string& name : names) {
            const auto found = line.cells.find(name);
            text += "," + (found == line.cells.end() ? std::string() : found->second);
        }
        text += "\n";
    }
    try {
        write_file(file_, text);
    } catch (const InputError&) { // nothing is kept
    }
}

} // namespace damslip::records
