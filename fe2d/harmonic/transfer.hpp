#pragma once

#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/time/structure_system.hpp"

#include <complex>
#include <vector>

namespace damslip::fe2d {

/// Steady answer to a horizontal ground acceleration of 1 m/s², positive downstream, on a tied base.
struct TransferPoint {
    double frequency = 0.0;     ///< [Hz]
    std::complex<double> crest; ///< absolute acceleration of the crest's upstream end in x, per ground acceleration [-]
    std::complex<double>
        water_force;     ///< on the dam in x, beyond the static one [N/m per m/s²]; 0 without acoustic water
    bool regular = true; ///< false: an undamped resonance, no value
};

/// @param structure    structure_system of the model
/// @param water        acoustic water, or null; the model then has no added mass
/// @param frequencies  > 0 [Hz]
std::vector<TransferPoint> transfer_functions(const Model& model, const StructureSystem& structure,
                                              const FluidModel* water, const std::vector<double>& frequencies);

} // namespace damslip::fe2d
