#include "pages/record/record_tables.hpp"

#include "core/units.hpp"
#include "records/measure/measures.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace damslip::pages {

Table record_info_table(const std::vector<Record>& records, Checksums checksums)
{
    struct Row {
        const Record& record;
        records::Measures m;
    };
    std::vector<Row> rows;
    for (const Record& r : records) rows.push_back({r, records::measure(r)});
    std::vector<ColumnOf<Row>> columns{
        {in_brief({"name", "name"}), [](const Row& r) { return r.record.name; }},
        {{"format", "format"}, [](const Row& r) { return r.record.source.format; }},
        {{"unit", "unit"}, [](const Row& r) { return r.record.source.unit; }},
        {in_brief({"component", "component"}), [](const Row& r) { return r.record.source.component; }},
        {in_brief({"samples", "samples", "–", 4}), [](const Row& r) { return r.record.acceleration.size(); }},
        {in_brief({"dt_s", "dt", "s", 4}), [](const Row& r) { return r.record.dt; }},
        {in_brief({"duration_s", "duration", "s", 4}), [](const Row& r) { return r.m.duration; }},
        {ranking({"pga_m_s2", "PGA", "m/s²", 4}), [](const Row& r) { return r.m.pga; }},
        {{"pga_g", "PGA", "g", 3}, [](const Row& r) { return r.m.pga / units::standard_gravity; }},
        {in_brief({"pgv_m_s", "PGV", "m/s", 3}), [](const Row& r) { return r.m.pgv; }},
        {{"pgd_m", "PGD", "m", 3}, [](const Row& r) { return r.m.pgd; }},
        {in_brief({"arias_intensity_m_s", "Arias", "m/s", 3}), [](const Row& r) { return r.m.arias_intensity; }},
        {{"cav_m_s", "CAV", "m/s", 3}, [](const Row& r) { return r.m.cumulative_velocity; }},
        {{"duration_5_75_s", "D5-75", "s", 3}, [](const Row& r) { return r.m.duration_5_75; }},
        {in_brief({"duration_5_95_s", "D5-95", "s", 3}), [](const Row& r) { return r.m.duration_5_95; }},
        {in_brief({"mean_period_s", "Tm", "s", 3}), [](const Row& r) { return r.m.mean_period; }}};
    if (checksums == Checksums::shown)
        columns.push_back({{"sha256", "sha256"}, [](const Row& r) { return r.record.source.sha256; }});
    Table table = table_of("Accelerograms", columns, rows);
    for (const Record& r : records)
        for (const std::string& warning : r.warnings) table.notes.push_back(r.name + ": " + warning);
    table.notes.push_back("PGV and PGD start from rest and are not baseline-corrected; all but Tm are exact for the "
                          "piecewise-linear record.");
    return table;
}

Table spectrum_table(const Record& record, const records::ResponseSpectrum& spectrum, double ratio)
{
    using P = records::SpectrumPoint;
    return table_of<P>(fmt::format("Response spectrum of {}, {} % damping", record.name, 100.0 * ratio),
                       {{in_brief({"period_s", "T", "s", 4}), &P::period},
                        {ranking({"pseudo_acceleration_m_s2", "PSA", "m/s²", 4}), &P::pseudo_acceleration},
                        {in_brief({"absolute_acceleration_m_s2", "Sa", "m/s²", 4}), &P::absolute_acceleration},
                        {in_brief({"velocity_m_s", "Sv", "m/s", 4}), &P::velocity},
                        {{"displacement_m", "Sd", "m", 4}, &P::displacement}},
                       spectrum.points,
                       {"exact for the piecewise-linear record (Nigam & Jennings 1969), free vibration of one period "
                        "after its end included"});
}

namespace {

/// A measured record times a factor; I_A grows with its square.
struct SuiteMeasured {
    const SuiteRow& row;
    double factor = 1.0, misfit = 0.0;
};

/// @param scaled  with factor and misfit
std::vector<ColumnOf<SuiteMeasured>> suite_columns(bool scaled)
{
    using M = SuiteMeasured;
    std::vector<ColumnOf<M>> columns{
        {in_brief({"name", "record"}), [](const M& m) { return m.row.name; }},
        {in_brief({"event", "event"}), [](const M& m) { return m.row.event; }},
        {ranking({"pga_m_s2", "PGA", "m/s²", 4}), [](const M& m) { return m.factor * m.row.measures.pga; }},
        {in_brief({"pgv_m_s", "PGV", "m/s", 3}), [](const M& m) { return m.factor * m.row.measures.pgv; }},
        {in_brief({"arias_intensity_m_s", "Arias", "m/s", 3}),
         [](const M& m) { return m.factor * m.factor * m.row.measures.arias_intensity; }},
        {{"cav_m_s", "CAV", "m/s", 3}, [](const M& m) { return m.factor * m.row.measures.cumulative_velocity; }},
        {in_brief({"duration_5_95_s", "D5-95", "s", 3}), [](const M& m) { return m.row.measures.duration_5_95; }},
        {in_brief({"mean_period_s", "Tm", "s", 3}), [](const M& m) { return m.row.measures.mean_period; }}};
    if (scaled)
        columns.insert(columns.begin() + 2, {{in_brief({"factor", "factor", "–", 4}), &M::factor},
                                             {in_brief({"misfit", "misfit", "–", 3}), &M::misfit}});
    return columns;
}

} // namespace

Table suite_index_table(const std::vector<SuiteRow>& rows)
{
    std::vector<SuiteMeasured> items;
    for (const SuiteRow& row : rows) items.push_back({row});
    return table_of("Records", suite_columns(false), items, {"Horizontal components as they are in their files."});
}

Table suite_selection_table(const std::vector<SuiteRow>& rows, const records::SuiteSelection& selection)
{
    std::vector<SuiteMeasured> items;
    for (const records::ChosenRecord& c : selection.chosen) items.push_back({rows[c.record], c.factor, c.misfit});
    Table table = table_of(
        "Selected", suite_columns(true), items,
        {fmt::format("misfit: root mean square of ln(factor Sa / target); of the geometric mean {:.3f}, of the records "
                     "{:.3f}. {}",
                     selection.mean_misfit, selection.single_misfit,
                     selection.exhaustive ? "All sets were tried." : "Found step by step, with exchanges."),
         "Measures are those of the scaled records; the vertical component has the same factor."});
    for (const records::ChosenRecord& c : selection.chosen)
        if (c.at_limit)
            table.notes.push_back(fmt::format("{}: its factor {:.4g} is the largest or smallest allowed.",
                                              rows[c.record].name, c.factor));
    return table;
}

Table suite_spectrum_table(std::span<const double> periods, std::span<const double> target,
                           const std::vector<std::vector<double>>& spectra, const records::SuiteSelection& selection)
{
    struct Row {
        double period, target, mean, low, high;
    };
    constexpr std::size_t most_rows = 12;
    std::vector<Row> rows;
    const std::size_t last = periods.size() - 1, n = std::min(most_rows, periods.size());
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t k = n > 1 ? i * last / (n - 1) : 0;
        double sum = 0.0, low = std::numeric_limits<double>::infinity(), high = 0.0;
        for (const records::ChosenRecord& c : selection.chosen) {
            const double value = c.factor * spectra[c.record][k];
            sum += std::log(value);
            low = std::min(low, value);
            high = std::max(high, value);
        }
        rows.push_back(
            {periods[k], target[k], std::exp(sum / static_cast<double>(selection.chosen.size())), low, high});
    }
    return table_of<Row>(
        "Spectra, 5 %",
        {{in_brief({"period_s", "T", "s", 3}), &Row::period},
         {in_brief({"target_m_s2", "target", "m/s²", 4}), &Row::target},
         {in_brief({"mean_m_s2", "geometric mean", "m/s²", 4}), &Row::mean},
         {in_brief({"mean_over_target", "mean/target", "–", 3}), [](const Row& r) { return r.mean / r.target; }},
         {{"smallest_m_s2", "smallest", "m/s²", 4}, &Row::low},
         {{"largest_m_s2", "largest", "m/s²", 4}, &Row::high}},
        rows);
}

} // namespace damslip::pages
