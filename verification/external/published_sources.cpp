#include "analysis/modes/modes.hpp"
#include "scene/read.hpp"
#include "verification/cases/registry.hpp"
#include "verification/external/slammer_set.hpp"
#include "verification/external/textbook_dams.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::external {

namespace {

/// Published numbers that are held as checks of verification cases: those whose quantity begins with one of the words.
struct Chosen {
    std::string case_id;
    std::vector<std::string> quantities; ///< empty: all
};

std::vector<Result> results_of(const std::vector<Chosen>& chosen)
{
    std::vector<Result> all;
    for (const verification::Case& c : verification::all_cases())
        for (const Chosen& choice : chosen) {
            if (c.id != choice.case_id) continue;
            for (const verification::Check& check : c.run()) {
                const auto begins = [&](const std::string& words) { return check.quantity.starts_with(words); };
                if (!choice.quantities.empty() &&
                    std::none_of(choice.quantities.begin(), choice.quantities.end(), begins))
                    continue;
                const bool relative = check.measure == verification::Measure::relative;
                all.push_back({.group = c.id,
                               .what = check.quantity,
                               .unit = check.unit,
                               .theirs = check.expected,
                               .ours = check.computed,
                               .accuracy = check.tolerance * (relative ? std::abs(check.expected) : 1.0),
                               .reason = ""});
            }
        }
    return all;
}

Source source(std::string id, std::string citation, std::string subject, std::string accuracy,
              std::vector<Chosen> chosen)
{
    return {std::move(id), std::move(citation), std::move(subject), std::move(accuracy), "", [chosen](const auto&) {
                return results_of(chosen);
            }};
}

/// Ours of the result that begins with some words; NaN: there is none.
double ours_of(const std::vector<Result>& results, const std::string& words)
{
    for (const Result& r : results)
        if (r.what.starts_with(words)) return r.ours;
    return std::nan("");
}

/// Pine Flat's periods. Those of a base that bends with the rock lie outside: what they are made of is computed one
/// assumption after the other.
std::vector<Result> pine_flat_results()
{
    const std::vector<Result> all = results_of({{"fe2d.rock.radiating-pine-flat", {}}});
    constexpr double standard_values = 0.04; // see the source's accuracy
    std::vector<Result> results;
    for (Result r : all) {
        if (r.what.find(" at most ") != std::string::npos) continue; // ours against ours
        r.accuracy = standard_values * std::abs(r.theirs);
        if (r.what.find("elastic base") != std::string::npos) {
            const std::string state = r.what.starts_with("period, full") ? "period, full, " : "period, empty, ";
            const auto words = [&](const char* which) {
                const double ours = ours_of(all, state + which);
                return fmt::format("{:.4f} s ({:+.1f} %)", ours, 100.0 * (ours / r.theirs - 1.0));
            };
            r.reason = fmt::format("the base bends with the rock; same section, rock and water by the first mode alone "
                                   "on a rigid strip {}, "
                                   "by all elements on that strip {}, on a base that bends {}, the same on rock in "
                                   "plane strain {}: theirs "
                                   "lies between the two of a strip",
                                   words("one mode"), words("rigid strip"), words("elastic base"),
                                   words("rock in plane strain"));
        }
        results.push_back(std::move(r));
    }
    return results;
}

Source pine_flat_source()
{
    return {
        "fenves-chopra-1986",
        "Fenves & Chopra (1986), UCB/EERC-85/10",
        "Pine Flat dam, tallest monolith: periods empty and with water to 381 ft, on a rigid base and on rock of the "
        "dam's modulus that lets waves out",
        "Standard values of a standard section with rounded coefficients: 4 %. A base that bends with the rock is held "
        "against the same 4 % and lies outside; its reason is computed",
        "",
        [](const auto&) { return pine_flat_results(); }};
}

/// Periods of Pine Flat dam under exciters at two water levels: the modulus by the first, the ratio of the periods by both.
std::vector<Result> shaken_pine_flat_results()
{
    constexpr double low = 310.0 * 0.3048, high = 345.0 * 0.3048, period_low = 0.288, period_high = 0.306;
    constexpr double periods = 0.0005 / period_low + 0.0005 / period_high, of_levels = 0.0017; // see the source's accuracy
    const Scene scene = parse_scene(R"(title = "Pine Flat dam"
[section]
polygon_ft = [[0, 0], [314.32, 0], [48.75, 340.4743590], [48.75, 400], [16.75, 400], [16.75, 335]]
[dam]
density_kg_m3 = 2482.86174
young_modulus_GPa = 22
poisson_ratio = 0.166666667
[contact]
friction = 1.0
[uplift]
model = "none"
[reservoir]
level_ft = 345
model = "added-mass"
)",
                                    "pine_flat.toml");
    const Calibration found = calibrate(scene, {.measured = {{1.0 / period_low, low}}});
    // Its frequency before any change is that of the modulus found.
    const Calibration other = calibrate(found.scene, {.measured = {{1.0 / period_high, high}}});
    const double ratio = found.frequencies.front().after / other.frequencies.front().before;
    return {{.group = "periods of a dam that was shaken",
             .what = "period with 345 ft of water over that with 310 ft",
             .unit = "–",
             .theirs = period_high / period_low,
             .ours = ratio,
             .accuracy = periods * period_high / period_low + of_levels,
             .reason = ""}};
}

Source shaken_pine_flat_source()
{
    return {"rea-liaw-chopra-1972",
            "Rea, Liaw & Chopra (1972), Dynamic properties of Pine Flat dam, UCB/EERC 72-7",
            "Pine Flat dam under exciters in winter and summer 1971: `damslip calibrate` finds the modulus of the dam by the first "
            "period, with 310 ft of water, and the scene found gives that with 345 ft",
            "Periods to 0.001 s, levels to a foot, which moves the ratio by 0.0017. A plane model with added mass on a rigid base: "
            "water that is compressible in a plane resonates lower than in the canyon, and gives 1.09",
            "",
            [](const auto&) { return shaken_pine_flat_results(); }};
}

} // namespace

std::vector<Source> all_sources()
{
    return {
        slammer_source(),
        textbook_dams_source(),
        source("goldgruber-2015", "Goldgruber (2015), Nonlinear seismic modelling of concrete dams, Graz: chapter 4",
               "dam of 62.5 and 125 m on massless rock, Westergaard's added mass and acoustic water: frequencies and "
               "effective masses; `damslip study` has its 108 slips",
               "One decimal; the figure of the section is missing in the source, so its shape is known to some per "
               "cent: 6 % of "
               "the added-mass frequencies, 2.5 % of the acoustic ones, 0.03 of a mass. The fifth frequency of the "
               "source, 15.9 Hz, has "
               "no counterpart on massless rock; the fourth is 11 % higher here",
               {{"fe.modes.reference-dam",
                 {"frequency, mode 1", "frequency, mode 2", "frequency, mode 3", "effective mass",
                  "125 m, mode 1: frequency", "125 m, mode 2: frequency", "125 m, mode 3: frequency",
                  "125 m, mode 4: frequency"}},
                {"fe2d.fluid.reference-modes", {}}}),
        source("chopra-chakrabarti-1973", "Chopra & Chakrabarti (1973), Bull. Seism. Soc. Am. 63: 381-397",
               "Koyna dam, empty, rigid base, plane stress: four circular frequencies",
               "From 136 elements: 3 %, the error of such a mesh in the fourth mode", {{"fe.modes.koyna", {}}}),
        pine_flat_source(),
        shaken_pine_flat_source(),
        source(
            "wyllie-mah-2004", "Wyllie & Mah (2004), Rock slope engineering, after Hoek & Bray (1981)",
            "the worked plane failure and the worked wedge",
            "Its printed digits; the wedge's angles are printed to whole degrees: 1.5 % with the shape made from them",
            {{"sliding.neighbours.plane-failure",
              {"depth of the crack, printed", "area of the plane, printed", "factor of safety, printed"}},
             {"sliding.neighbours.wedge-example",
              {"factor of safety with the book's", "factor of safety of the scene's"}}}),
        source("nafems", "NAFEMS, Selected benchmarks for natural frequency analysis (1987), test 32",
               "tapered membrane: six frequencies", "Five digits of its own fine mesh: 0.1 %",
               {{"fe.modes.tapered-membrane", {}}}),
        source("cook-1974", "Cook's membrane, reference value of the literature (23.96)", "deflection of the tip",
               "Four digits: 0.1 %", {{"fe.static.cooks-membrane", {"v of the tip's middle, 64 x 64"}}}),
    };
}

std::vector<std::string> not_to_be_had()
{
    return {
        "Chopra & Zhang (1991), Chavez & Fenves (1995): slips of Pine Flat and of triangular dams under Taft and "
        "others; the records as "
        "they were scaled are not at hand, and the slips are read from figures",
        "Mir & Taylor (1996), Tinawi et al. (2000), Korzec & Jankowski (2018): shake tables; the motions of the tables "
        "were not published",
        "Fenves & Chopra (1984), EAGD: curves of the crest over frequency are figures without digits, and its table of "
        "Pine Flat's periods is not at hand; the standard values of 1986 stand in their place",
        "Chopra (1967), curves of water pressure over frequency: no digits in print; the closed form is a case of "
        "`damslip verify`",
        "Sharma, Fujisawa & Murakami (2019): a dam of 50 m on rigid and on radiating rock, peaks at crest and heel; the record is "
        "not named and the width of the crest is in a figure alone",
        "code_aster, tests ssnp142 with values of GEFDYN: opening and stress of a joint with water below a dam of 10 m; the "
        "width of the crest is in a mesh file that is not published with the test",
        "printed examples of the regressions' authors: of the three of Goldgruber (2015) values by hand are a case of "
        "`damslip verify`",
    };
}

} // namespace damslip::external
