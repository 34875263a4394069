#pragma once

#include "core/input_error.hpp"
#include "fe2d/mesh/mesh.hpp"
#include "fe2d/model/model.hpp"
#include "records/record.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace damslip::fe2d { struct RunOptions; }

namespace damslip {

/// What of the scene a reduced run cannot do; nothing where it can.
std::optional<Diagnostic> why_not_reducible(const Scene& scene);

/// @throws UsageError with that
void check_reducible(const Scene& scene);

/// Has its runs correct their steps (fe2d::CorrectedRun) where steps are chosen, contact is exact, and the dam can be reduced and
/// stays in one piece; halve them elsewhere.
void set_corrector(const Scene& scene, fe2d::RunOptions& options);

/// What rock with mass asks of its box and mesh: waves that come back from fixed edges, and elements that are too long
/// for the waves of this motion. Nothing for massless rock.
std::vector<std::string> rock_warnings(const Scene& scene, const fe2d::Mesh& mesh, const GroundMotion& motion);

/// Water in the rock as nodal forces (stages.pore_pressure = total or effective), from the seepage on the model's own mesh; zero for none.
/// @throws NotConverged when the seepage solver loses its accuracy
Eigen::VectorXd rock_water_load(const Scene& scene, const fe2d::Model& model);

/// Does stages.pore_pressure ask for water in the rock, and is there rock?
bool has_water_in_rock(const Scene& scene);

/// The part of rock_water_load() beyond the uplift on both faces of the joint, which contact runs have by themselves. The
/// joint's two sides must have facing nodes for stages.pore_pressure = "effective".
Eigen::VectorXd water_in_rock(const Scene& scene, const fe2d::Model& model);

} // namespace damslip
