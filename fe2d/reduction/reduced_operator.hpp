#pragma once

#include "fe2d/contact/joint_laws.hpp"
#include "fe2d/reduction/dam_modes.hpp"
#include "fe2d/reduction/reduced_water.hpp"
#include "fe2d/run/dynamic_contact.hpp"
#include "fe2d/run/dynamic_operator.hpp"
#include "fe2d/run/static_contact.hpp"
#include "fe2d/solver/dense_product.hpp"
#include "fe2d/time/scheme.hpp"

#include <map>
#include <memory>
#include <mutex>

namespace damslip::fe2d {

/// What a reduced run needs beside the step size: modes, and the massless body on the plane. Radiating rock joins with its own
/// modes, of mass 1 too, after the dam's: pushed the other way by the same forces, -Φ of the rock is its part of the
/// gaps. Its damping couples them; its residual flexibility belongs to the massless body.
///
/// Acoustic water (ReducedWater) stands between the dam's modes, which then end in attachment modes for the pressures on the
/// face, and the rock's. It has mass and stiffness of its own, of the other sign, is coupled by -s φᵀH V as CoupledSystem
/// is, and has no part in the gaps. Where the floor is the rock's, the rock ends in attachment modes for the pressures there;
/// its residual flexibility has no inertia to tell: they get that of ten times the water's highest frequency.
struct ReducedSystem {
    DamModes modes;
    Eigen::Index dam_modes = 0; ///< of `modes` those of the dam alone, the first ones
    Eigen::MatrixXd
        radiation; ///< damping of the last modes, the rock's, without b_K [1/s]; empty: the rock does not radiate
    std::shared_ptr<const ReducedWater> water; ///< null: none
    Eigen::Index water_begin = 0;              ///< its first shape among `modes`
    SymmetricProduct water_mass, water_stiffness; ///< of `water`
    Eigen::MatrixXd of_face,
        of_floor; ///< damping between the dam's modes, those of the rock, and the water's shapes; empty: none
    Eigen::MatrixXd flexibility; ///< F_s = rock K_c⁻¹ or F_res + residual of the dam, in series, 2m x 2m [m²/N]
    RunDamping damping;
    double slip_damping = 0.0;   ///< k' of SlipDamping [N s/m per m]; 0: none
    Eigen::VectorXd mean_motion; ///< φᵀm̂: motion along the plane that each mode stands for [kg^1/2 m^-1/2 ...]
    Eigen::VectorXd weights;     ///< ω of SlipDamping

    /// @param radiating  rock of the motion on the plane; null: massless rock, or none
    /// @param water  acoustic, of the structure's; null: none @param highest  ω up to which its pressures are right [rad/s]
    ReducedSystem(const ContactStructure& structure, DamModes modes, const RunDamping& damping,
                  const ReducedRock* radiating = nullptr, std::shared_ptr<const ReducedWater> water = {},
                  double highest = 0.0);
    Eigen::Index rock_modes() const { return radiation.rows(); }
    bool slips_damped() const { return slip_damping != 0.0; }

private:
    void add_water();
    void add_rock(const ReducedRock& rock, double highest);
};

/// Φ in parts. The dam's modes have their own columns. The water's shapes have none. Radiating rock has many modes, but they make
/// few shapes on the plane, so its part is U P. What U P leaves of a mode is below 1e-8 of the rock's largest mode there.
struct PlaneShapes {
    explicit PlaneShapes(const ReducedSystem& system);

    Eigen::Index dam = 0;  ///< modes before those of water and rock
    Eigen::MatrixXd ports; ///< U, orthonormal, 2m x r; empty: the rock does not radiate
    Eigen::MatrixXd rock;  ///< P, r x N
    TransposedProduct to_dam, to_ports, to_rock; ///< Φᵀ of the dam, Uᵀ, Pᵀ
};

/// One step size of the reduced run: DynamicOperator with A_d = d, n x n, and the massless body
///
///     d = a0 + w a1 (a_M φᵀM_damφ + radiation) + w (1 + a1 b_K) diag(ω²),   Δq = d⁻¹ (b + Φᵀ λ̃ + k μ s_Δ),   Φ = D φ
///
/// (acoustic water: its own mass and stiffness in place of 1 and ω²; d is then quasi-definite, and its inverse still positive
/// definite on all that has a part in the gaps)
///
///     w (1 + a1 b_K) Δp = λ̃ + π,   Δg = Φ Δq + F_s Δp,   p: elastic force of the massless body
///
/// so W = Φ d⁻¹ Φᵀ + F, F = F_s/(w (1 + a1 b_K)), and with the free step q* = d⁻¹ b
///
///     W⁻¹ (Φ q* + F π) = π + W⁻¹Φ (q* - d⁻¹ Φᵀπ)
///
/// and Δq = d⁻¹ (b - Φᵀπ) + (Φ d⁻¹)ᵀ(λ̃ + π) + ... need products with Φ, W⁻¹Φ and Φ d⁻¹ only: 2m x n, nothing 2m x 2m but the
/// contact problem itself. F_s is never inverted.
///
/// Damping of every kind, C, adds the force C r by the rates r at the start of the step. It needs no product with C, and b does
/// not hold it: d = a0 M + w a1 C + w K, so  d⁻¹ C r = ρ - d⁻¹ (a0 M + w K) ρ  with ρ = r/(w a1).
///
/// Nothing in it changes: runs and threads share it.
class ReducedOperator {
public:
    /// What a run lends to the functions below; kept from step to step, it is not allocated again.
    struct Work {
        Eigen::VectorXd modal, plane, ports, rock, water, moved, pressures, room;
        Eigen::VectorXd free;  ///< d⁻¹ (b - Φᵀπ)
        double mean = 0.0;    ///< μᵀd⁻¹ b [m]
    };

    ReducedOperator(const Plane& plane, const ReducedSystem& system, const PlaneShapes& shapes, const StepConstants& constants);

    const StepConstants& constants() const { return constants_; }
    const std::shared_ptr<const Eigen::MatrixXd>& stiffness() const { return stiffness_; } ///< V of the contact problem

    /// λ⁰ for a gap that stays as it is.
    /// @param load  b less (a0 M + w K) ρ [..], modal @param rates  ρ @param massless  π [N/m]
    /// @param known  α λ₀ + λ_rest - (slip damping) [N/m]
    void stuck_force(const Eigen::VectorXd& load, const Eigen::VectorXd& rates, const Eigen::VectorXd& massless,
                     const Eigen::VectorXd& known, Work& work, Eigen::VectorXd& stuck) const;

    /// Δq and Δp for λ₁ = `force`; `slip` = ωᵀΔg_t [m]. @param work  as stuck_force() left it; of no load: zero
    void finish(const Eigen::VectorXd& massless, const Eigen::VectorXd& known, const Eigen::VectorXd& force, double slip,
                Work& work, Eigen::VectorXd& modal_step, Eigen::VectorXd& massless_step) const;

private:
    void soften(const Eigen::VectorXd& load, Work& work, Eigen::VectorXd& step) const;
    void push(Work& work, Eigen::VectorXd& step) const;

    const ReducedSystem& system_;
    const PlaneShapes& shapes_;
    StepConstants constants_;
    // d⁻¹: dam and rock meet in the water alone, by F and G on its pressures, so
    //     y = S⁻¹ (b_W - (D⁻¹F)ᵀ b_D - (R⁻¹G)ᵀ b_R),   D⁻¹ b_D - D⁻¹F y,   R⁻¹ b_R - R⁻¹G y,   S = W - FᵀD⁻¹F - GᵀR⁻¹G
    SymmetricProduct dam_, rock_, water_;                          ///< D⁻¹, R⁻¹, S⁻¹; no rows: there is none
    Eigen::MatrixXd dam_per_pressure_, rock_per_pressure_;         ///< D⁻¹F, R⁻¹G
    Eigen::MatrixXd dam_to_pressures_, rock_to_pressures_;         ///< transposed
    Eigen::MatrixXd water_per_pressure_;                           ///< the columns of S⁻¹ of its pressures
    Eigen::MatrixXd gaps_to_pressures_;                            ///< -(Φ (D⁻¹F, R⁻¹G))ᵀ
    TransposedProduct to_dam_steps_;                               ///< (Φ D⁻¹)ᵀ
    TransposedProduct to_rock_steps_;                              ///< (P R⁻¹)ᵀ
    Eigen::MatrixXd stiff_modes_;     ///< W⁻¹Φ of the dam
    Eigen::MatrixXd stiff_ports_;     ///< W⁻¹U
    double k_ = 0.0, zeta_ = 0.0, massless_factor_ = 1.0;
    Eigen::VectorXd softened_motion_; ///< d⁻¹ μ
    Eigen::VectorXd z_;               ///< Φ d⁻¹ μ
    std::shared_ptr<const Eigen::MatrixXd> stiffness_;
};

/// A plane and the system on it, with the operators of its steps: one by step size, made when first asked for, then shared
/// by all runs, whatever their friction and motion. Threads may ask at the same time.
class ReducedModel {
public:
    ReducedModel(Plane plane, ReducedSystem system, const Scheme& scheme);
    ReducedModel(const ReducedModel&) = delete;
    ReducedModel& operator=(const ReducedModel&) = delete;

    const Plane& plane() const { return plane_; }
    const ReducedSystem& system() const { return system_; }
    const ReducedOperator& at(double dt) const; ///< @param dt  > 0 [s]

private:
    Plane plane_;
    ReducedSystem system_;
    PlaneShapes shapes_;
    Scheme scheme_;
    mutable std::mutex mutex_;
    mutable std::map<double, std::unique_ptr<const ReducedOperator>> operators_;
};

/// The contact plane with neighbouring pairs joined to groups: gaps are area means of the group's, a force on the group is
/// spread over its pairs by area (uniform pressure). Too coarse for a slip, good enough for how much a slip changes
/// with the number of modes, and cheap: contact costs the square of the pairs.
class CoarsePlane {
public:
    /// @param groups  wanted, >= 1; each pair stands alone when there are no more
    CoarsePlane(const Plane& plane, int groups);

    const Plane& plane() const { return coarse_; } ///< a group stands as one pair
    ReducedSystem coarsened(const ReducedSystem& system) const;

    /// All groups shut and sticking, forces summed: for differences of two runs on this plane.
    ContactMemory shut(const ContactMemory& memory) const;

private:
    std::size_t group_of(Eigen::Index pair) const; ///< the groups are of consecutive pairs
    Eigen::MatrixXd mean_;                         ///< area means of the groups, groups x m
    Eigen::MatrixXd both_;                         ///< of normal and tangential components, 2 groups x 2m
    Plane coarse_;
};

/// Motion since the static state, on the modes kept, and the contact as in the full run.
struct ReducedState {
    double time = 0.0;           ///< [s]
    Eigen::VectorXd q, q_v, q_a; ///< modal amplitudes since the static state
    Eigen::VectorXd p, p_v, p_a; ///< elastic force of the massless body since then, and its rates [N/m]
    Eigen::VectorXd gap_v, gap_a; ///< rates of the gaps, elastic part included, 2m [m/s, m/s²]
    ContactMemory contact;
    GroundAcceleration ground;
};

/// The steps of DynamicContact on a reduced dam: same scheme, same contact solver, same damping.
class ReducedContact {
public:
    /// @param model  kept by reference
    /// @param rest  contact in static equilibrium; the motion starts there, at rest
    ReducedContact(const ReducedModel& model, const ContactMemory& rest, const Contact& joint = {},
                   const ContactOptions& options = {});

    /// One step to the given ground acceleration, as DynamicContact::advance. With laws of the joint it is made in halves where its
    /// contact is not resolved.
    ContactReport advance(double dt, const GroundAcceleration& ground, const ContactLaw& law, int cuts = 0);

    const ReducedState& state() const { return state_; }
    const DynamicCounts& counts() const { return counts_; }
    double mean_slip() const; ///< area mean since the static state [m]
    double crest() const;     ///< horizontal motion of the crest since then, relative to the ground [m]
    double kinetic() const { return 0.5 * state_.q_v.squaredNorm(); } ///< of the modes [J/m]
    double friction() const { return friction_; } ///< dissipated since the start, by the mean force of each step [J/m]

private:
    /// A step size: what all runs share, and the contact solver of this run.
    struct Step {
        const ReducedOperator* shared;
        std::unique_ptr<JointSolver> contact;
        std::unique_ptr<JointLawSolver> with_laws = {}; ///< null: none needed so far
    };
    Step& step_of(double dt);
    ContactReport solve_laws(Step& step, const ContactLaw& law);
    ContactReport in_halves(double dt, const GroundAcceleration& ground, const ContactLaw& law, int cuts);
    void change_by(const Step& step);
    void land(Step& step, const ContactLaw& law);
    void right_hand_side(const StepConstants& constants, const GroundAcceleration& ground);

    const ReducedModel& model_;
    const Plane& plane_;
    const ReducedSystem& system_;
    Contact joint_;
    ContactOptions options_;
    std::map<double, Step> steps_; ///< by size
    Eigen::VectorXd rest_force_, rest_slip_;
    double normal_force_ = 0.0; ///< static N', the scale of residuals [N/m]
    ReducedState state_;
    double friction_ = 0.0;
    DynamicCounts counts_;

    // Work space.
    Eigen::VectorXd load_, massless_, known_, stuck_, modal_step_, massless_step_, gap_step_, rates_, inertia_, strain_, elastic_;
    Eigen::VectorXd no_force_;                   ///< zeros
    Eigen::VectorXd force_before_, force_after_, slip_before_; ///< of the step: λ_c and slip
    ContactStates states_before_;
    ContactSolution solution_, jumps_;
    JointLaws laws_; ///< of the step; those of the state change when it is made
    ReducedOperator::Work work_, no_load_work_;
};

} // namespace damslip::fe2d
