#pragma once

#include "core/input_error.hpp"
#include "scene/keys.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Numbers that are allowed but not those of real dams: what is noted of them. A note is a Diagnostic that is not thrown: the
/// value, the usual range with its source, and what it may have been meant as.
namespace damslip {

/// One number as it was written.
struct WrittenNumber {
    std::string subject; ///< "dam.young_modulus_GPa = 28000", "--friction 7"
    double value = 0.0;
    UnitSuffix unit;     ///< one of the key's
    bool in_file = true; ///< a key of a scene, which other units have other names for; else of the command line
};

/// The note of a number outside the key's usual range; none inside, or for a key without one. File and line are left open.
std::optional<Diagnostic> unusual(const Key& key, const WrittenNumber& number);

/// A number as a note says it.
std::string six_digits(double value);

/// "10 ... 50 GPa (ACI 207.1R)"
std::string usual_text(const Usual& usual, const UnitSuffix& unit);

/// The key of a name without unit: "contact.friction". @pre there is one
Key key_named(const std::string& name);

/// A note on one line: "dam.toml:12: dam.young_modulus_GPa = 28000 is unusual. Usual: 10 ... 50 GPa (...). 28 GPa if ...".
std::string note_text(const Diagnostic& note);
std::vector<std::string> note_texts(const std::vector<Diagnostic>& notes);

/// The note of a water level above the crest. @param subject  "reservoir.level_m = 77.5"; levels [m]
/// @returns nothing up to the crest
std::optional<Diagnostic> unusual_level(const std::string& subject, double level, double crest);

/// Ranges of real dams: what a number of the scene usually is, and who says so. They are rounded outward from what the source
/// gives, so that a value outside is worth a second look, not wrong.

/// Puts the usual range beside each number of the table. Every number has one, or a reason for having none (no_usual_range).
void add_usual_ranges(std::vector<KeyGroup>& groups);

/// A number without a usual range.
struct NoUsualRange {
    std::string_view key;    ///< "force.x"
    std::string_view reason; ///< "a place"
};
std::span<const NoUsualRange> no_usual_range();

/// What a short source of Usual::source stands for.
struct UsualSource {
    std::string_view name; ///< as in Usual::source, where several are parted by "; "
    std::string_view full; ///< author, year, title, number
};
std::span<const UsualSource> usual_sources();

} // namespace damslip
