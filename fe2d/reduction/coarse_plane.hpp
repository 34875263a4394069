#pragma once

#include "fe2d/reduction/reduced_operator.hpp"
#include "fe2d/run/static_contact.hpp"

namespace damslip::fe2d {

/// The contact plane with neighbouring pairs joined to groups: gaps are area means of the group's, a force on the group is
/// spread over its pairs by area (uniform pressure). Too coarse for a slip, good enough for how much a slip changes
/// with the number of modes, and cheap: contact costs the square of the pairs.
class CoarsePlane {
public:
    /// @param groups  wanted, >= 1; each pair stands alone when there are no more
    CoarsePlane(const Plane& plane, int groups);

    const Plane& plane() const { return coarse_; } ///< a group stands as one pair
    ReducedSystem coarsened(const ReducedSystem& system) const;

    /// All groups shut and sticking, forces summed: for differences of two runs on this plane.
    ContactMemory shut(const ContactMemory& memory) const;

private:
    std::size_t group_of(Eigen::Index pair) const; ///< the groups are of consecutive pairs
    Eigen::MatrixXd mean_;                         ///< area means of the groups, groups x m
    Eigen::MatrixXd both_;                         ///< of normal and tangential components, 2 groups x 2m
    Plane coarse_;
};

} // namespace damslip::fe2d
