#include "fe2d/mesh/quality.hpp"

#include "core/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace damslip::fe2d {

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
