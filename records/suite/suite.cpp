#include "records/suite/suite.hpp"

#include "core/csv.hpp"
#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/text.hpp"
#include "records/measure/measures.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <numeric>
#include <set>

namespace damslip::records {

namespace {

[[noreturn]] void refuse_suite(std::string problem, std::string expected, std::string fix)
{
    throw InputError(Diagnostic{"", 0, 0, "record suite: " + std::move(problem), std::move(expected), std::move(fix)});
}

constexpr double none_yet = std::numeric_limits<double>::infinity();

double mean_square(std::span<const double> values)
{
    double sum = 0.0;
    for (const double v : values) sum += v * v;
    return sum / static_cast<double>(values.size());
}

/// A candidate as the search sees it.
struct ScaledCandidate {
    ChosenRecord chosen;
    std::vector<double> residual; ///< ln(f S_a / target)
    double cost = 0.0;            ///< its own part of the objective
};

/// Sets of candidates, their objective, and the ways through them.
class SuiteSearch {
public:
    SuiteSearch(std::span<const SuiteCandidate> candidates, std::span<const double> log_target,
                const SuiteOptions& options)
        : candidates_(candidates), options_(options), periods_(log_target.size())
    {
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            ScaledCandidate c{scaled_to_target(candidates[i], log_target, options.max_scale), {}, 0.0};
            c.chosen.record = i;
            const double log_factor = std::log(c.chosen.factor);
            for (std::size_t k = 0; k < periods_; ++k)
                c.residual.push_back(candidates[i].log_spectrum[k] + log_factor - log_target[k]);
            c.cost = mean_square(c.residual) + (options.least_scaling ? log_factor * log_factor : 0.0);
            scaled_.push_back(std::move(c));
        }
    }

    double objective(const std::vector<std::size_t>& set) const
    {
        std::vector<double> mean(periods_, 0.0);
        double own = 0.0;
        for (const std::size_t i : set) {
            for (std::size_t k = 0; k < periods_; ++k) mean[k] += scaled_[i].residual[k];
            own += scaled_[i].cost;
        }
        const auto n = static_cast<double>(set.size());
        return mean_square(mean) / (n * n) + own / n;
    }

    /// The best of all sets. Ties: the first in the order of the candidates.
    std::vector<std::size_t> all_sets()
    {
        std::vector<std::size_t> set;
        best_value_ = none_yet;
        extend(set, 0);
        return best_;
    }

    std::vector<std::size_t> step_by_step() const
    {
        std::vector<std::size_t> set;
        while (set.size() < options_.select) {
            set.push_back(0);
            set.back() = best_at(set, set.size() - 1);
        }
        for (bool moved = true; moved;) { // each exchange lowers the objective, so that this ends
            moved = false;
            for (std::size_t place = 0; place < set.size(); ++place) {
                const double before = objective(set);
                std::vector<std::size_t> other = set;
                other[place] = best_at(set, place);
                if (objective(other) < before) set = std::move(other), moved = true;
            }
        }
        std::sort(set.begin(), set.end());
        return set;
    }

    SuiteSelection selection(const std::vector<std::size_t>& set) const
    {
        SuiteSelection s;
        std::vector<double> mean(periods_, 0.0);
        double own = 0.0;
        for (const std::size_t i : set) {
            s.chosen.push_back(scaled_[i].chosen);
            for (std::size_t k = 0; k < periods_; ++k)
                mean[k] += scaled_[i].residual[k] / static_cast<double>(set.size());
            own += scaled_[i].chosen.misfit * scaled_[i].chosen.misfit;
        }
        s.mean_misfit = std::sqrt(mean_square(mean));
        s.single_misfit = std::sqrt(own / static_cast<double>(set.size()));
        return s;
    }

private:
    bool event_is_in(const std::vector<std::size_t>& set, std::size_t candidate, std::size_t but_place) const
    {
        for (std::size_t p = 0; p < set.size(); ++p)
            if (p != but_place && candidates_[set[p]].event == candidates_[candidate].event) return true;
        return false;
    }

    /// The candidate that suits this place of a set best.
    std::size_t best_at(std::vector<std::size_t> set, std::size_t place) const
    {
        double best_value = none_yet;
        std::size_t best = set[place];
        for (std::size_t i = 0; i < scaled_.size(); ++i) {
            if (event_is_in(set, i, place)) continue;
            set[place] = i;
            if (const double value = objective(set); value < best_value) best_value = value, best = i;
        }
        return best;
    }

    void extend(std::vector<std::size_t>& set, std::size_t from)
    {
        if (set.size() == options_.select) {
            if (const double value = objective(set); value < best_value_) best_value_ = value, best_ = set;
            return;
        }
        for (std::size_t i = from; i < scaled_.size(); ++i) {
            if (event_is_in(set, i, set.size())) continue;
            set.push_back(i);
            extend(set, i + 1);
            set.pop_back();
        }
    }

    std::span<const SuiteCandidate> candidates_;
    const SuiteOptions& options_;
    std::size_t periods_;
    std::vector<ScaledCandidate> scaled_;
    std::vector<std::size_t> best_;
    double best_value_ = none_yet;
};

/// n over k, or `most` + 1 where it is more.
std::size_t subsets(std::size_t n, std::size_t k, std::size_t most)
{
    double count = 1.0;
    for (std::size_t i = 0; i < k; ++i) count *= static_cast<double>(n - i) / static_cast<double>(i + 1);
    return count > static_cast<double>(most) ? most + 1 : static_cast<std::size_t>(std::llround(count));
}

} // namespace

ChosenRecord scaled_to_target(const SuiteCandidate& candidate, std::span<const double> log_target, double max_scale)
{
    if (candidate.log_spectrum.size() != log_target.size() || log_target.empty())
        refuse_suite(
            fmt::format("a spectrum has {} values, the target {}.", candidate.log_spectrum.size(), log_target.size()),
            "the same periods for both", "correct the caller");
    double sum = 0.0;
    for (std::size_t k = 0; k < log_target.size(); ++k) sum += log_target[k] - candidate.log_spectrum[k];
    const double wanted = sum / static_cast<double>(log_target.size()), limit = std::log(max_scale);
    const double log_factor = std::clamp(wanted, -limit, limit);
    ChosenRecord chosen;
    chosen.factor = std::exp(log_factor);
    chosen.at_limit = std::abs(wanted) > limit * (1.0 + 1e-12) + 1e-12;
    std::vector<double> residual;
    for (std::size_t k = 0; k < log_target.size(); ++k)
        residual.push_back(candidate.log_spectrum[k] + log_factor - log_target[k]);
    chosen.misfit = std::sqrt(mean_square(residual));
    return chosen;
}

SuiteSelection select_suite(std::span<const SuiteCandidate> candidates, std::span<const double> log_target,
                            const SuiteOptions& options)
{
    std::set<std::string> events;
    for (const SuiteCandidate& c : candidates) events.insert(c.event);
    if (options.select < 1 || options.select > events.size())
        refuse_suite(fmt::format("{} records are wanted of {} events.", options.select, events.size()),
                     fmt::format("1 to {}: components of one event are no independent records", events.size()),
                     "select fewer, or add records");
    if (!(options.max_scale >= 1.0))
        refuse_suite(fmt::format("the largest factor {} is not allowed.", options.max_scale), "at least 1",
                     "for example 4");
    SuiteSearch search(candidates, log_target, options);
    const bool all = subsets(candidates.size(), options.select, options.most_subsets) <= options.most_subsets;
    SuiteSelection selection = search.selection(all ? search.all_sets() : search.step_by_step());
    selection.exhaustive = all;
    return selection;
}

SuiteSelection whole_suite(std::span<const SuiteCandidate> candidates, std::span<const double> log_target,
                           double max_scale)
{
    SuiteOptions options;
    options.max_scale = max_scale;
    std::vector<std::size_t> all(candidates.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    SuiteSelection selection = SuiteSearch(candidates, log_target, options).selection(all);
    selection.exhaustive = true;
    return selection;
}

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
