#pragma once

#include "fe2d/mesh/mesh.hpp"
#include "records/record.hpp"
#include "scene/scene.hpp"

#include <string>
#include <vector>

namespace damslip {

/// What rock with mass asks of its box and mesh: waves that come back from fixed edges, and elements that are too long
/// for the waves of this motion. Nothing for massless rock.
std::vector<std::string> rock_warnings(const Scene& scene, const fe2d::Mesh& mesh, const GroundMotion& motion);

} // namespace damslip
