#pragma once

#include "fe2d/time/ground_load.hpp"
#include "fe2d/time/integrate.hpp"

namespace damslip::fe2d {

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
