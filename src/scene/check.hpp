#pragma once

#include "scene/findings.hpp"
#include "scene/key_table.hpp"
#include "scene/read.hpp"

#include <string>

namespace damslip {

/// Turns what [section] says into the polygon. Problems go to `findings`.
Section make_section(const SectionInput& input, Findings& findings);

/// Defaults that depend on other keys: levels, lengths, uplift model.
void fill_defaults(Scene& scene, const Findings& findings);

/// Checks that involve more than one key; each names all keys and values concerned.
void check_consistency(const Scene& scene, Findings& findings, FileCheck files);

/// Notes values that are allowed but unusual beside others: a level above the crest, a tailwater above the reservoir.
void note_unusual(const Scene& scene, Findings& findings);

} // namespace damslip

/// Checks of the scene that involve more than one key, by topic; each names all keys and values concerned.
namespace damslip::checks {

/// "curtain.depth_m = 12"
std::string value(const char* key, double x);

/// "contact.max_slip_m is given, but contact.sliding is not \"finite\"." @param key, unit  "max_slip", "_m"
/// @param choice, word  with which the key counts: "sliding", "finite"
void wrong_without(Findings& f, const std::string& table, const std::string& key, const char* unit, const char* choice,
                   const char* word);

/// Curtain, drains, rock box and uplift along the base.
void check_base(const Scene& s, Findings& f);

/// Rock with mass and the edges of its box.
void check_rock(const Scene& s, Findings& f);

/// @param table  "contact" or "lift_joint[1]"
void check_strength(const Contact& c, const std::string& table, Findings& f);
void check_lift_joints(const Scene& s, Findings& f);

/// Laws of the joints beyond Coulomb's, and what cannot go with them.
void check_joint_laws(const Scene& s, Findings& f);
/// Water that follows the opening of the base.
void check_opening_water(const Scene& s, Findings& f);
/// What follows friction over the rate, rebounds and sequences, and what does not.
void check_rate_methods(const Scene& s, Findings& f);

/// Law and enforcement of the contact.
void check_joint(const Scene& s, Findings& f);
void check_water(const Scene& s, Findings& f);
void check_motion(const Scene& s, Findings& f, FileCheck files);
void check_sequence(const Scene& s, Findings& f);

/// Planes, shape and water of the wedge. @pre scene.wedge
void check_wedge(const Scene& s, Findings& f);
void check_flexible_block(const Scene& s, Findings& f);
void check_combinations(const Scene& s, Findings& f);

/// Keys of an imported mesh against those of the program's own; the file itself is read where it is meshed.
void check_mesh_file(const Scene& s, Findings& f, FileCheck files);
/// Keys that are given, say something else than their default, and change nothing: a resolved scene, which has every key, is
/// no reason for a note.
void note_unread(const Scene& s, Findings& f);

/// Anchors in their joints, and what they cannot go with.
void check_anchors(const Scene& s, Findings& f);

/// Lifts through the dam and seams below it.
void check_planes(const Scene& s, Findings& f);

/// Mesh, damping and time integration.
void check_fe(const Scene& s, Findings& f);

} // namespace damslip::checks
