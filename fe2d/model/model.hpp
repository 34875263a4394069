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
    Eigen::VectorXd locked_stress; ///< horizontal, of each node of rock, besides what its strain makes: foundation.k0 on a seam
                                   ///< [Pa, tension positive]; linear in each element; empty: none
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

/// Dashpots along the sides and the bottom of the rock box, rho c_p across the edge and rho c_s along it, shared by the
/// nodes of every element edge: a diagonal matrix on the unknowns that are there [N s/m^2].
///
///     sigma_n = - rho c_p v_n,   tau = - rho c_s v_t        Lysmer & Kuhlemeyer (1969), eqs. 1, 2 with a = b = 1
///
/// Exact for plane waves that meet the edge at a right angle; a body wave at another angle comes back in part.
/// @param rock  density > 0
SparseMatrix edge_dashpots(const Mesh& mesh, const DofMap& dofs, const ElasticMaterial& rock);

/// Speeds of plane waves [m/s]: c_p of compression, c_s of shear.
struct ElasticWaves {
    double p = 0.0, s = 0.0;
};
ElasticWaves elastic_waves(const ElasticMaterial& material);

/// Rest of a model on free edges of its rock box.
struct HeldStart {
    Eigen::VectorXd displacement; ///< on the unknowns of the model with free edges [m]
    Eigen::VectorXd load;         ///< on these [N/m], with the reactions of the edges
};

/// From fixed to free edges: dashpots hold nothing that stands still, so the static stages stand on fixed edges, and what
/// holds the edges there, K u on them, goes on as a constant load. The two models then rest at the same displacements,
/// and nothing moves before the ground does.
///
/// In the run displacements of the rock are u_total = u_ff + u, those of the dam u_total = r u_g + u: u_ff is the free
/// field, waves that go straight up and down in a homogeneous half space with the free surface y = 0,
///
///     u_ff(y, t) = ½ [u_g(t + y/c) + u_g(t - y/c)],   y <= 0,   u_ff(0, t) = u_g(t),
///
/// c_s for horizontal, c_p for vertical motion. It solves the rock's own equations and leaves its surface free of traction,
/// so it drops out of them; the dashpots resist u̇ alone, the waves that dam and rock send out; dam and rock meet where
/// u_ff = r u_g. The motion of the ground therefore loads the dam and its water only, as on massless rock, and the record
/// is the motion of the free surface. The same motion comes out of the direct method (Zienkiewicz, Bicanic & Shen 1989;
/// Løkke & Chopra 2017), which puts the stresses ρ c (2 u̇_up - u̇) of the incoming wave on the bottom and those of the free
/// field on the sides (verification/cases/fe_rock_cases.cpp compares). Left out: what the curtain's other modulus
/// scatters of the free field.
///
/// @param fixed, free  of one scene and base, apart from ModelOptions::edges
/// @param displacement, load  on the unknowns of `fixed`
HeldStart held_edges(const Model& fixed, const Model& free, const Eigen::VectorXd& displacement,
                     const Eigen::VectorXd& load);

/// Displacements on the unknowns of `fixed`: what its edges hold is left out.
Eigen::VectorXd without_edges(const Model& fixed, const Model& free, const Eigen::VectorXd& displacement);

} // namespace damslip::fe2d
