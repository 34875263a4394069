#pragma once

#include "records/record.hpp"

namespace damslip::exact {

struct TwoSlips {
    double base = 0.0;  ///< of the lower block on the ground, positive downstream [m]
    double joint = 0.0; ///< of the upper block on the lower [m]
};

/// Two rigid blocks on each other under the ground's acceleration: velocities with Coulomb impulses at the end of very
/// short steps (Moreau 1988), each pair of impulses by projected Gauss-Seidel. First order in dt, here 4e-5 s; until 5 s
/// after the record's end.
/// @param lower, upper  masses [kg/m]
TwoSlips two_blocks(const GroundMotion& motion, double lower, double upper, double mu_base, double mu_joint);

} // namespace damslip::exact
