#pragma once

#include "analysis/prepare/ready.hpp"
#include "analysis/prepare/records.hpp"
#include "fe2d/damping/damping.hpp"
#include "fe2d/fluid/coupled_modes.hpp"
#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/harmonic/transfer.hpp"
#include "fe2d/modes/natural_modes.hpp"
#include "fe2d/rock/radiating_rock.hpp"

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

} // namespace damslip
