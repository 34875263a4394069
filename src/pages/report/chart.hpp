#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

/// A chart as data: curves with names and units, drawn by the page's script (page.js).
namespace damslip::pages {

enum class Scale {
    linear,
    log,  ///< values of zero and below are left out
    asinh ///< linear below Axis::linear_below, logarithmic above: for quantities that may be zero, as a slip
};

struct Axis {
    std::string label = {};                    ///< "slip"
    std::string unit = {};                     ///< "mm"; empty or "–": none
    Scale scale = Scale::linear;               ///< of values; categories are evenly spaced
    double linear_below = 0.1;                 ///< asinh only, in the axis' unit, > 0
    std::optional<double> low = {}, high = {}; ///< fixed ends; default: the values'
    std::vector<std::string> categories = {};  ///< x axis only: names of 0, 1, 2 ...; empty: numbers
};

enum class Mark { line, dashed, points, line_and_points };
enum class Weight {
    normal,
    strong, ///< the curve to look at
    faint   ///< one of many
};

struct Curve {
    std::string name;
    std::vector<double> x = {}, y = {};      ///< of equal length, x ascending; NaN: no value there
    std::vector<double> low = {}, high = {}; ///< band (lines) or bars (points) around y; both empty or as long as y
    Mark mark = Mark::line;
    Weight weight = Weight::normal;
    int colour = -1; ///< 0 ... 7 of the page's palette; -1: the next one

    void add(double at, double value)
    {
        x.push_back(at);
        y.push_back(value);
    }
    void add(double at, double value, double least, double largest)
    {
        add(at, value);
        low.push_back(least);
        high.push_back(largest);
    }
};

/// A straight line across the chart with a label: an allowable slip, the scene's friction.
struct Line {
    double at = 0.0;
    std::string label;
};

/// One curve of a chart at many instants; a slider chooses which is drawn.
struct Moving {
    std::size_t curve = 0;   ///< of Chart::curves; its own values are those of at[start]
    std::string label, unit; ///< of `at`: "time", "s"
    std::vector<double> at = {}; ///< ascending
    /// Values of the curve, one list for each `at`, over the curve's own x, which all curves of the chart share.
    std::vector<std::vector<double>> y = {};
    std::size_t start = 0; ///< drawn first
};

struct Chart {
    std::string title = {};
    Axis x = {}, y = {};
    std::vector<Curve> curves = {};
    std::vector<Line> horizontal = {}, vertical = {};
    std::optional<Moving> moving = {}; ///< fix the ends of y with it, so that the instants compare
    std::string together = {};         ///< charts with the same word share cursor, zoom in x and slider; empty: alone
    std::string note = {};             ///< sentence below the chart
    int height = 330;                  ///< of the drawing, legend excluded [px], >= 240
    /// Above `thin_above` abscissae only the lowest and highest value of each curve in each of `thin_buckets` equal
    /// parts are kept: what a screen can show. The chart then says so.
    std::size_t thin_above = 20000;
    std::size_t thin_buckets = 2000; ///< > 0
};

/// A chart without curves over time.
inline Chart time_chart(std::string title, Axis y, int height = Chart{}.height)
{
    return {.title = std::move(title), .x = {"time", "s"}, .y = std::move(y), .height = height};
}

/// One column of values over the common abscissae; NaN where the curve has none.
using Values = std::vector<double>;

/// Curves of one chart over common abscissae.
struct ChartData {
    std::vector<double> x;
    std::vector<Values> columns; ///< y, then low and high where the curve has them, curve after curve
    std::size_t samples = 0;     ///< abscissae before thinning
    bool joined = false;         ///< abscissae of the curves differ, so a NaN may mean "not sampled here"
};

/// All curves over the union of their abscissae. @pre x of each curve is ascending
ChartData common_abscissae(const Chart& chart);

/// The lowest and highest value of each column in each of `buckets` equal parts of the samples, first and last sample;
/// as it is up to `above` samples.
ChartData thinned(ChartData data, std::size_t above, std::size_t buckets);

/// What page.js draws, as one JSON object: numbers with 6 significant digits, NaN and infinity as null, "<" as \u003c.
std::string chart_json(const Chart& chart, const ChartData& data);

} // namespace damslip::pages
