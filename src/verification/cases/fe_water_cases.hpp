#pragma once

#include "verification/cases/registry.hpp"

namespace damslip::verification {

/// Modes, time domain and coupling of acoustic water; part of add_fe_fluid_cases.
void add_fe_water_cases(Registry& registry);

} // namespace damslip::verification
