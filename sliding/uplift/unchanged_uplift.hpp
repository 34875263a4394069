#pragma once

#include "sliding/uplift/crack.hpp"

namespace damslip::sliding {

/// cracked_base() where the uplift stays as it is, whatever opens: the same bits, without asking for the profile of each
/// crack that is looked at.
CrackedBase cracked_base_unchanged(const BaseLoad& load, double length, const PressureProfile& profile);

} // namespace damslip::sliding
