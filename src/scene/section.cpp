#include "scene/section.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace damslip {

namespace {

/// Twice the signed area, and its first moments, by the shoelace sums.
struct Moments {
    double a2 = 0.0, x6 = 0.0, y6 = 0.0;
};

Moments moments(const Polyline& p)
{
    Moments m;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Point& a = p[i];
        const Point& b = p[(i + 1) % p.size()];
        const double cross = a.x * b.y - b.x * a.y;
        m.a2 += cross;
        m.x6 += cross * (a.x + b.x);
        m.y6 += cross * (a.y + b.y);
    }
    return m;
}

} // namespace

double area(const Section& section)
{
    return 0.5 * moments(section.polygon).a2;
}

Point centroid(const Section& section)
{
    const Moments m = moments(section.polygon);
    return {m.x6 / (3.0 * m.a2), m.y6 / (3.0 * m.a2)};
}

double polar_moment(const Section& section)
{
    // About the centroid from the start, so that nothing cancels: triangles from there to each side.
    const Point c = centroid(section);
    const Polyline& p = section.polygon;
    double sum = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Point a{p[i].x - c.x, p[i].y - c.y};
        const Point& next = p[(i + 1) % p.size()];
        const Point b{next.x - c.x, next.y - c.y};
        sum += (a.x * b.y - b.x * a.y) * (a.x * a.x + a.x * b.x + b.x * b.x + a.y * a.y + a.y * b.y + b.y * b.y);
    }
    return sum / 12.0;
}

Point heel(const Section& section)
{
    return section.polygon.at(0);
}
Point toe(const Section& section)
{
    return section.polygon.at(1);
}

double base_length(const Section& section)
{
    return std::hypot(toe(section).x - heel(section).x, toe(section).y - heel(section).y);
}

double base_inclination(const Section& section)
{
    return std::atan2(heel(section).y - toe(section).y, toe(section).x - heel(section).x);
}

double crest_level(const Section& section)
{
    return std::max_element(section.polygon.begin(), section.polygon.end(), [](Point a, Point b) { return a.y < b.y; })
        ->y;
}

double width_at_level(const Section& section, double y)
{
    const Polyline& p = section.polygon;
    double first = std::numeric_limits<double>::infinity(), last = -first;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Point a = p[i], b = p[(i + 1) % p.size()];
        if (std::min(a.y, b.y) > y || std::max(a.y, b.y) < y || a.y == b.y) continue;
        const double x = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
        first = std::min(first, x);
        last = std::max(last, x);
    }
    return std::max(0.0, last - first);
}

Polyline upstream_face(const Section& section)
{
    const double top = crest_level(section);
    Polyline face{heel(section)};
    for (auto p = section.polygon.rbegin(); p != section.polygon.rend(); ++p) {
        face.push_back(*p);
        if (p->y == top) break;
    }
    return face;
}

Polyline downstream_face(const Section& section)
{
    const double top = crest_level(section);
    Polyline face;
    for (auto p = section.polygon.begin() + 1; p != section.polygon.end(); ++p) {
        face.push_back(*p);
        if (p->y == top) break;
    }
    return face;
}

const char* sliding_body(const Scene& scene)
{
    return scene.wedge ? "wedge" : scene.section.rock_slope ? "block" : "dam";
}

} // namespace damslip
