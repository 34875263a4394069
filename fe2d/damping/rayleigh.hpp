#pragma once

namespace damslip::fe2d {

/// C = a_M M + b_K K, (2-52).
struct RayleighConstants {
    double mass = 0.0;      ///< a_M [1/s]
    double stiffness = 0.0; ///< b_K [s]
};

/// The constants that give the ratio at two frequencies, (2-56), (2-57):
///
///     a_M = 2 ζ ω_i ω_j / (ω_i + ω_j),   b_K = 2 ζ / (ω_i + ω_j)
///
/// Table 5-5 of the thesis prints a_M = 0.422 for 5 % at 1.54 and 2.29 Hz; it is 0.579.
/// @param ratio  ζ >= 0 [-]
/// @param first_frequency, second_frequency  ω_i, ω_j > 0 [rad/s]; may be equal
RayleighConstants rayleigh_constants(double ratio, double first_frequency, double second_frequency);

/// ζ(ω) = a_M/(2ω) + b_K ω/2 [-], (2-55); below the given ratio between the two frequencies, above it outside.
double damping_ratio(const RayleighConstants& constants, double frequency);

} // namespace damslip::fe2d
