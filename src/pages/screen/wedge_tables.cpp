#include "pages/screen/screen_pages.hpp"

#include "core/units.hpp"
#include "pages/report/chart.hpp"
#include "scene/rock_wedge.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

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
         {{"normal_force_MN", "N′", "MN", 5}, &Row::normal, MN}},
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
    const auto if_it_exists = [=](auto value) {
        return [=](const R& r) { return exists(r) ? cell_of(value(r)) : Cell(); };
    };
    const auto mode = [&](const R& r) -> std::string {
        if (exists(r)) return mode_words(*scene.wedge, r.yield.state.mode);
        return r.yield.acceleration > 0.0 ? "not below 10 g" : "slides, even pushed back by 10 g";
    };
    return table_of<R>(
        "Yield acceleration of the wedge",
        {{{"motion", "ground motion"}, &R::motion},
         {{"azimuth_deg", "drives towards", "°", 4}, &R::azimuth, units::degree},
         {{"yield_acceleration_m_s2", "a_y", "m/s²", 6}, if_it_exists([](const R& r) { return r.yield.acceleration; })},
         {{"yield_coefficient_g", "a_y", "g", 6},
          if_it_exists([](const R& r) { return r.yield.acceleration / units::standard_gravity; })},
         {{"mode", "slides on"}, mode},
         {{"trend_deg", "towards", "°", 4},
          if_it_exists([](const R& r) { return trend(r.yield.state.direction) / units::degree; })},
         {{"plunge_deg", "plunge", "°", 4},
          if_it_exists([](const R& r) { return plunge(r.yield.state.direction) / units::degree; })},
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
    Chart chart{"Yield acceleration over the direction of the motion",
                {.label = "azimuth the motion drives to", .unit = "°", .low = 0.0, .high = 360.0},
                {"yield acceleration", "m/s²"}};
    Curve curve{.name = "a_y", .weight = Weight::strong, .colour = 0};
    double least = std::numeric_limits<double>::infinity();
    for (const double a : yields_over_azimuth(wedge.wedge)) {
        curve.add(5.0 * static_cast<double>(curve.x.size()), a);
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

namespace {

constexpr double wedge_drawing_width = 760.0; // [px]

/// A direction on the net of radius 1: equal-area projection of the lower hemisphere.
Point on_net(Vector3 d)
{
    d = unit(d);
    if (d[2] > 0.0) d = sum({}, -1.0, d);
    const double r = std::numbers::sqrt2 * std::sin(0.5 * (0.5 * std::numbers::pi - plunge(d)));
    return {r * std::sin(trend(d)), r * std::cos(trend(d))};
}

Polyline great_circle(double dip, double dip_direction)
{
    const Vector3 strike = line_direction(dip_direction - 0.5 * std::numbers::pi, 0.0),
                  down = line_direction(dip_direction, dip);
    Polyline points;
    for (int k = 0; k <= 60; ++k) {
        const double a = std::numbers::pi * k / 60.0;
        Vector3 d = sum(sum({}, std::cos(a), strike), std::sin(a), down);
        if (k == 0 || k == 60) { // the ends lie on the rim, each on its side
            points.push_back({d[0], d[1]});
            continue;
        }
        points.push_back(on_net(d));
    }
    return points;
}

std::string orientation(double dip, double direction)
{
    return fmt::format("{:.4g}/{:03.0f}", dip / units::degree, direction / units::degree);
}

void draw_net(Sketch& sketch)
{
    Polyline rim;
    for (int k = 0; k <= 120; ++k)
        rim.push_back({std::sin(std::numbers::pi * k / 60.0), std::cos(std::numbers::pi * k / 60.0)});
    sketch.line(rim, "whisker");
    for (int a = 0; a < 360; a += 30) {
        const Point rim_at{std::sin(a * units::degree), std::cos(a * units::degree)};
        sketch.line({{0.97 * rim_at.x, 0.97 * rim_at.y}, {1.03 * rim_at.x, 1.03 * rim_at.y}}, "dimension");
        sketch.text({1.1 * rim_at.x, 1.1 * rim_at.y}, a == 0 ? "N" : fmt::format("{}°", a), Align::middle, 0, 5,
                    "small halo");
    }
    sketch.line({{-0.03, 0.0}, {0.03, 0.0}}, "dimension");
    sketch.line({{0.0, -0.03}, {0.0, 0.03}}, "dimension");
}

/// One line of the legend, right of the net.
void legend(Sketch& sketch, int row, const std::string& css, const std::string& words)
{
    const Point at{1.32, 0.95 - 0.13 * row};
    if (css == "force" || css == "ground")
        sketch.arrow({at.x, at.y}, {at.x + 0.16, at.y}, css, 7);
    else if (css == "dot")
        sketch.circle({at.x + 0.08, at.y}, 5, "axis");
    else
        sketch.line({at, {at.x + 0.16, at.y}}, css);
    sketch.text({at.x + 0.16, at.y}, words, Align::start, 7, 4, "small");
}

} // namespace

Drawing stereonet(const Scene& scene, const RigidWedge& w)
{
    const RockWedge& given = *scene.wedge;
    Sketch sketch({-1.3, -1.25}, {3.35, 1.25}, wedge_drawing_width);
    draw_net(sketch);
    int row = 0;
    const auto plane = [&](const std::string& name, double dip, double direction, const char* css) {
        const Polyline circle = great_circle(dip, direction);
        sketch.line(circle, css);
        legend(sketch, row++, css, name + " " + orientation(dip, direction));
    };
    if (given.face_dip && given.face_dip_direction) {
        plane("face", *given.face_dip, *given.face_dip_direction, "rock");
        if (given.upper_dip.value_or(0.0) > 0.0)
            plane("upper ground", *given.upper_dip, given.upper_dip_direction.value_or(*given.face_dip_direction),
                  "hatch");
    }
    const char* planes[] = {"water-line", "drain"};
    for (std::size_t i = 0; i < 2; ++i) {
        const RockPlane& p = given.planes[i];
        plane(p.name, p.dip, p.dip_direction, planes[i]);
        sketch.text(on_net(line_direction(p.dip_direction, p.dip)), p.name, Align::middle, 0, -5, "small halo");
    }
    Vector3 line = unit(cross(plane_normal(given.planes[0].dip, given.planes[0].dip_direction),
                              plane_normal(given.planes[1].dip, given.planes[1].dip_direction)));
    if (line[2] > 0.0) line = sum({}, -1.0, line);
    sketch.circle(on_net(line), 5, "axis");
    legend(sketch, row++, "dot", "line of intersection, " + direction_words(line));
    if (w.still.mode != sliding::WedgeMode::lifts) {
        sketch.arrow({0.0, 0.0}, on_net(w.still.direction), "force");
        legend(sketch, row++, "force", "slides " + direction_words(w.still.direction));
        legend(sketch, row++, "none", "on " + mode_words(given, w.still.mode));
    } else {
        legend(sketch, row++, "none", "lifts off both planes");
    }
    const Point rim = on_net(w.push);
    sketch.arrow({0.86 * rim.x, 0.86 * rim.y}, {1.0 * rim.x, 1.0 * rim.y}, "ground");
    legend(sketch, row++, "ground", fmt::format("records, a_h > 0 drives towards {:.0f}°", w.azimuth / units::degree));
    return {"Stereonet",
            sketch.svg("Stereonet with the great circles of both planes, their line of intersection and the way the "
                       "wedge slides, " +
                       direction_words(w.still.direction)),
            "Lower hemisphere, equal area. Dip/dip direction."};
}

namespace {

/// Orthographic view from before the face, turned a little aside and looking down.
class View {
public:
    explicit View(double face_direction)
    {
        const Vector3 to_viewer = line_direction(face_direction + 28.0 * units::degree, -24.0 * units::degree);
        right_ = unit(cross({0.0, 0.0, 1.0}, to_viewer));
        up_ = cross(to_viewer, right_);
    }
    Point operator()(const Vector3& p) const { return {dot(p, right_), dot(p, up_)}; }

private:
    Vector3 right_, up_;
};

/// Corners of the slope around the wedge: crest to both sides, foot of the face below, edge of the upper ground behind.
struct Surroundings {
    Vector3 crest_a, crest_b, foot_a, foot_b, back_a, back_b;
};

Surroundings surroundings(const RockWedge& w, const WedgeShape& s, double height)
{
    const double aside = 0.35;
    const Vector3 crest = sum(s.second_crest, -1.0, s.first_crest);
    const Vector3 a = sum(s.first_crest, -aside, crest), b = sum(s.second_crest, aside, crest);
    const Vector3 down = line_direction(*w.face_dip_direction, *w.face_dip);
    const double upper_direction = w.upper_dip_direction.value_or(*w.face_dip_direction);
    const Vector3 rise = line_direction(upper_direction + std::numbers::pi, -w.upper_dip.value_or(0.0));
    const auto below = [&](const Vector3& p) { return sum(p, (p[2] + 0.15 * height) / std::sin(*w.face_dip), down); };
    // Far enough that the back edge lies behind the top of the wedge.
    const Vector3 back = line_direction(*w.face_dip_direction + std::numbers::pi, 0.0);
    const double depth = 1.25 * std::max(dot(sum(s.top, -1.0, a), back), dot(sum(s.top, -1.0, b), back)) /
                         std::max(0.2, dot(rise, back));
    return {a, b, below(a), below(b), sum(a, depth, rise), sum(b, depth, rise)};
}

} // namespace

std::optional<Drawing> wedge_drawing(const Scene& scene, const RigidWedge& w)
{
    const auto shape = wedge_shape(*scene.wedge);
    if (!shape) return std::nullopt;
    const View view(*scene.wedge->face_dip_direction);
    const double height = *scene.wedge->height;
    const Surroundings s = surroundings(*scene.wedge, *shape, height);
    const Point origin = view({}), top = view(shape->top), first = view(shape->first_crest),
                second = view(shape->second_crest);
    const Vector3 middle = sum({}, 1.0 / 3.0, sum(shape->first_crest, 1.0, shape->second_crest));
    const Point from = view(middle), to = view(sum(middle, 0.45 * height, w.still.direction));
    Polyline all{view(s.crest_a), view(s.crest_b), view(s.foot_a), view(s.foot_b), view(s.back_a), view(s.back_b), to};
    Point low = all.front(), high = all.front();
    for (const Point& p : all) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    const double margin = 0.06 * (high.x - low.x);
    Sketch sketch({low.x - margin, low.y - margin}, {high.x + margin, high.y + margin}, wedge_drawing_width);
    sketch.line({view(s.back_a), view(s.crest_a), view(s.foot_a), view(s.foot_b), view(s.crest_b), view(s.back_b),
                 view(s.back_a)},
                "rock");
    sketch.line({view(s.crest_a), view(s.crest_b)}, "rock");
    sketch.polygon({top, first, second}, "concrete");
    sketch.polygon({origin, first, second}, "concrete");
    sketch.line({origin, top}, "joint");
    const auto label = [&](Point a, Point b, const std::string& words, Align align, double aside) {
        sketch.text({0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}, words, align, aside, 0, "halo");
    };
    const bool first_left = first.x < second.x;
    label(origin, first, scene.wedge->planes[0].name, first_left ? Align::end : Align::start, first_left ? -8 : 8);
    label(origin, second, scene.wedge->planes[1].name, first_left ? Align::start : Align::end, first_left ? 8 : -8);
    sketch.text(view(s.foot_a),
                fmt::format("face {}", orientation(*scene.wedge->face_dip, *scene.wedge->face_dip_direction)),
                view(s.foot_a).x < view(s.foot_b).x ? Align::start : Align::end,
                view(s.foot_a).x < view(s.foot_b).x ? 8 : -8, -8, "small halo");
    sketch.text(top, "upper end of the line", Align::middle, 0, -8, "small halo");
    if (w.still.mode != sliding::WedgeMode::lifts) {
        sketch.arrow(from, to, "force");
        sketch.text(to, "slides", Align::start, 6, 10);
    }
    return Drawing{
        "The wedge in its slope",
        sketch.svg(fmt::format("The wedge of {:.4g} cubic metres between both planes, face and upper ground, with "
                               "the way it slides",
                               shape->volume)),
        fmt::format("Seen from before the face and from above, to scale. Dashed: the line of intersection inside the "
                    "rock, {:.4g} m high, {:.4g} m long. Volume {:.5g} m³, areas {:.5g} and {:.5g} m².",
                    height, norm(shape->top), shape->volume, shape->first_area, shape->second_area)};
}

} // namespace damslip::pages
