#include "fe2d/run/contact_planes.hpp"

#include <algorithm>
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

/// Directions of the pairs of a bent lift: the mean of the edges at each.
void bend(const Mesh& mesh, const std::vector<int>& nodes, Plane& plane)
{
    const auto edge = [&](std::size_t i) {
        const Point a = mesh.nodes[nodes[i]], b = mesh.nodes[nodes[i + 1]];
        return Eigen::Vector2d(b.x - a.x, b.y - a.y).normalized();
    };
    for (std::size_t i = 0; i < nodes.size(); ++i)
        plane.along.push_back((edge(std::max<std::size_t>(i, 1) - 1) + edge(std::min(i, nodes.size() - 2))).normalized());
}

/// Directions of an inclined base, mean ones of a bent lift.
void turn(const Mesh& mesh, const std::vector<int>& nodes, Plane& plane)
{
    const Point a = mesh.nodes[nodes.front()], b = mesh.nodes[nodes.back()];
    plane.tangent = Eigen::Vector2d(b.x - a.x, b.y - a.y).normalized();
    plane.normal = {-plane.tangent[1], plane.tangent[0]};
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
        if (lift.bent || (mesh.seam && planes_.size() == 2)) turn(mesh, lift.lower_nodes, planes_.back()); // or the base of the dam
        if (lift.bent) bend(mesh, lift.lower_nodes, planes_.back());
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
                gaps.emplace_back(pair, 2 * pair + c, plane.normal_of(i)[c]);
                gaps.emplace_back(m + pair, 2 * pair + c, plane.tangent_of(i)[c]);
            }
    }
    gaps_ = matrix(2 * m, 2 * m, gaps);

    above_.assign(planes_.size(), {});
    above_.front().assign(static_cast<std::size_t>(mesh.dam_node_count), 1);
    for (std::size_t k = mesh.lifts.size(); k > 0; --k) { // from top to bottom, each joins those above it
        above_[k] = connected(mesh, mesh.lifts[k - 1].upper_nodes);
        if (k == mesh.lifts.size() || mesh.lifts[k].upright != mesh.lifts[k - 1].upright) continue;
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
        result.row(i) = plane.normal_of(i).transpose() * interface.middleRows<2>(2 * i);
        result.row(m + i) = plane.tangent_of(i).transpose() * interface.middleRows<2>(2 * i);
    }
    return result;
}

} // namespace

VectorXd Plane::weights() const
{
    if (segments.size() < 2) return area / area.sum();
    VectorXd weights = VectorXd::Zero(pairs());
    weights.head(main_pairs()) = area.head(main_pairs()) / area.head(main_pairs()).sum();
    return weights;
}

std::size_t Plane::segment_of(Index pair) const
{
    std::size_t segment = 0;
    while (segment + 1 < segments.size() && segments[segment + 1] <= pair) ++segment;
    return segment;
}

VectorXd Plane::to_plane(const VectorXd& interface) const
{
    const Index m = interface.size() / 2;
    VectorXd result(2 * m);
    for (Index i = 0; i < m; ++i) {
        const Eigen::Vector2d n = normal_of(i), t = tangent_of(i);
        result[i] = n[0] * interface[2 * i] + n[1] * interface[2 * i + 1];
        result[m + i] = t[0] * interface[2 * i] + t[1] * interface[2 * i + 1];
    }
    return result;
}

VectorXd Plane::to_interface(const VectorXd& plane) const
{
    const Index m = plane.size() / 2;
    VectorXd result(2 * m);
    for (Index i = 0; i < m; ++i) {
        const Eigen::Vector2d n = normal_of(i), t = tangent_of(i);
        result[2 * i] = n[0] * plane[i] + t[0] * plane[m + i];
        result[2 * i + 1] = n[1] * plane[i] + t[1] * plane[m + i];
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
        const double half = plane.share * 0.5 * (plane.distance[i + 1] - plane.distance[i]);
        plane.area[i] += half;
        plane.area[i + 1] += half;
    }
}

VectorXd as_vector(const std::vector<double>& values)
{
    return Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
}

/// Half of each element goes to either end of it; one that ends at a bend, where no pair is, goes to its other end.
void share_areas(const SeamLine& seam, Plane& plane)
{
    plane.area.setZero(plane.distance.size());
    for (const SeamLine::Segment& s : seam.segments) {
        for (Index i = s.first; i + 1 < s.end; ++i) {
            const double half = 0.5 * (plane.distance[i + 1] - plane.distance[i]);
            plane.area[i] += half;
            plane.area[i + 1] += half;
        }
        plane.area[s.first] += s.before;
        plane.area[s.end - 1] += s.beyond;
        plane.segments.push_back(s.first);
        plane.turned.push_back({s.tangent.x, s.tangent.y});
    }
}

} // namespace

Plane plane_of(const Mesh& mesh)
{
    const ContactPlane& contact = mesh.contact;
    const Point heel = mesh.nodes[contact.dam_nodes.front()], toe = mesh.nodes[contact.dam_nodes.back()];
    Plane plane;
    plane.distance = as_vector(contact.distance);
    if (mesh.seam) {
        share_areas(*mesh.seam, plane);
        plane.tangent = plane.turned.front();
    } else {
        plane.share = contact.share;
        share_areas(plane);
        plane.tangent = Eigen::Vector2d(toe.x - heel.x, toe.y - heel.y).normalized();
    }
    plane.normal = {-plane.tangent[1], plane.tangent[0]};
    return plane;
}

Plane plane_of(const LiftPlane& lift)
{
    Plane plane;
    plane.distance = as_vector(lift.distance);
    plane.share = lift.share;
    share_areas(plane);
    if (!lift.upright) return plane;
    plane.upright = true;
    plane.area[0] += plane.distance[0]; // ends without a pair
    plane.area[plane.pairs() - 1] += lift.beyond;
    plane.normal = {1.0, 0.0};
    plane.tangent = {0.0, -1.0};
    return plane;
}

} // namespace damslip::fe2d
