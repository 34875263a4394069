#pragma once

#include "fe2d/damping/rayleigh.hpp"

#include <functional>
#include <string>
#include <vector>

namespace damslip::fe2d {

/// What modified Rayleigh damping needs to know of a mode.
struct ModalMass {
    double frequency = 0.0;        ///< circular, ω_n [rad/s]
    double effective_mass_x = 0.0; ///< of horizontal ground motion [kg/m]
};

/// S_a(ω [rad/s], ζ [-]) [m/s^2]: peak absolute acceleration of the exact one-degree-of-freedom response to the
/// horizontal record.
using SpectralAcceleration = std::function<double(double frequency, double ratio)>;

struct ModifiedRayleighOptions {
    double ratio = 0.05;        ///< ζ wanted in every mode, 0 < ζ < 1 [-]
    std::size_t first_mode = 0; ///< i, index into the modes; keeps the ratio exactly
    std::size_t ordinary_mode =
        4;                   ///< j of ordinary Rayleigh, taken when there is no other solution; the last mode if fewer
    double total_mass = 0.0; ///< all mass that horizontal motion can move [kg/m], > 0
    double required_mass = 0.7; ///< share of it the modes must reach together [-]
    int scan_points = 400;      ///< frequencies of the scan, in geometric steps, >= 2
};

enum class ModifiedRayleighStatus {
    found,      ///< ΔS = 0 at second_frequency
    no_solution ///< ΔS keeps its sign: constants are those of ordinary Rayleigh, ΔS says what they miss
};

struct ModifiedRayleigh {
    RayleighConstants constants;
    ModifiedRayleighStatus status = ModifiedRayleighStatus::no_solution;
    double second_frequency = 0.0;    ///< ω_j [rad/s]
    std::vector<double> sign_changes; ///< all ω_j with ΔS = 0 in the scanned range, ascending [rad/s]
    double imbalance = 0.0;           ///< ΔS at ω_j [N/m]
    double relative_imbalance = 0.0;  ///< |ΔS| / Σ S_a(ω_n, ζ) m_eff,n [-]
    double mass_share = 0.0;          ///< effective mass of all modes given over the total [-]
    std::vector<std::string> warnings;
};

/// Rayleigh constants whose base shear over all modes is the one of the ratio ζ in every mode, Spears & Jensen (2012);
/// (2-58), (2-59): ω_i is the first mode's, ω_j solves
///
///     ΔS(ω_j) = Σ_n [S_a(ω_n, ζ_n) - S_a(ω_n, ζ)] m_eff,n = 0,    ζ_n = a_M/(2ω_n) + b_K ω_n/2
///
/// ΔS is scanned over (ω_i, 3 ω_max], every change of sign is bisected to a relative 1e-12 and listed, the smallest is
/// taken. ω_j need not be a natural frequency. None: ordinary Rayleigh on modes i and `ordinary_mode`, with a warning.
/// @param modes  at least `first_mode` + 1, ascending in frequency
ModifiedRayleigh modified_rayleigh(const std::vector<ModalMass>& modes,
                                   const SpectralAcceleration& spectral_acceleration,
                                   const ModifiedRayleighOptions& options);

/// ΔS(ω_j) of the formula above [N/m].
double shear_imbalance(const std::vector<ModalMass>& modes, const SpectralAcceleration& spectral_acceleration,
                       double ratio, const RayleighConstants& constants);

} // namespace damslip::fe2d
