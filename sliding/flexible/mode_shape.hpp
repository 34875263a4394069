#pragma once

#include "scene/scene.hpp"

namespace damslip::sliding {

/// L = sum m psi, M_1 = sum m psi^2 and the whole horizontal mass M, water included [kg/m].
struct ModalSums {
    double load = 0.0, mass = 0.0, total = 0.0;

    double mass_ratio() const { return load * load / (total * mass); } ///< Gamma [-]
};

/// Of the shape psi = (y/H)^n, y above the heel (0 below it), H of the crest: section, and the added mass of the water at the
/// scene's level. n -> 0 is a rigid mass, Gamma = 1.
ModalSums power_shape(const Scene& scene, double exponent);

} // namespace damslip::sliding
