#include "pages/report/picture.hpp"

#include "pages/report/escape.hpp"
#include "pages/report/number_json.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

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
    std::string out = "{\"unit\":" + json_number(unit, 9) + ",\"n\":[";
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i) out += ',';
        out += std::isfinite(values[i]) ? std::to_string(std::lround(values[i] / unit)) : "null";
    }
    return out + "]}";
}

std::string elements_json(const std::vector<std::array<int, 4>>& elements)
{
    std::string out = "[";
    for (const auto& nodes : elements)
        for (const int node : nodes) out += (out.size() > 1 ? "," : "") + std::to_string(node);
    return out + "]";
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
    std::string out = "{\"name\":" + json_text(state.name) + ",\"time\":" + json_number(state.time) +
                      ",\"shift\":" + json_numbers({state.shift_x, state.shift_y}) +
                      ",\"ux\":" + whole_numbers_json(state.ux) + ",\"uy\":" + whole_numbers_json(state.uy) +
                      ",\"values\":[";
    for (std::size_t i = 0; i < state.values.size(); ++i) out += (i ? "," : "") + whole_numbers_json(state.values[i]);
    return out + "]}";
}

} // namespace

std::string state_map_json(const StateMap& map)
{
    assert(map.states.size() == map.time.size());
    std::string out = "{\"title\":" + json_text(map.title) + ",\"place\":" + json_text(map.place) +
                      ",\"time\":" + json_numbers(map.time) + ",\"distance\":" + json_numbers(map.distance) +
                      ",\"kinds\":[";
    for (std::size_t i = 0; i < map.kinds.size(); ++i)
        out += std::string(i ? "," : "") + "{\"letter\":" + json_text(std::string(1, map.kinds[i].letter)) +
               ",\"name\":" + json_text(map.kinds[i].name) + ",\"colour\":" + std::to_string(map.kinds[i].colour) + "}";
    out += "],\"states\":[";
    for (std::size_t i = 0; i < map.states.size(); ++i) {
        assert(map.states[i].size() == map.distance.size());
        out += (i ? "," : "") + json_text(run_lengths(map.states[i]));
    }
    return out + "]}";
}

std::string mesh_view_json(const MeshView& view)
{
    std::string out = "{\"title\":" + json_text(view.title) + ",\"x\":" + nodes_json(view.nodes, &Point::x) +
                      ",\"y\":" + nodes_json(view.nodes, &Point::y) + ",\"elements\":" + elements_json(view.elements) +
                      ",\"front\":" + std::to_string(view.front_nodes) + ",\"fields\":[";
    for (std::size_t i = 0; i < view.fields.size(); ++i)
        out += std::string(i ? "," : "") + "{\"name\":" + json_text(view.fields[i].name) +
               ",\"unit\":" + json_text(view.fields[i].unit) + (view.fields[i].least ? ",\"least\":true}" : "}");
    out += "],\"states\":[";
    for (std::size_t i = 0; i < view.states.size(); ++i) out += (i ? "," : "") + state_json(view.states[i]);
    return out + "]}";
}

} // namespace damslip::pages
