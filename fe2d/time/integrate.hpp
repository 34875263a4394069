#pragma once

#include "fe2d/damping/damping_choice.hpp"
#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/time/history.hpp"
#include "fe2d/time/moving_base.hpp"
#include "fe2d/time/run_progress.hpp"
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

} // namespace damslip::fe2d
