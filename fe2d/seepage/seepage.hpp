#pragma once

#include "core/status.hpp"
#include "fe2d/assembly/assemble.hpp"
#include "fe2d/element/elastic.hpp"
#include "fe2d/mesh/mesh.hpp"
#include "fe2d/solver/linear_solver.hpp"
#include "scene/scene.hpp"
#include "scene/uplift_models.hpp"
#include "scene/water.hpp"

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

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

/// Steady flow of water through saturated rock, ∇·(k ∇H) = 0 (Darcy 1856), on the rock and curtain elements of a mesh.
/// Hydraulic conductivity of the zones [m/s], isotropic, > 0.
struct Permeability {
    double rock = 1e-4;    ///< thesis table 4-1
    double curtain = 1e-8; ///< grout, thesis table 4-1
};

/// Prescribed hydraulic head H = p/γ_w + y [m] at a node, y measured from the heel.
struct NodeHead {
    int node = 0;
    double head = 0.0;
};

/// One value per node of the mesh; NaN on nodes that belong to no rock element.
struct DarcySolution {
    Eigen::VectorXd head; ///< H [m]
    Eigen::VectorXd
        inflow; ///< water that enters at a node, Σ K H over its elements [m^3/s per m]; round-off on free nodes
    SolverReport solver; ///< when not ok(), head and inflow are NaN
};

/// Everywhere else on the boundary no water passes. Inflows are consistent nodal fluxes: their sum is zero to
/// round-off, and they converge with twice the order of the gradients.
/// @param heads  at least one; a node given twice takes the last value
DarcySolution solve_darcy(const Mesh& mesh, const Permeability& permeability, std::span<const NodeHead> heads);

/// Water that the chosen elements take from the given nodes [m^3/s per m], as consistent nodal fluxes: the flow across
/// a line is what the elements on its far side take from the nodes on it.
double flow_into(const Mesh& mesh, const Permeability& permeability, const DarcySolution& solution,
                 std::span<const int> nodes, const std::function<bool(const Element&, const Corners&)>& chosen);

/// The scene's drain line: held, if it draws water, at the head that USACE EM 1110-2-2200 gives at the drains,
/// H3 = H2 + (1 - E)(H1 - H2)(L - X)/L, H2 the tailwater or a higher gallery. None without [drains], or where
/// ineffective.
std::optional<DrainLine> drain_line(const Scene& scene, const UpliftState& state);

struct SeepageResult {
    PressureProfile profile;           ///< a point at every node of the base, >= 0
    double uplift = 0.0;               ///< integral of the profile, normal to the base [N/m]
    double inflow = 0.0;               ///< through the reservoir floor; negative: flows upstream [m^3/s per m]
    double outflow = 0.0;              ///< through the ground downstream [m^3/s per m]
    double drain_flow = 0.0;           ///< taken by the drains [m^3/s per m]
    double flow_through_curtain = 0.0; ///< across the plane of its upstream side, within its depth [m^3/s per m]
    double flow_under_curtain = 0.0;   ///< across the same plane below its foot [m^3/s per m]
    std::optional<double> pressure_before_curtain; ///< at its upstream side on the base [Pa]
    std::optional<double> pressure_behind_curtain; ///< at its downstream side on the base [Pa]
    double lowest_pressure = 0.0;                  ///< on the base before negative values were cut off [Pa]
    double unit_weight = 0.0;                      ///< of water, γ_w [N/m^3]
    Mesh mesh;                                     ///< of the rock
    DarcySolution field;                           ///< heads on it; field.solver says whether all this is valid
    std::vector<Note> notes;                       ///< what was assumed and what the user should know
};

/// Steady seepage below the dam: head of the reservoir on its floor, of the tailwater on the ground downstream, no flow
/// through base, sides and bottom of the box (seepage_box). Water that is lower than the rock surface, or none, leaves
/// the surface at zero pressure. Needs the section, and of the rest only what the scene has.
/// @throws InputError when curtain, drains or base do not fit into the box. Not converged: field.solver.ok() is false.
SeepageResult solve_seepage(const Scene& scene, const UpliftState& state, const SeepageMeshOptions& options = {});

/// The same on a mesh at hand, such as that of the whole FE model. Drains are the nodes below the base nearest their
/// line.
SeepageResult solve_seepage_on(Mesh mesh, const Scene& scene, const UpliftState& state);

/// The profile as Scene::uplift.points: x = distance [m], y = p / p_heel with p_heel = γ_w times the reservoir level.
/// Empty without water in the reservoir. First and last point lie exactly on heel and toe.
std::vector<Point> uplift_points(const SeepageResult& result, const Scene& scene, const UpliftState& state);

} // namespace damslip::fe2d
