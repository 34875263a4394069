#include "pages/report/chart.hpp"

#include "core/text.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
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

namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Short sorted list inside a longer one's beginning: histories of one record with run-outs of different length.
bool is_beginning(const std::vector<double>& x, const std::vector<double>& whole)
{
    return x.size() <= whole.size() && std::equal(x.begin(), x.end(), whole.begin());
}

std::vector<double> united(const std::vector<Curve>& curves)
{
    std::vector<double> all;
    for (const Curve& c : curves) {
        std::vector<double> merged;
        merged.reserve(all.size() + c.x.size());
        std::set_union(all.begin(), all.end(), c.x.begin(), c.x.end(), std::back_inserter(merged));
        all = std::move(merged);
    }
    return all;
}

/// Values at `x`, of which `own` is a subset.
Values placed(const std::vector<double>& x, const std::vector<double>& own, const Values& values)
{
    if (own.size() == x.size()) return values;
    Values out(x.size(), nothing);
    std::size_t k = 0;
    for (std::size_t i = 0; i < x.size() && k < own.size(); ++i)
        if (x[i] == own[k]) out[i] = values[k++];
    return out;
}

void keep_extremes(const Values& y, std::size_t from, std::size_t to, std::vector<std::size_t>& kept)
{
    std::size_t low = to, high = to;
    for (std::size_t i = from; i < to; ++i) {
        if (!std::isfinite(y[i])) continue;
        if (low == to || y[i] < y[low]) low = i;
        if (high == to || y[i] > y[high]) high = i;
    }
    if (low == to) return;
    kept.push_back(low);
    kept.push_back(high);
}

/// Step of evenly spaced values, nothing for others.
std::optional<double> even_step(const std::vector<double>& x)
{
    if (x.size() < 3) return std::nullopt;
    const double step = (x.back() - x.front()) / static_cast<double>(x.size() - 1);
    for (std::size_t i = 0; i < x.size(); ++i)
        if (std::abs(x[i] - (x.front() + static_cast<double>(i) * step)) > 1e-6 * step) return std::nullopt;
    return step;
}

const char* word(Mark mark)
{
    return word_in(mark, {{Mark::line, "line"},
                          {Mark::dashed, "dashed"},
                          {Mark::points, "points"},
                          {Mark::line_and_points, "line_and_points"}});
}

const char* word(Weight weight)
{
    return word_in(weight, {{Weight::normal, "normal"}, {Weight::strong, "strong"}, {Weight::faint, "faint"}});
}

std::string axis_json(const Axis& axis)
{
    const char* const scale =
        word_in(axis.scale, {{Scale::linear, "linear"}, {Scale::log, "log"}, {Scale::asinh, "asinh"}});
    return "{\"label\":" + json_text(axis.label) + ",\"unit\":" + json_text(axis.unit) + ",\"scale\":\"" + scale +
           "\",\"linear_below\":" + json_number(axis.linear_below) + ",\"low\":" + json_number(axis.low) +
           ",\"high\":" + json_number(axis.high) + ",\"categories\":" + json_list(axis.categories, json_text) + "}";
}

std::string lines_json(const std::vector<Line>& lines)
{
    return json_list(lines | std::views::filter([](const Line& line) { return std::isfinite(line.at); }),
                     [](const Line& line) {
                         return "{\"at\":" + json_number(line.at) + ",\"label\":" + json_text(line.label) + "}";
                     });
}

/// The curve that a slider moves, null where there is none.
std::string moving_json(const std::optional<Moving>& moving, [[maybe_unused]] std::size_t samples)
{
    if (!moving || moving->at.empty()) return "null";
    assert(moving->y.size() == moving->at.size());
    return "{\"curve\":" + std::to_string(moving->curve) + ",\"label\":" + json_text(moving->label) +
           ",\"unit\":" + json_text(moving->unit) + ",\"start\":" + std::to_string(moving->start) +
           ",\"at\":" + json_numbers(moving->at) + ",\"y\":" +
           json_list(moving->y,
                     [&](const Values& y) {
                         assert(y.size() == samples);
                         return json_numbers(y, 4);
                     }) +
           "}";
}

std::string abscissae_json(const std::vector<double>& x)
{
    if (const auto step = even_step(x)) {
        std::string out = "{\"from\":";
        add_json_number(out, x.front(), 12);
        out += ",\"step\":";
        add_json_number(out, *step, 12);
        return out + ",\"n\":" + std::to_string(x.size()) + "}";
    }
    return json_numbers(x);
}

/// The column as drawn: a log axis has no place for zero and below.
Values drawable(Values values, Scale scale)
{
    if (scale == Scale::log)
        for (double& v : values)
            if (!(v > 0)) v = nothing;
    return values;
}

} // namespace

ChartData common_abscissae(const Chart& chart)
{
    ChartData data;
    const auto longest = std::ranges::max_element(chart.curves, {}, [](const Curve& c) { return c.x.size(); });
    if (longest == chart.curves.end()) return data;
    data.joined = !std::ranges::all_of(chart.curves, [&](const Curve& c) { return is_beginning(c.x, longest->x); });
    data.x = data.joined ? united(chart.curves) : longest->x;
    data.samples = data.x.size();
    for (const Curve& c : chart.curves) {
        assert(c.x.size() == c.y.size() && std::ranges::is_sorted(c.x));
        assert(c.low.size() == c.high.size() && (c.low.empty() || c.low.size() == c.y.size()));
        data.columns.push_back(placed(data.x, c.x, c.y));
        if (c.low.empty()) continue;
        data.columns.push_back(placed(data.x, c.x, c.low));
        data.columns.push_back(placed(data.x, c.x, c.high));
    }
    return data;
}

ChartData thinned(ChartData data, std::size_t above, std::size_t buckets)
{
    const std::size_t n = data.x.size();
    if (n <= above || buckets == 0) return data;
    std::vector<std::size_t> kept{0, n - 1};
    for (std::size_t b = 0; b < buckets; ++b)
        for (const Values& y : data.columns) keep_extremes(y, b * n / buckets, (b + 1) * n / buckets, kept);
    std::ranges::sort(kept);
    kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
    const auto pick = [&kept](const std::vector<double>& values) {
        std::vector<double> out;
        out.reserve(kept.size());
        for (const std::size_t i : kept) out.push_back(values[i]);
        return out;
    };
    data.x = pick(data.x);
    for (Values& y : data.columns) y = pick(y);
    return data;
}

std::string chart_json(const Chart& chart, const ChartData& data)
{
    std::string out = "{\"title\":" + json_text(chart.title) + ",\"xaxis\":" + axis_json(chart.x) +
                      ",\"yaxis\":" + axis_json(chart.y) + ",\"together\":" + json_text(chart.together) +
                      ",\"height\":" + std::to_string(chart.height) +
                      ",\"joined\":" + (data.joined ? "true" : "false") +
                      ",\"samples\":" + std::to_string(data.samples) + ",\"x\":" + abscissae_json(data.x) +
                      ",\"horizontal\":" + lines_json(chart.horizontal) +
                      ",\"vertical\":" + lines_json(chart.vertical) + ",\"curves\":";
    auto column = data.columns.begin();
    int next_colour = 0;
    const auto next_values = [&] { return json_numbers(drawable(*column++, chart.y.scale)); };
    out += json_list(chart.curves, [&](const Curve& c) {
        const int colour = c.colour >= 0 ? c.colour : next_colour++;
        std::string curve = "{\"name\":" + json_text(c.name) + ",\"mark\":\"" + word(c.mark) + "\",\"weight\":\"" +
                            word(c.weight) + "\",\"colour\":" + std::to_string(colour) + ",\"y\":" + next_values();
        if (!c.low.empty()) {
            curve += ",\"low\":" + next_values();
            curve += ",\"high\":" + next_values();
        }
        return curve + "}";
    });
    return out + ",\"moving\":" + moving_json(chart.moving, data.x.size()) + "}";
}

} // namespace damslip::pages
