#include "pages/modes/modes_pages.hpp"

#include "core/file.hpp"
#include "core/units.hpp"
#include "core/version.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/scene_pages.hpp"
#include "scene/plausible.hpp"
#include "scene/write.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sstream>

namespace damslip::pages {

namespace {

std::string water_words(const MeasuredFrequency& m)
{
    if (!m.level) return "as in the scene";
    return *m.level == 0.0 ? "empty" : fmt::format("{:g} m", *m.level);
}

Table frequency_table(const Calibration& c)
{
    using Row = FittedFrequency;
    return table_of<Row>(
        "Frequencies (tied base)",
        {{in_brief({"water", "water"}), [](const Row& r) { return water_words(r.measured); }},
         {in_brief({"mode", "mode"}), [](const Row& r) { return static_cast<std::int64_t>(r.measured.mode); }},
         {in_brief({"measured_Hz", "measured", "Hz", 4}), [](const Row& r) { return r.measured.frequency; }},
         {in_brief({"scene_Hz", "scene", "Hz", 4}), &Row::before},
         {in_brief({"calibrated_Hz", "calibrated", "Hz", 4}), &Row::after},
         {in_brief({"by_dam", "d ln f / d ln E, dam", "–", 3}, "by E of the dam"), &Row::by_dam},
         {in_brief({"by_rock", "rock", "–", 3}, "of the rock"), &Row::by_rock}},
        c.frequencies);
}

Table modulus_table(const Calibration& c)
{
    using Row = FittedModulus;
    return table_of<Row>("Moduli",
                         {{{"key", "key"}, &Row::key},
                          {{"scene_GPa", "scene", "GPa", 4}, &Row::before, units::GPa},
                          {{"calibrated_GPa", "calibrated", "GPa", 4}, &Row::after, units::GPa},
                          {{"beta", "beta of ln E", "–", 3}, &Row::beta}},
                         c.moduli);
}

std::string headline(const Calibration& c)
{
    std::string words;
    for (const FittedModulus& m : c.moduli)
        words += fmt::format("{}E of the {} {:.4g} GPa (scene: {:.4g}), known to {:.2g} %", words.empty() ? "" : "; ",
                             m.key.starts_with("dam") ? "dam" : "rock", m.after / units::GPa, m.before / units::GPa,
                             100.0 * m.beta);
    if (c.damping)
        words += fmt::format("; damping.ratio {:.3g} (measured in all: {:.3g})", c.damping->ratio, c.damping->measured);
    return words + ".";
}

std::vector<std::string> notes_of(const Scene& given, const Calibration& c)
{
    std::vector<std::string> notes = c.notes;
    if (c.damping)
        notes.push_back(fmt::format(
            "damping.ratio = {:.4g} gives the first resonance its {:.3g} %: {}", c.damping->ratio,
            100.0 * c.damping->measured,
            c.damping->waves >= 0.0 ? fmt::format("waves into rock and water take {:.2g} %", 100.0 * c.damping->waves)
                                    : "the mass-proportional part does not act on the water"));
    notes.push_back(
        "a frequency of small motions tells the dynamic modulus on a closed base; statics and cracks may ask for less");
    for (std::string& note : note_texts(given.notes)) notes.push_back(std::move(note));
    return notes;
}

/// Laws of the moduli as tables of a scene file that `fragility` reads.
std::string fragility_laws(const Calibration& c)
{
    std::string text;
    std::vector<std::string> names;
    for (const FittedModulus& m : c.moduli) {
        names.push_back(m.key.starts_with("dam") ? "E dam" : "E rock");
        text += fmt::format("[[probability.variable]]\nname = \"{}\"\nkey = \"{}\"\nkind = \"epistemic\"\n"
                            "lognormal = {{ median = {:.4g}, beta = {:.3g} }}\n",
                            names.back(), m.key, m.after / units::GPa, m.beta);
    }
    if (c.rank_correlation)
        text += fmt::format("[[probability.correlation]]\nbetween = [\"{}\", \"{}\"]\nspearman = {:.3f}\n", names[0],
                            names[1], *c.rank_correlation);
    return text;
}

} // namespace

Answer calibration_answer(const Scene& given, const Calibration& c)
{
    Answer all(json_header("calibrate", given));
    all += given.title + "\n\n";
    all.headline({headline(c)});
    all.add("moduli", modulus_table(c));
    all.add("frequencies", frequency_table(c), {.brief = true});
    if (c.damping)
        all.set("damping",
                {{"measured", c.damping->measured}, {"ratio", c.damping->ratio}, {"waves", c.damping->waves}});
    all.set("misfit", c.misfit);
    const std::string laws = fragility_laws(c);
    all.set("laws", laws);
    all += "For a fragility:\n\n" + laws + "\n";
    std::istringstream lines(laws);
    for (std::string line; std::getline(lines, line);) all.point("", line);
    all.notes("notes", notes_of(given, c));
    return all;
}

void write_calibrated(const std::filesystem::path& file, const Calibration& c)
{
    std::string text = fmt::format("# damslip {} calibrate: {}\n", program_version(), headline(c));
    for (const FittedFrequency& f : c.frequencies)
        text += fmt::format("#   water {}, mode {}: measured {:.4g} Hz, calibrated {:.4g} Hz\n",
                            water_words(f.measured), f.measured.mode, f.measured.frequency, f.after);
    write_file(file, text + resolved_toml(c.scene));
}

} // namespace damslip::pages
