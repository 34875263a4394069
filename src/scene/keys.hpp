#pragma once

#include "core/units.hpp"
#include "scene/scene.hpp"

#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
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

/// What a key takes.
enum class ValueKind {
    number,
    number_or_word, ///< added_mass.period_s = 0.28 | "dam"
    whole,
    flag,
    word, ///< one of several
    text,
    texts,
    numbers, ///< a list
    ends,    ///< of a range: search_deg = [10, 60]
    pairs,
    // Of the tables of a fragility alone.
    text_or_list,
    names,   ///< two
    law,     ///< numbers in braces: { median = 0.77, beta = 0.15 }
    discrete ///< values and weights in braces
};

/// An enumeration by the place of its word.
struct Choice {
    std::function<void(int)> set;
    std::function<int()> get; ///< -1: the scene has a value without a word
};

struct NumberOrWord {
    std::optional<double>* number;
    bool* word_given;
};

/// A list of numbers, or the one number of a list.
struct Numbers {
    std::vector<double>* list;
    bool one = false; ///< written as a number: angle_deg = 25 beside angles_deg = [20, 25]
};

struct Ends {
    double *from, *to;
};

/// Where the value of a key lives in its struct.
using Slot = std::variant<double*, std::optional<double>*, int*, std::optional<int>*, bool*, std::string*,
                          std::optional<std::string>*, std::filesystem::path*, std::optional<std::filesystem::path>*,
                          std::vector<Point>*, std::vector<std::string>*, Choice, NumberOrWord, Numbers, Ends>;

/// What a key takes, and where its struct has it.
struct Value {
    ValueKind kind;
    std::function<Slot(void*)> slot = {}; ///< null: of a fragility, whose tables have a reader of their own
    std::vector<std::string> words = {};  ///< of a word; the one of a number_or_word
};

/// A number in the braces of a law.
struct LawNumber {
    std::string name;
    bool required = false, positive = false;
};

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
    Value value;
    std::function<bool(const void*)> applies =
        {};                          ///< false: left out of resolved scenes, another choice makes it meaningless
    std::optional<Usual> usual =
        {}; ///< numbers and pairs; none: any value allowed is as usual as another (plausible.hpp)
    std::vector<LawNumber> numbers = {}; ///< of a law

    std::string canonical() const;              ///< name with the first suffix: "level_m"
    std::vector<std::string> spellings() const; ///< all accepted names
    std::string spelled(const UnitSuffix& unit) const { return unit.suffix.empty() ? name : name + "_" + unit.suffix; }
};

enum class Presence { always, optional, list };

/// One [table] or [[list of tables]] of the file, bound to one struct.
struct KeyGroup {
    std::string name; ///< "reservoir", "motion.record"; empty: top level
    Presence presence = Presence::optional;
    std::string meaning;
    std::vector<Key> keys;
    std::function<void*(Scene&)> open = {}; ///< makes the struct (a new item for lists) and returns it
    std::function<std::vector<const void*>(const Scene&)> items = {}; ///< those present, for writing
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

/// [probability], [[probability.variable]], [[probability.correlation]], [suite], [intensity], [[limit]], [hazard]: what
/// `damslip fragility` alone computes with. Their keys have no slots.
const std::vector<KeyGroup>& fragility_key_tables();

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
Value at(Member T::*member)
{
    const auto is = []<class... Types> { return (std::is_same_v<Member, Types> || ...); };
    Value value{is.template operator()<double, std::optional<double>>() ? ValueKind::number
                : is.template operator()<int, std::optional<int>>()     ? ValueKind::whole
                : is.template operator()<bool>()                        ? ValueKind::flag
                : is.template operator()<std::vector<Point>>()          ? ValueKind::pairs
                : is.template operator()<std::vector<std::string>>()    ? ValueKind::texts
                : is.template operator()<std::vector<double>>()         ? ValueKind::numbers
                                                                        : ValueKind::text};
    value.slot = [member](void* object) -> Slot {
        if constexpr (std::is_same_v<Member, std::vector<double>>)
            return Numbers{&(static_cast<T*>(object)->*member)};
        else
            return &(static_cast<T*>(object)->*member);
    };
    return value;
}

/// The same of a member of the object a table fills.
template <class T, class Part>
Value in(Part T::*part, Value value)
{
    value.slot = [part, slot = std::move(value.slot)](void* object) { return slot(&(static_cast<T*>(object)->*part)); };
    return value;
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

/// The same of a key that one choice of its table reads.
template <class T, class Enum>
Key only_with(Enum T::*member, Enum chosen, Key key)
{
    return only_where<T>([=](const T& table) { return table.*member == chosen; }, std::move(key));
}

template <class Enum>
struct EnumOf {
    using type = Enum;
};
template <class Enum>
struct EnumOf<std::optional<Enum>> {
    using type = Enum;
};

/// An enumeration by its words. An optional one is absent until the file names a word.
template <class T, class Member, class Enum = typename EnumOf<Member>::type>
Value choice(Member T::*member, const std::vector<std::pair<std::string, Enum>>& words)
{
    Value value{ValueKind::word};
    for (const auto& [word, meant] : words) value.words.push_back(word);
    value.slot = [member, words](void* object) -> Slot {
        Member* slot = &(static_cast<T*>(object)->*member);
        return Choice{[slot, words](int i) { *slot = words[static_cast<std::size_t>(i)].second; },
                      [slot, words] {
                          for (std::size_t i = 0; i < words.size(); ++i)
                              if (*slot == words[i].second) return static_cast<int>(i);
                          return -1;
                      }};
    };
    return value;
}

template <class T>
Value number_or_word(std::optional<double> T::*number, bool T::*given, std::string word)
{
    return {ValueKind::number_or_word,
            [=](void* object) -> Slot {
                auto* table = static_cast<T*>(object);
                return NumberOrWord{&(table->*number), &(table->*given)};
            },
            {std::move(word)}};
}

Key number(std::string name, Units units, Range range, std::string default_text, std::string meaning,
           std::string example, Value value);

Key word(std::string name, std::string default_text, std::string meaning, std::string example, Value value);

Key pairs(std::string name, Units first, Units second, Range range, std::string default_text, std::string meaning,
          std::string example, Value value);

/// One list of keys or tables of several.
template <class T>
std::vector<T> joined(std::initializer_list<std::vector<T>> lists)
{
    std::vector<T> all;
    for (const std::vector<T>& list : lists) all.insert(all.end(), list.begin(), list.end());
    return all;
}

/// A table that is always there. @param table  member of the scene, or what finds it: std::identity for the scene itself
template <class Table>
KeyGroup group(std::string name, std::string meaning, Table table, std::vector<Key> keys)
{
    return {std::move(name),
            Presence::always,
            std::move(meaning),
            std::move(keys),
            [table](Scene& s) -> void* { return &std::invoke(table, s); },
            [table](const Scene& s) { return std::vector<const void*>{&std::invoke(table, s)}; }};
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

/// @param list  member of the scene, or what finds the list in a scene
template <class List>
KeyGroup list_group(std::string name, std::string meaning, List list, std::vector<Key> keys)
{
    return {std::move(name),
            Presence::list,
            std::move(meaning),
            std::move(keys),
            [list](Scene& s) -> void* { return &std::invoke(list, s).emplace_back(); },
            [list](const Scene& s) {
                std::vector<const void*> items;
                for (const auto& item : std::invoke(list, const_cast<Scene&>(s))) items.push_back(&item);
                return items;
            }};
}

/// A table inside each entry of a list. @param inside  as KeyGroup::inside
template <class List>
KeyGroup inner_group(std::string name, std::string meaning, List list, std::function<void*(void*, bool)> inside,
                     std::vector<Key> keys)
{
    KeyGroup group = list_group(std::move(name), std::move(meaning), list, std::move(keys));
    group.presence = Presence::optional;
    group.inside = inside;
    group.items = [entries = group.items, inside](const Scene& s) {
        std::vector<const void*> items;
        for (const void* entry : entries(s))
            if (const void* there = inside(const_cast<void*>(entry), false)) items.push_back(there);
        return items;
    };
    return group;
}

// The keys of the scene file by topic, each with its unit, range, default and meaning. keys.cpp puts them in order.

KeyGroup project_group(); ///< title block of the reports
/// @param input  filled instead of a member of the scene: the polygon is made of it afterwards (make_section)
KeyGroup section_group(SectionInput& input);
std::vector<KeyGroup> base_groups();
std::vector<KeyGroup> water_groups();
std::vector<KeyGroup> motion_groups();
std::vector<KeyGroup> fe_groups();
std::vector<KeyGroup> wedge_groups();
KeyGroup flexible_block_group();
KeyGroup combination_group(); ///< load combinations of the limit equilibrium

/// Keys of [contact] as keys of a table whose struct has a strength of its own.
template <class T>
std::vector<Key> strength_keys(const std::vector<Key>& contact, Contact T::*strength, const std::set<std::string>& names)
{
    std::vector<Key> keys;
    for (Key key : contact) {
        if (!names.contains(key.name)) continue;
        key.value = in(strength, std::move(key.value));
        if (key.applies)
            key.applies = [applies = key.applies, strength](const void* object) {
                return applies(&(static_cast<const T*>(object)->*strength));
            };
        keys.push_back(std::move(key));
    }
    return keys;
}

/// [lifts], [[seam]] with the tables inside it, [planes]. @param contact  keys of [contact]
std::vector<KeyGroup> plane_groups(const std::vector<Key>& contact);

/// How the uplift in a base crack follows from the water: words of uplift.crack and combination.crack.
const std::vector<std::pair<std::string, CrackRule>>& crack_rules();

} // namespace damslip::keys

namespace damslip {

/// Puts the settings of `scene.analysis.preset` where `open` allows it. goldgruber-2015 (Goldgruber 2015, chapters 4 and 6):
/// penalty with slip tolerance 0.005, no separation, massless rock on fixed edges, damper and still bottom of acoustic
/// water, relative mass damping, HHT alpha = -1/3 and whole steps of 0.01 s.
/// @param open  may this key, as "time.dt", be set?
void apply_preset(Scene& scene, const std::function<bool(const char* key)>& open);

/// Which method honours which key of a scene file: one table.

/// Methods as bits of a set.
using Methods = unsigned;
namespace methods {
inline constexpr Methods rigid = 1, flexible = 2, equilibrium = 4, regressions = 8, spectrum = 16, fe = 32,
                         reduced = 64, modes = 128;
}

/// Methods whose answer follows the key. The others have no use for it (a rigid block has no modulus), refuse it, or leave
/// out what it asks for and say so: not_honoured().
/// @param table, key  as in the table of keys: "drains", "lost_at_slip"
Methods honoured_by(const std::string& table, const std::string& key);

/// "rigid, flexible, fe", in the order of the bits; "all", "none".
std::string method_words(Methods set);

/// What the scene asks for that these methods leave out of their slip, a note each; no PASS rests on such a slip.
std::vector<Diagnostic> not_honoured(const Scene& scene, Methods set);

} // namespace damslip
