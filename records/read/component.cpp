#include "records/read/component.hpp"

#include "records/read/record_text.hpp"

#include <algorithm>
#include <string>

namespace damslip::records {

namespace {

bool is_decimal(char c)
{
    return c >= '0' && c <= '9';
}

bool is_one_of(std::string_view word, std::string_view blank_separated)
{
    return !word.empty() && contains(" " + std::string(blank_separated) + " ", " " + std::string(word) + " ");
}

/// "n10e", "s80w": degrees from north or south.
bool is_quadrant(std::string_view s)
{
    return s.size() >= 3 && s.size() <= 4 && is_one_of(s.substr(0, 1), "n s") &&
           is_one_of(s.substr(s.size() - 1), "e w") && std::all_of(s.begin() + 1, s.end() - 1, is_decimal);
}

/// Letters and digits of the first word, in lower case.
std::string first_word(std::string_view words)
{
    const std::string s = lower(trimmed(words));
    std::string word = s.substr(0, s.find_first_of(" ,;\t"));
    std::erase_if(word, [](char c) { return !is_decimal(c) && !(c >= 'a' && c <= 'z'); });
    return word;
}

} // namespace

Component component_in_part(std::string_view part)
{
    constexpr std::string_view verticals = "v z u up ud upd updown dn dwn down ver vert vertical vrt vt",
                               horizontals =
                                   "h n e s w ns ew sn we x y l t r hor horiz horizontal north south east west "
                                   "long longitudinal lon tran trans transverse trn lat lateral rad radial tan "
                                   "tangential";
    if (is_quadrant(part)) return Component::horizontal;
    if (part.size() == 3 && is_one_of(part.substr(0, 1), "h b e c s l f g d m") &&
        is_one_of(part.substr(1, 1), "n l g h")) {
        if (part[2] == 'z') return Component::vertical;
        if (is_one_of(part.substr(2), "n e 1 2 x y r t")) return Component::horizontal;
    }
    std::string_view word = part;
    if (word.size() >= 2 && is_decimal(word.back())) word.remove_suffix(1); // "ud2", "h1"
    if (is_one_of(word, verticals)) return Component::vertical;
    return is_one_of(word, horizontals) ? Component::horizontal : Component::none;
}

Component component_in(std::string_view words)
{
    const std::string first = first_word(words);
    if (!first.empty() && first.size() <= 3 && std::all_of(first.begin(), first.end(), is_decimal) &&
        std::stoi(first) <= 360)
        return Component::horizontal;
    if (const Component known = component_in_part(first); known != Component::none) return known;
    const std::string s = lower(words);
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz0123456789";
    for (std::size_t end = s.find_last_of(letters); end != std::string::npos;) {
        const std::size_t before = s.find_last_not_of(letters, end),
                          begin = before == std::string::npos ? 0 : before + 1;
        const Component known = component_in_part(std::string_view(s).substr(begin, end + 1 - begin));
        if (known != Component::none) return known;
        end = begin == 0 ? std::string::npos : s.find_last_of(letters, begin - 1);
    }
    return Component::none;
}

bool is_downwards(std::string_view words)
{
    return is_one_of(first_word(words), "dn dwn down downward downwards");
}

} // namespace damslip::records
