#pragma once

#include <algorithm>
#include <initializer_list>
#include <type_traits>
#include <utility>

namespace damslip {

/// The word that a list of all values has beside this one.
template <class Value>
const char* word_in(Value value, std::initializer_list<std::pair<std::type_identity_t<Value>, const char*>> words)
{
    const auto at = std::find_if(words.begin(), words.end(), [&](const auto& each) { return each.first == value; });
    return at == words.end() ? "" : at->second;
}

} // namespace damslip
