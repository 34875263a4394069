#pragma once

#include "core/geometry.hpp"

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// Pictures that the page's scripts draw on a canvas (state_map.js, mesh_view.js).
namespace damslip::pages {

/// States along a line over time, one coloured cell each: where a base sticks, slips and opens.
struct StateMap {
    struct Kind {
        char letter = ' ';
        std::string name;
        int colour = -1; ///< 0 ... 7 of the page's palette; -1: as the paper's panel
    };
    std::string title;
    std::vector<double> time;        ///< ascending [s]
    std::vector<double> distance;    ///< of the places, ascending [m]
    std::string place;               ///< "from the heel"
    std::vector<std::string> states; ///< for each time a letter for each place
    std::vector<Kind> kinds;
    std::string note;
};

/// A mesh in several states: deformed, with contours of fields on its nodes. A slider goes through the states, from the one
/// after the first whose first field is largest; beside it stands the envelope of all after the first.
struct MeshView {
    struct Field {
        std::string name, unit;
        bool least = false; ///< its smallest value is the one that matters: the envelope keeps it
    };
    struct State {
        std::string name;
        double time = 0.0;                       ///< [s]
        std::vector<double> ux, uy;              ///< of the nodes, as magnified [m]
        double shift_x = 0.0, shift_y = 0.0;     ///< of the first `front_nodes` nodes, drawn to scale [m]
        std::vector<std::vector<double>> values; ///< of each field, of the nodes
    };
    std::string title;
    std::vector<Point> nodes;                 ///< [m]
    std::vector<std::array<int, 4>> elements; ///< counter-clockwise; the fourth is -1 in a triangle
    std::size_t front_nodes = 0;              ///< the body that is looked at: colours and first view are fitted to it
    std::vector<Field> fields;
    std::vector<State> states;
    std::string note;
};

/// What the scripts read, as one JSON object.
std::string state_map_json(const StateMap& map);
std::string mesh_view_json(const MeshView& view);

enum class Align { start, middle, end };

/// A drawing to scale: metres in, an <svg> element out. Colours come from the page's style (page.css, "drawings") by
/// class names, so it follows light and dark. Pixels are those of the drawing's own `width`.
class Sketch {
public:
    /// The part of the plane that is shown, lower left to upper right corner [m]. @param width  [px]
    Sketch(Point low, Point high, double width);

    double pixels_per_metre() const { return scale_; }
    double metres(double pixels) const { return pixels / scale_; } ///< length of so many pixels [m]

    void polygon(const Polyline& points, const std::string& css);
    void line(const Polyline& points, const std::string& css);
    void lines(const std::vector<Polyline>& all, const std::string& css); ///< many as one path: a mesh
    void circle(Point centre, double radius_px, const std::string& css);
    /// Text near a point, moved by (right, down) pixels. @param css  may be empty
    void text(Point at, const std::string& words, Align align = Align::start, double right = 0.0, double down = 0.0,
              const std::string& css = "halo");
    /// Straight arrow with its head at `to`.
    void arrow(Point from, Point to, const std::string& css, double head_px = 8.0);
    /// Dimension line between two points with a head at both ends, moved sideways (to the left of the direction from
    /// `a` to `b`) by `offset_px`, with extension lines and its text in the middle.
    void dimension(Point a, Point b, double offset_px, const std::string& words);
    /// Several marks as one: what is drawn until end_group() has this class, too.
    void begin_group(const std::string& css) { body_ += "<g class=\"" + css + "\">\n"; }
    void end_group() { body_ += "</g>\n"; }
    /// The triangle that marks a water level, its tip on the point.
    void level_mark(Point at, const std::string& words, Align align);

    /// @param description  what a reader who does not see it is told
    std::string svg(const std::string& description) const;

private:
    struct Pixel {
        double x, y;
    };
    Pixel pixel(Point p) const { return {(p.x - low_.x) * scale_, (high_.y - p.y) * scale_}; }
    void add_points(const std::string& element, const Polyline& points, const std::string& css);
    void text_at(Pixel at, const std::string& words, Align align, const std::string& css);
    void arrow_head(Pixel from, Pixel to, double size, const std::string& css);

    Point low_, high_;
    double scale_;
    std::string body_;
};

/// A drawing of the report as a file of its own: the page's colours of drawings go with it, on white paper.
/// @param svg  an <svg> element as Sketch::svg gives it
std::string standalone_svg(const std::string& svg);

/// A chart as data: curves with names and units, drawn by the page's script (page.js).
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
