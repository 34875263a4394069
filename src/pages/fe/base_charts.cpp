#include "pages/fe/fe_charts.hpp"

#include "scene/joint_bond.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace damslip::pages {

namespace {

constexpr std::size_t largest_instants = 150; ///< of one record alone

/// Values of the pairs at one row of the history, in MPa.
std::vector<double> row_values(const fe2d::PairHistory& pairs, const std::vector<float>& values, std::size_t row)
{
    std::vector<double> out;
    for (Eigen::Index i = 0; i < pairs.pairs; ++i) out.push_back(1e-6 * static_cast<double>(values[pairs.at(row, i)]));
    return out;
}

/// Every k-th row, the last one and the one of interest.
std::vector<std::size_t> shown_rows(std::size_t rows, std::size_t largest, std::optional<std::size_t> also)
{
    const std::size_t every = std::max<std::size_t>(1, (rows + largest - 1) / largest);
    std::vector<std::size_t> list;
    for (std::size_t row = 0; row < rows; ++row)
        if (row % every == 0 || row + 1 == rows || row == also) list.push_back(row);
    return list;
}

Chart chart_of(const RunView& view, const std::string& what, const std::vector<float>& values)
{
    const fe2d::RunResult& fe = view.run.fe;
    const fe2d::RunHistory& h = fe.history;
    const std::vector<double> distance(fe.pair_distance.begin(), fe.pair_distance.end());
    Chart chart;
    chart.title = view.run.label() + ": " + what + " along the base";
    chart.x = {"distance from the heel", "m"};
    chart.y = {what.substr(0, what.find(',')), "MPa"}; // the title has the rest
    chart.together = view.together + "base";
    const auto add = [&](const std::string& name, std::size_t row, int colour, Mark mark, Weight weight) {
        chart.curves.push_back({name, distance, row_values(h.by_pair, values, row), {}, {}, mark, weight, colour});
    };
    const std::optional<std::size_t> fastest = fastest_row(h);
    add("start", 0, 7, Mark::line, Weight::normal);
    if (fastest)
        add(fmt::format("largest slip rate, {:.4g} s", h.time[*fastest]), *fastest, 1, Mark::line, Weight::normal);
    add(fmt::format("end, {:.4g} s", h.time.back()), h.time.size() - 1, 2, Mark::line, Weight::normal);

    Moving moving;
    moving.label = "time";
    moving.unit = "s";
    const std::size_t largest = std::max<std::size_t>(20, largest_instants / view.records);
    for (const std::size_t row : shown_rows(h.time.size(), largest, fastest)) {
        if (row == fastest.value_or(0)) moving.start = moving.at.size();
        moving.at.push_back(h.time[row]);
        moving.y.push_back(row_values(h.by_pair, values, row));
    }
    moving.curve = chart.curves.size();
    add("at the slider's time", fastest.value_or(0), 0, Mark::line, Weight::strong);
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const double bottom = std::min(0.0, 1e-6 * static_cast<double>(*low)), top = 1e-6 * static_cast<double>(*high);
    chart.y.low = bottom - 0.04 * (top - bottom);
    chart.y.high = top + 0.04 * (top - bottom);
    chart.moving = std::move(moving);
    return chart;
}

char letter_of(fe2d::ContactState state)
{
    switch (state) {
    case fe2d::ContactState::stick:
        return 's';
    case fe2d::ContactState::slip_upstream:
        return 'u';
    case fe2d::ContactState::slip_downstream:
        return 'd';
    case fe2d::ContactState::open:
        return 'o';
    case fe2d::ContactState::pulled:
        return 'p';
    }
    return 's';
}

} // namespace

std::vector<Chart> base_charts(const RunView& view)
{
    const fe2d::PairHistory& pairs = view.run.fe.history.by_pair;
    std::vector<Chart> charts{chart_of(view, "effective pressure", pairs.pressure),
                              chart_of(view, "shear, resisting downstream slip", pairs.shear)};
    charts[0].note =
        "Effective pressure, compression positive: water in the joint is not part of it. The slider moves both "
        "charts.";
    return charts;
}

std::optional<Chart> bond_chart(const RunView& view, const Scene& scene)
{
    const fe2d::RunResult& fe = view.run.fe;
    const auto damage = fe.state.laws.find("bond_damage");
    if (damage == fe.state.laws.end() || !breaks_by_energy(scene.contact)) return std::nullopt;
    const std::vector<double> distance(fe.pair_distance.begin(), fe.pair_distance.end());
    const std::vector<double>& all = damage->second; // the base's pairs first
    if (all.size() < distance.size()) return std::nullopt;
    const std::vector<double> values(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(distance.size()));
    double broken = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (values[i] >= 1.0) broken += fe.pair_area[static_cast<Eigen::Index>(i)];
    Chart chart;
    chart.title = view.run.label() + ": bond along the base";
    chart.x = {"distance from the heel", "m"};
    chart.y = {"damage κ", "–"};
    chart.y.low = 0.0;
    chart.y.high = 1.05;
    chart.height = 240;
    chart.together = view.together + "base";
    chart.curves.push_back({"at the end", distance, values, {}, {}, Mark::line, Weight::strong, 1});
    chart.note = fmt::format("0: intact, 1: broken for good. At the end {:.3g} m of {:.3g} m are broken.", broken,
                             fe.pair_area.sum());
    return chart;
}

StateMap base_states(const RunView& view)
{
    const fe2d::RunResult& fe = view.run.fe;
    const fe2d::PairHistory& pairs = fe.history.by_pair;
    StateMap map;
    map.title = view.run.label() + ": where the base sticks, slips and opens";
    map.time = fe.history.time;
    map.distance.assign(fe.pair_distance.begin(), fe.pair_distance.end());
    map.place = "from the heel";
    map.kinds = {{'s', "sticks", -1}, {'u', "slips upstream", 2}, {'d', "slips downstream", 1}, {'o', "open", 0}};
    if (std::find(pairs.state.begin(), pairs.state.end(), fe2d::ContactState::pulled) != pairs.state.end())
        map.kinds.push_back({'p', "pulled (the joint may not open)", 3});
    for (std::size_t row = 0; row < map.time.size(); ++row) {
        std::string letters;
        for (Eigen::Index i = 0; i < pairs.pairs; ++i) letters += letter_of(pairs.state[pairs.at(row, i)]);
        map.states.push_back(std::move(letters));
    }
    map.note =
        "Each cell is a contact pair at an instant of the record; where several share a pixel, open counts before "
        "slip, slip before stick.";
    return map;
}

} // namespace damslip::pages
