#pragma once

#include "cli/terminal/terminal.hpp"
#include "scene/scene.hpp"
#include "scene/scene_text.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace damslip::cli {

/// What the commands that run a scene have in common on the command line.
struct RunInputs {
    std::filesystem::path scene; ///< "-": standard input
    bool strict = false;         ///< what would be noted is refused
    std::string record_list;     ///< folder, pattern or list of records in place of the scene's; empty: none
    std::vector<std::filesystem::path> records;   ///< horizontal components; given: they replace the scene's
    std::vector<std::filesystem::path> verticals; ///< none, or one for each record in the same order; "none": without
    std::string unit;                             ///< of record files that do not say
    std::optional<double> dt;                     ///< of one-column files [s]
    std::string column;                           ///< of files that hold several, horizontal components
    std::string vertical_column;                  ///< the same, vertical components
    std::optional<double> friction;
    std::optional<double> scale;
    std::string rock;   ///< "radiating" or "massless" in place of the scene's; empty: the scene's
    std::string plane;  ///< seam that finite elements slide on; empty or "base": the base
    std::string scheme; ///< "exact" or "slammer"; empty: the scene's
};

std::string single_quoted(const std::string& word); ///< as a POSIX shell reads it back
/// The same, as it is where that is safe.
std::string shell_quoted(const std::string& word);

/// SCENE and the flags that name its records, shell-quoted: "dam.toml --record ns.at2 --dt 0.01".
std::string shell_words(const RunInputs& inputs);

/// The scene with the command line's changes, checked. Its notes, and those of the command line's numbers, go to the talk; with
/// --strict they are thrown. @throws InputError, UsageError
Scene read_run_scene(const RunInputs& inputs, const Streams& streams);

/// The note of a number of the command line that stands for a key. @param value  in the key's first unit
/// @param subject  "--friction 7"; @param key  "contact.friction"
std::optional<Diagnostic> unusual_argument(const std::string& subject, const std::string& key, double value);

/// Puts notes to the talk, or throws them with --strict.
/// @throws InputError
void say(const std::vector<Diagnostic>& notes, bool strict, const Streams& streams);

/// Warns, before anything is computed, of a base that lets no wave go below finite elements that slide.
void say_base(const Scene& scene, const Streams& streams);

/// A scene that comes from standard input cannot be read a second time. @param flag  that needs it again
/// @throws UsageError
void need_scene_file(const RunInputs& inputs, const std::string& flag);

/// What the command needs of a scene is a section, not a [wedge]. @param instead  what to do with a wedge
/// @throws InputError for a scene of a rock wedge
void need_section(const Scene& scene, const std::string& command, const std::string& instead);

/// What a driver of Dakota asks for.
struct DakotaQuestion {
    std::vector<KeyChange> changes;
    std::vector<std::string> responses; ///< descriptors, in order
    std::vector<bool> wanted;           ///< of each response
};

/// Reads Dakota's parameters file, standard ("0.7 contact.friction") or aprepro ("{ contact.friction = 0.7 }"). Strings are
/// choices. @throws InputError for a file cut short, gradients asked for
DakotaQuestion read_dakota(const std::filesystem::path& file);

/// Reads quoFEM's params.in: the number of variables, then a name and a value a line. @throws InputError
std::vector<KeyChange> read_quofem(const std::filesystem::path& file);

} // namespace damslip::cli
