#include "fe2d/time/history.hpp"

namespace damslip::fe2d {

namespace {

std::vector<ColumnOf<HistoryRow>> columns(bool water)
{
    using Row = HistoryRow;
    std::vector<ColumnOf<Row>> all = {
        {{"time_s", "time", "s", 6}, &Row::time},
        {{"ground_accel_h_m_s2", "ground acceleration a_h", "m/s²", 4}, &Row::ground_accel_h},
        {{"ground_accel_v_m_s2", "ground acceleration a_v", "m/s²", 4}, &Row::ground_accel_v},
        {{"crest_x_m", "crest displacement x", "m", 4}, &Row::crest_x},
        {{"crest_y_m", "crest displacement y", "m", 4}, &Row::crest_y},
        {{"crest_accel_x_m_s2", "crest acceleration x", "m/s²", 4}, &Row::crest_accel_x},
        {{"crest_accel_y_m_s2", "crest acceleration y", "m/s²", 4}, &Row::crest_accel_y},
        {{"base_shear_N_m", "base shear", "N/m", 4}, &Row::base_shear},
        {{"base_normal_N_m", "base normal force", "N/m", 4}, &Row::base_normal},
        {{"energy_kinetic_J_m", "kinetic energy", "J/m", 4}, [](const Row& r) { return r.energy.kinetic; }},
        {{"energy_strain_J_m", "strain energy", "J/m", 4}, [](const Row& r) { return r.energy.strain; }},
        {{"energy_damping_J_m", "damping", "J/m", 4}, [](const Row& r) { return r.energy.damping; }},
        {{"energy_numerical_J_m", "numerical dissipation", "J/m", 4}, [](const Row& r) { return r.energy.numerical; }},
        {{"energy_friction_J_m", "friction", "J/m", 4}, [](const Row& r) { return r.energy.friction; }},
        {{"energy_radiated_J_m", "radiated", "J/m", 4}, [](const Row& r) { return r.energy.radiated; }},
        {{"energy_external_J_m", "external work", "J/m", 4}, [](const Row& r) { return r.energy.external; }},
        {{"energy_contact_normal_J_m", "contact normal work", "J/m", 4},
         [](const Row& r) { return r.energy.contact_normal; }},
        {{"energy_imbalance_J_m", "energy imbalance", "J/m", 2}, &Row::imbalance}};
    if (water) all.push_back({{"water_force_x_N_m", "hydrodynamic force x", "N/m", 4}, &Row::water_force_x});
    return all;
}

} // namespace

Table tabulate(const History& history)
{
    Table table = table_of("history", columns(history.peak_water_force > 0.0), history.rows, history.notes);
    if (history.status != TiedRunStatus::complete) table.notes.insert(table.notes.begin(), history.status_text);
    return table;
}

} // namespace damslip::fe2d
