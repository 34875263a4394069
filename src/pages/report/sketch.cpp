#include "pages/report/sketch.hpp"

#include "pages/report/escape.hpp"

#include <cassert>
#include <cmath>
#include <fmt/format.h>

namespace damslip::pages {

namespace {

const char* anchor(Align align)
{
    switch (align) {
    case Align::start:
        return "start";
    case Align::middle:
        return "middle";
    case Align::end:
        return "end";
    }
    return "";
}

} // namespace

Sketch::Sketch(Point low, Point high, double width) : low_(low), high_(high), scale_(width / (high.x - low.x))
{
    assert(high.x > low.x && high.y > low.y && width > 0);
}

void Sketch::polygon(const Polyline& points, const std::string& css)
{
    body_ += "<polygon class=\"" + css + "\" points=\"";
    for (const Point& p : points) body_ += fmt::format("{:.1f},{:.1f} ", pixel(p).x, pixel(p).y);
    body_ += "\"/>\n";
}

void Sketch::line(const Polyline& points, const std::string& css)
{
    body_ += "<polyline class=\"" + css + "\" points=\"";
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
                         anchor(align), html_text(words));
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
    const bool level = std::abs(b.x - a.x) > std::abs(b.y - a.y);
    if (level)
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

} // namespace damslip::pages
