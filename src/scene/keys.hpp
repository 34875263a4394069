#pragma once

#include "scene/key_table.hpp"
#include "scene/scene.hpp"

#include <functional>
#include <set>
#include <string>
#include <vector>

/// The keys of the scene file by topic, each with its unit, range, default and meaning. keys.cpp puts them in order.
namespace damslip::keys {

KeyGroup project_group(); ///< title block of the reports
/// @param input  filled instead of a member of the scene: the polygon is made of it afterwards (make_section)
KeyGroup section_group(SectionInput& input);
std::vector<KeyGroup> base_groups();
std::vector<KeyGroup> water_groups();
std::vector<KeyGroup> motion_groups();
std::vector<KeyGroup> fe_groups();
std::vector<KeyGroup> wedge_groups();
KeyGroup flexible_block_group();
KeyGroup combination_group(); ///< load combinations of the limit equilibrium

/// Keys of [contact] as keys of a table whose struct has a strength of its own.
template <class T>
std::vector<Key> strength_keys(const std::vector<Key>& contact, Contact T::*strength, const std::set<std::string>& names)
{
    std::vector<Key> keys;
    for (Key key : contact) {
        if (!names.contains(key.name)) continue;
        key.value = in(strength, std::move(key.value));
        if (key.applies)
            key.applies = [applies = key.applies, strength](const void* object) {
                return applies(&(static_cast<const T*>(object)->*strength));
            };
        keys.push_back(std::move(key));
    }
    return keys;
}

/// [lifts], [[seam]] with the tables inside it, [planes]. @param contact  keys of [contact]
std::vector<KeyGroup> plane_groups(const std::vector<Key>& contact);

/// How the uplift in a base crack follows from the water: words of uplift.crack and combination.crack.
const std::vector<std::pair<std::string, CrackRule>>& crack_rules();

} // namespace damslip::keys

namespace damslip {

/// Puts the settings of `scene.analysis.preset` where `open` allows it. goldgruber-2015 (Goldgruber 2015, chapters 4 and 6):
/// penalty with slip tolerance 0.005, no separation, massless rock on fixed edges, damper and still bottom of acoustic
/// water, relative mass damping, HHT alpha = -1/3 and whole steps of 0.01 s.
/// @param open  may this key, as "time.dt", be set?
void apply_preset(Scene& scene, const std::function<bool(const char* key)>& open);

/// Which method honours which key of a scene file: one table.

/// Methods as bits of a set.
using Methods = unsigned;
namespace methods {
inline constexpr Methods rigid = 1, flexible = 2, equilibrium = 4, regressions = 8, spectrum = 16, fe = 32,
                         reduced = 64, modes = 128;
}

/// Methods whose answer follows the key. The others have no use for it (a rigid block has no modulus), refuse it, or leave
/// out what it asks for and say so: not_honoured().
/// @param table, key  as in the table of keys: "drains", "lost_at_slip"
Methods honoured_by(const std::string& table, const std::string& key);

/// "rigid, flexible, fe", in the order of the bits; "all", "none".
std::string method_words(Methods set);

/// What the scene asks for that these methods leave out of their slip, a note each; no PASS rests on such a slip.
std::vector<Diagnostic> not_honoured(const Scene& scene, Methods set);

} // namespace damslip
