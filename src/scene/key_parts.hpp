#pragma once

#include "core/units.hpp"
#include "scene/key_table.hpp"

/// What the tables of keys are written with: units by quantity, keys of each kind, tables that are always there, optional
/// or repeated.
namespace damslip::keys {

// Units by quantity; the first is canonical.
inline const Units none{{"", 1.0}};
inline const Units length{{"m", 1.0}, {"mm", 1e-3}, {"cm", 1e-2}, {"ft", 0.3048}};
inline const Units small_length{{"m", 1.0}, {"mm", 1e-3}, {"cm", 1e-2}, {"ft", 0.3048}, {"in", 0.0254}};
inline const Units angle{{"deg", units::degree}, {"rad", 1.0}};
inline const Units seconds{{"s", 1.0}, {"ms", 1e-3}};
inline const Units acceleration{{"m_s2", 1.0}, {"g", units::standard_gravity}, {"cm_s2", 0.01}};
inline const Units density{{"kg_m3", 1.0}, {"t_m3", 1000.0}};
inline const Units modulus{{"GPa", 1e9}, {"MPa", 1e6}, {"Pa", 1.0}};
inline const Units bulk{{"MPa", 1e6}, {"GPa", 1e9}, {"Pa", 1.0}};
inline const Units stress{{"kPa", 1e3}, {"MPa", 1e6}, {"Pa", 1.0}};
inline const Units line_force{{"kN_m", 1e3}, {"MN_m", 1e6}, {"N_m", 1.0}};
inline const Units unit_weight{{"kN_m3", 1e3}, {"N_m3", 1.0}};
inline const Units conductivity{{"m_s", 1.0}, {"cm_s", 0.01}};
inline const Units hertz{{"Hz", 1.0}};
inline const Units friction{{"", 1.0}, {"deg", 1.0, true}};
inline const Units subgrade{{"N_m3", 1.0}, {"MN_m3", 1e6}, {"GN_m3", 1e9}};
inline const Units per_second{{"1_s", 1.0}};

/// The member of the object a table fills.
template <class T, class Member>
std::function<Slot(void*)> at(Member T::*member)
{
    return [member](void* object) -> Slot { return &(static_cast<T*>(object)->*member); };
}

template <class T, class Enum>
std::function<Slot(void*)> choice(Enum T::*member, std::vector<std::pair<std::string, Enum>> words)
{
    return [member, words](void* object) -> Slot {
        Choice c;
        for (const auto& [word, value] : words) c.words.push_back(word);
        Enum* slot = &(static_cast<T*>(object)->*member);
        c.set = [slot, words](int i) { *slot = words[static_cast<std::size_t>(i)].second; };
        c.get = [slot, words] {
            for (std::size_t i = 0; i < words.size(); ++i)
                if (words[i].second == *slot) return static_cast<int>(i);
            return 0;
        };
        return c;
    };
}

/// An optional enumeration: absent until the file names a word.
template <class T, class Enum>
std::function<Slot(void*)> optional_choice(std::optional<Enum> T::*member,
                                           std::vector<std::pair<std::string, Enum>> words)
{
    return [member, words](void* object) -> Slot {
        Choice c;
        for (const auto& [word, value] : words) c.words.push_back(word);
        std::optional<Enum>* slot = &(static_cast<T*>(object)->*member);
        c.set = [slot, words](int i) { *slot = words[static_cast<std::size_t>(i)].second; };
        c.get = [slot, words] {
            for (std::size_t i = 0; i < words.size(); ++i)
                if (*slot == words[i].second) return static_cast<int>(i);
            return -1;
        };
        return c;
    };
}

Key number(std::string name, Units units, Range range, std::string default_text, std::string meaning,
           std::string example, std::function<Slot(void*)> slot);

Key word(std::string name, std::string default_text, std::string meaning, std::string example,
         std::function<Slot(void*)> slot);

Key pairs(std::string name, Units first, Units second, Range range, std::string default_text, std::string meaning,
          std::string example, std::function<Slot(void*)> slot);

template <class T>
KeyGroup group(std::string name, std::string meaning, T Scene::*member, std::vector<Key> keys)
{
    return {std::move(name),
            Presence::always,
            std::move(meaning),
            std::move(keys),
            [member](Scene& s) -> void* { return &(s.*member); },
            [member](const Scene& s) { return std::vector<const void*>{&(s.*member)}; }};
}

template <class T>
KeyGroup optional_group(std::string name, std::string meaning, std::optional<T> Scene::*member, std::vector<Key> keys)
{
    return {std::move(name),
            Presence::optional,
            std::move(meaning),
            std::move(keys),
            [member](Scene& s) -> void* { return &(s.*member).emplace(); },
            [member](const Scene& s) {
                return (s.*member) ? std::vector<const void*>{&*(s.*member)} : std::vector<const void*>{};
            }};
}

template <class T, class List>
KeyGroup list_group(std::string name, std::string meaning, List list, std::vector<Key> keys)
{
    return {std::move(name),
            Presence::list,
            std::move(meaning),
            std::move(keys),
            [list](Scene& s) -> void* { return &list(s).emplace_back(); },
            [list](const Scene& s) {
                std::vector<const void*> items;
                for (const T& item : list(const_cast<Scene&>(s))) items.push_back(&item);
                return items;
            }};
}

} // namespace damslip::keys
