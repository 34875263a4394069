#include "pages/fe/rock_lines.hpp"

#include "analysis/prepare/rock_warnings.hpp"
#include "pages/fe/fe_report.hpp"
#include "scene/curtain.hpp"
#include "scene/rock_mass.hpp"
#include "scene/section.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

namespace damslip::pages {

namespace {

const char* word(RockKind kind)
{
    switch (kind) {
    case RockKind::rigid:
        return "rigid";
    case RockKind::massless:
        return "massless";
    case RockKind::boxed:
        return "boxed";
    case RockKind::radiating:
        break;
    }
    return "radiating";
}

const char* word(fe2d::RockOrigin origin)
{
    switch (origin) {
    case fe2d::RockOrigin::made:
        return "made";
    case fe2d::RockOrigin::kept:
        return "found in the cache";
    case fe2d::RockOrigin::not_kept:
        break;
    }
    return "made, the cache could not be written";
}

double hertz(double circular)
{
    return circular / (2.0 * std::numbers::pi);
}

} // namespace

std::string rock_line(const Scene& scene, const fe2d::EarthquakeRun& model)
{
    const fe2d::RadiatingRock* rock = model.radiating();
    if (!rock) return rock_words(scene);
    const fe2d::ReductionReport& report = rock->rock.report;
    return fmt::format("{}, {:.4g} kg/m3{}: waves right to {:.3g} Hz; {} modes, error {:.2g} %, {} in {:.2g} s{}",
                       rock_words(scene), radiating_density(*scene.foundation),
                       scene.foundation->material.density > 0.0 ? "" : " (none given)", hertz(rock->resolved),
                       report.modes, 100.0 * report.error, word(rock->origin), rock->seconds,
                       rock->rock.floor > 0 ? "; the water's floor is on it" : "");
}

nlohmann::ordered_json rock_json(const Scene& scene, const fe2d::EarthquakeRun& model)
{
    nlohmann::ordered_json j{{"model", word(rock_kind(scene))}, {"words", rock_words(scene)}};
    const fe2d::RadiatingRock* rock = model.radiating();
    if (!rock) return j;
    const fe2d::ReductionReport& report = rock->rock.report;
    j["density_kg_m3"] = radiating_density(*scene.foundation);
    j["waves_to_Hz"] = hertz(rock->resolved);
    j["modes"] = report.modes;
    j["error"] = report.error;
    j["gate"] = report.wanted;
    j["unknowns_of_the_box"] = report.unknowns;
    return j;
}

std::vector<std::string> radiating_messages(const Scene& scene, const fe2d::EarthquakeRun& model)
{
    std::vector<std::string> messages;
    const fe2d::RadiatingRock* rock = model.radiating();
    if (!rock) return messages;
    const fe2d::ReductionReport& report = rock->rock.report;
    if (!report.passed())
        messages.push_back(
            fmt::format("radiating rock: its reduction errs by {:.2g} % at a frequency in between, {:.2g} % "
                        "are wanted; a smaller foundation.wave_frequency_Hz needs fewer modes",
                        100.0 * report.error, 100.0 * report.wanted));
    const double wanted = scene.foundation->wave_frequency.value_or(25.0);
    if (hertz(rock->resolved) < 0.999 * wanted)
        messages.push_back(
            fmt::format("soft rock: waves in it are right to {:.3g} Hz, {:g} Hz are wanted; above, damping "
                        "alone takes energy from it",
                        hertz(rock->resolved), wanted));
    if (const double angle = base_inclination(scene.section); angle != 0.0) {
        const double drop = std::abs(toe(scene.section).y - heel(scene.section).y), strong = 5.0;
        const Material& material = scene.foundation->material;
        const double speed = std::sqrt(*material.young_modulus / (2.0 * (1.0 + material.poisson_ratio)) /
                                       radiating_density(*scene.foundation));
        messages.push_back(fmt::format("the base drops by {:.3g} m: the record moves all of it alike, although a wave "
                                       "needs {:.2g} ms for that; error of the motion at {:g} Hz: {:.2g} %",
                                       drop, 1e3 * drop / speed, strong,
                                       100.0 * 2.0 * std::numbers::pi * strong * drop / speed));
    }
    if (curtain_changes_stiffness(scene))
        messages.push_back("the curtain's stiffness is in the statics; waves see rock without it");
    return messages;
}

ModelNotes::ModelNotes(const Scene& scene, const fe2d::EarthquakeRun& model)
    : scene_(scene), model_(model), lines_(radiating_messages(scene, model))
{
    for (std::string& note : bond_messages(scene, model.model().mesh)) lines_.push_back(std::move(note));
}

void ModelNotes::add(const std::string& record, const GroundMotion& motion)
{
    for (const std::string& warning : rock_warnings(scene_, model_.model().mesh, motion))
        if (std::string line = record + ": " + warning; lines_.empty() || lines_.back() != line)
            lines_.push_back(std::move(line));
}

} // namespace damslip::pages
