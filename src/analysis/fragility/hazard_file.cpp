#include "analysis/fragility/hazard_file.hpp"

#include "core/file.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "records/read/number_table.hpp"
#include "records/read/header.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace damslip {

namespace {

using records::lower;
using records::trimmed;
using Json = nlohmann::json;

/// A unit of an intensity: SI value, and whether it is one of acceleration (else of velocity).
struct IntensityUnit {
    std::string text;
    double si = 1.0;
    bool acceleration = true;
};

std::optional<IntensityUnit> intensity_unit(std::string_view text)
{
    std::string word = lower(trimmed(text));
    const bool percent = word.starts_with('%') || word.starts_with("pct") || word.starts_with("percent");
    if (percent) word = word.substr(word.find_last_of("gG%") == std::string::npos ? 0 : word.size() - 1);
    if (percent && word != "g") return std::nullopt;
    if (const auto unit = records::acceleration_unit(word))
        return IntensityUnit{percent ? "%g" : std::string(unit->name), (percent ? 0.01 : 1.0) * unit->factor, true};
    std::replace(word.begin(), word.end(), '_', '/');
    for (const auto& [name, si] : {std::pair{"m/s", 1.0},
                                   {"cm/s", units::cm},
                                   {"mm/s", units::mm},
                                   {"in/s", 0.0254},
                                   {"g*s", units::standard_gravity},
                                   {"g s", units::standard_gravity},
                                   {"g-s", units::standard_gravity},
                                   {"g-sec", units::standard_gravity}})
        if (word == name) return IntensityUnit{name, si, false};
    return std::nullopt;
}

/// What a column or a curve says how often.
enum class HazardKind { rate, probability, return_period };

/// What a heading says.
struct HazardHeading {
    enum class Role { intensity, how_often, measure, longitude, latitude, beside, unknown } role = Role::unknown;
    std::string measure;               ///< of an intensity, as IntensityName writes it; empty: not said
    std::optional<IntensityUnit> unit; ///< of an intensity
    HazardKind kind = HazardKind::rate;
    double years = 0.0; ///< of a probability; 0: not said
};
using Role = HazardHeading::Role;

bool has(std::string_view text, std::string_view part)
{
    return text.find(part) != std::string_view::npos;
}

template <std::size_t N>
bool is_one_of(std::string_view word, const std::array<std::string_view, N>& words)
{
    return std::find(words.begin(), words.end(), word) != words.end();
}

/// "50" of "poe in 50 years", "poe_50y": the number in front of a word that begins with y, or "a" alone; 1 of what is annual; 0: none.
double years_in(std::string_view text)
{
    for (std::size_t at = text.find_first_of("0123456789"); at != std::string_view::npos;
         at = text.find_first_of("0123456789", at)) {
        std::size_t used = 0;
        const std::optional<double> number = parse_number(text.substr(at), &used);
        if (!number) return 0.0;
        std::string_view unit = text.substr(at + used);
        unit.remove_prefix(std::min(unit.find_first_not_of(" ("), unit.size()));
        if (unit.empty() || unit.starts_with('y') || unit == "a") return *number;
        at += std::max<std::size_t>(used, 1);
    }
    return has(text, "annual") || has(text, "per year") || text == "apoe" || text == "aep" ? 1.0 : 0.0;
}

/// "PGA", "SA(0.5)" of "pga", "sa(0.5s)", "psa 0p5", "spectral acceleration 0.5 s"; empty: no measure; `generic`: an intensity of no measure.
std::string measure_of(std::string name, bool& generic)
{
    using namespace std::string_view_literals;
    generic = is_one_of(name, std::array{"im"sv, "iml"sv, "imls"sv, "intensity"sv, "level"sv, "levels"sv, "x"sv,
                                         "ground motion"sv, "acceleration"sv, "intensity measure level"sv});
    if (generic) return "";
    if (name == "pga" || name == "peak ground acceleration") return "PGA";
    if (name == "pgv" || name == "peak ground velocity") return "PGV";
    if (name == "ia" || name == "arias" || name == "arias intensity") return "IA";
    if (name == "cav" || name == "cumulative absolute velocity") return "CAV";
    for (const auto& [prefix, upper] :
         {std::pair{"avgsa"sv, "avgSA("}, {"spectral acceleration"sv, "SA("}, {"psa"sv, "SA("}, {"sa"sv, "SA("}}) {
        if (!name.starts_with(prefix)) continue;
        std::string periods = name.substr(prefix.size());
        if (periods == "(t1)") return "SA(T1)";
        std::erase_if(periods, [](char c) { return has("() ", std::string_view(&c, 1)); });
        for (const auto end : {"sec"sv, "s"sv})
            if (periods.ends_with(end)) periods.resize(periods.size() - end.size());
        std::replace(periods.begin(), periods.end(), 'p', '.');
        const std::optional<IntensityName> read = parse_intensity(upper + periods + ")");
        return read ? text_of(*read) : "";
    }
    return "";
}

std::optional<IntensityUnit> take_intensity_unit(std::string& heading)
{
    const auto unit =
        records::take_unit(heading, [](std::string_view text) { return intensity_unit(text).has_value(); });
    return unit ? intensity_unit(*unit) : std::nullopt;
}

HazardHeading heading_of(std::string_view heading)
{
    using namespace std::string_view_literals;
    HazardHeading h;
    std::string name = lower(trimmed(heading));
    const std::string whole = [&] {
        std::string text = name;
        std::replace(text.begin(), text.end(), '_', ' ');
        return text;
    }();
    const auto of_role = [&](Role role) {
        h.role = role;
        return h;
    };
    if (is_one_of(whole, std::array{"lon"sv, "longitude"sv})) return of_role(Role::longitude);
    if (is_one_of(whole, std::array{"lat"sv, "latitude"sv})) return of_role(Role::latitude);
    if (is_one_of(whole, std::array{"imt"sv, "measure"sv})) return of_role(Role::measure);
    if (is_one_of(whole, std::array{"depth"sv, "custom site id"sv, "site id"sv})) return of_role(Role::beside);
    const bool logarithm = whole.starts_with("ln") || whole.starts_with("log") || has(whole, "densit");
    if (logarithm) return h;
    if (has(whole, "return") || is_one_of(whole, std::array{"rp"sv, "tr"sv, "t r"sv, "mri"sv})) {
        h.kind = HazardKind::return_period;
        return of_role(Role::how_often);
    }
    if (has(whole, "poe") || has(whole, "probab") || whole == "aep") {
        h.kind = HazardKind::probability;
        h.years = years_in(whole);
        return of_role(Role::how_often);
    }
    if (has(whole, "rate") || has(whole, "frequency") ||
        is_one_of(whole, std::array{"afe"sv, "mafe"sv, "maf"sv, "aef"sv, "lambda"sv}))
        return whole.find_first_of("023456789") == std::string::npos ? of_role(Role::how_often) : h;
    h.unit = take_intensity_unit(name);
    std::replace(name.begin(), name.end(), '_', ' ');
    bool generic = false;
    h.measure = measure_of(name, generic);
    if (generic || !h.measure.empty()) h.role = Role::intensity;
    return h;
}

/// One curve as it stands in a file.
struct RawCurve {
    std::string measure; ///< as IntensityName writes it; empty: not said
    std::optional<IntensityUnit> unit;
    HazardKind kind = HazardKind::rate;
    double years = 0.0;                        ///< of probabilities; 0: not said
    std::optional<std::array<double, 2>> site; ///< longitude, latitude
    std::vector<double> x, how_often;
    std::vector<int> line; ///< of each point; 0: of none
};

const char* openquake_word(IntensityMeasure measure)
{
    if (is_acceleration(measure)) return "g";
    return measure == IntensityMeasure::pgv ? "cm/s" : measure == IntensityMeasure::cav ? "g*s" : "m/s";
}

/// Units of OpenQuake's exports.
std::optional<IntensityUnit> unit_of_openquake(const std::string& measure)
{
    const std::optional<IntensityName> name = parse_intensity(measure);
    return name ? intensity_unit(openquake_word(name->measure)) : std::nullopt;
}

/// What stands behind "name=" in a text: 50.0, 'PGA', "SA(0.5)". Empty: not there.
std::string setting(std::string_view text, std::string_view name)
{
    for (std::size_t at = text.find(name); at != std::string_view::npos; at = text.find(name, at + 1)) {
        std::string_view rest = text.substr(at + name.size());
        rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
        if (!rest.starts_with('=')) continue;
        rest.remove_prefix(1);
        rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
        const bool quoted = rest.starts_with('\'') || rest.starts_with('"');
        const std::string_view ends = quoted ? rest.substr(0, 1) : ",'\" \t\r\n>";
        if (quoted) rest.remove_prefix(1);
        return std::string(rest.substr(0, rest.find_first_of(ends)));
    }
    return {};
}

/// The curves of a file, in whatever form it has them.
class HazardReader {
public:
    HazardReader(std::string_view text, const std::string& file, const HazardWish& wish)
        : text_(text), file_(file), wish_(wish)
    {
    }

    HazardFile read()
    {
        const std::size_t first = text_.find_first_not_of(" \t\r\n\xef\xbb\xbf");
        const char kind = first == std::string_view::npos ? ' ' : text_[first];
        if (kind == '{' || kind == '[')
            read_json();
        else if (kind == '<')
            read_nrml();
        else
            read_table();
        return rated(chosen_by_site(chosen_by_measure()));
    }

private:
    [[noreturn]] void wrong(int line, std::string problem, std::string expected, std::string fix) const
    {
        throw InputError(Diagnostic{file_, line, 0, std::move(problem), std::move(expected), std::move(fix)});
    }
    /// "pga_g,annual_rate": a heading that fits the levels.
    std::string example() const
    {
        std::string unit = wish_.level_unit_text;
        std::replace(unit.begin(), unit.end(), '/', '_');
        return fmt::format("{}_{},annual_rate",
                           wish_.measure.first_period ? fmt::format("SA({:.3g})", wish_.first_period)
                                                      : lower(text_of(wish_.measure)),
                           unit);
    }
    [[noreturn]] void not_a_curve(const std::string& problem) const
    {
        wrong(0, problem, "CSV, an export of OpenQuake (CSV, NRML hazardCurves) or of the USGS web services (JSON)",
              fmt::format("write a CSV file with the heading  {}  and a line for each point", example()));
    }

    double number(std::string_view field, int line, const std::string& what) const
    {
        std::string text(field);
        if (decimal_comma_ && !has(text, ".")) std::replace(text.begin(), text.end(), ',', '.');
        const std::optional<double> value = parse_whole_number_text(text);
        if (!value) wrong(line, fmt::format("{} = \"{}\" is no number.", what, field), "a number", "correct the field");
        return *value;
    }

    double years_of(const std::string& text, int line) const
    {
        if (text.empty()) return 0.0;
        const std::optional<double> years = parse_whole_number_text(text);
        if (!years || !(*years > 0.0))
            wrong(line, fmt::format("investigation_time = {} is not allowed.", text), "years, > 0",
                  "write  # investigation_time=50");
        return *years;
    }

    /// hazard_curve-mean-PGA_1.csv, hazard_curve-mean-SA(0.5)_12.csv: what stands between the last "-" and the "_" behind it.
    std::string measure_in_name() const
    {
        const std::string stem = std::filesystem::path(file_).stem().string();
        const std::size_t dash = stem.find_last_of('-');
        if (dash == std::string::npos) return {};
        return known_measure(stem.substr(dash + 1, stem.find('_', dash) - dash - 1));
    }
    /// As IntensityName writes it; empty: none.
    static std::string known_measure(std::string_view text)
    {
        bool generic = false;
        return measure_of(lower(trimmed(text)), generic);
    }
    std::string measure_called(std::string_view text, int line) const
    {
        const std::string measure = known_measure(text);
        if (measure.empty())
            wrong(line, fmt::format("\"{}\" is no measure of intensity.", text), std::string(known_intensities),
                  "correct it");
        return measure;
    }

    struct Line {
        int number;
        std::vector<std::string_view> fields;
    };
    /// What the columns of a table are, by their headings.
    struct Columns {
        std::vector<std::string_view> names;
        std::vector<HazardHeading> headings;
        std::vector<std::size_t> intensities, poes; ///< poes: "poe-0.1", of OpenQuake, a site a line
        std::optional<std::size_t> how_often, measure, longitude, latitude;
        std::optional<std::size_t>* place_of(Role role)
        {
            return role == Role::how_often   ? &how_often
                   : role == Role::measure   ? &measure
                   : role == Role::longitude ? &longitude
                   : role == Role::latitude  ? &latitude
                                             : nullptr;
        }
    };
    Columns columns_of(const Line& line) const
    {
        Columns columns;
        columns.names = line.fields;
        for (std::size_t k = 0; k < line.fields.size(); ++k) {
            const std::string_view name = line.fields[k];
            const bool poe = name.starts_with("poe-") && parse_whole_number_text(name.substr(4));
            const HazardHeading& h = columns.headings.emplace_back(poe ? HazardHeading{} : heading_of(name));
            if (poe)
                columns.poes.push_back(k);
            else if (h.role == Role::unknown)
                wrong(line.number, fmt::format("the heading \"{}\" is not known.", name),
                      "measure and unit of an intensity (pga_g, \"Sa(0.5s) [m/s2]\"), or annual_rate, poe_50_years, "
                      "return_period, imt, lon, lat, depth",
                      fmt::format("rename the column, or delete it; for example  {}", example()));
            else if (h.role == Role::intensity)
                columns.intensities.push_back(k);
            if (std::optional<std::size_t>* const place = poe ? nullptr : columns.place_of(h.role)) {
                if (*place)
                    wrong(line.number, fmt::format("\"{}\" and \"{}\" are the same.", line.fields[**place], name),
                          "one column", "delete the other");
                *place = k;
            }
        }
        if (columns.poes.empty() && (columns.intensities.empty() || !columns.how_often))
            wrong(line.number,
                  columns.intensities.empty() ? "no heading names an intensity." : "no heading says how often.",
                  "an intensity (pga_g) and one of annual_rate, poe_50_years, return_period",
                  fmt::format("write the heading  {}", example()));
        return columns;
    }
    std::optional<std::array<double, 2>> site_of(const Columns& columns, const Line& line) const
    {
        if (!columns.longitude || !columns.latitude) return std::nullopt;
        return std::array{number(line.fields[*columns.longitude], line.number, "lon"),
                          number(line.fields[*columns.latitude], line.number, "lat")};
    }
    void add_point(RawCurve& curve, double x, const Columns& columns, std::size_t column, const Line& line) const
    {
        curve.x.push_back(x);
        curve.how_often.push_back(number(line.fields[column], line.number, std::string(columns.names[column])));
        curve.line.push_back(line.number);
    }
    /// A site with all its points. @param said  measure @param years  of the probabilities
    void add_site(const Columns& columns, const Line& line, const std::string& said, double years)
    {
        RawCurve& curve = curves_.emplace_back();
        curve.measure = said;
        curve.unit = unit_of_openquake(said.empty() ? text_of(wish_.measure) : said);
        curve.kind = HazardKind::probability;
        curve.years = years;
        curve.site = site_of(columns, line);
        for (const std::size_t p : columns.poes)
            add_point(curve, *parse_whole_number_text(columns.names[p].substr(4)), columns, p, line);
    }
    /// A point of each measure of the line.
    void add_points(const Columns& columns, const Line& line, const std::string& said, double years)
    {
        const std::string called = columns.measure ? measure_called(line.fields[*columns.measure], line.number) : said;
        const auto site = site_of(columns, line);
        for (const std::size_t i : columns.intensities) {
            const HazardHeading& of = columns.headings[i];
            if (!of.measure.empty() && !called.empty() && of.measure != called && columns.intensities.size() == 1)
                wrong(
                    line.number,
                    fmt::format("the heading \"{}\" is of {}, the file says {}.", columns.names[i], of.measure, called),
                    "one measure", "correct one of them");
            const std::string name = of.measure.empty() ? called : of.measure;
            const auto same = std::find_if(curves_.begin(), curves_.end(),
                                           [&](const RawCurve& c) { return c.measure == name && c.site == site; });
            RawCurve& curve = same != curves_.end() ? *same : curves_.emplace_back();
            const HazardHeading& often = columns.headings[*columns.how_often];
            curve.measure = name;
            curve.site = site;
            curve.unit = of.unit || !columns.measure ? of.unit : unit_of_openquake(name);
            curve.kind = often.kind;
            curve.years = often.years > 0.0 ? often.years : years;
            add_point(curve, number(line.fields[i], line.number, std::string(columns.names[i])), columns,
                      *columns.how_often, line);
        }
    }

    void read_table()
    {
        const records::RecordText text = records::split_lines(text_, file_);
        std::string comment;
        int comment_line = 0;
        std::vector<Line> lines;
        records::Dialect dialect;
        for (std::size_t k = 0; k < text.lines.size(); ++k) {
            const std::string_view line = trimmed(text.lines[k]);
            const int number = static_cast<int>(k) + 1;
            if (line.starts_with('#')) {
                comment.append(line).append("\n");
                if (comment_line == 0) comment_line = number;
            } else if (!line.empty()) {
                if (lines.empty())
                    dialect.separator = has(line, ";") ? ';' : has(line, "\t") ? '\t' : has(line, ",") ? ',' : ' ';
                lines.push_back({number, records::fields_of(line, dialect)});
            }
        }
        decimal_comma_ = dialect.separator != ',';
        if (lines.size() < 2) not_a_curve(fmt::format("the file has {} lines beside comments.", lines.size()));
        if (parse_whole_number_text(lines.front().fields.front()))
            wrong(lines.front().number, "the first line holds numbers.",
                  "a heading that says measure, unit and kind: " + example(),
                  fmt::format("put the line  {}  above the points, if that is what they are", example()));
        const Columns columns = columns_of(lines.front());
        const std::string imt = setting(comment, "imt");
        const std::string said = !imt.empty()           ? measure_called(imt, comment_line)
                                 : columns.poes.empty() ? std::string()
                                                        : measure_in_name();
        const double years = years_of(setting(comment, "investigation_time"), comment_line);
        for (std::size_t k = 1; k < lines.size(); ++k) {
            if (lines[k].fields.size() != columns.names.size())
                wrong(lines[k].number,
                      fmt::format("{} fields below {} headings.", lines[k].fields.size(), columns.names.size()),
                      "as many fields as headings", "correct the line, or export the curve again");
            if (columns.poes.empty())
                add_points(columns, lines[k], said, years);
            else
                add_site(columns, lines[k], said, years);
        }
    }

    /// <hazardCurves IMT="PGA" investigationTime="50.0"><IMLs>...</IMLs><hazardCurve>... <gml:pos>10 45</gml:pos> ... <poEs>...</poEs></hazardCurve> ...
    void read_nrml()
    {
        const auto numbers_of = [&](std::string_view block, std::string_view name) {
            std::vector<double> values;
            const std::size_t open = block.find(fmt::format("<{}>", name));
            if (open == std::string_view::npos) return values;
            const std::string_view rest = block.substr(open + name.size() + 2);
            const std::string line = joined(rest.substr(0, rest.find('<')));
            for (const std::string_view field : records::fields_of(line, {}))
                values.push_back(number(field, 0, std::string(name)));
            return values;
        };
        for (std::size_t at = text_.find("<hazardCurves"); at != std::string_view::npos;
             at = text_.find("<hazardCurves", at + 1)) {
            const std::string_view block = text_.substr(at, text_.find("</hazardCurves", at) - at);
            const std::string_view tag = block.substr(0, block.find('>'));
            const std::string imt = setting(tag, "IMT"), period = setting(tag, "saPeriod");
            const std::string measure = measure_called(imt == "SA" ? "SA(" + period + ")" : imt, 0);
            const std::vector<double> x = numbers_of(block, "IMLs");
            for (std::size_t c = block.find("<hazardCurve>"); c != std::string_view::npos;
                 c = block.find("<hazardCurve>", c + 1)) {
                const std::string_view one = block.substr(c, block.find("</hazardCurve>", c) - c);
                const std::vector<double> site = numbers_of(one, "gml:pos");
                RawCurve& curve = curves_.emplace_back();
                curve.measure = measure;
                curve.unit = unit_of_openquake(measure);
                curve.kind = HazardKind::probability;
                curve.years = years_of(setting(tag, "investigationTime"), 0);
                if (site.size() == 2) curve.site = {site[0], site[1]};
                curve.x = x;
                curve.how_often = numbers_of(one, "poEs");
                curve.line.assign(x.size(), 0);
                if (x.size() != curve.how_often.size())
                    wrong(0, fmt::format("{} IMLs and {} poEs.", x.size(), curve.how_often.size()), "as many of both",
                          "export the curve again");
            }
        }
        if (curves_.empty()) not_a_curve("this XML has no hazardCurves with IMLs and poEs.");
    }
    /// Line ends as blanks.
    static std::string joined(std::string_view text)
    {
        std::string line(text);
        std::replace_if(
            line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
        return line;
    }

    /// response: [{metadata: {imt, xvalues, xlabel, ylabel}, data: [{component: "Total", yvalues}]}], or {hazardCurves: [{imt, data: [{component,
    /// values: {xs, ys}}]}]}: ground motions in g, annual frequencies.
    void read_json()
    {
        const Json file = Json::parse(text_, nullptr, false);
        const char* const unknown = "this JSON has no hazard curves as the USGS web services write them.";
        if (file.is_discarded()) not_a_curve("this is no JSON.");
        try {
            const Json& response = file.is_object() ? file.at("response") : file;
            const Json& list = response.is_object() ? response.at("hazardCurves") : response;
            for (const Json& entry : list) {
                const Json& about = entry.contains("metadata") ? entry.at("metadata") : entry;
                const Json& imt = about.at("imt");
                RawCurve curve;
                curve.measure = measure_called((imt.is_object() ? imt.at("value") : imt).get<std::string>(), 0);
                curve.unit = intensity_unit(curve.measure == "PGV" ? "cm/s" : "g");
                if (about.contains("xlabel")) {
                    std::string label = about.at("xlabel").get<std::string>();
                    if (const auto unit = take_intensity_unit(label)) curve.unit = unit;
                }
                if (about.contains("ylabel")) {
                    const HazardHeading h = heading_of(about.at("ylabel").get<std::string>());
                    if (h.role != Role::how_often) not_a_curve(unknown);
                    curve.kind = h.kind;
                    curve.years = h.years;
                }
                for (const Json& part : entry.at("data")) {
                    if (part.value("component", "Total") != "Total") continue;
                    const bool pairs = part.contains("values");
                    curve.x = (pairs ? part.at("values").at("xs") : about.at("xvalues")).get<std::vector<double>>();
                    curve.how_often =
                        (pairs ? part.at("values").at("ys") : part.at("yvalues")).get<std::vector<double>>();
                    break;
                }
                if (curve.x.size() != curve.how_often.size()) not_a_curve(unknown);
                curve.line.assign(curve.x.size(), 0);
                curves_.push_back(std::move(curve));
            }
        } catch (const Json::exception&) {
            not_a_curve(unknown);
        }
        if (curves_.empty()) not_a_curve(unknown);
    }

    /// Whether a curve is of the wanted measure. SA of a period within 5 % of T_1 is SA(T1).
    bool wanted(const std::string& measure) const
    {
        const std::optional<IntensityName> name = parse_intensity(measure);
        if (!name || name->measure != wish_.measure.measure) return false;
        const std::vector<double> periods =
            wish_.measure.first_period ? std::vector{wish_.first_period} : wish_.measure.periods;
        const double tolerance = wish_.measure.first_period ? 0.05 : 1e-6;
        if (name->first_period) return wish_.measure.first_period;
        return std::equal(periods.begin(), periods.end(), name->periods.begin(), name->periods.end(),
                          [&](double a, double b) { return std::abs(a - b) <= tolerance * a; });
    }

    std::vector<RawCurve> chosen_by_measure()
    {
        const std::string of_levels = wish_.measure.first_period
                                          ? fmt::format("SA(T1), T1 = {:.4g} s", wish_.first_period)
                                          : text_of(wish_.measure);
        std::vector<RawCurve> chosen;
        std::vector<std::string> others;
        for (RawCurve& curve : curves_) {
            if (curve.measure.empty()) {
                notes_.push_back(
                    fmt::format("{}: the file does not say of which measure it is; {} is taken.", name(), of_levels));
                curve.measure = text_of(wish_.measure);
            }
            if (wanted(curve.measure))
                chosen.push_back(std::move(curve));
            else if (std::find(others.begin(), others.end(), curve.measure) == others.end())
                others.push_back(curve.measure);
        }
        if (chosen.empty())
            wrong(0,
                  fmt::format("the hazard curve is of {}, the levels are of {}.", fmt::join(others, ", "), of_levels),
                  "one measure for both", "change intensity.measure, or take the curve of that measure");
        if (wish_.measure.first_period && chosen.front().measure != "SA(T1)")
            notes_.push_back(fmt::format("{}: {} is taken for {}.", name(), chosen.front().measure, of_levels));
        return chosen;
    }

    RawCurve chosen_by_site(std::vector<RawCurve> curves)
    {
        constexpr double near = 0.01; // degree
        if (curves.size() == 1 && (!wish_.site || !curves.front().site)) {
            if (wish_.site)
                notes_.push_back(fmt::format("{}: the file names no site; hazard.site is not used.", name()));
            return std::move(curves.front());
        }
        if (!curves.front().site)
            wrong(0, fmt::format("the file has {} curves of {}.", curves.size(), curves.front().measure), "one",
                  "keep one");
        const auto distance = [&](const RawCurve& c) {
            return std::hypot((*c.site)[0] - (*wish_.site)[0], (*c.site)[1] - (*wish_.site)[1]);
        };
        const auto written = [](const RawCurve& c) {
            return fmt::format("site = [{}, {}]", (*c.site)[0], (*c.site)[1]);
        };
        if (!wish_.site)
            wrong(curves[1].line.empty() ? 0 : curves[1].line.front(),
                  fmt::format("the file has {} sites.", curves.size()),
                  "one, or a choice by hazard.site = [longitude, latitude]",
                  fmt::format("write in [hazard]  {}", written(curves.front())));
        const auto best = std::min_element(curves.begin(), curves.end(), [&](const RawCurve& a, const RawCurve& b) {
            return distance(a) < distance(b);
        });
        if (distance(*best) > near)
            wrong(0, fmt::format("no site within {} degree of {:g}, {:g}.", near, (*wish_.site)[0], (*wish_.site)[1]),
                  "longitude and latitude of a site of the file", fmt::format("the nearest is  {}", written(*best)));
        return std::move(*best);
    }

    /// In SI and annual rates, checked point by point.
    HazardFile rated(const RawCurve& raw)
    {
        const bool acceleration = is_acceleration(wish_.measure.measure);
        if (raw.unit && raw.unit->acceleration != acceleration)
            wrong(raw.line.empty() ? 0 : raw.line.front(), fmt::format("{} in {}.", raw.measure, raw.unit->text),
                  acceleration ? "a unit of acceleration: g, %g, m/s2, cm/s2, gal"
                               : "m/s or cm/s of PGV, m/s of IA, m/s or g*s of CAV",
                  "correct the heading");
        if (!raw.unit)
            notes_.push_back(fmt::format("{}: the file names no unit; {} is taken, that of the levels.", name(),
                                         wish_.level_unit_text));
        if (raw.kind == HazardKind::probability && raw.years == 0.0)
            wrong(0, "probabilities of exceedance without the time they are of.",
                  "the investigation time in years: without it a probability is no rate",
                  "add the line  # investigation_time=50  , or write the heading  poe_50_years");
        if (raw.kind == HazardKind::probability)
            notes_.push_back(
                fmt::format("{}: probabilities p within {:g} years are read as annual rates -ln(1 - p)/{:g}.", name(),
                            raw.years, raw.years));
        const double si = raw.unit ? raw.unit->si : wish_.level_unit;
        const std::string unit = raw.unit ? raw.unit->text : wish_.level_unit_text;
        std::vector<double> x, rate;
        std::size_t certain = 0, none = 0;
        double last_x = 0.0, last = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < raw.x.size(); ++k) {
            const double value = raw.how_often[k];
            const auto refuse = [&](const std::string& problem, const std::string& expected, const std::string& fix) {
                wrong(raw.line[k], problem, expected, fix);
            };
            if (!(raw.x[k] > last_x))
                refuse(fmt::format("intensity {:g} follows {:g}.", raw.x[k], last_x), "intensities > 0 that rise",
                       "sort the points by intensity, without repeating one");
            last_x = raw.x[k];
            if (raw.kind == HazardKind::probability && !(value >= 0.0 && value <= 1.0))
                refuse(fmt::format("poe = {:g} at {:g} {}.", value, raw.x[k], unit), "a probability, 0 to 1",
                       "divide per cent by 100");
            if (!(value >= 0.0) || (raw.kind == HazardKind::return_period && value == 0.0))
                refuse(fmt::format("{:g} at {:g} {}.", value, raw.x[k], unit),
                       raw.kind == HazardKind::return_period ? "a return period > 0 [years]" : "an annual rate >= 0",
                       "correct the value");
            const double h = raw.kind == HazardKind::rate          ? value
                             : raw.kind == HazardKind::probability ? -std::log1p(-value) / raw.years
                                                                   : 1.0 / value;
            if (h > last)
                refuse(fmt::format("rate {:g} at intensity {:g} is more than {:g} before it.", h, raw.x[k], last),
                       "rates of exceedance, which never rise with the intensity",
                       "is the file of densities? Write annual rates of exceedance");
            last = h;
            certain += std::isinf(h);
            none += h == 0.0;
            if (h == 0.0 || std::isinf(h)) continue;
            x.push_back(raw.x[k] * si);
            rate.push_back(h);
        }
        if (certain)
            notes_.push_back(
                fmt::format("{}: points with poe = 1: {}, passed over, as no rate of them is known.", name(), certain));
        if (none) notes_.push_back(fmt::format("{}: points without any earthquake: {}, left out.", name(), none));
        if (x.size() < 2)
            wrong(0, fmt::format("the curve has {} points with a rate.", x.size()), "two points at least",
                  "export the whole curve");
        return {probability::HazardCurve(std::move(x), std::move(rate)), std::move(notes_)};
    }

    std::string name() const { return std::filesystem::path(file_).filename().string(); }

    std::string_view text_;
    const std::string& file_;
    const HazardWish& wish_;
    bool decimal_comma_ = false;
    std::vector<RawCurve> curves_;
    std::vector<std::string> notes_;
};

} // namespace

double openquake_unit(const IntensityName& measure)
{
    return intensity_unit(openquake_word(measure.measure))->si;
}

HazardFile parse_hazard_file(std::string_view text, const std::string& file_name, const HazardWish& wish)
{
    return HazardReader(text, file_name, wish).read();
}

HazardFile read_hazard_file(const std::filesystem::path& file, const HazardWish& wish)
{
    const std::string text = read_file(file);
    const std::string name = file.string();
    return parse_hazard_file(text, name, wish);
}

} // namespace damslip
