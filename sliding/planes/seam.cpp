#include "sliding/planes/seam.hpp"

#include "core/input_error.hpp"
#include "scene/joint_bond.hpp"
#include "scene/section.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/equilibrium/base_state.hpp"
#include "sliding/loads/added_mass.hpp"
#include "sliding/planes/chain.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <tuple>

namespace damslip::sliding {

namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();
constexpr double degree = std::numbers::pi / 180.0;

[[noreturn]] void refuse(const Seam& seam, const std::string& problem, const std::string& expected, const std::string& fix)
{
    throw InputError(Diagnostic{"", 0, 0, fmt::format("seam \"{}\": {}", seam.name, problem), expected, fix});
}

double distance(Point a, Point b)
{
    return std::hypot(b.x - a.x, b.y - a.y);
}

/// Where a ray that starts below the surface meets it; none: it does not rise to it within 100 km.
std::optional<Point> meets(const Polyline& surface, Point from, double cosine, double sine)
{
    constexpr double far = 1e5;
    const Point before{std::min(surface.front().x, from.x) - far, surface.front().y},
        after{std::max(surface.back().x, from.x) + far, surface.back().y};
    std::optional<double> nearest;
    for (std::size_t i = 0; i <= surface.size(); ++i) {
        const Point a = i > 0 ? surface[i - 1] : before, b = i < surface.size() ? surface[i] : after,
                    along{b.x - a.x, b.y - a.y}, to{a.x - from.x, a.y - from.y};
        const double determinant = cosine * along.y - sine * along.x;
        if (determinant == 0.0) continue;
        const double reach = (to.x * along.y - to.y * along.x) / determinant;
        const double share = (to.x * sine - to.y * cosine) / determinant;
        if (reach > 1e-9 && share >= -1e-12 && share <= 1.0 + 1e-12 && (!nearest || reach < *nearest)) nearest = reach;
    }
    if (!nearest) return std::nullopt;
    return Point{from.x + *nearest * cosine, from.y + *nearest * sine};
}

/// Points of the surface from one to the other of its points, in the order of x.
Polyline surface_between(const Polyline& surface, Point from, Point to)
{
    Polyline part;
    part.reserve(surface.size() + 2);
    part.push_back(from);
    for (const Point p : surface)
        if (p.x > from.x && p.x < to.x) part.push_back(p);
    if (part.back() != to) part.push_back(to);
    return part;
}

/// The surface without the base of the dam: upstream and downstream of it.
void add_ground_water(const Scene& scene, const Polyline& top, Force& load)
{
    const Point first = heel(scene.section), last = toe(scene.section);
    const auto press = [&](Polyline face, double level) {
        if (face.size() > 1)
            load += hydrostatic_load(face, DamSide::right, level, water_unit_weight(scene)).total();
    };
    if (scene.reservoir && top.front().x < first.x)
        press(surface_between(top, top.front(), top.back().x > first.x ? first : top.back()), scene.reservoir->level);
    if (scene.tailwater && top.back().x > last.x)
        press(surface_between(top, top.front().x < last.x ? last : top.front(), top.back()), scene.tailwater->level);
}

struct Heads {
    double entry = 0.0, exit = 0.0; ///< water levels at both ends of the path [m]
};

/// Path distance at which the drains meet the seam; none: no drains there.
std::optional<double> drains_on(const Scene& scene, const Polyline& surface, const Polyline& path)
{
    if (!scene.drains) return std::nullopt;
    const double x = scene.drains->distance;
    const double depth = scene.drains->depth ? *scene.drains->depth
                         : scene.curtain     ? 0.5 * scene.curtain->depth
                                             : 0.25 * base_length(scene.section);
    double before = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i) {
        const Point a = path[i - 1], b = path[i];
        if (x >= a.x && x <= b.x) {
            const double share = (x - a.x) / (b.x - a.x), y = a.y + share * (b.y - a.y);
            if (y < ground_level(surface, x) - depth * (1.0 + 1e-12)) return std::nullopt;
            return before + share * distance(a, b);
        }
        before += distance(a, b);
    }
    return std::nullopt;
}

/// Pressure along the path, never below zero. @param heads  x: distance, ascending [m]; linear between them
PressureProfile pressure_along(const Polyline& path, const std::vector<Point>& heads, double unit_weight)
{
    const auto head_at = [&](double s) {
        for (std::size_t i = 1; i < heads.size(); ++i)
            if (s <= heads[i].x)
                return heads[i - 1].y + (heads[i].y - heads[i - 1].y) * (s - heads[i - 1].x) / (heads[i].x - heads[i - 1].x);
        return heads.back().y;
    };
    PressureProfile wet; // suction is no pressure: corners where the line passes zero
    ProfilePoint last;   // with its suction
    wet.points.reserve(path.size() + 2 * heads.size());
    const auto add = [&](double s, double y) {
        if (!wet.points.empty() && s <= last.distance) return;
        const ProfilePoint p{s, unit_weight * (head_at(s) - y)}, q = last;
        if (!wet.points.empty() && (q.pressure < 0.0) != (p.pressure < 0.0) && q.pressure != 0.0 && p.pressure != 0.0)
            wet.points.push_back(
                {q.distance + (p.distance - q.distance) * q.pressure / (q.pressure - p.pressure), 0.0});
        wet.points.push_back({p.distance, std::max(0.0, p.pressure)});
        last = p;
    };
    double start = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i) {
        const Point a = path[i - 1], b = path[i];
        const double length = distance(a, b);
        const auto add_at = [&](double s) { add(s, a.y + (b.y - a.y) * (s - start) / length); };
        add_at(start);
        for (const Point& h : heads)
            if (h.x > start && h.x < start + length) add_at(h.x);
        add_at(start + length);
        start += length;
    }
    return wet;
}

PressureProfile seam_pressure(const Scene& scene, const Seam& seam, const Polyline& surface, const Polyline& path, Heads ends,
                              DrainState drains)
{
    if (seam.uplift == UpliftModel::none) return {};
    double length = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i) length += distance(path[i - 1], path[i]);
    const double unit_weight = water_unit_weight(scene);
    if (seam.uplift == UpliftModel::points) {
        PressureProfile profile;
        for (const Point& p : seam.uplift_points)
            profile.points.push_back({p.x, p.y * unit_weight * std::max(0.0, ends.entry - path.front().y)});
        return profile;
    }
    std::vector<Point> heads;
    heads.reserve(3);
    heads.push_back({0.0, ends.entry});
    const std::optional<double> at = seam.uplift == UpliftModel::drains ? drains_on(scene, surface, path) : std::nullopt;
    if (at && *at > 0.0 && *at < length && drains == DrainState::effective) {
        // EM 1110-2-2200: H3 = H2 + (1 - E)(H1 - H2)(L - X)/L; a gallery above H2 takes its place.
        const bool downstream = ends.entry >= ends.exit;
        const double high = std::max(ends.entry, ends.exit), low = std::min(ends.entry, ends.exit);
        const double far = downstream ? (length - *at) / length : *at / length;
        const double outlet = std::max(low, scene.drains->gallery_level.value_or(low));
        const double head = outlet + (1.0 - scene.drains->efficiency) * (high - outlet) * far;
        heads.push_back({*at, std::min(head, low + (high - low) * far)});
    }
    heads.push_back({length, ends.exit});
    return pressure_along(path, heads, unit_weight);
}

double force_on(const PressureProfile& pressure, double from, double to)
{
    double sum = 0.0; // as resultant() of part(), which allocate memory
    for (std::size_t i = 0; i + 1 < pressure.points.size(); ++i) {
        const ProfilePoint &a = pressure.points[i], &b = pressure.points[i + 1];
        if (b.distance <= from || a.distance >= to || b.distance == a.distance) continue;
        const double left = std::max(a.distance, from), right = std::min(b.distance, to);
        sum += 0.5 * (right - left) * ((left > a.distance ? pressure_at(pressure, left) : a.pressure) +
                                       (right < b.distance ? pressure_at(pressure, right) : b.pressure));
    }
    return sum;
}

/// Water pressure along an interface from its foot up, hydrostatic above it [N/m]; its first moment about the foot [N].
struct FaceWater {
    double force = 0.0, moment = 0.0;
};
FaceWater water_in(double foot_pressure, double unit_weight, double length, double rise)
{
    if (!(foot_pressure > 0.0)) return {};
    const double fall = unit_weight * rise / length; // of the pressure over the length
    const double wet = fall > 0.0 ? std::min(length, foot_pressure / fall) : length;
    const double top = foot_pressure - fall * wet;
    return {0.5 * (foot_pressure + top) * wet, wet * wet * (foot_pressure + 2.0 * top) / 6.0};
}

} // namespace

/// The dam on the rock and the seam below it, whatever the wedge and the strengths.
struct SeamGround::Rock {
    std::vector<Force> loads; ///< static, of the dam without its weight
    double mass = 0.0;
    Point centre;
    AddedMassIntegral water;
    Polyline surface, path; ///< of the rock; of the seam
    YieldScan yields;       ///< of the scan

    Rock(const Scene& scene, const Seam& seam)
        : mass(dam_mass(scene)), centre(centroid(scene.section)),
          water(scene_added_mass(scene, scene.reservoir ? std::optional(scene.reservoir->level) : std::nullopt)),
          surface(ground_line(scene)), path(seam_path(scene, seam))
    {
        if (!scene.foundation || !(scene.foundation->material.density > 0.0))
            refuse(seam, "the rock above it has no density.", "foundation.density_kg_m3",
                   "add  density_kg_m3 = 2650  to [foundation]");
        for (const Load& l : static_loads(scene, scene_load_case(scene)))
            if (l.kind != LoadKind::weight && l.kind != LoadKind::anchor) loads.push_back(l.force.total());
    }
};

namespace {

using Rock = SeamGround::Rock;

void put_strengths(const Seam& seam, const SeamState& state, InterfaceModel kind, std::size_t segments_of_seam, Chain& chain)
{
    const double friction = state.friction ? *state.friction : FrictionOverSlip(seam.strength).peak();
    for (std::size_t i = 0; i < chain.blocks.size(); ++i) {
        ChainBlock& block = chain.blocks[i];
        const bool of_wedge = i >= segments_of_seam;
        block.friction = of_wedge ? seam.wedge->friction : friction;
        block.cohesion = of_wedge ? seam.wedge->cohesion : state.bonded ? seam.strength.cohesion : 0.0;
        block.dilation = !state.dilates ? 0.0 : of_wedge ? seam.wedge->dilation : seam.dilation;
    }
    const bool rubs = kind == InterfaceModel::friction;
    for (ChainInterface& face : chain.interfaces) {
        face.friction = rubs ? seam.interface.friction : 0.0;
        face.cohesion = rubs ? seam.interface.cohesion : 0.0;
    }
}

/// Where the plane of the wedge comes to the ground.
Point exit_of(const Rock& on_rock, const Seam& seam, double angle)
{
    const std::optional<Point> exit = meets(on_rock.surface, on_rock.path.back(), std::cos(angle), std::sin(angle));
    if (!exit)
        refuse(seam, fmt::format("the plane of its wedge at {:.4g} deg does not reach the ground.", angle / degree), "a steeper angle",
               "raise seam.wedge.angle_deg");
    return *exit;
}

/// Water levels at the ends of the path. @param top  of the last block, at its downstream end
Heads heads_of(const Scene& scene, const SeamModel& model, Point top)
{
    return {scene.reservoir ? scene.reservoir->level : model.path.front().y,
            std::max(top.y, scene.tailwater ? scene.tailwater->level : -unbounded)};
}

/// Block i with all that acts on it but the water below it. @param before, after  tops of the faces that it lies between
void put_block(const Scene& scene, const Rock& on_rock, const Seam& seam, std::size_t i, Point before, Point after, SeamModel& model)
{
    const double unit_weight = water_unit_weight(scene);
    const Point first = heel(scene.section), last = toe(scene.section), a = model.path[i], b = model.path[i + 1];
    const bool ends = i + 2 == model.path.size(),
               free_face = ends && model.path.size() == on_rock.path.size() && seam.exit != SeamExit::daylight;
    ChainBlock& block = model.chain.blocks[i];
    block.length = distance(a, b);
    block.dip = std::atan2(a.y - b.y, b.x - a.x);
    const Polyline top = surface_between(on_rock.surface, before, after);
    Section rock;
    rock.polygon = std::move(model.outlines[i]);
    rock.polygon.assign({a, b});
    for (auto p = top.rbegin(); p != top.rend(); ++p)
        if (rock.polygon.back() != *p && rock.polygon.front() != *p) rock.polygon.push_back(*p);
    const double rock_mass = scene.foundation->material.density * (rock.polygon.size() < 3 ? 0.0 : area(rock));
    block.mass = rock_mass;
    Point centre = rock_mass > 0.0 ? centroid(rock) : Point{0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
    Force load;
    add_ground_water(scene, top, load);
    if (i == 0 && before != a && scene.reservoir)
        load += hydrostatic_load({a, before}, DamSide::right, scene.reservoir->level, unit_weight).total();
    if (free_face) load += hydrostatic_load({b, after}, DamSide::left, heads_of(scene, model, after).exit, unit_weight).total();
    if (before.x <= first.x && after.x >= last.x) {
        model.chain.dam = i;
        for (const Force& own : on_rock.loads) load += own;
        block.mass += on_rock.mass;
        centre = {(rock_mass * centre.x + on_rock.mass * on_rock.centre.x) / block.mass,
                  (rock_mass * centre.y + on_rock.mass * on_rock.centre.y) / block.mass};
        block.added_mass = {on_rock.water.xx, on_rock.water.xy, on_rock.water.yy};
        model.water_per_a_h = hydrodynamic_force(on_rock.water, -1.0, 0.0).total();
    }
    block.force = {load.x, load.y};
    load += force_at(centre, 0.0, -block.mass * scene.gravity);
    model.outlines[i] = std::move(rock.polygon);
    model.loads[i] = load;
    model.centroids[i] = centre;
}

/// The water below the blocks and in the faces between them. @param top  as of heads_of()
void put_water(const Scene& scene, const Rock& on_rock, const Seam& seam, DrainState drains, Point top, SeamModel& model)
{
    model.pressure = seam_pressure(scene, seam, on_rock.surface, model.path, heads_of(scene, model, top), drains);
    double start = 0.0;
    for (std::size_t i = 0; i < model.chain.blocks.size(); ++i) {
        ChainBlock& block = model.chain.blocks[i];
        block.uplift = force_on(model.pressure, start, start + block.length);
        start += block.length;
        if (i == model.feet.size()) continue;
        ChainInterface& face = model.chain.interfaces[i];
        face.water = model.pressure.empty() ? 0.0
                                            : water_in(pressure_at(model.pressure, start), water_unit_weight(scene), face.length,
                                                       model.tops[i].y - model.feet[i].y)
                                                  .force;
    }
}

SeamModel model_of(const Scene& scene, const Rock& on_rock, const Seam& seam, std::optional<double> angle,
                   const SeamState& state = {}, std::optional<InterfaceModel> interface = std::nullopt)
{
    const Polyline& surface = on_rock.surface;
    SeamModel model;
    model.path = on_rock.path;
    if (angle) model.path.push_back(exit_of(on_rock, seam, *angle));
    const std::size_t segments = model.path.size() - 1;
    const bool free_face = !angle && seam.exit != SeamExit::daylight;

    // Tops of the faces between the blocks; the first and the last are the ends of the body.
    const double up = seam.interface.angle.value_or(0.5 * std::numbers::pi);
    Polyline tops{{model.path.front().x, ground_level(surface, model.path.front().x)}};
    for (std::size_t j = 1; j < segments; ++j) {
        const std::optional<Point> top = meets(surface, model.path[j], std::cos(up), std::sin(up));
        if (!top) refuse(seam, "an interface between its blocks does not reach the ground.", "a steeper angle", "write  angle_deg = 90");
        model.feet.push_back(model.path[j]);
        model.tops.push_back(*top);
        tops.push_back(*top);
        ChainInterface& face = model.chain.interfaces.emplace_back();
        face.angle = up;
        face.length = distance(model.path[j], *top);
    }
    const Point exit = model.path.back();
    tops.push_back(free_face ? Point{exit.x, ground_level(surface, exit.x)} : exit);

    model.chain.gravity = scene.gravity;
    model.chain.blocks.resize(segments);
    model.outlines.resize(segments);
    model.loads.resize(segments);
    model.centroids.resize(segments);
    model.chain.dam = segments; // not yet found
    for (std::size_t i = 0; i < segments; ++i) put_block(scene, on_rock, seam, i, tops[i], tops[i + 1], model);
    if (model.chain.dam == segments)
        refuse(seam, "it bends under the dam, and the face between its blocks cuts the dam.",
               "kinks whose faces reach the ground outside of heel and toe", "move the kink, or give seam.interface.angle_deg");
    put_water(scene, on_rock, seam, state.drains, tops.back(), model);
    put_strengths(seam, state, interface.value_or(seam.interface.model), on_rock.path.size() - 1, model.chain);
    return model;
}

/// Turns the plane of the wedge; the drains work. The water below all blocks follows the length of the path.
/// @param model  with a wedge
void set_angle(const Scene& scene, const Rock& on_rock, const Seam& seam, double angle, SeamModel& model)
{
    const Point exit = model.path.back() = exit_of(on_rock, seam, angle);
    put_block(scene, on_rock, seam, model.path.size() - 2, model.tops.back(), exit, model);
    put_water(scene, on_rock, seam, DrainState::effective, exit, model);
}

} // namespace

SeamModel seam_model(const Scene& scene, const Seam& seam, std::optional<double> angle, const SeamState& state,
                     std::optional<InterfaceModel> interface)
{
    return model_of(scene, Rock(scene, seam), seam, angle, state, interface);
}

namespace {

/// Where N acts on each segment, by the moments of its block; thrusts act at a third of their face.
std::vector<double> resultants(const SeamModel& model, const ChainForces& forces, double a_h)
{
    const Chain& chain = model.chain;
    std::vector<double> places;
    double start = 0.0;
    for (std::size_t i = 0; i < chain.blocks.size(); ++i) {
        const ChainBlock& block = chain.blocks[i];
        const Point foot = model.path[i];
        Force all = model.loads[i] + force_at(model.centroids[i], block.mass * a_h, 0.0);
        if (i == chain.dam) all += a_h * model.water_per_a_h;
        const auto add_face = [&](std::size_t j, double sign) {
            const ChainInterface& face = chain.interfaces[j];
            const Point e{std::cos(face.angle), std::sin(face.angle)}, out{e.y, -e.x};
            const double third = face.length / 3.0;
            const Point at{model.feet[j].x + third * e.x, model.feet[j].y + third * e.y};
            const double thrust = forces.thrust[j] + face.water;
            all += force_at(at, sign * (thrust * out.x - forces.shear[j] * e.x), sign * (thrust * out.y - forces.shear[j] * e.y));
        };
        if (i > 0) add_face(i - 1, 1.0);
        if (i < chain.interfaces.size()) add_face(i, -1.0);
        const double uplift_moment =
            model.pressure.empty() ? 0.0 : [&] {
                PressureProfile own{part(model.pressure, start, start + block.length)};
                for (ProfilePoint& p : own.points) p.distance -= start;
                return resultant(own).moment_about_heel;
            }();
        // Counter-clockwise about the upstream end of the segment: loads + uplift + N x = 0.
        places.push_back(-(moment_about(all, foot) + uplift_moment) / forces.normal[i] / block.length);
        start += block.length;
    }
    return places;
}

/// Place of the least value between lo and hi, both above that at `best`: the minimum of the parabola through the three best
/// places, or a golden section where that does not close in (Brent 1973, chapter 5).
template <typename Function>
double least_between(Function&& value, double lo, double best, double at_best, double hi)
{
    constexpr double golden = 0.38196601125010515, tolerance = 1e-8;
    double second = best, third = best, at_second = at_best, at_third = at_best, step = 0.0, before = 0.0;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (lo + hi);
        if (std::abs(best - middle) <= 2.0 * tolerance - 0.5 * (hi - lo)) break;
        const double r = (best - second) * (at_best - at_third), q = (best - third) * (at_best - at_second);
        const double parabola = -0.5 * ((best - third) * q - (best - second) * r) / (q - r);
        const bool closes = std::abs(before) > tolerance && std::abs(parabola) < 0.5 * std::abs(before) &&
                            best + parabola > lo && best + parabola < hi; // false for no number
        before = closes ? step : best < middle ? hi - best : lo - best;
        step = closes ? parabola : golden * before;
        if (closes && std::min(best + step - lo, hi - best - step) < 2.0 * tolerance)
            step = std::copysign(tolerance, middle - best);
        const double place = best + (std::abs(step) >= tolerance ? step : std::copysign(tolerance, step));
        const double here = value(place);
        if (here <= at_best) {
            (place < best ? hi : lo) = best;
            third = second, at_third = at_second;
            second = best, at_second = at_best;
            best = place, at_best = here;
        } else {
            (place < best ? lo : hi) = place;
            if (here <= at_second || second == best) {
                third = second, at_third = at_second;
                second = place, at_second = here;
            } else if (here <= at_third || third == best || third == second) {
                third = place, at_third = here;
            }
        }
    }
    return best;
}

constexpr double scan_step = 0.25 * degree;

/// Angles that are tried: those given, or a scan.
std::vector<double> angles_of(const SeamWedge& wedge)
{
    if (!wedge.angles.empty()) return wedge.angles;
    std::vector<double> angles;
    const int steps = std::max(1, static_cast<int>(std::ceil((wedge.search_to - wedge.search_from) / scan_step - 1e-9)));
    for (int i = 0; i <= steps; ++i)
        angles.push_back(wedge.search_from + (wedge.search_to - wedge.search_from) * i / steps);
    return angles;
}

/// Of the chain with its strengths over its own factor of safety.
ChainStatus status_at(const Chain& chain, double factor, const GroundState& state)
{
    if (!std::isfinite(factor) || !(factor > 0.0)) return ChainStatus::locked;
    return chain_status(chain, chain_law(chain, factor), state.a_h, state.a_v, factor);
}

/// What F and a_y of a seam are least of: F of the k-th state, after the last of them a_y; infinite where the wedge does not stand.
double least_of(const Chain& chain, const ChainLaw& law, const std::vector<GroundState>& states, std::size_t k)
{
    const double value = k < states.size() ? chain_factor(chain, states[k].a_h, states[k].a_v) : law.yield();
    const ChainStatus status = k < states.size() ? status_at(chain, value, states[k]) : chain_status(chain, law, value, 0.0);
    return status == ChainStatus::stands ? value : unbounded;
}

WedgeTrial tried(double angle, const Chain& chain, const ChainLaw& law, const std::vector<GroundState>& states)
{
    WedgeTrial trial{angle, {}, {}, law.yield(), ChainStatus::locked};
    for (const GroundState& state : states) {
        trial.factors.push_back(chain_factor(chain, state.a_h, state.a_v));
        trial.statuses.push_back(status_at(chain, trial.factors.back(), state));
    }
    trial.status = chain_status(chain, law, trial.yield, 0.0);
    return trial;
}

} // namespace

SeamGround::SeamGround(const Scene& scene, const Seam& seam) : seam_(seam)
{
    const auto rock = std::make_shared<Rock>(scene, seam);
    rock_ = rock;
    body_ = model_of(scene, *rock, seam, std::nullopt);
    if (!seam.wedge || seam.exit != SeamExit::wedge) return;
    for (const double angle : angles_of(*seam.wedge)) {
        if (scan_.empty())
            with_wedge_ = model_of(scene, *rock, seam, angle);
        else
            set_angle(scene, *rock, seam, angle, with_wedge_);
        scan_.push_back({angle, with_wedge_.chain, chain_law(with_wedge_.chain)});
        rock->yields.add(scan_.back().chain, scan_.back().law);
    }
}

bool SeamGround::serves(const Seam& seam) const
{
    const auto path = [](const Seam& s) {
        return std::tie(s.points, s.depth, s.dip, s.heel, s.exit, s.uplift, s.uplift_points, s.dilation, s.interface.angle);
    };
    const auto wedge = [](const SeamWedge& w) {
        return std::tie(w.angles, w.search_from, w.search_to, w.distance, w.dilation);
    };
    return path(seam) == path(seam_) && seam.wedge.has_value() == seam_.wedge.has_value() &&
           (!seam.wedge || wedge(*seam.wedge) == wedge(*seam_.wedge));
}

namespace {

/// The chain of a seam that has slid. @param angle  of the wedge; none: the body alone
using ChainOf = std::function<Chain(std::optional<double> angle, const SeamState& state)>;
bool is_block(const Chain& chain, const Seam& seam);
SlipStages stages_of(const Scene& scene, const Seam& seam, std::optional<double> angle, double growth, const ChainOf& chain_of);
std::vector<SeamStage> bodies_of(const Scene& scene, const Seam& seam, std::optional<double> angle, double growth,
                                 const ChainOf& chain_of);

/// Place of the least value that is not infinite; the size: there is none.
std::size_t least_place(const std::vector<double>& values)
{
    std::size_t best = values.size();
    double least = unbounded;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (values[i] < least) least = values[i], best = i;
    return best;
}

/// Angles of the wedge at the least F of each state and, last, at the least a_y; none: no wedge, or none that stands.
/// @param plane  its model becomes that of some angle
std::vector<std::optional<double>> least_angles(const Scene& scene, const Seam& seam, const std::vector<GroundState>& states,
                                                const SeamGround& ground, SeamPlane& plane)
{
    std::vector<std::optional<double>> angles(states.size() + 1);
    const std::vector<SeamGround::Scanned>& scan = ground.scan();
    if (scan.empty()) return angles;
    SeamModel& model = plane.model = ground.with_wedge();
    put_strengths(seam, {}, seam.interface.model, ground.rock().path.size() - 1, model.chain);
    SeamGround::Scanned at;
    const auto with_strengths = [&](const SeamGround::Scanned& scanned) {
        at = scanned;
        put_strengths(seam, {}, seam.interface.model, ground.rock().path.size() - 1, at.chain);
        set_strengths(at.chain, 1.0, at.law);
    };
    if (!states.empty())
        for (const SeamGround::Scanned& scanned : scan) {
            with_strengths(scanned);
            plane.trials.push_back(tried(at.angle, at.chain, at.law, states));
        }
    std::vector<double> values = states.empty() ? ground.rock().yields.yields(model.chain) : std::vector<double>(scan.size());
    ChainLaw law;
    const auto alone = [&](std::size_t k) {
        Chain body = ground.body().chain;
        put_strengths(seam, {}, seam.interface.model, ground.rock().path.size() - 1, body);
        return k < states.size() ? chain_factor(body, states[k].a_h, states[k].a_v) : chain_law(body).yield();
    };
    for (std::size_t k = 0; k <= states.size(); ++k) {
        for (std::size_t i = 0; i < plane.trials.size(); ++i)
            values[i] = k < states.size() ? plane.trials[i].factors[k] : plane.trials[i].yield;
        const auto stands = [&](std::size_t i) {
            if (!states.empty())
                return (k < states.size() ? plane.trials[i].statuses[k] : plane.trials[i].status) == ChainStatus::stands;
            with_strengths(scan[i]);
            return chain_status(at.chain, at.law, values[i], 0.0) == ChainStatus::stands;
        };
        std::size_t best = least_place(values);
        for (; best < scan.size() && !stands(best); best = least_place(values)) values[best] = unbounded;
        if (best == scan.size()) continue;
        angles[k] = scan[best].angle;
        if (!seam.wedge->angles.empty()) { // joints that are there: one at which the wedge falls leaves the body alone
            bool falls = false;
            for (std::size_t i = 0; i < scan.size(); ++i) falls = falls || !stands(i);
            if (falls && alone(k) < values[best]) angles[k] = std::nullopt;
            continue;
        }
        const bool at_end = best == 0 || best + 1 == scan.size();
        plane.at_end_of_range = plane.at_end_of_range || at_end;
        if (at_end) continue;
        angles[k] = least_between(
            [&](double angle) {
                set_angle(scene, ground.rock(), seam, angle, model);
                set_law(model.chain, 1.0, law);
                return least_of(model.chain, law, states, k);
            },
            scan[best - 1].angle, scan[best].angle, values[best], scan[best + 1].angle);
    }
    if (states.empty()) return angles;
    for (const std::optional<double>& angle : angles) {
        if (!angle || !seam.wedge->angles.empty()) continue;
        set_angle(scene, ground.rock(), seam, *angle, model);
        plane.trials.push_back(tried(*angle, model.chain, chain_law(model.chain), states));
    }
    const auto lower = [](const WedgeTrial& a, const WedgeTrial& b) { return a.angle < b.angle; };
    std::sort(plane.trials.begin(), plane.trials.end(), lower);
    const auto same = [](const WedgeTrial& a, const WedgeTrial& b) { return a.angle == b.angle; };
    plane.trials.erase(std::unique(plane.trials.begin(), plane.trials.end(), same), plane.trials.end());
    return angles;
}

/// Friction of the first `segments` blocks at which the yield is zero, so that F is 1; infinite where none holds.
double friction_that_holds(const Chain& chain, const ChainLaw& law, std::size_t segments)
{
    std::vector<Point> weights;
    auto excess = [&, held = chain](double friction) mutable {
        for (std::size_t i = 0; i < segments; ++i) held.blocks[i].friction = friction;
        return yield_with(held, chain, law, weights);
    };
    double high = 1.0;
    while (high < 1e3 && excess(high) < 0.0) high *= 2.0;
    return excess(0.0) >= 0.0 ? 0.0 : excess(high) < 0.0 ? unbounded : bracketed_root(excess, 0.0, high);
}

} // namespace

SeamPlane seam_plane(const Scene& scene, const Seam& seam, const std::vector<GroundState>& states)
{
    return seam_plane(scene, seam, states, SeamGround(scene, seam));
}

SeamPlane seam_plane(const Scene& scene, const Seam& seam, const std::vector<GroundState>& states, const SeamGround& ground)
{
    SeamPlane plane;
    plane.name = seam.name;
    const Rock& on_rock = ground.rock();
    const std::vector<std::optional<double>> angles = least_angles(scene, seam, states, ground, plane);
    plane.wedge_left_out = !ground.scan().empty() && !angles.back();
    plane.angle = angles.back();

    const bool bare = seam.exit == SeamExit::wedge;
    for (std::size_t k = 0; k < states.size(); ++k) {
        SeamFactor factor;
        factor.angle = angles[k];
        const auto by = [&](std::optional<double> angle, InterfaceModel kind) {
            return chain_factor(model_of(scene, on_rock, seam, angle, {}, kind).chain, states[k].a_h, states[k].a_v);
        };
        factor.smooth = by(factor.angle, InterfaceModel::smooth);
        factor.friction = by(factor.angle, InterfaceModel::friction);
        factor.factor = seam.interface.model == InterfaceModel::smooth ? factor.smooth : factor.friction;
        factor.status = status_at(model_of(scene, on_rock, seam, factor.angle).chain, factor.factor, states[k]);
        factor.without_wedge = bare ? by(std::nullopt, seam.interface.model) : factor.factor;
        plane.factors.push_back(factor);
    }

    if (plane.angle)
        set_angle(scene, on_rock, seam, *plane.angle, plane.model);
    else
        plane.model = ground.body();
    const ChainOf chain_of = [&](std::optional<double> angle, const SeamState& state) {
        if (state.drains != DrainState::effective) return model_of(scene, on_rock, seam, angle, state).chain;
        Chain chain = angle == plane.angle ? plane.model.chain : ground.body().chain;
        put_strengths(seam, state, seam.interface.model, on_rock.path.size() - 1, chain);
        return chain;
    };
    plane.model.chain = chain_of(plane.angle, {});
    const Chain& chain = plane.model.chain;
    const ChainLaw law = chain_law(chain);
    plane.yield = law.yield();
    plane.status = chain_status(chain, law, plane.yield, 0.0);
    plane.holding_friction = friction_that_holds(chain, law, on_rock.path.size() - 1);
    if (plane.angle && !states.empty()) // the least yield under that friction may be at another angle
        for (int pass = 0; pass < 20 && plane.holding_friction > 0.0 && std::isfinite(plane.holding_friction); ++pass) {
            Seam held = seam;
            held.strength.friction_table.clear();
            held.strength.residual_friction.reset();
            held.strength.friction = plane.holding_friction;
            SeamPlane found;
            const Chain other = model_of(scene, on_rock, held, least_angles(scene, held, {}, ground, found).back()).chain;
            const double before = plane.holding_friction;
            plane.holding_friction = std::max(before, friction_that_holds(other, chain_law(other), on_rock.path.size() - 1));
            if (plane.holding_friction - before <= 1e-9 * before) break;
        }
    plane.valid_slip = unbounded;
    if (plane.status == ChainStatus::locked) {
        plane.stages = stages_of(scene, seam, plane.angle, 0.0, chain_of);
        return plane;
    }
    plane.yield_per_a_v = -law.per_a_v / law.drive;
    plane.slip_factor = law.factor();
    if (!states.empty()) {
        plane.forces = chain_forces(chain, law, plane.yield, 0.0);
        plane.resultants = resultants(plane.model, plane.forces, plane.yield);
        plane.shares = resistance_shares(chain, law, plane.forces);
    }
    const bool grows = scene.planes.geometry == PlaneGeometry::linear;
    if (!chain.interfaces.empty() && (grows || !states.empty())) {
        plane.growth = yield_growth(chain, scene.foundation->material.density);
        if (plane.growth != 0.0) plane.valid_slip = 0.05 * std::abs(plane.yield / plane.growth);
    }
    const double growth = grows ? plane.growth : 0.0;
    plane.bodies = bodies_of(scene, seam, plane.angle, growth, chain_of);
    if (!plane.bodies.empty()) {
        const SeamStage& first = plane.bodies.front();
        plane.upstream = yield_upstream_alone(first.body);
        if (!states.empty()) plane.impact = chain_law(first.body).mass / chain_law(first.chain).mass;
        if (const std::size_t n = first.body.blocks.size(); n + 1 == chain.blocks.size() && !states.empty()) {
            Chain wedge{{chain.blocks[n]}, {}, chain.gravity, 0};
            const ChainInterface& face = chain.interfaces[n - 1];
            wedge.blocks[0].force.x += face.water * std::sin(face.angle);
            wedge.blocks[0].force.y -= face.water * std::cos(face.angle);
            plane.wedge_back = yield_upstream_alone(wedge).law.constant;
        }
    }
    plane.stages = stages_of(scene, seam, plane.angle, growth, chain_of);
    plane.of_block = is_block(chain, seam);
    return plane;
}

namespace {

/// From a slip on.
struct Piece {
    double from = 0.0, friction = 0.0, slope = 0.0; ///< slope of the friction [1/m]
    bool bonded = true;
    SeamState state = {};
};

/// Slips at which something changes, and what holds from there on.
std::vector<Piece> pieces_of(const Scene& scene, const Seam& seam)
{
    const FrictionOverSlip law(seam.strength);
    std::vector<Piece> pieces;
    const std::vector<FrictionOverSlip::Piece> given = law.pieces();
    const bool loses = seam.strength.cohesion > 0.0 && seam.strength.cohesion_lost_at_slip;
    if (loses) pieces.push_back({0.0, law.peak(), 0.0, true});
    constexpr int parts = 16; // of a slope: the law of a chain is not linear in friction
    for (std::size_t i = 0; i < given.size(); ++i) {
        const bool slopes = given[i].slope != 0.0 && i + 1 < given.size();
        const int count = slopes ? parts : 1;
        const double length = i + 1 < given.size() ? given[i + 1].from_slip - given[i].from_slip : 0.0;
        for (int k = 0; k < count; ++k) {
            const double from = given[i].from_slip + length * k / count;
            pieces.push_back({from, given[i].friction + given[i].slope * (from - given[i].from_slip),
                              slopes ? given[i].slope : 0.0, !loses});
        }
    }
    const auto split = [&](std::optional<double> slip) {
        if (!slip) return;
        const auto next = std::find_if(pieces.begin(), pieces.end(), [&](const Piece& p) { return p.from > *slip; });
        const auto last = std::prev(next);
        if (last->from != *slip || *slip == 0.0)
            pieces.insert(next, {*slip, law.at(*slip), last->slope, last->bonded && (*slip == 0.0 || !loses)});
    };
    const std::optional<double> drains_lost = scene.drains ? scene.drains->lost_at_slip : std::nullopt;
    split(drains_lost);
    split(seam.dilation_slip);
    for (Piece& piece : pieces) {
        const bool moved = &piece != &pieces.front(); // a later stage from the same slip holds from the first movement on
        piece.state.friction = piece.friction;
        piece.state.bonded = piece.bonded;
        piece.state.dilates = !(seam.dilation_slip && moved && piece.from >= *seam.dilation_slip);
        if (drains_lost && moved && piece.from >= *drains_lost) piece.state.drains = DrainState::ineffective;
    }
    return pieces;
}

/// Does the chain move as the base does, so that its lift-off and its way upstream are those of a block?
bool is_block(const Chain& chain, const Seam& seam)
{
    return chain.blocks.size() == 1 && seam.dilation == 0.0 && std::isfinite(chain_law(chain).yield());
}

RigidBlock own_block(const Chain& chain)
{
    const ChainBlock& own = chain.blocks.front();
    RigidBlock block;
    block.mass = own.mass;
    block.added_mass = own.added_mass;
    block.gravity = chain.gravity;
    block.vertical_force = -own.force.y;
    block.horizontal_force = own.force.x;
    block.uplift = own.uplift;
    block.cohesion_force = own.cohesion * own.length;
    block.friction = own.friction;
    block.base_inclination = own.dip;
    return block;
}

SlipStages stages_of(const Scene& scene, const Seam& seam, std::optional<double> angle, double growth, const ChainOf& chain_of)
{
    SlipStages stages;
    const std::vector<FrictionOverSlip::Piece> given = FrictionOverSlip(seam.strength).pieces();
    const bool of_block = is_block(chain_of(angle, {}), seam);
    for (const Piece& piece : pieces_of(scene, seam)) {
        const Chain chain = chain_of(angle, piece.state);
        SlipStage stage;
        stage.from_slip = piece.from;
        stage.block = of_block ? own_block(chain) : chain_block(chain, chain_law(chain));
        // The yield grows by κ per slip: as the weight of the block does, so by its friction.
        stage.block.friction += growth * piece.from / chain.gravity;
        stage.friction_slope = growth / chain.gravity;
        stages.push_back(stage);
    }
    // Friction linear over the slip: between the laws at both ends of a piece.
    for (std::size_t i = 0; i + 1 < stages.size(); ++i) {
        const double length = stages[i + 1].from_slip - stages[i].from_slip;
        const auto piece = std::find_if(given.rbegin(), given.rend(), [&](const FrictionOverSlip::Piece& p) {
            return p.from_slip <= stages[i].from_slip;
        });
        if (length <= 0.0 || piece == given.rend() || piece->slope == 0.0) continue;
        RigidBlock& block = stages[i].block;
        const double rise = yield_acceleration(stages[i + 1].block) - yield_acceleration(block),
                     more = stages[i + 1].block.friction - block.friction; // of the yield under a_v, over a_v
        if (!of_block && more != 0.0) { // what of the weight the yield does not follow counts as uplift
            block.uplift = block.mass * (scene.gravity - rise / more);
            block.horizontal_force -= block.friction * block.uplift;
        }
        stages[i].friction_slope = more != 0.0 ? more / length : rise / length / scene.gravity;
    }
    if (stages.back().friction_slope != 0.0) {
        // The last stage may not go on for ever; the geometry is good for less than the length of the seam.
        SlipStage end = stages.back();
        const double reach = 10.0 * base_length(scene.section);
        end.block.friction += end.friction_slope * reach;
        end.from_slip += reach;
        end.friction_slope = 0.0;
        stages.push_back(end);
    }
    return stages;
}

/// Blocks of a body that go upstream together; those before them stay, since they would have to be pulled. At least the dam's.
std::size_t blocks_back(const Chain& body)
{
    std::size_t count = body.blocks.size();
    for (std::size_t face = body.dam; face + 1 < count; ++face) {
        Chain back = going_upstream(body);
        back.blocks.resize(count);
        back.interfaces.resize(count - 1);
        const ChainLaw law = chain_law(back);
        if (law.locked || chain_forces(back, law, law.yield(), 0.0).thrust[face] >= 0.0) continue;
        count = face + 1;
    }
    return count;
}

std::vector<SeamStage> bodies_of(const Scene& scene, const Seam& seam, std::optional<double> angle, double growth,
                                 const ChainOf& chain_of)
{
    std::vector<SeamStage> stages;
    const std::vector<Piece> pieces = pieces_of(scene, seam);
    std::size_t count = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        SeamState state = pieces[i].state;
        if (pieces[i].slope != 0.0 && i + 1 < pieces.size()) // the mean
            state.friction = pieces[i].friction + 0.5 * pieces[i].slope * (pieces[i + 1].from - pieces[i].from);
        SeamStage stage{pieces[i].from, chain_of(angle, state), {}, growth,
                        scene.planes.wedge == PlaneWedge::free};
        stage.body = angle ? chain_of(std::nullopt, state) : stage.chain;
        if (count == 0) count = blocks_back(stage.body);
        if (count < stage.body.blocks.size()) { // the water of the face stays
            const ChainInterface& face = stage.body.interfaces[count - 1];
            stage.body.blocks.resize(count);
            stage.body.interfaces.resize(count - 1);
            stage.body.blocks.back().force.x -= face.water * std::sin(face.angle);
            stage.body.blocks.back().force.y += face.water * std::cos(face.angle);
        }
        if (chain_law(stage.chain).locked || chain_law(stage.body).locked) return {};
        stages.push_back(std::move(stage));
    }
    return stages;
}

} // namespace

SlipStages seam_stages(const Scene& scene, const Seam& seam, std::optional<double> angle, double growth)
{
    const Rock on_rock(scene, seam);
    return stages_of(scene, seam, angle, growth, [&](std::optional<double> of_wedge, const SeamState& state) {
        return model_of(scene, on_rock, seam, of_wedge, state).chain;
    });
}

} // namespace damslip::sliding
