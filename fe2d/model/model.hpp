#pragma once

#include "fe2d/assembly/assemble.hpp"
#include "fe2d/assembly/surface_load.hpp"
#include "fe2d/mesh/build_mesh.hpp"
#include "fe2d/model/model_counts.hpp"
#include "scene/scene.hpp"

namespace damslip::fe2d {

/// What the caller decides about the model, besides the scene.
struct ModelOptions {
    Base base = Base::tied;
    MassKind mass = MassKind::consistent;
    ContactExtension extension = {};
    AddedMassLaw added_mass =
        {}; ///< of the upstream face; used only when the scene has a reservoir; empty: no added mass
};

/// The assembled structure of one scene. Only what the scene holds is there: without a foundation no rock unknowns,
/// without a reservoir (or without a law for it) `added_mass` has no entries, without a curtain no curtain elements.
struct Model {
    Mesh mesh;
    DofMap dofs;
    Materials materials;
    SparseMatrix stiffness; ///< K [N/m per m]
    MassKind mass_kind = MassKind::consistent;
    SparseMatrix mass;       ///< of the structure [kg/m]; rows of massless rock are empty
    SparseMatrix added_mass; ///< of the water on the upstream face [kg/m]
    Eigen::VectorXd inertia_x,
        inertia_y; ///< (mass + added mass) times a rigid translation in x, y, fixed nodes included [kg/m]
    Eigen::Vector2d total_mass =
        Eigen::Vector2d::Zero(); ///< of everything that moves, in x and in y, added mass included [kg/m]
    ModelCounts counts;

    SparseMatrix moving_mass() const { return mass + added_mass; }
};

/// Meshes the scene and assembles its matrices. With a tied base scene.mesh.rock_contact_size is left aside: the nodes
/// of both sides face each other.
/// @throws InputError when the section cannot be meshed or a Young's modulus is missing.
Model build_model(const Scene& scene, const ModelOptions& options = {});

/// The same on a mesh that is there already.
Model build_model_on(Mesh mesh, const Scene& scene, const ModelOptions& options = {});

} // namespace damslip::fe2d
