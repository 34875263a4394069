#include "fe2d/run/joints_of_scene.hpp"

#include "fe2d/contact/bond_law.hpp"
#include "fe2d/contact/rate_friction_law.hpp"
#include "fe2d/run/anchor_places.hpp"
#include "scene/friction_over_slip.hpp"
#include "scene/joint_bond.hpp"
#include "scene/water.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace damslip::fe2d {

using Eigen::Index;

namespace {

void add_bond(const Scene& scene, const Contact& base, const ContactPlanes& planes, JointLaws& laws)
{
    std::vector<BondStrength> pairs(static_cast<std::size_t>(planes.pairs()));
    bool any = false;
    for (Index k = 0; k < planes.count(); ++k) {
        const Contact& strength = k == 0 ? base : scene.lift_joints[static_cast<std::size_t>(k - 1)].strength;
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

const Contact& strength_of(const Scene& scene, const Contact& base, Index plane)
{
    return plane == 0 ? base : scene.lift_joints[static_cast<std::size_t>(plane - 1)].strength;
}

void add_rate(const Scene& scene, const Contact& base, const ContactPlanes& planes, JointLaws& laws)
{
    std::vector<RateFrictionPart> parts;
    for (Index k = 0; k < planes.count(); ++k)
        if (const RateFriction& rate = strength_of(scene, base, k).rate; rate.active())
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

} // namespace damslip::fe2d
