#include "scene/check.hpp"

#include "scene/uplift_models.hpp"
#include "scene/water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

namespace damslip {

namespace {

void sort_by_place(std::vector<Diagnostic>& diagnostics)
{
    std::stable_sort(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& a, const Diagnostic& b) {
        return std::tie(a.line, a.column) < std::tie(b.line, b.column);
    });
}

} // namespace

Findings::Place Findings::place(const std::string& key) const
{
    std::string name = key;
    for (;;) {
        if (const auto found = places_.find(name); found != places_.end()) return found->second;
        const std::size_t dot = name.rfind('.');
        if (dot == std::string::npos) return {};
        name.resize(dot);
    }
}

void Findings::wrong(const std::string& key, std::string problem, std::string expected, std::string fix)
{
    wrong_at(place(key), std::move(problem), std::move(expected), std::move(fix));
}

void Findings::wrong_at(Place place, std::string problem, std::string expected, std::string fix)
{
    diagnostics_.push_back({file_, place.line, place.column, std::move(problem), std::move(expected), std::move(fix)});
}

void Findings::note_at(Place place, Diagnostic note)
{
    note.file = file_;
    note.line = place.line;
    note.column = place.column;
    notes_.push_back(std::move(note));
}

std::vector<Diagnostic> Findings::notes() const
{
    std::vector<Diagnostic> sorted = notes_;
    sort_by_place(sorted);
    return sorted;
}

void Findings::throw_if_any()
{
    if (diagnostics_.empty()) return;
    sort_by_place(diagnostics_);
    throw InputError(std::move(diagnostics_));
}

namespace {

/// A key or table that is given and changes nothing.
struct Unread {
    const char* key; ///< "drains", "damping.ratio"
    bool asked;      ///< it says something else than the default, and nothing reads it
    std::string problem, read_by, fix;
};

std::vector<Unread> unread_uplift(const Scene& s, const Findings& f)
{
    if (!s.uplift) return {}; // a dry dam
    const std::string with = fmt::format("with uplift.model = \"{}\"", word(s.uplift->model));
    return {{"drains", s.drains && !drains_are_read(s), fmt::format("[drains] is not read {}.", with),
             "model = \"drains\" or \"seepage\", the models that read it", "write  model = \"drains\"  in [uplift], or delete [drains]"},
            {"curtain", s.curtain && !curtain_is_read(s, f.given("foundation.depth")),
             fmt::format("[curtain] is not read {}.", with), "model = \"seepage\" or \"curtain\", the models that read it",
             "write  model = \"seepage\"  in [uplift], or delete [curtain]"}};
}

std::vector<Unread> unread_water(const Scene& s, const Findings& f)
{
    std::vector<Unread> all;
    const AddedMass &mass = s.added_mass, usual;
    const bool still = !s.reservoir || s.reservoir->model == ReservoirModel::hydrostatic;
    const std::string without = s.reservoir ? "with reservoir.model = \"hydrostatic\"" : "without [reservoir]";
    all.push_back({"added_mass",
                   still && (mass.formula != usual.formula || mass.period || mass.period_of_dam ||
                             mass.inclined_face != usual.inclined_face || !mass.zangar_table.empty()),
                   fmt::format("[added_mass] is not read {}.", without), "water that moves, model = \"added-mass\"",
                   "delete [added_mass], or write  model = \"added-mass\"  in [reservoir]"});
    if (!s.reservoir) return all;
    const Reservoir& water = *s.reservoir;
    const Reservoir plain;
    const bool silent = water.model == ReservoirModel::hydrostatic || water.model == ReservoirModel::added_mass;
    const auto of_waves = [&](const char* key, const char* written, bool other) {
        all.push_back({key, silent && other && f.given(key),
                       fmt::format("reservoir.{} is not read with reservoir.model = \"{}\".", written,
                                   water.model == ReservoirModel::hydrostatic ? "hydrostatic" : "added-mass"),
                       "model = \"acoustic\" or \"auto\", water that has waves",
                       fmt::format("keep it for acoustic water ( sweep --reservoir acoustic ), or delete {}", written)});
    };
    of_waves("reservoir.far_end", "far_end", water.far_end != plain.far_end);
    of_waves("reservoir.surface", "surface", water.surface != plain.surface);
    of_waves("reservoir.bottom_reflection", "bottom_reflection", water.bottom_reflection != plain.bottom_reflection);
    of_waves("reservoir.bottom_density", "bottom_density_kg_m3", water.bottom_density.has_value());
    of_waves("reservoir.bottom_motion", "bottom_motion", water.bottom_motion != plain.bottom_motion);
    return all;
}

std::vector<Unread> unread_rock(const Scene& s, const Findings& f)
{
    std::vector<Unread> all;
    if (!s.foundation || s.foundation->mass != RockMass::massless) return all;
    const Foundation &rock = *s.foundation, usual;
    const auto of_mass = [&](const char* key, const char* written, bool other) {
        all.push_back({key, other && f.given(key),
                       fmt::format("foundation.{} is not read with foundation.mass = \"massless\".", written),
                       "mass = \"with-mass\", rock in which waves travel",
                       fmt::format("keep it for  --rock radiating , or delete {}", written)});
    };
    of_mass("foundation.boundary", "boundary", rock.boundary == RockBoundary::fixed); // viscous is refused
    of_mass("foundation.wave_box", "wave_box", rock.wave_box != usual.wave_box);
    of_mass("foundation.wave_frequency", "wave_frequency_Hz", rock.wave_frequency.has_value());
    of_mass("foundation.density", "density_kg_m3",
            rock.material.density > 0.0 && s.stages.gravity != GravityStage::dam_and_rock && s.seams.empty());
    return all;
}

} // namespace

void checks::note_unread(const Scene& s, Findings& f)
{
    std::vector<Unread> all = unread_uplift(s, f);
    for (auto* more : {unread_water, unread_rock})
        for (Unread& row : more(s, f)) all.push_back(std::move(row));
    all.push_back({"damping.ratio",
                   f.given("damping.ratio") && s.damping.ratio != Damping{}.ratio && s.damping.mass_coefficient &&
                       s.damping.stiffness_coefficient,
                   "damping.ratio is not read by finite elements beside damping.mass_coefficient_1_s and stiffness_coefficient_s.",
                   "one of the two; modes and response spectra have the ratio alone", "delete the coefficients, or ratio"});
    for (Unread& row : all) {
        if (!row.asked) continue;
        Diagnostic note;
        note.problem = std::move(row.problem);
        note.expected = std::move(row.read_by);
        note.fix = std::move(row.fix);
        f.note(row.key, note);
    }
}

} // namespace damslip
