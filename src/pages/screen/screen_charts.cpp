#include "pages/screen/screen_pages.hpp"

#include "analysis/screen/variation.hpp"
#include "core/statistics.hpp"
#include "core/status.hpp"
#include "core/units.hpp"
#include "pages/scene/scene_pages.hpp"
#include "records/transform/transform.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>

namespace damslip::pages {

namespace {

using units::mm;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t named_records = 6; ///< so many curves can be told apart

Axis slip_axis()
{
    return {"largest slip", "mm", Scale::asinh};
}

std::vector<std::vector<double>> in_mm(std::vector<std::vector<double>> slips)
{
    for (std::vector<double>& row : slips)
        for (double& slip : row) slip /= mm;
    return slips;
}

std::vector<double> column(const std::vector<std::vector<double>>& grid, std::size_t j)
{
    std::vector<double> out;
    for (const auto& row : grid) out.push_back(row[j]);
    return out;
}

bool is_finite(double value)
{
    return std::isfinite(value);
}

/// A statistic of each row; none for a row that is not complete.
template <class Statistic>
std::vector<double> row_statistic(const std::vector<std::vector<double>>& grid, Statistic&& statistic)
{
    std::vector<double> out;
    for (const auto& row : grid) {
        out.push_back(std::ranges::all_of(row, is_finite) ? statistic(row) : nothing);
    }
    return out;
}

void add_set_curves(Chart& chart, const std::vector<double>& x, const std::vector<std::vector<double>>& grid)
{
    const auto share = [](double q) { return [q](const std::vector<double>& row) { return percentile(row, q); }; };
    chart.curves = {{.name = "median, band 16 to 84 %",
                     .x = x,
                     .y = row_statistic(grid, share(0.5)),
                     .low = row_statistic(grid, share(0.16)),
                     .high = row_statistic(grid, share(0.84)),
                     .weight = Weight::strong,
                     .colour = 0},
                    {.name = "largest",
                     .x = x,
                     .y = row_statistic(grid, [](const auto& row) { return std::ranges::max(row); }),
                     .mark = Mark::dashed,
                     .colour = 1}};
}

/// For people [mm]; not a number where the slide has none.
double largest_slip(const sliding::SlideResult& slide)
{
    return reported(slide.status, slide.max_slip).value_or(nothing) / mm;
}

/// Of the flexible block, by the analysis that is judged.
Curve governing_by_record(const Screening& s)
{
    Curve curve{.name = "flexible, judged", .mark = Mark::points, .colour = 3};
    for (std::size_t i = 0; 2 * i + 1 < s.slips.size(); ++i)
        curve.add(static_cast<double>(i), largest_slip(worse_judged(s, i).judged()));
    return curve;
}

/// The larger one of both polarities, where both have one.
Curve elastic_by_record(const Screening& s, const std::vector<std::string>& records)
{
    Curve curve{.name = "finite elements", .mark = Mark::points, .colour = 2};
    for (std::size_t i = 0; i < records.size(); ++i) {
        double largest = 0.0;
        bool found = false;
        for (const ContactRun& run : s.elastic->runs) {
            if (run.record != records[i]) continue;
            const std::optional<double> slip = reported(run.fe.status, run.fe.max_slip);
            largest = slip ? std::max(largest, std::abs(*slip) / mm) : nothing;
            found = true;
            if (!slip) break;
        }
        curve.add(static_cast<double>(i), found ? largest : nothing);
    }
    return curve;
}

/// Whose slips a chart of this file shows.
std::string by_the_block(const Screening& s)
{
    return !s.slips.empty() && s.slips.front().of_dam ? " By the rigid block, no upper bound of an elastic dam." : "";
}

} // namespace

std::optional<Chart> slip_over_friction(const Scene& scene, const Screening& s,
                                        const std::vector<GroundMotion>& motions, int jobs)
{
    const std::optional<SlipVariation> found = slips_by_friction(scene, s, motions, jobs);
    if (!found) return std::nullopt;
    const RigidModel& own = s.bases.front().model;
    const std::vector<double>& friction = found->friction;
    const auto grid = in_mm(found->slip);
    Chart chart{"Slip over friction",
                {scene.wedge ? "friction μ of " + scene.wedge->planes.front().name : "friction μ", "–"},
                slip_axis()};
    if (motions.size() <= named_records)
        for (std::size_t j = 0; j < motions.size(); ++j)
            chart.curves.push_back({motions[j].name, friction, column(grid, j)});
    else
        add_set_curves(chart, friction, grid);
    chart.vertical.push_back({own.block.friction, "scene"});
    if (own.critical_friction > 0.6 * own.block.friction && std::isfinite(own.critical_friction)) {
        chart.vertical.push_back({own.critical_friction, "holds without earthquake"});
        chart.x.low = std::min(0.98 * own.critical_friction, friction.front());
    }
    if (scene.criteria.allowable_slip && !s.flexible)
        chart.horizontal.push_back({*scene.criteria.allowable_slip / mm, "allowable"});
    chart.note = "Worse polarity of each record, with the vertical component where it has one. Linear near zero, "
                 "logarithmic above.";
    if (s.flexible) chart.note += " The rigid block; the flexible one is judged by its own slip.";
    chart.note += by_the_block(s);
    if (scene.wedge) chart.note += " The friction of the other plane keeps its share of this one.";
    return chart;
}

Chart slip_by_record(const Screening& s, const std::optional<double>& allowable)
{
    Chart chart{"Largest slip of each record", {"record"}, slip_axis()};
    const bool both = s.elastic && !s.elastic->runs.empty();
    const std::string block = both ? "rigid block, " : "";
    Curve h{.name = block + "horizontal", .mark = Mark::points, .colour = 0};
    Curve hv{.name = block + "with vertical", .mark = Mark::points, .colour = 1};
    for (std::size_t i = 0; 2 * i + 1 < s.slips.size(); ++i) {
        chart.x.categories.push_back(s.slips[2 * i].record);
        h.add(static_cast<double>(i), largest_slip(worse_horizontal(s, i).horizontal));
        const SlipRow* row = worse_with_vertical(s, i);
        hv.add(static_cast<double>(i), row ? largest_slip(*row->with_vertical) : nothing);
    }
    chart.curves.push_back(std::move(h));
    if (std::ranges::any_of(hv.y, is_finite)) chart.curves.push_back(std::move(hv));
    if (s.flexible) chart.curves.push_back(governing_by_record(s));
    if (both) chart.curves.push_back(elastic_by_record(s, chart.x.categories));
    if (allowable) chart.horizontal.push_back({*allowable / mm, "allowable"});
    chart.note = "Worse polarity of each record." + (both ? "" : by_the_block(s));
    return chart;
}

Chart slip_over_ratio(const Screening& s)
{
    Chart chart{"Slip over a_y/PGA", {"a_y/PGA", "–"}, slip_axis()};
    const double a_y = s.bases.front().model.downstream.law.constant;
    std::vector<std::size_t> order(s.slips.size() / 2);
    std::iota(order.begin(), order.end(), 0u);
    std::erase_if(order, [&](std::size_t i) { return !(s.slips[2 * i].pga > 0); });
    std::ranges::stable_sort(order,
                             [&](std::size_t a, std::size_t b) { return s.slips[2 * a].pga > s.slips[2 * b].pga; });
    Curve h{.name = "horizontal", .mark = Mark::points, .colour = 0};
    Curve hv{.name = "with vertical", .mark = Mark::points, .colour = 1};
    for (const std::size_t i : order) {
        const double ratio = a_y / s.slips[2 * i].pga;
        h.add(ratio, largest_slip(worse_horizontal(s, i).horizontal));
        if (const SlipRow* row = worse_with_vertical(s, i)) hv.add(ratio, largest_slip(*row->with_vertical));
    }
    if (a_y < 0) // the ratio falls with the PGA's fall: back into ascending order
        for (Curve* c : {&h, &hv}) {
            std::ranges::reverse(c->x);
            std::ranges::reverse(c->y);
        }
    chart.curves.push_back(std::move(h));
    if (!hv.x.empty()) chart.curves.push_back(std::move(hv));
    chart.note = "One point for each record, worse polarity." + by_the_block(s);
    return chart;
}

namespace {

/// The regressions of record `number` with their bands beside its rigorous slip; nothing where none gives a slip.
std::optional<Chart> regressions_beside(const Screening& s, std::size_t number)
{
    Chart chart{"Regressions beside the rigid block", {"regression"}, {"slip", "mm", Scale::asinh}};
    Curve curve{.name = "regression, 16 to 84 %", .mark = Mark::points, .colour = 0};
    for (const RegressionRow& row : s.regressions) {
        if (row.record != s.slips[2 * number].record || !row.valid) continue;
        const double median = row.median.value_or(nothing); // no published sigma: no band
        curve.add(static_cast<double>(chart.x.categories.size()), median / mm, row.low.value_or(median) / mm,
                  row.high.value_or(median) / mm);
        chart.x.categories.push_back(row.model);
    }
    if (std::ranges::none_of(curve.y, [](double v) { return v > 0; })) return std::nullopt;
    const auto add_line = [&chart](const sliding::SlideResult& slide, const char* name) {
        if (reported(slide.status, slide.max_slip)) chart.horizontal.push_back({largest_slip(slide), name});
    };
    add_line(worse_horizontal(s, number).horizontal, "rigid block, horizontal");
    if (const SlipRow* row = worse_with_vertical(s, number))
        add_line(*row->with_vertical, "rigid block, with vertical");
    const auto zero = [](double v) { return v <= 0; };
    if (std::ranges::none_of(curve.low, zero) && std::ranges::none_of(chart.horizontal, zero, &Line::at))
        chart.y.scale = Scale::log;
    chart.curves.push_back(std::move(curve));
    chart.note = "Regressions take the horizontal component only; no point where a_y, record or magnitude lie outside "
                 "their data.";
    return chart;
}

/// A curve for each uplift model, the scene's own strong. @param own  the scene's value of x
Chart yield_chart(const Screening& s, const YieldVariation& found, const std::string& title, const Axis& x, double own)
{
    Chart chart{title, x, {"yield acceleration", "m/s²"}};
    chart.horizontal.push_back({0.0, "slides without an earthquake below"});
    if (s.largest_pga > 0) chart.horizontal.push_back({s.largest_pga, "largest PGA of the records"});
    chart.vertical.push_back({own, "scene"});
    for (const YieldVariation::Curve& c : found.curves)
        chart.curves.push_back({.name = c.uplift,
                                .x = found.at,
                                .y = c.yield,
                                .weight = chart.curves.empty() ? Weight::strong : Weight::normal});
    return chart;
}

} // namespace

Chart yield_over_friction(const Scene& scene, const Screening& s)
{
    return yield_chart(s, yields_by_friction(scene, s), "Yield acceleration over friction", {"friction μ", "–"},
                       s.bases.front().model.block.friction);
}

Chart yield_over_level(const Scene& scene, const Screening& s)
{
    Chart chart = yield_chart(s, yields_by_level(scene, s), "Yield acceleration over the water level",
                              {"reservoir level above the heel", "m"}, scene.reservoir->level);
    chart.note =
        fmt::format("Friction {:.4g}; added mass and uplift follow the level.", s.bases.front().model.block.friction);
    return chart;
}

namespace {

std::vector<double> sample_times(const GroundMotion& motion)
{
    std::vector<double> t(motion.accel_h.size());
    for (std::size_t i = 0; i < t.size(); ++i) t[i] = static_cast<double>(i) * motion.dt;
    return t;
}

/// The motion with the pauses of this slide.
GroundMotion played(const GroundMotion& motion, const sliding::SlideResult& slide)
{
    std::vector<double> starts;
    for (const EventSlip& event : slide.events) starts.push_back(event.start);
    return records::as_played(motion, starts);
}

constexpr int low_chart = 260; ///< of less weight than the slip [px]

Curve line(std::string name, std::vector<double> x, std::vector<double> y, int colour)
{
    return {.name = std::move(name), .x = std::move(x), .y = std::move(y), .colour = colour};
}

Chart acceleration_chart(const GroundMotion& motion)
{
    Chart chart = time_chart(motion.name + ": ground acceleration", {"acceleration", "m/s²"}, low_chart);
    chart.curves.push_back(line("horizontal, upstream", sample_times(motion), motion.accel_h, 0));
    if (!motion.accel_v.empty()) chart.curves.push_back(line("vertical, up", sample_times(motion), motion.accel_v, 1));
    return chart;
}

Curve slip_curve(const sliding::SlideHistory& history, const std::string& name, int colour)
{
    std::vector<double> slip = history.slip;
    for (double& v : slip) v /= units::mm;
    return line(name, history.time, std::move(slip), colour);
}

/// Ground acceleration of the run and what the block withstands at each instant; it starts to slide where they cross.
Chart demand_chart(const GroundMotion& motion, const sliding::SlideHistory& history, int polarity)
{
    Chart chart = time_chart(motion.name + ": yield acceleration with vertical motion", {"acceleration", "m/s²"});
    std::vector<double> demand = motion.accel_h;
    for (double& a : demand) a *= polarity;
    chart.curves.push_back(
        line(fmt::format("ground, polarity {:+d}", polarity), sample_times(motion), std::move(demand), 0));
    chart.curves.push_back(line("yield acceleration", history.time, history.yield, 6));
    // Beyond the record's end the ground rests: that part of the history says nothing here.
    Curve& yield = chart.curves.back();
    yield.x.resize(std::min(yield.x.size(), motion.accel_h.size()));
    yield.y.resize(yield.x.size());
    return chart;
}

void on_record_grid(const GroundMotion& motion, Curve& curve)
{
    const std::size_t n = std::min(curve.x.size(), motion.accel_h.size());
    for (std::size_t i = 0; i < n; ++i)
        if (std::abs(curve.x[i] - static_cast<double>(i) * motion.dt) < 1e-9 * motion.dt * static_cast<double>(n))
            curve.x[i] = static_cast<double>(i) * motion.dt;
}

/// Slip of the flexible block.
Chart flexible_chart(const Scene& scene, const Screening& s, const RecordHistories::Flexible& found,
                     const GroundMotion& motion, std::size_t number, std::size_t records)
{
    Chart chart = time_chart(fmt::format("{}: slip of the flexible block, polarity {:+d}", motion.name, found.polarity),
                             {"slip, downstream", "mm"});
    const auto& decoupled = found.slips.decoupled;
    const auto& coupled = found.slips.coupled;
    if (decoupled) chart.curves.push_back(slip_curve(decoupled->slide.history, "decoupled", 2));
    if (coupled) chart.curves.push_back(slip_curve(coupled->slide.history, "coupled", 3));
    const double judged = worse_judged(s, number).judged().max_slip;
    if (scene.criteria.allowable_slip && judged > 0.2 * *scene.criteria.allowable_slip)
        chart.horizontal.push_back({*scene.criteria.allowable_slip / units::mm, "allowable"});
    thin_for(chart, records);
    return chart;
}

/// Slip of the block that rocks.
Chart rocking_chart(const GroundMotion& motion, const RecordHistories::Rocking& found)
{
    Chart chart =
        time_chart(fmt::format("{}: block that rocks and slides, polarity {:+d}", motion.name, found.polarity),
                   {"slip, downstream", "mm"});
    chart.curves.push_back(slip_curve(found.motion.slide.history, "slip", 2));
    if (found.motion.slide.status == Status::overturned) chart.note = "It overturns.";
    return chart;
}

/// How far its heel and its toe are open.
Chart rotation_chart(const GroundMotion& motion, const RecordHistories::Rocking& found, double length)
{
    std::vector<double> heel, toe;
    for (const double rotation : found.motion.rotation) {
        heel.push_back(length * std::sin(std::max(0.0, rotation)) / units::mm);
        toe.push_back(length * std::sin(std::max(0.0, -rotation)) / units::mm);
    }
    const std::vector<double>& time = found.motion.slide.history.time;
    Chart chart = time_chart(motion.name + ": opening of the block that rocks", {"opening", "mm"}, low_chart);
    chart.curves.push_back(line("heel open", time, std::move(heel), 0));
    chart.curves.push_back(line("toe open", time, std::move(toe), 1));
    chart.note = "At the samples; shorter ones between them are in the table's largest values.";
    return chart;
}

/// What carries it: uplift and effective normal force over the weight.
Chart carried_chart(const GroundMotion& motion, const RecordHistories::Rocking& found, double weight)
{
    const auto share = [&](std::vector<double> force) {
        for (double& f : force) f /= weight;
        return force;
    };
    const sliding::SlideHistory& history = found.motion.slide.history;
    Chart chart =
        time_chart(motion.name + ": what carries the block that rocks", {"force over weight", "–"}, low_chart);
    chart.curves.push_back(line("uplift U", history.time, share(found.motion.uplift), 1));
    chart.curves.push_back(line("normal force N′", history.time, share(history.normal_force), 0));
    chart.note = "Uplift on heel or toe by uplift.opening; N′ jumps where a corner leaves the rock or comes down.";
    return chart;
}

/// A slide that has no slip is named instead.
void add_slip_curve(const sliding::SlideResult& slide, const std::string& name, int colour, Chart& chart)
{
    if (reported(slide.status, slide.max_slip))
        chart.curves.push_back(slip_curve(slide.history, name, colour));
    else
        chart.note += fmt::format("{}{}: {}.", chart.note.empty() ? "" : " ", name, word(slide.status));
}

} // namespace

std::vector<Part> record_parts(const Scene& scene, const Screening& s, const GroundMotion& motion, std::size_t number,
                               std::size_t records)
{
    const RecordHistories found = record_histories(scene, s, motion, number);
    const GroundMotion shown = played(motion, found.horizontal.slide);
    const std::string together = fmt::format("record{}", number + 1);
    std::vector<Part> parts;
    const auto add = [&](Chart chart) {
        if (chart.curves.empty()) {
            parts.emplace_back(Paragraph{chart.title + ": none. " + chart.note});
            return;
        }
        chart.together = together;
        for (Curve& curve : chart.curves) on_record_grid(shown, curve);
        thin_for(chart, records);
        parts.emplace_back(std::move(chart));
    };
    add(acceleration_chart(shown));

    Chart slip = time_chart(motion.name + ": slip", {scene.wedge ? "slip" : "slip, downstream", "mm"});
    const SlipRow& h = worse_horizontal(s, number);
    const sliding::SlideResult& horizontal = found.horizontal.slide;
    add_slip_curve(horizontal, fmt::format("horizontal, polarity {:+d}", h.polarity), 0, slip);
    if (scene.criteria.allowable_slip && !s.flexible && h.judged().max_slip > 0.2 * *scene.criteria.allowable_slip)
        slip.horizontal.push_back({*scene.criteria.allowable_slip / units::mm, "allowable"});
    const SlipRow* hv = worse_with_vertical(s, number);
    const bool still = h.horizontal.max_slip == 0.0 && (!hv || hv->with_vertical->max_slip == 0.0);
    if (still && is_answer(horizontal.status) && !fails_statically(horizontal.status))
        slip.note = fmt::format("The {} does not slide in this record.", sliding_body(scene));
    if (!hv) {
        add(std::move(slip));
    } else {
        const sliding::SlideResult& both = found.with_vertical->slide;
        add_slip_curve(both, fmt::format("with vertical, polarity {:+d}", hv->polarity), 1, slip);
        add(std::move(slip));
        add(demand_chart(played(motion, both), both.history, hv->polarity));
    }
    if (found.rocking) {
        const RigidModel& model = s.bases.front().model;
        add(rocking_chart(motion, *found.rocking));
        add(rotation_chart(motion, *found.rocking, model.length.value_or(0.0)));
        add(carried_chart(motion, *found.rocking, model.block.mass * model.block.gravity));
    }
    if (found.flexible) parts.emplace_back(flexible_chart(scene, s, *found.flexible, motion, number, records));
    if (auto regressions = regressions_beside(s, number)) {
        regressions->title = motion.name + ": " + regressions->title;
        parts.emplace_back(std::move(*regressions));
    }
    return parts;
}

} // namespace damslip::pages
