#include "verification/cases/registry.hpp"

#include "verification/cases/modules.hpp"

#include <cmath>

namespace damslip::verification {

double Check::error() const
{
    const double difference = std::abs(computed - expected);
    return measure == Measure::relative && expected != 0.0 ? difference / std::abs(expected) : difference;
}

bool Check::passed() const
{
    if (!std::isfinite(computed)) return false;
    switch (measure) {
    case Measure::upper_bound:
        return computed <= expected;
    case Measure::lower_bound:
        return computed >= expected;
    default:
        return error() <= tolerance;
    }
}

Registry all_cases()
{
    Registry registry;
    add_record_cases(registry);
    add_block_cases(registry);
    add_block_rate_cases(registry);
    add_empirical_cases(registry);
    add_load_cases(registry);
    add_equilibrium_cases(registry);
    add_rocking_cases(registry);
    add_neighbour_cases(registry);
    add_wedge_cases(registry);
    add_plane_cases(registry);
    add_anchor_cases(registry);
    add_probability_cases(registry);
    add_probability_sampling_cases(registry);
    add_probability_command_cases(registry);
    add_fe_core_cases(registry);
    add_fe_quadratic_cases(registry);
    add_fe_import_cases(registry);
    add_fe_modes_cases(registry);
    add_fe_fluid_cases(registry);
    add_fe_water_cases(registry);
    add_fe_time_cases(registry);
    add_fe_integrator_cases(registry);
    add_fe_contact_cases(registry);
    add_fe_friction_cases(registry);
    add_fe_rate_cases(registry);
    add_fe_joint_cases(registry);
    add_fe_bond_cases(registry);
    add_fe_joint_water_cases(registry);
    add_opening_block_cases(registry);
    add_fe_rock_cases(registry);
    add_fe_radiating_cases(registry);
    add_fe_radiating_tied_cases(registry);
    add_fe_rock_floor_cases(registry);
    add_fe_wave_contact_cases(registry);
    add_fe_sliding_cases(registry);
    add_fe_pairing_cases(registry);
    add_fe_moreau_cases(registry);
    add_fe_explicit_contact_cases(registry);
    add_fe_reduction_cases(registry);
    add_fe_seepage_cases(registry);
    add_fe_anchor_cases(registry);
    return registry;
}

} // namespace damslip::verification
