#include "fe2d/run/contact_planes.hpp"

#include <cassert>
#include <utility>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

using Entries = std::vector<Eigen::Triplet<double>>;

ContactPlanes::Matrix matrix(Index rows, Index columns, const Entries& entries)
{
    ContactPlanes::Matrix result(rows, columns);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

/// True for the dam's nodes that hang together with one of `start` through elements.
std::vector<char> connected(const Mesh& mesh, const std::vector<int>& start)
{
    std::vector<char> reached(static_cast<std::size_t>(mesh.dam_node_count), 0);
    for (const int node : start) reached[static_cast<std::size_t>(node)] = 1;
    for (bool more = true; more;) {
        more = false;
        for (int e = 0; e < mesh.dam_element_count; ++e) {
            const ElementNodes nodes = mesh.elements[static_cast<std::size_t>(e)].all();
            int count = 0;
            for (const int node : nodes) count += reached[static_cast<std::size_t>(node)];
            if (count == 0 || count == nodes.count) continue;
            for (const int node : nodes) reached[static_cast<std::size_t>(node)] = 1;
            more = true;
        }
    }
    return reached;
}

} // namespace

ContactPlanes::ContactPlanes(const Mesh& mesh, BelowBase below)
{
    planes_.push_back(plane_of(mesh));
    nodes_ = mesh.contact.dam_nodes;
    const auto tie = [&](const std::vector<int>& upper, const std::vector<int>& lower) {
        for (std::size_t i = 0; i < upper.size(); ++i) ties_.push_back({upper[i], lower[i]});
    };
    if (below == BelowBase::block) {
        assert(mesh.contact.matching && mesh.has_rock());
        tie(mesh.contact.dam_nodes, mesh.contact.rock_nodes);
    }
    for (const LiftPlane& lift : mesh.lifts) {
        planes_.push_back(plane_of(lift));
        nodes_.insert(nodes_.end(), lift.upper_nodes.begin(), lift.upper_nodes.end());
        tie(lift.upper_nodes, lift.lower_nodes);
    }
    Index m = 0;
    for (const Plane& plane : planes_) {
        first_.push_back(m);
        m += plane.pairs();
    }
    area_.resize(m);
    weights_ = MatrixXd::Zero(m, count());
    Entries gaps;
    for (Index k = 0; k < count(); ++k) {
        const Plane& plane = (*this)[k];
        const Index pairs = plane.pairs();
        area_.segment(first(k), pairs) = plane.area;
        weights_.col(k).segment(first(k), pairs) = plane.weights();
        for (Index i = 0; i < pairs; ++i)
            for (const Index c : {0, 1}) {
                const Index pair = first(k) + i;
                gaps.emplace_back(pair, 2 * pair + c, plane.normal[c]);
                gaps.emplace_back(m + pair, 2 * pair + c, plane.tangent[c]);
            }
    }
    gaps_ = matrix(2 * m, 2 * m, gaps);

    above_.assign(planes_.size(), {});
    above_.front().assign(static_cast<std::size_t>(mesh.dam_node_count), 1);
    for (std::size_t k = mesh.lifts.size(); k > 0; --k) { // from top to bottom, each joins those above it
        above_[k] = connected(mesh, mesh.lifts[k - 1].upper_nodes);
        if (k == mesh.lifts.size()) continue;
        for (std::size_t node = 0; node < above_[k].size(); ++node) above_[k][node] |= above_[k + 1][node];
    }
}

MatrixXd sliding_motions(const ContactPlanes& planes)
{
    const Index nodes = static_cast<Index>(planes.above(0).size());
    MatrixXd motions = MatrixXd::Zero(2 * nodes, planes.count());
    for (Index k = 0; k < planes.count(); ++k)
        for (Index node = 0; node < nodes; ++node)
            if (planes.above(k)[static_cast<std::size_t>(node)])
                motions.col(k).segment<2>(2 * node) = planes[k].tangent;
    return motions;
}

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
