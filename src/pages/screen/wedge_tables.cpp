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
    struct Row {
        std::string name;
        const sliding::WedgePlane& plane;
        double normal;
    };
    const std::vector<Row> rows{{scene.wedge->planes[0].name, wedge.wedge.first, wedge.still.first_normal},
                                {scene.wedge->planes[1].name, wedge.wedge.second, wedge.still.second_normal}};
    Table t = table_of<Row>(
        "Planes of the wedge",
        {{{"plane", "plane"}, &Row::name},
         {{"dip_deg", "dip", "°", 4}, [](const Row& r) { return r.plane.dip / units::degree; }},
         {{"dip_direction_deg", "dip direction", "°", 4},
          [](const Row& r) { return r.plane.dip_direction / units::degree; }},
         {{"area_m2", "area", "m²", 5}, [](const Row& r) { return r.plane.area; }},
         {{"friction", "μ", "–", 4}, [](const Row& r) { return r.plane.friction; }},
         {{"friction_deg", "φ", "°", 4}, [](const Row& r) { return angle_of_friction(r.plane.friction); }},
         {{"cohesion_kPa", "cohesion", "kPa", 4}, [](const Row& r) { return r.plane.cohesion / units::kPa; }},
         {{"water_force_MN", "water U", "MN", 5}, [](const Row& r) { return r.plane.water_force / MN; }},
         {{"normal_force_MN", "N′", "MN", 5}, [](const Row& r) { return r.normal / MN; }}},
        rows);
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
    struct Row {
        const char* name;
        sliding::WedgeState state;
        double critical_friction;
    };
    const RigidWedge& w = *model.wedge;
    std::vector<Row> rows{{"as given", w.still, critical_first_friction(w.wedge, w.still)}};
    if (w.still.cohesion > 0.0) {
        sliding::Wedge bare = w.wedge;
        bare.first.cohesion = bare.second.cohesion = 0.0;
        const sliding::WedgeState state = wedge_state(bare);
        rows.push_back({"without cohesion", state, critical_first_friction(w.wedge, state)});
    }
    const auto result = [](const Row& r) {
        if (r.state.mode == sliding::WedgeMode::lifts) return "LIFTS";
        return r.state.factor_of_safety < 1.0 ? "SLIDES STATICALLY" : "stands";
    };
    Table t = table_of<Row>(
        "The wedge without earthquake",
        {{{"state", "state"}, &Row::name},
         {{"mode", "slides on"}, [&](const Row& r) { return mode_words(*scene.wedge, r.state.mode); }},
         {{"trend_deg", "towards", "°", 4}, [](const Row& r) { return trend(r.state.direction) / units::degree; }},
         {{"plunge_deg", "plunge", "°", 4}, [](const Row& r) { return plunge(r.state.direction) / units::degree; }},
         {{"drive_MN", "drive", "MN", 5}, [](const Row& r) { return r.state.drive / MN; }},
         {{"resistance_MN", "resistance", "MN", 5}, [](const Row& r) { return r.state.resistance / MN; }},
         {{"factor_of_safety", "factor of safety", "–", 4},
          [](const Row& r) { return finite_cell(r.state.factor_of_safety); }},
         {{"critical_friction", "critical μ of " + scene.wedge->planes[0].name, "–", 4},
          [](const Row& r) { return finite_cell(r.critical_friction); }},
         {{"critical_friction_deg", "critical φ", "°", 4},
          [](const Row& r) { return angle_of_friction(r.critical_friction); }},
         {{"result", "without earthquake"}, result}},
        rows);
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
    using R = WedgeYieldRow;
    const auto exists = [](const R& r) { return !std::isinf(r.yield.acceleration); }; // below 10 g
    const auto mode = [&](const R& r) -> std::string {
        if (exists(r)) return mode_words(*scene.wedge, r.yield.state.mode);
        return r.yield.acceleration > 0.0 ? "not below 10 g" : "slides, even pushed back by 10 g";
    };
    return table_of<R>(
        "Yield acceleration of the wedge",
        {{{"motion", "ground motion"}, &R::motion},
         {{"azimuth_deg", "drives towards", "°", 4},
          [](const R& r) { return optional_cell(r.azimuth, units::degree); }},
         {{"yield_acceleration_m_s2", "a_y", "m/s²", 6},
          [=](const R& r) { return exists(r) ? Cell(r.yield.acceleration) : Cell(); }},
         {{"yield_coefficient_g", "a_y", "g", 6},
          [=](const R& r) { return exists(r) ? Cell(r.yield.acceleration / units::standard_gravity) : Cell(); }},
         {{"mode", "slides on"}, mode},
         {{"trend_deg", "towards", "°", 4},
          [=](const R& r) { return exists(r) ? Cell(trend(r.yield.state.direction) / units::degree) : Cell(); }},
         {{"plunge_deg", "plunge", "°", 4},
          [=](const R& r) { return exists(r) ? Cell(plunge(r.yield.state.direction) / units::degree) : Cell(); }},
         {{"slip_factor", "slip per excess", "–", 4},
          [=](const R& r) { return exists(r) && r.azimuth ? Cell(r.yield.factor) : Cell(); }},
         {{"yield_per_vertical", "a_y per a_v", "–", 4},
          [=](const R& r) { return exists(r) && r.azimuth ? Cell(r.yield.law.per_a_v) : Cell(); }}},
        wedge_yield_rows(wedge),
        {"horizontal rows: the ground accelerates away from the azimuth, the inertia of the wedge points to it; "
         "a_y per a_v: change of a_y with the ground acceleration upwards; negative a_y: slides without earthquake, "
         "and would just stand pushed the other way by as much."});
}

Chart wedge_yield_chart(const RigidWedge& wedge, double largest_pga)
{
    Chart chart;
    chart.title = "Yield acceleration over the direction of the motion";
    chart.x = {"azimuth the motion drives to", "°", Scale::linear, 0.1, 0.0, 360.0, {}};
    chart.y = {"yield acceleration", "m/s²"};
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
