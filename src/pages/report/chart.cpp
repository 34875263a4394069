#include "pages/report/chart.hpp"

#include "core/word_in.hpp"
#include "pages/report/json.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
#include <ranges>

namespace damslip::pages {

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
