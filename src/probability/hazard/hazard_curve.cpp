#include "probability/hazard/hazard_curve.hpp"

#include "core/file.hpp"
#include "core/input_error.hpp"
#include "core/number.hpp"
#include "probability/laws/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace damslip::probability {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

struct CsvLine {
    int number = 0;
    std::vector<std::string> fields;
};

std::string trimmed(std::string_view text)
{
    const std::size_t first = text.find_first_not_of(" \t\r\"");
    if (first == std::string_view::npos) return {};
    return std::string(text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1));
}

std::vector<std::string> split(std::string_view line)
{
    std::vector<std::string> fields;
    for (std::size_t start = 0; start <= line.size();) {
        const std::size_t comma = std::min(line.find(',', start), line.size());
        fields.push_back(trimmed(line.substr(start, comma - start)));
        start = comma + 1;
    }
    return fields;
}

/// What stands behind "name=" in a comment: 50.0, 'PGA', "SA(0.5)". Empty: not there.
std::string setting(std::string_view comment, std::string_view name)
{
    for (std::size_t at = comment.find(name); at != std::string_view::npos; at = comment.find(name, at + 1)) {
        std::string_view rest = comment.substr(at + name.size());
        rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
        if (!rest.starts_with('=')) continue;
        rest.remove_prefix(1);
        rest.remove_prefix(std::min(rest.find_first_not_of(" \t'\""), rest.size()));
        return std::string(rest.substr(0, rest.find_first_of(",'\" \t\r\n")));
    }
    return {};
}

/// hazard_curve-mean-PGA_1.csv, hazard_curve-mean-SA(0.5)_12.csv: what stands between the last "-" and the "_" behind it.
std::string measure_in_name(const std::string& file)
{
    const std::string stem = std::filesystem::path(file).stem().string();
    const std::size_t dash = stem.find_last_of('-');
    if (dash == std::string::npos) return {};
    const std::string word = stem.substr(dash + 1, stem.find('_', dash) - dash - 1);
    const bool known = word == "PGA" || word == "PGV" || word == "IA" || word == "CAV" || word.starts_with("SA(") ||
                       word.starts_with("avgSA") || word.starts_with("AvgSA");
    return known ? word : std::string{};
}

/// Reads one file; every complaint names file and line.
class HazardReader {
public:
    HazardReader(std::string_view text, const std::string& file) : file_(file)
    {
        int number = 0;
        for (std::size_t start = 0; start < text.size();) {
            const std::size_t end = std::min(text.find('\n', start), text.size());
            const std::string_view line = text.substr(start, end - start);
            start = end + 1;
            ++number;
            const std::string kept = trimmed(line);
            if (kept.empty()) continue;
            if (kept.front() == '#') {
                comment_.append(kept).append("\n");
                if (comment_line_ == 0) comment_line_ = number;
            } else {
                lines_.push_back({number, split(line)});
            }
        }
    }

    HazardFile read(const std::optional<Site>& site) const
    {
        if (lines_.size() < 2)
            wrong(0, fmt::format("the file has {} lines beside comments.", lines_.size()),
                  "a heading and the points of a hazard curve", "export the curve again");
        const std::vector<std::string>& heading = lines_.front().fields;
        const bool openquake =
            std::any_of(heading.begin(), heading.end(), [](const std::string& f) { return f.starts_with("poe-"); });
        return openquake ? of_openquake(site) : plain();
    }

private:
    [[noreturn]] void wrong(int line, std::string problem, std::string expected, std::string fix) const
    {
        throw InputError(Diagnostic{file_, line, 0, std::move(problem), std::move(expected), std::move(fix)});
    }

    double number(const CsvLine& line, std::size_t field, const std::string& what) const
    {
        const std::string text = field < line.fields.size() ? line.fields[field] : std::string{};
        const std::optional<double> value = parse_whole_number_text(text);
        if (!value)
            wrong(line.number, fmt::format("{} = \"{}\" is no number.", what, text), "a number", "correct the field");
        return *value;
    }

    std::string measure() const
    {
        const std::string said = setting(comment_, "imt");
        return said.empty() ? measure_in_name(file_) : said;
    }

    void check_point(const CsvLine& line, double x, double rate, double last_x, double last_rate) const
    {
        if (!(x > last_x))
            wrong(line.number, fmt::format("intensity {:g} follows {:g}.", x, last_x), "intensities > 0 that rise",
                  "sort the points by intensity, without repeating one");
        if (!(rate > 0.0))
            wrong(line.number, fmt::format("rate {:g} at intensity {:g}.", rate, x), "an annual rate > 0",
                  "leave out points without any earthquake");
        if (rate > last_rate)
            wrong(line.number,
                  fmt::format("rate {:g} at intensity {:g} is more than {:g} before it.", rate, x, last_rate),
                  "rates of exceedance, which never rise with the intensity",
                  "is the file of densities, or of return periods? Write annual rates of exceedance");
    }

    HazardFile plain() const
    {
        std::vector<double> x, rate;
        if (parse_whole_number_text(lines_.front().fields.front()))
            wrong(lines_.front().number, "the first line holds numbers.", "a heading: im,annual_rate",
                  "put the line  im,annual_rate  above the points");
        for (std::size_t k = 1; k < lines_.size(); ++k) {
            const CsvLine& line = lines_[k];
            if (line.fields.size() != 2)
                wrong(line.number, fmt::format("{} fields.", line.fields.size()),
                      "two: intensity and annual rate of exceedance", "remove the others");
            const double level = number(line, 0, "intensity"), h = number(line, 1, "annual rate");
            check_point(line, level, h, x.empty() ? 0.0 : x.back(),
                        rate.empty() ? std::numeric_limits<double>::infinity() : rate.back());
            x.push_back(level);
            rate.push_back(h);
        }
        if (x.size() < 2) wrong(0, "the curve has one point.", "two points at least", "export the whole curve");
        return {HazardCurve(std::move(x), std::move(rate)), measure(), 0.0, {}};
    }

    double investigation_time() const
    {
        const std::string text = setting(comment_, "investigation_time");
        const std::optional<double> years = parse_whole_number_text(text);
        if (!years || !(*years > 0.0))
            wrong(comment_line_,
                  text.empty() ? "the comment has no investigation_time."
                               : fmt::format("investigation_time = {} is not allowed.", text),
                  "investigation_time = years, > 0, in a comment line: poe is a probability within that time",
                  "add the line  # investigation_time=50.0, imt='PGA'");
        return *years;
    }

    const CsvLine& row_of(const std::optional<Site>& site, std::size_t lon, std::size_t lat) const
    {
        if (lines_.size() == 2 && !site) return lines_[1];
        if (!site)
            wrong(lines_[2].number, fmt::format("the file has {} sites.", lines_.size() - 1), "one, or a choice",
                  "name the site by its longitude and latitude, or keep one row");
        const CsvLine* best = nullptr;
        double nearest_distance = 0.01; // degree
        for (std::size_t k = 1; k < lines_.size(); ++k) {
            const double distance = std::hypot(number(lines_[k], lon, "lon") - site->longitude,
                                               number(lines_[k], lat, "lat") - site->latitude);
            if (distance <= nearest_distance) best = &lines_[k], nearest_distance = distance;
        }
        if (!best)
            wrong(0, fmt::format("no site within 0.01 degree of {:g}, {:g}.", site->longitude, site->latitude),
                  "longitude and latitude of a row", "take those of the file");
        return *best;
    }

    std::size_t column(const std::string& name) const
    {
        const std::vector<std::string>& heading = lines_.front().fields;
        const auto at = std::find(heading.begin(), heading.end(), name);
        if (at == heading.end())
            wrong(lines_.front().number, fmt::format("no column {}.", name), "lon,lat,depth,poe-…",
                  "export the curve again");
        return static_cast<std::size_t>(at - heading.begin());
    }

    HazardFile of_openquake(const std::optional<Site>& site) const
    {
        const double years = investigation_time();
        const CsvLine& row = row_of(site, column("lon"), column("lat"));
        const std::vector<std::string>& heading = lines_.front().fields;
        if (row.fields.size() != heading.size())
            wrong(row.number, fmt::format("{} fields below {} headings.", row.fields.size(), heading.size()),
                  "as many fields as headings", "export the curve again");
        std::vector<double> x, rate;
        std::vector<std::string> notes;
        for (std::size_t k = 0; k < heading.size(); ++k) {
            if (!heading[k].starts_with("poe-")) continue;
            const std::optional<double> level = parse_whole_number_text(heading[k].substr(4));
            if (!level)
                wrong(lines_.front().number, fmt::format("\"{}\" names no intensity.", heading[k]), "poe-0.1",
                      "correct it");
            const double poe = number(row, k, heading[k]);
            if (!(poe >= 0.0 && poe < 1.0))
                wrong(row.number, fmt::format("{} = {:g} is not allowed.", heading[k], poe),
                      "0 <= poe < 1: of poe = 1 no rate is known",
                      "leave the point out, or compute the hazard for a shorter investigation time");
            if (poe == 0.0) {
                notes.push_back(fmt::format("{} = 0: the point is left out", heading[k]));
                continue;
            }
            if (!notes.empty())
                wrong(row.number, fmt::format("{} = {:g} follows a poe of 0.", heading[k], poe),
                      "probabilities that never rise with the intensity", "export the curve again");
            const double h = -std::log1p(-poe) / years;
            check_point(row, *level, h, x.empty() ? 0.0 : x.back(),
                        rate.empty() ? std::numeric_limits<double>::infinity() : rate.back());
            x.push_back(*level);
            rate.push_back(h);
        }
        if (x.size() < 2)
            wrong(row.number, fmt::format("{} points have a poe above 0.", x.size()), "two points at least",
                  "compute the hazard at smaller intensities");
        return {HazardCurve(std::move(x), std::move(rate)), measure(), years, std::move(notes)};
    }

    const std::string& file_;
    std::string comment_;
    int comment_line_ = 0;
    std::vector<CsvLine> lines_;
};

} // namespace

HazardCurve::HazardCurve(std::vector<double> x, std::vector<double> rate) : x_(std::move(x)), rate_(std::move(rate))
{
    if (x_.size() != rate_.size() || x_.size() < 2)
        throw ParameterError("points", fmt::format("{}, {}", x_.size(), rate_.size()), "two at least, a rate for each");
    for (std::size_t i = 0; i < x_.size(); ++i) {
        if (!(x_[i] > (i ? x_[i - 1] : 0.0)) || !std::isfinite(x_[i]))
            throw ParameterError("x", shortest(x_[i]), "intensities > 0 that rise");
        if (!(rate_[i] > 0.0) || !std::isfinite(rate_[i]) || (i && rate_[i] > rate_[i - 1]))
            throw ParameterError("rate", shortest(rate_[i]), "rates > 0 that never rise");
    }
}

double HazardCurve::slope(std::size_t i) const
{
    return -std::log(rate_[i + 1] / rate_[i]) / std::log(x_[i + 1] / x_[i]);
}

double HazardCurve::rate_at(double x) const
{
    if (!(x >= x_.front() && x <= x_.back())) return not_a_number;
    const std::size_t above = static_cast<std::size_t>(std::lower_bound(x_.begin(), x_.end(), x) - x_.begin());
    if (x_[above] == x) return rate_[above];
    return rate_[above - 1] * std::pow(x / x_[above - 1], -slope(above - 1));
}

HazardFile parse_hazard_curve(std::string_view text, const std::string& file, std::optional<Site> site)
{
    return HazardReader(text, file).read(site);
}

HazardFile read_hazard_curve(const std::filesystem::path& file, std::optional<Site> site)
{
    return parse_hazard_curve(read_file(file), file.string(), site);
}

} // namespace damslip::probability
