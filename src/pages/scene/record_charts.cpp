#include "pages/scene/record_charts.hpp"

#include "core/parallel.hpp"
#include "core/statistics.hpp"
#include "core/units.hpp"
#include "records/measure/measures.hpp"
#include "records/measure/response_spectrum.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::pages {

namespace {

constexpr std::size_t named_records = 6;

Record horizontal_record(const GroundMotion& motion)
{
    Record r;
    r.name = motion.name;
    r.dt = motion.dt;
    r.acceleration = motion.accel_h;
    return r;
}

double peak(const std::vector<double>& a)
{
    double p = 0.0;
    for (const double x : a) p = std::max(p, std::abs(x));
    return p;
}

} // namespace

void thin_for(Chart& chart, std::size_t records)
{
    chart.thin_above = std::clamp<std::size_t>(80000 / std::max<std::size_t>(records, 1), 800, 20000);
    chart.thin_buckets = chart.thin_above / (2 * std::max<std::size_t>(chart.curves.size(), 1));
}

Chart spectra(const std::vector<GroundMotion>& motions, int jobs)
{
    const std::vector<double> periods = records::logarithmic_periods(0.03, 4.0, 48);
    std::vector<std::vector<double>> psa(motions.size(), std::vector<double>(periods.size()));
    // One task per record and period: long and short records share the threads evenly.
    parallel_for(motions.size() * periods.size(), jobs, [&](std::size_t task) {
        const std::size_t i = task / periods.size(), k = task % periods.size();
        const auto spectrum =
            records::response_spectrum(motions[i].accel_h, motions[i].dt, std::span(&periods[k], 1), 0.05);
        psa[i][k] = spectrum.points.front().pseudo_acceleration;
    });
    Chart chart;
    chart.title = "Response spectra, 5 % damping, horizontal";
    chart.x = {"period", "s", Scale::log};
    chart.y = {"pseudo-acceleration", "m/s²", Scale::linear, 0.1, 0.0, {}, {}};
    const bool named = motions.size() <= named_records;
    for (std::size_t i = 0; i < motions.size(); ++i)
        chart.curves.push_back({motions[i].name,
                                periods,
                                psa[i],
                                {},
                                {},
                                Mark::line,
                                named ? Weight::normal : Weight::faint,
                                named ? static_cast<int>(i) : 7});
    if (named) return chart;
    Curve median{"median, band 16 to 84 %", periods, {}, {}, {}, Mark::line, Weight::strong, 0};
    for (std::size_t k = 0; k < periods.size(); ++k) {
        std::vector<double> values;
        for (const auto& row : psa) values.push_back(row[k]);
        median.y.push_back(percentile(values, 0.5));
        median.low.push_back(percentile(values, 0.16));
        median.high.push_back(percentile(values, 0.84));
    }
    chart.curves.push_back(std::move(median));
    return chart;
}

Table record_table(const std::vector<GroundMotion>& motions)
{
    struct Row {
        const GroundMotion& motion;
        records::Measures m;
    };
    std::vector<Row> rows;
    for (const GroundMotion& motion : motions) rows.push_back({motion, records::measure(horizontal_record(motion))});
    const auto vertical_peak = [](const Row& r) {
        return r.motion.accel_v.empty() ? Cell() : Cell(peak(r.motion.accel_v));
    };
    return table_of<Row>(
        "Records as scaled",
        {{{"record", "record"}, [](const Row& r) { return r.motion.name; }},
         {{"duration_s", "duration", "s", 4}, [](const Row& r) { return r.m.duration; }},
         {{"pga_m_s2", "PGA", "m/s²", 4}, [](const Row& r) { return r.m.pga; }},
         {{"pga_vertical_m_s2", "PGA vertical", "m/s²", 4}, vertical_peak},
         {{"pgv_m_s", "PGV", "m/s", 4}, [](const Row& r) { return r.m.pgv; }},
         {{"arias_intensity_m_s", "Arias intensity", "m/s", 4}, [](const Row& r) { return r.m.arias_intensity; }},
         {{"duration_5_95_s", "D5-95", "s", 4}, [](const Row& r) { return r.m.duration_5_95; }},
         {{"mean_period_s", "mean period", "s", 4}, [](const Row& r) { return optional_cell(r.m.mean_period); }}},
        rows);
}

} // namespace damslip::pages
