#pragma once

#include "fe2d/mesh/faces.hpp"
#include "fe2d/mesh/grading.hpp"
#include "fe2d/mesh/mesh.hpp"

namespace damslip::fe2d {

/// Sizes the dam is meshed with, fixed before any node is made.
struct DamLayout {
    std::vector<double> base; ///< node distances from the heel along the base [m], 0 ... base length
    std::vector<double> rows; ///< face parameter s of every row of nodes, 0 ... 1
    std::vector<int> joints;  ///< indices in `rows` of the lift joints, increasing
    Grading heights;          ///< element size against the mean height above the base [m]
};

/// Appends the dam to an empty mesh: quadrilaterals in rows that follow both faces. Where the columns have become much
/// narrower than the element size of their height, four columns become two by a row of six quadrilaterals, so that
/// elements stay near square up to a narrow crest; a section that ends in a point ends in triangles. Rows at
/// lift joints are made twice. Fills dam nodes, elements, faces, crest, contact.dam_nodes and lifts.
void append_dam(Mesh& mesh, const Faces& faces, const DamLayout& layout);

} // namespace damslip::fe2d
