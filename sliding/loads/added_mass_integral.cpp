#include "sliding/loads/added_mass_integral.hpp"

#include "scene/section.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace damslip::sliding {

namespace {

/// Integrals over 0...1 of f(w), w f(w) and w^2 f(w) by the tanh-sinh rule: w = 1/(1 + exp(-pi sinh t)), step 1/16. Roots and
/// logarithms at the ends cost no accuracy; w is exact near 0, where the free surface is.
struct Moments {
    double zeroth = 0.0, first = 0.0, second = 0.0;
};

struct Node {
    double w, weight;
};

std::array<Node, 109> tanh_sinh_nodes()
{
    constexpr int half = 54;
    constexpr double step = 1.0 / 16.0;
    std::array<Node, 2 * half + 1> nodes;
    for (int k = -half; k <= half; ++k) {
        const double t = k * step, e = std::exp(-std::numbers::pi * std::sinh(t));
        const double w = 1.0 / (1.0 + e);
        nodes[static_cast<std::size_t>(k + half)] = {w, step * std::numbers::pi * std::cosh(t) * w * (e * w)};
    }
    return nodes;
}

template <class Function>
Moments integrate(Function f)
{
    static const std::array<Node, 109> nodes = tanh_sinh_nodes();
    Moments sum;
    for (const auto& [w, weight] : nodes) {
        const double value = weight * f(w);
        sum.zeroth += value;
        sum.first += w * value;
        sum.second += w * w * value;
    }
    return sum;
}

/// One straight piece, from its end nearer to the surface to the other.
void add_piece(const AddedMass& method, const WaterColumn& water, Point upper, Point lower, Point normal, double phi,
               const std::function<double(double)>& share, AddedMassIntegral& sum)
{
    const double length = std::hypot(lower.x - upper.x, lower.y - upper.y);
    const double z0 = water.depth - upper.y, dz = upper.y - lower.y;
    const Moments m = integrate([&](double w) {
        const double own = added_mass_per_area(method, water, z0 + w * dz, phi);
        return share ? own * share(upper.y - w * dz) : own;
    });
    const double mass = length * m.zeroth;
    const double x = length * (upper.x * m.zeroth + (lower.x - upper.x) * m.first); // integral of m x dS
    const double y = length * (upper.y * m.zeroth + (lower.y - upper.y) * m.first);
    sum.xx += mass * normal.x * normal.x;
    sum.xy += mass * normal.x * normal.y;
    sum.yy += mass * normal.y * normal.y;
    sum.horizontal_moment.x -= y * normal.x * normal.x;
    sum.horizontal_moment.y -= y * normal.x * normal.y;
    sum.vertical_moment.x += x * normal.y * normal.x;
    sum.vertical_moment.y += x * normal.y * normal.y;
    // n_x y - n_y x is linear along the piece.
    const double arm = normal.x * upper.y - normal.y * upper.x;
    const double change = normal.x * (lower.y - upper.y) - normal.y * (lower.x - upper.x);
    sum.rotation += length * (arm * arm * m.zeroth + 2.0 * arm * change * m.first + change * change * m.second);
}

bool same(const AddedMass& a, const AddedMass& b)
{
    return a.formula == b.formula && a.period == b.period && a.inclined_face == b.inclined_face &&
           a.zangar_table == b.zangar_table;
}

bool same(const WaterColumn& a, const WaterColumn& b)
{
    return a.depth == b.depth && a.density == b.density && a.bulk_modulus == b.bulk_modulus;
}

Point at_height(Point a, Point b, double y)
{
    const double s = (y - a.y) / (b.y - a.y);
    return {a.x + s * (b.x - a.x), y};
}

} // namespace

AddedMassIntegral integrate_added_mass(const AddedMass& method, const WaterColumn& water, const Polyline& upstream_face,
                                       const std::function<double(double)>& share)
{
    AddedMassIntegral sum;
    if (!(water.depth > 0.0)) return sum;
    for (std::size_t i = 0; i + 1 < upstream_face.size(); ++i) {
        Point a = upstream_face[i], b = upstream_face[i + 1]; // towards the crest, dam on the right
        const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
        Point upper = dy >= 0.0 ? b : a, lower = dy >= 0.0 ? a : b;
        if (length == 0.0 || lower.y >= water.depth || upper.y < 0.0) continue;
        if (upper.y > water.depth) upper = at_height(a, b, water.depth);
        if (lower.y < 0.0) lower = at_height(a, b, 0.0);
        Point normal{dy / length, -dx / length};
        if (method.inclined_face == InclinedFaceRule::horizontal) normal.y = 0.0; // what it presses down is left out
        add_piece(method, water, upper, lower, normal, std::atan2(dx, dy), share, sum);
    }
    return sum;
}

AddedMassIntegral scene_added_mass(const Scene& scene, std::optional<double> level)
{
    if (!scene.reservoir || !level || !(*level > 0.0) || scene.reservoir->model == ReservoirModel::hydrostatic)
        return {};
    // A sweep over friction asks for the same integral for each of its models: the last one is kept, for each thread.
    struct Last {
        AddedMass method;
        WaterColumn water;
        Polyline face;
        AddedMassIntegral sum;
    };
    static thread_local std::optional<Last> last;
    const WaterColumn water{*level, scene.reservoir->density, scene.reservoir->bulk_modulus};
    Polyline face = upstream_face(scene.section);
    if (!last || !same(last->method, scene.added_mass) || !same(last->water, water) || last->face != face) {
        last.reset(); // also where the integral is refused
        const AddedMassIntegral sum = integrate_added_mass(scene.added_mass, water, face);
        last = Last{scene.added_mass, water, std::move(face), sum};
    }
    return last->sum;
}

FaceLoad hydrodynamic_force(const AddedMassIntegral& mass, double ax, double ay)
{
    return {{-(mass.xx * ax + mass.xy * ay), 0.0, -(mass.horizontal_moment.x * ax + mass.horizontal_moment.y * ay)},
            {0.0, -(mass.xy * ax + mass.yy * ay), -(mass.vertical_moment.x * ax + mass.vertical_moment.y * ay)}};
}

} // namespace damslip::sliding
