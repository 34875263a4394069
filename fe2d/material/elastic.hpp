#pragma once

#include "scene/scene.hpp"

#include <Eigen/Core>

namespace damslip::fe2d {

/// Linear elastic isotropic material.
struct ElasticMaterial {
    double density = 0.0;       ///< [kg/m^3]; 0: massless
    double young_modulus = 0.0; ///< [Pa], > 0
    double poisson_ratio = 0.0; ///< [-], 0 <= nu < 0.5
};

/// Stress (xx, yy, xy) of plane strain from strain (xx, yy, 2 xy): D of sigma = D epsilon [Pa]; tension positive.
Eigen::Matrix3d plane_strain_matrix(const ElasticMaterial& material);

/// The material whose plane strain matrix is the plane stress matrix of `material`, same density:
///     E' = E (1 + 2 nu) / (1 + nu)^2,   nu' = nu / (1 + nu).
/// For comparing with published plane stress results; the out-of-plane stress has no meaning then.
ElasticMaterial plane_stress_equivalent(const ElasticMaterial& material);

/// Stress normal to the plane in plane strain: nu (sigma_xx + sigma_yy) [Pa].
double out_of_plane_stress(const ElasticMaterial& material, const Eigen::Vector3d& stress);

/// Checked material of a scene. @throws InputError naming `key` when there is no Young's modulus: FE needs one.
ElasticMaterial elastic_material(const Material& material, const Scene& scene, const char* key);

} // namespace damslip::fe2d
