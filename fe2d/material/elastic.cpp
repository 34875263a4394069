#include "fe2d/material/elastic.hpp"

#include "core/input_error.hpp"

namespace damslip::fe2d {

Eigen::Matrix3d plane_strain_matrix(const ElasticMaterial& material)
{
    const double nu = material.poisson_ratio;
    const double factor = material.young_modulus / ((1.0 + nu) * (1.0 - 2.0 * nu));
    Eigen::Matrix3d d;
    d << 1.0 - nu, nu, 0.0, //
        nu, 1.0 - nu, 0.0,  //
        0.0, 0.0, 0.5 - nu;
    return factor * d;
}

ElasticMaterial plane_stress_equivalent(const ElasticMaterial& material)
{
    const double nu = material.poisson_ratio;
    return {material.density, material.young_modulus * (1.0 + 2.0 * nu) / ((1.0 + nu) * (1.0 + nu)), nu / (1.0 + nu)};
}

double out_of_plane_stress(const ElasticMaterial& material, const Eigen::Vector3d& stress)
{
    return material.poisson_ratio * (stress[0] + stress[1]);
}

ElasticMaterial elastic_material(const Material& material, const Scene& scene, const char* key)
{
    if (!material.young_modulus)
        throw InputError(Diagnostic{.file = scene.file.string(),
                                    .problem = std::string(key) + ".young_modulus is missing.",
                                    .expected = "a number > 0; finite elements need it (concrete: 20 to 35 GPa)",
                                    .fix = std::string("add  young_modulus_GPa = ...  to [") + key + "]"});
    return {material.density, *material.young_modulus, material.poisson_ratio};
}

} // namespace damslip::fe2d
