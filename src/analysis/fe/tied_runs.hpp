#pragma once

#include "analysis/fe/contact_runs.hpp"
#include "fe2d/fluid/fluid_model.hpp"
#include "fe2d/model/model.hpp"
#include "fe2d/rock/radiating_rock.hpp"
#include "fe2d/time/energy.hpp"

#include <optional>
#include <string>
#include <vector>

/// The earthquakes of a dam that is bonded to its base: linear.
namespace damslip {

/// The earthquake of one motion on a bonded base.
struct TiedRun : MotionName {
    fe2d::History history;
    std::vector<std::string> notes;
    double seconds = 0.0;
    GroundMotion motion;
};

/// What stands still, what moves, and what its damping is taken from; the same model where the rock is massless.
struct TiedModels {
    fe2d::Model still;
    std::optional<fe2d::Model> on_free_edges, massless;

    TiedModels(const Scene& scene, const fe2d::ModelOptions& options);
    const fe2d::Model& moving() const { return on_free_edges ? *on_free_edges : still; }
    const fe2d::Model& damped() const { return massless ? *massless : still; }
};

/// The models of one scene and the runs on them. Both polarities are run: the static loads, and the vertical motion where there is
/// one, are not turned round with the horizontal motion.
class TiedRuns {
public:
    /// Solves the static stages. @param ready, watch  outlive this
    /// @throws InputError; NotConverged where the static stages could not be solved
    TiedRuns(const Ready& ready, const FeOptions& options, Watch& watch);

    const fe2d::Model& model() const { return models_.still; }
    const fe2d::FluidModel* water() const { return water_ ? &*water_ : nullptr; } ///< acoustic; null: none
    const fe2d::RadiatingRock* radiating() const { return radiating_ ? &*radiating_ : nullptr; } ///< null: other rock
    const fe2d::StaticSolution& statics() const { return statics_; }

    using TakeRun = std::function<void(TiedRun& run)>; ///< called with each run as soon as it is there
    std::vector<TiedRun> run(const TakeRun& take = {});
    std::size_t whole() const; ///< number of runs when none is left out

private:
    TiedRun run(const MotionName& name, const GroundMotion& motion) const;

    const Ready& ready_;
    Watch& watch_;
    std::optional<int> polarity_; ///< asked for; none: the scene's, else both
    TiedModels models_;
    std::optional<fe2d::FluidModel> water_;
    std::optional<fe2d::RadiatingRock> radiating_; ///< none: the rock of the models moves
    fe2d::StaticSolution statics_;
    fe2d::HeldStart start_;
};

} // namespace damslip
