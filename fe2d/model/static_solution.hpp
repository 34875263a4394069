#pragma once

#include "fe2d/model/model.hpp"
#include "fe2d/solver/linear_solver.hpp"

#include <Eigen/Core>
#include <string>
#include <vector>

namespace damslip::fe2d {

/// One static load case as nodal forces of the model's unknowns.
struct StaticLoad {
    std::string name;
    Eigen::VectorXd force;     ///< [N/m], length dofs.count
    Eigen::Vector2d resultant; ///< on all nodes, the fixed ones included [N/m]: x downstream, y up
};

/// The scene's static loads by stage; a load the scene does not have is not in the list.
struct StaticLoads {
    std::vector<StaticLoad> rock;    ///< weight of all rock, where the dam stands on a seam: before the dam is there
    std::vector<StaticLoad> gravity; ///< weight of the dam, and of the rock where scene.stages asks for it
    std::vector<StaticLoad>
        impounding; ///< water on the upstream face, on the floor where asked for, tailwater, silt, ice, forces
};

/// @throws InputError when a point force or the ice is not on the dam.
StaticLoads static_loads(const Scene& scene, const Model& model);

/// Sum of the forces of one list [N/m]; zero when it is empty.
Eigen::VectorXd sum_of(const std::vector<StaticLoad>& loads, int unknowns);

/// Pressure in a lift joint [Pa] over the distance from the upstream face [m]: the hydrostatic head of the reservoir at
/// the upstream face, linear to that of the tailwater at the downstream face; nothing at a dry face. Empty where the
/// joint has no water or both faces are dry.
/// @param length  of the joint [m]
PressureProfile lift_water_profile(const Scene& scene, const LiftJoint& joint, double length);

/// The water of all lift joints on both their faces, open or not, and that in the faces up from the path of a seam [N/m]; empty
/// where there is none.
/// @param model  of the same scene
Eigen::VectorXd lift_water(const Scene& scene, const Model& model);

/// State after one stage of the static loading.
struct StaticStage {
    std::string name;             ///< "gravity", "impounding"
    Eigen::Vector2d resultant;    ///< of all loads up to here [N/m]
    Eigen::VectorXd displacement; ///< counted from the zero-displacement start where scene.stages.geostatic is set [m]
    Eigen::VectorXd elastic;      ///< displacement that carries the stresses: from the unloaded state, never reset [m]
};

struct StaticSolution {
    SolverReport solver; ///< when it is not ok(), `stages` is empty
    std::vector<StaticStage> stages;
};

/// Solves the stages of a tied model, one factorisation for all. A stage without loads is left out.
StaticSolution solve_static(const Scene& scene, const Model& model, const StaticLoads& loads,
                            const SolverOptions& options = {});

/// Forces the rock (or the rigid base) exerts on the dam at the base nodes, heel to toe, 2 x n [N/m]: internal forces
/// of the dam minus `dam_load`. For a tied base they are the nodal contact forces.
/// @param dam_load  forces on all dam nodes, by all_dofs(mesh, 2) [N/m]
Eigen::Matrix2Xd base_forces(const Model& model, const Eigen::VectorXd& displacement, const Eigen::VectorXd& dam_load);

/// Stresses of a displacement state, tension positive [Pa].
struct StressField {
    Eigen::Matrix3Xd nodal;  ///< (xx, yy, xy) of every node: mean over its elements of the same region; a node on the
                             ///< curtain's edge takes the mean of rock and curtain. The two sides of the contact plane
                             ///< are separate nodes and stay separate
    Eigen::Matrix3Xd centre; ///< (xx, yy, xy) of every element at its centre, the most accurate place
};

/// @param displacement  of the unknowns, length dofs.count [m]
StressField stress_field(const Mesh& mesh, const DofMap& dofs, const Materials& materials,
                         const Eigen::VectorXd& displacement);
/// The same with the model's locked stress.
StressField stress_field(const Model& model, const Eigen::VectorXd& displacement);

struct PrincipalStress {
    double major = 0.0; ///< the larger (more tensile) one [Pa]
    double minor = 0.0; ///< [Pa]
    double angle = 0.0; ///< of the major one from the x axis, -pi/2 ... pi/2 [rad]
};
PrincipalStress principal_stress(const Eigen::Vector3d& stress);

} // namespace damslip::fe2d
