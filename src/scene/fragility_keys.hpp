#pragma once

#include "scene/key_table.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace damslip {

/// What a key of the tables of a fragility takes.
enum class FragilityValue { number, whole, flag, word, text, text_or_list, numbers, names, law, discrete };

/// A number in the braces of a law: lognormal = { median = 0.77, beta = 0.15 }.
struct LawNumber {
    std::string name;
    bool required = false, positive = false;
};

/// One key of these tables. Its reader takes its name, the JSON Schema and the page of keys all of it.
struct FragilityKey {
    std::string name;
    FragilityValue value;
    Range range = {};               ///< of numbers
    std::vector<std::string> words; ///< of a word
    std::vector<LawNumber> numbers; ///< of a law
    std::string default_text, meaning;
    std::string example; ///< as written in a file
};

/// One [table] or [[list of tables]] that `damslip fragility` alone computes with.
struct FragilityKeyTable {
    std::string name; ///< "probability.variable"
    Presence presence = Presence::optional;
    std::string meaning;
    std::vector<FragilityKey> keys;

    std::vector<std::string> names() const;
    const FragilityKey& key(std::string_view name) const; ///< @throws std::logic_error for a name it does not have
};

/// [probability], [[probability.variable]], [[probability.correlation]], [suite], [intensity], [[limit]], [hazard]
const std::vector<FragilityKeyTable>& fragility_key_tables();
const FragilityKeyTable&
fragility_key_table(std::string_view name); ///< @throws std::logic_error for a table there is not

} // namespace damslip
