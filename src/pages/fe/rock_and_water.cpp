#include "pages/fe/fe_pages.hpp"

#include "analysis/prepare/ready.hpp"
#include "core/text.hpp"
#include "scene/joint_bond.hpp"
#include "scene/mesh_sizes.hpp"
#include "scene/rock_mass.hpp"
#include "scene/section.hpp"
#include "scene/water.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <numbers>
#include <ranges>

namespace damslip::pages {

namespace {

const char* word(RockKind kind)
{
    return word_in(kind, {{RockKind::rigid, "rigid"},
                          {RockKind::massless, "massless"},
                          {RockKind::boxed, "boxed"},
                          {RockKind::radiating, "radiating"}});
}

const char* word(fe2d::RockOrigin origin)
{
    return word_in(origin, {{fe2d::RockOrigin::made, "made"},
                            {fe2d::RockOrigin::kept, "found in the cache"},
                            {fe2d::RockOrigin::not_kept, "made, the cache could not be written"}});
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

namespace {

/// What is to be known of radiating rock: a gate that was failed, what an inclined base and a curtain leave out.
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

} // namespace

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

std::vector<std::string> reservoir_warnings(const Scene& scene, double highest)
{
    const Reservoir& water = *scene.reservoir;
    const double c = std::sqrt(water.bulk_modulus / water.density), first = c / (4.0 * water.level),
                 ratio = water.length / water.level;
    std::vector<std::string> warnings;
    if (water.far_end == FarEnd::damper && highest > first)
        warnings.push_back(
            fmt::format("reservoir.far_end = \"damper\" is exact for waves along the axis only: above the reservoir's "
                        "first frequency, {:.3g} Hz, its "
                        "force may err by a factor of 2 with a rigid bottom; \"absorbing\" is right there",
                        first));
    if (water.far_end == FarEnd::damper && ratio < 2.0)
        warnings.push_back(fmt::format(
            "the reservoir is {:.3g} depths long; a damper wants 2 at least (Goldgruber 2015, 3.5.3.2)", ratio));
    if ((water.far_end == FarEnd::closed || water.far_end == FarEnd::open) && ratio < 4.0)
        warnings.push_back(
            fmt::format("the reservoir is {:.3g} depths long; a reflecting end wants 4 at least", ratio));
    if ((water.far_end == FarEnd::closed || water.far_end == FarEnd::open) && highest > first)
        warnings.push_back(fmt::format(
            "waves above the reservoir's first frequency, {:.3g} Hz, come back from a reflecting far end after "
            "{:.3g} s",
            first, 2.0 * water.length / c));
    if (water.far_end == FarEnd::absorbing && ratio < 0.5)
        warnings.push_back(
            fmt::format("the reservoir is {:.3g} depths long; the absorbing end wants half a depth at least", ratio));
    if (floor_on_rock(scene) && ratio < 2.0)
        warnings.push_back(fmt::format(
            "the reservoir is {:.3g} depths long; a floor that is the rock's wants 2 at least: the rock beyond "
            "does not feel the water, the slip may change by some 5 %",
            ratio));
    if (water.bottom_motion == BottomMotion::ground && !floor_on_rock(scene) && scene.motion.vertical &&
        water.bottom_reflection == 1.0 && !water.bottom_density && highest > first)
        warnings.push_back(
            fmt::format("a rigid bottom that moves (bottom_reflection = 1) has no damping of the water's vertical "
                        "resonance at {:.3g} Hz: vertical motion may raise the slip several times; give the bottom its "
                        "bottom_reflection",
                        first));
    const double size = water_mesh_size(water), resolved = c / (10.0 * std::max(size, water.level / 12.0));
    if (highest > resolved)
        warnings.push_back(
            fmt::format("the water's mesh resolves waves up to {:.3g} Hz (ten elements a wave)", resolved));
    return warnings;
}

std::string water_counts(const fe2d::FluidModel& water)
{
    std::string text = fmt::format("acoustic water: {} elements, {} pressures", water.reservoir.mesh.element_count(),
                                   water.mesh_unknowns);
    if (water.layer_pressures > 0)
        text += fmt::format(", absorbing end of {} layers with {} pressures and {} momenta",
                            water.options.layers.cosines.size() + water.options.layers.decays.size(),
                            water.layer_pressures, water.layer_momenta);
    return text + fmt::format("; {} non-zeros in its matrices",
                              water.mass.nonZeros() + water.damping.nonZeros() + water.stiffness.nonZeros());
}

namespace {

using fe2d::JointWaterReport;

const JointWaterReport& water_of(const ContactRun& run)
{
    return *run.fe.base_water;
}

auto with_water(const std::vector<ContactRun>& runs)
{
    return runs | std::views::filter([](const ContactRun& r) { return r.fe.base_water.has_value(); });
}

} // namespace

Table base_water_table(const Scene& scene, const std::vector<ContactRun>& runs)
{
    using R = ContactRun;
    const OpeningWater rule = scene.uplift ? scene.uplift->water.opening : OpeningWater::unchanged;
    const auto figure = [](double JointWaterReport::*member, double unit) {
        return [=](const R& r) { return water_of(r).*member / unit; };
    };
    std::vector<ColumnOf<R>> columns{
        record_of_run,
        polarity_of_run,
        {{"opening", "rule"}, [=](const R&) { return word(rule); }},
        {{"largest_crack_m", "longest crack", "m", 4}, [](const R& r) { return water_of(r).largest.upstream; }},
        {{"largest_toe_crack_m", "from the toe", "m", 4}, [](const R& r) { return water_of(r).largest.downstream; }},
        {{"crack_at_end_m", "at end", "m", 4}, [](const R& r) { return water_of(r).crack.upstream; }},
        {{"cracked_through_s", "open through", "s", 3}, figure(&JointWaterReport::cracked_through, 1.0)},
        {{"least_pressure_kPa", "least p", "kPa", 4}, figure(&JointWaterReport::least_pressure, 1e3)},
        {{"largest_pressure_kPa", "largest p", "kPa", 4}, figure(&JointWaterReport::largest_pressure, 1e3)},
        {{"water_work_J_m", "work on the dam", "J/m", 4},
         [](const R& r) { return r.fe.history.energy.empty() ? 0.0 : r.fe.history.energy.back().joint_water; }}};
    if (drains_shear_off(scene))
        columns.push_back({{"drains_lost_s", "drains lost at", "s", 4}, [](const R& r) -> Cell {
                               if (const auto at = water_of(r).drains_lost) return *at;
                               return std::string("hold");
                           }});
    if (rule == OpeningWater::reynolds)
        columns.push_back({{"reynolds_number", "largest Re", "–", 3}, figure(&JointWaterReport::reynolds_number, 1.0)});
    return table_of<R>(
        "Water in the opening base", columns, with_water(runs),
        {"crack: open pairs in a row from the heel, to the place where the opening ends; p: in the joint, "
         "against the atmosphere; work: beyond that of the pressure before the earthquake."});
}

Table joint_flow_table(const std::vector<ContactRun>& runs)
{
    using R = ContactRun;
    const auto term = [](double fe2d::JointFlowWork::*member) {
        return [=](const R& r) { return water_of(r).flow.*member; };
    };
    using W = fe2d::JointFlowWork;
    return table_of<R>(
        "Energy of the flow in the joint",
        {record_of_run,
         polarity_of_run,
         {{"walls_J_m", "on the faces", "J/m", 5}, term(&W::walls)},
         {{"ends_J_m", "from the ends", "J/m", 5}, term(&W::ends)},
         {{"drain_J_m", "from the drain", "J/m", 5}, term(&W::drain)},
         {{"rock_J_m", "from the rock", "J/m", 5}, term(&W::rock)},
         {{"gravity_J_m", "by gravity", "J/m", 5}, term(&W::gravity)},
         {{"viscous_J_m", "viscous", "J/m", 5}, term(&W::viscous)},
         {{"stored_J_m", "compression", "J/m", 5}, term(&W::stored)},
         {{"cavities_J_m", "cavities", "J/m", 5}, term(&W::cavities)},
         {{"imbalance_J_m", "imbalance", "J/m", 2}, [](const R& r) { return water_of(r).flow.imbalance(); }}},
        runs | std::views::filter([](const R& r) { return r.fe.base_water && r.fe.base_water->flow.viscous > 0.0; }),
        {"on the faces = ends + drain + rock + gravity - viscous - compression - cavities, of the whole pressure in "
         "the "
         "joint."});
}

std::vector<std::string> base_water_notes(const Scene& scene, const std::vector<ContactRun>& runs)
{
    constexpr double laminar = 2300.0; // the usual end of laminar flow
    std::vector<std::string> notes;
    const double length = scene.wedge ? 0.0 : base_length(scene.section);
    for (const ContactRun& run : with_water(runs)) {
        const JointWaterReport& w = water_of(run);
        if (w.drains_lost)
            notes.push_back(*w.drains_lost == 0.0
                                ? run.label() + ": the drains were sheared off before: uplift without them"
                                : fmt::format("{}: the drains sheared off at {:.4g} s, after {:g} mm of slip: uplift "
                                              "without them from then on",
                                              run.label(), *w.drains_lost, 1e3 * *scene.drains->lost_at_slip));
        if (w.cracked_through > 0.0)
            notes.push_back(
                fmt::format("{}: the base was open from heel to toe for {:.3g} s in all, with uplift.opening = "
                            "\"{}\": nothing but its inertia held the dam then",
                            run.label(), w.cracked_through, word(scene.uplift->water.opening)));
        else if (w.largest.upstream > 0.9 * length)
            notes.push_back(fmt::format("{}: the crack came to {:.4g} m of the {:.4g} m of the base", run.label(),
                                        w.largest.upstream, length));
        if (w.reynolds_number > laminar)
            notes.push_back(
                fmt::format("{}: the flow in the joint was turbulent, Re up to {:.3g}: its friction is that of "
                            "smooth faces (Blasius), a rough joint lets less water in",
                            run.label(), w.reynolds_number));
    }
    return notes;
}

} // namespace damslip::pages
