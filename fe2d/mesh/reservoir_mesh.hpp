#pragma once

#include "fe2d/mesh/mesh.hpp"
#include "scene/scene.hpp"

namespace damslip::fe2d {

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
