#include "scene/read.hpp"

#include "core/file.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <toml++/toml.h>

namespace damslip {

namespace {

/// A key or table as a message names it: "contact.sliding", "seam[2].exit", "[lifts]", "[[seam]]".
struct Named {
    std::vector<std::string> parts; ///< "seam", "exit"
    std::size_t entry = 0;          ///< of the list that the first part is, from 0
    bool numbered = false;          ///< "seam[2]": the entry is in the message
};

bool of_a_key(char c)
{
    return std::islower(static_cast<unsigned char>(c)) || std::isdigit(static_cast<unsigned char>(c)) || c == '_';
}

/// The one that begins at `at`; none: another word.
std::optional<Named> named_at(std::string_view text, std::size_t at)
{
    Named named;
    const bool table = text[at] == '[';
    while (at < text.size() && text[at] == '[') ++at;
    for (;;) {
        const std::size_t begin = at;
        while (at < text.size() && of_a_key(text[at])) ++at;
        if (at == begin) break;
        named.parts.emplace_back(text.substr(begin, at - begin));
        if (!table && named.parts.size() == 1 && at < text.size() && text[at] == '[') {
            std::size_t number = 0;
            const auto end = std::from_chars(text.data() + at + 1, text.data() + text.size(), number);
            if (end.ec != std::errc{} || number == 0 || end.ptr == text.data() + text.size() || *end.ptr != ']') return std::nullopt;
            named.entry = number - 1;
            named.numbered = true;
            at = static_cast<std::size_t>(end.ptr - text.data()) + 1;
        }
        if (at + 1 >= text.size() || text[at] != '.' || !of_a_key(text[at + 1])) break;
        ++at;
    }
    const bool closed = table && at < text.size() && text[at] == ']';
    const bool key = !table && (named.parts.size() > 1 || named.numbered); // one word alone may be any word
    return !named.parts.empty() && (closed || key) ? std::optional(named) : std::nullopt;
}

/// The node of a key in a table, with or without its unit: "level" finds "level_m".
const toml::node* entry_of(const toml::table& table, const std::string& key)
{
    if (const toml::node* node = table.get(key)) return node;
    for (const auto& [name, node] : table)
        if (name.str().starts_with(key + "_")) return &node;
    return nullptr;
}

const toml::node* find(const toml::table& scene, const Named& named)
{
    const toml::node* node = &scene;
    for (const std::string& part : named.parts) {
        const toml::table* table = node->as_table();
        if (const toml::array* list = node->as_array())
            table = list->size() > named.entry ? list->get(named.entry)->as_table() : nullptr;
        node = table ? entry_of(*table, part) : nullptr;
        if (!node) return nullptr;
    }
    if (const toml::array* list = node->as_array(); list && list->size() > named.entry && list->is_array_of_tables())
        return list->get(named.entry);
    return node;
}

} // namespace

Diagnostic with_line(Diagnostic d)
{
    if (d.line > 0 || !d.file.ends_with(".toml")) return d;
    try {
        const toml::table scene = toml::parse(read_file(d.file));
        for (const std::string* text : {&d.problem, &d.expected, &d.fix})
            for (std::size_t at = 0; at < text->size(); ++at) {
                if (at > 0 && (of_a_key((*text)[at - 1]) || (*text)[at - 1] == '.' || (*text)[at - 1] == '[')) continue;
                if (!of_a_key((*text)[at]) && (*text)[at] != '[') continue;
                const std::optional<Named> named = named_at(*text, at);
                const toml::node* const node = named ? find(scene, *named) : nullptr;
                if (!node) continue;
                d.line = static_cast<int>(node->source().begin.line);
                return d;
            }
    } catch (const std::exception&) { // the file is gone, or was never one
    }
    return d;
}

} // namespace damslip
