#pragma once

#include "core/geometry.hpp"

#include <Eigen/Core>

#include <vector>

namespace damslip::exact {

/// Loads of a strip as forces on its nodes, each with the resultant 1: uniform along x, uniform along y, and upwards in
/// proportion to x from the middle (a moment). One column each; rows (x, y) by node. @param nodes  level, x increasing [m]
Eigen::MatrixXd strip_loads(const std::vector<Point>& nodes);

} // namespace damslip::exact
