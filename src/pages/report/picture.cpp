#include "pages/report/picture.hpp"

#include "core/word_in.hpp"
#include "pages/report/json.hpp"
#include "pages/report/page.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <ranges>
#include <stdexcept>
#include <string_view>

namespace damslip::pages {

namespace {

/// "ssssod" as "4sod": a count before each letter that is repeated.
std::string run_lengths(const std::string& letters)
{
    std::string out;
    for (std::size_t i = 0; i < letters.size();) {
        std::size_t end = i;
        while (end < letters.size() && letters[end] == letters[i]) ++end;
        if (end - i > 1) out += std::to_string(end - i);
        out += letters[i];
        i = end;
    }
    return out;
}

/// Values as whole multiples of the largest over 30 000, which takes half the space of decimals.
std::string whole_numbers_json(const std::vector<double>& values)
{
    constexpr double parts = 30000.0;
    double largest = 0.0;
    for (const double v : values)
        if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
    const double unit = largest > 0.0 ? largest / parts : 1.0;
    const auto whole = [=](double v) { return std::isfinite(v) ? std::to_string(std::lround(v / unit)) : "null"; };
    return "{\"unit\":" + json_number(unit, 9) + ",\"n\":" + json_list(values, whole) + "}";
}

std::string elements_json(const std::vector<std::array<int, 4>>& elements)
{
    return json_list(elements | std::views::join, [](int node) { return std::to_string(node); });
}

std::string nodes_json(const std::vector<Point>& nodes, double Point::*coordinate)
{
    std::vector<double> values;
    values.reserve(nodes.size());
    for (const Point& p : nodes) values.push_back(p.*coordinate);
    return json_numbers(values);
}

std::string state_json(const MeshView::State& state)
{
    return "{\"name\":" + json_text(state.name) + ",\"time\":" + json_number(state.time) +
           ",\"shift\":" + json_numbers({state.shift_x, state.shift_y}) + ",\"ux\":" + whole_numbers_json(state.ux) +
           ",\"uy\":" + whole_numbers_json(state.uy) + ",\"values\":" + json_list(state.values, whole_numbers_json) +
           "}";
}

} // namespace

std::string state_map_json(const StateMap& map)
{
    assert(map.states.size() == map.time.size());
    const auto kind_json = [](const StateMap::Kind& kind) {
        return "{\"letter\":" + json_text(std::string(1, kind.letter)) + ",\"name\":" + json_text(kind.name) +
               ",\"colour\":" + std::to_string(kind.colour) + "}";
    };
    const auto states_json = [&](const std::string& states) {
        assert(states.size() == map.distance.size());
        return json_text(run_lengths(states));
    };
    return "{\"title\":" + json_text(map.title) + ",\"place\":" + json_text(map.place) +
           ",\"time\":" + json_numbers(map.time) + ",\"distance\":" + json_numbers(map.distance) +
           ",\"kinds\":" + json_list(map.kinds, kind_json) + ",\"states\":" + json_list(map.states, states_json) + "}";
}

std::string mesh_view_json(const MeshView& view)
{
    const auto field_json = [](const MeshView::Field& field) {
        return "{\"name\":" + json_text(field.name) + ",\"unit\":" + json_text(field.unit) +
               (field.least ? ",\"least\":true}" : "}");
    };
    return "{\"title\":" + json_text(view.title) + ",\"x\":" + nodes_json(view.nodes, &Point::x) +
           ",\"y\":" + nodes_json(view.nodes, &Point::y) + ",\"elements\":" + elements_json(view.elements) +
           ",\"front\":" + std::to_string(view.front_nodes) + ",\"fields\":" + json_list(view.fields, field_json) +
           ",\"states\":" + json_list(view.states, state_json) + "}";
}

Sketch::Sketch(Point low, Point high, double width) : low_(low), high_(high), scale_(width / (high.x - low.x))
{
    assert(high.x > low.x && high.y > low.y && width > 0);
}

void Sketch::polygon(const Polyline& points, const std::string& css)
{
    add_points("polygon", points, css);
}

void Sketch::line(const Polyline& points, const std::string& css)
{
    add_points("polyline", points, css);
}

void Sketch::add_points(const std::string& element, const Polyline& points, const std::string& css)
{
    body_ += "<" + element + " class=\"" + css + "\" points=\"";
    for (const Point& p : points) body_ += fmt::format("{:.1f},{:.1f} ", pixel(p).x, pixel(p).y);
    body_ += "\"/>\n";
}

void Sketch::lines(const std::vector<Polyline>& all, const std::string& css)
{
    body_ += "<path class=\"" + css + "\" d=\"";
    for (const Polyline& points : all)
        for (std::size_t i = 0; i < points.size(); ++i)
            body_ += fmt::format("{}{:.1f} {:.1f}", i ? "L" : "M", pixel(points[i]).x, pixel(points[i]).y);
    body_ += "\"/>\n";
}

void Sketch::circle(Point centre, double radius_px, const std::string& css)
{
    body_ += fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\"/>\n", css, pixel(centre).x,
                         pixel(centre).y, radius_px);
}

void Sketch::text_at(Pixel at, const std::string& words, Align align, const std::string& css)
{
    body_ += fmt::format("<text class=\"{}\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", css, at.x, at.y,
                         word_in(align, {{Align::start, "start"}, {Align::middle, "middle"}, {Align::end, "end"}}),
                         html_text(words));
}

void Sketch::text(Point at, const std::string& words, Align align, double right, double down, const std::string& css)
{
    text_at({pixel(at).x + right, pixel(at).y + down}, words, align, css);
}

void Sketch::arrow_head(Pixel from, Pixel to, double size, const std::string& css)
{
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    if (!(length > 0)) return;
    const double ux = (to.x - from.x) / length, uy = (to.y - from.y) / length;
    const double bx = to.x - size * ux, by = to.y - size * uy, w = 0.38 * size;
    body_ += fmt::format("<polygon class=\"{}\" points=\"{:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f}\"/>\n", css, to.x,
                         to.y, bx - w * uy, by + w * ux, bx + w * uy, by - w * ux);
}

void Sketch::arrow(Point from, Point to, const std::string& css, double head_px)
{
    line({from, to}, css);
    arrow_head(pixel(from), pixel(to), head_px, css);
}

void Sketch::dimension(Point a, Point b, double offset_px, const std::string& words)
{
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    if (!(length > 0)) return;
    const Point left{-(b.y - a.y) / length, (b.x - a.x) / length};
    const auto moved = [&](Point p, double px) { return Point{p.x + left.x * metres(px), p.y + left.y * metres(px)}; };
    const double past = offset_px > 0 ? 5.0 : -5.0;
    const Point from = moved(a, offset_px), to = moved(b, offset_px);
    line({moved(a, past), moved(a, offset_px + past)}, "dimension");
    line({moved(b, past), moved(b, offset_px + past)}, "dimension");
    line({from, to}, "dimension");
    arrow_head(pixel(from), pixel(to), 7.0, "dimension");
    arrow_head(pixel(to), pixel(from), 7.0, "dimension");
    const Point middle{(from.x + to.x) / 2, (from.y + to.y) / 2};
    if (std::abs(b.x - a.x) > std::abs(b.y - a.y)) // level
        text(middle, words, Align::middle, 0, -4);
    else
        text(middle, words, Align::start, 6, 4);
}

void Sketch::level_mark(Point at, const std::string& words, Align align)
{
    const Pixel p = pixel(at);
    body_ += fmt::format("<polygon class=\"level\" points=\"{:.1f},{:.1f} {:.1f},{:.1f} {:.1f},{:.1f}\"/>\n", p.x, p.y,
                         p.x - 6, p.y - 10, p.x + 6, p.y - 10);
    const double right = align == Align::start ? 11 : align == Align::end ? -11 : 0;
    text_at({p.x + right, p.y - 4}, words, align, "halo");
}

std::string Sketch::svg(const std::string& description) const
{
    const double width = (high_.x - low_.x) * scale_, height = (high_.y - low_.y) * scale_;
    return fmt::format("<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">\n", width, height,
                       html_text(description)) +
           body_ + "</svg>\n";
}

namespace {

/// The part of the page's style between two marks, the first included.
std::string part_of(std::string_view style, std::string_view from, std::string_view to)
{
    const std::size_t first = style.find(from);
    const std::size_t last = first == style.npos ? first : style.find(to, first);
    if (last == style.npos) throw std::logic_error("the page's style has no part " + std::string(from));
    return std::string(style.substr(first, last - first));
}

void replace_all(std::string& text, const std::string& what, const std::string& by)
{
    for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; at += by.size())
        text.replace(at, what.size(), by);
}

} // namespace

std::string standalone_svg(const std::string& svg)
{
    const std::string_view style = assets().page_style;
    std::string colours = part_of(style, ":root {", "}") + "}\n";
    std::string shapes = part_of(style, "/* drawings */", "@media");
    replace_all(colours, ":root", "svg");
    replace_all(shapes, ".drawing text", "text");
    std::string out = svg;
    if (out.find("xmlns=") == out.npos) out.insert(out.find("<svg") + 4, " xmlns=\"http://www.w3.org/2000/svg\"");
    out.insert(out.find('>') + 1,
               "<style>\n" + colours + "svg { background: var(--paper); }\n" + shapes + "</style>\n");
    return out + "\n";
}

} // namespace damslip::pages
