#pragma once

#include "fe2d/model/static_loads.hpp"
#include "fe2d/solver/linear_solver.hpp"

namespace damslip::fe2d {

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

} // namespace damslip::fe2d
