#pragma once

#include "core/geometry.hpp"

#include <array>
#include <vector>

/// Mesh of one scene: dam and, where the scene has one, the rock below it with the grout curtain.
///
/// Axes of the scene: x downstream, y up, heel at the origin [m]. The dam-foundation plane is always split: every node
/// of the base exists twice, once on the dam and once on the rock, at the same place unless the scene gives the rock an
/// element size of its own there. Lift joints split the dam in the same way. Whether the two sides are tied, free or in
/// contact is said by the degrees of freedom (assembly/dof_map.hpp), not by the mesh.
namespace damslip::fe2d {

enum class Region : unsigned char { dam, rock, curtain, reservoir };
inline constexpr int region_count = 4;

/// A quadrilateral, or a triangle when the fourth node is -1; nodes counter-clockwise.
struct Element {
    std::array<int, 4> nodes{-1, -1, -1, -1};
    Region region = Region::dam;

    int size() const { return nodes[3] < 0 ? 3 : 4; }
};

/// Consecutive nodes of a boundary in the counter-clockwise order of the body they belong to: going along the chain the
/// body is on the left, the outward normal of the edge (a, b) is (y_b - y_a, x_a - x_b) / length.
using NodeChain = std::vector<int>;

/// The plane between dam and rock, always straight, from the heel to the toe.
struct ContactPlane {
    std::vector<int> dam_nodes;   ///< on the dam, heel to toe
    std::vector<int> rock_nodes;  ///< on the rock, heel to toe; at the same places if `matching`; empty: rigid base
    std::vector<double> distance; ///< of the dam's nodes from the heel, along the plane [m]
    std::vector<double> rock_node_distance; ///< of rock_nodes; `distance` itself if `matching` [m]
    bool matching = true;       ///< rock_nodes[i] lies where dam_nodes[i] does; otherwise only heel and toe coincide
    std::vector<int> rock_line; ///< rock surface nodes of the whole plane: it goes on straight past heel and toe,
                                ///< upstream to downstream
    std::vector<double>
        rock_distance; ///< of rock_line from the heel, along the plane; negative upstream of the heel [m]
};

/// A horizontal joint through the dam: its nodes exist twice, as those of the base do.
struct LiftPlane {
    std::vector<int> lower_nodes; ///< of the dam below, upstream to downstream
    std::vector<int> upper_nodes; ///< of the block above, at the same places
    std::vector<double> distance; ///< of these nodes from the upstream face, along the joint [m]
};

struct Mesh {
    std::vector<Point> nodes;      ///< dam nodes first (those of lift joints twice), then the rock's
    std::vector<Element> elements; ///< dam first, then rock and curtain
    int dam_node_count = 0;
    int dam_element_count = 0;

    ContactPlane contact;
    std::vector<LiftPlane> lifts;  ///< from the bottom up, in the order of Scene::lift_joints
    NodeChain upstream_face;       ///< of the dam, crest to heel; at a lift joint through both nodes, upper first: an
                                   ///< edge of no length
    NodeChain downstream_face;     ///< of the dam, toe to crest; at a lift joint through both nodes, lower first
    NodeChain crest;               ///< downstream end to upstream end; one node where the section ends in a point
    NodeChain floor;               ///< rock surface upstream of the heel, heel to the edge of the box
    NodeChain ground;              ///< rock surface downstream of the toe, edge of the box to the toe
    NodeChain box_left, box_right; ///< vertical sides of the rock
    NodeChain box_bottom;

    int node_count() const { return static_cast<int>(nodes.size()); }
    int element_count() const { return static_cast<int>(elements.size()); }
    bool has_rock() const { return !contact.rock_nodes.empty(); }
};

/// Corner coordinates of one element in node order; unused entries of a triangle are (0, 0).
std::array<Point, 4> corners(const Mesh& mesh, const Element& element);

} // namespace damslip::fe2d
