#pragma once

#include "scene/scene.hpp"

#include <string>
#include <vector>

/// Which method honours which key of a scene file: one table.
namespace damslip {

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
