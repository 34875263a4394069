#pragma once

#include "fe2d/model/model.hpp"

namespace damslip::fe2d {

/// Rest of a model on free edges of its rock box.
struct HeldStart {
    Eigen::VectorXd displacement; ///< on the unknowns of the model with free edges [m]
    Eigen::VectorXd load;         ///< on these [N/m], with the reactions of the edges
};

/// From fixed to free edges: dashpots hold nothing that stands still, so the static stages stand on fixed edges, and what
/// holds the edges there, K u on them, goes on as a constant load. The two models then rest at the same displacements,
/// and nothing moves before the ground does.
///
/// In the run displacements of the rock are u_total = u_ff + u, those of the dam u_total = r u_g + u: u_ff is the free
/// field, waves that go straight up and down in a homogeneous half space with the free surface y = 0,
///
///     u_ff(y, t) = ½ [u_g(t + y/c) + u_g(t - y/c)],   y <= 0,   u_ff(0, t) = u_g(t),
///
/// c_s for horizontal, c_p for vertical motion. It solves the rock's own equations and leaves its surface free of traction,
/// so it drops out of them; the dashpots resist u̇ alone, the waves that dam and rock send out; dam and rock meet where
/// u_ff = r u_g. The motion of the ground therefore loads the dam and its water only, as on massless rock, and the record
/// is the motion of the free surface. The same motion comes out of the direct method (Zienkiewicz, Bicanic & Shen 1989;
/// Løkke & Chopra 2017), which puts the stresses ρ c (2 u̇_up - u̇) of the incoming wave on the bottom and those of the free
/// field on the sides (verification/cases/fe_rock_cases.cpp compares). Left out: what the curtain's other modulus
/// scatters of the free field.
///
/// @param fixed, free  of one scene and base, apart from ModelOptions::edges
/// @param displacement, load  on the unknowns of `fixed`
HeldStart held_edges(const Model& fixed, const Model& free, const Eigen::VectorXd& displacement,
                     const Eigen::VectorXd& load);

/// Displacements on the unknowns of `fixed`: what its edges hold is left out.
Eigen::VectorXd without_edges(const Model& fixed, const Model& free, const Eigen::VectorXd& displacement);

} // namespace damslip::fe2d
