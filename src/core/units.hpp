#pragma once

#include <numbers>

/// SI inside, other units at the edges only. A conversion is a factor `1 unit = factor SI units`.
namespace damslip::units {

inline constexpr double standard_gravity =
    9.80665;                        ///< the unit "g" of files, outputs and regressions [m/s^2]; ISO 80000-3
inline constexpr double gal = 0.01; ///< 1 Gal = 1 cm/s^2 [m/s^2]
inline constexpr double cm = 0.01;  ///< [m]
inline constexpr double mm = 0.001; ///< [m]
inline constexpr double MPa = 1e6;  ///< [Pa]
inline constexpr double kPa = 1e3;  ///< [Pa]
inline constexpr double GPa = 1e9;  ///< [Pa]
inline constexpr double degree = std::numbers::pi / 180.0; ///< [rad]

/// Frequency [Hz] of a circular frequency [rad/s].
constexpr double hertz(double circular)
{
    return circular / (2.0 * std::numbers::pi);
}

} // namespace damslip::units
