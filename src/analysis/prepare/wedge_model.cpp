#include "analysis/prepare/wedge_model.hpp"

#include "core/units.hpp"
#include "scene/rock_wedge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace damslip {

namespace {

Vector3 towards(double azimuth)
{
    return line_direction(azimuth, 0.0);
}

sliding::WedgePlane plane_of(const RockWedge& w, std::size_t i, double gravity)
{
    const RockPlane& p = w.planes[i];
    const double area = wedge_area(w, i);
    return {p.dip, p.dip_direction, area, p.friction, p.cohesion, area * wedge_water_pressure(w, i, gravity)};
}

/// Azimuth of the least yield, to 1 degree around the least of every fifth.
double least_azimuth(const sliding::Wedge& wedge)
{
    const std::vector<double> coarse = yields_over_azimuth(wedge);
    const auto middle = 5 * (std::min_element(coarse.begin(), coarse.end()) - coarse.begin());
    double best = static_cast<double>(middle), least = std::numeric_limits<double>::infinity();
    for (auto a = middle - 4; a <= middle + 4; ++a) {
        const double here = wedge_yield(wedge, towards(static_cast<double>(a) * units::degree)).acceleration;
        if (!(here < least)) continue;
        least = here;
        best = static_cast<double>((a + 360) % 360);
    }
    return best * units::degree;
}

} // namespace

sliding::Wedge make_wedge(const RockWedge& w, double gravity)
{
    sliding::Wedge wedge;
    wedge.first = plane_of(w, 0, gravity);
    wedge.second = plane_of(w, 1, gravity);
    wedge.mass = w.density * wedge_volume(w);
    wedge.gravity = gravity;
    for (const WedgeForce& f : w.forces) wedge.force = sum(wedge.force, f.force, line_direction(f.trend, f.plunge));
    return wedge;
}

RigidWedge make_rigid_wedge(const Scene& scene)
{
    RigidWedge w;
    w.wedge = make_wedge(*scene.wedge, scene.gravity);
    w.still = wedge_state(w.wedge);
    w.azimuth = scene.wedge->motion_azimuth.value_or(trend(w.still.direction));
    w.push = towards(w.azimuth);
    w.yields.at_rest = wedge_yield(w.wedge, w.push);
    if (scene.wedge->cohesion_lost_at_slip && w.yields.at_rest.state.cohesion > 0.0)
        w.yields.moving = without_cohesion(w.wedge, w.yields.at_rest);
    return w;
}

double critical_first_friction(const sliding::Wedge& w, const sliding::WedgeState& state)
{
    if (!(w.first.friction > 0.0)) return critical_friction(state); // no share to keep: both get the same
    const double by_friction = state.resistance - state.cohesion, missing = state.drive - state.cohesion;
    if (state.mode == sliding::WedgeMode::lifts) return std::numeric_limits<double>::infinity();
    if (!(missing > 0.0)) return 0.0;
    if (!(by_friction > 0.0)) return std::numeric_limits<double>::infinity();
    return w.first.friction * missing / by_friction;
}

std::optional<double> sliding_length(const RockWedge& wedge, sliding::WedgeMode mode)
{
    switch (mode) {
    case sliding::WedgeMode::both_planes:
        return line_length(wedge);
    case sliding::WedgeMode::first_plane:
        return plane_length(wedge, 0);
    case sliding::WedgeMode::second_plane:
        return plane_length(wedge, 1);
    case sliding::WedgeMode::lifts:
        break;
    }
    return std::nullopt;
}

std::vector<double> yields_over_azimuth(const sliding::Wedge& wedge)
{
    std::vector<double> yields;
    for (int a = 0; a <= 360; a += 5) yields.push_back(wedge_yield(wedge, towards(a * units::degree)).acceleration);
    return yields;
}

std::vector<WedgeYieldRow> wedge_yield_rows(const RigidWedge& w)
{
    const auto row = [&w](const char* motion, double azimuth) {
        return WedgeYieldRow{motion, azimuth, wedge_yield(w.wedge, towards(azimuth))};
    };
    const double back = w.azimuth < std::numbers::pi ? w.azimuth + std::numbers::pi : w.azimuth - std::numbers::pi;
    return {{"records, a_h > 0", w.azimuth, w.yields.at_rest},
            row("records, a_h < 0", back),
            row("least of all azimuths", least_azimuth(w.wedge)),
            {"ground up", std::nullopt, wedge_yield(w.wedge, {0.0, 0.0, -1.0})},
            {"ground down", std::nullopt, wedge_yield(w.wedge, {0.0, 0.0, 1.0})}};
}

std::string mode_words(const RockWedge& names, sliding::WedgeMode mode)
{
    switch (mode) {
    case sliding::WedgeMode::both_planes:
        return "both planes, along their line";
    case sliding::WedgeMode::first_plane:
        return names.planes[0].name + " alone";
    case sliding::WedgeMode::second_plane:
        return names.planes[1].name + " alone";
    case sliding::WedgeMode::lifts:
        return "lifts off both planes";
    }
    return "";
}

} // namespace damslip
