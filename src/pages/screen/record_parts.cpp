
#include "analysis/screen/variation.hpp"
#include "core/units.hpp"
#include "pages/scene/record_charts.hpp"
#include "pages/screen/screen_charts.hpp"
#include "records/transform/sequence.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::pages {

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
