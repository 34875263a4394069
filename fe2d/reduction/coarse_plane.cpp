#include "fe2d/reduction/coarse_plane.hpp"

#include <algorithm>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

CoarsePlane::CoarsePlane(const Plane& plane, int groups) : coarse_(plane)
{
    const Index m = plane.pairs(), count = std::clamp<Index>(groups, 1, m);
    mean_ = MatrixXd::Zero(count, m);
    for (Index i = 0; i < m; ++i) mean_(i * count / m, i) = plane.area[i];
    coarse_.area = mean_.rowwise().sum();
    mean_ = (coarse_.area.cwiseInverse().asDiagonal() * mean_).eval();
    coarse_.distance = mean_ * plane.distance;
    both_ = MatrixXd::Zero(2 * count, 2 * m);
    both_.topLeftCorner(count, m) = both_.bottomRightCorner(count, m) = mean_;
}

std::size_t CoarsePlane::group_of(Index pair) const
{
    return static_cast<std::size_t>(pair * mean_.rows() / mean_.cols());
}

ReducedSystem CoarsePlane::coarsened(const ReducedSystem& system) const
{
    ReducedSystem result = system;
    result.modes.on_plane = both_ * system.modes.on_plane;
    result.modes.residual = MatrixXd();
    result.modes.residual_crest = both_ * system.modes.residual_crest;
    result.flexibility = both_ * system.flexibility * both_.transpose();
    result.weights = coarse_.weights();
    return result;
}

ContactMemory CoarsePlane::shut(const ContactMemory& memory) const
{
    const Index m = mean_.cols(), count = mean_.rows();
    ContactMemory result(count);
    for (Index i = 0; i < m; ++i) {
        const auto group = static_cast<Index>(group_of(i));
        result.force[group] += memory.force[i];
        result.force[count + group] += memory.force[m + i];
    }
    result.slip = mean_ * memory.slip;
    return result;
}

} // namespace damslip::fe2d
