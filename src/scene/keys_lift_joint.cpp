#include "scene/key_parts.hpp"
#include "scene/keys.hpp"

#include <set>

namespace damslip::keys {

namespace {

/// A key of the contact strength as a key of the lift joint that has it.
Key of_joint(Key key)
{
    const auto strength = [](const void* joint) { return &static_cast<const LiftJoint*>(joint)->strength; };
    key.slot = [slot = key.slot, strength](void* joint) { return slot(const_cast<Contact*>(strength(joint))); };
    if (key.applies)
        key.applies = [applies = key.applies, strength](const void* joint) { return applies(strength(joint)); };
    return key;
}

} // namespace

std::vector<Key> lift_joint_keys(const std::vector<Key>& contact)
{
    using J = LiftJoint;
    static const std::set<std::string> of_strength{"friction",
                                                   "cohesion",
                                                   "cohesion_lost_at_slip",
                                                   "residual_slip",
                                                   "residual_path",
                                                   "residual_friction",
                                                   "friction_table",
                                                   "bond",
                                                   "tensile_strength",
                                                   "fracture_energy_tension",
                                                   "fracture_energy_shear",
                                                   "unloading",
                                                   "kinetic_friction_ratio",
                                                   "characteristic_rate",
                                                   "relaxation_time",
                                                   "relaxation_slip"};
    std::vector<Key> keys{word("name", "lift joint and its number", "name in the tables", "\"neck\"", at(&J::name)),
                          number("elevation", length, Range::any(), "required", "of the joint above the heel", "51.5",
                                 at(&J::elevation))};
    for (const Key& key : contact)
        if (of_strength.contains(key.name)) keys.push_back(of_joint(key));
    keys.push_back(word(
        "water", "none",
        "water in the joint, open or not: none, or linear from the head of the reservoir at the upstream face to that "
        "of the tailwater at the downstream face, 0 at a dry face",
        "\"linear\"",
        choice(&J::water, std::vector<std::pair<std::string, JointWater>>{{"none", JointWater::none},
                                                                          {"linear", JointWater::linear}})));
    return keys;
}

} // namespace damslip::keys
