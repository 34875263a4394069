#pragma once

#include "core/units.hpp"
#include "scene/scene.hpp"

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

/// The one table that describes every key of a scene file. Reader, JSON Schema, documentation and the writer of
/// resolved scenes are all made from it, so they cannot disagree.
namespace damslip {

/// A way to write a quantity: key suffix and what turns the number into SI.
struct UnitSuffix {
    std::string suffix;   ///< "m", "GPa", "deg"; empty: the bare key
    double factor = 1.0;  ///< SI value = factor * written value ...
    bool tangent = false; ///< ... or tan(written value in degrees), for friction angles
};

/// The SI value of a written number. With a decimal factor it is the double next to the decimal product, so that
/// 3 mm and 0.003 m, 0.3 g and 2.941995 m/s2 are the same; 45 deg of friction is 1.
double to_si(double written, const UnitSuffix& unit);

/// The accepted suffixes of one kind of quantity; the first is the one written to resolved scenes and shown in the
/// docs.
using Units = std::vector<UnitSuffix>;

/// Allowed values, in the unit of the first suffix.
struct Range {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    bool low_open = false, high_open = false;

    static Range any() { return {}; }
    static Range above(double x) { return {x, std::numeric_limits<double>::infinity(), true, false}; }
    static Range at_least(double x) { return {x, std::numeric_limits<double>::infinity(), false, false}; }
    static Range between(double a, double b) { return {a, b, false, false}; }
    static Range half_open(double a, double b) { return {a, b, true, false}; }
    static Range inside(double a, double b) { return {a, b, true, true}; }

    bool contains(double x) const; ///< false for NaN and infinities
    std::string text() const;      ///< "> 0", "0 ... 1", "any number"
};

/// What real dams have, within what is allowed. A value outside it is noted, not refused.
struct Usual {
    double low, high;     ///< in the unit of the key's first suffix; of pairs: of the second entry
    std::string source;   ///< short: "ACI 207.1R"; in full in usual_sources(). "judgement": nobody's but ours
    bool or_zero = false; ///< 0 is usual too: it means "not there"

    bool contains(double x) const; ///< the ends included, up to the rounding of a unit
};

/// An enumeration by its words in the file.
struct Choice {
    std::vector<std::string> words;
    std::function<void(int)> set; ///< index into words
    std::function<int()> get;
};

/// A number or one word: added_mass.period_s = 0.28 | "dam".
struct NumberOrWord {
    std::optional<double>* number;
    bool* word_given;
    std::string word;
};

/// A list of numbers, or the one number of a list.
struct Numbers {
    std::vector<double>* list;
    bool one = false; ///< written as a number: angle_deg = 25 beside angles_deg = [20, 25]
};

/// The ends of a range: search_deg = [10, 60].
struct Ends {
    double *from, *to;
};

/// Where the value of a key lives in its struct.
using Slot = std::variant<double*, std::optional<double>*, int*, std::optional<int>*, bool*, std::string*,
                          std::optional<std::string>*, std::filesystem::path*, std::optional<std::filesystem::path>*,
                          std::vector<Point>*, std::vector<std::string>*, Choice, NumberOrWord, Numbers, Ends>;

struct Key {
    std::string name;   ///< without unit suffix
    Units units;        ///< of the number, or of the first entry of a pair; empty suffix only: no unit
    Units second_units; ///< pairs: of the second entry
    Range range;        ///< numbers; pairs: of the second entry
    bool required = false;
    std::string
        default_text; ///< shown in the docs; the value itself is the struct's initialiser or is filled in after reading
    std::string meaning; ///< one sentence
    std::string example; ///< as written in a file: "0.77"
    std::function<Slot(void*)> slot;
    std::function<bool(const void*)> applies =
        {};                          ///< false: left out of resolved scenes, another choice makes it meaningless
    std::optional<Usual> usual = {}; ///< numbers and pairs; none: any value allowed is as usual as another (usual.hpp)

    std::string canonical() const;              ///< name with the first suffix: "level_m"
    std::vector<std::string> spellings() const; ///< all accepted names
};

enum class Presence { always, optional, list };

/// One [table] or [[list of tables]] of the file, bound to one struct.
struct KeyGroup {
    std::string name; ///< "reservoir", "motion.record"; empty: top level
    Presence presence = Presence::optional;
    std::string meaning;
    std::vector<Key> keys;
    std::function<void*(Scene&)> open; ///< makes the struct (a new item for lists) and returns it
    std::function<std::vector<const void*>(const Scene&)> items; ///< those present, for writing
    /// Of a table in an entry of a list, as [seam.wedge]: the struct inside the entry, made where `make` says so; null:
    /// it is not there.
    std::function<void*(void* entry, bool make)> inside = {};

    bool in_list() const { return presence == Presence::list || inside; }
};

/// The name of the list that a table with `inside` belongs to: "seam" of "seam.wedge"; of another table its own.
std::string list_of(const KeyGroup& group);

/// What [section] may say; turned into the polygon of Scene::section after reading.
struct SectionInput {
    std::vector<Point> polygon;
    std::optional<double> height, base, crest, neck, upstream_slope, upstream_slope_height, base_inclination;
    std::optional<double> slope_height, face_dip, plane_dip, crack_distance, upper_dip; ///< of a rock slope
    std::vector<Point> thickness;
};

/// The whole table. `section` receives what [section] says; it must outlive the use of the groups.
std::vector<KeyGroup> key_groups(SectionInput& section);

/// Tables of a scene whose block is a [wedge]; it has no others.
bool belongs_to_wedge(const std::string& group);

} // namespace damslip

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
inline const Units surface_energy{{"N_m", 1.0}, {"J_m2", 1.0}, {"kN_m", 1e3}};
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

/// A member of a member of the object a table fills.
template <class T, class Part, class Member>
std::function<Slot(void*)> in(Part T::*part, Member Part::*member)
{
    return [part, member](void* object) -> Slot { return &(static_cast<T*>(object)->*part.*member); };
}

/// A key that resolved scenes hold only where its law is there.
template <class T>
Key only_where(std::function<bool(const T&)> applies, Key key)
{
    key.applies = [applies = std::move(applies)](const void* object) {
        return applies(*static_cast<const T*>(object));
    };
    return key;
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

/// A table inside each entry of a list. @param inside  as KeyGroup::inside
template <class T, class List>
KeyGroup inner_group(std::string name, std::string meaning, List list, std::function<void*(void*, bool)> inside,
                     std::vector<Key> keys)
{
    return {std::move(name),
            Presence::optional,
            std::move(meaning),
            std::move(keys),
            [list, inside](Scene& s) { return inside(&list(s).emplace_back(), true); },
            [list, inside](const Scene& s) {
                std::vector<const void*> items;
                for (T& item : list(const_cast<Scene&>(s)))
                    if (const void* there = inside(&item, false)) items.push_back(there);
                return items;
            },
            inside};
}

} // namespace damslip::keys
