#include "fe2d/statics/stress.hpp"

#include <cmath>

namespace damslip::fe2d {

StressField stress_field(const Mesh& mesh, const DofMap& dofs, const Materials& materials,
                         const Eigen::VectorXd& displacement)
{
    const Eigen::VectorXd u = nodal_values(dofs, displacement);
    StressField field{.nodal = Eigen::Matrix3Xd::Zero(3, mesh.node_count()),
                      .centre = Eigen::Matrix3Xd::Zero(3, mesh.element_count())};
    Eigen::VectorXi elements_at = Eigen::VectorXi::Zero(mesh.node_count());
    for (int e = 0; e < mesh.element_count(); ++e) {
        const Element& element = mesh.elements[e];
        const int size = element.size();
        const ElementNodes nodes = element.all();
        const ExtraNodes extra = extra_nodes(element);
        ElementVector ue(2 * nodes.count);
        for (int i = 0; i < nodes.count; ++i) ue.segment<2>(2 * i) = u.segment<2>(2 * nodes[i]);
        const Eigen::Matrix3d d = plane_strain_matrix(materials.of(element.region));
        const Corners c = corners(mesh, element);
        const auto at_nodes = nodal_stress(c, size, d, materials.kind, ue, extra);
        field.centre.col(e) = centre_stress(c, size, d, materials.kind, ue, extra);
        for (int i = 0; i < nodes.count; ++i) {
            field.nodal.col(nodes[i]) += at_nodes.col(i);
            ++elements_at[nodes[i]];
        }
    }
    for (int n = 0; n < mesh.node_count(); ++n)
        if (elements_at[n] > 0) field.nodal.col(n) /= elements_at[n];
    return field;
}

PrincipalStress principal_stress(const Eigen::Vector3d& stress)
{
    const double mean = 0.5 * (stress[0] + stress[1]), half = 0.5 * (stress[0] - stress[1]);
    const double radius = std::hypot(half, stress[2]);
    return {mean + radius, mean - radius, 0.5 * std::atan2(stress[2], half)};
}

} // namespace damslip::fe2d
