#pragma once

#include "core/input_error.hpp"
#include "scene/keys.hpp"
#include "scene/read.hpp"
#include "scene/scene.hpp"

#include <toml++/toml.h>

#include <map>
#include <string>
#include <vector>

namespace damslip {

/// What reading found: where each key stands in the file, everything that is wrong so far, and what is unusual.
class Findings {
public:
    struct Place {
        int line = 0, column = 0;
    };

    explicit Findings(std::string file) : file_(std::move(file)) {}

    void saw(const std::string& key, Place place) { places_[key] = place; }
    bool given(const std::string& key) const { return places_.contains(key); }
    Place place(const std::string& key) const; ///< of the key or, failing that, of its table

    /// `key` says where; `problem` is the whole first sentence.
    void wrong(const std::string& key, std::string problem, std::string expected, std::string fix);
    void wrong_at(Place place, std::string problem, std::string expected, std::string fix);
    /// Allowed, but not what real dams have; its place is filled in here.
    void note(const std::string& key, Diagnostic note) { note_at(place(key), std::move(note)); }
    void note(const std::string& key, std::string problem, std::string expected, std::string fix)
    {
        note(key, Diagnostic{"", 0, 0, std::move(problem), std::move(expected), std::move(fix)});
    }
    void note_at(Place place, Diagnostic note);
    bool any() const { return !diagnostics_.empty(); }
    void throw_if_any();                   ///< @throws InputError, in the order of the file
    std::vector<Diagnostic> notes() const; ///< in the order of the file

private:
    std::string file_;
    std::map<std::string, Place> places_;
    std::vector<Diagnostic> diagnostics_, notes_;
};

/// The second half of parse_scene(): of a text that is TOML. @throws InputError
Scene scene_of_table(toml::table root, const std::filesystem::path& file, FileCheck check);

/// The first half. @throws InputError with the line that is no TOML
toml::table toml_of(std::string_view text, const std::filesystem::path& file);

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
