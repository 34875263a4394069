#pragma once

#include "fe2d/time/integrate.hpp"

namespace damslip::fe2d {

/// Share of the stability limit that a step chosen by the program stays below: Lanczos' method finds the highest frequency from
/// below, and within a few per cent of the limit the highest modes ring long.
inline constexpr double explicit_step_share = 0.9;

/// What the steps of an explicit run are bounded by.
struct ExplicitLimit {
    double highest_frequency = 0.0; ///< ω of M⁻¹K, M lumped, by 80 steps of Lanczos' method [rad/s]
    double dt = 0.0;                ///< central_difference_limit() [s]
    double dt_undamped = 0.0;       ///< the same with b_K = 0 [s]
    std::string text() const;       ///< one sentence with the numbers
};
ExplicitLimit explicit_limit(const SparseMatrix& lumped, const SparseMatrix& stiffness, double stiffness_damping);

/// The step asked for, or the largest whole part of the motion's step below explicit_step_share of the limit [s].
/// @param asked  time.dt_s @throws InputError when it is above the limit, with both numbers
double explicit_step(double motion_dt, std::optional<double> asked, const ExplicitLimit& limit);

/// The run of integrate() by central differences with lumped mass (CentralDifference). Massless rock is condensed, which leaves
/// no massless unknown; rock with mass stays whole. `options.scheme` is not used. Quadratic elements need a model with
/// MassKind::lumped (their row sums are not positive).
///
/// Rows are kept at the motion's steps, peaks and energies see every step.
/// @throws InputError for a step above the limit, acoustic water, massless unknowns (RockTreatment::whole), damping that is neither
///         mass- nor stiffness-proportional
History integrate_explicit(const Model& model, const GroundMotion& motion, const TiedRunOptions& options);

} // namespace damslip::fe2d
