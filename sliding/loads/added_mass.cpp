#include "sliding/loads/added_mass.hpp"

#include "core/input_error.hpp"
#include "core/units.hpp"
#include "scene/section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace damslip::sliding {

namespace {

using std::numbers::pi;
constexpr double right_angle = 0.5 * pi;

/// tau = (T_r/T)^2 of the series; refuses periods at and below the reservoir's own.
double period_ratio_squared(const AddedMass& method, const WaterColumn& water)
{
    if (!method.period) return 0.0;
    const double own = reservoir_period(water);
    if (*method.period <= own)
        throw InputError(
            Diagnostic{"", 0, 0, fmt::format("added_mass.period_s = {:g} is not allowed.", *method.period),
                       fmt::format("a period T of the excitation or of the dam above T_r = 4h/c = {:.6g} s, the "
                                   "water's own first period (h = {:g} m): at T_r the water resonates, the first "
                                   "term of Westergaard's series has c_1 = 0, and below it no mass can stand for it",
                                   own, water.depth),
                       "leave the period out (infinite, incompressible water), or use the acoustic reservoir"});
    return std::pow(own / *method.period, 2);
}

double table_value(const std::vector<Point>& table, double x)
{
    if (x <= table.front().x) return table.front().y;
    for (std::size_t i = 1; i < table.size(); ++i)
        if (x <= table[i].x) {
            const Point &a = table[i - 1], &b = table[i];
            return b.x > a.x ? a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x) : b.y;
        }
    return table.back().y;
}

/// C_m of Zangar, over cos(phi) where the normal component is asked for. Its own line 0.73 (1 - phi/90 deg) goes to
/// zero with cos(phi), so the quotient stays finite: 0.73 2/pi at phi = 90 deg.
double zangar_coefficient(const AddedMass& method, double phi)
{
    const bool normal = method.inclined_face != InclinedFaceRule::printed;
    const double leaning = std::max(phi, 0.0);
    if (method.zangar_table.empty()) {
        const double rest = right_angle - leaning; // angle from the horizontal
        const double line = 0.73 * rest / right_angle;
        if (!normal) return line;
        return rest < 1e-6 ? 0.73 / right_angle : line / (phi < 0.0 ? std::cos(phi) : std::sin(rest));
    }
    const double value = table_value(method.zangar_table, leaning);
    if (!normal) return value;
    return std::cos(phi) > 1e-6 ? value / std::cos(phi) : 0.0;
}

double zangar(const AddedMass& method, double zeta, double phi)
{
    const double a = zeta * (2.0 - zeta);
    return 0.5 * zangar_coefficient(method, phi) * (a + std::sqrt(a));
}

double goldgruber(const AddedMass& method, double zeta, double phi)
{
    const double degrees = std::max(phi, 0.0) / units::degree;
    if (degrees > 30.0 * (1.0 + 1e-12))
        throw InputError(Diagnostic{
            "", 0, 0,
            fmt::format("added_mass.formula = \"goldgruber\" with a face {:.4g} degrees from the vertical.", degrees),
            "a wet upstream face within 0 to 30 degrees of the vertical, the range of (3-10)",
            "use added_mass.formula = \"zangar\" or \"westergaard\""});
    const double peak = std::sqrt(degrees / 1000.0); // h_m / h
    // With y/h = 1 - zeta the cosine is sin((pi/2) zeta/(1 - peak)): exact near the surface.
    const double shape = std::sin(right_angle * zeta / (1.0 - peak));
    const double value = 0.707 * (1.0 - 0.011 * degrees) * std::pow(std::max(shape, 0.0), 0.6 + 0.005 * degrees);
    return method.inclined_face != InclinedFaceRule::printed ? value / std::max(std::cos(phi), 1e-6) : value;
}

} // namespace

double sound_speed(const WaterColumn& water)
{
    return std::sqrt(water.bulk_modulus / water.density);
}

double reservoir_period(const WaterColumn& water)
{
    return 4.0 * water.depth / sound_speed(water);
}

double added_mass_per_area(const AddedMass& method, const WaterColumn& water, double depth, double face_angle)
{
    const double unit = water.density * water.depth; // rho h [kg/m^2]
    const double zeta = std::min(depth / water.depth, 1.0);
    const double tau = method.formula == AddedMassFormula::westergaard ? period_ratio_squared(method, water) : 0.0;
    if (!(zeta > 0.0)) return 0.0;
    if (const AddedMassRow& row = added_mass_row(method.formula); row.per_area)
        return row.per_area(method, water, zeta * water.depth, face_angle);
    switch (method.formula) {
    case AddedMassFormula::westergaard_simplified:
        return 0.875 * unit * std::sqrt(zeta);
    case AddedMassFormula::westergaard:
        return 8.0 / (pi * pi) * unit * westergaard_series(zeta, tau);
    case AddedMassFormula::zangar:
        return unit * zangar(method, zeta, face_angle);
    case AddedMassFormula::goldgruber:
        return unit * goldgruber(method, zeta, face_angle);
    }
    return 0.0;
}

CompressibilityCriterion compressibility_criterion(const WaterColumn& water, double dam_frequency_hz)
{
    const double ratio = 1.0 / (reservoir_period(water) * dam_frequency_hz);
    return {ratio, ratio < 2.0};
}

namespace {

constexpr double zeta3 = 1.2020569031595942854; // Riemann zeta(3)

/// Sums over odd n of sin(n x)/n^2 and sin(n x)/n^4, 0 <= x <= pi/2.
struct SineSums {
    double second = 0.0, fourth = 0.0;
};

/// Coefficients of ln(tan u / u) = sum_k c_k u^2k: c_k = (4^k - 2) zeta(2k) / (k pi^2k).
double tangent_log_coefficient(int k)
{
    double zeta = 1.0; // zeta(2k), or its known value for the slowly converging ones
    if (k == 1) {
        zeta = std::numbers::pi * std::numbers::pi / 6.0;
    } else if (k == 2) {
        zeta = std::pow(std::numbers::pi, 4) / 90.0;
    } else {
        for (int n = 2; n <= 400; ++n) {
            const double term = std::pow(n, -2 * k);
            if (term < 1e-19) break;
            zeta += term;
        }
    }
    return (std::pow(4.0, k) - 2.0) * zeta / (k * std::pow(std::numbers::pi, 2 * k));
}

/// With d/dx sum sin(nx)/n^2 = -1/2 ln tan(x/2) and d2/dx2 sum sin(nx)/n^4 = - sum sin(nx)/n^2, both sums follow from
/// integrating the power series of ln(tan u / u), u = x/2 <= pi/4, term by term; terms shrink like 4^-k.
SineSums sine_sums(double x)
{
    if (x <= 0.0) return {};
    constexpr int terms = 27;
    static const std::array<double, terms> c = [] {
        std::array<double, terms> values{};
        for (int k = 1; k <= terms; ++k) values[static_cast<std::size_t>(k - 1)] = tangent_log_coefficient(k);
        return values;
    }();
    const double u2 = 0.25 * x * x, log_half = std::log(0.5 * x);
    double second = 0.0, fourth = 0.0, power = u2;
    for (int k = 1; k <= terms; ++k, power *= u2) {
        const double term = c[static_cast<std::size_t>(k - 1)] * power, d = 2.0 * k + 1.0;
        second += term / d;
        fourth += term / (d * (d + 1.0) * (d + 2.0));
    }
    return {-0.5 * x * (log_half - 1.0 + second),
            x * (0.875 * zeta3 + 0.5 * x * x * (log_half / 6.0 - 11.0 / 36.0 + fourth))};
}

} // namespace

double westergaard_series(double zeta, double tau)
{
    const double x = 0.5 * std::numbers::pi * zeta;
    const SineSums sums = sine_sums(x);
    double total = sums.second;
    if (tau > 0.0) {
        // 1/(n sqrt(n^2 - tau)) = 1/n^2 + tau/(2 n^4) + rest; the rest falls like 3 tau^2/(8 n^6): beyond n = 401 less
        // than 4e-15.
        total += 0.5 * tau * sums.fourth;
        for (int n = 401; n >= 1; n -= 2) {
            const double n2 = static_cast<double>(n) * n;
            const double rest = 1.0 / (n * std::sqrt(n2 - tau)) - 1.0 / n2 - 0.5 * tau / (n2 * n2);
            total += rest * std::sin(n * x);
        }
    }
    return total;
}

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
