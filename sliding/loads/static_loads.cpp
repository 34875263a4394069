#include "sliding/loads/static_loads.hpp"

#include "scene/section.hpp"
#include "scene/water.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace damslip::sliding {

namespace {

/// The part of the straight piece a-b at or below the level; degenerate (both ends equal) if there is none.
std::pair<Point, Point> below(Point a, Point b, double level)
{
    if (a.y >= level && b.y >= level) return {a, a};
    if (a.y <= level && b.y <= level) return {a, b};
    const double s = (level - a.y) / (b.y - a.y);
    const Point cut{a.x + s * (b.x - a.x), level};
    return a.y < level ? std::pair{a, cut} : std::pair{cut, b};
}

/// Integral of f g over s in 0...1 for f, g linear with the given end values.
double product(double f0, double f1, double g0, double g1)
{
    return (2.0 * (f0 * g0 + f1 * g1) + f0 * g1 + f1 * g0) / 6.0;
}

} // namespace

FaceLoad hydrostatic_load(const Polyline& face, DamSide side, double level, double unit_weight)
{
    const double into_dam =
        side == DamSide::right ? 1.0 : -1.0; // normal into the dam: (dy, -dx) for a dam on the right
    FaceLoad load;
    for (std::size_t i = 0; i + 1 < face.size(); ++i) {
        const auto [a, b] = below(face[i], face[i + 1], level);
        const double pa = unit_weight * (level - a.y), pb = unit_weight * (level - b.y);
        const double nx = into_dam * (b.y - a.y), ny = -into_dam * (b.x - a.x); // length of the piece included
        load.horizontal += {0.5 * (pa + pb) * nx, 0.0, -product(pa, pb, a.y, b.y) * nx};
        load.vertical += {0.0, 0.5 * (pa + pb) * ny, product(pa, pb, a.x, b.x) * ny};
    }
    return load;
}

Force silt_thrust(const Polyline& upstream_face, double level, double submerged_unit_weight,
                  double pressure_coefficient)
{
    return hydrostatic_load(upstream_face, DamSide::right, level, pressure_coefficient * submerged_unit_weight)
        .horizontal;
}

namespace {

FaceLoad scaled(double factor, const FaceLoad& load)
{
    return {factor * load.horizontal, factor * load.vertical};
}

FaceLoad at_point(Point at, double x, double y)
{
    return {force_at(at, x, 0.0), force_at(at, 0.0, y)};
}

bool gates_shut(const Scene& scene, const LoadCase& load_case)
{
    return scene.gate && !load_case.gates_open;
}

/// The share of hydrostatic_load() that meets the concrete of a section with a thickness: what piers carry between open
/// gates.
FaceLoad load_on_piers(const Section& section, const Polyline& face, double level, double unit_weight)
{
    FaceLoad load;
    for (std::size_t i = 0; i + 1 < face.size(); ++i) {
        const Point a = face[i], b = face[i + 1];
        if (a.y == b.y) continue;
        const double lean = (b.x - a.x) / (b.y - a.y), rises = b.y > a.y ? 1.0 : -1.0;
        for (const ShareBand& band : share_bands(section.thickness)) {
            const double low = std::max(band.from, std::min(a.y, b.y)),
                         high = std::min({band.to, level, std::max(a.y, b.y)});
            if (!(high > low)) continue;
            for (const double place : {-std::sqrt(0.6), 0.0, std::sqrt(0.6)}) { // Gauss: exact for p, share and arm
                const double y = 0.5 * (low + high) + 0.5 * place * (high - low), x = a.x + lean * (y - a.y);
                const double weight = 0.5 * (high - low) * rises * (place == 0.0 ? 8.0 / 9.0 : 5.0 / 9.0);
                const double p = unit_weight * (level - y) * band.at(y) * weight;
                load.horizontal += force_at({x, y}, p, 0.0);
                load.vertical += force_at({x, y}, 0.0, -p * lean);
            }
        }
    }
    return load;
}

/// Water standing on the flat crest, from the downstream to the upstream end of the crest.
FaceLoad crest_water(const Scene& scene, const LoadCase& load_case, double unit_weight)
{
    const Polyline crest{downstream_face(scene.section).back(), upstream_face(scene.section).back()};
    const double dry = crest.front().y;
    const double upstream = gates_shut(scene, load_case) ? dry : load_case.reservoir_level.value_or(dry);
    const double level = std::max(upstream, load_case.tailwater_level.value_or(dry));
    return hydrostatic_load(crest, DamSide::left, level, unit_weight);
}

double ice_level(const Scene& scene, const LoadCase& load_case)
{
    const bool at_surface = scene.reservoir && scene.ice->level == scene.reservoir->level;
    return at_surface ? load_case.reservoir_level.value_or(scene.ice->level) : scene.ice->level;
}

} // namespace

LoadCase scene_load_case(const Scene& scene)
{
    LoadCase load_case;
    if (scene.reservoir) load_case.reservoir_level = scene.reservoir->level;
    if (scene.tailwater) load_case.tailwater_level = scene.tailwater->level;
    return load_case;
}

double dam_mass(const Scene& scene)
{
    return area(scene.section) * scene.dam.density;
}

std::vector<Load> static_loads(const Scene& scene, const LoadCase& load_case)
{
    const double unit_weight = water_unit_weight(scene);
    const Polyline upstream = upstream_face(scene.section), downstream = downstream_face(scene.section);
    const double weight = dam_mass(scene) * scene.gravity;

    std::vector<Load> loads;
    loads.push_back({LoadKind::weight, "dam weight",
                     scaled(load_case.weight_factor, at_point(centroid(scene.section), 0.0, -weight))});
    const auto add_water = [&](LoadKind kind, const char* name, const FaceLoad& load) {
        if (load.total() != Force{}) loads.push_back({kind, name, scaled(load_case.water_factor, load)});
    };
    if (const auto level = load_case.reservoir_level)
        add_water(LoadKind::reservoir, "reservoir",
                  load_case.gates_open && !scene.section.thickness.empty()
                      ? load_on_piers(scene.section, upstream, *level, unit_weight)
                      : hydrostatic_load(upstream, DamSide::right, *level, unit_weight));
    if (const auto level = load_case.reservoir_level;
        level && gates_shut(scene, load_case) && scene.gate->top > upstream.back().y) {
        const Point sill = upstream.back();
        add_water(LoadKind::reservoir, "gates",
                  hydrostatic_load({sill, {sill.x, scene.gate->top}}, DamSide::right, *level, unit_weight));
    }
    if (const auto level = load_case.tailwater_level)
        add_water(LoadKind::tailwater, "tailwater", hydrostatic_load(downstream, DamSide::left, *level, unit_weight));
    add_water(LoadKind::crest_water, "water on the crest", crest_water(scene, load_case, unit_weight));
    if (scene.silt) {
        const Silt& silt = *scene.silt;
        loads.push_back(
            {LoadKind::silt, "silt",
             scaled(load_case.silt_factor,
                    {silt_thrust(upstream, silt.level, silt.submerged_unit_weight, silt.pressure_coefficient), {}})});
    }
    if (scene.ice && load_case.ice == IceLoad::on) {
        const Point at{0.0, ice_level(scene, load_case)}; // a horizontal force: its x does not enter
        loads.push_back({LoadKind::ice, "ice", scaled(load_case.ice_factor, at_point(at, scene.ice->force, 0.0))});
    }
    for (const PointForce& force : scene.forces)
        loads.push_back({LoadKind::point_force, force.name, at_point(force.at, force.force_x, force.force_y)});
    const Point base{toe(scene.section).x / base_length(scene.section),
                     toe(scene.section).y / base_length(scene.section)};
    for (const Anchor& anchor : scene.anchors) {
        const double force = force_of(anchor, load_case.anchors);
        if (!anchor.joint.empty() || force == 0.0) continue;
        // Along the bar, up from the rock: cos ψ n + sin ψ t, with t = base and n = (-t.y, t.x).
        const double c = std::cos(anchor.inclination), s = std::sin(anchor.inclination);
        const bool yields = force != anchor.prestress;
        loads.push_back({LoadKind::anchor, fmt::format("{}, {}", anchor.name, yields ? "yield force" : "prestress"),
                         at_point({anchor.distance * base.x, anchor.distance * base.y},
                                  -force * (s * base.x - c * base.y), -force * (s * base.y + c * base.x))});
    }
    return loads;
}

double force_of(const Anchor& anchor, AnchorForce which)
{
    const bool yields = which == AnchorForce::limit && anchor.limit_force == AnchorForceRule::yield;
    return yields ? anchor.yield_strength * anchor.area : anchor.prestress;
}

Force resultant(const std::vector<Load>& loads)
{
    Force sum;
    for (const Load& load : loads) sum += load.force.total();
    return sum;
}

} // namespace damslip::sliding
