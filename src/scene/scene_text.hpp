#pragma once

#include "scene/scene.hpp"

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace damslip {

/// What a key is set to: a number in the unit of its spelling, true or false, or a word.
using KeyValue = std::variant<double, bool, std::string>;

/// One key as a file spells it, with the unit in its name: "contact.friction", "reservoir.level_m", "lift_joint[crown].friction". An entry of a
/// list is named in brackets, by its `name` or by its number from 1.
struct KeyChange {
    std::string key;
    KeyValue value;
};

/// The number, "true" or "false", the word in quotes: for messages.
std::string text_of(const KeyValue& value);

/// A scene file that is read once, and of which scenes with other values are made. Each is read and checked as if the values stood in the file.
class SceneText {
public:
    /// @param file  name for messages; record files are relative to its folder @throws InputError for text that is no TOML
    SceneText(std::string_view toml_text, std::filesystem::path file);
    static SceneText read(const std::filesystem::path& file); ///< @throws InputError

    /// @throws InputError with all that is wrong; an unknown key with the nearest one that can be set
    Scene with(std::span<const KeyChange> changes) const;
    Scene scene() const { return with({}); }
    /// A text with the values in it. @throws InputError as with(), but does not check the scene
    SceneText set(std::span<const KeyChange> changes) const;

    /// Keys that can be set: numbers, whole numbers, true or false, and choices, of tables that every scene has or this file names; in
    /// their first unit. In the order of the documentation.
    std::vector<std::string> keys() const;
    /// The words of a choice key; empty: not a choice. @throws InputError for a key that cannot be set
    std::vector<std::string> words(const std::string& key) const;
    /// The key as the documentation names it, with its first unit and its list entry by name where it has one. Two spellings of one key give the
    /// same. @throws InputError for a key that cannot be set
    std::string canonical(const std::string& key) const;

    /// The number that the file has for a key, in the unit of the key's spelling given here. @throws InputError where it says none
    double written(const std::string& key) const;

    const std::filesystem::path& file() const;

private:
    struct Tables;
    explicit SceneText(std::shared_ptr<const Tables> tables) : tables_(std::move(tables)) {}
    std::shared_ptr<const Tables> tables_;
};

/// The scene with another peak friction of what its block slides on (planes.slides_on); a residual value above it is lowered to it. Of a wedge it is the friction of the first
/// plane, and the second keeps its share of it (without friction on the first plane: both get it). @throws UsageError for a
/// scene with a friction table
Scene with_friction(Scene scene, double friction);
/// The same in place.
void set_friction(Scene& scene, double friction);

/// JSON Schema (draft 7) of the scene file, for editors and checkers.
std::string scene_schema();

/// Every key with unit, range, default and meaning, as Markdown.
std::string scene_keys_markdown();

} // namespace damslip
