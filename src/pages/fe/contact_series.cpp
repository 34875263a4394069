// Tables of one run over time and along the base.
#include "pages/fe/contact_tables.hpp"

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

/// A column of the history of one run, and of one of its lift joints.
struct HistoryColumn {
    Column column;
    std::vector<double> fe2d::RunHistory::*values;
};
struct LiftColumn {
    Column column;
    std::vector<double> fe2d::LiftHistory::*values;
};

const std::vector<HistoryColumn>& motion_columns()
{
    using H = fe2d::RunHistory;
    static const std::vector<HistoryColumn> all{{{"time_s", "time", "s", 6}, &H::time},
                                                {{"ground_accel_h_m_s2", "a_h", "m/s²", 5}, &H::ground_h},
                                                {{"ground_accel_v_m_s2", "a_v", "m/s²", 5}, &H::ground_v},
                                                {{"slip_m", "slip", "m", 6}, &H::slip},
                                                {{"slip_heel_m", "slip, heel", "m", 6}, &H::slip_heel},
                                                {{"slip_middle_m", "slip, middle", "m", 6}, &H::slip_middle},
                                                {{"slip_toe_m", "slip, toe", "m", 6}, &H::slip_toe},
                                                {{"rocking_rad", "rocking", "rad", 6}, &H::rocking},
                                                {{"crest_x_m", "crest x", "m", 6}, &H::crest_x},
                                                {{"normal_force_N_m", "N'", "N/m", 6}, &H::normal_force},
                                                {{"shear_force_N_m", "T", "N/m", 6}, &H::shear_force},
                                                {{"normal_position_m", "N' from heel", "m", 6}, &H::normal_position},
                                                {{"moment_N_m_m", "moment", "N m/m", 6}, &H::moment},
                                                {{"open_length_m", "open", "m", 4}, &H::open_length},
                                                {{"slipping_length_m", "slipping", "m", 4}, &H::slipping_length},
                                                {{"largest_opening_m", "opening", "m", 4}, &H::largest_opening}};
    return all;
}

const std::vector<LiftColumn>& lift_columns()
{
    using L = fe2d::LiftHistory;
    static const std::vector<LiftColumn> all{{{"slip_m", "slip", "m", 6}, &L::slip},
                                             {{"rocking_rad", "rocking", "rad", 6}, &L::rocking},
                                             {{"normal_force_N_m", "N'", "N/m", 6}, &L::normal_force},
                                             {{"largest_opening_m", "opening", "m", 4}, &L::largest_opening}};
    return all;
}

} // namespace

Table contact_history_table(const fe2d::RunHistory& h)
{
    Table t;
    for (const HistoryColumn& c : motion_columns()) t.columns.push_back(c.column);
    for (const EnergyTerm& term : energy_terms()) t.columns.push_back(term.column);
    t.columns.push_back({"imbalance_J_m", "imbalance", "J/m", 4});
    for (std::size_t k = 1; k <= h.lifts.size(); ++k)
        for (const LiftColumn& c : lift_columns())
            t.columns.push_back({"lift" + std::to_string(k) + "_" + c.column.key,
                                 "lift joint " + std::to_string(k) + ", " + c.column.heading, c.column.unit,
                                 c.column.digits});
    for (std::size_t i = 0; i < h.time.size(); ++i) {
        std::vector<Cell>& row = t.rows.emplace_back();
        for (const HistoryColumn& c : motion_columns()) row.emplace_back((h.*c.values)[i]);
        for (const EnergyTerm& term : energy_terms()) row.emplace_back(h.energy[i].*term.value);
        row.emplace_back(h.imbalance[i]);
        for (const fe2d::LiftHistory& lift : h.lifts)
            for (const LiftColumn& c : lift_columns()) row.emplace_back((lift.*c.values)[i]);
    }
    return t;
}

Table base_table(const fe2d::RunResult& r)
{
    Table t;
    t.columns = {{"distance_m", "distance", "m", 5},
                 {"area_m", "length", "m", 5},
                 {"pressure_Pa", "effective pressure", "Pa", 6},
                 {"shear_Pa", "shear", "Pa", 6},
                 {"slip_m", "slip", "m", 6},
                 {"opening_m", "opening", "m", 6}};
    for (Eigen::Index i = 0; i < r.pair_slip.size(); ++i)
        t.rows.push_back({r.pair_distance[i], r.pair_area[i], r.pair_pressure[i], r.pair_shear[i], r.pair_slip[i],
                          r.pair_opening[i]});
    return t;
}

Table pair_table(const fe2d::RunResult& r, std::size_t largest)
{
    Table t;
    t.columns = {{"time_s", "time", "s", 6},
                 {"distance_m", "distance", "m", 5},
                 {"pressure_Pa", "effective pressure", "Pa", 6},
                 {"shear_Pa", "shear", "Pa", 6},
                 {"slip_m", "slip", "m", 6},
                 {"opening_m", "opening", "m", 6},
                 {"state", "state", "", 4}};
    const fe2d::PairHistory& p = r.history.by_pair;
    const std::size_t rows = p.pairs ? r.history.time.size() : 0,
                      every = std::max<std::size_t>(1, (rows + largest - 1) / largest);
    for (std::size_t row = 0; row < rows; ++row) {
        if (row % every && row + 1 != rows) continue;
        for (Eigen::Index i = 0; i < p.pairs; ++i) {
            const std::size_t k = p.at(row, i);
            t.rows.push_back({r.history.time[row], r.pair_distance[i], static_cast<double>(p.pressure[k]),
                              static_cast<double>(p.shear[k]), static_cast<double>(p.slip[k]),
                              static_cast<double>(p.opening[k]), std::string(1, letter(p.state[k]))});
        }
    }
    return t;
}

Table state_map(const fe2d::RunHistory& h)
{
    Table t;
    t.columns = {{"time_s", "time", "s", 6}, {"states_heel_to_toe", "states, heel to toe", "", 4}};
    for (std::size_t row = 0; h.by_pair.pairs && row < h.time.size(); ++row) {
        std::string states;
        for (Eigen::Index i = 0; i < h.by_pair.pairs; ++i) states += letter(h.by_pair.state[h.by_pair.at(row, i)]);
        t.rows.push_back({h.time[row], states});
    }
    return t;
}

} // namespace damslip::pages
