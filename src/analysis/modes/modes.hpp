#pragma once

#include "analysis/prepare/ready.hpp"
#include "analysis/prepare/records.hpp"
#include "core/parallel.hpp"
#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/fluid/coupled_system.hpp"
#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/harmonic/transfer.hpp"
#include "fe2d/rock/radiating_rock.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

/// What `modes` computes, as data; pages/modes shows it.
namespace damslip {

/// Rayleigh's constants from the two modes the scene names, or the last there is, and for each record modified ones.
struct DampingOfModes {
    Eigen::Index first_mode = 0, second_mode = 0;         ///< from 0
    double first_frequency = 0.0, second_frequency = 0.0; ///< circular [rad/s]
    fe2d::RayleighConstants rayleigh;
    struct OfRecord {
        std::string record;
        fe2d::ModifiedRayleigh found;
    };
    std::vector<OfRecord> modified;
};

/// Modes of dam and massless rock on a tied base, with added mass or with acoustic water.
struct ModesResult {
    Scene scene;   ///< as the plan calls for it, reservoir.model and added_mass.period decided
    std::optional<int> count; ///< modes asked for; none: ten, with acoustic water all up to coupled_modes_to
    std::optional<ReservoirChoice> choice;
    std::optional<DamPeriod> period;
    fe2d::Model model;
    std::optional<fe2d::FluidModel> water;        ///< acoustic
    std::optional<fe2d::CoupledModes> coupled;    ///< with acoustic water, up to coupled_modes_to
    std::vector<Eigen::Index> leading;            ///< of the coupled ones those that move the dam
    fe2d::NaturalModes modes;                     ///< without acoustic water; with it the leading ones, without shapes
    std::optional<DampingOfModes> damping;        ///< none: no modes, or no damping
    std::vector<fe2d::TransferPoint> transfer;    ///< 0.1 ... 20 Hz, on the rock of the scene; empty: not asked for
    std::optional<fe2d::RadiatingRock> radiating; ///< of the transfer functions; none: other rock

    bool complete() const; ///< every mode that was asked for was found
};

inline constexpr double coupled_modes_to = 20.0; ///< [Hz]
inline constexpr int usual_modes = 10;           ///< without acoustic water, where no number is asked for

struct ModesOptions {
    std::optional<int> count = {}; ///< modes; none: ten, with acoustic water all up to coupled_modes_to
    bool transfer = false;         ///< transfer functions, too
    bool damping = true;           ///< constants of damping, too; those of the records take many response spectra
    std::vector<double> frequencies = {}; ///< of the transfer functions [Hz]; empty: 0.1 ... 20
};

/// The leading coupled modes as modes of a structure, for what knows no water; without shapes.
fe2d::NaturalModes as_natural_modes(const fe2d::CoupledModes& modes, const std::vector<Eigen::Index>& leading);

/// @param ready  for finite elements
ModesResult compute_modes(const Ready& ready, const ModesOptions& options);

// Moduli and damping of a dam whose frequencies were measured.

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
