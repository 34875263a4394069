#pragma once

#include "fe2d/mesh/mesh.hpp"
#include "scene/scene.hpp"

namespace damslip::fe2d {

/// The water upstream of the dam as a mesh of its own (one pressure per node): rows at the levels of the dam's face nodes, columns graded
/// away from the face. Pressure and displacement live on different nodes at the same places; `dam_face` says which belong together.
struct ReservoirMesh {
    Mesh mesh;      ///< nodes and elements of Region::reservoir only
    NodeChain face; ///< heel to water surface; the water is on the left
    std::vector<int>
        dam_face; ///< node of the structure's mesh at the place of each node of `face` the dam reaches; may be shorter than
        ///< `face` where the water stands above the crest (the rest is a rigid wall over the crest's upstream end)
    NodeChain surface; ///< face to far end
    NodeChain far_end; ///< surface to bottom
    NodeChain bottom;  ///< far end to heel
    double depth =
        0.0; ///< of the water over the heel [m]: the scene's level, moved to the nearest face node within 2 % of an element
};

/// @param structure  build_mesh(scene), whose rows include the water level
/// The scene must have a reservoir with a level above the heel. The bottom is horizontal at the heel's height.
/// @throws InputError when the reservoir is shorter than the face leans upstream.
ReservoirMesh build_reservoir_mesh(const Scene& scene, const Mesh& structure);

} // namespace damslip::fe2d
