#pragma once

#include <span>

namespace damslip::records {

/// Largest absolute values of the ground motion that starts from rest, and where it ends.
struct Peaks {
    double acceleration = 0.0;       ///< [m/s^2]
    double acceleration_time = 0.0;  ///< of the first sample that reaches it [s]
    double velocity = 0.0;           ///< [m/s]
    double displacement = 0.0;       ///< [m]
    double final_velocity = 0.0;     ///< [m/s], with its sign
    double final_displacement = 0.0; ///< [m], with its sign
};

/// Exact for acceleration linear between samples: velocity is quadratic and displacement cubic there, and their
/// extremes inside an interval (zeros of the acceleration and of the velocity) count.
/// @param accel  [m/s^2]   @param dt  [s], > 0
Peaks motion_peaks(std::span<const double> accel, double dt);

} // namespace damslip::records
