#pragma once

#include "fe2d/time/linear_integrator.hpp"

#include <vector>

/// Small systems with many unknowns for tests of time integration; no physical meaning beyond that.
namespace damslip::verification {

/// m u'' + 2ζω m u' + ω² m u = R, one unknown.
fe2d::LinearSystem oscillator(double omega, double damping_ratio, double mass = 1.0);

/// nx x ny points joined by springs of uneven stiffness to their neighbours and, along the lowest row, to the ground.
/// Unknown of point (i, j): i + j nx. Masses uneven, with neighbour coupling (consistent), zero in the lowest
/// `massless_rows`.
struct LatticeOptions {
    Eigen::Index nx = 4, ny = 6;
    Eigen::Index massless_rows = 0;
    double mass_coefficient = 0.0;      ///< a_M [1/s]
    double stiffness_coefficient = 0.0; ///< b_K [s]
};
fe2d::LinearSystem lattice(const LatticeOptions& options);

/// A smooth but uneven vector, always the same: entries of order one.
Eigen::VectorXd uneven_vector(Eigen::Index size, double phase);

} // namespace damslip::verification
