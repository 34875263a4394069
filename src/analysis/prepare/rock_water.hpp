#pragma once

#include "fe2d/model/model.hpp"
#include "scene/scene.hpp"

namespace damslip {

/// Water in the rock as nodal forces (stages.pore_pressure = total or effective), from the seepage on the model's own mesh; zero for none.
/// @throws NotConverged when the seepage solver loses its accuracy
Eigen::VectorXd rock_water_load(const Scene& scene, const fe2d::Model& model);

/// Does stages.pore_pressure ask for water in the rock, and is there rock?
bool has_water_in_rock(const Scene& scene);

/// The part of rock_water_load() beyond the uplift on both faces of the joint, which contact runs have by themselves. The
/// joint's two sides must have facing nodes for stages.pore_pressure = "effective".
Eigen::VectorXd water_in_rock(const Scene& scene, const fe2d::Model& model);

} // namespace damslip
