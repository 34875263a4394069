#pragma once

#include "scene/key_table.hpp"

/// The keys of the scene file by topic, each with its unit, range, default and meaning. keys.cpp puts them in order.
namespace damslip::keys {

/// Title block of the reports.
KeyGroup project_group();

/// @param input  filled instead of a member of the scene: the polygon is made of it afterwards (make_section)
KeyGroup section_group(SectionInput& input);
std::vector<KeyGroup> base_groups();
std::vector<Key> bond_keys();          ///< of the contact's strength
std::vector<Key> rate_keys();          ///< of its friction over the rate, and of landings
std::vector<Key> opening_water_keys(); ///< of [uplift]
KeyGroup anchor_group();
std::vector<KeyGroup> water_groups();
std::vector<KeyGroup> motion_groups();
std::vector<KeyGroup> fe_groups();
std::vector<KeyGroup> wedge_groups();
KeyGroup flexible_block_group();

/// Load combinations of the limit equilibrium.
KeyGroup combination_group();

/// Keys of [contact]; those of the strength are keys of every lift joint too.
std::vector<Key> lift_joint_keys(const std::vector<Key>& contact);

/// How the uplift in a base crack follows from the water: words of uplift.crack and combination.crack.
const std::vector<std::pair<std::string, CrackRule>>& crack_rules();

} // namespace damslip::keys
