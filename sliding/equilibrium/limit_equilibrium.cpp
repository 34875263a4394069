#include "sliding/equilibrium/limit_equilibrium.hpp"

#include "core/units.hpp"
#include "scene/joint_bond.hpp"
#include "scene/section.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/equilibrium/base_state.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace damslip::sliding {

const char* word(CombinationKind kind)
{
    switch (kind) {
    case CombinationKind::usual:
        return "usual";
    case CombinationKind::unusual:
        return "unusual";
    case CombinationKind::extreme:
        return "extreme";
    case CombinationKind::post_seismic:
        return "post-seismic";
    }
    return "";
}

const char* word(ResultantZone zone)
{
    switch (zone) {
    case ResultantZone::kern:
        return "kern";
    case ResultantZone::middle_half:
        return "middle-half";
    case ResultantZone::base:
        return "base";
    case ResultantZone::outside:
        return "outside";
    }
    return "";
}

const char* word(CrackRule rule)
{
    switch (rule) {
    case CrackRule::none:
        return "none";
    case CrackRule::fixed_static:
        return "static";
    case CrackRule::seismic_zero:
        return "seismic-zero";
    case CrackRule::seismic_unchanged:
        return "seismic-unchanged";
    case CrackRule::seismic_full:
        return "seismic-full";
    }
    return "";
}

const char* word(CrackStatus status)
{
    switch (status) {
    case CrackStatus::closed:
        return "closed";
    case CrackStatus::partial:
        return "partial";
    case CrackStatus::through:
        return "cracked through";
    case CrackStatus::open:
        return "open";
    }
    return "";
}

const char* word(Verdict verdict)
{
    switch (verdict) {
    case Verdict::pass:
        return "PASS";
    case Verdict::fail:
        return "FAIL";
    case Verdict::no_criterion:
        return "no criterion";
    }
    return "";
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool seismic(const Combination& c)
{
    return c.k_h != 0.0 || c.k_v != 0.0;
}

StaticCase static_case_of(const Scene& scene, const Combination& c, CrackRule rule, const EquilibriumOptions& options)
{
    StaticCase out;
    LoadCase& loads = out.loads;
    loads = scene_load_case(scene);
    if (c.reservoir_level) loads.reservoir_level = c.reservoir_level;
    if (c.tailwater_level) loads.tailwater_level = c.tailwater_level;
    loads.anchors = AnchorForce::limit;
    loads.gates_open = c.gates_open;
    loads.ice = c.ice ? IceLoad::on : IceLoad::off;
    loads.weight_factor = c.weight_factor;
    loads.water_factor = c.water_factor;
    loads.silt_factor = c.silt_factor;
    loads.ice_factor = c.ice_factor;
    out.uplift = {loads.reservoir_level, loads.tailwater_level,
                  c.drains_effective ? DrainState::effective : DrainState::ineffective,
                  c.curtain_intact ? CurtainState::intact : CurtainState::damaged};
    out.uplift_factor = c.uplift_factor;
    out.crack = rule;
    if (c.kind == CombinationKind::post_seismic) out.opened = options.opened;
    return out;
}

/// A sum of the loads, and of the uplift, that is no more than the rounding of its terms is none.
double without_round_off(double sum, const Equilibrium& e)
{
    double terms = std::abs(e.base.uplift.force);
    for (const Load& load : e.loads) terms += std::abs(load.force.total().x) + std::abs(load.force.total().y);
    return std::abs(sum) <= 1e-13 * terms ? 0.0 : sum;
}

double factor(double resisting, double driving)
{
    return driving > 0.0 ? resisting / driving : infinity;
}

struct Strength {
    double friction, cohesion;
};

Strength peak(const Scene& scene, const Combination& c)
{
    const Contact& contact = scene.contact;
    return {c.friction.value_or(FrictionOverSlip(contact).peak()) / c.friction_divisor,
            c.cohesion.value_or(contact.cohesion) / c.cohesion_divisor};
}

Strength residual(const Scene& scene, const Combination& c)
{
    const Contact& contact = scene.contact;
    const Strength from = peak(scene, c);
    Strength out{from.friction, contact.cohesion_lost_at_slip || c.residual_strength ? 0.0 : from.cohesion};
    if (const FrictionOverSlip friction(contact); !friction.constant())
        out.friction = friction.residual() / c.friction_divisor;
    if (c.residual_strength && c.friction) out.friction = from.friction;
    return out;
}

void anchor_forces(const Scene& scene, Equilibrium& e)
{
    e.dowel_force = dowel_force(scene, AnchorForce::limit);
    for (const Anchor& anchor : scene.anchors) {
        if (!anchor.joint.empty()) continue;
        const double force = force_of(anchor, AnchorForce::limit);
        e.anchor_force += force;
        e.anchor_shear += (force - anchor.prestress) * std::sin(anchor.inclination);
    }
}

/// That the yield force is there only once the dam has slid.
void note_yield_forces(const Scene& scene, Equilibrium& e)
{
    for (const Anchor& anchor : scene.anchors) {
        if (!anchor.joint.empty() || force_of(anchor, AnchorForce::limit) == anchor.prestress) continue;
        const double slip = anchor_bar(anchor, 0.0).slip_to_yield();
        e.notes.push_back({NoteKind::yield_force_counts, {anchor.name, slip / units::mm}});
    }
}

void sliding_factors(Equilibrium& e)
{
    const double normal = std::max(0.0, e.base.effective_normal), without_slip = e.shear + e.anchor_shear;
    const bool resists = without_slip * e.anchor_shear > 0.0;
    const double shear = std::abs(resists ? without_slip : e.shear);
    const double anchors = e.dowel_force + (resists ? std::abs(e.anchor_shear) : 0.0);
    e.sliding_factor = factor(e.cohesion * e.cohesive_length + e.friction * normal + anchors, shear);
    e.friction_factor = factor(e.friction * normal + anchors, shear);
    e.sliding_factor_residual =
        factor(e.residual_cohesion * e.cohesive_length + e.residual_friction * normal + anchors, shear);
    e.critical_friction =
        normal > 0.0 ? std::max(0.0, shear - e.cohesion * e.cohesive_length - anchors) / normal : infinity;
}

Force uplift_force(const Equilibrium& e)
{
    const double u = e.base.uplift.force;
    return {u * e.frame.n.x, u * e.frame.n.y, e.base.uplift.moment_about_heel};
}

/// Stabilising over overturning moment; horizontal and vertical part of every load count on their own.
double overturning_factor(const Equilibrium& e, Point toe_point)
{
    const bool downstream = e.shear >= 0.0;
    const Point pivot = downstream ? toe_point : Point{};
    double stabilising = 0.0, overturning = 0.0;
    const auto add = [&](const Force& f) {
        const double m = downstream ? moment_about(f, pivot) : -moment_about(f, pivot);
        (m > 0.0 ? stabilising : overturning) += std::abs(m);
    };
    for (const Load& load : e.loads) {
        add(load.force.horizontal);
        add(load.force.vertical);
    }
    add(uplift_force(e));
    return factor(stabilising, overturning);
}

/// (W + S)/(U - W_G), EM 1110-2-2100 (2005) eq. (3-2): W weight (with its vertical inertia), S vertical user forces and anchors, U
/// uplift, W_G water standing on the structure. Infinite if the water on top outweighs the uplift.
double flotation_factor(const Equilibrium& e)
{
    double weight = 0.0, water = 0.0;
    for (const Load& load : e.loads) {
        const double down = -load.force.vertical.y;
        switch (load.kind) {
        case LoadKind::weight:
        case LoadKind::inertia:
        case LoadKind::point_force:
        case LoadKind::anchor:
            weight += down;
            break;
        case LoadKind::reservoir:
        case LoadKind::tailwater:
        case LoadKind::crest_water:
            water += down;
            break;
        default:
            break;
        }
    }
    return factor(weight, uplift_force(e).y - water);
}

ResultantZone zone_of(double eccentricity, double length, bool pressed)
{
    const double e = std::abs(eccentricity) / length, slack = 1e-12;
    if (!pressed || !(e <= 0.5 + slack)) return ResultantZone::outside;
    if (e <= 1.0 / 6.0 + slack) return ResultantZone::kern;
    return e <= 0.25 + slack ? ResultantZone::middle_half : ResultantZone::base;
}

/// Linear effective stress over the compressed part.
void base_stresses(Equilibrium& e)
{
    const CrackedBase& base = e.base;
    const double length = base.compressed_length;
    if (base.status == CrackStatus::open || base.status == CrackStatus::through || !(length > 0.0)) {
        e.heel_stress = e.toe_stress = nan;
        return;
    }
    const double start = base.compressed_side == Side::toe ? e.frame.length - length : 0.0;
    const double mean = base.effective_normal / (length * e.frame.share);
    const double lever = (base.resultant_distance - start) / length - 0.5;
    e.heel_stress = mean * (1.0 - 6.0 * lever);
    e.toe_stress = mean * (1.0 + 6.0 * lever);
    // The crack search ends where the tip stress is zero: what is left there is round-off. A static crack that the
    // earthquake may not open further keeps the tension it gets.
    const bool kept = e.crack_rule == CrackRule::fixed_static && (e.k_h != 0.0 || e.k_v != 0.0);
    if (base.status == CrackStatus::partial && !kept)
        (base.compressed_side == Side::toe ? e.heel_stress : e.toe_stress) = 0.0;
}

void resultant_position(Equilibrium& e)
{
    e.resultant_from_toe = e.frame.length - e.base.resultant_distance;
    e.eccentricity = e.base.resultant_distance - 0.5 * e.frame.length;
    const bool pressed = e.base.effective_normal > 0.0 && e.base.status != CrackStatus::through;
    e.zone = zone_of(e.eccentricity, e.frame.length, pressed);
}

Check least(const char* quantity, double value, const std::optional<double>& required, const std::string& source)
{
    const Verdict verdict = !required ? Verdict::no_criterion : value >= *required ? Verdict::pass : Verdict::fail;
    return {quantity, value, required, verdict, required ? source : ""};
}

Check resultant_check(const Equilibrium& e, const Requirements& required)
{
    Check check{
        "resultant, distance from the middle / base length", std::abs(e.eccentricity) / e.frame.length, {}, {}, ""};
    check.verdict = Verdict::no_criterion;
    if (!required.resultant) return check;
    check.required = *required.resultant == ResultantZone::kern          ? 1.0 / 6.0
                     : *required.resultant == ResultantZone::middle_half ? 0.25
                                                                         : 0.5;
    check.verdict = e.zone <= *required.resultant ? Verdict::pass : Verdict::fail;
    check.source = required.source;
    return check;
}

void add_checks(Equilibrium& e, const Combination& c, const Requirements& required)
{
    e.checks.push_back(least(c.residual_strength ? "sliding, residual strength" : "sliding, peak strength",
                             e.sliding_factor, required.sliding, required.source));
    if (!c.residual_strength)
        e.checks.push_back(
            least("sliding, residual strength", e.sliding_factor_residual, required.sliding_residual, required.source));
    e.checks.push_back(least("overturning", e.overturning_factor, required.overturning, required.source));
    e.checks.push_back(least("flotation", e.flotation_factor, required.flotation, required.source));
    e.checks.push_back(resultant_check(e, required));
}

void add_notes(Equilibrium& e)
{
    if (e.base.effective_normal <= 0.0)
        e.notes.push_back({NoteKind::uplift_carries_block});
    else if (e.base.status == CrackStatus::open)
        e.notes.push_back({NoteKind::opens_wholly});
    else if (e.base.status == CrackStatus::through)
        e.notes.push_back(
            {NoteKind::cracked_through,
             {e.base.compressed_length, e.frame.length,
              2.0 * e.base.effective_normal / (e.base.compressed_length * e.frame.share) / units::MPa}});
    if (e.crack_rule == CrackRule::none && std::min(e.heel_stress, e.toe_stress) < 0.0)
        e.notes.push_back({NoteKind::tension_without_crack});
    if (e.sliding_factor < 1.0) e.notes.push_back({NoteKind::shear_beyond_strength});
}

} // namespace

Equilibrium evaluate(const Scene& scene, const Combination& c, const Requirements& required,
                     const EquilibriumOptions& options)
{
    Equilibrium e;
    e.name = c.name;
    e.kind = c.kind;
    e.crack_rule = c.crack.value_or(scene.uplift ? scene.uplift->crack : CrackRule::none);
    e.k_h = c.k_h;
    e.k_v = c.k_v;
    const StaticCase static_case = static_case_of(scene, c, e.crack_rule, options);
    e.reservoir_level = static_case.loads.reservoir_level;
    e.tailwater_level = static_case.loads.tailwater_level;

    // 1. the static state before the earthquake, 2. the earthquake on top of it
    const BaseState before = base_state(scene, static_case, options.seepage);
    const AddedMassIntegral water = scene_added_mass(scene, e.reservoir_level);
    const double a_h = c.k_h * units::standard_gravity, a_v = c.k_v * units::standard_gravity;
    e.frame = before.frame;
    e.loads = before.loads;
    e.base = before.base;
    if (seismic(c))
        for (Load& load : earthquake_loads(scene, water, a_h, a_v, c.k_profile)) e.loads.push_back(std::move(load));
    e.load = resultant(e.loads);
    if (seismic(c)) e.base = shaken_base(scene, static_case, before, e.load, options.seepage);
    e.base.effective_normal = without_round_off(e.base.effective_normal, e);
    if (e.base.effective_normal == 0.0) e.base.resultant_distance = nan;
    const bool kept = e.crack_rule == CrackRule::fixed_static && seismic(c); // a crack that may not open further
    if (!kept && cracked_through(e.base, e.frame.length)) e.base.status = CrackStatus::through;
    e.cohesive_length = e.base.status == CrackStatus::through ? 0.0 : bonded_length(before, e.base);

    // 3. strengths and factors
    const Strength residual_strength = residual(scene, c);
    const Strength used = c.residual_strength ? residual_strength : peak(scene, c);
    e.friction = used.friction;
    e.cohesion = used.cohesion;
    e.residual_friction = residual_strength.friction;
    e.residual_cohesion = residual_strength.cohesion;
    e.shear = without_round_off(shear(e.frame, e.load), e);
    const Point toe_point = toe(scene.section);
    anchor_forces(scene, e);
    sliding_factors(e);
    e.overturning_factor = overturning_factor(e, toe_point);
    e.flotation_factor = flotation_factor(e);
    resultant_position(e);
    base_stresses(e);

    // 4. accelerations, with the uplift and crack of the static state
    BlockOptions block_options;
    block_options.friction = e.friction;
    block_options.cohesion = e.cohesion;
    const RigidBlock block = make_rigid_block(scene, before, e.reservoir_level, block_options);
    e.yield_acceleration = yield_downstream(block).law.at(a_v);
    e.yield_acceleration_upstream = yield_upstream(block).law.at(a_v);
    e.tipping_acceleration = tipping_acceleration(scene, water, before, a_v, Towards::downstream);

    add_checks(e, c, required);
    add_notes(e);
    note_yield_forces(scene, e);
    return e;
}

} // namespace damslip::sliding
