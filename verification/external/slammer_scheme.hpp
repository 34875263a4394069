#pragma once

#include <optional>
#include <span>
#include <vector>

/// The flexible analyses of SLAMMER 1.1 step by step, as its manual and its public source describe them (Jibson, Rathje,
/// Jibson & Lee 2013, USGS Techniques and Methods 12-B1): Newmark's average acceleration at the samples of the record, slip by the
/// trapezoid rule. Written to tell its steps' error from ours; no analysis of this program uses them.
namespace damslip::external {

/// One shear mode of a column on its base, Gamma = 8/pi^2. x'' + 2 zeta omega x' + omega^2 x = a on a base that does not slip.
struct SlammerColumn {
    double omega = 0.0;   ///< pi V_s/(2 H) [rad/s]
    double damping = 0.0; ///< zeta, of soil and foundation together [-]
};

struct SlammerResponse {
    std::vector<double> drive;                            ///< k = a - Gamma x'' at the samples [m/s^2]
    double largest_drive = 0.0, largest_deflection = 0.0; ///< |k| [m/s^2], |x| [m]
};

/// @param accel  [m/s^2], > 0 drives the slip  @param dt  [s]
SlammerResponse slammer_response(const SlammerColumn& column, std::span<const double> accel, double dt);

/// Slip one way of a block on the drive of slammer_response() [m]. A movement starts at the first sample above the yield, and
/// the step in which it stops is dropped.
double slammer_decoupled(std::span<const double> drive, double dt, double yield);

/// Slip and vibration at the same time [m]; the step in which a movement stops is divided.
double slammer_coupled(const SlammerColumn& column, std::span<const double> accel, double dt, double yield);

/// A column whose shear wave velocity and damping follow its strain.
struct StrainColumn {
    double height = 0.0;           ///< [m]
    double velocity = 0.0;         ///< V_s at small strain [m/s]
    double base_velocity = 0.0;    ///< of the rock below [m/s]
    double damping = 0.0;          ///< at small strain, of the soil alone, where the iteration begins [-]
    double reference_strain = 0.0; ///< [%]
};

struct StrainCompatible {
    double velocity = 0.0; ///< V_s [m/s]
    double damping = 0.0;  ///< of soil and foundation [-]
    int iterations = 0;
};

/// Equivalent-linear iteration until velocity squared and soil damping change by less than 5 %: effective strain
/// 0.65 · 1.57 u_max/H, V_s = V_0/sqrt(1 + gamma/gamma_r), soil damping of Darendeli's form (1 % + 0.62 (G/G_0)^0.1 times
/// Masing's), foundation damping 55.016 (V_base/V_s)^-0.9904 %, at most 20 %. @returns nothing where it does not settle
std::optional<StrainCompatible> slammer_equivalent_linear(const StrainColumn& column, std::span<const double> accel,
                                                          double dt);

} // namespace damslip::external
