#include "pages/screen/wedge_tables.hpp"

#include "core/units.hpp"
#include "scene/wedge_shape.hpp"

#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace damslip::pages {

namespace {

constexpr double MN = 1e6;

Cell angle_of_friction(double mu)
{
    return std::isfinite(mu) ? Cell(std::atan(mu) / units::degree) : Cell();
}

} // namespace

std::string direction_words(const Vector3& direction)
{
    return fmt::format("plunging {:.1f}° towards {:.0f}°", plunge(direction) / units::degree,
                       trend(direction) / units::degree);
}

Table wedge_plane_table(const Scene& scene, const RigidWedge& wedge)
{
    Table t;
    t.title = "Planes of the wedge";
    t.columns = {{"plane", "plane", "", 4},
                 {"dip_deg", "dip", "°", 4},
                 {"dip_direction_deg", "dip direction", "°", 4},
                 {"area_m2", "area", "m²", 5},
                 {"friction", "μ", "–", 4},
                 {"friction_deg", "φ", "°", 4},
                 {"cohesion_kPa", "cohesion", "kPa", 4},
                 {"water_force_MN", "water U", "MN", 5},
                 {"normal_force_MN", "N′", "MN", 5}};
    const auto add = [&](const std::string& name, const sliding::WedgePlane& p, double normal) {
        t.rows.push_back({name, p.dip / units::degree, p.dip_direction / units::degree, p.area, p.friction,
                          angle_of_friction(p.friction), p.cohesion / units::kPa, p.water_force / MN, normal / MN});
    };
    add(scene.wedge->planes[0].name, wedge.wedge.first, wedge.still.first_normal);
    add(scene.wedge->planes[1].name, wedge.wedge.second, wedge.still.second_normal);
    const Vector3 line = cross(plane_normal(wedge.wedge.first.dip, wedge.wedge.first.dip_direction),
                               plane_normal(wedge.wedge.second.dip, wedge.wedge.second.dip_direction));
    t.notes.push_back(fmt::format("volume {:.5g} m³, weight {:.5g} MN; line of intersection {}; N′: effective, without "
                                  "earthquake.",
                                  wedge_volume(*scene.wedge), wedge.wedge.mass * wedge.wedge.gravity / MN,
                                  direction_words(line[2] > 0.0 ? sum({}, -1.0, line) : line)));
    return t;
}

Table wedge_stability_table(const Scene& scene, const RigidModel& model)
{
    const RigidWedge& w = *model.wedge;
    Table t;
    t.title = "The wedge without earthquake";
    t.columns = {{"state", "state", "", 4},
                 {"mode", "slides on", "", 4},
                 {"trend_deg", "towards", "°", 4},
                 {"plunge_deg", "plunge", "°", 4},
                 {"drive_MN", "drive", "MN", 5},
                 {"resistance_MN", "resistance", "MN", 5},
                 {"factor_of_safety", "factor of safety", "–", 4},
                 {"critical_friction", "critical μ of " + scene.wedge->planes[0].name, "–", 4},
                 {"critical_friction_deg", "critical φ", "°", 4},
                 {"result", "without earthquake", "", 4}};
    const auto add = [&](const char* name, const sliding::WedgeState& s) {
        const bool lifts = s.mode == sliding::WedgeMode::lifts;
        const double mu = critical_first_friction(w.wedge, s);
        t.rows.push_back({std::string(name), mode_words(*scene.wedge, s.mode), trend(s.direction) / units::degree,
                          plunge(s.direction) / units::degree, s.drive / MN, s.resistance / MN,
                          finite_cell(s.factor_of_safety), finite_cell(mu), angle_of_friction(mu),
                          std::string(lifts                      ? "LIFTS"
                                      : s.factor_of_safety < 1.0 ? "SLIDES STATICALLY"
                                                                 : "stands")});
    };
    add("as given", w.still);
    if (w.still.cohesion > 0.0) {
        sliding::Wedge bare = w.wedge;
        bare.first.cohesion = bare.second.cohesion = 0.0;
        add("without cohesion", wedge_state(bare));
    }
    t.notes.push_back(
        "the way of sliding is found: along the line of intersection on both planes, on one of them, or lifting; "
        "critical μ: friction of " +
        scene.wedge->planes[0].name + " that just holds the wedge, the other plane keeping its share of it.");
    if (w.still.cohesion > 0.0)
        t.notes.push_back(w.yields.moving
                              ? "the first slip takes the cohesion away (wedge.cohesion_lost_at_slip)."
                              : "cohesion stays when the wedge slips (wedge.cohesion_lost_at_slip = false).");
    return t;
}

Table wedge_yield_table(const Scene& scene, const RigidWedge& wedge)
{
    Table t;
    t.title = "Yield acceleration of the wedge";
    t.columns = {{"motion", "ground motion", "", 4},
                 {"azimuth_deg", "drives towards", "°", 4},
                 {"yield_acceleration_m_s2", "a_y", "m/s²", 6},
                 {"yield_coefficient_g", "a_y", "g", 6},
                 {"mode", "slides on", "", 4},
                 {"trend_deg", "towards", "°", 4},
                 {"plunge_deg", "plunge", "°", 4},
                 {"slip_factor", "slip per excess", "–", 4},
                 {"yield_per_vertical", "a_y per a_v", "–", 4}};
    for (const WedgeYieldRow& row : wedge_yield_rows(wedge)) {
        const sliding::WedgeYield& y = row.yield;
        const Cell azimuth = row.azimuth ? Cell(*row.azimuth / units::degree) : Cell();
        if (std::isinf(y.acceleration)) {
            const std::string none = y.acceleration > 0.0 ? "not below 10 g" : "slides, even pushed back by 10 g";
            t.rows.push_back({row.motion, azimuth, Cell(), Cell(), none, Cell(), Cell(), Cell(), Cell()});
            continue;
        }
        t.rows.push_back({row.motion, azimuth, y.acceleration, y.acceleration / units::standard_gravity,
                          mode_words(*scene.wedge, y.state.mode), trend(y.state.direction) / units::degree,
                          plunge(y.state.direction) / units::degree, row.azimuth ? Cell(y.factor) : Cell(),
                          row.azimuth ? Cell(y.law.per_a_v) : Cell()});
    }
    t.notes.push_back(
        "horizontal rows: the ground accelerates away from the azimuth, the inertia of the wedge points to it; "
        "a_y per a_v: change of a_y with the ground acceleration upwards; negative a_y: slides without earthquake, and "
        "would just stand pushed the other way by as much.");
    return t;
}

Chart wedge_yield_chart(const RigidWedge& wedge, double largest_pga)
{
    Chart chart;
    chart.title = "Yield acceleration over the direction of the motion";
    chart.x = {"azimuth the motion drives to", "°", Scale::linear, 0.1, 0.0, 360.0, {}};
    chart.y = {"yield acceleration", "m/s²", Scale::linear, 0.1, {}, {}, {}};
    Curve curve{"a_y", {}, {}, {}, {}, Mark::line, Weight::strong, 0};
    double least = std::numeric_limits<double>::infinity();
    for (const double a : yields_over_azimuth(wedge.wedge)) {
        curve.x.push_back(5.0 * static_cast<double>(curve.x.size()));
        curve.y.push_back(a);
        if (std::isfinite(a)) least = std::min(least, a);
    }
    if (least >= 0.0) chart.y.low = 0.0;
    const double shown = std::max(4.0 * std::abs(least), 2.0 * largest_pga); // far above, the curve says nothing
    for (double& y : curve.y)
        if (!(std::abs(y) <= shown)) y = std::numeric_limits<double>::quiet_NaN();
    chart.curves.push_back(std::move(curve));
    chart.vertical.push_back({wedge.azimuth / units::degree, "records"});
    if (largest_pga > 0.0) chart.horizontal.push_back({largest_pga, "largest PGA"});
    chart.note = "No curve where the yield is far above what is shown, or none exists.";
    return chart;
}

} // namespace damslip::pages
