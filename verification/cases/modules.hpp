#pragma once

#include "verification/cases/registry.hpp"

/// One function per file of this folder; each appends its cases.
namespace damslip::verification {

void add_record_cases(Registry& registry);
void add_block_cases(Registry& registry);
void add_block_rate_cases(Registry& registry);
void add_empirical_cases(Registry& registry);
void add_load_cases(Registry& registry);
void add_equilibrium_cases(Registry& registry);
void add_rocking_cases(Registry& registry);
void add_neighbour_cases(Registry& registry);
void add_wedge_cases(Registry& registry);
void add_plane_cases(Registry& registry);
void add_anchor_cases(Registry& registry);
void add_probability_cases(Registry& registry);
void add_probability_sampling_cases(Registry& registry);
void add_probability_command_cases(Registry& registry);
void add_fe_core_cases(Registry& registry);
void add_fe_quadratic_cases(Registry& registry);
void add_fe_import_cases(Registry& registry);
void add_fe_modes_cases(Registry& registry);
void add_fe_fluid_cases(Registry& registry);
void add_fe_water_cases(Registry& registry);
void add_fe_time_cases(Registry& registry);
void add_fe_integrator_cases(Registry& registry);
void add_fe_contact_cases(Registry& registry);
void add_fe_friction_cases(Registry& registry);
void add_fe_rate_cases(Registry& registry);
void add_fe_wave_contact_cases(Registry& registry);
void add_fe_pairing_cases(Registry& registry);
void add_fe_moreau_cases(Registry& registry);
void add_fe_explicit_contact_cases(Registry& registry);
void add_fe_reduction_cases(Registry& registry);
void add_fe_seepage_cases(Registry& registry);
void add_fe_anchor_cases(Registry& registry);
void add_fe_sliding_cases(Registry& registry);
void add_fe_joint_cases(Registry& registry);
void add_fe_bond_cases(Registry& registry);
void add_fe_joint_water_cases(Registry& registry);
void add_opening_block_cases(Registry& registry);
void add_fe_rock_cases(Registry& registry);
void add_fe_radiating_cases(Registry& registry);
void add_fe_radiating_tied_cases(Registry& registry);
void add_fe_rock_floor_cases(Registry& registry);

} // namespace damslip::verification
