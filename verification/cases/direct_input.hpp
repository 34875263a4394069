#pragma once

#include "fe2d/model/model.hpp"
#include "fe2d/time/linear_integrator.hpp"
#include "verification/exact/free_field.hpp"

namespace damslip::verification {

/// The direct method: total displacements, the wave brought in by forces on the edges of the rock box (Zienkiewicz, Bicanic
/// & Shen 1989; Løkke & Chopra 2017). Beside the dashpots C stands on each edge, per length,
///
///     C u̇_ff + σ_ff n,   on the bottom together 2 ρ c u̇_up, u̇_up = ½ u̇_g(t + H/c) the wave that comes up.
///
/// A second way to what fe2d does in motion relative to the free field (held_edges.hpp).
class DirectInput {
public:
    /// @param model  with free edges and rock that has mass
    /// @param horizontal, vertical  of the free surface; amplitude 0: none
    DirectInput(const fe2d::Model& model, const exact::SurfacePulse& horizontal, const exact::SurfacePulse& vertical);

    Eigen::VectorXd load(double time) const; ///< on all unknowns of the model [N/m]
    const exact::FreeField& horizontal() const { return horizontal_; }
    const exact::FreeField& vertical() const { return vertical_; }

private:
    void add(const fe2d::NodeChain& chain, double normal_x, double normal_y, double time, Eigen::VectorXd& load) const;

    const fe2d::Model& model_;
    double shear_modulus_, lame_, density_;
    fe2d::ElasticWaves waves_;
    exact::FreeField horizontal_, vertical_;
};

/// The rock of a model alone (Base::separate): its unknowns are those behind the dam's.
struct RockAlone {
    Eigen::Index first = 0; ///< of its unknowns in the model
    fe2d::LinearSystem system;

    explicit RockAlone(const fe2d::Model& model);
};

} // namespace damslip::verification
