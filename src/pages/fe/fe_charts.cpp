#include "pages/fe/fe_pages.hpp"

#include "core/text.hpp"
#include "core/units.hpp"
#include "pages/scene/scene_pages.hpp"
#include "scene/joint_bond.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
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

    void of_motion()
    {
        begin("ground acceleration", "acceleration", "m/s²", 240);
        add("horizontal, upstream", h_.ground_h, 1.0, 0);
        if (std::ranges::any_of(h_.ground_v, [](double a) { return a != 0.0; }))
            add("vertical, up", h_.ground_v, 1.0, 1);

        begin("slip", "slip, downstream", "mm", 360);
        add("FE, heel", h_.slip_heel, mm, 2);
        add("FE, middle", h_.slip_middle, mm, 4);
        add("FE, toe", h_.slip_toe, mm, 5);
        add("FE, area mean", h_.slip, mm, 0, Weight::strong);
        for (std::size_t k = 0; k < h_.lifts.size(); ++k) add(lift_name(k), h_.lifts[k].slip, mm, k % 2 ? 6 : 3);
        if (view_.rigid) {
            charts_.back().curves.push_back({.name = "rigid block",
                                             .x = view_.rigid->history.time,
                                             .y = scaled(view_.rigid->history.slip, mm),
                                             .mark = Mark::dashed,
                                             .weight = Weight::strong,
                                             .colour = 1});
            on_grid(charts_.back().curves.back());
            charts_.back().note =
                "The rigid block has the same uplift, water and added mass, and the vertical component "
                "where the record has one.";
        }
        if (view_.allowable && std::abs(view_.run.fe.max_slip) > 0.2 * *view_.allowable)
            charts_.back().horizontal.push_back({*view_.allowable / mm, "allowable"});

        begin("crest motion", "displacement, downstream", "mm", 280);
        add("crest, relative to the ground", h_.crest_x, mm, 0);
        std::vector<double> lean = h_.crest_x;
        for (std::size_t i = 0; i < lean.size(); ++i) lean[i] -= h_.slip[i];
        add("crest, relative to the base", lean, mm, 2);
    }

    void of_base()
    {
        begin("forces on the base", "force", "MN/m", 280);
        add("effective normal force N'", h_.normal_force, 1e6, 0);
        add("shear T, resists downstream slip", h_.shear_force, 1e6, 1);

        begin("anchors", "force N", "kN/m", 240);
        for (std::size_t k = 0; k < h_.anchors.size(); ++k)
            add(h_.anchors[k].name, h_.anchors[k].force, 1e3, static_cast<int>(k % 7));

        begin("rocking", "rotation", "mrad", 240);
        add("base over the rock", h_.rocking, 1e-3, 0);
        for (std::size_t k = 0; k < h_.lifts.size(); ++k) add(lift_name(k), h_.lifts[k].rocking, 1e-3, k % 2 ? 6 : 3);
        charts_.back().note = "Of what is above over what is below, positive where the upstream end opens.";

        begin("sliding and open length of the base", "length", "m", 240);
        add("slips", h_.slipping_length, 1.0, 1);
        add("open", h_.open_length, 1.0, 0);
    }

    void of_energy()
    {
        using E = fe2d::Energy;
        begin("energy since the start of the shaking", "energy", "kJ/m", 360);
        add_energy("external work", &E::external, 0);
        add_energy("kinetic", &E::kinetic, 2);
        add_energy("strain", &E::strain, 5);
        add_energy("friction, dissipated", &E::friction, 1);
        add_energy("damping, dissipated", &E::damping, 4);
        add_energy("scheme, dissipated", &E::numerical, 3);
        if (!h_.energy.empty() && h_.energy.back().radiated != 0.0)
            add_energy("radiated by water and rock", &E::radiated, 6);
        const std::size_t plain = charts_.back().curves.size() + 2; // contact normal work and the imbalance
        const auto of_joints = [&](const char* name, double E::*term, int colour) {
            if (std::ranges::any_of(
                    h_.energy, [](double value) { return value != 0.0; }, term))
                add_energy(name, term, colour, Mark::dashed);
        };
        of_joints("stored in joints", &E::joint_stored, 5);
        of_joints("bond, fracture", &E::bond_fracture, 1);
        of_joints("anchors, plastic", &E::anchor_plastic, 3);
        of_joints("anchors, snapped", &E::anchor_loss, 2);
        of_joints("impacts", &E::impact, 4);
        of_joints("water in joints", &E::joint_water, 6);
        add_energy("contact normal work", &E::contact_normal, 7, Mark::dashed);
        add("imbalance", h_.imbalance, 1e3, 7);
        charts_.back().note =
            fmt::format("kinetic + strain + damping + scheme + friction + radiated = external + contact normal work; "
                        "what is left is the imbalance, at the end {:.1e} of the largest term.",
                        view_.run.fe.energy_error);
        if (charts_.back().curves.size() > plain)
            charts_.back().note +=
                " What bonds, anchors and impacts store and spend counts on the left, the work of water in joints "
                "on the right.";
    }

    /// Those that have a curve.
    std::vector<Chart> charts()
    {
        std::erase_if(charts_, [](const Chart& chart) { return chart.curves.empty(); });
        for (Chart& chart : charts_) thin_for(chart, view_.records, run_samples, most_run_samples);
        return std::move(charts_);
    }

private:
    std::string lift_name(std::size_t k) const
    {
        const fe2d::LiftResult& lift = view_.run.fe.lifts[k];
        return lift.name.empty() ? lift.plane : lift.name;
    }

    /// The next chart, which the curves that follow are of.
    void begin(const std::string& title, const std::string& label, const std::string& unit, int height)
    {
        charts_.push_back(time_chart(view_.run.label() + ": " + title, {label, unit}, height));
        charts_.back().together = view_.together;
    }

    void add(const std::string& name, const std::vector<double>& values, double unit, int colour,
             Weight weight = Weight::normal, Mark mark = Mark::line)
    {
        if (values.size() != time_.size()) return; // not kept by this kind of run
        charts_.back().curves.push_back(
            {.name = name, .x = time_, .y = scaled(values, unit), .mark = mark, .weight = weight, .colour = colour});
    }

    void add_energy(const std::string& name, double fe2d::Energy::*term, int colour, Mark mark = Mark::line)
    {
        if (h_.energy.empty()) return;
        std::vector<double> values;
        for (const fe2d::Energy& e : h_.energy) values.push_back(e.*term - h_.energy.front().*term);
        add(name, values, 1e3, colour, Weight::normal, mark);
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
    std::vector<Chart> charts_;
};

} // namespace

std::vector<Chart> history_charts(const RunView& view)
{
    Charts make(view);
    make.of_motion();
    make.of_base();
    make.of_energy();
    return make.charts();
}

namespace {

/// The row of the history where the mean slip changes fastest; nothing where the dam does not slide.
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

constexpr std::size_t largest_instants = 150; ///< of one record alone

/// Pressures along the base, or of the water in it: some instants, and any of about 150 by a slider.
template <class Value>
class BaseChart {
public:
    /// @param values  of the pairs, row by row of the history [Pa]; outlives this
    BaseChart(const RunView& view, const std::string& title, const std::string& quantity,
              const std::vector<Value>& values)
        : view_(view), values_(values), chart_{.title = view.run.label() + ": " + title,
                                               .x = {"distance from the heel", "m"},
                                               .y = {quantity, "MPa"},
                                               .together = view.together + "base"}
    {
    }

    void add(const std::string& name, std::size_t row, int colour, Weight weight = Weight::normal)
    {
        const Eigen::VectorXd& distance = view_.run.fe.pair_distance;
        chart_.curves.push_back({.name = name,
                                 .x = {distance.begin(), distance.end()},
                                 .y = in_MPa(row),
                                 .weight = weight,
                                 .colour = colour});
    }

    /// @param rows  the slider goes through @param first  drawn first
    Chart with_slider(const std::vector<std::size_t>& rows, std::size_t first)
    {
        Moving moving{.curve = chart_.curves.size(), .label = "time", .unit = "s"};
        for (const std::size_t row : rows) {
            if (row == first) moving.start = moving.at.size();
            moving.at.push_back(view_.run.fe.history.time[row]);
            moving.y.push_back(in_MPa(row));
        }
        add("at the slider's time", first, 0, Weight::strong);
        const auto [low, high] = std::ranges::minmax_element(values_);
        const double bottom = std::min(0.0, 1e-6 * *low), top = 1e-6 * *high;
        chart_.y.low = bottom - 0.04 * (top - bottom);
        chart_.y.high = top + 0.04 * (top - bottom);
        chart_.moving = std::move(moving);
        return std::move(chart_);
    }

private:
    std::vector<double> in_MPa(std::size_t row) const
    {
        const auto pairs = static_cast<std::size_t>(view_.run.fe.pair_distance.size());
        std::vector<double> out;
        for (std::size_t i = row * pairs; i < (row + 1) * pairs; ++i) out.push_back(1e-6 * values_[i]);
        return out;
    }

    const RunView& view_;
    const std::vector<Value>& values_;
    Chart chart_;
};

Chart chart_of(const RunView& view, const std::string& what, const std::vector<double>& values)
{
    const fe2d::RunHistory& h = view.run.fe.history;
    BaseChart chart(view, what + " along the base", what.substr(0, what.find(',')), values); // the title has the rest
    const std::optional<std::size_t> fastest = fastest_row(h);
    chart.add("start", 0, 7);
    if (fastest) chart.add(fmt::format("largest slip rate, {:.4g} s", h.time[*fastest]), *fastest, 1);
    chart.add(fmt::format("end, {:.4g} s", h.time.back()), h.time.size() - 1, 2);
    const std::size_t largest = std::max<std::size_t>(20, largest_instants / view.records);
    const std::size_t every = std::max<std::size_t>(1, (h.time.size() + largest - 1) / largest);
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < h.time.size(); ++row)
        if (row % every == 0 || row + 1 == h.time.size() || row == fastest) rows.push_back(row);
    return chart.with_slider(rows, fastest.value_or(0));
}

const char* letter(fe2d::ContactState state)
{
    return word_in(state, {{fe2d::ContactState::stick, "s"},
                           {fe2d::ContactState::slip_downstream, "d"},
                           {fe2d::ContactState::slip_upstream, "u"},
                           {fe2d::ContactState::open, "o"},
                           {fe2d::ContactState::pulled, "p"}});
}

/// One for each pair, from heel to toe.
std::string letters_of(const fe2d::PairHistory& pairs, std::size_t row)
{
    std::string letters;
    for (Eigen::Index i = 0; i < pairs.pairs; ++i) letters += letter(pairs.state[pairs.at(row, i)]);
    return letters;
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

std::optional<Chart> base_water_chart(const RunView& view)
{
    const fe2d::RunResult& fe = view.run.fe;
    const fe2d::RunHistory& h = fe.history;
    if (!fe.base_water || h.joint_pressure.empty()) return std::nullopt;
    const auto sum = [&, pairs = fe.pair_distance.size()](std::size_t row) {
        const auto from = h.joint_pressure.begin() + static_cast<std::ptrdiff_t>(row) * pairs;
        return std::accumulate(from, from + pairs, 0.0);
    };
    std::size_t least = 0, most = 0;
    for (std::size_t row = 1; row < h.time.size(); ++row) {
        if (sum(row) < sum(least)) least = row;
        if (sum(row) > sum(most)) most = row;
    }
    const auto longest = static_cast<std::size_t>(std::ranges::max_element(h.crack_length) - h.crack_length.begin());
    BaseChart chart(view, "water pressure in the joint", "water pressure", h.joint_pressure);
    chart.add("before the earthquake", 0, 7);
    chart.add(fmt::format("longest crack, {:.3g} m at {:.4g} s", h.crack_length[longest], h.time[longest]), longest, 1);
    if (most != longest && most != 0) chart.add(fmt::format("largest uplift, {:.4g} s", h.time[most]), most, 3);
    if (least != longest && least != 0) chart.add(fmt::format("least uplift, {:.4g} s", h.time[least]), least, 2);
    const std::size_t largest = std::max<std::size_t>(20, largest_instants / view.records),
                      every = std::max<std::size_t>(1, h.time.size() / largest);
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < h.time.size(); ++row)
        if (row % every == 0 || row == longest) rows.push_back(row);
    Chart shown = chart.with_slider(rows, longest);
    shown.note = "Against the atmosphere, mean over the length that belongs to each contact pair.";
    return shown;
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
    return Chart{.title = view.run.label() + ": bond along the base",
                 .x = {"distance from the heel", "m"},
                 .y = {.label = "damage κ", .unit = "–", .low = 0.0, .high = 1.05},
                 .curves = {{.name = "at the end", .x = distance, .y = values, .weight = Weight::strong, .colour = 1}},
                 .together = view.together + "base",
                 .note = fmt::format("0: intact, 1: broken for good. At the end {:.3g} m of {:.3g} m are broken.",
                                     broken, fe.pair_area.sum()),
                 .height = 240};
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
    if (std::ranges::find(pairs.state, fe2d::ContactState::pulled) != pairs.state.end())
        map.kinds.push_back({'p', "pulled (the joint may not open)", 3});
    for (std::size_t row = 0; row < map.time.size(); ++row) map.states.push_back(letters_of(pairs, row));
    map.note =
        "Each cell is a contact pair at an instant of the record; where several share a pixel, open counts before "
        "slip, slip before stick.";
    return map;
}

// Tables of one run over time and along the base.

namespace {

using RowColumn = ColumnOf<std::size_t>; ///< of the rows of a history

/// One of its values in each row. @param values  outlives this
auto of(const std::vector<double>& values)
{
    return [&values](std::size_t row) { return values[row]; };
}

/// None where it is empty. @param h  outlives them
std::vector<RowColumn> slide_columns(const fe2d::SlideHistory& h)
{
    if (h.rate.empty()) return {};
    return {{{"thrust_over_friction", "χ", "–", 4}, of(h.thrust_over_friction)},
            {{"hops", "lift-offs", "", 6}, of(h.lift_offs)},
            {{"unloaded_share", "unloaded", "–", 4}, of(h.unloaded_share)},
            {{"slip_rate_m_s", "slip rate", "m/s", 4}, of(h.rate)}};
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
         {{"state", "state"}, [&](const Row& row) { return letter(p.state[row.place]); }}},
        rows);
}

Table state_map(const fe2d::RunHistory& h)
{
    const auto states = [&h](std::size_t row) { return letters_of(h.by_pair, row); };
    return table_of<std::size_t>(
        "", {{{"time_s", "time", "s", 6}, of(h.time)}, {{"states_heel_to_toe", "states, heel to toe"}, states}},
        std::views::iota(std::size_t{0}, h.by_pair.pairs ? h.time.size() : 0));
}

} // namespace damslip::pages
