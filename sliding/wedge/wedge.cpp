#include "sliding/wedge/wedge.hpp"

#include "core/input_error.hpp"
#include "sliding/block/roots.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace damslip::sliding {

namespace {

/// Into the wedge, upwards.
Vector3 normal_of(const WedgePlane& p)
{
    return plane_normal(p.dip, p.dip_direction);
}

void check(const Wedge& w)
{
    Diagnostic wrong;
    wrong.file = "wedge";
    wrong.expected =
        "mass > 0; dips 0 ... 90 degrees; friction, cohesion, areas and water forces >= 0; planes that meet";
    const auto bad = [](double x) { return !(x >= 0.0) || !std::isfinite(x); };
    if (!(w.mass > 0.0) || !std::isfinite(w.mass) || bad(w.gravity))
        wrong.problem = "mass or gravity of the wedge is not allowed.";
    for (const WedgePlane& p : {w.first, w.second}) {
        if (bad(p.dip) || p.dip > 0.5 * std::numbers::pi || !std::isfinite(p.dip_direction))
            wrong.problem = "a dip of the wedge is not allowed.";
        if (bad(p.friction) || bad(p.cohesion) || bad(p.area) || bad(p.water_force))
            wrong.problem = "a strength, area or water force of the wedge is not allowed.";
    }
    for (const double x : w.force)
        if (!std::isfinite(x)) wrong.problem = "a force on the wedge is not a number.";
    const Vector3 line = cross(normal_of(w.first), normal_of(w.second));
    if (wrong.problem.empty() && !(dot(line, line) > 1e-12)) wrong.problem = "the planes of the wedge are parallel.";
    if (!wrong.problem.empty()) throw InputError(wrong);
}

double cohesion_force(const WedgePlane& p)
{
    return p.cohesion * p.area;
}

void finish(WedgeState& s)
{
    s.factor_of_safety = s.drive > 0.0 ? s.resistance / s.drive : std::numeric_limits<double>::infinity();
}

/// Both normal forces of a wedge that keeps to both planes: S + N1 n1 + N2 n2 along the line of intersection.
WedgeState on_both(const Wedge& w, const Vector3& n1, const Vector3& n2, const Vector3& force)
{
    WedgeState s;
    const double c = dot(n1, n2), f1 = dot(force, n1), f2 = dot(force, n2);
    s.first_normal = -(f1 - c * f2) / (1.0 - c * c);
    s.second_normal = -(f2 - c * f1) / (1.0 - c * c);
    const Vector3 line = unit(cross(n1, n2));
    const double along = dot(force, line);
    s.direction = along >= 0.0 ? line : Vector3{-line[0], -line[1], -line[2]};
    s.drive = std::abs(along);
    s.cohesion = cohesion_force(w.first) + cohesion_force(w.second);
    s.resistance = s.cohesion + w.first.friction * s.first_normal + w.second.friction * s.second_normal;
    finish(s);
    return s;
}

WedgeState on_one(WedgeMode mode, const WedgePlane& plane, const Vector3& n, const Vector3& force)
{
    WedgeState s;
    s.mode = mode;
    const double pressed = -dot(force, n);
    (mode == WedgeMode::first_plane ? s.first_normal : s.second_normal) = pressed;
    const Vector3 along = sum(force, pressed, n);
    s.direction = unit(along);
    s.drive = std::sqrt(dot(along, along));
    s.cohesion = cohesion_force(plane);
    s.resistance = s.cohesion + plane.friction * pressed;
    finish(s);
    return s;
}

} // namespace

WedgeState wedge_state(const Wedge& wedge, const Vector3& push, double accel, double accel_v)
{
    check(wedge);
    const Vector3 n1 = normal_of(wedge.first), n2 = normal_of(wedge.second);
    Vector3 force = wedge.force;
    force[2] -= wedge.mass * (wedge.gravity + accel_v);
    force = sum(force, wedge.mass * accel, push);
    force = sum(force, wedge.first.water_force, n1);
    force = sum(force, wedge.second.water_force, n2);
    const WedgeState both = on_both(wedge, n1, n2, force);
    if (both.first_normal > 0.0 && both.second_normal > 0.0) return both;
    // Pressed on one plane, and sliding on it leads away from the other.
    const double f1 = dot(force, n1), f2 = dot(force, n2), c = dot(n1, n2);
    if (f1 < 0.0 && f2 - c * f1 >= 0.0) return on_one(WedgeMode::first_plane, wedge.first, n1, force);
    if (f2 < 0.0 && f1 - c * f2 >= 0.0) return on_one(WedgeMode::second_plane, wedge.second, n2, force);
    WedgeState lifted;
    lifted.mode = WedgeMode::lifts;
    lifted.direction = unit(force);
    lifted.drive = std::sqrt(dot(force, force));
    return lifted;
}

double critical_friction(const WedgeState& s)
{
    const double pressed = s.first_normal + s.second_normal;
    if (s.mode == WedgeMode::lifts || !(pressed > 0.0)) return std::numeric_limits<double>::infinity();
    return std::max(0.0, (s.drive - s.cohesion) / pressed);
}

namespace {

/// What a force adds to the drive of a kept way of sliding less what it adds to the resistance.
double net_drive(const Wedge& w, const WedgeState& kept, const Vector3& force)
{
    const Vector3 n1 = normal_of(w.first), n2 = normal_of(w.second);
    const double c = dot(n1, n2), f1 = dot(force, n1), f2 = dot(force, n2);
    double resisted = 0.0;
    if (kept.mode == WedgeMode::both_planes)
        resisted = -(w.first.friction * (f1 - c * f2) + w.second.friction * (f2 - c * f1)) / (1.0 - c * c);
    else if (kept.mode == WedgeMode::first_plane)
        resisted = -w.first.friction * f1;
    else if (kept.mode == WedgeMode::second_plane)
        resisted = -w.second.friction * f2;
    return dot(force, kept.direction) - resisted;
}

} // namespace

WedgeYield wedge_yield(const Wedge& wedge, const Vector3& push)
{
    const double infinity = std::numeric_limits<double>::infinity();
    const auto excess = [&](double a) {
        const WedgeState s = wedge_state(wedge, push, a);
        return s.drive - s.resistance;
    };
    WedgeYield y;
    const double step = wedge.gravity / 200.0;
    const bool stands = excess(0.0) <= 0.0;
    const int way = stands ? 1 : -1; // one that slides is looked at pushed back, until it stands
    int k = 1;
    while (k <= 2000 && (excess(way * k * step) <= 0.0) == stands) ++k;
    if (k > 2000) {
        y.acceleration = way * infinity;
        y.law = {y.acceleration, 0.0};
        y.state = wedge_state(wedge);
        return y;
    }
    y.acceleration =
        stands ? bracketed_root(excess, (k - 1) * step, k * step) : bracketed_root(excess, -k * step, (1 - k) * step);
    y.state = wedge_state(wedge, push, y.acceleration);
    // The forces are linear in a and a_v: m e and -m z per unit of each.
    y.factor = net_drive(wedge, y.state, push);
    const double per_a_v = -net_drive(wedge, y.state, {0.0, 0.0, 1.0});
    y.law.constant = y.acceleration;
    if (y.factor > 0.0) y.law.per_a_v = -per_a_v / y.factor;
    return y;
}

WedgeYield without_cohesion(const Wedge& wedge, WedgeYield yield)
{
    WedgeState& s = yield.state;
    if (std::isfinite(yield.law.constant) && yield.factor > 0.0)
        yield.law.constant -= s.cohesion / (wedge.mass * yield.factor);
    yield.acceleration = yield.law.constant;
    s.resistance -= s.cohesion;
    s.cohesion = 0.0;
    finish(s);
    return yield;
}

SlipSummary slide_wedge(const GroundMotion& motion, const WedgeYield& yield, const ConstantYieldOptions& options)
{
    GroundMotion horizontal = motion;
    horizontal.accel_v.clear();
    return slide_constant_yield(SkippingMotion(std::move(horizontal)), {yield.acceleration, yield.factor}, options);
}

namespace {

constexpr double gravity = 9.81; // of the block that stands for the wedge: cancels

/// A block of unit mass on a level plane with the yields of the wedge.
SlipStages level_block(const WedgeYields& yields)
{
    const double first = yields.at_rest.law.constant, later = yields.moving ? yields.moving->law.constant : first;
    RigidBlock block;
    block.mass = 1.0;
    block.gravity = gravity;
    block.friction = std::max(later, 0.0) / gravity;
    block.horizontal_force = std::max(-later, 0.0);
    block.cohesion_force = first - later;
    SlipStages stages{{0.0, block, 0.0}};
    if (block.cohesion_force > 0.0) {
        block.cohesion_force = 0.0;
        stages.push_back({0.0, block, 0.0}); // from the first slip on
    }
    return stages;
}

/// a_h - per_a_v a_v, which drives that block.
GroundMotion driving(const GroundMotion& motion, double per_a_v, int polarity)
{
    GroundMotion level = motion;
    level.accel_v.clear();
    for (std::size_t k = 0; k < level.accel_h.size(); ++k) {
        level.accel_h[k] *= polarity;
        if (!motion.accel_v.empty()) level.accel_h[k] -= per_a_v * motion.accel_v[k];
    }
    return level;
}

void scale(SlideResult& r, double factor)
{
    for (double* x : {&r.slip, &r.max_slip, &r.downstream_slip, &r.upstream_slip, &r.peak_slip_rate}) *x *= factor;
    for (auto* list : {&r.history.slip, &r.history.slip_rate})
        for (double& x : *list) x *= factor;
}

/// Yield of a_h at the samples; the run-out has no vertical motion.
void restore_yield(SlideHistory& history, const GroundMotion& motion, double per_a_v)
{
    history.normal_force.clear();
    history.gap.clear();
    for (std::size_t k = 0; k < std::min(history.yield.size(), motion.accel_v.size()); ++k)
        history.yield[k] += per_a_v * motion.accel_v[k];
}

/// A wedge that no ground acceleration moves.
SlideResult at_rest(const GroundMotion& motion, const SlideOptions& options)
{
    SlideResult r;
    const std::size_t n = motion.accel_h.size();
    r.end_time = n > 0 ? motion.dt * static_cast<double>(n - 1) : 0.0;
    if (options.history == HistoryOutput::none) return r;
    for (std::size_t k = 0; k < n; ++k) r.history.time.push_back(motion.dt * static_cast<double>(k));
    r.history.slip.assign(n, 0.0);
    r.history.slip_rate.assign(n, 0.0);
    r.history.yield.assign(n, std::numeric_limits<double>::quiet_NaN());
    return r;
}

} // namespace

SlideResult slide_wedge(const GroundMotion& motion, const WedgeYields& yields, const SlideOptions& options)
{
    const WedgeYield& yield = yields.at_rest;
    if (yield.law.constant == std::numeric_limits<double>::infinity()) return at_rest(motion, options);
    if (!(yield.factor > 0.0) || !std::isfinite(yield.law.constant)) { // slides without, and no shaking pushes it on
        SlideResult r = at_rest(motion, options);
        r.status = Status::static_failure;
        return r;
    }
    SlideOptions level = options;
    level.polarity = 1;
    level.sliding.two_way = false;
    SlideResult r = slide(driving(motion, yield.law.per_a_v, options.polarity), level_block(yields), level);
    scale(r, yield.factor);
    restore_yield(r.history, motion, yield.law.per_a_v);
    if (r.status == Status::static_failure)
        r.notes = {{NoteKind::wedge_slides}};
    return r;
}

double share_of_other_modes(const Wedge& wedge, const Vector3& push, const GroundMotion& motion,
                            const WedgeYield& yield, int polarity)
{
    std::size_t beyond = 0, other = 0;
    for (std::size_t k = 0; k < motion.accel_h.size(); ++k) {
        const double a_h = polarity * motion.accel_h[k], a_v = motion.accel_v.empty() ? 0.0 : motion.accel_v[k];
        if (!(a_h > yield.law.at(a_v))) continue;
        ++beyond;
        other += wedge_state(wedge, push, a_h, a_v).mode != yield.state.mode;
    }
    return beyond > 0 ? static_cast<double>(other) / static_cast<double>(beyond) : 0.0;
}

} // namespace damslip::sliding
