#include "pages/record/record_tables.hpp"

#include "core/units.hpp"
#include "records/measure/measures.hpp"

#include <fmt/format.h>

namespace damslip::pages {

Table record_info_table(const std::vector<Record>& records)
{
    struct Row {
        const Record& record;
        records::Measures m;
    };
    std::vector<Row> rows;
    for (const Record& r : records) rows.push_back({r, records::measure(r)});
    Table table = table_of<Row>(
        "Accelerograms",
        {{{"name", "name"}, [](const Row& r) { return r.record.name; }},
         {{"format", "format"}, [](const Row& r) { return r.record.source.format; }},
         {{"unit", "unit"}, [](const Row& r) { return r.record.source.unit; }},
         {{"component", "component"}, [](const Row& r) { return r.record.source.component; }},
         {{"samples", "samples", "–", 4}, [](const Row& r) { return count_cell(r.record.acceleration.size()); }},
         {{"dt_s", "dt", "s", 4}, [](const Row& r) { return r.record.dt; }},
         {{"duration_s", "duration", "s", 4}, [](const Row& r) { return r.m.duration; }},
         {{"pga_m_s2", "PGA", "m/s²", 4}, [](const Row& r) { return r.m.pga; }},
         {{"pga_g", "PGA", "g", 3}, [](const Row& r) { return r.m.pga / units::standard_gravity; }},
         {{"pgv_m_s", "PGV", "m/s", 3}, [](const Row& r) { return r.m.pgv; }},
         {{"pgd_m", "PGD", "m", 3}, [](const Row& r) { return r.m.pgd; }},
         {{"arias_intensity_m_s", "Arias", "m/s", 3}, [](const Row& r) { return r.m.arias_intensity; }},
         {{"cav_m_s", "CAV", "m/s", 3}, [](const Row& r) { return r.m.cumulative_velocity; }},
         {{"duration_5_75_s", "D5-75", "s", 3}, [](const Row& r) { return r.m.duration_5_75; }},
         {{"duration_5_95_s", "D5-95", "s", 3}, [](const Row& r) { return r.m.duration_5_95; }},
         {{"mean_period_s", "Tm", "s", 3}, [](const Row& r) { return optional_cell(r.m.mean_period); }},
         {{"sha256", "sha256"}, [](const Row& r) { return r.record.source.sha256; }}},
        rows);
    for (const Record& r : records)
        for (const std::string& warning : r.warnings) table.notes.push_back(r.name + ": " + warning);
    table.notes.push_back("PGV and PGD start from rest and are not baseline-corrected; all but Tm are exact for the "
                          "piecewise-linear record.");
    return table;
}

Table without_checksums(Table table)
{
    table.columns.pop_back();
    for (auto& row : table.rows) row.pop_back();
    return table;
}

Table spectrum_table(const Record& record, const records::ResponseSpectrum& spectrum, double ratio)
{
    using P = records::SpectrumPoint;
    return table_of<P>(fmt::format("Response spectrum of {}, {} % damping", record.name, 100.0 * ratio),
                       {{{"period_s", "T", "s", 4}, &P::period},
                        {{"pseudo_acceleration_m_s2", "PSA", "m/s²", 4}, &P::pseudo_acceleration},
                        {{"absolute_acceleration_m_s2", "Sa", "m/s²", 4}, &P::absolute_acceleration},
                        {{"velocity_m_s", "Sv", "m/s", 4}, &P::velocity},
                        {{"displacement_m", "Sd", "m", 4}, &P::displacement}},
                       spectrum.points,
                       {"exact for the piecewise-linear record (Nigam & Jennings 1969), free vibration of one period "
                        "after its end included"});
}

} // namespace damslip::pages
