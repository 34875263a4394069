#pragma once

#include "fe2d/reduction/reduced_operator.hpp"

namespace damslip::fe2d {

/// The contact plane with neighbouring pairs joined to one: gaps are area means of the group's, a force on the group is
/// spread over its pairs by area (uniform pressure). Too coarse for a slip, good enough for how much a slip changes
/// with the number of modes, and cheap: contact costs the square of the pairs.
class CoarsePlane {
public:
    /// @param groups  wanted, >= 1; each pair stands alone when there are no more
    CoarsePlane(const Plane& plane, int groups);

    const Plane& plane() const { return coarse_; }
    ReducedSystem coarsened(const ReducedSystem& system) const;
    ContactMemory coarsened(const ContactMemory& memory) const; ///< all pairs shut and sticking, forces summed

private:
    Eigen::MatrixXd mean_; ///< area means of the groups, groups x m
    Eigen::MatrixXd both_; ///< of normal and tangential components, 2 groups x 2m
    Plane coarse_;
};

} // namespace damslip::fe2d
