#pragma once

#include "fe2d/assembly/assemble.hpp"
#include "fe2d/mesh/mesh.hpp"
#include "scene/scene.hpp"

#include <Eigen/Core>
#include <optional>
#include <span>

namespace damslip::fe2d {

/// A line of relief wells below the base, held at one head as long as they take more water than they give.
struct DrainLine {
    double distance = 0.0; ///< from the heel along the base [m]
    double depth = 0.0;    ///< below the base [m]
    double head = 0.0;     ///< [m] above the heel
};

/// Rock box in which the water flows.
struct SeepageBox {
    double width = 0.0; ///< centred on the base [m]
    double depth = 0.0; ///< below the heel [m]
};

/// The scene's foundation; without one 300/45 x 100/45 base lengths, the proportions of the thesis' foundation.
SeepageBox seepage_box(const Scene& scene);

struct SeepageMeshOptions {
    double finest =
        1.0 / 450.0;      ///< element size where the flow is singular (heel, toe, curtain, drain foot), of the base [-]
    double growth = 1.15; ///< ratio of neighbouring sizes [-], > 1
    double largest = 1.0 / 20.0; ///< largest element size, of the box depth [-]
};

/// Rock alone, for the flow: columns and rows refined towards heel, toe, both sides and foot of the curtain (where it
/// changes the flow), and the drain line. Its contact plane stands on nodes of its own; there are no dam elements.
/// @throws InputError when the base, curtain or drains do not fit into the box
Mesh seepage_mesh(const Scene& scene, const std::optional<DrainLine>& drains, const SeepageMeshOptions& options = {});

/// Water in the rock as forces on the structure, in either of two forms that give the same displacements.
///
/// Effective stress σ' = D ε and total stress σ = σ' - m p (tension positive, m = (1, 1, 0)) in ∫Bᵀσ = f give
///
///     (a) total:      K u = -∫Nᵀ n p dS + ∫Bᵀ m p dV      pressures on floor, ground and both faces of the base joint
///     (b) effective:  K u = -∫Nᵀ ∇p dV                    on the rock; nothing on its surface
///
/// Both are the same by the divergence theorem, element by element too: with bilinear p and 2 x 2 Gauss points, and with
/// quadratic p and 3 x 3, all integrals are exact. The dam's face of the joint carries +p in both. p is the excess p_ex = γ_w (H - y_0) over still
/// water at the heel's ground level y_0 = 0: the rock was saturated up to there before the impounding, and only the
/// change strains it. On a horizontal rock surface p_ex is the water pressure itself. Never combine (b) with water
/// loads on the rock's surface. The incompatible modes of quadrilaterals get no load in either form: a constant p does
/// no work on them.

/// p_ex at every node [Pa], 0 outside the rock.
/// @param head  H of solve_darcy [m]
Eigen::VectorXd excess_pore_pressure(const Eigen::VectorXd& head, double unit_weight);

/// ∫Bᵀ m p dV over rock and curtain [N/m].
/// @param pressure  at every node of the mesh [Pa]
Eigen::VectorXd pore_pressure_force(const Mesh& mesh, const DofMap& dofs, const Eigen::VectorXd& pressure);

/// -∫Nᵀ ∇p dV over rock and curtain [N/m].
Eigen::VectorXd seepage_body_force(const Mesh& mesh, const DofMap& dofs, const Eigen::VectorXd& pressure);

/// -∫Nᵀ n p dS along a chain of nodes, n the outward normal of its body (body on the left), p linear between the nodes, quadratic
/// along edges with a node in their middle [N/m].
Eigen::VectorXd surface_pressure_force(const Mesh& mesh, const DofMap& dofs, std::span<const int> chain,
                                       const Eigen::VectorXd& pressure);

/// What pore_pressure_loads() has beyond the uplift on both faces of the joint: the water in the rock and on its surface
/// beside the dam, forces on the rock alone [N/m]. Zero for PorePressure::none.
Eigen::VectorXd water_in_rock(const Mesh& mesh, const DofMap& dofs, const Eigen::VectorXd& pressure, PorePressure form);

/// All forces of the pore pressure on rock and base joint in the given form [N/m]; PorePressure::none: uplift on both
/// faces of the joint only. Uplift presses the dam up and the rock down; with a tied base the two cancel there.
Eigen::VectorXd pore_pressure_loads(const Mesh& mesh, const DofMap& dofs, const Eigen::VectorXd& pressure,
                                    PorePressure form);

} // namespace damslip::fe2d
