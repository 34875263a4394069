// Tables of one run over time and along the base.
#include "cli/show/contact_tables.hpp"

namespace damslip::cli {

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

} // namespace

Table contact_history_table(const fe2d::RunHistory& h)
{
    Table t;
    t.columns = {{"time_s", "time", "s", 6},
                 {"ground_accel_h_m_s2", "a_h", "m/s²", 5},
                 {"ground_accel_v_m_s2", "a_v", "m/s²", 5},
                 {"slip_m", "slip", "m", 6},
                 {"slip_heel_m", "slip, heel", "m", 6},
                 {"slip_middle_m", "slip, middle", "m", 6},
                 {"slip_toe_m", "slip, toe", "m", 6},
                 {"rocking_rad", "rocking", "rad", 6},
                 {"crest_x_m", "crest x", "m", 6},
                 {"normal_force_N_m", "N'", "N/m", 6},
                 {"shear_force_N_m", "T", "N/m", 6},
                 {"normal_position_m", "N' from heel", "m", 6},
                 {"moment_N_m_m", "moment", "N m/m", 6},
                 {"open_length_m", "open", "m", 4},
                 {"slipping_length_m", "slipping", "m", 4},
                 {"largest_opening_m", "opening", "m", 4},
                 {"kinetic_J_m", "kinetic", "J/m", 6},
                 {"strain_J_m", "strain", "J/m", 6},
                 {"damping_J_m", "damping", "J/m", 6},
                 {"numerical_J_m", "numerical", "J/m", 6},
                 {"friction_J_m", "friction", "J/m", 6},
                 {"external_J_m", "external", "J/m", 6},
                 {"contact_normal_J_m", "contact normal", "J/m", 6},
                 {"imbalance_J_m", "imbalance", "J/m", 4}};
    for (std::size_t k = 1; k <= h.lifts.size(); ++k) {
        const std::string key = "lift" + std::to_string(k) + "_", name = "lift joint " + std::to_string(k) + ", ";
        t.columns.push_back({key + "slip_m", name + "slip", "m", 6});
        t.columns.push_back({key + "rocking_rad", name + "rocking", "rad", 6});
        t.columns.push_back({key + "normal_force_N_m", name + "N'", "N/m", 6});
        t.columns.push_back({key + "largest_opening_m", name + "opening", "m", 4});
    }
    for (std::size_t i = 0; i < h.time.size(); ++i) {
        const fe2d::Energy& e = h.energy[i];
        t.rows.push_back({h.time[i],
                          h.ground_h[i],
                          h.ground_v[i],
                          h.slip[i],
                          h.slip_heel[i],
                          h.slip_middle[i],
                          h.slip_toe[i],
                          h.rocking[i],
                          h.crest_x[i],
                          h.normal_force[i],
                          h.shear_force[i],
                          h.normal_position[i],
                          h.moment[i],
                          h.open_length[i],
                          h.slipping_length[i],
                          h.largest_opening[i],
                          e.kinetic,
                          e.strain,
                          e.damping,
                          e.numerical,
                          e.friction,
                          e.external,
                          e.contact_normal,
                          h.imbalance[i]});
        for (const fe2d::LiftHistory& lift : h.lifts)
            t.rows.back().insert(t.rows.back().end(),
                                 {lift.slip[i], lift.rocking[i], lift.normal_force[i], lift.largest_opening[i]});
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

} // namespace damslip::cli
