#include "pages/accuracy/accuracy_pages.hpp"

#include "core/text.hpp"
#include "pages/report/answer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace damslip::pages {

namespace {

constexpr double width = 880, height = 576, left = 74, right = 20, top = 94, bottom = 54;
constexpr std::array<ModelLevelKind, 8> kinds{ModelLevelKind::regression, ModelLevelKind::rigid,           ModelLevelKind::reduced,
                                        ModelLevelKind::variant,    ModelLevelKind::finite_elements, ModelLevelKind::acoustic,
                                        ModelLevelKind::quadratic,  ModelLevelKind::other_rock};

const char* const standalone_style = R"(<style>
svg { --paper: #ffffff; --ink: #1c2227; --muted: #59656f; --grid: #e4e8eb; --axis: #3c464e; --mark: #6b4fa0;
  --c0: #0b62b0; --c1: #c8500a; --c2: #128059; --c3: #a3309b; --c4: #7a6200; --c5: #0a7f92; --c6: #b3223c; --c7: #5b6670; }
@media (prefers-color-scheme: dark) { svg { --paper: #14181b; --ink: #e4e9ed; --muted: #a3afb9; --grid: #2b3339; --axis: #c3ccd4;
  --mark: #c4a8f5; --c0: #6fb4f2; --c1: #f2995c; --c2: #5fcfa2; --c3: #e58bdf; --c4: #d9c05a; --c5: #5fd0e0; --c6: #f58a9c;
  --c7: #a9b4be; } }
text { font: 13px system-ui, -apple-system, "Segoe UI", Roboto, Arial, sans-serif; fill: var(--ink); }
</style>
)";

struct Box {
    double x0, y0, x1, y1;
    bool meets(const Box& o) const { return x0 < o.x1 && o.x0 < x1 && y0 < o.y1 && o.y0 < y1; }
};

/// A logarithmic axis between two pixels.
struct LogAxis {
    double low, high; ///< decimal logarithms of the ends
    double from, to;  ///< [px]

    double at(double value) const
    {
        return from + (to - from) * std::clamp((std::log10(value) - low) / (high - low), 0.0, 1.0);
    }
    /// One to nine times each power of ten, with the multiple.
    std::vector<std::pair<double, int>> marks() const
    {
        std::vector<std::pair<double, int>> list;
        for (int e = static_cast<int>(std::floor(low)); e <= std::ceil(high); ++e)
            for (int m = 1; m < 10; ++m)
                if (const double v = m * std::pow(10.0, e); std::log10(v) >= low && std::log10(v) <= high)
                    list.emplace_back(v, m);
        return list;
    }
};

LogAxis log_axis(const std::vector<double>& values, double from, double to)
{
    const auto [low, high] = std::ranges::minmax_element(values);
    LogAxis axis{std::log10(*low) - 0.15, std::log10(*high) + 0.15, from, to};
    const double middle = 0.5 * (axis.low + axis.high);
    axis.low = std::min(axis.low, middle - 0.5); // a decade at least
    axis.high = std::max(axis.high, middle + 0.5);
    return axis;
}

/// The figure under construction.
class Figure {
public:
    Figure(const std::vector<ModelLevelResult>& results, const Judgement& judgement, double tolerance)
        : results_(results), judgement_(judgement), tolerance_(tolerance)
    {
        std::vector<double> seconds, percent{100.0 * tolerance};
        for (std::size_t i = 0; i < results.size(); ++i) {
            if (!judgement.model_levels[i].deviation) continue;
            shown_.push_back(i);
            seconds.push_back(results[i].seconds);
            percent.push_back(percent_of(i));
        }
        if (shown_.empty()) return;
        x_ = log_axis(seconds, left, width - right);
        y_ = log_axis(percent, height - bottom, top);
    }

    std::string svg(const std::string& title, FigureStyle style)
    {
        if (shown_.empty()) return "";
        draw_axes();
        draw_lines();
        draw_front();
        for (const std::size_t i : shown_) draw_model_level(i);
        for (const std::size_t i : named()) draw_name(i);
        draw_legend(title);
        const bool alone = style == FigureStyle::standalone;
        return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:g} {:g}\"{} role=\"img\" "
                           "aria-label=\"{}\">\n{}{}{}</svg>\n",
                           width, height, alone ? fmt::format(" width=\"{:g}\" height=\"{:g}\"", width, height) : "",
                           html_text(title), alone ? standalone_style : "",
                           alone ? "<rect width=\"100%\" height=\"100%\" style=\"fill:var(--paper)\"/>\n" : "", body_);
    }

private:
    double percent_of(std::size_t i) const { return std::max(100.0 * *judgement_.model_levels[i].deviation, 1e-6); }
    double x(std::size_t i) const { return x_.at(results_[i].seconds); }
    double y(std::size_t i) const { return y_.at(percent_of(i)); }

    void line(double x0, double y0, double x1, double y1, const std::string& style)
    {
        body_ += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" style=\"{}\"/>\n", x0, y0,
                             x1, y1, style);
    }
    void text(double at_x, double at_y, const std::string& words, const std::string& anchor,
              const std::string& style = "")
    {
        body_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" style=\"{}\">{}</text>\n", at_x, at_y,
                             anchor, style, html_text(words));
    }

    void draw_axes()
    {
        const std::string grid = "stroke:var(--grid);stroke-width:1", fine = grid + ";stroke-opacity:.5";
        for (const auto& [v, m] : x_.marks()) {
            line(x_.at(v), top, x_.at(v), height - bottom, m == 1 ? grid : fine);
            if (m == 1) text(x_.at(v), height - bottom + 18, fmt::format("{:g}", v), "middle");
        }
        const bool dense = y_.high - y_.low < 2.0;
        for (const auto& [v, m] : y_.marks()) {
            line(left, y_.at(v), width - right, y_.at(v), m == 1 ? grid : fine);
            if (m == 1 || (dense && (m == 2 || m == 5))) text(left - 8, y_.at(v) + 4, fmt::format("{:g} %", v), "end");
        }
        const std::string axis = "stroke:var(--axis);stroke-width:1.2";
        line(left, height - bottom, width - right, height - bottom, axis);
        line(left, top, left, height - bottom, axis);
        text(0.5 * (left + width - right), height - 12, "time of this model level alone (s)", "middle");
        text(left, top - 8, "deviation from the finest model level, what that leaves open included", "start",
             "fill:var(--muted)");
    }

    void draw_lines()
    {
        const auto across = [&](double percent, const std::string& words, const std::string& dash) {
            const double at = y_.at(percent);
            line(left, at, width - right, at, "stroke:var(--mark);stroke-width:1.3;stroke-dasharray:" + dash);
            text(left + 6, at - 5, words, "start",
                 "fill:var(--mark);paint-order:stroke;stroke:var(--paper);stroke-width:4");
            const double size = 6.6 * static_cast<double>(words.size());
            taken_.push_back({left + 6, at - 17, left + 6 + size, at});
        };
        across(100.0 * tolerance_, fmt::format("tolerance {:.3g} %", 100.0 * tolerance_), "6 4");
        if (judgement_.top_error && std::abs(std::log10(*judgement_.top_error / tolerance_)) > 0.08)
            across(100.0 * *judgement_.top_error,
                   fmt::format("left open by the finest model level, {:.2g} %", 100.0 * *judgement_.top_error), "2 4");
    }

    void draw_front()
    {
        std::vector<std::size_t> front;
        for (const std::size_t i : shown_)
            if (judgement_.model_levels[i].front) front.push_back(i);
        std::ranges::sort(front, {}, [&](std::size_t i) { return results_[i].seconds; });
        std::string path;
        for (std::size_t k = 0; k < front.size(); ++k)
            path += k == 0 ? fmt::format("M{:.1f} {:.1f}", x(front[k]), y(front[k]))
                           : fmt::format("H{:.1f}V{:.1f}", x(front[k]), y(front[k]));
        if (!front.empty()) path += fmt::format("H{:.1f}", width - right);
        body_ +=
            "<path d=\"" + path + "\" style=\"fill:none;stroke:var(--ink);stroke-width:1.4;stroke-opacity:.55\"/>\n";
    }

    static std::string colour(ModelLevelKind kind) { return fmt::format("var(--c{})", static_cast<int>(kind)); }

    void dot(double at_x, double at_y, ModelLevelKind kind, bool full, double radius)
    {
        body_ +=
            fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:g}\" style=\"fill:{};stroke:{};stroke-width:1.8\">",
                        at_x, at_y, radius, full ? colour(kind) : "var(--paper)", colour(kind));
    }

    void draw_model_level(std::size_t i)
    {
        const bool front = judgement_.model_levels[i].front;
        if (judgement_.choice == i)
            body_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"11\" "
                                 "style=\"fill:none;stroke:var(--mark);stroke-width:2.2\"/>\n",
                                 x(i), y(i));
        dot(x(i), y(i), kind_of(results_[i].model_level), front, front ? 5.5 : 4);
        body_ += fmt::format("<title>{}: {:.3g} s, {:.3g} %</title></circle>\n", html_text(model_level_id(results_[i].model_level)),
                             results_[i].seconds, percent_of(i));
        taken_.push_back({x(i) - 6, y(i) - 6, x(i) + 6, y(i) + 6});
    }

    /// The chosen model level first, then the front, the top model level, and the fastest of each kind while there is room.
    std::vector<std::size_t> named() const
    {
        std::vector<std::size_t> order;
        const auto add = [&](std::size_t i) {
            if (std::ranges::find(order, i) == order.end()) order.push_back(i);
        };
        if (judgement_.choice) add(*judgement_.choice);
        for (const std::size_t i : shown_)
            if (judgement_.model_levels[i].front) add(i);
        if (judgement_.top) add(*judgement_.top);
        for (const std::size_t i : shown_)
            if (kind_of(results_[i].model_level) != ModelLevelKind::regression) add(i);
        return order;
    }

    void draw_name(std::size_t i)
    {
        const std::string words = model_level_id(results_[i].model_level);
        const double size = 6.9 * static_cast<double>(words.size());
        const struct {
            double dx, dy;
            const char* anchor;
        } places[] = {{10, 4, "start"}, {-10, 4, "end"}, {8, -9, "start"},   {8, 17, "start"},
                      {-8, -9, "end"},  {-8, 17, "end"}, {0, -13, "middle"}, {0, 22, "middle"}};
        for (const auto& place : places) {
            const double px = x(i) + place.dx, py = y(i) + place.dy;
            const double start = *place.anchor == 's' ? px : *place.anchor == 'e' ? px - size : px - 0.5 * size;
            const Box box{start, py - 12, start + size, py + 4};
            if (box.x0 < left || box.x1 > width - right || box.y0 < top || box.y1 > height - bottom) continue;
            const Box own{x(i) - 6, y(i) - 6, x(i) + 6, y(i) + 6};
            const auto in_the_way = [&](const Box& o) { return o.meets(box) && !(o.x0 == own.x0 && o.y0 == own.y0); };
            if (std::ranges::any_of(taken_, in_the_way)) continue;
            const bool front = judgement_.model_levels[i].front || judgement_.choice == i;
            text(px, py, words, place.anchor,
                 fmt::format("paint-order:stroke;stroke:var(--paper);stroke-width:4;stroke-linejoin:round{}",
                             judgement_.choice == i ? ";font-weight:700"
                             : front                ? ""
                                                    : ";fill:var(--muted);font-size:11.5px"));
            taken_.push_back(box);
            return;
        }
    }

    void draw_legend(const std::string& title)
    {
        text(left, 22, title, "start", "font-size:16px;font-weight:600");
        double at = left + 6, row = 40;
        for (const ModelLevelKind kind : kinds) {
            const auto of_kind = [&](std::size_t i) { return kind_of(results_[i].model_level) == kind; };
            if (std::ranges::none_of(shown_, of_kind)) continue;
            const std::string words = kind_name(kind, results_);
            const double size = 6.6 * static_cast<double>(words.size());
            if (at + 10 + size > width - right) at = left + 6, row += 17; // a second row, above the axis' words
            dot(at, row, kind, true, 5);
            body_ += "</circle>\n";
            text(at + 10, row + 4, words, "start");
            at += 33 + size;
        }
    }

    const std::vector<ModelLevelResult>& results_;
    const Judgement& judgement_;
    double tolerance_;
    std::vector<std::size_t> shown_;
    LogAxis x_{}, y_{};
    std::vector<Box> taken_;
    std::string body_;
};

} // namespace

std::string cost_figure(const std::vector<ModelLevelResult>& results, const Judgement& judgement, double tolerance,
                        const std::string& title, FigureStyle style)
{
    return Figure(results, judgement, tolerance).svg(title, style);
}

ModelLevelKind kind_of(const ModelLevel& model_level)
{
    if (model_level.family == ModelLevelFamily::regression) return ModelLevelKind::regression;
    if (model_level.family == ModelLevelFamily::rigid) return ModelLevelKind::rigid;
    if (model_level.modes) return ModelLevelKind::reduced;
    if (!model_level.other_model.empty() || model_level.wave_box != 1.0) return ModelLevelKind::other_rock;
    if (model_level.tangential_stiffness || model_level.alpha || model_level.step == StepChoice::as_the_scene) return ModelLevelKind::variant;
    if (!model_level.element.empty()) return ModelLevelKind::quadratic;
    return model_level.water == ModelLevelWater::acoustic ? ModelLevelKind::acoustic : ModelLevelKind::finite_elements;
}

std::string kind_name(ModelLevelKind kind, const std::vector<ModelLevelResult>& results)
{
    if (kind != ModelLevelKind::finite_elements)
        return word_in(kind, {{ModelLevelKind::regression, "regressions"},
                              {ModelLevelKind::rigid, "rigid block"},
                              {ModelLevelKind::reduced, "FE, few modes"},
                              {ModelLevelKind::variant, "FE, penalty or scheme"},
                              {ModelLevelKind::acoustic, "FE, acoustic water"},
                              {ModelLevelKind::quadratic, "FE, quadratic elements"},
                              {ModelLevelKind::other_rock, "FE, other rock or box of waves"}});
    for (const ModelLevelResult& r : results)
        if (r.model_level.family == ModelLevelFamily::finite_elements && r.model_level.water != ModelLevelWater::acoustic)
            return "FE, " + std::string(water_word(r.model_level.water));
    return "FE";
}

} // namespace damslip::pages
