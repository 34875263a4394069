#include "pages/report/tornado.hpp"

#include "pages/report/picture.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::pages {

namespace {

// Pixels of the drawing; y is up.
constexpr double width = 720.0, names = 200.0, figures = 130.0, row = 26.0, bar = 15.0, axis_height = 44.0;

/// 1, 2 or 5 times a power of ten, at most the value.
double round_step(double value)
{
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double digit : {5.0, 2.0})
        if (digit * power <= value) return digit * power;
    return power;
}

struct Frame {
    double low = 0.0, high = 0.0; ///< of the values
    /// Both sides that have bars have room for their figures.
    double x(double value) const
    {
        const double left = names + (low < 0 ? figures : 0.0);
        return left + (value - low) / (high - low) * (width - figures - left);
    }
};

Frame frame_of(const std::vector<Bar>& bars)
{
    Frame f;
    double largest = 0.0;
    for (const Bar& b : bars) {
        if (!b.value) continue;
        largest = std::max(largest, std::abs(*b.value));
        f.low = std::min(f.low, *b.value);
        f.high = std::max(f.high, *b.value);
    }
    for (const Bar& b : bars) { // whiskers longer than half the longest bar are cut at the frame
        if (!b.value) continue;
        f.low = std::min(f.low, *b.value - std::min(b.error, 0.5 * largest));
        f.high = std::max(f.high, *b.value + std::min(b.error, 0.5 * largest));
    }
    if (f.high == f.low) f.high = 1.0;
    return f;
}

void draw_axis(Sketch& sketch, const Frame& f, double top, const std::string& axis)
{
    const double step = round_step((f.high - f.low) / 3.0);
    for (double k = std::ceil(f.low / step); k * step <= f.high * (1 + 1e-12); ++k) {
        const double x = f.x(k * step);
        sketch.line({{x, axis_height}, {x, top}}, k == 0.0 ? "axis" : "grid-line");
        sketch.text({x, axis_height}, fmt::format("{:.6g}", k == 0.0 ? 0.0 : k * step), Align::middle, 0, 15, "small");
    }
    sketch.text({f.x(0.5 * (f.low + f.high)), axis_height}, axis, Align::middle, 0, 33, "small");
}

void draw_bar(Sketch& sketch, const Frame& f, const Bar& b, double middle)
{
    sketch.text({names, middle}, b.name, Align::end, -12, 4.5, "");
    if (!b.value) {
        sketch.text({f.x(0.0), middle}, b.words, Align::start, 8, 4.5, "small");
        return;
    }
    const double from = f.x(0.0), to = f.x(*b.value), low = middle - bar / 2, high = middle + bar / 2;
    const std::string css = std::string(*b.value > 0 ? "more" : "less") + (b.doubtful ? " doubtful" : "");
    if (from != to) sketch.polygon({{from, low}, {to, low}, {to, high}, {from, high}}, css);
    double end = to;
    if (b.error > 0) {
        const double a = f.x(std::max(f.low, *b.value - b.error)), z = f.x(std::min(f.high, *b.value + b.error));
        sketch.line({{a, middle}, {z, middle}}, "whisker");
        for (const double x : {a, z}) sketch.line({{x, middle - 4}, {x, middle + 4}}, "whisker");
        end = *b.value < 0 ? std::min(a, to) : std::max(z, to);
    }
    sketch.text({end, middle}, b.words, *b.value < 0 ? Align::end : Align::start, *b.value < 0 ? -6 : 6, 4.5,
                "halo small");
}

} // namespace

Drawing tornado(std::string title, std::vector<Bar> bars, const std::string& axis, const std::string& note)
{
    std::ranges::stable_sort(bars, [](const Bar& a, const Bar& b) {
        return (a.value ? std::abs(*a.value) : -1.0) > (b.value ? std::abs(*b.value) : -1.0);
    });
    const Frame f = frame_of(bars);
    const double top = axis_height + row * static_cast<double>(bars.size()) + 4.0;
    Sketch sketch({0, 0}, {width, top}, width);
    draw_axis(sketch, f, top, axis);
    double middle = top - 4.0 - row / 2;
    for (const Bar& b : bars) {
        draw_bar(sketch, f, b, middle);
        middle -= row;
    }
    std::string description = title + ":";
    for (const Bar& b : bars) description += fmt::format(" {} {};", b.name, b.words);
    return {std::move(title), sketch.svg(description), note};
}

} // namespace damslip::pages
