#include "fe2d/run/stages.hpp"

#include "fe2d/contact/anchor_law.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/run/dynamic_contact.hpp"
#include "fe2d/run/static_contact.hpp"
#include "scene/section.hpp"
#include "scene/uplift_models.hpp"
#include "scene/water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

BaseResultant base_resultant(const ContactStructure& structure, const VectorXd& ordered_load, Index index)
{
    const Mesh& mesh = structure.model().mesh;
    const VectorXd dam_load = structure.order().to_old(ordered_load);
    const Plane& plane = structure.planes()[index];
    const std::vector<char>& above = structure.planes().above(index);
    const int first = index == 0 ? mesh.contact.dam_nodes.front()
                                 : mesh.lifts[static_cast<std::size_t>(index - 1)].upper_nodes.front();
    const Point end = mesh.nodes[first];
    Eigen::Vector2d force = Eigen::Vector2d::Zero();
    double moment = 0.0; // about the upstream end, counter-clockwise
    for (int node = 0; node < mesh.dam_node_count; ++node) {
        if (!above[static_cast<std::size_t>(node)]) continue;
        const double fx = dam_load[2 * node], fy = dam_load[2 * node + 1];
        force += Eigen::Vector2d(fx, fy);
        moment += (mesh.nodes[node].x - end.x) * fy - (mesh.nodes[node].y - end.y) * fx;
    }
    // N' acts upwards at `position` and balances the moment of the loads: position N' = -moment.
    const double normal = -plane.normal.dot(force);
    return {normal, plane.tangent.dot(force), normal != 0.0 ? -moment / normal : 0.0};
}

LoadStages load_stages(const Scene& scene, const Model& model, const PressureProfile& uplift, const VectorXd& in_rock)
{
    const StaticLoads loads = static_loads(scene, model);
    LoadStages stages;
    VectorXd sum = sum_of(loads.gravity, model.dofs.count);
    if (!loads.rock.empty()) sum += sum_of(loads.rock, model.dofs.count); // zero_displacement() of the run takes it off
    stages.names.push_back("gravity");
    stages.loads.push_back(sum);
    if (std::any_of(scene.anchors.begin(), scene.anchors.end(), [](const Anchor& a) { return a.prestress > 0.0; })) {
        stages.names.push_back("prestress"); // by AnchorLaw: within the joints, no load on the model
        stages.loads.push_back(sum);
    }
    if (!loads.impounding.empty()) {
        sum += sum_of(loads.impounding, model.dofs.count);
        stages.names.push_back("water");
        stages.loads.push_back(sum);
    }
    const VectorXd in_joints = lift_water(scene, model);
    stages.before_uplift = sum;
    if (in_joints.size() > 0) stages.before_uplift += in_joints;
    if (in_rock.size() > 0) stages.before_uplift += in_rock;
    if (!uplift.empty() || in_joints.size() > 0 || in_rock.size() > 0) {
        stages.names.push_back("uplift");
        stages.loads.push_back(uplift.empty() ? stages.before_uplift : load_with(stages, model, uplift));
    }
    return stages;
}

VectorXd load_with(const LoadStages& stages, const Model& model, const PressureProfile& uplift)
{
    if (uplift.empty()) return stages.last();
    VectorXd sum = stages.before_uplift;
    for (const ContactSide side : {ContactSide::dam, ContactSide::rock})
        sum += uplift_load(model.mesh, model.dofs, uplift, side);
    return sum;
}

void let_water_ride(const ContactStructure& structure, const PressureProfile& uplift, SplitLoad& load)
{
    if (!structure.slides_far() || uplift.empty()) return;
    const Model& model = structure.model();
    const VectorXd on_dam = uplift_load(model.mesh, model.dofs, uplift, ContactSide::dam);
    const VectorXd on_rock = uplift_load(model.mesh, model.dofs, uplift, ContactSide::rock);
    const VectorXd dam = structure.to_order(on_dam);
    load.joint = -(structure.gaps() * dam);
    load.rock -= structure.split(on_rock).rock;
}

namespace {

/// @param bond  its tensile strength helps to carry the moment
StageStatus judge(const BaseResultant& r, double resistance, const PlaneLimit& bond)
{
    if (!(r.normal_force + bond.tension_strength > 0.0)) return StageStatus::floats;
    if (std::abs(r.shear_force) > resistance) return StageStatus::slides;
    if (bond.tension_strength == 0.0) {
        if (r.position < 0.0 || r.position > bond.length) return StageStatus::overturns;
        return StageStatus::ok;
    }
    const double all = r.normal_force + bond.tension_strength,
                 position = (r.position * r.normal_force + 0.5 * bond.length * bond.tension_strength) / all;
    return position < 0.0 || position > bond.length ? StageStatus::overturns : StageStatus::ok;
}

std::string plane_name(const ContactStructure& structure, Index index)
{
    const Mesh& mesh = structure.model().mesh;
    if (index == 0) return mesh.seam ? "seam" : "base";
    const LiftPlane& lift = mesh.lifts[static_cast<std::size_t>(index - 1)];
    if (mesh.seam && index == 1) return "base";
    if (lift.upright)
        return fmt::format("interface at {:.6g} m", mesh.nodes[static_cast<std::size_t>(lift.upper_nodes.front())].x);
    const int node = mesh.lifts[static_cast<std::size_t>(index - 1)].upper_nodes.front();
    const int heel = mesh.seam ? mesh.seam->base.front() : mesh.contact.dam_nodes.front();
    return fmt::format("lift joint at {:.6g} m", mesh.nodes[node].y - mesh.nodes[heel].y);
}

/// All strength of a plane's bond at once; nothing where its bond takes no work to break.
PlaneLimit bond_limit(const ContactStructure& structure, Index index, const ContactMemory& memory)
{
    PlaneLimit limit;
    limit.length = structure.planes()[index].length();
    const auto* bond = memory.laws.find<BondLaw>();
    if (!bond) return limit;
    const Index first = structure.planes().first(index), pairs = structure.planes()[index].pairs();
    for (Index i = first; i < first + pairs; ++i) {
        if (bond->damage()[i] >= 1.0) continue;
        const BondStrength& b = bond->strength()[static_cast<std::size_t>(i)];
        limit.shear_strength += std::hypot(b.shear, b.friction * b.tension);
        limit.tension_strength += b.tension;
        limit.cohesion += b.shear * b.left(bond->damage()[i]);
        limit.friction = b.friction;
    }
    return limit;
}

/// What presses on the joint when anchors pull on it, too.
BaseResultant with_anchors(const BaseResultant& loads, const AnchorLaw::Support& anchors)
{
    BaseResultant r{loads.normal_force + anchors.normal, loads.shear_force - anchors.along, 0.0};
    if (r.normal_force != 0.0) r.position = (loads.position * loads.normal_force + anchors.moment) / r.normal_force;
    return r;
}

/// Resultants against the strength of the whole plane: cohesion on all of it, the weakest friction. Factor and critical friction are those
/// of μN' + cA; it fails for certain only beyond the bond's bound (PlaneLimit). Anchors count with the force they have; they fail only where
/// their yield forces would not hold it either.
PlaneBalance balance(const ContactStructure& structure, Index index, const VectorXd& dam_load, const ContactLaw& law,
                     const PlaneLimit& bond, const AnchorLaw* anchors)
{
    const Index first = structure.planes().first(index), pairs = structure.planes()[index].pairs();
    PlaneBalance result;
    result.plane = plane_name(structure, index);
    if (!structure.planes()[index].bears_alone()) { // what else holds is not known: read_state()
        result.sliding_factor = std::numeric_limits<double>::infinity();
        return result;
    }
    const BaseResultant of_loads = base_resultant(structure, dam_load, index);
    result.resultant = of_loads;
    AnchorLaw::Support now, most;
    if (anchors) {
        const VectorXd distance = structure.planes()[index].distance.array() - structure.planes()[index].distance[0];
        now = anchors->support(AnchorLaw::Force::next_stage, first, pairs, distance);
        most = anchors->support(AnchorLaw::Force::yield, first, pairs, distance);
        if (now.any) result.resultant = with_anchors(of_loads, now);
    }
    const double normal = result.resultant.normal_force, shear = std::abs(result.resultant.shear_force);
    const double cohesion = law.cohesion.segment(first, pairs).sum() + bond.cohesion + now.dowel,
                 resistance = law.friction.segment(first, pairs).minCoeff() * normal + cohesion,
                 bound = resistance + bond.shear_strength - bond.cohesion;
    result.critical_friction = std::max(0.0, shear - cohesion) / normal;
    // A balance of the loads on the dam alone: round-off of sums of order N' is not a shear force.
    result.sliding_factor =
        shear > 1e-12 * std::abs(normal) ? resistance / shear : std::numeric_limits<double>::infinity();
    result.status = judge(result.resultant, bound, bond);
    if (most.any && result.status != StageStatus::ok) {
        const BaseResultant yielding = with_anchors(of_loads, most);
        const double held = bound + law.friction.segment(first, pairs).minCoeff() * (most.normal - now.normal);
        result.status = judge(yielding, held, bond);
    }
    return result;
}

/// Of a plane that is one of several that hold a body, statics alone tell nothing: what its main pairs carry.
void read_forces(const ContactPlanes& planes, Index index, const ContactMemory& memory, const ContactLaw& law,
                 PlaneBalance& result)
{
    const Plane& plane = planes[index];
    const Index first = planes.first(index), pairs = plane.main_pairs();
    const VectorXd force = memory.contact_force(), normal = force.segment(first, pairs),
                   distance = plane.distance.head(pairs).array() - plane.distance[0];
    double cohesion = 0.0;
    for (Index i = 0; i < pairs; ++i)
        if (memory.states[static_cast<std::size_t>(first + i)] != ContactState::open) cohesion += law.cohesion[first + i];
    BaseResultant& r = result.resultant;
    r.normal_force = normal.sum();
    r.shear_force = -force.segment(planes.pairs() + first, pairs).sum();
    r.position = r.normal_force > 0.0 ? normal.dot(distance) / r.normal_force : 0.0;
    const double shear = std::abs(r.shear_force);
    result.critical_friction = r.normal_force > 0.0 ? std::max(0.0, shear - cohesion) / r.normal_force : 0.0;
    if (shear > 1e-12 * r.normal_force)
        result.sliding_factor = (law.friction.segment(first, pairs).minCoeff() * r.normal_force + cohesion) / shear;
}

/// Where the solver has opened the joint there is no cohesion.
void read_state(const ContactPlanes& planes, Index index, const ContactMemory& memory, const ContactLaw& law,
                PlaneBalance& result)
{
    const Index first = planes.first(index);
    const Plane& plane = planes[index];
    result.slip = planes.mean(index, memory.slip);
    double without = 0.0;
    for (Index i = 0; i < plane.pairs(); ++i) {
        const ContactState state = memory.states[static_cast<std::size_t>(first + i)];
        if (state == ContactState::open) {
            result.open_length += plane.area[i] / plane.share;
            without += law.cohesion[first + i];
        }
        if (is_slip(state)) result.slipping_length += plane.area[i] / plane.share;
    }
    if (!plane.bears_alone()) return read_forces(planes, index, memory, law, result);
    if (std::isfinite(result.sliding_factor)) result.sliding_factor -= without / std::abs(result.resultant.shear_force);
}

PlaneLoad plane_load(const BaseResultant& r)
{
    return {r.normal_force, r.shear_force, r.normal_force * r.position};
}

/// The load comes bit by bit where the bond breaks on the way. @returns false: it is not carried
bool follow_bond(StaticContact& statics, const ContactStructure& structure, const SplitLoad& before,
                 const SplitLoad& load, const ContactLaw& law, ContactMemory& memory, StageResult& result)
{
    BondLoad& bond = result.bond.emplace();
    bond.limit = std::numeric_limits<double>::infinity();
    for (Index k = 0; k < structure.planes().count(); ++k)
        bond.limit = std::min(bond.limit, limit_load(bond_limit(structure, k, memory),
                                                     plane_load(base_resultant(structure, before.dam, k)),
                                                     plane_load(base_resultant(structure, load.dam, k))));
    const StaticPath path = follow_damage(statics.with_laws(), statics.linear().shut_force(before),
                                          statics.linear().shut_force(load), law, memory);
    bond.largest = bond.carried = path.largest_load;
    bond.events = path.events;
    result.contact = path.contact;
    return path.holds;
}

SplitLoad between(const SplitLoad& before, const SplitLoad& load, double t)
{
    const auto mean = [t](const VectorXd& a, const VectorXd& b) -> VectorXd {
        if (a.size() == 0) return t * b;
        if (b.size() == 0) return (1.0 - t) * a;
        return (1.0 - t) * a + t * b;
    };
    return {mean(before.dam, load.dam), mean(before.rock, load.rock), mean(before.joint, load.joint)};
}

constexpr int tried_shares = 16; ///< of a load that is not carried, each brought on at once

/// Largest share of the load that the bond carries when it comes at once; 0: none of those tried.
/// @param memory  before the load @param least  shares below are of no interest
double carried_at_once(StaticContact& statics, const SplitLoad& before, const SplitLoad& load, const ContactLaw& law,
                       const ContactMemory& memory, double least)
{
    const auto stands = [&](double t) {
        ContactMemory trial = memory;
        return statics.solve(between(before, load, t), law, trial).resolved();
    };
    constexpr double part = 1.0 / tried_shares;
    double low = 0.0;
    for (int k = tried_shares - 1; k > 0 && low == 0.0 && k * part > least; --k)
        if (stands(k * part)) low = k * part;
    if (low == 0.0) return 0.0;
    double high = low + part;
    while (high - low > 1e-3 * high) {
        const double middle = 0.5 * (low + high);
        (stands(middle) ? low : high) = middle;
    }
    return low;
}

constexpr double first_jump = 1e-3; ///< load beyond the limit point with which the dam is released; doubled each time [-]

/// From the limit point the dam is released under a little more load. Where it comes to rest the load goes on.
/// @param memory  at the limit point; changed as far as it went @returns whether it holds the whole load
bool jump(StaticContact& statics, const SplitLoad& before, const SplitLoad& load, const ContactLaw& law,
          const Relaxation& relax, ContactMemory& memory, BondLoad& bond, ContactReport& report)
{
    double at = bond.largest;
    for (double more = first_jump; at < 1.0; more *= 2.0) {
        const double next = std::min(1.0, at + more);
        const SplitLoad higher = between(before, load, next);
        const StaticState start = statics.displacements(between(before, load, at), memory);
        const Release release = relax(higher, start, law, memory);
        bond.lost += release.lost;
        if (!release.rests) return false;
        ++bond.jumps;
        at = next;
        bond.carried = at;
        ContactMemory settled = memory;
        if (const ContactReport end = statics.solve(load, law, settled); end.resolved()) {
            report = end;
            memory = std::move(settled);
            break;
        }
        const StaticPath path = follow_damage(statics.with_laws(), statics.linear().shut_force(higher),
                                              statics.linear().shut_force(load), law, memory);
        bond.events += path.events;
        if (path.contact.resolved()) report = path.contact;
        at = path.holds ? 1.0 : at + path.largest_load * (1.0 - at);
        bond.carried = at;
    }
    bond.carried = 1.0;
    return true;
}

} // namespace

StageResult solve_stage(StaticContact& statics, const ContactStructure& structure, const std::string& name,
                        const SplitLoad& load, Strength& strength, ContactMemory& memory, const SplitLoad* before,
                        const Relaxation& relax)
{
    const ContactPlanes& planes = structure.planes();
    const ContactLaw& law = strength.law();
    const AnchorLaw* anchors = memory.laws.find<AnchorLaw>();
    StageResult result;
    result.name = name;
    static_cast<PlaneBalance&>(result) =
        balance(structure, 0, load.dam, law, bond_limit(structure, 0, memory), anchors);
    result.base_fails = result.status != StageStatus::ok;
    for (Index k = 1; k < planes.count(); ++k) {
        result.lifts.push_back(balance(structure, k, load.dam, law, bond_limit(structure, k, memory), anchors));
        if (result.status == StageStatus::ok) result.status = result.lifts.back().status;
    }
    if (result.status != StageStatus::ok) return result;

    ContactMemory trial = memory;
    result.contact = statics.solve(load, law, trial);
    if (!result.contact.resolved() && before && memory.laws.find<BondLaw>()) {
        trial = memory;
        if (!follow_bond(statics, structure, *before, load, law, trial, result) &&
            !(relax && jump(statics, *before, load, law, relax, trial, *result.bond, result.contact))) {
            result.status = StageStatus::progressive;
            BondLoad& bond = *result.bond;
            bond.largest = std::max(bond.largest, bond.carried);
            bond.largest = std::max(bond.largest, carried_at_once(statics, *before, load, law, memory, bond.largest));
            return result;
        }
        result.bond->largest = 1.0;
    } else if (!result.contact.resolved()) {
        result.status = StageStatus::not_resolved;
        return result;
    }
    memory = std::move(trial);
    read_state(planes, 0, memory, law, result);
    for (Index k = 1; k < planes.count(); ++k)
        read_state(planes, k, memory, law, result.lifts[static_cast<std::size_t>(k - 1)]);
    strength.follow(memory);
    return result;
}

double head_in_crack(const Scene& scene, const LiftJoint& lift, const Plane& plane, const BondLengths& crack)
{
    const VectorXd distance = plane.distance.array() - plane.distance[0];
    const PressureProfile water = lift_water_profile(scene, lift, distance[distance.size() - 1]);
    const double unit_weight = water_unit_weight(scene) * share_above(scene.section, lift.elevation);
    double up = scene.reservoir ? unit_weight * std::max(0.0, scene.reservoir->level - lift.elevation) : 0.0,
           down = scene.tailwater ? unit_weight * std::max(0.0, scene.tailwater->level - lift.elevation) : 0.0;
    if (crack.through()) up = down = std::max(up, down);
    const double from = crack.upstream / plane.share, to = plane.length() - crack.downstream / plane.share;
    const double at_from = crack.upstream > 0.0 ? up - pressure_at(water, from) : 0.0,
                 at_to = crack.downstream > 0.0 ? down - pressure_at(water, to) : 0.0;
    double sum = 0.0;
    for (Index i = 0; i < plane.pairs(); ++i) {
        const double x = distance[i], now = pressure_at(water, x);
        double more = water.empty() ? 0.0 : at_from + (at_to - at_from) * (x - from) / (to - from);
        if (crack.upstream > 0.0 && x <= from)
            more = up - now;
        else if (crack.downstream > 0.0 && x >= to)
            more = down - now;
        sum += std::max(0.0, more) * plane.area[i] / plane.share; // pressures are per metre of dam
    }
    return sum;
}

StageResult stage_after(StaticContact& statics, const ContactStructure& structure, const CrackedUplift& uplift,
                        const CrackLengths& cracked, const std::function<SplitLoad(const PressureProfile&)>& load,
                        Strength strength, const ContactMemory& memory, const SplitLoad* before, const Relaxation& relax)
{
    const auto uplift_of = [&](const CrackLengths& crack) {
        return uplift ? uplift(crack.upstream, crack.downstream) : PressureProfile();
    };
    strength.lose_broken();
    CrackLengths crack = cracked;
    PressureProfile profile = uplift_of(crack);
    for (Index round = 0;; ++round) { // a crack that takes water may open further under it
        Strength left = strength;
        ContactMemory at_rest = memory;
        StageResult result = solve_stage(statics, structure, "after the earthquake", load(profile), left, at_rest,
                                         before, relax);
        if (profile.points != uplift_of({}).points)
            result.flooded = crack.upstream + crack.downstream;
        const CrackLengths &was = strength.opened(), &now = left.opened();
        if (now.upstream > was.upstream) crack.upstream = std::max(crack.upstream, now.upstream);
        if (now.downstream > was.downstream) crack.downstream = std::max(crack.downstream, now.downstream);
        PressureProfile next = uplift_of(crack);
        if (result.status != StageStatus::ok || round == structure.plane().pairs() ||
            next.points == profile.points)
            return result;
        profile = std::move(next);
    }
}

Status status_of(StageStatus stage)
{
    switch (stage) {
    case StageStatus::slides:
    case StageStatus::progressive:
        return Status::static_failure;
    case StageStatus::floats:
        return Status::floats;
    case StageStatus::overturns:
        return Status::overturns;
    case StageStatus::ok:
    case StageStatus::not_resolved:
        break;
    }
    return Status::not_resolved;
}

std::vector<Note> StageResult::notes() const
{
    const PlaneBalance* weakest = this; // the base where it fails, else the first joint that does
    for (const PlaneBalance& lift : lifts)
        if (!base_fails && weakest == this && lift.status != StageStatus::ok) weakest = &lift;
    const bool is_base = weakest == this;
    const BaseResultant& r = weakest->resultant;
    const double normal = 1e-6 * r.normal_force, shear = 1e-6 * r.shear_force;
    const std::string body = is_base ? "the dam" : "what is above the " + weakest->plane;
    const std::string stage =
        flooded > 0.0 ? fmt::format("{}, full head on {:.4g} m of the base", name, flooded) : name;
    switch (status) {
    case StageStatus::ok: {
        std::vector<Note> all{
            {NoteKind::stage_holds, {stage, normal, shear, 1e3 * slip, open_length, critical_friction}}};
        if (bond && bond->jumps > 0)
            all.push_back({NoteKind::stage_jumped, {std::int64_t{bond->jumps}, bond->lost}});
        return all;
    }
    case StageStatus::slides:
        return {{NoteKind::stage_slides, {stage, body, normal, shear, weakest->critical_friction}}};
    case StageStatus::floats:
        return {{flooded > 0.0 ? NoteKind::stage_crack_floats : NoteKind::stage_floats, {stage, body, normal, shear}}};
    case StageStatus::overturns:
        return {{NoteKind::stage_overturns,
                 {stage, body, normal, shear, r.position, is_base ? "heel" : "upstream face",
                  is_base ? "base" : "joint"}}};
    case StageStatus::progressive: {
        const BondLoad carried = bond.value_or(BondLoad{.largest = 0.0});
        if (carried.jumps > 0)
            return {{NoteKind::stage_progressive_jumped,
                     {stage, normal, shear, carried.largest, carried.limit, carried.carried,
                      std::int64_t{carried.jumps}}}};
        return {{NoteKind::stage_progressive, {stage, normal, shear, carried.largest, carried.limit}}};
    }
    case StageStatus::not_resolved:
        break;
    }
    return {{NoteKind::stage_not_resolved,
             {stage, std::int64_t{contact.iterations}, normal, shear, critical_friction}}};
}

namespace {

constexpr double steps_per_period = 40.0;
constexpr double least_damping_ratio = 0.05; ///< of the first mode [-]
constexpr int still_periods = 5;             ///< without slip: at rest
constexpr int most_periods = 400;
constexpr double still = 1e-8;         ///< largest slip of a pair within a period of a dam at rest [m]
constexpr double still_kinetic = 1e-4; ///< kinetic energy of a dam at rest, over the largest on the way [-]
/// Mean slip beyond which a dam whose rate grows slides away [m]; with anchors their longest free length, if that is more: a bar
/// across the joint tightens with the square of the slip.
constexpr double far = 0.1;
constexpr int growing_periods = 5; ///< for so long

/// What one period brought.
struct PeriodWatch {
    VectorXd slip;
    double mean = 0.0, rate = 0.0;
    int still_for = 0, growing_for = 0;

    /// @param now  slips of all pairs [m] @param mean_now  the largest mean of a plane since the start [m]
    /// @param away  slip beyond which nothing tightens any more [m]
    void add(const VectorXd& now, double mean_now, double away, bool calm)
    {
        still_for = calm && (now - slip).cwiseAbs().maxCoeff() <= still ? still_for + 1 : 0;
        const double rate_now = std::abs(mean_now - mean);
        growing_for = mean_now > away && rate_now >= rate ? growing_for + 1 : 0;
        slip = now;
        mean = mean_now;
        rate = rate_now;
    }
};

double largest_mean(const ContactPlanes& planes, const VectorXd& slip)
{
    double largest = 0.0;
    for (Eigen::Index k = 0; k < planes.count(); ++k) largest = std::max(largest, std::abs(planes.mean(k, slip)));
    return largest;
}

Release relax(const std::shared_ptr<StepOperators>& operators, const SplitLoad& load, const StaticState& start,
               const ContactLaw& law, const Contact& joint, const ContactOptions& options, double dt,
               ContactMemory& memory)
{
    DynamicContact motion(operators, load, start, memory, joint, options);
    const ContactPlanes& planes = operators->structure().planes();
    const VectorXd& slip = motion.state().contact.slip;
    PeriodWatch watch;
    watch.slip = slip;
    double fastest = 0.0;
    Release release;
    for (int period = 0; period < most_periods && watch.growing_for < growing_periods; ++period) {
        for (int step = 0; step < static_cast<int>(steps_per_period); ++step) {
            motion.advance(dt, {}, law);
            if (!motion.within_reach()) return release;
        }
        const double kinetic = motion.energy().kinetic;
        fastest = std::max(fastest, kinetic);
        const auto* anchors = motion.state().contact.laws.find<AnchorLaw>();
        const double away = std::max(far, anchors ? anchors->reach() : 0.0);
        watch.add(slip, largest_mean(planes, slip - memory.slip), away, kinetic <= still_kinetic * fastest);
        release.lost = motion.energy().damping + motion.energy().numerical + motion.energy().radiated;
        if (watch.still_for < still_periods) continue;
        memory = motion.state().contact;
        release.rests = true;
        return release;
    }
    return release;
}

} // namespace

double first_period(double height, double young_modulus)
{
    return 381.0 * height / std::sqrt(young_modulus);
}

Relaxation relaxation_of(const ContactStructure& structure, const RunDamping& damping, const Scheme& scheme,
                const ReducedRock* radiating, const Contact& joint, const ContactOptions& options, double period)
{
    RunDamping stiffness_alone = damping;
    stiffness_alone.constants.mass = 0.0;
    stiffness_alone.constants.stiffness =
        std::max(damping.constants.stiffness, least_damping_ratio * period / std::numbers::pi);
    const double dt = period / steps_per_period;
    // Made when they are needed first: most stages hold.
    auto operators = std::make_shared<std::shared_ptr<StepOperators>>();
    return
        [=, &structure](const SplitLoad& load, const StaticState& start, const ContactLaw& law, ContactMemory& memory) {
            if (!*operators)
                *operators = std::make_shared<StepOperators>(
                    structure, stiffness_alone, scheme,
                    std::shared_ptr<const ReducedRock>(std::shared_ptr<const ReducedRock>(), radiating));
            return relax(*operators, load, start, law, joint, options, dt, memory);
        };
}

} // namespace damslip::fe2d
