#include "pages/report/chart.hpp"

#include "pages/report/json.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>

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

const char* word(Scale scale)
{
    switch (scale) {
    case Scale::linear:
        return "linear";
    case Scale::log:
        return "log";
    case Scale::asinh:
        return "asinh";
    }
    return "";
}

const char* word(Mark mark)
{
    switch (mark) {
    case Mark::line:
        return "line";
    case Mark::dashed:
        return "dashed";
    case Mark::points:
        return "points";
    case Mark::line_and_points:
        return "line_and_points";
    }
    return "";
}

const char* word(Weight weight)
{
    switch (weight) {
    case Weight::normal:
        return "normal";
    case Weight::strong:
        return "strong";
    case Weight::faint:
        return "faint";
    }
    return "";
}

std::string axis_json(const Axis& axis)
{
    std::string out = "{\"label\":" + json_text(axis.label) + ",\"unit\":" + json_text(axis.unit) + ",\"scale\":\"" +
                      word(axis.scale) + "\",\"linear_below\":" + json_number(axis.linear_below) +
                      ",\"low\":" + json_number(axis.low) + ",\"high\":" + json_number(axis.high) + ",\"categories\":[";
    for (std::size_t i = 0; i < axis.categories.size(); ++i) out += (i ? "," : "") + json_text(axis.categories[i]);
    return out + "]}";
}

std::string lines_json(const std::vector<Line>& lines)
{
    std::string out = "[";
    for (const Line& line : lines)
        if (std::isfinite(line.at))
            out += (out.size() > 1 ? ",{\"at\":" : "{\"at\":") + json_number(line.at) +
                   ",\"label\":" + json_text(line.label) + "}";
    return out + "]";
}

/// The curve that a slider moves, null where there is none.
std::string moving_json(const std::optional<Moving>& moving, const ChartData& data)
{
    if (!moving || moving->at.empty()) return "null";
    assert(moving->y.size() == moving->at.size());
    std::string out = "{\"curve\":" + std::to_string(moving->curve) + ",\"label\":" + json_text(moving->label) +
                      ",\"unit\":" + json_text(moving->unit) + ",\"start\":" + std::to_string(moving->start) +
                      ",\"at\":" + json_numbers(moving->at) + ",\"y\":[";
    for (std::size_t k = 0; k < moving->y.size(); ++k) {
        assert(moving->y[k].size() == data.x.size());
        out += (k ? "," : "") + json_numbers(moving->y[k], 4);
    }
    (void)data;
    return out + "]}";
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
    const auto longest = std::max_element(chart.curves.begin(), chart.curves.end(),
                                          [](const Curve& a, const Curve& b) { return a.x.size() < b.x.size(); });
    if (longest == chart.curves.end()) return data;
    data.joined = !std::all_of(chart.curves.begin(), chart.curves.end(),
                               [&](const Curve& c) { return is_beginning(c.x, longest->x); });
    data.x = data.joined ? united(chart.curves) : longest->x;
    data.samples = data.x.size();
    for (const Curve& c : chart.curves) {
        assert(c.x.size() == c.y.size() && std::is_sorted(c.x.begin(), c.x.end()));
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
    std::sort(kept.begin(), kept.end());
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
                      ",\"vertical\":" + lines_json(chart.vertical) + ",\"curves\":[";
    std::size_t column = 0;
    int next_colour = 0;
    for (std::size_t i = 0; i < chart.curves.size(); ++i) {
        const Curve& c = chart.curves[i];
        const int colour = c.colour >= 0 ? c.colour : next_colour++;
        out += std::string(i ? "," : "") + "{\"name\":" + json_text(c.name) + ",\"mark\":\"" + word(c.mark) +
               "\",\"weight\":\"" + word(c.weight) + "\",\"colour\":" + std::to_string(colour) +
               ",\"y\":" + json_numbers(drawable(data.columns[column++], chart.y.scale));
        if (!c.low.empty()) {
            out += ",\"low\":" + json_numbers(drawable(data.columns[column++], chart.y.scale));
            out += ",\"high\":" + json_numbers(drawable(data.columns[column++], chart.y.scale));
        }
        out += "}";
    }
    return out + "],\"moving\":" + moving_json(chart.moving, data) + "}";
}

} // namespace damslip::pages
