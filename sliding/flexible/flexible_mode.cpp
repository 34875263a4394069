#include "sliding/flexible/flexible_mode.hpp"

#include "scene/section.hpp"
#include "scene/water.hpp"
#include "sliding/loads/added_mass.hpp"
#include "sliding/loads/added_mass_integral.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::sliding {

Oscillator::Oscillator(double omega, double damping, double inertia)
    : stiffness_(omega * omega), damping_(2.0 * damping * omega), decay_(damping * omega / inertia),
      square_(stiffness_ / inertia - decay_ * decay_), free_stiffness_(stiffness_ / inertia)
{
}

ModeState Oscillator::after(const ModeState& now, double p0, double p1, double h) const
{
    // Particular solution, linear in time; the rest is free.
    const double v_p = p1 / stiffness_;
    const double x_p = (p0 - damping_ * v_p) / stiffness_;
    const double x = now.x - x_p, v = now.v - v_p;
    double even = 1.0, odd = h; // cos(d h), sin(d h)/d
    const double d = std::sqrt(std::abs(square_));
    if (d * h > 1e-8) {
        even = square_ > 0.0 ? std::cos(d * h) : std::cosh(d * h);
        odd = (square_ > 0.0 ? std::sin(d * h) : std::sinh(d * h)) / d;
    }
    const double fade = std::exp(-decay_ * h);
    return {x_p + v_p * h + fade * (x * even + (v + decay_ * x) * odd),
            v_p + fade * (v * even - (free_stiffness_ * x + decay_ * v) * odd)};
}

namespace {

/// Integral of y^p over the part of the polygon between two levels, 0 <= low: by Green the integrals of x y^p dy along the
/// edges, closed for straight ones.
double power_moment(const Polyline& polygon, double p, double low, double high)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        Point a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        if (a.y == b.y || (a.y <= 0.0 && b.y <= 0.0)) continue;
        const double slope = (b.x - a.x) / (b.y - a.y), x0 = a.x - slope * a.y; // x = x0 + slope y
        const double from = std::clamp(a.y, low, high), to = std::clamp(b.y, low, high);
        sum += x0 * (std::pow(to, p + 1) - std::pow(from, p + 1)) / (p + 1) +
               slope * (std::pow(to, p + 2) - std::pow(from, p + 2)) / (p + 2);
    }
    return sum;
}

/// The same of the concrete of a section.
double power_moment(const Section& section, double p)
{
    double sum = 0.0;
    for (const ShareBand& band : share_bands(section.thickness)) {
        const double low = std::max(0.0, band.from), high = band.to;
        if (!(high > low)) continue;
        sum += band.constant * power_moment(section.polygon, p, low, high);
        if (band.slope != 0.0) sum += band.slope * power_moment(section.polygon, p + 1, low, high);
    }
    return sum;
}

/// Sums of n_x^2 m_n psi^k dS over the wet face, by midpoints in the square root of the depth (the mass begins with a root
/// there): 1e-6.
void add_water(const Scene& scene, double exponent, double height, ModalSums& sums)
{
    if (!has_water(scene) || scene.reservoir->model == ReservoirModel::hydrostatic) return;
    const WaterColumn water{scene.reservoir->level, scene.reservoir->density, scene.reservoir->bulk_modulus};
    const Polyline face = upstream_face(scene.section);
    constexpr int panels = 4000;
    for (std::size_t i = 0; i + 1 < face.size(); ++i) {
        const Point lower = face[i].y <= face[i + 1].y ? face[i] : face[i + 1],
                    upper = face[i].y <= face[i + 1].y ? face[i + 1] : face[i];
        const double top = std::min(upper.y, water.depth), bottom = std::max(lower.y, 0.0);
        if (!(top > bottom)) continue;
        const double lean = (face[i + 1].x - face[i].x) / (face[i + 1].y - face[i].y), phi = std::atan(lean);
        const double along = std::sqrt(1.0 + lean * lean), n_x2 = 1.0 / (along * along);
        const double r0 = std::sqrt(water.depth - top), r1 = std::sqrt(water.depth - bottom);
        for (int k = 0; k < panels; ++k) { // midpoints in r = sqrt(z), dy = 2 r dr
            const double r = r0 + (r1 - r0) * (k + 0.5) / panels, y = water.depth - r * r;
            const double m =
                added_mass_per_area(scene.added_mass, water, r * r, phi) * n_x2 * along * 2.0 * r * (r1 - r0) / panels;
            const double psi = std::pow(std::max(y, 0.0) / height, exponent);
            sums.load += m * psi;
            sums.mass += m * psi * psi;
        }
    }
    sums.total += scene_added_mass(scene, scene.reservoir->level).xx;
}

} // namespace

ModalSums power_shape(const Scene& scene, double exponent)
{
    const double height = crest_level(scene.section), density = scene.dam.density;
    ModalSums sums;
    sums.load = density * power_moment(scene.section, exponent) / std::pow(height, exponent);
    sums.mass = density * power_moment(scene.section, 2 * exponent) / std::pow(height, 2 * exponent);
    sums.total = density * area(scene.section);
    add_water(scene, exponent, height, sums);
    return sums;
}

namespace {

using std::numbers::pi;
constexpr int most_iterations = 200;

double radiation_damping(const StrainColumn& column, double velocity)
{
    if (column.base_velocity <= 0.0) return 0.0;
    return std::min(0.2, 0.55016 * std::pow(column.base_velocity / velocity, -0.9904));
}

/// 0.62 (G/G_0)^0.1 of Masing's hysteresis of the hyperbola, and 1 % at no strain. @param ratio  gamma/gamma_r, > 0
double material_damping(double ratio)
{
    const double masing = 1.0 / pi * (4.0 * (ratio - std::log1p(ratio)) * (1.0 + ratio) / (ratio * ratio) - 2.0);
    return 0.62 * std::pow(1.0 + ratio, -0.1) * masing + 0.01;
}

FlexibleBlock mode_of(const StrainColumn& column, double velocity, double damping, double mass_ratio)
{
    return {4.0 * column.height / velocity, std::min(0.5, damping), mass_ratio};
}

/// Largest |x| at the samples and one period after them [m].
double largest_deflection(const FlexibleBlock& block, const GroundMotion& motion)
{
    if (motion.accel_h.empty()) return 0.0;
    const double omega = 2.0 * pi / block.period;
    const Oscillator mode(omega, block.damping_ratio, 1.0);
    ModeState state;
    double largest = 0.0;
    const std::vector<double>& a = motion.accel_h;
    for (std::size_t k = 0; k + 1 < a.size(); ++k) {
        state = mode.after(state, a[k], (a[k + 1] - a[k]) / motion.dt, motion.dt);
        largest = std::max(largest, std::abs(state.x));
    }
    for (double t = 0.0; t < block.period; t += motion.dt) {
        state = mode.after(state, 0.0, 0.0, motion.dt);
        largest = std::max(largest, std::abs(state.x));
    }
    return largest;
}

} // namespace

StrainCompatible strain_compatible(const StrainColumn& column, const GroundMotion& motion, double mass_ratio,
                                   double tolerance)
{
    StrainCompatible now;
    now.velocity = column.velocity;
    double material = column.damping;
    now.block = mode_of(column, now.velocity, material + radiation_damping(column, now.velocity), mass_ratio);
    const auto strain = [&] { return 0.65 * 1.57 * 4.0 / pi * largest_deflection(now.block, motion) / column.height; };
    if (column.reference_strain <= 0.0) {
        now.strain = strain();
        return now;
    }
    now.settled = false;
    while (!now.settled && now.iterations < most_iterations) {
        ++now.iterations;
        now.strain = strain();
        const double ratio = std::max(1e-9, now.strain / column.reference_strain);
        double velocity = column.velocity / std::sqrt(1.0 + ratio), damping = material_damping(ratio);
        now.settled = std::abs(1.0 - velocity * velocity / (now.velocity * now.velocity)) <= tolerance &&
                      std::abs(1.0 - damping / material) <= tolerance;
        if (!now.settled && now.iterations > most_iterations / 4) { // it goes to and fro between two peaks: half steps
            velocity = 0.5 * (velocity + now.velocity);
            damping = 0.5 * (damping + material);
        }
        now.velocity = velocity;
        material = damping;
        now.block = mode_of(column, velocity, material + radiation_damping(column, velocity), mass_ratio);
    }
    return now;
}

} // namespace damslip::sliding
