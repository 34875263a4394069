#include "core/file.hpp"
#include "core/units.hpp"
#include "core/version.hpp"
#include "fe2d/output/vtu.hpp"
#include "pages/fe/fe_pages.hpp"
#include "pages/modes/modes_pages.hpp"
#include "pages/report/table_text.hpp"
#include "pages/scene/scene_pages.hpp"
#include "scene/plausible.hpp"
#include "scene/rock_mass.hpp"
#include "scene/write.hpp"
#include "sliding/loads/added_mass.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ranges>
#include <sstream>

namespace damslip::pages {

namespace {

using Mode = Eigen::Index; ///< from 0
using ModeColumn = ColumnOf<Mode>;

/// Shares of the modes up to each one, summed in their order [-].
std::vector<double> sums_of(const Eigen::Matrix2Xd& share, Mode direction)
{
    std::vector<double> sums;
    double sum = 0.0;
    for (Mode i = 0; i < share.cols(); ++i) sums.push_back(sum += share(direction, i));
    return sums;
}

auto in_percent(const std::vector<double>& shares)
{
    return [&shares](Mode i) { return 100 * shares[static_cast<std::size_t>(i)]; };
}

/// Columns that natural and coupled modes share. @param m  either, outlives this
template <class Modes>
std::vector<ModeColumn> mode_columns(const Modes& m, const std::vector<double>& sum_x)
{
    return {{in_brief({"mode", "mode"}), [](Mode i) { return static_cast<std::int64_t>(i + 1); }},
            {in_brief({"frequency_Hz", "frequency", "Hz", 5}), [&m](Mode i) { return m.frequency[i]; }},
            {in_brief({"period_s", "period", "s", 5}), [&m](Mode i) { return 1 / m.frequency[i]; }},
            {{"effective_mass_x_kg_m", "mass x", "kg/m", 5}, [&m](Mode i) { return m.effective_mass(0, i); }},
            {in_brief({"share_x_percent", "share x", "%", 4}), [&m](Mode i) { return 100 * m.effective_share(0, i); }},
            {in_brief({"cumulative_x_percent", "sum x", "%", 4}), in_percent(sum_x)},
            {{"effective_mass_y_kg_m", "mass y", "kg/m", 5}, [&m](Mode i) { return m.effective_mass(1, i); }},
            {in_brief({"share_y_percent", "share y", "%", 4}), [&m](Mode i) { return 100 * m.effective_share(1, i); }}};
}

Table natural_mode_table(const fe2d::NaturalModes& m)
{
    const std::vector<double> sum_x = sums_of(m.effective_share, 0), sum_y = sums_of(m.effective_share, 1);
    std::vector<ModeColumn> columns = mode_columns(m, sum_x);
    columns.push_back({{"cumulative_y_percent", "sum y", "%", 4}, in_percent(sum_y)});
    return table_of(
        "Natural modes (tied base)", columns, std::views::iota(Mode{0}, m.frequency.size()),
        {"shares of everything that moves in that direction, added mass included; massless rock adds no modes."});
}

/// @param count  rows at most
Table coupled_mode_table(const fe2d::CoupledModes& m, const std::vector<Mode>& leading, Mode count)
{
    const std::vector<double> sum_x = sums_of(m.effective_share, 0);
    const auto chosen = [&](Mode i) { return std::ranges::find(leading, i) != leading.end() ? Cell("yes") : Cell(); };
    std::vector<ModeColumn> columns = mode_columns(m, sum_x);
    const ModeColumn of{in_brief({"of", "of"}), [&](Mode i) { return m.of_water(i) ? "reservoir" : "dam"; }},
        energy{{"water_energy_percent", "energy in water", "%", 3}, [&](Mode i) { return 100 * m.water_share[i]; }};
    columns.insert(columns.begin() + 3, {of, energy}); // before the masses
    columns.push_back({in_brief({"dam_share_x_percent", "of it the dam", "%", 4}), [&](Mode i) { return 100 * m.dam_share[i]; }});
    columns.push_back({{"leading", "leading"}, chosen});
    return table_of(
        "Coupled modes of dam and water (tied base)", columns,
        std::views::iota(Mode{0}, std::min(count, m.frequency.size())),
        {fmt::format("real modes: far end closed, bottom rigid and still. leading: the first {} in which the dam's own "
                     "mass carries at least 0.1 % of the horizontal mass; damping.rayleigh_modes counts these.",
                     leading.size()),
         "shares of the dam and the added mass of incompressible water; a mode is the reservoir's when more than half "
         "of its potential energy is in the water."});
}

constexpr double two_pi = 2 * std::numbers::pi;

/// "2 sign changes of 95 % of the mass"
std::string damping_remark(const fe2d::ModifiedRayleigh& m)
{
    const std::size_t changes = m.sign_changes.size();
    if (m.status == fe2d::ModifiedRayleighStatus::found)
        return fmt::format("{} sign change{} of {:.0f} % of the mass", changes, changes == 1 ? "" : "s",
                           100 * m.mass_share);
    return fmt::format("no solution: ordinary Rayleigh of {:.0f} % of the mass, |ΔS| {:.2g}", 100 * m.mass_share,
                       m.relative_imbalance);
}

std::string criterion_sentence(const Scene& scene, double frequency)
{
    const sliding::CompressibilityCriterion c = sliding::compressibility_criterion(
        {scene.reservoir->level, scene.reservoir->density, scene.reservoir->bulk_modulus}, frequency);
    return fmt::format(
        "compressibility (3-36): Omega_r = {:.3g} {} 2, so compressible water {} (acoustic reservoir{}).",
        c.frequency_ratio, c.compressible_matters ? "<" : ">=", c.compressible_matters ? "matters" : "does not matter",
        c.compressible_matters ? "" : " not needed");
}

/// What has to be said beside the tables.
std::vector<std::string> modes_notes(const Scene& given, const ModesResult& m)
{
    std::vector<std::string> notes = note_texts(given.notes);
    if (m.choice) notes.push_back(m.choice->reason);
    if (m.period)
        notes.push_back(fmt::format("added_mass.period_s = \"dam\": T = {:.6g} s, f_1 = {:.5g} Hz (incompressible "
                                    "water: {:.5g} Hz), {} solutions",
                                    1 / m.period->frequency, m.period->frequency, m.period->incompressible_frequency,
                                    m.period->iterations));
    if (rock_has_mass(m.scene))
        notes.push_back(
            "foundation.mass = \"with-mass\": modes are those of the dam on massless rock, from which Rayleigh's "
            "constants come too; rock with mass has the modes of its box, or, where waves leave, none");
    if (!m.transfer.empty() && rock_has_mass(m.scene)) notes.push_back("transfer functions: on " + rock_words(m.scene));
    if (m.radiating && m.radiating->resolved < two_pi * m.transfer.back().frequency)
        notes.push_back(
            fmt::format("transfer functions above {:.3g} Hz are not resolved: there the reduced rock hardly "
                        "radiates (foundation.wave_frequency_Hz)",
                        m.radiating->resolved / two_pi));
    if (m.coupled && m.coupled->status != fe2d::CoupledModesStatus::ok)
        notes.push_back("not all coupled modes were found: " + text_of(m.coupled->solver.note()));
    else if (m.coupled && m.count && *m.count > m.coupled->frequency.size())
        notes.push_back(fmt::format("{} of {} modes: with acoustic water those up to {:g} Hz are looked for",
                                    m.coupled->frequency.size(), *m.count, coupled_modes_to));
    if (m.water) {
        notes.push_back(water_counts(*m.water));
        for (std::string& warning : reservoir_warnings(m.scene, coupled_modes_to)) notes.push_back(std::move(warning));
    } else if (m.modes.status != fe2d::ModesStatus::ok) {
        notes.push_back(fmt::format("only {} of {} modes: {}", m.modes.frequency.size(), m.count.value_or(usual_modes),
                                    text_of(m.modes.solver.note())));
    }
    if (m.scene.reservoir && m.modes.frequency.size() && !m.choice && !m.water)
        notes.push_back(criterion_sentence(m.scene, m.modes.frequency[0]));
    if (m.damping)
        for (const DampingOfModes::OfRecord& r : m.damping->modified)
            for (const Note& warning : r.found.warnings) notes.push_back(r.record + ": " + text_of(warning));
    return notes;
}

Table frequency_table(const ModesResult& m)
{
    return m.coupled ? coupled_mode_table(*m.coupled, m.leading, m.count.value_or(m.coupled->frequency.size()))
                     : natural_mode_table(m.modes);
}

Table damping_table(const ModesResult& m)
{
    struct Row {
        std::string method;
        fe2d::RayleighConstants constants;
        double first_frequency;                 ///< [rad/s]
        std::optional<double> second_frequency; ///< [rad/s]; none: no solution
        std::string remark;
    };
    std::vector<Row> rows;
    if (const auto& d = m.damping) {
        rows.push_back({"Rayleigh", d->rayleigh, d->first_frequency, d->second_frequency,
                        fmt::format("modes {} and {}", d->first_mode + 1, d->second_mode + 1)});
        for (const auto& [record, found] : d->modified)
            rows.push_back({"modified Rayleigh, " + record, found.constants, d->first_frequency,
                            found.status == fe2d::ModifiedRayleighStatus::found ? std::optional(found.second_frequency)
                                                                                : std::nullopt,
                            damping_remark(found)});
    }
    return table_of<Row>(
        fmt::format("Damping, {:.3g} %", 100 * m.scene.damping.ratio),
        {{in_brief({"method", "method"}), &Row::method},
         {in_brief({"mass_coefficient_1_s", "a_M", "1/s", 5}), [](const Row& r) { return r.constants.mass; }},
         {in_brief({"stiffness_coefficient_s", "b_K", "s", 5}), [](const Row& r) { return r.constants.stiffness; }},
         {{"first_frequency_Hz", "f_i", "Hz", 5}, &Row::first_frequency, two_pi},
         {{"second_frequency_Hz", "f_j", "Hz", 5}, &Row::second_frequency, two_pi},
         {in_brief({"remark", "remark"}), &Row::remark}},
        rows);
}

Table transfer_table(const ModesResult& m)
{
    using P = fe2d::TransferPoint;
    const auto degrees = [](std::complex<double> z) { return std::arg(z) * 180.0 / M_PI; };
    std::vector<ColumnOf<P>> columns{
        {{"frequency_Hz", "frequency", "Hz", 5}, &P::frequency},
        {{"crest_amplitude", "crest/ground", "–", 5}, [](const P& p) { return std::abs(p.crest); }},
        {{"crest_phase_deg", "phase", "deg", 4}, [=](const P& p) { return degrees(p.crest); }}};
    if (m.water) {
        columns.push_back({{"water_force_kN_m_per_m_s2", "water force", "kN/m per m/s²", 5},
                           [](const P& p) { return std::abs(p.water_force) / 1e3; }});
        columns.push_back(
            {{"water_force_phase_deg", "phase", "deg", 4}, [=](const P& p) { return degrees(p.water_force); }});
    }
    return table_of("Transfer functions of a horizontal ground acceleration (tied base)", columns,
                    m.transfer | std::views::filter(&P::regular),
                    {"crest: absolute acceleration of its upstream end in x; both positive downstream."});
}

} // namespace

Answer modes_answer(const Scene& given, const ModesResult& m)
{
    Answer all(json_header("modes", given));
    all += given.title + "\n\n";
    all.add("modes", frequency_table(m), {.brief = true});
    all.add("damping", damping_table(m), {.brief = true});
    all.add("model", count_table(m.model.counts, m.water ? &*m.water : nullptr));
    if (!m.transfer.empty()) all.add("transfer_functions", transfer_table(m));
    const Eigen::VectorXd& frequency = m.coupled ? m.coupled->frequency : m.modes.frequency;
    all.headline_in_brief({frequency.size() > 0 ? fmt::format("The first mode has {:.4g} Hz, a period of {:.4g} s (tied base).",
                                                              frequency[0], 1.0 / frequency[0])
                                                : "No mode was found."});
    all.notes("notes", modes_notes(given, m));
    return all;
}

void write_modes(const std::filesystem::path& folder, const Scene& given, const ModesResult& m)
{
    for (Mode i = 0; !m.water && i < m.modes.frequency.size(); ++i)
        fe2d::write_vtu(folder / fmt::format("mode_{:02d}.vtu", i + 1), m.model.mesh,
                        {{"shape", node_vectors(m.model.dofs, m.modes.shape.col(i))}}, {});
    if (m.transfer.empty()) return;
    const std::vector<std::string> comments{"damslip " + program_version() + " modes --frf",
                                            "scene " + scene_hash(given)};
    write_file(folder / "transfer_functions.csv", csv(transfer_table(m), comments));
}

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
