#pragma once

#include "core/status.hpp"
#include "fe2d/time/linear_integrator.hpp"
#include "records/record.hpp"

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

namespace damslip::fe2d {

/// Work of the interface forces over one step, by the caller who knows their directions [J/m]. They must sum up to
/// ½ (λ₀ + λ₁)ᵀ B Δu = normal - friction - radiated - numerical, else the ledger does not close.
struct InterfaceWork {
    double friction = 0.0;  ///< dissipated by sliding, positive
    double normal = 0.0;    ///< done by contact pressure on opening and closing, positive when it drives the structure
    double radiated = 0.0;  ///< carried away through absorbing boundaries, positive
    double dashpots = 0.0;  ///< what part of the work of C v is: it counts as radiated, not as damping
    double numerical = 0.0; ///< lost by the scheme in the coupling of dam and water (CoupledEnergy), positive
    double floor = 0.0;     ///< done by water on the rock below it: Energy::floor
};

/// Energies per metre of dam length [J/m], of the motion relative to the ground. Kinetic and strain are of the state,
/// the rest is summed over the steps from the start.
struct Energy {
    double kinetic = 0.0;        ///< ½ vᵀ M v
    double strain = 0.0;         ///< ½ uᵀ K u, and what soft normal contact stores
    double damping = 0.0;        ///< C v, dissipated
    double numerical = 0.0;      ///< dissipated by the scheme (gained, when negative); computed from the states
    double friction = 0.0;       ///< dissipated
    double radiated = 0.0;       ///< left the model
    double external = 0.0;       ///< done by R: static loads and ground motion
    double contact_normal = 0.0; ///< done by contact pressures beyond what soft contact stores or gives back

    // Of the joints' laws beside contact and friction; zero without them.
    double joint_stored = 0.0;   ///< in bonds and anchors
    double bond_fracture = 0.0;  ///< spent on breaking bonds
    double anchor_plastic = 0.0; ///< spent on yielding anchors
    double anchor_loss = 0.0;    ///< stored in anchors that snapped
    double joint_water = 0.0;    ///< done by water that follows the opening, beyond its pressure before
    double impact = 0.0;         ///< lost in landings

    /// Done by the water's pressure on the rock below it (reservoir.floor = "rock"): what the floor takes from the water's
    /// waves and gives to the rock. It passes within the model and is no part of the balance.
    double floor = 0.0;

    /// Δ(kinetic + strain) + damping + numerical + friction + radiated - external - contact_normal since the start
    /// [J/m].
    double imbalance(const Energy& start) const;
    /// Largest of the terms so far, the scale of the imbalance [J/m].
    double scale() const;
};

/// Energy balance of a run, kept step by step. Every term is computed from the states before and after, none as the
/// remainder, so the balance closes only if the steps satisfy the equations of motion and the scheme's assumptions.
///
/// Sum the equation of motion of two successive steps, M a₁ = -(1+α)F₁ + αF₀ and M a₀ = -(1+α)F₀ + αF₋₁, with
/// F = C v + K u - R - Bᵀλ, half each, and multiply by Δuᵀ. With means (·)_m of the step and Newmark's assumptions in
/// the form Δv = Δt a_m + (γ-½)Δt Δa and Δu = Δt v_m + (β-γ/2)Δt² Δa the left side is Δuᵀ M a_m = Δ(½vᵀMv) plus terms
/// in Δa, so that
///
///     Δ(½vᵀMv + ½uᵀKu) + ΔuᵀC v_m + D = ΔuᵀR_m + Δuᵀ(Bᵀλ)_m
///     D = -(γ-½) ΔuᵀMΔa + (γ-½)(β-γ/2)Δt² ΔaᵀMΔa + (β-γ/2)Δt² Δ(½aᵀMa) + (α/2) Δuᵀ(F₁ - F₋₁)
///
/// D = 0 for average acceleration; β < γ/2 stores (β-γ/2)Δt² ½aᵀMa and gives it back; α < 0 dissipates.
/// F₋₁ of the first step is F₀, which is right for a start in equilibrium.
class EnergyLedger {
public:
    explicit EnergyLedger(const State& start);

    /// Adds the step from `before` to `after`. The scheme and step are those the step was made with.
    /// @param base  energies of the body that the interface forces come from (MovingBase): their work is in it then, and
    ///              `work` has none
    void add_step(const State& before, const State& after, const StepConstants& constants,
                  const InterfaceWork& work = {}, const Energy& base = {});

    const Energy& energy() const { return energy_; }
    double imbalance() const { return energy_.imbalance(start_); } ///< [J/m]
    double largest_scale() const { return scale_; }                ///< largest term of any step so far [J/m]

private:
    Energy start_, energy_, base_;
    double scale_ = 0.0;
};

/// Ground acceleration, velocity and displacement at one time; a_h positive upstream, a_v positive up, as in the record.
struct GroundState {
    double accel_h = 0.0, accel_v = 0.0;               ///< [m/s^2]
    double velocity_h = 0.0, velocity_v = 0.0;         ///< integrals from zero [m/s]
    double displacement_h = 0.0, displacement_v = 0.0; ///< integrals of these from zero [m]
};

/// Acceleration linear between samples, zero before the first and after the last; velocity and displacement its exact
/// integrals. After the end of the motion the velocity stays.
class GroundHistory {
public:
    explicit GroundHistory(const GroundMotion& motion);
    GroundState at(double time) const;
    double duration() const { return duration_; } ///< [s]

private:
    double dt_ = 0.0, duration_ = 0.0;
    std::vector<GroundState> samples_;
};

/// Load of the motion on the structure as it moves relative to the ground. With r_x, r_y rigid translations in x (downstream)
/// and y (up) and the ground acceleration in these axes a_g = (-a_h, +a_v):
///
///     R = R_static - M r a_g = R_static + M r_x a_h - M r_y a_v,
///
/// M the mass of everything that moves, added mass included. Where the mass-proportional damping resists the total velocity,
/// - a_M M_s (v + r v_g) on the structure's own mass, its second part is a load too:  + a_M M_s (r_x v_h - r_y v_v).
struct GroundLoad {
    Eigen::VectorXd still;              ///< R_static [N/m]
    Eigen::VectorXd mass_x, mass_y;     ///< M r_x, M r_y [kg/m]
    Eigen::VectorXd damped_x, damped_y; ///< a_M M_s r_x, a_M M_s r_y [kg/(m s)]; empty: relative velocity only
    Eigen::VectorXd velocity_x,
        velocity_y; ///< load of the water per ground velocity in these axes (CoupledSystem); empty: no water
    Eigen::VectorXd displacement_y; ///< and per vertical displacement

    void evaluate(const GroundState& ground, Eigen::VectorXd& load) const;
};

/// A body with inertia of its own that a dam is tied to, radiating rock say; its steps see no more of it than the base.
/// All is zero at rest; p are the forces on it beyond those at rest, and p̃ = (1 + α) p₁ - α p₀ of a step.
class MovingBase {
public:
    virtual ~MovingBase() = default;

    virtual std::int64_t unknowns() const = 0;
    virtual const Eigen::MatrixXd& compliance() const = 0;            ///< W_r, Δu by p̃, symmetric, >= 0 [m²/N]
    virtual const Eigen::VectorXd& begin_step() = 0;                  ///< @returns Δu where p̃ = 0 [m]
    virtual void end_step(const Eigen::VectorXd& weighted_force) = 0; ///< @param weighted_force  p̃ [N/m]
    /// kinetic and strain of the state; damping, radiated and numerical since rest [J/m]. With the work of p, as
    /// BaseCoupling::numerical_work() splits it, they close.
    virtual Energy energy() const = 0;

    /// Last rows of all this that belong to the water's floor (ReducedRock::floor), and their v̇, v̈ at the start of the step.
    virtual Eigen::Index floor() const { return 0; }
    virtual Eigen::VectorXd floor_velocity() const { return {}; }
    virtual Eigen::VectorXd floor_acceleration() const { return {}; }
};

enum class TiedRunStatus {
    complete,
    cancelled,     ///< stopped by the caller; everything up to there is valid
    solver_failed, ///< a matrix could not be factorised; no step was made
    diverged       ///< a value is no longer finite; the last row is the last finite state
};

/// One row of a run, at the end of a step. Displacements are relative to the ground, accelerations absolute.
struct HistoryRow {
    double time = 0.0;                                 ///< [s]
    double ground_accel_h = 0.0, ground_accel_v = 0.0; ///< a_h positive upstream, a_v positive up [m/s^2]
    double crest_x = 0.0, crest_y = 0.0; ///< displacement of the crest's upstream end, downstream and up [m]
    double crest_accel_x = 0.0, crest_accel_y = 0.0; ///< absolute, downstream and up [m/s^2]
    double base_shear = 0.0;                         ///< of the dam on the rock, positive downstream [N/m]
    double base_normal = 0.0; ///< of the dam on the rock, compression positive [N/m]; total, without uplift
    double water_force_x =
        0.0;       ///< of acoustic water beyond the static one on the dam, positive downstream [N/m]; 0 without
    Energy energy; ///< [J/m]
    double imbalance = 0.0; ///< of the energies since the start [J/m]
};

/// What a superposition of modes leaves out. The modes left out follow the ground statically; the errors are estimates of
/// the dynamic part of them, see integrate_modal().
struct ModalTruncation {
    int modes = 0;
    double highest_frequency = 0.0;                       ///< of the modes kept [Hz]
    Eigen::Vector2d mass_share = Eigen::Vector2d::Zero(); ///< effective mass kept, in x and in y [-]
    double damping_coupling = 0.0; ///< largest |φ_iᵀCφ_j| over the root of φ_iᵀCφ_i φ_jᵀCφ_j, i ≠ j; 0: classical [-]
    double crest_x_error = 0.0;       ///< [m]
    double crest_accel_x_error = 0.0; ///< [m/s^2]
    double base_shear_error = 0.0;    ///< [N/m]
};

/// What a run gives, and how it ended.
struct History {
    TiedRunStatus status = TiedRunStatus::complete;
    Note ending{NoteKind::steps_done}; ///< how it ended, with the numbers
    std::vector<HistoryRow> rows; ///< the start and every step; thinned where asked for
    Eigen::VectorXd displacement; ///< of all model unknowns at the end [m]
    double time_step = 0.0;       ///< [s]
    std::int64_t steps = 0;       ///< made
    std::size_t factorisations = 0;
    std::int64_t unknowns = 0;       ///< of the system stepped
    std::string method;              ///< "HHT", "central difference", "24 modes" ...
    double step_limit = 0.0;         ///< of an explicit scheme [s]; 0: none
    ModalTruncation modal;           ///< of a superposition of modes; modes = 0: none
    double energy_scale = 0.0;       ///< largest energy of the run [J/m]
    double largest_imbalance = 0.0;  ///< over the steps, over energy_scale [-]
    double peak_crest_x = 0.0;       ///< largest |crest displacement - the one at the start| in x [m]
    double peak_crest_accel_x = 0.0; ///< largest |absolute crest acceleration| in x [m/s^2]
    double peak_base_shear = 0.0;    ///< largest, downstream [N/m]
    double peak_water_force = 0.0;   ///< largest |water_force_x| [N/m]
    std::vector<Note> notes;
};

/// Where a run stands, for a progress line.
struct RunProgress {
    double time = 0.0, end = 0.0; ///< [s]
    std::int64_t step = 0, steps = 0;
};

enum class RunAnswer { go_on, stop };

} // namespace damslip::fe2d
