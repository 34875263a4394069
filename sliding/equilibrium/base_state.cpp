#include "sliding/equilibrium/base_state.hpp"

#include "core/units.hpp"
#include "scene/joint_bond.hpp"
#include "scene/section.hpp"
#include "sliding/uplift/uplift.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace damslip::sliding {

BaseFrame base_frame(const Scene& scene)
{
    const Point a = heel(scene.section), b = toe(scene.section);
    const double length = base_length(scene.section);
    const Point t{(b.x - a.x) / length, (b.y - a.y) / length};
    return {length, base_inclination(scene.section), base_share(scene.section), t, {-t.y, t.x}};
}

BaseLoad base_load(const BaseFrame& frame, const Force& force)
{
    return {-(force.x * frame.n.x + force.y * frame.n.y), force.moment};
}

double shear(const BaseFrame& frame, const Force& force)
{
    return force.x * frame.t.x + force.y * frame.t.y;
}

StaticCase scene_static_case(const Scene& scene)
{
    StaticCase static_case;
    static_case.loads = scene_load_case(scene);
    static_case.uplift = scene_uplift_state(scene);
    if (scene.uplift) static_case.crack = scene.uplift->crack;
    return static_case;
}

CrackUplift crack_uplift(const Scene& scene, const UpliftState& state, double factor, const SeepageProfile& seepage)
{
    return [&scene, state, factor, seepage](const Crack& crack) {
        PressureProfile profile = uplift_profile(scene, state, crack, seepage);
        for (ProfilePoint& p : profile.points) p.pressure *= factor;
        return profile;
    };
}

BaseState base_state(const Scene& scene, const StaticCase& static_case, const SeepageProfile& seepage)
{
    BaseState state;
    state.frame = base_frame(scene);
    state.loads = static_loads(scene, static_case.loads);
    state.load = resultant(state.loads);
    state.opened = static_case.opened;
    state.dowel_force = dowel_force(scene, static_case.loads.anchors);
    const BaseLoad load = base_load(state.frame, state.load);
    const CrackUplift uplift = crack_uplift(scene, static_case.uplift, static_case.uplift_factor, seepage);
    if (static_case.crack == CrackRule::none) {
        state.base = uncracked_base(load, state.frame.length, uplift(static_case.opened));
        state.base.crack = static_case.opened;
    } else {
        state.base = cracked_base(load, state.frame.length, uplift, static_case.opened, crack_events(scene));
    }
    return state;
}

std::vector<AnchorBar> base_anchors(const Scene& scene)
{
    std::vector<AnchorBar> bars;
    for (const Anchor& anchor : scene.anchors)
        if (anchor.joint.empty()) bars.push_back(anchor_bar(anchor, FrictionOverSlip(scene.contact).peak()));
    return bars;
}

double dowel_force(const Scene& scene, AnchorForce which)
{
    double sum = 0.0;
    for (const Anchor& anchor : scene.anchors) {
        if (!anchor.joint.empty() || !anchor.dowel) continue;
        const AnchorBar bar = anchor_bar(anchor, FrictionOverSlip(scene.contact).peak());
        sum += bar.dowel * dowel_share(force_of(anchor, which) / bar.yield_force);
    }
    return sum;
}

RigidBlock make_rigid_block(const Scene& scene, const BlockOptions& options)
{
    StaticCase static_case = scene_static_case(scene);
    if (options.crack) static_case.crack = *options.crack;
    static_case.uplift.drains = options.drains;
    static_case.uplift.curtain = options.curtain;
    return make_rigid_block(scene, base_state(scene, static_case, options.seepage), static_case.loads.reservoir_level,
                            options);
}

RigidBlock make_rigid_block(const Scene& scene, const BaseState& state, std::optional<double> reservoir_level,
                            const BlockOptions& options)
{
    const AddedMassIntegral water = scene_added_mass(scene, reservoir_level);
    RigidBlock block;
    block.mass = dam_mass(scene);
    block.added_mass = {water.xx, water.xy, water.yy};
    block.gravity = scene.gravity;
    for (const Load& load : state.loads) {
        const Force force = load.force.total();
        block.horizontal_force += force.x;
        // The weight is the block's own; only what a load factor changes of it is left here.
        block.vertical_force -= load.kind == LoadKind::weight ? force.y + block.mass * block.gravity : force.y;
    }
    block.uplift = state.base.uplift.force;
    block.cohesion_force = options.cohesion.value_or(scene.contact.cohesion) * state.cohesive_length();
    block.friction = options.friction.value_or(FrictionOverSlip(scene.contact).peak());
    block.dowel_force = state.dowel_force;
    block.base_inclination = state.frame.inclination;
    return block;
}

PressureProfile without_new_crack(const BaseState& state, const Crack& crack)
{
    const CrackedBase& before = state.base;
    const double length = state.frame.length;
    const bool same = crack.side == before.crack.side;
    const double dry_from = crack.side == Side::heel ? (same ? before.crack.length : 0.0) : length - crack.length;
    const double dry_to = crack.side == Side::heel ? crack.length : length - (same ? before.crack.length : 0.0);
    if (dry_to <= dry_from) return before.profile;
    PressureProfile out;
    out.points = part(before.profile, 0.0, dry_from);
    out.points.push_back({dry_from, 0.0});
    out.points.push_back({dry_to, 0.0});
    for (const ProfilePoint& p : part(before.profile, dry_to, length)) out.points.push_back(p);
    return out;
}

std::vector<Load> earthquake_loads(const Scene& scene, const AddedMassIntegral& water, double a_h, double a_v,
                                   const Polyline& profile)
{
    double mass = dam_mass(scene);
    Point at = centroid(scene.section);
    if (!profile.empty()) {
        const SectionSums sums = section_sums(scene.section, profile);
        mass = sums.area * scene.dam.density;
        at = mass > 0.0 ? sums.centre() : at;
    }
    std::vector<Load> loads;
    loads.push_back(
        {LoadKind::inertia, "inertia of the dam", {force_at(at, mass * a_h, 0.0), force_at(at, 0.0, -mass * a_v)}});
    if (water.xx > 0.0) loads.push_back({LoadKind::hydrodynamic, "hydrodynamic", hydrodynamic_force(water, -a_h, a_v)});
    return loads;
}

CrackedBase shaken_base(const Scene& scene, const StaticCase& static_case, const BaseState& before, const Force& load,
                        const SeepageProfile& seepage)
{
    const BaseLoad total = base_load(before.frame, load);
    const double length = before.frame.length;
    switch (static_case.crack) {
    case CrackRule::none:
        break;
    case CrackRule::fixed_static: {
        CrackedBase base = uncracked_base(total, length, before.base.profile);
        base.crack = before.base.crack;
        base.status = before.base.status;
        base.compressed_length = length - base.crack.length;
        base.compressed_side = before.base.compressed_side;
        return base;
    }
    case CrackRule::seismic_unchanged:
        return cracked_base_unchanged(total, length, before.base.profile);
    case CrackRule::seismic_zero:
        return cracked_base(total, length,
                            [&](const Crack& crack) { return without_new_crack(before, crack); });
    case CrackRule::seismic_full:
        return cracked_base(total, length, crack_uplift(scene, static_case.uplift, static_case.uplift_factor, seepage),
                            before.base.crack, crack_events(scene));
    }
    CrackedBase base = uncracked_base(total, length, before.base.profile);
    base.crack = before.base.crack;
    return base;
}

UpliftResultant uplift_of_empty_joint(const BaseState& before, Side opens)
{
    const double length = before.frame.length;
    return resultant(without_new_crack(before, {opens, length}));
}

std::optional<UpliftResultant> uplift_of_open_joint(const Scene& scene, const StaticCase& static_case,
                                                    const BaseState& before, Side opens, const SeepageProfile& seepage)
{
    if (!scene.uplift || scene.uplift->model == UpliftModel::none) return std::nullopt;
    const Crack through{opens, before.frame.length};
    switch (scene.uplift->water.opening) {
    case OpeningWater::zero:
        return uplift_of_empty_joint(before, opens);
    case OpeningWater::full:
    case OpeningWater::mouth:
        return resultant(crack_uplift(scene, static_case.uplift, static_case.uplift_factor, seepage)(through));
    case OpeningWater::unchanged:
    case OpeningWater::reynolds:
        break;
    }
    return std::nullopt;
}

BaseState with_open_joint(const Scene& scene, const StaticCase& static_case, const BaseState& before, Side opens,
                          const SeepageProfile& seepage)
{
    BaseState state = before;
    if (const auto uplift = uplift_of_open_joint(scene, static_case, before, opens, seepage))
        state.base.uplift = *uplift;
    return state;
}

double bonded_length(const BaseState& before, const CrackedBase& base)
{
    const double length = before.frame.length;
    const Crack &a = before.base.crack, &b = base.crack;
    const double lost = a.side == b.side ? std::max(a.length, b.length) : a.length + b.length;
    return before.frame.share * std::max(0.0, length - lost);
}

namespace {

constexpr double beyond_any_earthquake = 100.0 * units::standard_gravity; // [m/s^2]

/// The joint under static loads and a constant horizontal ground acceleration a_h.
class ShakenJoint {
public:
    ShakenJoint(const Scene& scene, const StaticCase& static_case, const AddedMassIntegral& water,
                const BaseState& before, const SeepageProfile& seepage)
        : scene_(scene), static_case_(static_case), water_(water), before_(before), seepage_(seepage)
    {
        if (static_case_.crack == CrackRule::none || static_case_.crack == CrackRule::fixed_static)
            static_case_.crack = CrackRule::seismic_unchanged;
    }

    bool open(double a_h) const { return base(load(a_h)).status == CrackStatus::open; }

    /// With the bond of what is closed under this acceleration itself; a joint that is open from end to end rests on one of
    /// them.
    bool slides(double a_h, double friction, double cohesion) const
    {
        const Force total = load(a_h);
        const CrackedBase joint = base(total);
        const bool through = joint.status == CrackStatus::open || cracked_through(joint, before_.frame.length);
        const double bonded = through ? 0.0 : bonded_length(before_, joint);
        return shear(before_.frame, total) >
               cohesion * bonded + before_.dowel_force + friction * joint.effective_normal;
    }

private:
    Force load(double a_h) const
    {
        Force sum = before_.load;
        for (const Load& shaking : earthquake_loads(scene_, water_, a_h, 0.0)) sum += shaking.force.total();
        return sum;
    }
    CrackedBase base(const Force& total) const { return shaken_base(scene_, static_case_, before_, total, seepage_); }

    const Scene& scene_;
    StaticCase static_case_;
    const AddedMassIntegral& water_;
    const BaseState& before_;
    const SeepageProfile& seepage_;
};

/// Bisected between an acceleration at which it does not happen and one at which it does; what happens under any acceleration does at none.
template <class Happens>
double between(const Happens& happens, double not_yet, double already)
{
    constexpr double none = 1e-12; // [m/s^2]
    while (already - not_yet > 1e-12 * already) {
        if (already < none) return 0.0;
        const double middle = not_yet + 0.5 * (already - not_yet);
        (happens(middle) ? already : not_yet) = middle;
    }
    return already;
}

/// Smallest acceleration from which on it happens, bracketed by doubling and bisected; infinite if none makes it happen.
template <class Happens>
double smallest_acceleration(const Happens& happens)
{
    if (happens(0.0)) return 0.0;
    double not_yet = 0.0, already = 0.25 * units::standard_gravity;
    while (!happens(already)) {
        if (already > beyond_any_earthquake) return std::numeric_limits<double>::infinity();
        not_yet = already;
        already *= 2.0;
    }
    return between(happens, not_yet, already);
}

/// The same for what may come, go and come again as the acceleration grows: the first of many even steps up to one that
/// makes it happen, then bisected.
template <class Happens>
double first_acceleration(const Happens& happens)
{
    constexpr int steps = 128; // a rule of uplift turns a_y(a) around by a jump at curtain or drains at most
    double last = smallest_acceleration(happens);
    if (!std::isfinite(last)) return last;
    double before = 0.0;
    for (int k = 1; k < steps; ++k) {
        const double a = last * k / steps;
        if (!happens(a)) {
            before = a;
            continue;
        }
        last = a;
        break;
    }
    return between(happens, before, last);
}

} // namespace

double tipping_acceleration(const Scene& scene, const AddedMassIntegral& water, const BaseState& before, double a_v,
                            Towards towards)
{
    const bool downstream = towards == Towards::downstream;
    const Point pivot = downstream ? toe(scene.section) : heel(scene.section);
    Force fixed = before.load, unit;
    const double u = before.base.uplift.force;
    fixed += {u * before.frame.n.x, u * before.frame.n.y, before.base.uplift.moment_about_heel};
    for (const Load& load : earthquake_loads(scene, water, 0.0, a_v)) fixed += load.force.total();
    for (const Load& load : earthquake_loads(scene, water, downstream ? 1.0 : -1.0, 0.0)) unit += load.force.total();
    // Counter-clockwise moments hold the toe, clockwise ones the heel.
    const double sense = downstream ? 1.0 : -1.0, per_a_h = sense * moment_about(unit, pivot);
    return per_a_h < 0.0 ? -sense * moment_about(fixed, pivot) / per_a_h : std::numeric_limits<double>::infinity();
}

BaseLimits base_limits(const Scene& scene, const SeepageProfile& seepage, std::optional<CrackRule> crack)
{
    StaticCase static_case = scene_static_case(scene);
    if (crack) static_case.crack = *crack;
    const BaseState before = base_state(scene, static_case, seepage);
    const AddedMassIntegral water = scene_added_mass(scene, static_case.loads.reservoir_level);
    BaseLimits limits;
    const auto tips = [&](Towards towards, Side opens) {
        return tipping_acceleration(scene, water, with_open_joint(scene, static_case, before, opens, seepage), 0.0,
                                    towards);
    };
    limits.tips = tips(Towards::downstream, Side::heel);
    limits.tips_upstream = tips(Towards::upstream, Side::toe);
    const ShakenJoint joint(scene, static_case, water, before, seepage);
    limits.opens = smallest_acceleration([&](double a_h) { return joint.open(a_h); });
    const RigidBlock block = make_rigid_block(scene, before, static_case.loads.reservoir_level);
    limits.yield_with_crack =
        first_acceleration([&](double a_h) { return joint.slides(a_h, block.friction, scene.contact.cohesion); });
    return limits;
}

namespace {

/// The polygon's part at and above the level y, counter-clockwise, first its upstream end on the level.
Polyline part_above(const Polyline& polygon, double y)
{
    Polyline part;
    const auto add = [&part](Point p) {
        if (part.empty() || part.back() != p) part.push_back(p);
    };
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        if (a.y >= y) add(a);
        if ((a.y < y) != (b.y < y)) add({a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x), y});
    }
    if (part.size() > 1 && part.front() == part.back()) part.pop_back();
    const auto more_upstream = [y](Point a, Point b) { return (a.y == y) != (b.y == y) ? a.y == y : a.x < b.x; };
    std::rotate(part.begin(), std::min_element(part.begin(), part.end(), more_upstream), part.end());
    assert(part.size() > 2 && part[1].y == y && part[1].x > part[0].x);
    return part;
}

/// A level above the joint instead of the heel; nothing left when it is below.
template <class Water>
void lower_level(std::optional<Water>& water, double by)
{
    if (!water) return;
    water->level -= by;
    if (!(water->level > 0.0)) water.reset();
}

} // namespace

Scene scene_above(const Scene& scene, const LiftJoint& joint)
{
    Scene part = scene;
    const double y = joint.elevation;
    part.section.polygon = part_above(scene.section.polygon, y);
    const double x = part.section.polygon.front().x;
    for (Point& p : part.section.polygon) p = {p.x - x, p.y - y};
    for (Point& p : part.section.thickness) p.x -= y;
    part.contact = joint.strength;
    part.lift_joints.clear();
    part.combinations.clear();
    part.foundation.reset();
    part.curtain.reset();
    part.drains.reset();
    lower_level(part.reservoir, y);
    lower_level(part.tailwater, y);
    lower_level(part.silt, y);
    lower_level(part.ice, y);
    std::erase_if(part.forces, [y](const PointForce& f) { return f.at.y < y; });
    for (PointForce& f : part.forces) f.at = {f.at.x - x, f.at.y - y};
    std::erase_if(part.anchors, [&joint](const Anchor& a) { return a.joint != joint.name; });
    for (Anchor& anchor : part.anchors) anchor.joint.clear();
    part.uplift.reset();
    if (joint.water == JointWater::linear) part.uplift.emplace().model = UpliftModel::linear;
    return part;
}

RigidBlock lift_block(const Scene& scene, const LiftJoint& joint)
{
    RigidBlock block = make_rigid_block(scene_above(scene, joint));
    Scene wet = scene;
    wet.section.polygon = part_above(scene.section.polygon, joint.elevation);
    const AddedMassIntegral water =
        scene_added_mass(wet, scene.reservoir ? std::optional(scene.reservoir->level) : std::nullopt);
    block.added_mass = {water.xx, water.xy, water.yy};
    return block;
}

} // namespace damslip::sliding
