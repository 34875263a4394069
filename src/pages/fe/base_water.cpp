#include "pages/fe/base_water.hpp"

#include "scene/opening_water.hpp"
#include "scene/section.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <ranges>

namespace damslip::pages {

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

const ColumnOf<ContactRun> record_of_run{{"record", "record"}, &ContactRun::record};
const ColumnOf<ContactRun> polarity_of_run{{"polarity", "polarity"}, &ContactRun::polarity};

/// Rows of the history in which the joint's pressure stands, in MPa.
struct PressureRows {
    const fe2d::RunHistory& history;
    std::size_t pairs;

    double sum(std::size_t row) const
    {
        const auto from = history.joint_pressure.begin() + static_cast<std::ptrdiff_t>(row * pairs);
        return std::accumulate(from, from + static_cast<std::ptrdiff_t>(pairs), 0.0);
    }
    std::vector<double> at(std::size_t row) const
    {
        std::vector<double> values;
        for (std::size_t i = 0; i < pairs; ++i)
            values.push_back(1e-6 * static_cast<double>(history.joint_pressure[row * pairs + i]));
        return values;
    }
};

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

std::optional<Chart> base_water_chart(const RunView& view)
{
    const fe2d::RunResult& fe = view.run.fe;
    const fe2d::RunHistory& h = fe.history;
    if (!fe.base_water || h.joint_pressure.empty()) return std::nullopt;
    const PressureRows rows{h, static_cast<std::size_t>(fe.pair_distance.size())};
    const std::vector<double> distance(fe.pair_distance.begin(), fe.pair_distance.end());
    Chart chart;
    chart.title = view.run.label() + ": water pressure in the joint";
    chart.x = {"distance from the heel", "m"};
    chart.y = {"water pressure", "MPa"};
    chart.together = view.together + "base";
    const auto add = [&](const std::string& name, std::size_t row, int colour, Weight weight) {
        chart.curves.push_back({name, distance, rows.at(row), {}, {}, Mark::line, weight, colour});
    };
    std::size_t least = 0, most = 0;
    for (std::size_t row = 1; row < h.time.size(); ++row) {
        if (rows.sum(row) < rows.sum(least)) least = row;
        if (rows.sum(row) > rows.sum(most)) most = row;
    }
    const auto longest = static_cast<std::size_t>(std::max_element(h.crack_length.begin(), h.crack_length.end()) -
                                                  h.crack_length.begin());
    add("before the earthquake", 0, 7, Weight::normal);
    add(fmt::format("longest crack, {:.3g} m at {:.4g} s", h.crack_length[longest], h.time[longest]), longest, 1,
        Weight::normal);
    if (most != longest && most != 0)
        add(fmt::format("largest uplift, {:.4g} s", h.time[most]), most, 3, Weight::normal);
    if (least != longest && least != 0)
        add(fmt::format("least uplift, {:.4g} s", h.time[least]), least, 2, Weight::normal);

    Moving moving;
    moving.label = "time";
    moving.unit = "s";
    const std::size_t every = std::max<std::size_t>(1, h.time.size() / std::max<std::size_t>(20, 150 / view.records));
    for (std::size_t row = 0; row < h.time.size(); ++row) {
        if (row % every && row != longest) continue;
        if (row == longest) moving.start = moving.at.size();
        moving.at.push_back(h.time[row]);
        moving.y.push_back(rows.at(row));
    }
    moving.curve = chart.curves.size();
    add("at the slider's time", longest, 0, Weight::strong);
    const auto [low, high] = std::minmax_element(h.joint_pressure.begin(), h.joint_pressure.end());
    const double bottom = std::min(0.0, 1e-6 * static_cast<double>(*low)), top = 1e-6 * static_cast<double>(*high);
    chart.y.low = bottom - 0.04 * (top - bottom);
    chart.y.high = top + 0.04 * (top - bottom);
    chart.moving = std::move(moving);
    chart.note = "Against the atmosphere, mean over the length that belongs to each contact pair.";
    return chart;
}

} // namespace damslip::pages
