#include "pages/screen/screen_pages.hpp"

#include "analysis/screen/variation.hpp"
#include "core/statistics.hpp"
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

/// A statistic of each row; none for a row that is not complete.
template <class Statistic>
std::vector<double> row_statistic(const std::vector<std::vector<double>>& grid, Statistic&& statistic)
{
    std::vector<double> out;
    for (const auto& row : grid) {
        const bool whole = std::all_of(row.begin(), row.end(), [](double v) { return std::isfinite(v); });
        out.push_back(whole ? statistic(row) : nothing);
    }
    return out;
}

void add_set_curves(Chart& chart, const std::vector<double>& x, const std::vector<std::vector<double>>& grid)
{
    const auto share = [](double q) { return [q](const std::vector<double>& row) { return percentile(row, q); }; };
    Curve median{"median, band 16 to 84 %",
                 x,
                 row_statistic(grid, share(0.5)),
                 row_statistic(grid, share(0.16)),
                 row_statistic(grid, share(0.84)),
                 Mark::line,
                 Weight::strong,
                 0};
    Curve largest{"largest",
                  x,
                  row_statistic(grid, [](const auto& row) { return *std::max_element(row.begin(), row.end()); }),
                  {},
                  {},
                  Mark::dashed,
                  Weight::normal,
                  1};
    chart.curves = {std::move(median), std::move(largest)};
}

/// For people [mm]; not a number where the slide has none.
double largest_slip(const sliding::SlideResult& slide)
{
    return reported(slide.status, slide.max_slip).value_or(nothing) / mm;
}

/// Of the flexible block, by the analysis that is judged.
Curve governing_by_record(const Screening& s)
{
    Curve curve{"flexible, judged", {}, {}, {}, {}, Mark::points, Weight::normal, 3};
    for (std::size_t i = 0; 2 * i + 1 < s.slips.size(); ++i) {
        curve.x.push_back(static_cast<double>(i));
        curve.y.push_back(largest_slip(worse_judged(s, i).judged()));
    }
    return curve;
}

/// The larger one of both polarities, where both have one.
Curve elastic_by_record(const Screening& s, const std::vector<std::string>& records)
{
    Curve curve{"finite elements", {}, {}, {}, {}, Mark::points, Weight::normal, 2};
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
        curve.x.push_back(static_cast<double>(i));
        curve.y.push_back(found ? largest : nothing);
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
    Chart chart;
    chart.title = "Slip over friction";
    chart.x = {scene.wedge ? "friction μ of " + scene.wedge->planes.front().name : "friction μ", "–"};
    chart.y = slip_axis();
    if (motions.size() <= named_records)
        for (std::size_t j = 0; j < motions.size(); ++j)
            chart.curves.push_back(
                {motions[j].name, friction, column(grid, j), {}, {}, Mark::line, Weight::normal, -1});
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
    Chart chart;
    chart.title = "Largest slip of each record";
    chart.x.label = "record";
    chart.y = slip_axis();
    const bool both = s.elastic && !s.elastic->runs.empty();
    const std::string block = both ? "rigid block, " : "";
    Curve h{block + "horizontal", {}, {}, {}, {}, Mark::points, Weight::normal, 0};
    Curve hv{block + "with vertical", {}, {}, {}, {}, Mark::points, Weight::normal, 1};
    for (std::size_t i = 0; 2 * i + 1 < s.slips.size(); ++i) {
        chart.x.categories.push_back(s.slips[2 * i].record);
        h.x.push_back(static_cast<double>(i));
        h.y.push_back(largest_slip(worse_horizontal(s, i).horizontal));
        const SlipRow* row = worse_with_vertical(s, i);
        hv.x.push_back(static_cast<double>(i));
        hv.y.push_back(row ? largest_slip(*row->with_vertical) : nothing);
    }
    chart.curves.push_back(std::move(h));
    if (std::any_of(hv.y.begin(), hv.y.end(), [](double v) { return std::isfinite(v); }))
        chart.curves.push_back(std::move(hv));
    if (s.flexible) chart.curves.push_back(governing_by_record(s));
    if (both) chart.curves.push_back(elastic_by_record(s, chart.x.categories));
    if (allowable) chart.horizontal.push_back({*allowable / mm, "allowable"});
    chart.note = "Worse polarity of each record." + (both ? "" : by_the_block(s));
    return chart;
}

Chart slip_over_ratio(const Screening& s)
{
    Chart chart;
    chart.title = "Slip over a_y/PGA";
    chart.x = {"a_y/PGA", "–"};
    chart.y = slip_axis();
    const double a_y = s.bases.front().model.downstream.law.constant;
    std::vector<std::size_t> order(s.slips.size() / 2);
    std::iota(order.begin(), order.end(), 0u);
    std::erase_if(order, [&](std::size_t i) { return !(s.slips[2 * i].pga > 0); });
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return s.slips[2 * a].pga > s.slips[2 * b].pga; });
    Curve h{"horizontal", {}, {}, {}, {}, Mark::points, Weight::normal, 0};
    Curve hv{"with vertical", {}, {}, {}, {}, Mark::points, Weight::normal, 1};
    for (const std::size_t i : order) {
        const double ratio = a_y / s.slips[2 * i].pga;
        h.x.push_back(ratio);
        h.y.push_back(largest_slip(worse_horizontal(s, i).horizontal));
        if (const SlipRow* row = worse_with_vertical(s, i)) {
            hv.x.push_back(ratio);
            hv.y.push_back(largest_slip(*row->with_vertical));
        }
    }
    if (a_y < 0) // the ratio falls with the PGA's fall: back into ascending order
        for (Curve* c : {&h, &hv}) {
            std::reverse(c->x.begin(), c->x.end());
            std::reverse(c->y.begin(), c->y.end());
        }
    chart.curves.push_back(std::move(h));
    if (!hv.x.empty()) chart.curves.push_back(std::move(hv));
    chart.note = "One point for each record, worse polarity." + by_the_block(s);
    return chart;
}

std::optional<Chart> regressions_beside(const Screening& s, std::size_t number)
{
    Chart chart;
    chart.title = "Regressions beside the rigid block";
    chart.x.label = "regression";
    chart.y = {"slip", "mm", Scale::asinh};
    Curve curve{"regression, 16 to 84 %", {}, {}, {}, {}, Mark::points, Weight::normal, 0};
    for (const RegressionRow& row : s.regressions) {
        if (row.record != s.slips[2 * number].record || !row.valid) continue;
        curve.x.push_back(static_cast<double>(chart.x.categories.size()));
        chart.x.categories.push_back(row.model);
        curve.y.push_back(row.median.value_or(nothing) / mm);
        curve.low.push_back(row.low.value_or(row.median.value_or(nothing)) / mm); // no published sigma: no band
        curve.high.push_back(row.high.value_or(row.median.value_or(nothing)) / mm);
    }
    if (std::none_of(curve.y.begin(), curve.y.end(), [](double v) { return v > 0; })) return std::nullopt;
    const auto add_line = [&chart](const sliding::SlideResult& slide, const char* name) {
        if (reported(slide.status, slide.max_slip)) chart.horizontal.push_back({largest_slip(slide), name});
    };
    add_line(worse_horizontal(s, number).horizontal, "rigid block, horizontal");
    if (const SlipRow* row = worse_with_vertical(s, number))
        add_line(*row->with_vertical, "rigid block, with vertical");
    const bool any_zero =
        std::any_of(curve.low.begin(), curve.low.end(), [](double v) { return v <= 0; }) ||
        std::any_of(chart.horizontal.begin(), chart.horizontal.end(), [](const Line& line) { return line.at <= 0; });
    if (!any_zero) chart.y.scale = Scale::log;
    chart.curves.push_back(std::move(curve));
    chart.note = "Regressions take the horizontal component only; no point where a_y, record or magnitude lie outside "
                 "their data.";
    return chart;
}

namespace {

/// A curve for each uplift model, the scene's own strong.
Chart yield_chart(const Screening& s, const YieldVariation& found)
{
    Chart chart;
    chart.y = {"yield acceleration", "m/s²"};
    chart.horizontal.push_back({0.0, "slides without an earthquake below"});
    if (s.largest_pga > 0) chart.horizontal.push_back({s.largest_pga, "largest PGA of the records"});
    for (const YieldVariation::Curve& c : found.curves) {
        const Weight weight = chart.curves.empty() ? Weight::strong : Weight::normal;
        chart.curves.push_back({c.uplift, found.at, c.yield, {}, {}, Mark::line, weight, -1});
    }
    return chart;
}

} // namespace

Chart yield_over_friction(const Scene& scene, const Screening& s)
{
    Chart chart = yield_chart(s, yields_by_friction(scene, s));
    chart.title = "Yield acceleration over friction";
    chart.x = {"friction μ", "–"};
    chart.vertical.push_back({s.bases.front().model.block.friction, "scene"});
    return chart;
}

Chart yield_over_level(const Scene& scene, const Screening& s)
{
    Chart chart = yield_chart(s, yields_by_level(scene, s));
    chart.title = "Yield acceleration over the water level";
    chart.x = {"reservoir level above the heel", "m"};
    chart.vertical.push_back({scene.reservoir->level, "scene"});
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

Axis time_axis()
{
    return {"time", "s"};
}

Curve line(std::string name, std::vector<double> x, std::vector<double> y, int colour)
{
    return {std::move(name), std::move(x), std::move(y), {}, {}, Mark::line, Weight::normal, colour};
}

Chart acceleration_chart(const GroundMotion& motion)
{
    Chart chart;
    chart.title = motion.name + ": ground acceleration";
    chart.x = time_axis();
    chart.y = {"acceleration", "m/s²"};
    chart.height = 260;
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
    Chart chart;
    chart.title = motion.name + ": yield acceleration with vertical motion";
    chart.x = time_axis();
    chart.y = {"acceleration", "m/s²"};
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
    Chart chart;
    chart.title = motion.name + fmt::format(": slip of the flexible block, polarity {:+d}", found.polarity);
    chart.x = time_axis();
    chart.y = {"slip, downstream", "mm"};
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
    Chart chart;
    chart.title = motion.name + fmt::format(": block that rocks and slides, polarity {:+d}", found.polarity);
    chart.x = time_axis();
    chart.y = {"slip, downstream", "mm"};
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
    Chart chart;
    chart.title = motion.name + ": opening of the block that rocks";
    chart.x = time_axis();
    chart.y = {"opening", "mm"};
    chart.height = 260;
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
    Chart chart;
    chart.title = motion.name + ": what carries the block that rocks";
    chart.x = time_axis();
    chart.y = {"force over weight", "–"};
    chart.height = 260;
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

    Chart slip;
    slip.title = motion.name + ": slip";
    slip.x = time_axis();
    slip.y = {scene.wedge ? "slip" : "slip, downstream", "mm"};
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
