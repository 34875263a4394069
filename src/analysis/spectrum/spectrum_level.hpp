#pragma once

#include "analysis/modes/modes.hpp"
#include "analysis/prepare/flexible_mass.hpp"
#include "analysis/prepare/ready.hpp"

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// The dam by its response spectrum: linear, on a bonded base, peaks of the modes instead of a history.
namespace damslip {

/// S_a of one earthquake.
struct LevelSpectrum {
    std::string name;                                   ///< of the record or of the file
    double ratio = 0.05;                                ///< damping it is for [-]
    std::function<double(double period)> acceleration;  ///< S_a(T), T >= 0 [s], PGA at T = 0 [m/s^2]
    std::function<double(double period)> vertical = {}; ///< the same of the vertical component; empty: without one
};

/// The spectra of a record's components at a damping ratio; a vertical one where it has that component.
LevelSpectrum spectrum_of(const std::string& name, const GroundMotion& motion, double ratio);

/// One mode under one spectrum.
struct ModeShare {
    double frequency = 0.0;      ///< [Hz]
    double effective_mass = 0.0; ///< Gamma^2, horizontal [kg/m]
    double acceleration = 0.0;   ///< S_a [m/s^2]
    double base_shear = 0.0;     ///< of its peak, along the base, downstream [N/m]
};

/// Above one level, of the earthquake alone; combined peaks, >= 0.
struct LevelForce {
    double level = 0.0;   ///< y [m]
    double lateral = 0.0; ///< shear here less the shear at the next level above: equivalent lateral force [N/m]
    double shear = 0.0;   ///< [N/m]
    double moment = 0.0;  ///< about the middle of the section [N m/m]
    double stress = 0.0;  ///< vertical, of the beam, at both faces: +- M c/I and N/A together; the larger [Pa]
};

/// What one component of the earthquake does, or both together: peaks about the base, and with the static loads. Each
/// on its own, whichever way it goes; what is with the static loads is its worst.
struct ComponentDemand {
    std::string motion;                      ///< "horizontal", "vertical", "both, SRSS", "both, 100/30"
    double shear = 0.0;                      ///< along the base [N/m]
    double normal = 0.0;                     ///< across it [N/m]
    double moment = 0.0;                     ///< about the middle of the base [N m/m]
    double heel_least = 0.0, toe_most = 0.0; ///< with the static one, compression positive [Pa]
    double sliding_factor = 0.0;             ///< (c A' + mu N')/T downstream; 0: no strength is left at the worst [-]
    double overturning_factor = 0.0;         ///< about the toe [-]
};

/// One spectrum: peaks of modes combined, beside and on top of the static loads. All about the base, its directions.
struct SpectrumDemand {
    std::string record;
    double pga = 0.0;                     ///< [m/s^2]
    std::vector<ModeShare> modes;         ///< lowest first
    double residual_mass = 0.0;           ///< what the modes leave of the total mass; moves with the ground [kg/m]
    double shear_srss = 0.0, shear = 0.0; ///< base shear, without and with (CQC) correlation of the modes [N/m]
    double moment = 0.0;                  ///< about the middle of the base [N m/m]
    double normal_with_shear = 0.0;       ///< compression most likely at the instant of the peak shear downstream [N/m]
    double heel_stress = 0.0, toe_stress = 0.0; ///< peaks, vertical stress of the beam, of the earthquake alone [Pa]
    double crest = 0.0;                         ///< of the crest's upstream end against the ground [m]
    std::vector<LevelForce> levels;             ///< from the base up

    double heel_least = 0.0, heel_most = 0.0; ///< with the static one, compression positive [Pa]
    double toe_least = 0.0, toe_most = 0.0;
    double sliding_factor = 0.0;     ///< (c A' + mu N')/T downstream, both with the earthquake [-]
    double overturning_factor = 0.0; ///< about the toe [-]
    double coefficient = 0.0;        ///< base shear over the weight of the moving mass [-]

    // Where the spectrum has a vertical component; empty without. All above is of the horizontal one.
    double vertical_pga = 0.0;               ///< [m/s^2]
    std::vector<ModeShare> vertical_modes;   ///< masses and forces up, across the base
    double vertical_residual_mass = 0.0;     ///< [kg/m]
    std::vector<ComponentDemand> components; ///< horizontal, vertical, SRSS, 100/30
};

struct SpectrumLevel {
    double total_mass = 0.0;                               ///< of dam and added mass, horizontal [kg/m]
    double vertical_mass = 0.0;                            ///< the same, vertical; 0: no vertical spectrum [kg/m]
    double ratio = 0.05;                                   ///< damping [-]
    std::string water;                                     ///< "acoustic water", "added mass", "no water that moves"
    double static_shear = 0.0, static_normal = 0.0;        ///< T, N' [N/m]
    double static_heel = 0.0, static_toe = 0.0;            ///< effective, linear [Pa]
    double static_sliding = 0.0, static_overturning = 0.0; ///< factors [-]
    std::vector<SpectrumDemand> rows;
    std::vector<std::string> notes;
};

/// Modes of dam and massless rock on a tied base, with the water of the scene; the mass that they leave moves rigidly with
/// the ground and is combined by the root of squares. Equivalent static forces of mode n: Gamma_n K phi_n S_a / omega_n^2.
/// The static state has no crack, N' linear over the base. Factors of the horizontal earthquake take the peak shear with the
/// normal force that comes with it. Components are independent of each other. "SRSS": the root of the sum of their squares;
/// the sliding factor is the least on the ellipse of T and N' that goes with it (Menun & Der Kiureghian 2000). "100/30": all
/// of one and 0.3 of the other, the worst of the four (two ways of the vertical one).
/// @param ready  for finite elements @param given  in place of the records' spectra; empty: the records'
/// @throws InputError, NotConverged, Interrupted
SpectrumLevel spectrum_level(const Ready& ready, const std::vector<LevelSpectrum>& given = {});

/// Those of modes found. @param modes  with shapes @throws NotConverged where modes or the static pressure were not found
ModalForces modal_forces(const ModesResult& modes, ModalDirection direction = ModalDirection::horizontal);

} // namespace damslip
