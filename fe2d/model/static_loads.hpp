#pragma once

#include "fe2d/model/model.hpp"

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
    std::vector<StaticLoad> gravity; ///< weight of the dam, and of the rock where scene.stages asks for it
    std::vector<StaticLoad>
        impounding; ///< water on the upstream face, on the floor where asked for, tailwater, silt, ice, forces
};

/// @throws InputError when a point force or the ice is not on the dam.
StaticLoads static_loads(const Scene& scene, const Model& model);

/// Sum of the forces of one list [N/m]; zero when it is empty.
Eigen::VectorXd sum_of(const std::vector<StaticLoad>& loads, int unknowns);

} // namespace damslip::fe2d
