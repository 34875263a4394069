#pragma once

#include "fe2d/assembly/dof_map.hpp"
#include "fe2d/element/elastic.hpp"
#include "fe2d/material/elastic.hpp"

#include <Eigen/SparseCore>

#include <functional>
#include <span>

namespace damslip::fe2d {

using SparseMatrix = Eigen::SparseMatrix<double>; ///< by columns; symmetric ones are stored whole

/// Matrix of one element; an empty (0 x 0) matrix leaves the element out.
using ElementMatrixFunction = std::function<ElementMatrix(const Element& element, const Corners& corners)>;
using ElementVectorFunction = std::function<ElementVector(const Element& element, const Corners& corners)>;

/// Sum of the element matrices, dofs.count x dofs.count. Fixed unknowns are left out. Elements are added in mesh order:
/// same bits each time.
SparseMatrix assemble(const Mesh& mesh, const DofMap& dofs, const ElementMatrixFunction& element_matrix);

/// The same with different unknowns for rows and columns, rows.count x columns.count: for parts of a matrix, such as
/// the coupling of free and prescribed values. Both maps have the same number of components.
SparseMatrix assemble(const Mesh& mesh, const DofMap& rows, const DofMap& columns,
                      const ElementMatrixFunction& element_matrix);

/// Sum of the element vectors, length dofs.count.
Eigen::VectorXd assemble_vector(const Mesh& mesh, const DofMap& dofs, const ElementVectorFunction& element_vector);

/// Material of each region, and how the quadrilaterals are formulated.
struct Materials {
    ElasticMaterial dam, rock, curtain;
    Q4Kind kind = Q4Kind::incompatible; ///< of linear quadrilaterals; whether an element is quadratic, its nodes say

    const ElasticMaterial& of(Region region) const;
};

/// Materials of the scene; the curtain takes the rock's density, and its modulus where it has none of its own.
/// @throws InputError where Young's modulus is missing.
Materials materials_of(const Scene& scene);

/// The same without inertia or weight of rock and curtain.
Materials without_rock_density(Materials materials);

SparseMatrix stiffness_matrix(const Mesh& mesh, const DofMap& dofs, const Materials& materials); ///< K [N/m per m]
/// The same of the dam's elements alone.
SparseMatrix dam_stiffness_matrix(const Mesh& mesh, const DofMap& dofs, const Materials& materials);
SparseMatrix mass_matrix(const Mesh& mesh, const DofMap& dofs, const Materials& materials, MassKind kind); ///< M [kg/m]

/// M r for a rigid translation r = `direction` of every node, the fixed ones included [kg/m]: the ground acceleration
/// a_g along it loads the relative motion with - M r a_g. `kind` is that of M.
Eigen::VectorXd inertia_vector(const Mesh& mesh, const DofMap& dofs, const Materials& materials,
                               const Eigen::Vector2d& direction, MassKind kind = MassKind::consistent);

/// Weight: density times gravity, downwards [N/m], of the given regions.
Eigen::VectorXd gravity_load(const Mesh& mesh, const DofMap& dofs, const Materials& materials, double gravity,
                             std::span<const Region> regions);

} // namespace damslip::fe2d
