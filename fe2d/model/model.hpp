#pragma once

#include "fe2d/assembly/assemble.hpp"
#include "fe2d/mesh/build_mesh.hpp"
#include "fe2d/solver/linear_solver.hpp"
#include "scene/scene.hpp"

#include <Eigen/Core>

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

/// One static load case as nodal forces of the model's unknowns.
struct StaticLoad {
    std::string name;
    Eigen::VectorXd force;     ///< [N/m], length dofs.count
    Eigen::Vector2d resultant; ///< on all nodes, the fixed ones included [N/m]: x downstream, y up
};

/// The scene's static loads by stage; a load the scene does not have is not in the list.
struct StaticLoads {
    std::vector<StaticLoad> rock;    ///< weight of all rock, where the dam stands on a seam: before the dam is there
    std::vector<StaticLoad> gravity; ///< weight of the dam, and of the rock where scene.stages asks for it
    std::vector<StaticLoad>
        impounding; ///< water on the upstream face, on the floor where asked for, tailwater, silt, ice, forces
};

/// @throws InputError when a point force or the ice is not on the dam.
StaticLoads static_loads(const Scene& scene, const Model& model);

/// Sum of the forces of one list [N/m]; zero when it is empty.
Eigen::VectorXd sum_of(const std::vector<StaticLoad>& loads, int unknowns);

/// Pressure in a lift joint [Pa] over the distance from the upstream face [m]: the hydrostatic head of the reservoir at
/// the upstream face, linear to that of the tailwater at the downstream face; nothing at a dry face. Empty where the
/// joint has no water or both faces are dry.
/// @param length  of the joint [m]
PressureProfile lift_water_profile(const Scene& scene, const LiftJoint& joint, double length);

/// The water of all lift joints on both their faces, open or not, and that in the faces up from the path of a seam [N/m]; empty
/// where there is none.
/// @param model  of the same scene
Eigen::VectorXd lift_water(const Scene& scene, const Model& model);

/// State after one stage of the static loading.
struct StaticStage {
    std::string name;             ///< "gravity", "impounding"
    Eigen::Vector2d resultant;    ///< of all loads up to here [N/m]
    Eigen::VectorXd displacement; ///< counted from the zero-displacement start where scene.stages.geostatic is set [m]
    Eigen::VectorXd elastic;      ///< displacement that carries the stresses: from the unloaded state, never reset [m]
};

struct StaticSolution {
    SolverReport solver; ///< when it is not ok(), `stages` is empty
    std::vector<StaticStage> stages;
};

/// Solves the stages of a tied model, one factorisation for all. A stage without loads is left out.
StaticSolution solve_static(const Scene& scene, const Model& model, const StaticLoads& loads,
                            const SolverOptions& options = {});

/// Forces the rock (or the rigid base) exerts on the dam at the base nodes, heel to toe, 2 x n [N/m]: internal forces
/// of the dam minus `dam_load`. For a tied base they are the nodal contact forces.
/// @param dam_load  forces on all dam nodes, by all_dofs(mesh, 2) [N/m]
Eigen::Matrix2Xd base_forces(const Model& model, const Eigen::VectorXd& displacement, const Eigen::VectorXd& dam_load);

/// Stresses of a displacement state, tension positive [Pa].
struct StressField {
    Eigen::Matrix3Xd nodal;  ///< (xx, yy, xy) of every node: mean over its elements of the same region; a node on the
                             ///< curtain's edge takes the mean of rock and curtain. The two sides of the contact plane
                             ///< are separate nodes and stay separate
    Eigen::Matrix3Xd centre; ///< (xx, yy, xy) of every element at its centre, the most accurate place
};

/// @param displacement  of the unknowns, length dofs.count [m]
StressField stress_field(const Mesh& mesh, const DofMap& dofs, const Materials& materials,
                         const Eigen::VectorXd& displacement);
/// The same with the model's locked stress.
StressField stress_field(const Model& model, const Eigen::VectorXd& displacement);

struct PrincipalStress {
    double major = 0.0; ///< the larger (more tensile) one [Pa]
    double minor = 0.0; ///< [Pa]
    double angle = 0.0; ///< of the major one from the x axis, -pi/2 ... pi/2 [rad]
};
PrincipalStress principal_stress(const Eigen::Vector3d& stress);

} // namespace damslip::fe2d
