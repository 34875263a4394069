#pragma once

#include "core/geometry.hpp"

#include <array>
#include <string>
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

} // namespace damslip::pages
