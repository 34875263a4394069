#pragma once

#include "fe2d/modes/modes_and_damping.hpp"
#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/time/energy.hpp"
#include "fe2d/time/structure_system.hpp"
#include "records/record.hpp"

#include <functional>
#include <memory>

namespace damslip::fe2d {

/// Options of a run on a tied base.
struct TiedRunOptions {
    Scheme scheme = {-0.05, 0.55, 0.275625};    ///< hht(-0.05)
    std::optional<double> dt;                   ///< [s], a whole part of the motion's step; default: that step
    DampingChoice damping;                      ///< default: none
    Eigen::VectorXd static_load;                ///< on the model's unknowns, constant [N/m]; empty: none
    Eigen::VectorXd start_displacement;         ///< at rest under static_load [m]; empty: K u = static_load is solved,
                                                ///< which rock on free edges does not allow (held_edges)
    Eigen::Vector2d static_resultant{0.0, 0.0}; ///< of the static loads on the dam, fixed nodes included [N/m]
    double free_vibration = 0.0;                ///< time after the motion's end without ground acceleration [s], >= 0
    int keep_every = 1; ///< steps per kept row of the history, >= 1; peaks and energies see every step
    RockTreatment rock = RockTreatment::condensed;
    /// Makes the body that the dam is tied to in the earthquake, for the constants of the step and b_K, with the unknowns of
    /// unknowns_of_base(); the model's rock, massless and condensed, is the one of the statics then. Empty: that one moves.
    std::function<std::unique_ptr<MovingBase>(const StepConstants&, double)> moving_base;
    const FluidModel* water =
        nullptr; ///< acoustic water on the upstream face, at rest at the start; null: none. The model then has
                 ///< no added mass
    SolverOptions solver;
    std::function<RunAnswer(const RunProgress&)> progress; ///< asked after every step; empty: none
};

/// Linear earthquake run of a dam tied to its base, from static equilibrium at rest.
///
/// The start is K u₀ = R_static, so nothing moves before the ground does. Motion relative to the ground; massless rock is
/// condensed exactly; rock with free edges and a moving base move relative to the free field (held_edges.hpp). Every step
/// is entered in the energy ledger. What holds the base at rest is a constant load on a dam whose base moves: its work is in
/// `external`, and the energies of the base count from rest.
/// @param model  with Base::tied
/// @throws InputError when dt is no whole part of the motion's step, or unstable for the scheme.
///         Everything else that can go wrong is in History::status.
History integrate(const Model& model, const GroundMotion& motion, const TiedRunOptions& options);

/// What a row of the history needs of a state, summed up by the caller.
struct TiedSums {
    Eigen::Vector2d crest = Eigen::Vector2d::Zero();       ///< displacement of the crest's upstream end [m]
    Eigen::Vector2d crest_accel = Eigen::Vector2d::Zero(); ///< its acceleration, relative to the ground [m/s^2]
    Eigen::Vector2d inertia = Eigen::Vector2d::Zero();     ///< rᵀM_dam a [N/m], see TiedProblem::mass_x
    Eigen::Vector2d damping = Eigen::Vector2d::Zero();     ///< a_M rᵀM_s v [N/m]
    Eigen::Vector2d water_force = Eigen::Vector2d::Zero(); ///< of acoustic water on the dam [N/m]
};

/// What every way of running a dam tied to its base starts from: matrices, loads, the state of rest.
struct TiedProblem {
    /// `model`, `options` are kept by reference.
    TiedProblem(const Model& model, const GroundMotion& motion, const TiedRunOptions& options);

    /// Loads and the displacements at rest under the static ones. @returns structure.solver.ok()
    bool prepare();
    /// K⁻¹ of each column; factorised on first use. Look at structure.solver before using it.
    Eigen::MatrixXd static_response(const Eigen::MatrixXd& loads);
    Eigen::VectorXd rigid_x() const; ///< unit translation of the system's unknowns in x ...
    Eigen::VectorXd rigid_y() const; ///< ... and in y
    double other_damping() const;    ///< part of C that is neither a_M M_s nor b_K K, over all of it [-]
    /// Row without energies. Force of the dam on the rock from the balance of the whole dam: with a rigid translation r the
    /// internal forces drop out, rᵀR_static + rᵀH p - rᵀM (ü + r a_g) - a_M rᵀM_s (u̇ [+ r v_g]).
    HistoryRow row(double time, const GroundState& ground, const TiedSums& sums) const;
    /// Displacements of all unknowns of the model.
    Eigen::VectorXd all_displacements(const Eigen::VectorXd& of_system) const;

    const Model& model;
    const TiedRunOptions& options;
    GroundHistory ground;
    bool total_velocity; ///< the mass damping resists the total velocity
    StructureSystem structure;
    GroundLoad load;
    Eigen::VectorXd start;          ///< displacements at rest [m]
    Eigen::VectorXd mass_x, mass_y; ///< M_dam r_x, M_dam r_y, own and added mass of the dam alone, on the system [kg/m]
    Eigen::VectorXd damped_x, damped_y;                     ///< a_M M_s r of the dam [kg/(m s)]
    Eigen::Vector2d total = Eigen::Vector2d::Zero();        ///< rᵀM r of the dam, fixed nodes included [kg/m]
    Eigen::Vector2d damped_total = Eigen::Vector2d::Zero(); ///< a_M rᵀM_s r [kg/(m s)]
    Eigen::Index crest_x, crest_y;                          ///< unknowns of the crest's upstream end

private:
    void balance();
    std::optional<LinearSolver> static_factor_;
};

/// The step asked for, else the motion's. @throws InputError when it is no whole part of the motion's step
double step_of(const GroundMotion& motion, const TiedRunOptions& options);
/// Steps from the start to the end of motion and free vibration.
std::int64_t step_count(const GroundHistory& ground, const TiedRunOptions& options, double dt);

/// The rows of a history as they come: peaks see all of them, every `keep_every`-th is kept, and the last.
class HistoryWriter {
public:
    HistoryWriter(History& history, const TiedRunOptions& options, double dt, std::int64_t steps, int keep_every);

    void enter(const HistoryRow& row, std::int64_t step);
    bool stopped(std::int64_t step, double time); ///< asks options.progress; notes it in the status
    /// Status text of a complete run, and the imbalance over the energy scale [J/m].
    void finish(double energy_scale);

private:
    History& history_;
    const TiedRunOptions& options_;
    double dt_;
    std::int64_t steps_;
    int keep_every_;
    double start_crest_x_ = 0.0;
};

} // namespace damslip::fe2d
