#pragma once

#include "core/csv.hpp"
#include "scene/scene.hpp"

namespace damslip::study {

/// One mode as Goldgruber (2015) prints it, and as it came out.
struct ModeBeside {
    double printed_frequency = 0.0, frequency = 0.0; ///< [Hz]
    double printed_mass_sum = 0.0, mass_sum = 0.0;   ///< effective mass in x, sum of the listed modes [%]
};

/// Five modes and the Rayleigh constants of the first and fifth of one model.
struct ModelModes {
    std::string water; ///< "acoustic", "westergaard"
    double size = 1.0;
    std::vector<ModeBeside> modes;
    double printed_mass_coefficient = 0.0, mass_coefficient = 0.0;           ///< [1/s]
    double printed_stiffness_coefficient = 0.0, stiffness_coefficient = 0.0; ///< [s]
};

/// The four models of tables 4-3 and 4-4: acoustic and rigorous Westergaard, sizes 1 and 2.
std::vector<ModelModes> study_modes(const Scene& scene);

/// Tables 4-3 (size 1) and 4-4 (size 2), printed values beside.
Table modes_table(const std::vector<ModelModes>& models, double size);

} // namespace damslip::study
