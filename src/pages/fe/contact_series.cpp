// Tables of one run over time and along the base.
#include "pages/fe/contact_tables.hpp"

#include <ranges>

namespace damslip::pages {

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
    std::vector<RowColumn> all{{{"time_s", "time", "s", 6}, of(h.time)},
                               {{"ground_accel_h_m_s2", "a_h", "m/s²", 5}, of(h.ground_h)},
                               {{"ground_accel_v_m_s2", "a_v", "m/s²", 5}, of(h.ground_v)},
                               {{"slip_m", "slip", "m", 6}, of(h.slip)},
                               {{"slip_heel_m", "slip, heel", "m", 6}, of(h.slip_heel)},
                               {{"slip_middle_m", "slip, middle", "m", 6}, of(h.slip_middle)},
                               {{"slip_toe_m", "slip, toe", "m", 6}, of(h.slip_toe)},
                               {{"rocking_rad", "rocking", "rad", 6}, of(h.rocking)},
                               {{"crest_x_m", "crest x", "m", 6}, of(h.crest_x)},
                               {{"normal_force_N_m", "N'", "N/m", 6}, of(h.normal_force)},
                               {{"shear_force_N_m", "T", "N/m", 6}, of(h.shear_force)},
                               {{"normal_position_m", "N' from heel", "m", 6}, of(h.normal_position)},
                               {{"moment_N_m_m", "moment", "N m/m", 6}, of(h.moment)},
                               {{"open_length_m", "open", "m", 4}, of(h.open_length)},
                               {{"slipping_length_m", "slipping", "m", 4}, of(h.slipping_length)},
                               {{"largest_opening_m", "opening", "m", 4}, of(h.largest_opening)}};
    for (const auto& [column, value] : energy_columns_of(h.energy))
        all.push_back({column, [&h, value](std::size_t row) { return value(h.energy[row]); }});
    all.push_back({{"imbalance_J_m", "imbalance", "J/m", 4}, of(h.imbalance)});
    for (std::size_t k = 0; k < h.lifts.size(); ++k) {
        const fe2d::LiftHistory& lift = h.lifts[k];
        const std::string number = std::to_string(k + 1), key = "lift" + number + "_",
                          name = "lift joint " + number + ", ";
        all.push_back({{key + "slip_m", name + "slip", "m", 6}, of(lift.slip)});
        all.push_back({{key + "rocking_rad", name + "rocking", "rad", 6}, of(lift.rocking)});
        all.push_back({{key + "normal_force_N_m", name + "N'", "N/m", 6}, of(lift.normal_force)});
        all.push_back({{key + "largest_opening_m", name + "opening", "m", 4}, of(lift.largest_opening)});
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
            {{"hops", "hops", "", 6}, of(h.hops)},
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
