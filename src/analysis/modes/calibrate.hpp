#pragma once

#include "core/watch.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

/// Moduli and damping of a dam whose frequencies were measured.
namespace damslip {

struct MeasuredFrequency {
    double frequency = 0.0;           ///< [Hz]
    std::optional<double> level = {}; ///< of the water above the heel, 0: none [m]; none: the scene's
    int mode = 1;                     ///< of the dam, 1 or 2
};

struct CalibrateOptions {
    std::vector<MeasuredFrequency> measured; ///< one at least
    double scatter = 0.02;                   ///< standard deviation of each measured frequency over it [-]
    std::optional<double> damping = {};      ///< ratio of the first mode as measured, with all that waves take away [-]
    StopAsked stop = {};
};

/// A modulus before and after, and the standard deviation of its logarithm.
struct FittedModulus {
    std::string key;                  ///< "dam.young_modulus_GPa"
    double before = 0.0, after = 0.0; ///< [Pa]
    double beta = 0.0;                ///< [-]
};

struct FittedFrequency {
    MeasuredFrequency measured;
    double before = 0.0, after = 0.0;   ///< of the scene and of the calibrated scene [Hz]
    double by_dam = 0.0, by_rock = 0.0; ///< d ln f / d ln E of each modulus [-]
};

/// Damping of the structure that makes the first mode's as measured, beside what its rock and water take away.
struct FittedDamping {
    double measured = 0.0, ratio = 0.0; ///< [-]
    double waves =
        0.0; ///< measured less ratio: waves into rock and water; negative where a_M does not act on added mass [-]
};

struct Calibration {
    Scene scene; ///< as given, with the values found
    std::vector<FittedModulus> moduli;
    std::vector<FittedFrequency> frequencies;
    std::optional<double> rank_correlation; ///< of the two moduli (Spearman) [-]
    std::optional<FittedDamping> damping;   ///< none: not asked for, or the waves alone take more
    double misfit = 0.0;                    ///< root mean square of ln(measured / calibrated) [-]
    std::vector<std::string> notes;
};

/// Weighted least squares in the logarithms of the moduli: minimises the sum of (ln f_measured - ln f)^2. Frequencies are those of
/// compute_modes(): tied base, massless rock, water as the scene has it ("auto" as decided for the scene once). The rock's modulus is
/// fitted where there are two frequencies or more and they tell it to a factor of two; else it stays.
/// Covariance of the logarithms: scatter^2 (J^T J)^-1; one frequency of a dam on a rigid base: 2 scatter.
/// @throws InputError  for what the scene cannot be measured against, NotConverged where no modulus gives the frequencies
Calibration calibrate(const Scene& given, const CalibrateOptions& options);

} // namespace damslip
