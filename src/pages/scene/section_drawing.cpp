#include "pages/scene/scene_pages.hpp"

#include "analysis/prepare/reservoir.hpp"
#include "core/units.hpp"
#include "pages/report/chart.hpp"
#include "scene/effect_plan.hpp"
#include "scene/section.hpp"
#include "scene/water.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::pages {

namespace {

constexpr double drawing_width = 760.0; // [px]

/// What the parts of the drawing have in common [m].
struct Frame {
    double left, right, bottom, top; ///< of the drawing
    double size;                     ///< the larger of height and base
    double crest;
    double uplift_depth; ///< length of the largest pressure below the base
    Point heel, toe;
};

double curtain_depth(const Scene& scene, double size)
{
    return scene.curtain ? std::min(scene.curtain->depth, 0.55 * size) : 0.0;
}

Frame make_frame(const Scene& scene, bool uplift)
{
    Frame f{};
    f.heel = heel(scene.section);
    f.toe = toe(scene.section);
    f.crest = crest_level(scene.section);
    double x_low = 0.0, x_high = 0.0, y_low = 0.0;
    for (const Point& p : scene.section.polygon) {
        x_low = std::min(x_low, p.x);
        x_high = std::max(x_high, p.x);
        y_low = std::min(y_low, p.y);
    }
    f.size = std::max(f.crest - y_low, x_high - x_low);
    const bool water = scene.reservoir || scene.silt;
    f.uplift_depth = uplift ? 0.26 * f.size : 0.0;
    f.left = x_low - (water ? 0.5 : 0.25) * f.size;
    f.right = x_high + 0.8 * f.size;
    const double surface = std::max({f.crest, scene.reservoir ? scene.reservoir->level : f.crest,
                                     scene.tailwater ? scene.tailwater->level : f.crest});
    f.top = surface + 0.13 * f.size;
    f.bottom =
        y_low - std::max({f.uplift_depth + 0.05 * f.size, curtain_depth(scene, f.size), 0.05 * f.size}) - 0.1 * f.size;
    return f;
}

/// The face up to a level, from its foot.
Polyline below(const Polyline& face, double level)
{
    Polyline part;
    for (std::size_t i = 0; i < face.size(); ++i) {
        if (face[i].y <= level) {
            part.push_back(face[i]);
            continue;
        }
        if (i > 0 && face[i - 1].y < level) {
            const double q = (level - face[i - 1].y) / (face[i].y - face[i - 1].y);
            part.push_back({face[i - 1].x + q * (face[i].x - face[i - 1].x), level});
        }
        break;
    }
    return part;
}

/// What fills the space between a face, the ground and a level, out to `far`.
Polyline pool(const Polyline& face, double ground, double level, double far)
{
    Polyline shape{{far, ground}};
    const Polyline wet = below(face, level);
    shape.insert(shape.end(), wet.begin(), wet.end());
    if (!wet.empty()) shape.push_back({wet.back().x, level});
    shape.push_back({far, level});
    return shape;
}

/// Water on a face out to `far`, with its surface and a mark of the level. @param mark  where that stands
void draw_water(Sketch& sketch, const Polyline& face, Point foot, double level, double far, double mark)
{
    if (level <= foot.y) return;
    sketch.polygon(pool(face, foot.y, level, far), "water");
    const Polyline wet = below(face, level);
    const double shore = wet.empty() ? foot.x : wet.back().x;
    sketch.line({{std::min(far, shore), level}, {std::max(far, shore), level}}, "water-line");
    sketch.level_mark({mark, level}, fmt::format("{:.4g} m", level), Align::start);
}

void draw_pools(Sketch& sketch, const Scene& scene, const Frame& f)
{
    const Polyline up = upstream_face(scene.section), down = downstream_face(scene.section);
    if (scene.reservoir) draw_water(sketch, up, f.heel, scene.reservoir->level, f.left, f.left + 0.2 * f.size);
    if (scene.silt && scene.silt->level > f.heel.y) {
        sketch.polygon(pool(up, f.heel.y, scene.silt->level, f.left), "silt");
        sketch.text({f.left, scene.silt->level}, fmt::format("silt {:.4g} m", scene.silt->level), Align::start, 6, -5);
    }
    if (scene.tailwater) draw_water(sketch, down, f.toe, scene.tailwater->level, f.right, f.right - 0.25 * f.size);
}

void draw_ground(Sketch& sketch, const Frame& f)
{
    const double d = sketch.metres(9);
    const auto hatch = [&](double from, double to, double y) {
        for (double x = from; x < to - 0.5 * d; x += 1.6 * d) sketch.line({{x + d, y}, {x, y - d}}, "hatch");
    };
    hatch(f.left, f.heel.x - 1.5 * d, f.heel.y);
    hatch(f.toe.x + d, f.right, f.toe.y);
    sketch.line({{f.left, f.heel.y}, f.heel, f.toe, {f.right, f.toe.y}}, "rock");
}

/// The pressure figure hanging below the base, pressures [kPa] at its corners.
void draw_uplift(Sketch& sketch, const Scene& scene, const Frame& f, const PressureProfile& profile)
{
    double largest = 0.0;
    for (const auto& p : profile.points) largest = std::max(largest, p.pressure);
    if (!(largest > 0.0)) return;
    const double theta = base_inclination(scene.section);
    const Point t{std::cos(theta), -std::sin(theta)}, n{std::sin(theta), std::cos(theta)};
    const auto at = [&](double s, double p) {
        const double depth = p / largest * f.uplift_depth;
        return Point{s * t.x - depth * n.x, s * t.y - depth * n.y};
    };
    const double length = base_length(scene.section);
    Polyline shape{at(0, 0)};
    for (const auto& p : profile.points) shape.push_back(at(p.distance, p.pressure));
    shape.push_back(at(length, 0));
    sketch.polygon(shape, "uplift");
    for (int k = 1; k < 14; ++k) {
        const double s = length * k / 14, p = pressure_at(profile, s);
        if (p / largest * f.uplift_depth > sketch.metres(14)) sketch.arrow(at(s, p), at(s, 0), "uplift-arrow", 6);
    }
    const auto words = [](double p) { return fmt::format("{:.4g} kPa", p / units::kPa); };
    const auto& points = profile.points;
    sketch.text(at(0, points.front().pressure), words(points.front().pressure), Align::end, -5, 2, "small halo");
    for (std::size_t i = 1; i < points.size(); ++i) {
        const bool jump = points[i].distance == points[i - 1].distance;
        const bool fall = jump && points[i].pressure < points[i - 1].pressure;
        if (fall)
            sketch.text(at(points[i - 1].distance, points[i - 1].pressure), words(points[i - 1].pressure), Align::start,
                        13, 2, "small halo");
        const bool few = points.size() <= 5 && i + 1 < points.size();
        if (jump || few)
            sketch.text(at(points[i].distance, points[i].pressure), words(points[i].pressure), Align::start, 13, 14,
                        "small halo");
    }
    if (points.back().pressure > 0.005 * largest)
        sketch.text(at(length, points.back().pressure), words(points.back().pressure), Align::start, 6, 6,
                    "small halo");
    sketch.text(at(length, 0.8 * largest), fmt::format("uplift U = {:.0f} kN/m", resultant(profile).force / 1e3),
                Align::start, 6, 0);
}

void draw_curtain_and_drains(Sketch& sketch, const Scene& scene, const Frame& f)
{
    const double slope = -std::tan(base_inclination(scene.section));
    if (scene.curtain) {
        const double depth = curtain_depth(scene, f.size), x0 = scene.curtain->distance,
                     x1 = x0 + std::max(scene.curtain->thickness, sketch.metres(3)), y = slope * x0;
        sketch.polygon({{x0, y}, {x1, y}, {x1, y - depth}, {x0, y - depth}},
                       scene.curtain->intact ? "curtain" : "curtain broken");
        sketch.text({x1, y - depth},
                    fmt::format("{} {:.4g} m{}", scene.curtain->intact ? "curtain" : "ruptured curtain",
                                scene.curtain->depth, depth < scene.curtain->depth ? " (cut off)" : ""),
                    Align::start, 6, 0);
    }
    if (!drains_are_read(scene)) return;
    const double x = scene.drains->distance, y = slope * x,
                 depth = std::min(scene.drains->depth.value_or(0.2 * f.size), 0.55 * f.size);
    const double from = scene.drains->gallery_level.value_or(y);
    sketch.line({{x, std::max(from, y)}, {x, y - depth}}, "drain");
    if (scene.drains->gallery_level) {
        sketch.circle({x, *scene.drains->gallery_level}, 5, "dimension");
        sketch.text({x, *scene.drains->gallery_level}, "gallery", Align::start, 8, 4);
    }
    sketch.text({x, y - depth}, fmt::format("drains, E = {:.3g}", scene.drains->efficiency), Align::start, 6, 12);
}

void draw_lift_joints(Sketch& sketch, const Scene& scene)
{
    for (const LiftJoint& joint : scene.lift_joints) {
        if (!joint.path.empty()) {
            sketch.line(joint.path, "joint");
            sketch.text(joint.path.back(), joint.name, Align::start, 7, 4, "small halo");
            continue;
        }
        const Polyline up = below(upstream_face(scene.section), joint.elevation),
                       down = below(downstream_face(scene.section), joint.elevation);
        if (up.empty() || down.empty()) continue;
        sketch.line({up.back(), down.back()}, "joint");
        sketch.text(down.back(),
                    fmt::format("{} {:.4g} m, μ = {:.3g}", joint.name.empty() ? "lift joint" : joint.name,
                                joint.elevation, joint.strength.friction),
                    Align::start, 7, 4, "small halo");
    }
}

/// Each across its joint, as far up as the dam goes and down as the picture does; its ends are no data of the scene.
void draw_anchors(Sketch& sketch, const Scene& scene, const Frame& f)
{
    for (const Anchor& anchor : scene.anchors) {
        const double theta = anchor.joint.empty() ? base_inclination(scene.section) : 0.0;
        Point at{anchor.distance * std::cos(theta), -anchor.distance * std::sin(theta)};
        for (const LiftJoint& joint : scene.lift_joints) {
            if (joint.name != anchor.joint) continue;
            const Polyline up = below(upstream_face(scene.section), joint.elevation);
            at = {(up.empty() ? 0.0 : up.back().x) + anchor.distance, joint.elevation};
        }
        const double x = std::sin(anchor.inclination + theta), y = std::cos(anchor.inclination + theta);
        if (!(y > 0.05)) continue; // almost along the joint
        const double rise = std::min(0.7 * anchor.free_length, (f.crest - at.y) / y),
                     fall =
                         std::min(std::max(0.3 * anchor.free_length, sketch.metres(10)), 0.5 * (at.y - f.bottom) / y);
        const Point head{at.x + rise * x, at.y + rise * y};
        sketch.line({{at.x - fall * x, at.y - fall * y}, head}, "force");
        sketch.circle(head, 3, "force");
        const std::string force = anchor.prestress > 0.0 ? fmt::format(", P₀ {:.4g} kN/m", anchor.prestress / 1e3) : "";
        sketch.text(head, anchor.name + force, Align::start, 7, 4, "small halo");
    }
}

void draw_forces(Sketch& sketch, const Scene& scene)
{
    if (scene.ice) {
        const Polyline face = below(upstream_face(scene.section), scene.ice->level);
        const double x = face.empty() ? 0.0 : face.back().x, y = scene.ice->level;
        sketch.arrow({x - sketch.metres(55), y}, {x, y}, "force");
        sketch.text({x, y}, fmt::format("ice {:.4g} kN/m", scene.ice->force / 1e3), Align::end, -60, 4);
    }
    for (const PointForce& force : scene.forces) {
        const double size = std::hypot(force.force_x, force.force_y), arm = sketch.metres(50);
        if (!(size > 0)) continue;
        const Point tail{force.at.x - arm * force.force_x / size, force.at.y - arm * force.force_y / size};
        sketch.arrow(tail, force.at, "force");
        sketch.text(tail, force.name + fmt::format(" {:.4g} kN/m", size / 1e3),
                    force.force_x > 0 ? Align::end : Align::start, force.force_x > 0 ? -4 : 4, -4);
    }
}

void draw_dimensions(Sketch& sketch, const Scene& scene, const Frame& f)
{
    const Point crest_up = upstream_face(scene.section).back(), crest_down = downstream_face(scene.section).back();
    if (crest_down.x - crest_up.x > sketch.metres(12))
        sketch.dimension(crest_up, crest_down, 16, fmt::format("{:.4g} m", crest_down.x - crest_up.x));
    double far = f.toe.x;
    for (const Point& p : scene.section.polygon) far = std::max(far, p.x);
    sketch.line({{crest_down.x, f.crest}, {far, f.crest}}, "dimension");
    sketch.dimension({far, std::min(f.heel.y, f.toe.y)}, {far, f.crest}, -24,
                     fmt::format("{:.4g} m", f.crest - std::min(f.heel.y, f.toe.y)));
    const double low = f.bottom + sketch.metres(12);
    const double theta = base_inclination(scene.section);
    std::string words = fmt::format("base {:.4g} m", base_length(scene.section));
    if (std::abs(theta) > 1e-12)
        words += fmt::format(", {:.3g}° {}", std::abs(theta) / units::degree, theta > 0 ? "down" : "up");
    sketch.dimension({f.heel.x, low}, {f.toe.x, low}, 0, words);
}

/// Axes and what is positive, in the free corner above the downstream side.
void draw_signs(Sketch& sketch, const Frame& f)
{
    const auto m = [&](double px) { return sketch.metres(px); };
    double x = f.right - m(222), y = f.crest - m(48);
    sketch.arrow({x, y}, {x + m(44), y}, "axis");
    sketch.text({x + m(44), y}, "x downstream", Align::start, 5, 4);
    sketch.arrow({x, y}, {x, y + m(40)}, "axis");
    sketch.text({x, y + m(40)}, "y up", Align::start, 7, 6);
    sketch.text({x, y}, "heel at the origin", Align::start, 0, 19, "small halo");
    y -= m(46);
    sketch.arrow({x + m(44), y}, {x, y}, "ground");
    sketch.text({x + m(44), y}, "a_h > 0: ground upstream,", Align::start, 6, 4, "small halo");
    sketch.text({x + m(44), y}, "drives the dam downstream", Align::start, 6, 18, "small halo");
    y -= m(62);
    sketch.arrow({x + m(22), y}, {x + m(22), y + m(32)}, "ground");
    sketch.text({x + m(44), y}, "a_v > 0: ground up", Align::start, 6, -10, "small halo");
    sketch.text({x + m(44), y}, "slip > 0: dam downstream", Align::start, 6, 10, "small halo");
}

} // namespace

Drawing section_drawing(const Scene& scene, const PressureProfile& uplift, const std::vector<Polyline>& mesh)
{
    const bool wet = std::ranges::any_of(uplift.points, [](const auto& p) { return p.pressure > 0; });
    const Frame f = make_frame(scene, wet);
    Sketch sketch({f.left, f.bottom}, {f.right, f.top}, drawing_width);
    draw_pools(sketch, scene, f);
    sketch.polygon(scene.section.polygon, "concrete");
    if (!mesh.empty()) sketch.lines(mesh, "mesh");
    if (wet) draw_uplift(sketch, scene, f, uplift);
    draw_ground(sketch, f);
    draw_curtain_and_drains(sketch, scene, f);
    draw_lift_joints(sketch, scene);
    draw_anchors(sketch, scene, f);
    draw_forces(sketch, scene);
    draw_dimensions(sketch, scene, f);
    sketch.begin_group("signs"); // a narrow screen has no room for them
    draw_signs(sketch, f);
    sketch.end_group();
    std::string note = "x downstream, y up; a_h > 0: ground upstream, drives the dam downstream; slip > 0: downstream.";
    if (wet)
        note += fmt::format(" Below the base: uplift pressure {}.",
                            mesh.empty() ? "of the yield acceleration" : "before the earthquake");
    return {"The section, to scale",
            sketch.svg(fmt::format("Cross-section, {:.4g} m high, base {:.4g} m, with water levels and uplift "
                                   "pressure along the base",
                                   f.crest, base_length(scene.section))),
            note};
}

std::string drawn_section(const Scene& given)
{
    const Scene scene = called_for(make_effect_plan(given, Method::rigid_block), given);
    return standalone_svg(section_drawing(scene, SeepageSource().uplift_of(scene)).svg);
}

} // namespace damslip::pages
