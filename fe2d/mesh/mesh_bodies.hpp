#pragma once

#include "fe2d/mesh/faces.hpp"
#include "fe2d/mesh/grading.hpp"
#include "fe2d/mesh/mesh.hpp"

#include <vector>

/// The bodies build_mesh() makes, each by a layout that is fixed before any node is made.
namespace damslip::fe2d {

/// Sizes the dam is meshed with.
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

/// Where the columns and rows of the rock lie.
struct RockLayout {
    double inclination = 0.0;  ///< of the contact plane, positive: dips downstream [rad]
    std::vector<double> plane; ///< columns on the contact plane and its extensions: distance from the heel along it [m]
    bool matching = true;      ///< the columns below the base are the dam's; otherwise only heel and toe are
    int base_begin = 0;        ///< index of the heel in `plane`
    int base_end = 0;          ///< index of the toe in `plane`
    std::vector<double>
        left; ///< x of the columns upstream of the plane, from its end to the edge of the box, decreasing [m]
    std::vector<double>
        right; ///< x of the columns downstream of the plane, from its end to the edge of the box, increasing [m]
    std::vector<double> depths; ///< rows as share of the way from the surface to the bottom, 0 ... 1
    double bottom = 0.0;        ///< y of the bottom [m]
    int curtain_begin = -1;     ///< index in `plane` of the curtain's upstream side; -1: no curtain
    int curtain_end = -1;       ///< index in `plane` of the curtain's downstream side
    int curtain_rows = 0;       ///< element rows the curtain reaches down
};

/// Appends rock and curtain to a mesh that holds the dam: a structured block whose columns go on from the base's nodes.
/// The surface is straight along the contact plane and its extensions and horizontal from there to the edges of the
/// box. Fills contact.rock_nodes, rock_line, floor, ground and the sides of the box.
void append_rock(Mesh& mesh, const RockLayout& layout);

} // namespace damslip::fe2d
