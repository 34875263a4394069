#include "pages/scene/scene_pages.hpp"

#include "core/text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::pages {

namespace {

/// "key = value   # what it is", with "ASSUMED" where nobody gave it.
std::string line(const std::string& key, double value, bool given, const std::string& meaning)
{
    return fmt::format("{:<26} # {}{}\n", key + " = " + shortest(value), given ? "" : "ASSUMED, check: ", meaning);
}

std::string line(const std::string& key, const std::optional<double>& given, double otherwise,
                 const std::string& meaning)
{
    return line(key, given.value_or(otherwise), given.has_value(), meaning);
}

/// To the half metre.
double rounded(double metres)
{
    return std::max(0.5, std::round(2.0 * metres) / 2.0);
}

/// As a string of TOML.
std::string quoted(const std::string& text)
{
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + "\"";
}

std::string records_of(const SceneTemplate& dam)
{
    if (dam.records.empty())
        return "# Accelerograms: AT2, CSV, ESM, COSMOS, SMC, K-NET and more (docs/records.md); one [[motion.record]] "
               "for each.\n"
               "# [[motion.record]]\n"
               "# horizontal = \"record_h.AT2\"\n"
               "# vertical = \"record_v.AT2\"     # leave out where there is none\n";
    std::string out;
    for (std::size_t i = 0; i < dam.records.size(); ++i) {
        out += (i ? "\n[[motion.record]]\nhorizontal = " : "[[motion.record]]\nhorizontal = ") +
               quoted(dam.records[i].string()) + "\n";
        if (i < dam.verticals.size()) out += "vertical = " + quoted(dam.verticals[i].string()) + "\n";
    }
    return out;
}

} // namespace

std::string scene_text(const SceneTemplate& dam)
{
    const double base = dam.base.value_or(rounded(0.8 * dam.height)),
                 crest = dam.crest.value_or(rounded(0.1 * dam.height));
    std::string out =
        "# A gravity dam on rock. The heel is the origin, x points downstream, y up; lengths in metres.\n"
        "# Lines with ASSUMED are guesses that stand for your own numbers. All keys: docs/scene-keys.md.\n"
        "#\n"
        "# run:  damslip screen THIS      limit equilibrium, regressions and the rigid block, in a second\n"
        "#       damslip fe THIS          finite elements with contact, both polarities\n"
        "#       damslip draw THIS        the section as SVG\n";
    out += "title = " + quoted(dam.title) +
           "\n\n# Title block of the reports; take the # away and fill in.\n"
           "# [project]\n"
           "# name = \"Safety review\"\n"
           "# client = \"Owner of the dam\"\n"
           "# author = \"Name of the engineer\"\n"
           "# checker = \"Name of the checker\"\n"
           "# date = \"2026-01-31\"\n"
           "# revision = \"A\"\n"
           "\n[section]\n";
    out += line("height_m", dam.height, true, "from the base to the crest");
    out += line("base_m", dam.base, base, "length of the base, heel to toe");
    out += line("crest_m", dam.crest, crest, "width of the crest; polygon_m takes any other section");
    out += "\n[dam]\n";
    out += line("density_kg_m3", 2400, false, "concrete");
    out += line("young_modulus_GPa", 25, false, "finite elements only; static to dynamic: see docs/user-guide.md");
    out += line("poisson_ratio", 0.2, false, "of the concrete");
    out += "\n[foundation]\n";
    out += line("young_modulus_GPa", 25, false, "rock; delete the table for a rigid base");
    out += line("poisson_ratio", 0.25, false, "of the rock");
    out += line("width_m", std::round(5.0 * dam.height), false, "of the box for statics and seepage");
    out += line("depth_m", std::round(1.5 * dam.height), false, "the same");
    out += "\n[reservoir]\n";
    out += line("level_m", dam.level, rounded(0.95 * dam.height), "of the water above the heel");
    out += "\n[uplift]\n";
    out += "model = \"linear\"           # ASSUMED, check: from the full head at the heel to the tailwater at the toe, "
           "no drains\n";
    out += "\n[contact]\n";
    out += line("friction", dam.friction, 0.8, "of the base, Coulomb's mu; cohesion_kPa only where tests show it");
    out += "\n[criteria]\n";
    out += line("allowable_slip_mm", dam.allowable, 50, "the verdict is against this");
    return out + "\n" + records_of(dam);
}

} // namespace damslip::pages
