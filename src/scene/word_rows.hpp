#pragma once

#include "scene/scene.hpp"

#include <algorithm>
#include <cassert>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Tables whose rows come from several files, and are called by a word of a scene file or by an enumerator: row.word, row.named.
namespace damslip {

/// All rows. New files come last, so that the places of the named rows stay: the place of a row is the value of its enumerator.
template <class Enum, class Row>
std::vector<Row> rows_of_files(std::initializer_list<std::vector<Row> (*)()> files)
{
    std::vector<Row> all;
    for (auto* file : files)
        for (Row& row : file()) {
            assert(!row.named || *row.named == Enum(all.size()));
            all.push_back(std::move(row));
        }
    return all;
}

/// @pre the word is in the table
template <class Enum, class Rows>
Enum named_by(std::string_view word, const Rows& rows)
{
    const auto found = std::ranges::find_if(rows, [word](const auto& row) { return row.word == word; });
    assert(found != rows.end());
    return Enum(found - rows.begin());
}

/// The words with their enumerators, for a key that chooses one.
template <class Enum, class Rows>
std::vector<std::pair<std::string, Enum>> choices_of(const Rows& rows)
{
    std::vector<std::pair<std::string, Enum>> words;
    for (const auto& row : rows) words.emplace_back(row.word, Enum(words.size()));
    return words;
}

/// "none; linear (heel to toe)".
template <class Rows>
std::string meanings_of(const Rows& rows, const char* between)
{
    std::string text;
    for (const auto& row : rows)
        text += (text.empty() ? "" : between) + row.word + (row.meaning.empty() ? "" : " (" + row.meaning + ")");
    return text;
}

/// The scene has what the model or formula of the row needs.
template <class Row>
bool has_what_it_needs(const Scene& scene, const Row& row)
{
    return !row.there || row.there(scene);
}

} // namespace damslip
