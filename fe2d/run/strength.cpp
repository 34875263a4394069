#include "fe2d/run/strength.hpp"

#include "fe2d/contact/anchor_law.hpp"
#include "fe2d/contact/bond_law.hpp"
#include "fe2d/contact/joint_law.hpp"
#include "fe2d/run/contact_planes.hpp"
#include "scene/joint_bond.hpp"
#include "scene/planes.hpp"
#include "scene/scene.hpp"
#include "scene/water.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::fe2d {

/// The scene's anchors on the pairs next to where they cross their joints. @returns null for a scene without any
std::unique_ptr<AnchorLaw> anchors_on(const Scene& scene, const ContactPlanes& planes);

using Eigen::Index;

Strength::Strength(const Contact& contact, const Plane& plane) : law_(uniform_law(plane.pairs(), 0.0))
{
    law_.separation = contact.separation;
    base_area_ = plane.area;
    add(contact, 0, plane.area);
}

Strength::Strength(const Contact& base, const std::vector<LiftJoint>& joints, const ContactPlanes& planes,
                   const std::vector<Contact>& segments)
    : law_(uniform_law(planes.pairs(), 0.0))
{
    law_.separation = base.separation; // [contact] says it for all planes
    base_area_ = planes.base().area;
    add(base, 0, base_area_.head(planes.base().main_pairs()));
    for (std::size_t s = 1; s < segments.size(); ++s) {
        const Index first = planes.base().segments[s],
                    end = s + 1 < segments.size() ? planes.base().segments[s + 1] : base_area_.size();
        add(segments[s], first, base_area_.segment(first, end - first));
    }
    base_area_ /= planes.base().share; // lengths of cracks
    for (Index k = 1; k < planes.count(); ++k)
        add(joints[static_cast<std::size_t>(k - 1)].strength, planes.first(k), planes[k].area);
}

void Strength::add(const Contact& contact, Index first, const Eigen::VectorXd& area)
{
    const FrictionOverSlip friction(contact);
    law_.friction.segment(first, area.size()).setConstant(friction.at(0.0));
    Part part{friction, std::nullopt, first, area.size(), {}};
    if (breaks_by_energy(contact)) {
        law_.cohesion.segment(first, area.size()).setZero();
    } else {
        law_.cohesion.segment(first, area.size()) = contact.cohesion * area;
        if (contact.cohesion != 0.0 && contact.cohesion_lost_at_slip) part.loss = bond_loss(contact);
        if (part.loss == BondLoss::together) part.cohesion = contact.cohesion * area;
    }
    if (!friction.constant() || part.loss) constant_ = false;
    parts_.push_back(std::move(part));
    broken_.assign(static_cast<std::size_t>(law_.pairs()), 0);
    last_slip_ = accumulated_ = Eigen::VectorXd::Zero(law_.pairs());
}

void Strength::note_cracks(const ContactStates& states)
{
    const std::size_t base = static_cast<std::size_t>(base_area_.size());
    const auto open = [&](std::size_t i) { return states[i] == ContactState::open; };
    const auto area = [&](std::size_t i) { return base_area_[static_cast<Index>(i)]; };
    CrackLengths now;
    for (std::size_t i = 0; i < base && open(i); ++i) now.upstream += area(i);
    for (std::size_t i = base; i > 0 && open(i - 1); --i) now.downstream += area(i - 1);
    opened_ = {std::max(opened_.upstream, now.upstream), std::max(opened_.downstream, now.downstream)};
    for (std::size_t i = 0; i < broken_.size(); ++i)
        if (states[i] != ContactState::stick) broken_[i] = 1;
}

void Strength::lose_broken()
{
    for (Part& part : parts_)
        for (Index i = part.first; part.loss && i < part.first + part.pairs; ++i) {
            if (!broken_[static_cast<std::size_t>(i)]) continue;
            law_.cohesion[i] = 0.0;
            if (part.cohesion.size() > 0) part.cohesion[i - part.first] = 0.0;
        }
}

void Strength::follow(const ContactMemory& memory)
{
    note_cracks(memory.states);
    if (constant_) return;
    for (Part& part : parts_) {
        if (part.loss == BondLoss::together && part.cohesion.size() > 0 && lose_together(part, memory))
            part.cohesion.resize(0);
        for (Index i = part.first; i < part.first + part.pairs; ++i) {
            accumulated_[i] += std::abs(memory.slip[i] - last_slip_[i]);
            last_slip_[i] = memory.slip[i];
            law_.friction[i] = part.friction.at(accumulated_[i]);
            const ContactState state = memory.states[static_cast<std::size_t>(i)];
            if (part.loss == BondLoss::pairs && state != ContactState::stick) law_.cohesion[i] = 0.0;
            if (part.loss == BondLoss::together) {
                const bool holds = part.cohesion.size() > 0 && state != ContactState::open;
                law_.cohesion[i] = holds ? part.cohesion[i - part.first] : 0.0;
            }
        }
    }
}

/// |Σλ_t| over all closed pairs of a plane against μΣλ_n + c A_closed. Each pair is within its own strength, so the plane has
/// reached it only when every closed pair slips, up to round-off.
bool Strength::lose_together(const Part& part, const ContactMemory& memory) const
{
    double shear = 0.0, strength = 0.0;
    for (Index i = part.first; i < part.first + part.pairs; ++i) {
        if (memory.states[static_cast<std::size_t>(i)] == ContactState::open) continue;
        shear += memory.force[law_.pairs() + i];
        strength += law_.friction[i] * std::max(0.0, memory.force[i]) + part.cohesion[i - part.first];
    }
    return std::abs(shear) >= strength * (1.0 - 1e-9);
}

void Strength::save(RunState& state) const
{
    Strength left = *this;
    left.lose_broken();
    state.path = accumulated_;
    state.cohesion = left.law_.cohesion;
}

void Strength::restore(const RunState& state)
{
    accumulated_ = state.path;
    last_slip_ = state.slip;
    law_.cohesion = state.cohesion;
    for (Part& part : parts_) {
        if (part.cohesion.size() > 0 && (state.cohesion.segment(part.first, part.pairs).array() == 0.0).all())
            part.cohesion.resize(0);
        for (Index i = part.first; i < part.first + part.pairs; ++i) {
            const auto at = static_cast<std::size_t>(i);
            law_.friction[i] = part.friction.at(accumulated_[i]);
            broken_[at] = part.loss && state.cohesion[i] == 0.0;
            // A bond that is lost together acts again where the joint has shut, until the plane reaches its strength.
            if (part.cohesion.size() > 0 && state.states[at] != ContactState::open)
                law_.cohesion[i] = part.cohesion[i - part.first];
        }
    }
}

namespace {

Contact strength_of(const Scene& scene, const Contact& base, Index plane)
{
    return plane == 0 ? base : joints_of(scene)[static_cast<std::size_t>(plane - 1)].strength;
}

void add_bond(const Scene& scene, const Contact& base, const ContactPlanes& planes, JointLaws& laws)
{
    std::vector<BondStrength> pairs(static_cast<std::size_t>(planes.pairs()));
    bool any = false;
    for (Index k = 0; k < planes.count(); ++k) {
        const Contact strength = strength_of(scene, base, k);
        if (!breaks_by_energy(strength)) continue;
        any = true;
        const double friction = FrictionOverSlip(strength).at(0.0);
        const double length = planes[k].length() / static_cast<double>(std::max<Index>(1, planes[k].pairs() - 1));
        const CarriedBond carried = carried_bond(
            strength, joint_modulus(scene, k == 0).value_or(scene.dam.young_modulus.value_or(0.0)), length);
        Bond bond = strength.bond;
        bond.tensile_strength = carried.tensile_strength;
        for (Index i = 0; i < planes[k].pairs(); ++i)
            pairs[static_cast<std::size_t>(planes.first(k) + i)] =
                bond_strength(planes[k].area[i], friction, carried.cohesion, bond);
    }
    if (any) laws.add(std::make_unique<BondLaw>(std::move(pairs)));
}

void add_rate(const Scene& scene, const Contact& base, const ContactPlanes& planes, JointLaws& laws)
{
    std::vector<RateFrictionPart> parts;
    for (Index k = 0; k < planes.count(); ++k)
        if (const RateFriction rate = strength_of(scene, base, k).rate; rate.active())
            parts.push_back({planes.first(k), planes[k].pairs(), rate});
    if (!parts.empty()) laws.add(std::make_unique<RateFrictionLaw>(planes.pairs(), std::move(parts)));
}

/// Friction that falls with the rate and nothing else: between elastic bodies slips of short wave length grow without bound
/// (Rice, Lapusta & Ranjith 2001), so the slip depends on the mesh.
void check_lag(const Contact& joint, const std::string& table, const Scene& scene)
{
    const RateFriction& rate = joint.rate;
    if (!(rate.kinetic_ratio < 1.0) || rate.relaxation_time || rate.relaxation_slip) return;
    throw InputError(Diagnostic{
        scene.file.string(), 0, 0,
        fmt::format(
            "{}.kinetic_friction_ratio = {:g} without {}.relaxation_time_s or relaxation_slip_m, by finite elements.",
            table, rate.kinetic_ratio, table),
        "friction between elastic bodies that lags behind the rate at which it falls: without lag the slip has no "
        "limit as "
        "the mesh is refined",
        "add  relaxation_time_s = 0.05  (or relaxation_slip_m = 0.001), or take the rigid block (damslip screen), "
        "which "
        "needs none"});
}

} // namespace

void check_friction_over_rate(const Scene& scene)
{
    check_lag(scene.contact, "contact", scene);
    for (std::size_t k = 0; k < scene.lift_joints.size(); ++k)
        check_lag(scene.lift_joints[k].strength, fmt::format("lift_joint[{}]", k + 1), scene);
}

void check_rebounds(const Scene& scene)
{
    const Contact& c = scene.contact;
    if (!(c.restitution > 0.0)) return;
    const auto refuse = [&](const std::string& what, const std::string& expected, const std::string& fix) {
        throw InputError(
            Diagnostic{scene.file.string(), 0, 0,
                       fmt::format("contact.restitution = {:g} with {}, by finite elements.", c.restitution, what),
                       expected, fix + ", or delete restitution"});
    };
    if (c.enforcement != ContactEnforcement::exact || c.normal != NormalContact::hard)
        refuse("contact that gives way", "enforcement = \"exact\" and normal = \"hard\": springs rebound by themselves",
               "delete enforcement and normal");
    if (scene.time.scheme == TimeScheme::central_difference)
        refuse("time.scheme = \"central-difference\"", "implicit steps", "write  scheme = \"hht\"  in [time]");
    if (is_acoustic(scene))
        refuse("acoustic water", "water as added mass: an impulse of the dam would be one of the water",
               "write  model = \"added-mass\"  in [reservoir]");
}

JointLaws joint_laws(const Scene& scene, const Contact& base, const ContactPlanes& planes)
{
    JointLaws laws;
    add_bond(scene, base, planes, laws);
    if (auto anchors = anchors_on(scene, planes)) laws.add(std::move(anchors));
    add_rate(scene, base, planes, laws);
    return laws;
}

std::unique_ptr<AnchorLaw> anchors_on(const Scene& scene, const ContactPlanes& planes)
{
    if (scene.anchors.empty()) return nullptr;
    std::vector<PlacedAnchor> all;
    const std::vector<LiftJoint> joints = joints_of(scene);
    for (const Anchor& anchor : scene.anchors) {
        Eigen::Index index = 0;
        if (!anchor.joint.empty()) {
            const auto joint =
                std::find_if(joints.begin(), joints.end(), [&](const LiftJoint& j) { return j.name == anchor.joint; });
            index = 1 + (joint - joints.begin());
        }
        const Contact& contact =
            index == 0 ? scene.contact : joints[static_cast<std::size_t>(index - 1)].strength;
        const Plane& plane = planes[index];
        const double at = plane.distance[0] + anchor.distance;
        Eigen::Index i = 0;
        while (i + 2 < plane.pairs() && plane.distance[i + 1] < at) ++i;
        double share = 0.0;
        if (plane.pairs() > 1)
            share = std::clamp((at - plane.distance[i]) / (plane.distance[i + 1] - plane.distance[i]), 0.0, 1.0);
        all.push_back({anchor_bar(anchor, FrictionOverSlip(contact).peak()), planes.first(index) + i, share});
    }
    return std::make_unique<AnchorLaw>(std::move(all), planes.pairs());
}

} // namespace damslip::fe2d
