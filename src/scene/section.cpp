#include "scene/section.hpp"

#include "core/text.hpp"
#include "core/units.hpp"
#include "scene/check.hpp"
#include "scene/rock_mass.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <initializer_list>
#include <limits>
#include <tuple>

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

std::vector<ShareBand> share_bands(const Polyline& thickness)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (thickness.empty()) return {{-infinity, infinity, 1.0, 0.0}};
    std::vector<ShareBand> bands{{-infinity, thickness.front().x, thickness.front().y, 0.0}};
    for (std::size_t i = 1; i < thickness.size(); ++i) {
        const Point a = thickness[i - 1], b = thickness[i];
        if (b.x == a.x) continue;
        const double slope = (b.y - a.y) / (b.x - a.x);
        bands.push_back({a.x, b.x, a.y - slope * a.x, slope});
    }
    bands.push_back({thickness.back().x, infinity, thickness.back().y, 0.0});
    return bands;
}

double share_above(const Section& section, double y)
{
    // A joint that has come to its own axes by a subtraction is at the step all the same.
    const double above = y + 1e-9 * std::max(1.0, std::abs(crest_level(section)));
    double share = 1.0;
    for (const ShareBand& band : share_bands(section.thickness))
        if (band.from <= above) share = band.at(std::max(y, band.from));
    return share;
}

double mean_share(const Section& section, double from, double to)
{
    if (section.thickness.empty()) return 1.0;
    if (!(to > from)) return share_above(section, from);
    double sum = 0.0;
    for (const ShareBand& band : share_bands(section.thickness)) {
        const double low = std::max(from, band.from), high = std::min(to, band.to);
        if (high > low) sum += band.at(0.5 * (low + high)) * (high - low);
    }
    return sum / (to - from);
}

double base_share(const Section& section)
{
    return section.thickness.empty() ? 1.0 : share_above(section, std::max(heel(section).y, toe(section).y));
}

SectionSums section_sums(const Section& section, const Polyline& factor)
{
    // By Green: integrals along the sides, each cut where a table bends; four points of Gauss are exact there.
    constexpr std::pair<double, double> gauss[]{{-0.8611363115940526, 0.3478548451374538},
                                                {-0.3399810435848563, 0.6521451548625461},
                                                {0.3399810435848563, 0.6521451548625461},
                                                {0.8611363115940526, 0.3478548451374538}};
    const auto shares = share_bands(section.thickness), factors = share_bands(factor);
    SectionSums sums;
    const Polyline& p = section.polygon;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Point a = p[i], b = p[(i + 1) % p.size()];
        if (a.y == b.y) continue;
        const auto [bottom, top] = std::minmax(a.y, b.y);
        for (const ShareBand& share : shares)
            for (const ShareBand& times : factors) {
                const double low = std::max({bottom, share.from, times.from}),
                             high = std::min({top, share.to, times.to});
                if (!(high > low)) continue;
                for (const auto& [place, weight] : gauss) {
                    const double y = 0.5 * (low + high) + 0.5 * place * (high - low);
                    const double x = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
                    const double dy = std::copysign(0.5 * weight * (high - low), b.y - a.y) * share.at(y) * times.at(y);
                    sums.area += x * dy;
                    sums.x += 0.5 * x * x * dy;
                    sums.y += x * y * dy;
                    sums.polar += (x * x * x / 3.0 + x * y * y) * dy;
                }
            }
    }
    return sums;
}

double area(const Section& section)
{
    if (!section.thickness.empty()) return section_sums(section).area;
    return 0.5 * moments(section.polygon).a2;
}

Point centroid(const Section& section)
{
    if (!section.thickness.empty()) return section_sums(section).centre();
    const Moments m = moments(section.polygon);
    return {m.x6 / (3.0 * m.a2), m.y6 / (3.0 * m.a2)};
}

double polar_moment(const Section& section)
{
    // About the centroid from the start, so that nothing cancels: triangles from there to each side.
    const Point c = centroid(section);
    if (!section.thickness.empty()) {
        const SectionSums sums = section_sums(section);
        return sums.polar - sums.area * (c.x * c.x + c.y * c.y);
    }
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

namespace {

using checks::value;

double cross(Point o, Point a, Point b)
{
    return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

bool between(Point a, Point b, Point p)
{
    return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
           p.y <= std::max(a.y, b.y);
}

/// Closed segments ab and cd have a point in common.
bool touch(Point a, Point b, Point c, Point d)
{
    const double d1 = cross(a, b, c), d2 = cross(a, b, d), d3 = cross(c, d, a), d4 = cross(c, d, b);
    if (((d1 > 0) != (d2 > 0)) && ((d3 > 0) != (d4 > 0)) && d1 != 0 && d2 != 0 && d3 != 0 && d4 != 0) return true;
    return (d1 == 0 && between(a, b, c)) || (d2 == 0 && between(a, b, d)) || (d3 == 0 && between(c, d, a)) ||
           (d4 == 0 && between(c, d, b));
}

std::string point_text(Point p)
{
    return fmt::format("({}, {})", shortest(p.x), shortest(p.y));
}

void check_polygon(const Polyline& p, Findings& findings)
{
    const auto wrong = [&](std::string problem, std::string fix) {
        findings.wrong("section.polygon", "section.polygon_m " + std::move(problem),
                       "a simple polygon, counter-clockwise, from the heel at (0, 0) along the base to the toe",
                       std::move(fix));
    };
    const std::size_t n = p.size();
    if (n < 3) return wrong(fmt::format("has {} vertices.", n), "give at least three");
    if (n > 400) return wrong(fmt::format("has {} vertices.", n), "a section needs far fewer; at most 400");
    if (p[0] != Point{0, 0})
        return wrong("starts at " + point_text(p[0]) + ".", "shift it so that the heel, given first, is (0, 0)");
    for (const Point& q : p)
        if (std::abs(q.x) > 1e5 || std::abs(q.y) > 1e5)
            return wrong("has the vertex " + point_text(q) + ".", "coordinates are metres; at most 100 km");
    for (std::size_t i = 0; i < n; ++i)
        if (p[i] == p[(i + 1) % n])
            return wrong("repeats the vertex " + point_text(p[i]) + ".", "delete one; the polygon closes by itself");
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 2; j < n; ++j) {
            if (i == 0 && j == n - 1) continue;
            if (touch(p[i], p[i + 1], p[j], p[(j + 1) % n]))
                return wrong(fmt::format("crosses itself: edge {}-{} meets edge {}-{}.", point_text(p[i]),
                                         point_text(p[i + 1]), point_text(p[j]), point_text(p[(j + 1) % n])),
                             "put the vertices in order along the outline");
        }
    const double signed_area = area({p});
    if (!(signed_area != 0)) return wrong("has no area.", "give the outline of the section");
    if (signed_area < 0)
        return wrong("runs clockwise.", "reverse the order after the heel: (0, 0), toe, ..., crest, back to the heel");
    if (!(p[1].x > 0) || std::abs(p[1].y) > p[1].x)
        return wrong("has the toe " + point_text(p[1]) + ".",
                     "the second vertex is the toe, downstream (x > 0); the base dips less than 45 degrees");
    if (crest_level({p}) <= 0) return wrong("has no vertex above the heel.", "y is up; the base is the first edge");
    for (std::size_t i = 2; i < n; ++i)
        if (cross(p[0], p[1], p[i]) <= 0)
            return wrong("has the vertex " + point_text(p[i]) + " on or below the base.",
                         fmt::format("the base is the edge from heel to toe; all other vertices lie above its line. A key or "
                                     "step below it: leave it out of the polygon and write the plane through its underside as "
                                     " [[seam]] depth_m = {:.4g}  with  [seam.wedge]  for the rock before it; see "
                                     "examples/keyed_base.toml",
                                     std::max(-cross(p[0], p[1], p[i]) / std::hypot(p[1].x, p[1].y), 0.1)));
}

/// Are all keys there that a description needs? @param fix  with places for a key and its example
bool all_given(std::initializer_list<std::tuple<std::optional<double>, const char*, const char*>> keys,
               const char* expected, const char* fix, Findings& findings)
{
    bool all = true;
    for (const auto& [value, key, example] : keys) {
        if (value) continue;
        all = false;
        const std::string_view written = key; // "height_m" of the key height
        if (findings.given(fmt::format("section.{}", written.substr(0, written.rfind('_'))))) continue; // not allowed: reported
        findings.wrong("section", fmt::format("section.{} is missing.", key), expected,
                       fmt::format(fmt::runtime(fix), key, example));
    }
    return all;
}

Polyline polygon_by_dimensions(const SectionInput& in, Findings& findings)
{
    if (!all_given({{in.height, "height_m", "62.5"}, {in.base, "base_m", "45"}},
                   "polygon_m, or height_m, base_m and crest_m", "add  {} = {}  or a polygon_m to [section]", findings))
        return {};
    const double h = *in.height, b = *in.base, crest = in.crest.value_or(0), neck = in.neck.value_or(0);
    const double batter_height = std::min(in.upstream_slope_height.value_or(h), h);
    const double crest_from = in.upstream_slope.value_or(0) * batter_height; // x of the crest's upstream end
    const double crest_to = crest_from + crest;
    const auto wrong = [&](const char* key, std::string problem, std::string fix) {
        findings.wrong(std::string("section.") + key, std::move(problem), "dimensions that make a section",
                       std::move(fix));
    };
    if (neck > 0 && !(crest > 0))
        wrong("neck",
              fmt::format("section.neck_m = {} is given without section.crest_m: the crest has no width.",
                          shortest(neck)),
              "add  crest_m = 6  or delete neck_m");
    else if (neck >= h)
        wrong("neck",
              fmt::format("section.neck_m = {} is not below section.height_m = {}.", shortest(neck), shortest(h)),
              "neck_m is the height of the vertical downstream face below the crest");
    else if (crest_to > b)
        wrong("crest",
              fmt::format("the crest ends at x = {} m, downstream of the toe at section.base_m = {}.",
                          shortest(crest_to), shortest(b)),
              "widen the base, or lessen crest_m or upstream_slope");
    if (in.upstream_slope_height && *in.upstream_slope_height > h * (1 + 1e-12))
        wrong("upstream_slope_height",
              fmt::format("section.upstream_slope_height_m = {} is above section.height_m = {}.",
                          shortest(*in.upstream_slope_height), shortest(h)),
              "upstream_slope_height_m is the height of the sloping part of the upstream face: lessen it, or leave it out for "
              "a slope up to the crest");
    const double toe_y = -b * std::tan(in.base_inclination.value_or(0));
    if (neck < h && toe_y >= h - neck)
        wrong("base_inclination",
              fmt::format("section.base_inclination_deg puts the toe at y = {} m.", shortest(toe_y)),
              "the toe must lie below the downstream face");
    Polyline p{{0, 0}, {b, toe_y}};
    const auto add = [&p](Point q) {
        if (q != p.back() && q != p.front()) p.push_back(q);
    };
    add({crest_to, h - neck});
    add({crest_to, h});
    add({crest_from, h});
    if (batter_height < h) add({crest_from, batter_height});
    return p;
}

bool any_of_rock_slope(const SectionInput& in)
{
    return in.slope_height || in.face_dip || in.plane_dip || in.crack_distance || in.upper_dip;
}

/// Empty where the slope cannot be: said in `findings`.
Polyline polygon_of_rock_slope(const SectionInput& in, Findings& findings)
{
    if (!all_given({{in.slope_height, "slope_height_m", "12"},
                    {in.face_dip, "face_dip_deg", "60"},
                    {in.plane_dip, "plane_dip_deg", "35"},
                    {in.crack_distance, "crack_distance_m", "4"}},
                   "slope_height_m, face_dip_deg, plane_dip_deg and crack_distance_m of a rock slope",
                   "add  {} = {}  to [section]", findings))
        return {};
    const RockSlope slope{*in.slope_height, *in.face_dip, *in.plane_dip, *in.crack_distance, in.upper_dip.value_or(0)};
    const auto degrees = [](const char* key, double angle) {
        return fmt::format("{} = {:.10g}", key, angle / units::degree);
    };
    const auto wrong = [&](const char* key, std::string problem, const char* allowed, const char* fix) {
        findings.wrong(std::string("section.") + key, std::move(problem), allowed, fix);
        return Polyline{};
    };
    if (slope.plane_dip >= slope.face_dip)
        return wrong("plane_dip",
                     fmt::format("{} is not flatter than {}.", degrees("section.plane_dip_deg", slope.plane_dip),
                                 degrees("section.face_dip_deg", slope.face_dip)),
                     "a plane that comes out in the face: plane_dip_deg < face_dip_deg", "exchange them, if mixed up");
    if (slope.upper_dip >= slope.face_dip)
        return wrong("upper_dip",
                     fmt::format("{} is not flatter than {}.", degrees("section.upper_dip_deg", slope.upper_dip),
                                 degrees("section.face_dip_deg", slope.face_dip)),
                     "upper_dip_deg < face_dip_deg", "there is no crest otherwise");
    const double crest = slope.height / std::tan(slope.face_dip);
    if (slope.crack_distance <= -crest)
        return wrong("crack_distance",
                     fmt::format("{} puts the crack before the slope: its toe is {} m before the crest.",
                                 value("section.crack_distance_m", slope.crack_distance), shortest(crest)),
                     "a crack between the toe of the slope and the place where the plane comes up", "move the crack");
    if (crack_depth(slope) <= 1e-9 * slope.height)
        return wrong("crack_distance",
                     fmt::format("{}: the plane has come up to the surface before the crack.",
                                 value("section.crack_distance_m", slope.crack_distance)),
                     "a crack between the toe of the slope and the place where the plane comes up",
                     "move the crack towards the crest; a block without crack is a polygon_m");
    return sliding_block(slope);
}

void check_thickness(const Section& section, Findings& findings)
{
    const Polyline& t = section.thickness;
    const auto wrong = [&](std::string problem, std::string fix) {
        findings.wrong("section.thickness", "section.thickness " + std::move(problem),
                       "pairs [metres above the heel, share of the width, above 0 to 1], from the bottom up",
                       std::move(fix));
    };
    if (section.rock_slope) return wrong("with a rock slope.", "delete it: a block of rock is solid");
    for (std::size_t i = 1; i < t.size(); ++i) {
        const bool third = i > 1 && t[i].x == t[i - 2].x;
        if (t[i].x < t[i - 1].x || third)
            return wrong(fmt::format("has the elevation {} at place {}.", shortest(t[i].x), i + 1),
                         third ? "give an elevation twice at most: the share below a step, and above it"
                               : "put the pairs in order of their elevations");
    }
    const auto [low, high] = std::minmax(heel(section).y, toe(section).y);
    if (t.back().x < low || t.front().x > crest_level(section))
        return wrong(fmt::format("has elevations from {} to {} m, beside a dam from {} to {} m.", shortest(t.front().x),
                                 shortest(t.back().x), shortest(low), shortest(crest_level(section))),
                     "elevations are metres above the heel");
    if (high > low)
        for (const ShareBand& band : share_bands(t))
            if (band.from < high && band.to > low && (band.slope != 0.0 || band.constant != base_share(section)))
                return wrong("changes over the inclined base.",
                             fmt::format("begin above {} m, the higher end of the base", shortest(high)));
}

} // namespace

Section make_section(const SectionInput& in, Findings& findings)
{
    const bool dimensions = in.height || in.base || in.crest || in.neck || in.upstream_slope ||
                            in.upstream_slope_height || in.base_inclination;
    const bool slope = any_of_rock_slope(in);
    Section section{in.polygon, slope};
    if (!in.polygon.empty() && dimensions) {
        findings.wrong("section", "section.polygon_m is given together with dimensions.",
                       "polygon_m alone, or height_m, base_m, crest_m ... alone", "delete one of the two descriptions");
        return section;
    }
    if (slope && (!in.polygon.empty() || dimensions)) {
        findings.wrong("section", "section describes a rock slope together with a polygon or dimensions.",
                       "slope_height_m, face_dip_deg, plane_dip_deg, crack_distance_m, upper_dip_deg alone",
                       "delete one of the two descriptions");
        return section;
    }
    if (in.polygon.empty()) {
        if (findings.given("section.polygon")) return section; // already reported
        section.polygon = slope ? polygon_of_rock_slope(in, findings) : polygon_by_dimensions(in, findings);
        if (section.polygon.empty()) return section;
    }
    if (!findings.any()) check_polygon(section.polygon, findings);
    section.thickness = in.thickness;
    if (!findings.any() && !in.thickness.empty()) check_thickness(section, findings);
    return section;
}

} // namespace damslip
