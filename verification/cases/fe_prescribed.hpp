#pragma once

#include "fe2d/assembly/assemble.hpp"

#include <vector>

namespace damslip::verification {

/// Displacement of all nodes (u_x0, u_y0, ...) of a mesh of the dam's material where `fixed` nodes have the given values
/// and `load` acts on all nodes; NaN where the matrix has no factor.
/// @param values, load  of all nodes, in the layout of fe2d::all_dofs
Eigen::VectorXd solve_prescribed(const fe2d::Mesh& mesh, const fe2d::Materials& materials,
                                 const std::vector<int>& fixed, const Eigen::VectorXd& values,
                                 const Eigen::VectorXd& load);

} // namespace damslip::verification
