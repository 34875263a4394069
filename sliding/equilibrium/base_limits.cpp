#include "sliding/equilibrium/base_limits.hpp"

#include "core/units.hpp"
#include "scene/section.hpp"
#include "sliding/equilibrium/shaken_base.hpp"

#include <cmath>

namespace damslip::sliding {

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
    while (already - not_yet > 1e-12 * already) {
        const double middle = not_yet + 0.5 * (already - not_yet);
        (happens(middle) ? already : not_yet) = middle;
    }
    return already;
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
    while (last - before > 1e-12 * last) {
        const double middle = before + 0.5 * (last - before);
        (happens(middle) ? last : before) = middle;
    }
    return last;
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

} // namespace damslip::sliding
