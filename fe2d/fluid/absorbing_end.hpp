#pragma once

#include "fe2d/fluid/water_boundary.hpp"

#include <Eigen/SparseCore>

#include <vector>

namespace damslip::fe2d {

/// What a boundary adds to Q, A, L.
struct FluidTriplets {
    std::vector<Eigen::Triplet<double>> mass, damping, stiffness;
};

/// Nodes of a vertical far end, and what bounds the water beyond it above and below.
struct EndColumn {
    std::vector<double> y;           ///< surface to bottom, decreasing [m]
    std::vector<Eigen::Index> place; ///< unknown of each node; -1: p = 0 there
    double bottom_admittance = 0.0;  ///< of the bottom beyond the end [m/(Pa s)]
    double surface_mass = 0.0;       ///< 1/(ρ g) of a sloshing surface there [m/Pa], else 0
    double bottom_load = 0.0;        ///< -1 where the bottom moves with the ground (n_y), else 0
};

/// Unknowns an absorbing end adds, numbered from `first`: pressures of the layers, then their vertical momenta.
struct AbsorbingEnd {
    Eigen::Index pressures = 0, momenta = 0;
    FluidTriplets entries;
    /// Load on the layers by a bottom that moves: beside the face's flux times the ground's acceleration the end takes these times its
    /// velocity (cosine layers) and its acceleration (decay layers).
    std::vector<Eigen::Triplet<double>> velocity_load, acceleration_load; ///< (unknown, 0, value)
};

/// The infinite channel of constant depth beyond a vertical far end, in layers of linear elements integrated at their middle
/// (continued-fraction absorbing boundary: Guddati & Tassoulas 2000; Guddati & Lim 2006; also called perfectly matched discrete layers).
///
/// Beyond the end the discrete depth column obeys  M₁ p_xx = S(s) p, M₁ = ∫NN/ρ dy, S = L_y + s A_y + s² Q_y with everything the channel
/// has above and below. One such element of length l is  M₁/l [1 -1; -1 1] + S l/4 [1 1; 1 1],  and a channel behind it looks through
/// it unchanged, whatever l, because (1/l + λl/4)² - (-1/l + λl/4)² = λ. The error is that of what stands behind the last one (a wall):
/// a mode of wave number k comes back with Π ((k - a_j)/(k + a_j))², a_j = 2/l_j.
///  - a = s cos θ/c, l = 2c/(s cos θ), is exact for waves that leave at the angle θ to the axis, which is how a depth mode above its cut-off
///    frequency travels: cos θ = √(1 - ω_n²/ω²). The damper of Lysmer & Kuhlemeyer is the crude form for θ = 0.
///  - a = decay / depth, a real length, is exact for a field that decays so: the depth modes below their cut-off.
/// S l/4 of the first kind holds L_y/s. It is made of first-order unknowns w, one per depth element and layer, the vertical momentum of
/// the water there: (β/ρh)(Δq)²/s = stationary value over w of 2 w Δq - (s ρ h/β) w², β = c/(2 cos θ), q the sum of the element's two
/// pressures; so Q, A, L stay real, symmetric and constant. Q and A have the signs of an energy and a loss on the pressures, A the opposite
/// one on w: [pressures | w] is symmetric quasi-definite in every implicit step.
/// A bottom in uniform motion drives the channel too: its own field does not depend on x and passes through unchanged (the wall at the end).
AbsorbingEnd absorbing_end(const EndColumn& column, const FluidOptions& water, Eigen::Index first);

} // namespace damslip::fe2d
