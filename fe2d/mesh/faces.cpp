#include "fe2d/mesh/faces.hpp"

#include "core/input_error.hpp"
#include "core/text.hpp"
#include "scene/planes.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace damslip::fe2d {

namespace {

constexpr double flattest_face =
    0.7; ///< tangent of the slope (35 degrees) below which an edge at the top counts as crest

std::string vertex_text(const Polyline& polygon, std::size_t i)
{
    return std::to_string(i + 1) + " (" + shortest(polygon[i].x) + ", " + shortest(polygon[i].y) + ")";
}

double slope(Point a, Point b)
{
    return std::abs(b.y - a.y) / std::max(std::abs(b.x - a.x), 1e-300);
}

/// Vertices of the crest, first its downstream end; equal where the section ends in a point.
struct Crest {
    std::size_t downstream, upstream;
};

Crest find_crest(const Polyline& polygon)
{
    const std::size_t n = polygon.size();
    const double top = std::max_element(polygon.begin(), polygon.end(), [](Point a, Point b) { return a.y < b.y; })->y;
    const double tolerance = 1e-9 * (top - std::min(polygon[0].y, polygon[1].y));
    std::size_t first = n, last = 0;
    for (std::size_t i = 0; i < n; ++i) {
        if (polygon[i].y < top - tolerance) continue;
        first = std::min(first, i);
        last = i;
    }
    if (first != last) return {first, last};
    // One highest vertex: the flatter of its two edges is the crest, unless it leads straight to the heel or the toe.
    const double before = first - 1 >= 2 ? slope(polygon[first - 1], polygon[first]) : HUGE_VAL;
    const double after = first + 1 < n ? slope(polygon[first], polygon[first + 1]) : HUGE_VAL;
    if (std::min(before, after) >= flattest_face) return {first, first};
    return before < after ? Crest{first - 1, first} : Crest{first, first + 1};
}

void check_rising(const Scene& scene, const std::vector<std::size_t>& chain, const char* face)
{
    const Polyline& polygon = scene.section.polygon;
    for (std::size_t k = 0; k + 1 < chain.size(); ++k)
        if (polygon[chain[k + 1]].y <= polygon[chain[k]].y)
            refuse(scene.file,
                   "section.polygon: the " + std::string(face) + " face does not rise between vertex " +
                       vertex_text(polygon, chain[k]) + " and vertex " + vertex_text(polygon, chain[k + 1]) + ".",
                   "both faces rising from the base to the crest",
                   "give a step a slope, for example 1 mm of rise, or mesh the section with an imported mesh");
}

Polyline points_of(const Polyline& polygon, const std::vector<std::size_t>& chain)
{
    Polyline points;
    for (const std::size_t i : chain) points.push_back(polygon[i]);
    return points;
}

using Layers = std::vector<Faces::Layer>;

using Level = double Faces::Layer::*; ///< of a layer at one of the faces

struct Station {
    double s, level;
};

/// Ends of the interval of a face's (s, y) between base, layers and crest that `inside` is true for first.
template <class Inside>
std::pair<Station, Station> interval(const Polyline& face, const Layers& layers, Level level, Inside inside)
{
    Station from{0.0, face.front().y};
    for (const Faces::Layer& layer : layers) {
        const Station here{layer.s, layer.*level};
        if (inside(here)) return {from, here};
        from = here;
    }
    return {from, {1.0, face.back().y}};
}

Point at(const Polyline& face, const Layers& layers, Level level, double s)
{
    if (s <= 0.0) return face.front();
    if (s >= 1.0) return face.back();
    const auto [from, to] = interval(face, layers, level, [s](const Station& layer) { return s <= layer.s; });
    const double y = s == to.s ? to.level : from.level + (s - from.s) / (to.s - from.s) * (to.level - from.level);
    std::size_t i = 0;
    while (i + 2 < face.size() && face[i + 1].y < y) ++i;
    const double t = (y - face[i].y) / (face[i + 1].y - face[i].y);
    return {face[i].x + t * (face[i + 1].x - face[i].x), y};
}

double parameter(const Polyline& face, const Layers& layers, Level level, double y)
{
    const auto [from, to] = interval(face, layers, level, [y](const Station& layer) { return y <= layer.level; });
    if (y == to.level) return to.s;
    return from.s + (y - from.level) / (to.level - from.level) * (to.s - from.s);
}

/// The lift joints as layers; s is the mean of where the two faces have the level.
Layers joint_layers(const Scene& scene, const Polyline& upstream, const Polyline& downstream)
{
    const double low = std::max(upstream.front().y, downstream.front().y);
    const double high = std::min(upstream.back().y, downstream.back().y);
    Layers layers;
    for (const LiftJoint& joint : scene.lift_joints)
        layers.push_back({.level = joint.elevation,
                          .downstream = joint.path.empty() ? joint.elevation : joint.path.back().y,
                          .path = joint.path});
    for (const LiftJoint& joint : scene.tied_lifts) layers.push_back({.level = joint.elevation, .tied = true});
    // A row of nodes at each step of the thickness, so that no element has two shares.
    const Polyline& share = scene.section.thickness;
    for (std::size_t i = 1; i < share.size(); ++i) {
        const double y = share[i].x;
        const bool taken = std::any_of(layers.begin(), layers.end(),
                                       [y](const Faces::Layer& l) { return std::abs(l.level - y) < same_level; });
        if (y == share[i - 1].x && y > low && y < high && !taken) layers.push_back({.level = y, .step = true});
    }
    std::sort(layers.begin(), layers.end(), [](const auto& a, const auto& b) { return a.level < b.level; });
    for (Faces::Layer& layer : layers) {
        const double y = layer.level, other = layer.downstream;
        if (!(y > low && y < high && other > low && other < high))
            refuse(scene.file,
                   "lift_joint.elevation_m = " + shortest(y) + " is not between base and crest on both faces.",
                   "above " + shortest(low) + " m and below " + shortest(high) + " m", "move the joint");
        layer.s = 0.5 * (parameter(upstream, {}, &Faces::Layer::level, y) +
                         parameter(downstream, {}, &Faces::Layer::downstream, other));
    }
    return layers;
}

} // namespace

double height_on(const Polyline& path, double x)
{
    if (x <= path.front().x) return path.front().y;
    for (std::size_t i = 1; i < path.size(); ++i)
        if (x <= path[i].x)
            return path[i - 1].y + (x - path[i - 1].x) / (path[i].x - path[i - 1].x) * (path[i].y - path[i - 1].y);
    return path.back().y;
}

Point Faces::upstream_at(double s) const
{
    return damslip::fe2d::at(upstream, layers, &Layer::level, s);
}
Point Faces::downstream_at(double s) const
{
    return damslip::fe2d::at(downstream, layers, &Layer::downstream, s);
}

Point Faces::at(double s, double fraction) const
{
    const auto straight = [&](double row) {
        const Point u = upstream_at(row), d = downstream_at(row);
        return Point{u.x + fraction * (d.x - u.x), u.y + fraction * (d.y - u.y)};
    };
    Point p = straight(s);
    for (std::size_t k = 0; k < layers.size(); ++k) {
        const Layer& layer = layers[k];
        const double below = k == 0 ? 0.0 : layers[k - 1].s, above = k + 1 == layers.size() ? 1.0 : layers[k + 1].s;
        if (layer.path.empty() || s <= below || s >= above) continue;
        const double share = s <= layer.s ? (s - below) / (layer.s - below) : (above - s) / (above - layer.s);
        const Point on = straight(layer.s);
        p.y += share * (height_on(layer.path, on.x) - on.y);
    }
    return p;
}

double Faces::width_at(double s) const
{
    const Point a = upstream_at(s), b = downstream_at(s);
    return std::hypot(b.x - a.x, b.y - a.y);
}

double Faces::height() const
{
    return 0.5 * (upstream.back().y - upstream.front().y + downstream.back().y - downstream.front().y);
}

std::vector<double> Faces::kinks() const
{
    std::vector<double> all;
    for (const Polyline* face : {&upstream, &downstream})
        for (const Point& p : *face)
            all.push_back(parameter(*face, layers, face == &upstream ? &Layer::level : &Layer::downstream, p.y));
    for (const Layer& layer : layers) all.push_back(layer.s);
    std::sort(all.begin(), all.end());
    std::vector<double> distinct;
    for (const double s : all)
        if (distinct.empty() || s - distinct.back() > 1e-9) distinct.push_back(s);
    distinct.front() = 0.0;
    distinct.back() = 1.0;
    return distinct;
}

double Faces::parameter_of_level(double y) const
{
    return parameter(upstream, layers, &Layer::level, y);
}
bool Faces::ends_in_point() const
{
    return upstream.back() == downstream.back();
}

std::pair<Point, Point> crest_ends(const Section& section)
{
    const Crest crest = find_crest(section.polygon);
    return {section.polygon[crest.downstream], section.polygon[crest.upstream]};
}

Faces split_faces(const Scene& scene)
{
    const Polyline& polygon = scene.section.polygon;
    if (polygon.size() < 3)
        refuse(scene.file, "section.polygon has " + std::to_string(polygon.size()) + " vertices.", "at least three",
               "add vertices");
    if (!(area(scene.section) > 0.0))
        refuse(scene.file, "section.polygon is not counter-clockwise.",
               "heel first, toe second, then up the downstream face", "turn the order of the vertices round");
    const Crest crest = find_crest(polygon);
    std::vector<std::size_t> up{0}, down;
    for (std::size_t i = polygon.size() - 1; i >= crest.upstream; --i) up.push_back(i);
    for (std::size_t i = 1; i <= crest.downstream; ++i) down.push_back(i);
    if (up.size() < 2 || down.size() < 2)
        refuse(scene.file,
               "section.polygon: vertex " + vertex_text(polygon, crest.downstream) +
                   " is heel or toe and the highest point.",
               "heel and toe below the crest",
               "list the vertices from the heel to the toe, then up the downstream face");
    check_rising(scene, up, "upstream");
    check_rising(scene, down, "downstream");
    Faces faces{points_of(polygon, up), points_of(polygon, down), {}};
    faces.layers = joint_layers(scene, faces.upstream, faces.downstream);
    return faces;
}

namespace {

constexpr double flattest_corner = 0.01;

struct Shape {
    double shortest = HUGE_VAL, longest = 0.0, angle = HUGE_VAL, jacobian = HUGE_VAL;
};

Shape shape_of(const Mesh& mesh, const Element& element)
{
    const auto p = corners(mesh, element);
    const int n = element.size();
    Shape shape;
    for (int i = 0; i < n; ++i) {
        const Point &a = p[(i + n - 1) % n], &b = p[i], &c = p[(i + 1) % n];
        const double out_x = c.x - b.x, out_y = c.y - b.y, in_x = a.x - b.x, in_y = a.y - b.y;
        const double out = std::hypot(out_x, out_y), in = std::hypot(in_x, in_y);
        const double cross = out_x * in_y - out_y * in_x;
        const double sine = out > 0.0 && in > 0.0 ? cross / (out * in) : 0.0;
        shape.shortest = std::min(shape.shortest, out);
        shape.longest = std::max(shape.longest, out);
        shape.angle = std::min(shape.angle, std::atan2(cross, out_x * in_x + out_y * in_y));
        shape.jacobian = std::min(shape.jacobian, n == 4 ? sine : sine * 2.0 / std::numbers::sqrt3);
    }
    return shape;
}

const char* name_of(Region region)
{
    switch (region) {
    case Region::dam:
        return "dam";
    case Region::rock:
        return "rock";
    case Region::curtain:
        return "curtain";
    case Region::reservoir:
        return "reservoir";
    case Region::block:
        return "rock above the seam";
    }
    return "";
}

/// "vertices 3 (12, 51.5) and 4 (12, 62.5)": the edge of the section nearest to p.
std::string nearest_section_edge(const Scene& scene, Point p)
{
    const Polyline& v = scene.section.polygon;
    std::size_t best = 0;
    double best_distance = HUGE_VAL;
    for (std::size_t i = 0; i < v.size(); ++i) {
        const Point a = v[i], b = v[(i + 1) % v.size()];
        const double dx = b.x - a.x, dy = b.y - a.y;
        const double t = std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
        const double distance = std::hypot(a.x + t * dx - p.x, a.y + t * dy - p.y);
        if (distance < best_distance) best_distance = distance, best = i;
    }
    const std::size_t next = (best + 1) % v.size();
    return fmt::format("vertices {} ({:g}, {:g}) and {} ({:g}, {:g})", best + 1, v[best].x, v[best].y, next + 1,
                       v[next].x, v[next].y);
}

} // namespace

MeshQuality measure_quality(const Mesh& mesh)
{
    MeshQuality quality{.smallest_edge = HUGE_VAL, .smallest_angle = HUGE_VAL, .smallest_scaled_jacobian = HUGE_VAL};
    for (int e = 0; e < mesh.element_count(); ++e) {
        const Shape shape = shape_of(mesh, mesh.elements[e]);
        quality.smallest_edge = std::min(quality.smallest_edge, shape.shortest);
        quality.largest_edge = std::max(quality.largest_edge, shape.longest);
        quality.largest_aspect =
            std::max(quality.largest_aspect, shape.shortest > 0.0 ? shape.longest / shape.shortest : HUGE_VAL);
        quality.smallest_angle = std::min(quality.smallest_angle, shape.angle);
        if (shape.jacobian < quality.smallest_scaled_jacobian) {
            quality.smallest_scaled_jacobian = shape.jacobian;
            quality.worst_element = e;
        }
        ++(mesh.elements[e].size() == 4 ? quality.quadrilaterals : quality.triangles);
    }
    return quality;
}

void check_quality(const Mesh& mesh, const Scene& scene)
{
    const MeshQuality quality = measure_quality(mesh);
    if (quality.smallest_scaled_jacobian >= flattest_corner) return;
    const Element& element = mesh.elements[quality.worst_element];
    Point centre;
    for (int i = 0; i < element.size(); ++i) {
        centre.x += mesh.nodes[element.nodes[i]].x / element.size();
        centre.y += mesh.nodes[element.nodes[i]].y / element.size();
    }
    throw InputError(
        Diagnostic{.file = scene.file.string(),
                   .problem = fmt::format("section.polygon cannot be meshed: the element at ({:.4g}, {:.4g}) m in the "
                                          "{} is {} (scaled Jacobian {:.3g}).",
                                          centre.x, centre.y, name_of(element.region),
                                          quality.smallest_scaled_jacobian < 0.0 ? "inverted" : "flat",
                                          quality.smallest_scaled_jacobian),
                   .expected = fmt::format("every corner with a scaled Jacobian of at least {:g}", flattest_corner),
                   .fix = "look at " + nearest_section_edge(scene, centre) +
                          ": faces must not cross and edges must not be shorter than the elements"});
}

} // namespace damslip::fe2d
