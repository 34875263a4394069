#pragma once

#include "fe2d/assembly/assemble.hpp"

namespace damslip::fe2d {

/// Dashpots along the sides and the bottom of the rock box, rho c_p across the edge and rho c_s along it, shared by the
/// nodes of every element edge: a diagonal matrix on the unknowns that are there [N s/m^2].
///
///     sigma_n = - rho c_p v_n,   tau = - rho c_s v_t        Lysmer & Kuhlemeyer (1969), eqs. 1, 2 with a = b = 1
///
/// Exact for plane waves that meet the edge at a right angle; a body wave at another angle comes back in part.
/// @param rock  density > 0
SparseMatrix edge_dashpots(const Mesh& mesh, const DofMap& dofs, const ElasticMaterial& rock);

/// Speeds of plane waves [m/s]: c_p of compression, c_s of shear.
struct ElasticWaves {
    double p = 0.0, s = 0.0;
};
ElasticWaves elastic_waves(const ElasticMaterial& material);

} // namespace damslip::fe2d
