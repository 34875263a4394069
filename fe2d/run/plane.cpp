#include "fe2d/run/contact_planes.hpp"

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

MatrixXd rows_to_plane(const Plane& plane, const MatrixXd& interface)
{
    const Index m = interface.rows() / 2;
    MatrixXd result(2 * m, interface.cols());
    for (Index i = 0; i < m; ++i) {
        result.row(i) = plane.normal.transpose() * interface.middleRows<2>(2 * i);
        result.row(m + i) = plane.tangent.transpose() * interface.middleRows<2>(2 * i);
    }
    return result;
}

} // namespace

VectorXd Plane::to_plane(const VectorXd& interface) const
{
    const Index m = interface.size() / 2;
    VectorXd result(2 * m);
    for (Index i = 0; i < m; ++i) {
        result[i] = normal[0] * interface[2 * i] + normal[1] * interface[2 * i + 1];
        result[m + i] = tangent[0] * interface[2 * i] + tangent[1] * interface[2 * i + 1];
    }
    return result;
}

VectorXd Plane::to_interface(const VectorXd& plane) const
{
    const Index m = plane.size() / 2;
    VectorXd result(2 * m);
    for (Index i = 0; i < m; ++i) {
        result[2 * i] = normal[0] * plane[i] + tangent[0] * plane[m + i];
        result[2 * i + 1] = normal[1] * plane[i] + tangent[1] * plane[m + i];
    }
    return result;
}

MatrixXd Plane::to_plane(const MatrixXd& interface) const
{
    return rows_to_plane(*this, rows_to_plane(*this, interface).transpose());
}

namespace {

/// Half of each element goes to either end of it.
void share_areas(Plane& plane)
{
    const Index m = plane.distance.size();
    plane.area.setZero(m);
    for (Index i = 0; i + 1 < m; ++i) {
        const double half = 0.5 * (plane.distance[i + 1] - plane.distance[i]);
        plane.area[i] += half;
        plane.area[i + 1] += half;
    }
}

VectorXd as_vector(const std::vector<double>& values)
{
    return Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
}

} // namespace

Plane plane_of(const Mesh& mesh)
{
    const ContactPlane& contact = mesh.contact;
    const Point heel = mesh.nodes[contact.dam_nodes.front()], toe = mesh.nodes[contact.dam_nodes.back()];
    Plane plane;
    plane.tangent = Eigen::Vector2d(toe.x - heel.x, toe.y - heel.y).normalized();
    plane.normal = {-plane.tangent[1], plane.tangent[0]};
    plane.distance = as_vector(contact.distance);
    share_areas(plane);
    return plane;
}

Plane plane_of(const LiftPlane& lift)
{
    Plane plane;
    plane.distance = as_vector(lift.distance);
    share_areas(plane);
    return plane;
}

} // namespace damslip::fe2d
