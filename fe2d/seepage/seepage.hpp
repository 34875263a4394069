#pragma once

#include "core/note.hpp"
#include "fe2d/element/elastic.hpp"
#include "fe2d/mesh/mesh.hpp"
#include "fe2d/seepage/seepage_mesh.hpp"
#include "fe2d/solver/linear_solver.hpp"
#include "scene/uplift_models.hpp"
#include "scene/water.hpp"

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Steady flow of water through saturated rock, ∇·(k ∇H) = 0 (Darcy 1856), on the rock and curtain elements of a mesh.
namespace damslip::fe2d {

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
