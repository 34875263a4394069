#pragma once

#include <numbers>

namespace damslip::sliding {

/// One mode of a sliding mass that is not rigid.
struct FlexibleBlock {
    double period = 0.0;         ///< T_s, > 0, of the mode on a base that does not slide [s]
    double damping_ratio = 0.05; ///< zeta of the mode, 0 ... 0.5 [-]
    /// Gamma = L^2/(M M_1) with L = sum m psi, M_1 = sum m psi^2: effective mass of the mode over the sliding mass [-],
    /// > 0, <= 0.95. A uniform shear column, psi = sin(pi y/2H), has 8/pi^2 = 0.81.
    double mass_ratio = 8.0 / (std::numbers::pi * std::numbers::pi);
};

} // namespace damslip::sliding
