#pragma once

#include "fe2d/mesh/faces.hpp"
#include "fe2d/mesh/mesh.hpp"
#include "scene/mesh_sizes.hpp"
#include "scene/scene.hpp"

#include <vector>

namespace damslip::fe2d {

/// How far the fine part of the rock surface goes on, straight, past heel and toe: the dam may slide that far.
struct ContactExtension {
    double upstream = 1.0;   ///< [m], >= 0
    double downstream = 1.0; ///< [m], >= 0
};

/// Turns the linear quadrilaterals and triangles of a mesh, whoever made it, into elements of the wanted kind:
/// quadrilaterals split along their shorter diagonal (t3, t6), middle nodes added (q8, q9, t6; element/elastic.hpp).
void shape_elements(Mesh& mesh, ElementKind kind);

/// Whether the curtain is a zone of its own in the mesh (build_mesh).
bool curtain_is_meshed(const Scene& scene);

/// Meshes the dam and, where the scene has a foundation, the rock box (scene.mesh gives sizes, growth and element kind,
/// see shape_elements). A curtain is a zone of its own where
/// its stiffness differs from the rock's, or its permeability does and scene.stages.pore_pressure puts the flow on this
/// mesh; any other curtain is rock, and the mesh that of the scene without it. With scene.mesh.rock_contact_size the
/// rock's nodes on the contact plane are its own. With scene.mesh.file the mesh is that of the file (import_mesh.hpp). Node places depend on the scene only: same scene, same bits.
/// @throws InputError when the section cannot be meshed (faces.hpp, quality.hpp), or the box does not hold the base,
///         its extensions or the curtain.
Mesh build_mesh(const Scene& scene, const ContactExtension& extension = {});

/// Element size as a function of the distance d from where the mesh is fine: h(d) = min(largest, first + d ln(growth)).
/// With it neighbouring elements differ by the factor `growth` until `largest` is reached.
struct Grading {
    double first = 1.0;   ///< size at d = 0 [m], > 0
    double growth = 1.0;  ///< ratio of neighbouring sizes [-], >= 1
    double largest = 1.0; ///< [m], >= first

    double size_at(double distance) const;
    double elements_to(double distance) const;          ///< integral of dd/h(d): elements between 0 and `distance`
    double distance_after(double element_number) const; ///< inverse of elements_to
};

/// Positions from stations.front() to stations.back(), graded away from the first, with every station exactly among
/// them.
/// @param stations  strictly increasing, at least two
/// Each interval gets the nearest whole number of elements, at least one.
std::vector<double> graded_positions(const std::vector<double>& stations, const Grading& grading);

/// Positions with every station among them, each interval divided evenly into the nearest whole number of parts of
/// `size`, at least one.
std::vector<double> even_positions(const std::vector<double>& stations, double size);

/// The bodies build_mesh() makes, each by a layout that is fixed before any node is made.

/// Wanted element size over the mean height above the base: fine at the base, and at every lift joint whose bond breaks by its
/// fracture energy (lift_mesh_size), growing from there.
struct DamSizes {
    struct FineLayer {
        double height = 0.0; ///< mean height of the layer above the base [m]
        Grading grading;     ///< of the distance from it, up and down
    };
    Grading base;
    std::vector<FineLayer> lifts = {};

    double size_at(double height) const;
    /// Positions from the base to the crest with every station among them.
    std::vector<double> positions(const std::vector<double>& stations) const;
};

/// Sizes the dam is meshed with.
struct DamLayout {
    std::vector<double> base; ///< node distances from the heel along the base [m], 0 ... base length
    std::vector<double> rows; ///< face parameter s of every row of nodes, 0 ... 1
    std::vector<int> joints;  ///< indices in `rows` of the lift joints, increasing
    std::vector<int> tied;    ///< the same of tied lifts
    DamSizes sizes;           ///< element size against the mean height above the base [m]
};

/// Appends the dam to an empty mesh: quadrilaterals in rows that follow both faces. Where the columns have become much
/// narrower than the element size of their height, four columns become two by a row of six quadrilaterals, so that
/// elements stay near square up to a narrow crest; below a bonded lift two columns become four in the same way; a section that ends in a point ends in triangles. Rows at
/// lift joints are made twice. Fills dam nodes, elements, faces, crest, contact.dam_nodes, lifts and tied_lifts.
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

/// Appends to a mesh that holds the dam the rock above the path of scene.seam_body as part of it, then the rock below: upright columns
/// through the dam's base nodes. Where rock above the path thins out its rows end one after the other in triangles.
/// @throws InputError where the box does not hold the path
void append_rock_with_seam(Mesh& mesh, const Scene& scene, const MeshSizes& sizes);

/// The water upstream of the dam as a mesh of its own (one pressure per node): rows at constant height, columns graded away from the
/// face. Its rows need not meet the dam's: pressure and displacement are coupled by the integral over the face they share.
struct ReservoirMesh {
    Mesh mesh; ///< nodes and elements of Region::reservoir only
    NodeChain
        face; ///< heel to water surface, every kink of the dam's face among its nodes; the water is on the left. Above the
              ///< crest it goes on vertically: a rigid wall over the crest's upstream end
    NodeChain surface;  ///< face to far end
    NodeChain far_end;  ///< surface to bottom, vertical
    NodeChain bottom;   ///< far end to heel, horizontal
    double depth = 0.0; ///< of the water over the heel [m]
};

/// The scene must have a reservoir with a level above the heel. The bottom is horizontal at the heel's height. Rows are
/// reservoir.mesh_size apart, level / 20 unless given: three quarter waves over the depth with an error below 0.1 %.
/// @throws InputError when the reservoir is shorter than the face leans upstream.
ReservoirMesh build_reservoir_mesh(const Scene& scene);

} // namespace damslip::fe2d
