#pragma once

#include "fe2d/assembly/assemble.hpp"
#include "fe2d/assembly/surface_load.hpp"
#include "fe2d/mesh/build_mesh.hpp"
#include "scene/scene.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace damslip::fe2d {

/// What the caller decides about the model, besides the scene.
struct ModelOptions {
    Base base = Base::tied;
    MassKind mass = MassKind::consistent;
    RockEdges edges =
        RockEdges::fixed; ///< free: dashpots on them (edge_damping), for runs in time with rock that has mass
    ContactExtension extension = {};
    AddedMassLaw added_mass =
        {}; ///< of the upstream face; used only when the scene has a reservoir; empty: no added mass
};

/// What one effect adds to the system.
struct EffectCount {
    std::string effect; ///< "dam", "foundation", "curtain", "added mass"
    std::int64_t elements = 0;
    std::int64_t unknowns = 0; ///< that would not be there without it
    std::int64_t nonzeros = 0; ///< stored matrix entries (K and M) that would not be there without it
    std::int64_t bytes = 0;    ///< of those entries and of four vectors of those unknowns
};

/// Counts of a model, taken from the assembled matrices themselves (assembling costs milliseconds), so what is
/// announced before a run and what the run holds are the same numbers. The effects sum to the totals.
struct ModelCounts {
    std::vector<EffectCount> effects; ///< only those the scene has
    std::int64_t elements = 0;
    std::int64_t unknowns = 0;
    std::int64_t nonzeros = 0;
    std::int64_t bytes = 0;

    void add(EffectCount effect); ///< fills the effect's bytes and sums up
};

/// The assembled structure of one scene. Only what the scene holds is there: without a foundation no rock unknowns,
/// without a reservoir (or without a law for it) `added_mass` has no entries, without a curtain no curtain elements.
struct Model {
    Mesh mesh;
    DofMap dofs;
    Materials materials;
    SparseMatrix stiffness; ///< K [N/m per m]
    MassKind mass_kind = MassKind::consistent;
    SparseMatrix mass;         ///< of the structure [kg/m]; rows of massless rock are empty
    SparseMatrix rock_mass;    ///< the rock's part of `mass`; without entries where it is massless (Foundation::mass)
    SparseMatrix edge_damping; ///< dashpots on free edges of the rock box [N s/m^2]; without entries on fixed ones
    Materials loaded;        ///< materials whose densities are what the moving ground loads: the dam's, and the rock's
                             ///< where it has mass and fixed edges. On free edges the rock moves relative to the free
                             ///< field, which balances its own inertia
    SparseMatrix added_mass; ///< of the water on the upstream face [kg/m]
    Eigen::VectorXd inertia_x,
        inertia_y; ///< (mass of `loaded` + added mass) times a rigid translation in x, y, fixed nodes included [kg/m]
    Eigen::Vector2d total_mass =
        Eigen::Vector2d::Zero(); ///< of everything the ground's motion loads, in x and in y, added mass included [kg/m]
    ModelCounts counts;

    SparseMatrix moving_mass() const; ///< mass + added_mass
    SparseMatrix dam_mass() const;    ///< mass - rock_mass
    bool rock_has_mass() const { return rock_mass.nonZeros() > 0; }
};

/// Meshes the scene and assembles its matrices. With a tied base scene.mesh.rock_contact_size is left aside: the nodes
/// of both sides face each other.
/// @throws InputError when the section cannot be meshed or a Young's modulus is missing.
Model build_model(const Scene& scene, const ModelOptions& options = {});

/// The same on a mesh that is there already.
Model build_model_on(Mesh mesh, const Scene& scene, const ModelOptions& options = {});

} // namespace damslip::fe2d
