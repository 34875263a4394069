#include "scene/check.hpp"
#include "scene/plausible.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace damslip {

namespace {

/// A value beside another one it is usually in proportion to.
struct Proportion {
    const char* key;     ///< "curtain.depth", where the note stands
    const char* written; ///< "curtain.depth_m"
    double value;        ///< [m]
    double length;       ///< [m]
    const char* of;      ///< "the dam's height"
    double low, high;    ///< of value / length
    const char* source;
};

void look_at(const Proportion& p, Findings& f)
{
    const double ratio = p.value / p.length;
    if (ratio >= p.low * (1 - 1e-9) && ratio <= p.high * (1 + 1e-9)) return;
    Diagnostic note;
    note.problem = fmt::format("{} = {} is unusual: {} times {}, {} m.", p.written, six_digits(p.value),
                               six_digits(ratio), p.of, six_digits(p.length));
    note.expected = fmt::format("{} ... {} m, {} ... {} times {} ({})", six_digits(p.low * p.length),
                                six_digits(p.high * p.length), six_digits(p.low), six_digits(p.high), p.of, p.source);
    note.fix = "check value and unit";
    f.note(p.key, note);
}

double height_of(const Section& section)
{
    return crest_level(section) - std::min(heel(section).y, toe(section).y);
}

/// Height and base of a polygon, which has no keys for them.
void look_at_polygon(const Scene& s, Findings& f)
{
    if (!f.given("section.polygon")) return;
    for (const auto& [name, value] :
         {std::pair("section.height", height_of(s.section)), std::pair("section.base", base_length(s.section))}) {
        const Key key = key_named(name);
        if (auto note = unusual(key, {fmt::format("the {} of section.polygon, {} m,", key.name, six_digits(value)),
                                      value, key.units.front(), false}))
            f.note("section.polygon", *note);
    }
}

void look_at_shape(const Scene& s, Findings& f)
{
    look_at_polygon(s, f);
    if (s.section.rock_slope) return;
    const char* const where = f.given("section.polygon") ? "section.polygon" : "section.base";
    look_at(
        {where, "the section's base", base_length(s.section), height_of(s.section), "its height", 0.3, 4, "judgement"},
        f);
}

/// Below the dam, along the base and into the rock.
void look_at_base(const Scene& s, Findings& f)
{
    const double base = base_length(s.section), height = height_of(s.section);
    if (s.curtain) {
        look_at({"curtain.distance", "curtain.distance_m", s.curtain->distance, base, "the base", 0, 1.0 / 3.0,
                 "judgement"},
                f);
        look_at({"curtain.depth", "curtain.depth_m", s.curtain->depth, height, "the dam's height", 0.1, 2, "USBR 1976"},
                f);
    }
    if (s.drains)
        look_at({"drains.distance", "drains.distance_m", s.drains->distance, base, "the base", 0, 0.5, "judgement"}, f);
    if (!s.foundation) return;
    look_at({"foundation.width", "foundation.width_m", s.foundation->width, base, "the base", 2, 30, "judgement"}, f);
    look_at({"foundation.depth", "foundation.depth_m", s.foundation->depth, base, "the base", 0.5, 20, "judgement"}, f);
}

void look_at_level(const std::string& key, const std::string& written, double level, double crest, Findings& f)
{
    if (const auto note = unusual_level(fmt::format("{} = {}", written, six_digits(level)), level, crest))
        f.note(key, *note);
}

/// A level that is above another one it usually is below.
void look_at_order(const std::string& key, const std::string& written, double level, const std::string& other,
                   double above, const char* reason, Findings& f)
{
    if (level <= above * (1 + 1e-9)) return;
    Diagnostic note;
    note.problem = fmt::format("{} = {} is above {} = {}.", written, six_digits(level), other, six_digits(above));
    note.expected = fmt::format("at most {}: {} (judgement)", six_digits(above), reason);
    note.fix = "check datum and unit: both are measured from the heel";
    f.note(key, note);
}

void look_at_ice(const Scene& s, Findings& f)
{
    if (!s.ice || !s.reservoir || !f.given("ice.level")) return;
    const double below = s.reservoir->level - s.ice->level;
    if (below >= -1e-9 && below <= 2) return;
    Diagnostic note;
    note.problem =
        fmt::format("ice.level_m = {} is {} m {} the water surface, reservoir.level_m = {}.", six_digits(s.ice->level),
                    six_digits(std::abs(below)), below > 0 ? "below" : "above", six_digits(s.reservoir->level));
    note.expected = "0 ... 2 m below the surface, on which the ice floats (judgement)";
    note.fix = "leave level_m out: the ice then acts at the water surface";
    f.note("ice.level", note);
}

void look_at_water(const Scene& s, Findings& f)
{
    if (s.section.rock_slope) return; // [reservoir] is the water in its tension crack
    const double crest = crest_level(s.section);
    const double reservoir = s.reservoir ? s.reservoir->level : 0.0;
    if (s.reservoir) {
        look_at_level("reservoir.level", "reservoir.level_m", reservoir, crest, f);
        if (reservoir > 0.0 && f.given("reservoir.length"))
            look_at({"reservoir.length", "reservoir.length_m", s.reservoir->length, reservoir, "the water's depth", 0.5,
                     10, "judgement"},
                    f);
    }
    if (s.tailwater && s.reservoir)
        look_at_order("tailwater.level", "tailwater.level_m", s.tailwater->level, "reservoir.level_m", reservoir,
                      "water downstream of the dam stands lower than upstream", f);
    if (s.drains && s.drains->gallery_level && s.reservoir)
        look_at_order("drains.gallery_level", "drains.gallery_level_m", *s.drains->gallery_level, "reservoir.level_m",
                      reservoir, "drains draw the pressure down to the gallery", f);
    if (s.silt && s.reservoir)
        look_at_order("silt.level", "silt.level_m", s.silt->level, "reservoir.level_m", reservoir,
                      "silt settles under water", f);
    look_at_ice(s, f);
}

/// A flood may stand above the crest, a usual state does not.
void look_at_combinations(const Scene& s, Findings& f)
{
    for (std::size_t i = 0; i < s.combinations.size(); ++i) {
        const Combination& c = s.combinations[i];
        const std::string label = fmt::format("combination[{}]", i + 1);
        const double crest = crest_level(s.section);
        if (c.reservoir_level && (c.kind == CombinationKind::usual || *c.reservoir_level > 1.1 * crest))
            look_at_level(label + ".reservoir_level", label + ".reservoir_level_m", *c.reservoir_level, crest, f);
        const double upstream = c.reservoir_level.value_or(s.reservoir ? s.reservoir->level : 0.0);
        if (c.tailwater_level && s.reservoir)
            look_at_order(label + ".tailwater_level", label + ".tailwater_level_m", *c.tailwater_level, "the reservoir",
                          upstream, "water downstream of the dam stands lower than upstream", f);
    }
}

} // namespace

void note_unusual(const Scene& scene, Findings& findings)
{
    if (scene.wedge) return;
    look_at_shape(scene, findings);
    look_at_base(scene, findings);
    look_at_water(scene, findings);
    look_at_combinations(scene, findings);
}

} // namespace damslip
