#pragma once

#include "fe2d/mesh/mesh.hpp"
#include "scene/scene.hpp"

#include <utility>
#include <vector>

namespace damslip::fe2d {

/// The section as its two faces, each from the base up to the crest. Both are functions of a height parameter s: s = 0
/// is the base (heel, toe), s = 1 the crest's upstream and downstream end; along each face y is linear in s. For a
/// horizontal base and crest a line s = const is a horizontal layer; an inclined base or crest is blended linearly over
/// the height, piecewise between the lift joints, which are horizontal layers always.
struct Faces {
    /// A layer that is horizontal whatever base and crest are, or follows the path of a crack.
    struct Layer {
        double s = 0.0;     ///< its height parameter
        double level = 0.0; ///< above the heel, at the upstream face [m]
        bool tied = false;  ///< of Scene::tied_lifts
        bool step = false;  ///< of Section::thickness
        double downstream = level; ///< at the downstream face [m]
        Polyline path = {};        ///< LiftJoint::path
    };

    Polyline upstream;         ///< heel to the upstream end of the crest, y strictly increasing
    Polyline downstream;       ///< toe to the downstream end of the crest, y strictly increasing
    std::vector<Layer> layers; ///< the lift joints and tied lifts, from the bottom up

    /// A node of the row s; near the path of a crack rows bend with it.
    Point at(double s, double fraction) const;
    Point upstream_at(double s) const;
    Point downstream_at(double s) const;
    double width_at(double s) const; ///< between the faces at s [m]
    double height() const;           ///< mean of both faces' heights [m]
    std::vector<double>
    kinks() const; ///< s of all vertices of both faces and of the layers, 0 and 1 included, increasing
    double parameter_of_level(double y) const; ///< s at which the upstream face reaches the level y [m]
    bool ends_in_point() const;                ///< the crest is a single point
};

/// Of a path whose x rises, at x; level beyond its ends [m].
double height_on(const Polyline& path, double x);

/// Where the crest ends (see split_faces): its downstream and its upstream end, equal where the section ends in a point.
std::pair<Point, Point> crest_ends(const Section& section);

/// Splits the section into its faces. The crest is the horizontal edge at the top; without one, the edge at the highest
/// vertex that is flatter than 35 degrees; without that, the highest vertex itself.
/// @throws InputError naming the vertices (counted from 1) where a face is horizontal or leads downwards, or the
/// polygon is not
///         counter-clockwise or has fewer than three vertices, or a lift joint does not go through both faces.
Faces split_faces(const Scene& scene);

/// Shape figures of a mesh. The scaled Jacobian of a corner is the sine of its angle (for triangles divided by sin 60
/// degrees): 1 is ideal, 0 is flat, negative is inverted.
struct MeshQuality {
    double smallest_edge = 0.0;  ///< [m]
    double largest_edge = 0.0;   ///< [m]
    double largest_aspect = 0.0; ///< longest over shortest edge of one element [-]
    double smallest_angle = 0.0; ///< [rad]
    double smallest_scaled_jacobian = 0.0;
    int worst_element = -1; ///< where the smallest scaled Jacobian is
    int quadrilaterals = 0, triangles = 0;
};

MeshQuality measure_quality(const Mesh& mesh);

/// Refuses a mesh with a flat, inverted or non-convex element (scaled Jacobian below 0.01).
/// @throws InputError with the region, the place of the element and the section's vertices beside it.
void check_quality(const Mesh& mesh, const Scene& scene);

} // namespace damslip::fe2d
