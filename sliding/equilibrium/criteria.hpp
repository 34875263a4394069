#pragma once

#include "sliding/equilibrium/limit_equilibrium.hpp"

namespace damslip::sliding {

/// The combination's own required values; what it leaves open from the scene's criteria document.
/// Errors: InputError for an unknown document or resultant word.
Requirements requirements(const Scene& scene, const Combination& combination);

} // namespace damslip::sliding
