#include "scene/checks.hpp"

#include <fmt/format.h>
#include <set>
#include <tuple>

namespace damslip::checks {

void check_motion(const Scene& s, Findings& f, FileCheck files)
{
    if (const int polarity = s.motion.polarity.value_or(1); polarity != 1 && polarity != -1)
        f.wrong("motion.polarity", fmt::format("motion.polarity = {} is not allowed.", polarity), "1 or -1",
                "write  polarity = -1  to flip the horizontal component");
    static const std::set<std::string> known{"", "g", "m/s2", "cm/s2", "gal", "mg"};
    std::set<std::string> names;
    for (std::size_t i = 0; i < s.motion.records.size(); ++i) {
        const RecordFiles& r = s.motion.records[i];
        const std::string label = fmt::format("motion.record[{}]", i + 1);
        if (!known.contains(r.unit))
            f.wrong(label + ".unit", fmt::format("{}.unit = \"{}\" is not allowed.", label, r.unit),
                    "\"g\", \"m/s2\", \"cm/s2\", \"gal\" or \"mg\"", "write  unit = \"g\"");
        if (!names.insert(r.name).second)
            f.wrong(label + ".name", fmt::format("two records are named \"{}\".", r.name), "names that differ",
                    fmt::format("give one a name of its own in [[motion.record]] number {}", i + 1));
        if (!r.vertical_column.empty() && !r.vertical)
            f.wrong(
                label + ".vertical_column",
                fmt::format("{}.vertical_column = \"{}\", but no vertical file is named.", label, r.vertical_column),
                "vertical with vertical_column",
                fmt::format("write  vertical = \"{}\"  if the horizontal file holds it",
                            r.horizontal.filename().string()));
        if (files == FileCheck::skip) continue;
        const auto exists = [&](const std::filesystem::path& p, const char* key) {
            std::error_code error;
            if (!std::filesystem::is_regular_file(p, error))
                f.wrong(label + "." + key, fmt::format("{}.{}: there is no file {}.", label, key, p.string()),
                        "an accelerogram file, named relative to the scene file",
                        "correct the name, or copy the file there");
        };
        exists(r.horizontal, "horizontal");
        if (r.vertical) exists(*r.vertical, "vertical");
    }
}

namespace {

/// A post-seismic state follows an earthquake that the scene has.
void check_follows(const Scene& s, const Combination& c, const std::string& label, Findings& f)
{
    if (c.follows.empty()) return;
    if (c.kind != CombinationKind::post_seismic)
        return f.wrong(label + ".follows",
                       fmt::format("{}.follows = \"{}\", but its kind is not \"post-seismic\".", label, c.follows),
                       "follows in combinations of kind \"post-seismic\" only",
                       "delete follows, or write  kind = \"post-seismic\"");
    std::string extremes;
    for (const Combination& other : s.combinations) {
        if (other.kind != CombinationKind::extreme) continue;
        if (other.name == c.follows) return;
        extremes += fmt::format("{}\"{}\"", extremes.empty() ? "" : ", ", other.name);
    }
    f.wrong(label + ".follows",
            fmt::format("{}.follows = \"{}\" is no combination of kind \"extreme\".", label, c.follows),
            extremes.empty() ? "the name of an extreme combination; the scene has none" : "one of " + extremes,
            "correct the name, or leave follows out: the governing one is then taken");
}

/// A seismic coefficient is a value or a share of the records' peak.
void check_coefficients(const Combination& c, const std::string& label, Findings& f)
{
    for (const auto& [value, fraction, given] : {std::tuple("k_h", "pga_fraction", c.pga_fraction.has_value()),
                                                 std::tuple("k_v", "pga_v_fraction", c.pga_v_fraction.has_value())})
        if (given && f.given(label + "." + value))
            f.wrong(label + "." + fraction,
                    fmt::format("{0}.{1} is given together with {0}.{2}.", label, fraction, value), "one of the two",
                    fmt::format("delete {} or {}", value, fraction));
}

} // namespace

void check_combinations(const Scene& s, Findings& f)
{
    std::set<std::string> names;
    for (std::size_t i = 0; i < s.combinations.size(); ++i) {
        const Combination& c = s.combinations[i];
        const std::string label = fmt::format("combination[{}]", i + 1);
        if (!names.insert(c.name).second)
            f.wrong(label + ".name", fmt::format("two combinations are named \"{}\".", c.name), "names that differ",
                    "rename one");
        if (c.ice && !s.ice)
            f.wrong(label + ".ice", label + ".ice = true, but the scene has no [ice].",
                    "an [ice] table with force_kN_m", "add [ice] or delete the line");
        if ((f.given(label + ".reservoir_level") && !s.reservoir) ||
            (f.given(label + ".tailwater_level") && !s.tailwater))
            f.wrong(label + ".reservoir_level", label + " changes a water level of a table the scene does not have.",
                    "[reservoir] for reservoir_level_m, [tailwater] for tailwater_level_m",
                    "add the table; its level_m may be 0");
        check_follows(s, c, label, f);
        check_coefficients(c, label, f);
        if (c.required_resultant && *c.required_resultant != "kern" && *c.required_resultant != "middle-half" &&
            *c.required_resultant != "base")
            f.wrong(label + ".required_resultant",
                    fmt::format("{}.required_resultant = \"{}\" is not allowed.", label, *c.required_resultant),
                    "\"kern\" (the middle third), \"middle-half\" or \"base\" (anywhere within the base)",
                    c.required_resultant->find("half") != std::string::npos
                        ? "write  required_resultant = \"middle-half\""
                        : "write  required_resultant = \"kern\"  for the middle third");
    }
}

} // namespace damslip::checks
