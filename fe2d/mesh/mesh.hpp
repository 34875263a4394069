#pragma once

#include "core/geometry.hpp"
#include "fe2d/gmsh/gmsh.hpp"

#include <array>
#include <optional>
#include <vector>

/// Mesh of one scene: dam and, where the scene has one, the rock below it with the grout curtain.
///
/// Axes of the scene: x downstream, y up, heel at the origin [m]. The dam-foundation plane is always split: every node
/// of the base exists twice, once on the dam and once on the rock, at the same place unless the scene gives the rock an
/// element size of its own there. Lift joints split the dam in the same way. Whether the two sides are tied, free or in
/// contact is said by the degrees of freedom (assembly/dof_map.hpp), not by the mesh.
namespace damslip {
struct LiftJoint;
struct Section;
} // namespace damslip

namespace damslip::fe2d {

enum class Region : unsigned char {
    dam,
    rock,
    curtain,
    reservoir,
    block ///< rock above a seam: it moves with the dam, and has mass
};
inline constexpr int region_count = 5;

/// The nodes of one element without a heap: corners, then the middles of its edges that have one, then its centre.
struct ElementNodes {
    std::array<int, 9> index{};
    int count = 0;

    const int* begin() const { return index.data(); }
    const int* end() const { return index.data() + count; }
    int operator[](int i) const { return index[i]; }
};

/// A quadrilateral, or a triangle when the fourth node is -1; nodes counter-clockwise. Edges are straight, and linear or
/// quadratic each by itself: an element between a quadratic and a linear edge is a transition element, and the mesh is
/// conforming wherever the two elements of an edge agree on its middle node (element/elastic.hpp).
struct Element {
    std::array<int, 4> nodes{-1, -1, -1, -1}; ///< corners
    Region region = Region::dam;
    std::array<int, 4> mid{-1, -1, -1,
                           -1}; ///< node in the middle of the edge from corner i to the next; -1: linear edge
    int centre = -1;            ///< node at the centre of a quadrilateral; -1: none
    double share = 1.0; ///< mean of Section::thickness over its height: a factor on stiffness and mass, no stress [-]

    int size() const { return nodes[3] < 0 ? 3 : 4; } ///< corners
    bool linear() const { return mid[0] < 0 && mid[1] < 0 && mid[2] < 0 && mid[3] < 0 && centre < 0; }
    ElementNodes all() const; ///< in the order of the element's matrices
};

/// The node in the middle of the quadratic edge between two corners.
struct EdgeNode {
    int a = 0, b = 0; ///< corners, a < b
    int mid = 0;
};

/// Consecutive nodes of a boundary in the counter-clockwise order of the body they belong to: going along the chain the
/// body is on the left, the outward normal of the edge (a, b) is (y_b - y_a, x_a - x_b) / length.
using NodeChain = std::vector<int>;

/// The plane between dam and rock, from the heel to the toe, always straight; of a dam on a seam the path of the seam, whose bends
/// have no pair (Mesh::seam).
struct ContactPlane {
    std::vector<int> dam_nodes;   ///< on the dam, heel to toe
    std::vector<int> rock_nodes;  ///< on the rock, heel to toe; at the same places if `matching`; empty: rigid base
    std::vector<double> distance; ///< of the dam's nodes from the heel, along the plane [m]
    std::vector<double> rock_node_distance; ///< of rock_nodes; `distance` itself if `matching` [m]
    bool matching = true;       ///< rock_nodes[i] lies where dam_nodes[i] does; otherwise only heel and toe coincide
    double share = 1.0; ///< of the width that is concrete [-]
    std::vector<int> rock_line; ///< rock surface nodes of the whole plane: it goes on straight past heel and toe,
                                ///< upstream to downstream
    std::vector<double>
        rock_distance; ///< of rock_line from the heel, along the plane; negative upstream of the heel [m]
};

/// A horizontal joint through the dam, or the path of a crack: its nodes exist twice, as those of the base do. Or an upright interface between two blocks of
/// rock on a seam, where "below" is upstream and "above" downstream.
struct LiftPlane {
    std::vector<int> lower_nodes; ///< of the dam below, upstream to downstream; of an interface from the ground down
    std::vector<int> upper_nodes; ///< of the block above, at the same places
    std::vector<double> distance; ///< of these nodes from the upstream face, along the joint [m]
    double share = 1.0;           ///< of the width that is concrete [-]
    bool upright = false;         ///< an interface
    bool bent = false;            ///< the path of a crack: each pair has its own direction
    double beyond = 0.0; ///< from the last pair on to the bend of the path, where three bodies meet and no pair is [m]
};

/// Below a dam on a seam: the path as two lines of nodes from upstream to downstream, and the faces with water in them.
struct SeamLine {
    struct Segment {
        int first = 0, end = 0;        ///< pairs of ContactPlane
        Point tangent;                 ///< downstream
        double before = 0.0, beyond = 0.0; ///< lengths next to the ends that belong to a bend, without a pair [m]
    };
    struct Face {
        NodeChain upstream, downstream; ///< of the bodies on either side of it; empty: there is none
    };
    std::vector<Segment> segments;
    std::vector<int> body, rock;                     ///< all nodes; of the bodies each bend twice
    std::vector<double> body_distance, rock_distance; ///< along the path [m]
    std::vector<std::array<int, 3>> bends;           ///< upstream and downstream body, rock: at one place
    Face crack, end;                                 ///< above the first point of the path, and above its last
    std::vector<Face> interfaces;                    ///< of each bend
    std::vector<int> base;                           ///< the dam's nodes on the rock that moves with it, heel to toe
};

struct Mesh {
    std::vector<Point> nodes;      ///< dam nodes first (those of lift joints twice), then the rock's
    std::vector<Element> elements; ///< dam first, then rock and curtain
    int dam_node_count = 0;
    int dam_element_count = 0;

    ContactPlane contact;
    std::optional<SeamLine> seam;     ///< none: the dam on its base
    std::vector<LiftPlane> lifts;     ///< from the bottom up, then interfaces on a seam: in the order of joints_of()
    std::vector<LiftPlane> tied_lifts; ///< the same of Scene::tied_lifts: both sides have the same nodes
    std::vector<EdgeNode> edge_nodes; ///< of all quadratic edges, by a, then b. Chains and planes below are of corners
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

/// The node in the middle of the edge between two corners; -1 where the edge is linear or there is none.
int mid_node(const Mesh& mesh, int a, int b);

/// A chain with the middle nodes of its quadratic edges in between.
std::vector<int> with_mid_nodes(const Mesh& mesh, const NodeChain& chain);

/// Corner coordinates of one element in node order; unused entries of a triangle are (0, 0).
std::array<Point, 4> corners(const Mesh& mesh, const Element& element);

enum class QuadraticKind {
    serendipity, ///< nodes in the middle of edges: Q8, T6
    lagrange     ///< and at the centres of quadrilaterals: Q9, T6
};

/// Makes a mesh of linear elements quadratic: every edge gets a node in its middle, except the edges on contact planes
/// (base and lift joints, both sides, and the rock's surface along which the dam may slide), so that contact, uplift and
/// their integrals are those of the linear mesh; the elements at them are transition elements. Water loads, added mass
/// and acoustic coupling integrate over quadratic edges. New nodes of the dam follow the dam's, those of the rock come
/// last: the rock's nodes are renumbered. Same mesh, same bits.
void make_quadratic(Mesh& mesh, QuadraticKind kind);

enum class BaseNodes {
    twice, ///< as the mesh has them: the dam's and the rock's
    shared ///< the dam's alone; a base whose sides match only
};

/// Sets the shares of dam elements, base and lift joints by Section::thickness.
void set_shares(Mesh& mesh, const Section& section, const std::vector<LiftJoint>& lift_joints);

/// A mesh with the physical groups that import_mesh asks for, in metres: surfaces "dam", "rock", "curtain"; lines "base" (the
/// dam's edges), "upstream", "crest", "downstream", "floor", "ground", "rock-left", "rock-bottom", "rock-right". Node tags are
/// those of the mesh plus one. Lift joints keep their nodes twice.
GmshFile export_mesh(const Mesh& mesh, BaseNodes base = BaseNodes::twice);

} // namespace damslip::fe2d
