#include "sliding/flexible/mode_shape.hpp"

#include "scene/section.hpp"
#include "scene/water.hpp"
#include "sliding/loads/added_mass.hpp"
#include "sliding/loads/added_mass_integral.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::sliding {

namespace {

/// Integral of y^p over the part of the polygon above y = 0: by Green the integrals of x y^p dy along the edges, closed for
/// straight ones.
double power_moment(const Polyline& polygon, double p)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        Point a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        if (a.y == b.y || (a.y <= 0.0 && b.y <= 0.0)) continue;
        const double slope = (b.x - a.x) / (b.y - a.y), x0 = a.x - slope * a.y; // x = x0 + slope y
        const double from = std::max(a.y, 0.0), to = std::max(b.y, 0.0);
        sum += x0 * (std::pow(to, p + 1) - std::pow(from, p + 1)) / (p + 1) +
               slope * (std::pow(to, p + 2) - std::pow(from, p + 2)) / (p + 2);
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
    sums.load = density * power_moment(scene.section.polygon, exponent) / std::pow(height, exponent);
    sums.mass = density * power_moment(scene.section.polygon, 2 * exponent) / std::pow(height, 2 * exponent);
    sums.total = density * area(scene.section);
    add_water(scene, exponent, height, sums);
    return sums;
}

} // namespace damslip::sliding
