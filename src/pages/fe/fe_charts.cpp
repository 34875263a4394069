#include "pages/fe/fe_pages.hpp"

#include "core/units.hpp"
#include "scene/joint_bond.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <ranges>

namespace damslip::pages {

namespace {

using units::mm;

/// Times as multiples of the history's own step, so that all curves share one list.
std::vector<double> even_times(const std::vector<double>& time)
{
    if (time.size() < 2) return time;
    const double step = time[1] - time[0];
    std::vector<double> even = time;
    for (std::size_t i = 0; i < even.size(); ++i) {
        const double k = static_cast<double>(i);
        if (std::abs(even[i] - k * step) < 1e-6 * step) even[i] = k * step;
    }
    return even;
}

std::vector<double> scaled(std::vector<double> values, double unit)
{
    for (double& v : values) v /= unit;
    return values;
}

/// Makes the charts of one run.
class Charts {
public:
    explicit Charts(const RunView& view)
        : view_(view), h_(view.run.fe.history), time_(even_times(view.run.fe.history.time))
    {
    }

    Chart ground() const
    {
        Chart chart = empty("ground acceleration", "acceleration", "m/s²", 240);
        add(chart, "horizontal, upstream", h_.ground_h, 1.0, 0);
        if (std::any_of(h_.ground_v.begin(), h_.ground_v.end(), [](double a) { return a != 0.0; }))
            add(chart, "vertical, up", h_.ground_v, 1.0, 1);
        return chart;
    }

    Chart slip() const
    {
        Chart chart = empty("slip", "slip, downstream", "mm", 360);
        add(chart, "FE, heel", h_.slip_heel, mm, 2);
        add(chart, "FE, middle", h_.slip_middle, mm, 4);
        add(chart, "FE, toe", h_.slip_toe, mm, 5);
        add(chart, "FE, area mean", h_.slip, mm, 0, Weight::strong);
        for (std::size_t k = 0; k < h_.lifts.size(); ++k) add(chart, lift_name(k), h_.lifts[k].slip, mm, k % 2 ? 6 : 3);
        if (view_.rigid) {
            Curve rigid{"rigid block",
                        view_.rigid->history.time,
                        scaled(view_.rigid->history.slip, mm),
                        {},
                        {},
                        Mark::dashed,
                        Weight::strong,
                        1};
            on_grid(rigid);
            chart.curves.push_back(std::move(rigid));
        }
        if (view_.allowable && std::abs(view_.run.fe.max_slip) > 0.2 * *view_.allowable)
            chart.horizontal.push_back({*view_.allowable / mm, "allowable"});
        chart.note = view_.rigid
                         ? "The rigid block has the same uplift, water and added mass, and the vertical component "
                           "where the record has one."
                         : "";
        return chart;
    }

    Chart crest() const
    {
        Chart chart = empty("crest motion", "displacement, downstream", "mm", 280);
        add(chart, "crest, relative to the ground", h_.crest_x, mm, 0);
        std::vector<double> lean = h_.crest_x;
        for (std::size_t i = 0; i < lean.size(); ++i) lean[i] -= h_.slip[i];
        add(chart, "crest, relative to the base", lean, mm, 2);
        return chart;
    }

    Chart forces() const
    {
        Chart chart = empty("forces on the base", "force", "MN/m", 280);
        add(chart, "effective normal force N'", h_.normal_force, 1e6, 0);
        add(chart, "shear T, resists downstream slip", h_.shear_force, 1e6, 1);
        return chart;
    }

    Chart anchors() const
    {
        Chart chart = empty("anchors", "force N", "kN/m", 240);
        for (std::size_t k = 0; k < h_.anchors.size(); ++k)
            add(chart, h_.anchors[k].name, h_.anchors[k].force, 1e3, static_cast<int>(k % 7));
        return chart;
    }

    Chart rocking() const
    {
        Chart chart = empty("rocking", "rotation", "mrad", 240);
        add(chart, "base over the rock", h_.rocking, 1e-3, 0);
        for (std::size_t k = 0; k < h_.lifts.size(); ++k)
            add(chart, lift_name(k), h_.lifts[k].rocking, 1e-3, k % 2 ? 6 : 3);
        chart.note = "Of what is above over what is below, positive where the upstream end opens.";
        return chart;
    }

    Chart lengths() const
    {
        Chart chart = empty("sliding and open length of the base", "length", "m", 240);
        add(chart, "slips", h_.slipping_length, 1.0, 1);
        add(chart, "open", h_.open_length, 1.0, 0);
        return chart;
    }

    Chart energy() const
    {
        Chart chart = empty("energy since the start of the shaking", "energy", "kJ/m", 360);
        const auto term = [&](const char* name, double fe2d::Energy::*member, int colour, Mark mark = Mark::line) {
            if (h_.energy.empty()) return;
            std::vector<double> values;
            values.reserve(h_.energy.size());
            for (const fe2d::Energy& e : h_.energy) values.push_back(e.*member - h_.energy.front().*member);
            add(chart, name, values, 1e3, colour);
            chart.curves.back().mark = mark;
        };
        term("external work", &fe2d::Energy::external, 0);
        term("kinetic", &fe2d::Energy::kinetic, 2);
        term("strain", &fe2d::Energy::strain, 5);
        term("friction, dissipated", &fe2d::Energy::friction, 1);
        term("damping, dissipated", &fe2d::Energy::damping, 4);
        term("scheme, dissipated", &fe2d::Energy::numerical, 3);
        if (!h_.energy.empty() && h_.energy.back().radiated != 0.0)
            term("radiated by water and rock", &fe2d::Energy::radiated, 6);
        const std::size_t before_joints = chart.curves.size();
        const auto of_joints = [&](const char* name, double fe2d::Energy::*member, int colour) {
            const auto there = [=](const fe2d::Energy& e) { return e.*member != 0.0; };
            if (std::any_of(h_.energy.begin(), h_.energy.end(), there)) term(name, member, colour, Mark::dashed);
        };
        of_joints("stored in joints", &fe2d::Energy::joint_stored, 5);
        of_joints("bond, fracture", &fe2d::Energy::bond_fracture, 1);
        of_joints("anchors, plastic", &fe2d::Energy::anchor_plastic, 3);
        of_joints("anchors, snapped", &fe2d::Energy::anchor_loss, 2);
        of_joints("impacts", &fe2d::Energy::impact, 4);
        of_joints("water in joints", &fe2d::Energy::joint_water, 6);
        const std::size_t plain = before_joints + 2; // this one and the imbalance
        term("contact normal work", &fe2d::Energy::contact_normal, 7, Mark::dashed);
        add(chart, "imbalance", h_.imbalance, 1e3, 7);
        chart.note =
            fmt::format("kinetic + strain + damping + scheme + friction + radiated = external + contact normal work; "
                        "what is left is the imbalance, at the end {:.1e} of the largest term.",
                        view_.run.fe.energy_error);
        if (chart.curves.size() > plain)
            chart.note +=
                " What bonds, anchors and impacts store and spend counts on the left, the work of water in joints "
                "on the right.";
        return chart;
    }

private:
    std::string lift_name(std::size_t k) const
    {
        const fe2d::LiftResult& lift = view_.run.fe.lifts[k];
        return lift.name.empty() ? lift.plane : lift.name;
    }

    Chart empty(const std::string& title, const std::string& label, const std::string& unit, int height) const
    {
        Chart chart;
        chart.title = view_.run.label() + ": " + title;
        chart.x = {"time", "s"};
        chart.y = {label, unit};
        chart.height = height;
        chart.together = view_.together;
        return chart;
    }

    void add(Chart& chart, const std::string& name, const std::vector<double>& values, double unit, int colour,
             Weight weight = Weight::normal) const
    {
        if (values.size() != time_.size()) return; // not kept by this kind of run
        chart.curves.push_back({name, time_, scaled(values, unit), {}, {}, Mark::line, weight, colour});
    }

    /// Times of the block at the history's instants become those to the last bit.
    void on_grid(Curve& curve) const
    {
        for (std::size_t i = 0; i < std::min(curve.x.size(), time_.size()); ++i)
            if (std::abs(curve.x[i] - time_[i]) <
                1e-6 * (time_.back() - time_.front()) / static_cast<double>(time_.size()))
                curve.x[i] = time_[i];
    }

    const RunView& view_;
    const fe2d::RunHistory& h_;
    std::vector<double> time_;
};

} // namespace

std::vector<Chart> history_charts(const RunView& view)
{
    const Charts make(view);
    std::vector<Chart> charts{make.ground(),  make.slip(),    make.crest(),   make.forces(),
                              make.anchors(), make.rocking(), make.lengths(), make.energy()};
    std::erase_if(charts, [](const Chart& chart) { return chart.curves.empty(); });
    for (Chart& chart : charts) { // so that a run of 20 s at 0.005 s is whole, and many long ones stay small
        chart.thin_above = std::clamp<std::size_t>(16000 / std::max<std::size_t>(view.records, 1), 800, 4200);
        chart.thin_buckets = chart.thin_above / (2 * chart.curves.size());
    }
    return charts;
}

std::optional<std::size_t> fastest_row(const fe2d::RunHistory& h)
{
    std::optional<std::size_t> row;
    double largest = 0.0;
    for (std::size_t i = 1; i < h.slip.size(); ++i) {
        const double rate = std::abs(h.slip[i] - h.slip[i - 1]) / (h.time[i] - h.time[i - 1]);
        if (!(rate > largest)) continue;
        largest = rate;
        row = i;
    }
    return row;
}

namespace {

constexpr std::size_t largest_instants = 150; ///< of one record alone

/// Values of the pairs at one row of the history, in MPa.
std::vector<double> row_values(const fe2d::PairHistory& pairs, const std::vector<double>& values, std::size_t row)
{
    std::vector<double> out;
    for (Eigen::Index i = 0; i < pairs.pairs; ++i) out.push_back(1e-6 * values[pairs.at(row, i)]);
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

Chart chart_of(const RunView& view, const std::string& what, const std::vector<double>& values)
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

// Tables of one run over time and along the base.

namespace {

char letter(fe2d::ContactState state)
{
    switch (state) {
    case fe2d::ContactState::stick:
        return 's';
    case fe2d::ContactState::slip_downstream:
        return 'd';
    case fe2d::ContactState::slip_upstream:
        return 'u';
    case fe2d::ContactState::open:
        return 'o';
    case fe2d::ContactState::pulled:
        return 'p';
    }
    return '?';
}

using RowColumn = ColumnOf<std::size_t>; ///< of the rows of a history

/// One of its values in each row. @param values  outlives this
auto of(const std::vector<double>& values)
{
    return [&values](std::size_t row) { return values[row]; };
}

std::vector<RowColumn> history_columns(const fe2d::RunHistory& h)
{
    std::vector<RowColumn> all;
    const auto add = [&](Column column, const std::vector<double>& values) { // a run on few modes does not keep all
        if (values.size() == h.time.size()) all.push_back({std::move(column), of(values)});
    };
    add({"time_s", "time", "s", 6}, h.time);
    add({"ground_accel_h_m_s2", "a_h", "m/s²", 5}, h.ground_h);
    add({"ground_accel_v_m_s2", "a_v", "m/s²", 5}, h.ground_v);
    add({"slip_m", "slip", "m", 6}, h.slip);
    add({"slip_heel_m", "slip, heel", "m", 6}, h.slip_heel);
    add({"slip_middle_m", "slip, middle", "m", 6}, h.slip_middle);
    add({"slip_toe_m", "slip, toe", "m", 6}, h.slip_toe);
    add({"rocking_rad", "rocking", "rad", 6}, h.rocking);
    add({"crest_x_m", "crest x", "m", 6}, h.crest_x);
    add({"normal_force_N_m", "N'", "N/m", 6}, h.normal_force);
    add({"shear_force_N_m", "T", "N/m", 6}, h.shear_force);
    add({"normal_position_m", "N' from heel", "m", 6}, h.normal_position);
    add({"moment_N_m_m", "moment", "N m/m", 6}, h.moment);
    add({"open_length_m", "open", "m", 4}, h.open_length);
    add({"slipping_length_m", "slipping", "m", 4}, h.slipping_length);
    add({"largest_opening_m", "opening", "m", 4}, h.largest_opening);
    if (h.energy.size() == h.time.size())
        for (const auto& [column, value] : energy_columns_of(h.energy))
            all.push_back({column, [&h, value](std::size_t row) { return value(h.energy[row]); }});
    add({"imbalance_J_m", "imbalance", "J/m", 4}, h.imbalance);
    for (std::size_t k = 0; k < h.lifts.size(); ++k) {
        const fe2d::LiftHistory& lift = h.lifts[k];
        const std::string number = std::to_string(k + 1), key = "lift" + number + "_",
                          name = "lift joint " + number + ", ";
        all.push_back({{key + "slip_m", name + "slip", "m", 6}, of(lift.slip)});
        all.push_back({{key + "rocking_rad", name + "rocking", "rad", 6}, of(lift.rocking)});
        all.push_back({{key + "normal_force_N_m", name + "N'", "N/m", 6}, of(lift.normal_force)});
        all.push_back({{key + "largest_opening_m", name + "opening", "m", 4}, of(lift.largest_opening)});
        if (lift.damaged.empty()) continue;
        all.push_back({{key + "damaged_m", name + "damaged", "m", 5}, of(lift.damaged)});
        all.push_back({{key + "broken_m", name + "broken", "m", 5}, of(lift.broken)});
    }
    for (std::size_t k = 0; k < h.anchors.size(); ++k)
        all.push_back({{"anchor" + std::to_string(k + 1) + "_force_N_m", "N, " + h.anchors[k].name, "N/m", 6},
                       of(h.anchors[k].force)});
    if (!h.crack_length.empty()) {
        all.push_back({{"crack_length_m", "crack", "m", 5}, of(h.crack_length)});
        all.push_back({{"wet_length_m", "water in the crack", "m", 5}, of(h.wet_length)});
    }
    for (RowColumn& column : slide_columns(h.slide)) all.push_back(std::move(column));
    return all;
}

} // namespace

std::vector<ColumnOf<std::size_t>> slide_columns(const fe2d::SlideHistory& h)
{
    if (h.rate.empty()) return {};
    return {{{"thrust_over_friction", "χ", "–", 4}, of(h.thrust_over_friction)},
            {{"hops", "lift-offs", "", 6}, of(h.lift_offs)},
            {{"unloaded_share", "unloaded", "–", 4}, of(h.unloaded_share)},
            {{"slip_rate_m_s", "slip rate", "m/s", 4}, of(h.rate)}};
}

Table contact_history_table(const fe2d::RunHistory& h)
{
    return table_of("", history_columns(h), std::views::iota(std::size_t{0}, h.time.size()));
}

Table base_table(const fe2d::RunResult& r)
{
    using Pair = Eigen::Index;
    const auto of_pairs = [](const Eigen::VectorXd& values) { return [&values](Pair i) { return values[i]; }; };
    return table_of<Pair>("",
                          {{{"distance_m", "distance", "m", 5}, of_pairs(r.pair_distance)},
                           {{"area_m", "length", "m", 5}, of_pairs(r.pair_area)},
                           {{"pressure_Pa", "effective pressure", "Pa", 6}, of_pairs(r.pair_pressure)},
                           {{"shear_Pa", "shear", "Pa", 6}, of_pairs(r.pair_shear)},
                           {{"slip_m", "slip", "m", 6}, of_pairs(r.pair_slip)},
                           {{"opening_m", "opening", "m", 6}, of_pairs(r.pair_opening)}},
                          std::views::iota(Pair{0}, r.pair_slip.size()));
}

Table pair_table(const fe2d::RunResult& r, std::size_t largest)
{
    struct Row {
        std::size_t instant;
        Eigen::Index pair;
        std::size_t place; ///< in the history by pair
    };
    const fe2d::PairHistory& p = r.history.by_pair;
    const std::size_t instants = p.pairs ? r.history.time.size() : 0,
                      every = std::max<std::size_t>(1, (instants + largest - 1) / largest);
    std::vector<Row> rows;
    for (std::size_t instant = 0; instant < instants; ++instant) {
        if (instant % every && instant + 1 != instants) continue;
        for (Eigen::Index i = 0; i < p.pairs; ++i) rows.push_back({instant, i, p.at(instant, i)});
    }
    const auto kept = [](const auto& values) {
        return [&values](const Row& row) { return static_cast<double>(values[row.place]); };
    };
    return table_of<Row>(
        "",
        {{{"time_s", "time", "s", 6}, [&](const Row& row) { return r.history.time[row.instant]; }},
         {{"distance_m", "distance", "m", 5}, [&](const Row& row) { return r.pair_distance[row.pair]; }},
         {{"pressure_Pa", "effective pressure", "Pa", 6}, kept(p.pressure)},
         {{"shear_Pa", "shear", "Pa", 6}, kept(p.shear)},
         {{"slip_m", "slip", "m", 6}, kept(p.slip)},
         {{"opening_m", "opening", "m", 6}, kept(p.opening)},
         {{"state", "state"}, [&](const Row& row) { return std::string(1, letter(p.state[row.place])); }}},
        rows);
}

Table state_map(const fe2d::RunHistory& h)
{
    const auto states = [&h](std::size_t row) {
        std::string letters;
        for (Eigen::Index i = 0; i < h.by_pair.pairs; ++i) letters += letter(h.by_pair.state[h.by_pair.at(row, i)]);
        return letters;
    };
    return table_of<std::size_t>(
        "", {{{"time_s", "time", "s", 6}, of(h.time)}, {{"states_heel_to_toe", "states, heel to toe"}, states}},
        std::views::iota(std::size_t{0}, h.by_pair.pairs ? h.time.size() : 0));
}

} // namespace damslip::pages
