#pragma once

#include "core/input_error.hpp"
#include "scene/read.hpp"
#include "scene/scene.hpp"

#include <map>
#include <string>
#include <toml++/toml.h>
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

/// As written in a scene file: "curtain".
const char* word(UpliftModel model);

} // namespace damslip
