#include "pages/modes/modes_pages.hpp"

#include "core/text.hpp"
#include "core/units.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/table_text.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace damslip::pages {

namespace {

constexpr double kilo = 1e3;

} // namespace

Table spectrum_table(const SpectrumLevel& level)
{
    using R = SpectrumDemand;
    using units::MPa;
    std::vector<std::string> notes{
        fmt::format("modes of dam and massless rock on a bonded base with {}, {:.3g} % damping; CQC of Der Kiureghian "
                    "(1981), the mass that the modes leave moves with the ground; horizontal component alone{}.",
                    level.water, 100.0 * level.ratio, level.vertical_mass > 0.0 ? ", both in the next table" : ""),
        fmt::format("without earthquake: T {:.4g} kN/m, N' {:.4g} kN/m, sliding factor {}, overturning factor "
                    "{}, heel {:.3g} MPa, toe {:.3g} MPa (compression positive, no crack).",
                    level.static_shear / kilo, level.static_normal / kilo, factor_text(level.static_sliding),
                    factor_text(level.static_overturning), level.static_heel / MPa, level.static_toe / MPa),
        "factors: static loads and the peak of the earthquake downstream together; a factor below 1 at one instant is "
        "not yet a failure: how far the dam slides is the question of the other levels."};
    notes.insert(notes.end(), level.notes.begin(), level.notes.end());
    return table_of<R>("Response spectrum",
                       {{{"record", "record"}, &R::record},
                        {{"pga_m_s2", "PGA", "m/s²"}, &R::pga},
                        {{"base_shear_kN_m", "base shear", "kN/m", 5}, &R::shear, kilo},
                        {{"base_shear_srss_kN_m", "by SRSS", "kN/m", 5}, &R::shear_srss, kilo},
                        {{"seismic_coefficient", "coefficient", "–"}, &R::coefficient},
                        {{"base_moment_kN", "moment", "kN m/m", 5}, &R::moment, kilo},
                        {{"crest_mm", "crest", "mm"}, &R::crest, units::mm},
                        {{"heel_least_MPa", "heel, least", "MPa", 3}, &R::heel_least, MPa},
                        {{"toe_most_MPa", "toe, most", "MPa", 3}, &R::toe_most, MPa},
                        {{"sliding_factor", "sliding factor", "–", 3}, &R::sliding_factor},
                        {{"overturning_factor", "overturning factor", "–", 3}, &R::overturning_factor}},
                       level.rows, notes);
}

namespace {

/// Of many records: three are shown mode by mode.
constexpr std::size_t detailed_spectra = 3;

/// Modes, their masses and shares of one spectrum's base shear, or of the normal force of its vertical component.
Table mode_table(const SpectrumLevel& level, const SpectrumDemand& row, bool vertical)
{
    using M = ModeShare;
    const double total = vertical ? level.vertical_mass : level.total_mass,
                 left = vertical ? row.vertical_residual_mass : row.residual_mass;
    std::vector<ColumnOf<M>> columns{
        {{"frequency_Hz", "frequency", "Hz", 5}, &M::frequency},
        {{"effective_mass_kg_m", "effective mass", "kg/m", 5}, &M::effective_mass},
        {{"share_percent", "share", "%", 3}, [=](const M& m) { return 100.0 * m.effective_mass / total; }},
        {{"spectral_acceleration_m_s2", "S_a", "m/s²", 4}, &M::acceleration}};
    if (vertical) {
        columns.push_back({{"normal_force_kN_m", "normal force", "kN/m", 5}, &M::base_shear, kilo});
    } else {
        columns.insert(columns.begin() + 1,
                       {{"period_s", "period", "s", 4}, [](const M& m) { return 1.0 / m.frequency; }});
        columns.push_back({{"base_shear_kN_m", "base shear", "kN/m", 5}, &M::base_shear, kilo});
    }
    return table_of(row.record + (vertical ? ": modes, vertical" : ": modes"), columns,
                    vertical ? row.vertical_modes : row.modes,
                    {fmt::format("total mass {:.5g} kg/m; left by the modes: {:.3g} %, under the PGA.", total,
                                 100.0 * left / total)});
}

/// Each component of the earthquake and both together, where the spectra have a vertical one; else without rows.
Table component_table(const SpectrumLevel& level)
{
    struct Row {
        std::string record;
        double pga;
        const ComponentDemand* demand;
    };
    std::vector<Row> rows;
    for (const SpectrumDemand& d : level.rows)
        for (const ComponentDemand& c : d.components)
            rows.push_back({d.record, c.motion == "vertical" ? d.vertical_pga : d.pga, &c});
    using R = Row;
    return table_of<R>(
        "Response spectrum, both components",
        {{{"record", "record"}, &R::record},
         {{"motion", "motion"}, [](const R& r) { return r.demand->motion; }},
         {{"pga_m_s2", "PGA", "m/s²"}, &R::pga},
         {{"base_shear_kN_m", "base shear", "kN/m", 5}, [](const R& r) { return r.demand->shear / kilo; }},
         {{"normal_force_kN_m", "normal force", "kN/m", 5}, [](const R& r) { return r.demand->normal / kilo; }},
         {{"base_moment_kN", "moment", "kN m/m", 5}, [](const R& r) { return r.demand->moment / kilo; }},
         {{"heel_least_MPa", "heel, least", "MPa", 3}, [](const R& r) { return r.demand->heel_least / units::MPa; }},
         {{"toe_most_MPa", "toe, most", "MPa", 3}, [](const R& r) { return r.demand->toe_most / units::MPa; }},
         {{"sliding_factor", "sliding factor", "–", 3}, [](const R& r) { return r.demand->sliding_factor; }},
         {{"overturning_factor", "overturning factor", "–", 3},
          [](const R& r) { return r.demand->overturning_factor; }}},
        rows,
        {"each component alone: its modes by CQC; SRSS: root of the sum of the squares "
         "of both, "
         "the sliding factor the least on the ellipse of shear and normal force; 100/30: all of one and 0.3 of the "
         "other, "
         "the worst, the vertical component up or down.",
         "forces and moment: peaks of the earthquake alone, either way; stresses and factors: with the static loads."});
}

/// Equivalent lateral forces and sections over the height.
Table height_table(const SpectrumDemand& row)
{
    using L = LevelForce;
    return table_of<L>(row.record + ": forces over the height",
                       {{{"level_m", "level", "m"}, &L::level},
                        {{"lateral_force_kN_m", "lateral force up to the next", "kN/m"}, &L::lateral, kilo},
                        {{"shear_kN_m", "shear", "kN/m"}, &L::shear, kilo},
                        {{"moment_kN", "moment", "kN m/m"}, &L::moment, kilo},
                        {{"stress_MPa", "vertical stress at a face", "MPa", 3}, &L::stress, units::MPa}},
                       row.levels, {"peaks of the earthquake alone, either way; sections as beams (plane, linear)."});
}

} // namespace

nlohmann::ordered_json spectrum_json(const SpectrumLevel& level)
{
    nlohmann::ordered_json j{{"damping_ratio", level.ratio},
                             {"water", level.water},
                             {"total_mass_kg_m", level.total_mass},
                             {"static_sliding_factor", level.static_sliding},
                             {"static_overturning_factor", level.static_overturning}};
    j["rows"] = json_of(spectrum_table(level));
    for (std::size_t i = 0; i < level.rows.size(); ++i) {
        j["rows"][i]["modes"] = json_of(mode_table(level, level.rows[i], false));
        j["rows"][i]["heights"] = json_of(height_table(level.rows[i]));
        if (!level.rows[i].vertical_modes.empty())
            j["rows"][i]["vertical_modes"] = json_of(mode_table(level, level.rows[i], true));
    }
    if (level.vertical_mass > 0.0) j["components"] = json_of(component_table(level));
    j["notes"] = level.notes;
    return j;
}

std::string spectrum_text(const SpectrumLevel& level)
{
    std::vector<Table> tables{spectrum_table(level)};
    if (level.vertical_mass > 0.0) tables.push_back(component_table(level));
    for (std::size_t i = 0; i < level.rows.size() && i < detailed_spectra; ++i) {
        tables.push_back(mode_table(level, level.rows[i], false));
        tables.push_back(height_table(level.rows[i]));
    }
    return texts(tables);
}

std::string spectrum_sentence(const SpectrumLevel& level)
{
    if (level.rows.empty()) return "";
    const SpectrumDemand& worst = *std::max_element(level.rows.begin(), level.rows.end(), [](const auto& a, const auto& b) {
        return a.shear < b.shear;
    });
    return fmt::format("{}, PGA {:.4g} m/s²: base shear {:.4g} MN/m by its modes, sliding factor {:.3g}, heel {:.3g} MPa at least",
                       worst.record, worst.pga, worst.shear / 1e6, worst.sliding_factor, worst.heel_least / units::MPa);
}

Section spectrum_section(const SpectrumLevel& level)
{
    Section section{"Response spectrum"};
    section.parts.push_back(rows_part(spectrum_table(level)));
    if (level.vertical_mass > 0.0) section.parts.push_back(rows_part(component_table(level)));
    for (const SpectrumDemand& row : level.rows) {
        section.parts.push_back(TablePart{mode_table(level, row, false), Layout::rows, 1, Fold::folded});
        section.parts.push_back(TablePart{height_table(row), Layout::rows, 1, Fold::folded});
        if (!row.vertical_modes.empty())
            section.parts.push_back(TablePart{mode_table(level, row, true), Layout::rows, 1, Fold::folded});
    }
    return section;
}

} // namespace damslip::pages
