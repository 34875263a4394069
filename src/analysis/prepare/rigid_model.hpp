#pragma once

#include "analysis/prepare/lift_modes.hpp"
#include "analysis/prepare/records.hpp"
#include "scene/scene.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/empirical/regression.hpp"
#include "sliding/equilibrium/base_state.hpp"
#include "sliding/planes/seam.hpp"
#include "sliding/rocking/rocking.hpp"
#include "sliding/wedge/wedge.hpp"

#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

namespace damslip {

/// The rock wedge of a scene, which takes the place of the rigid block: the wedge, the ground motion that drives it and what it does then.
struct RigidWedge {
    sliding::Wedge wedge;
    sliding::WedgeState still; ///< without earthquake
    double azimuth = 0.0;      ///< positive a_h drives the wedge this way [rad]
    Vector3 push{};            ///< unit vector of it
    sliding::WedgeYields yields;
};

/// @pre scene.wedge
RigidWedge make_rigid_wedge(const Scene& scene);

/// Friction of the first plane at which a wedge just stands as it is in `state`, the second keeping its share of it as
/// with_friction() has it [-]; infinite when it lifts or no friction would do. Of planes alike it is that of both.
double critical_first_friction(const sliding::Wedge& wedge, const sliding::WedgeState& state);

/// The yield under ground motion of one direction.
struct WedgeYieldRow {
    std::string motion;            ///< "record", "opposite", "most unfavourable", "ground down", "ground up"
    std::optional<double> azimuth; ///< it drives the wedge this way [rad]; none: vertical
    sliding::WedgeYield yield;
};

/// Along the records and against them, the least over all azimuths to 1 degree, and vertical.
std::vector<WedgeYieldRow> wedge_yield_rows(const RigidWedge& wedge);

/// Yield accelerations over the azimuth the motion drives to, every 5 degrees from 0 to 360 [m/s^2].
std::vector<double> yields_over_azimuth(const sliding::Wedge& wedge);

/// "both planes, along their line", "plane 1 alone", ...
std::string mode_words(const RockWedge& names, sliding::WedgeMode mode);

/// The rigid block of a scene, what it becomes with slip, and what holds it.
struct RigidModel {
    sliding::RigidBlock block;      ///< before any slip
    sliding::SlipStages stages;     ///< strength and uplift over slip
    std::vector<AnchorBar> anchors; ///< through the base; the block holds their forces before any slip
    sliding::Yield downstream, upstream;
    sliding::StaticState state = sliding::StaticState::at_rest;
    double critical_friction = 0.0;                       ///< [-]; of a wedge: of its first plane
    std::optional<RigidWedge> wedge;                      ///< takes the place of block and stages
    std::shared_ptr<const sliding::RockingBlock> rocking; ///< the same block, free to rock; none: a wedge
    /// Ground acceleration that tips it about its toe (sliding::tipping_acceleration) [m/s^2]
    double tips = std::numeric_limits<double>::infinity();
    /// The static state between the records of a sequence (uplift.after); null: none
    std::shared_ptr<const sliding::RestBetweenEvents> rests;
    std::optional<double> length; ///< of what it slides on [m]; none: a wedge whose surfaces are not given
    double amplification = 1.0;   ///< of the ground's motion where the block stands: of a lift [-]
    /// The vibrating dam below and around the block, in place of `amplification`; null: none
    std::shared_ptr<const sliding::TiedPart> tied;
    bool one_way = false;         ///< `stages` are followed downstream only, whatever sliding.two_way says
    /// Of a seam that slides both ways, which `stages` do not; null: none. `upstream` is the yield of the body alone
    std::shared_ptr<const std::vector<sliding::SeamStage>> bodies;

    bool moves_unlike_ground() const { return tied || amplification != 1.0; }
    /// Why it is not at rest before the earthquake: "friction 0.5 is below the 0.645 that would hold it".
    std::string why_it_fails() const;
};

/// What the rigid block of a scene stands on whatever its friction: found once, for all frictions and from any thread.
struct RigidStatics {
    sliding::BaseState before;               ///< before any slip
    std::optional<sliding::BaseState> later; ///< with the drains lost
    sliding::AddedMassIntegral water;
};
template <class Found>
class KeptOnce {
public:
    const Found& get(const std::function<Found()>& find)
    {
        const std::lock_guard lock(mutex_);
        if (!found_) found_ = find();
        return *found_;
    }

private:
    std::mutex mutex_;
    std::optional<Found> found_;
};
/// Of the seams of a scene, by name; one that does not serve any more is made again.
class KeptSeams {
public:
    std::shared_ptr<const sliding::SeamGround> get(const Scene& scene, const Seam& seam)
    {
        const std::lock_guard lock(mutex_);
        std::shared_ptr<const sliding::SeamGround>& kept = found_[seam.name];
        if (!kept || !kept->serves(seam)) kept = std::make_shared<const sliding::SeamGround>(scene, seam);
        return kept;
    }

private:
    std::mutex mutex_;
    std::map<std::string, std::shared_ptr<const sliding::SeamGround>> found_;
};
struct KeptStatics {
    KeptOnce<RigidStatics> base;
    KeptOnce<LiftModes> lifts; ///< of lifts.amplification = "modes"
    KeptSeams seams;
};

/// On the base, or on the plane that scene.planes.slides_on names.
/// @param seepage  gives the profile of uplift.model = "seepage"; not asked for other models
/// @param crack    in place of the scene's uplift.crack, if given
/// @param kept     of scenes that differ in friction only; null: found for this one
RigidModel make_rigid_model(const Scene& scene, const sliding::SeepageProfile& seepage,
                            std::optional<CrackRule> crack = std::nullopt, KeptStatics* kept = nullptr);

/// The one place where a slip that passes what it slides on loses its meaning: Status::runs_away in place of at_rest and
/// sliding_at_end.
void check_length(const RigidModel& model, sliding::SlideResult& result);

/// The one place that finds that the block tips before it slides: Status::rocks_first in place of at_rest and
/// sliding_at_end where the acceleration that tips it lies below its yield and the motion reaches it.
/// About its toe only: rocking upstream, about the heel, is a premise of the verdict (broken_premises), as the dam slides
/// downstream all the same.
/// @param peak  of the acceleration of the mass that drives it downstream [m/s^2]
void check_tipping(const RigidModel& model, double peak, sliding::SlideResult& result);

/// How a slide without a final slip ended, a sentence; empty: its notes say nothing.
std::string ending_of(const sliding::SlideResult& result);

/// The model that rocks and slides, under a motion with the scene's [sliding] options. @param model  no wedge
sliding::RockingResult rock_model(const Scene& scene, const RigidModel& model, const GroundMotion& motion, int polarity,
                                  sliding::HistoryOutput history = sliding::HistoryOutput::none);

/// Slip of the model under a motion with the scene's [sliding] options.
sliding::SlideResult slide_model(const Scene& scene, const RigidModel& model, const sliding::SkippingMotion& motion,
                                 int polarity, sliding::HistoryOutput history = sliding::HistoryOutput::none);
sliding::SlideResult slide_model(const Scene& scene, const RigidModel& model, const GroundMotion& motion, int polarity,
                                 sliding::HistoryOutput history = sliding::HistoryOutput::none);

/// Of a seam, with the work of each part, whether or not the motion moves it upstream. @pre model.bodies
sliding::SeamSlide slide_bodies(const Scene& scene, const RigidModel& model, const GroundMotion& motion, int polarity);

/// The same of models of one scene that differ in friction, side by side where that is sooner; no histories.
/// @param models  at least one, none null
std::vector<sliding::SlideResult> slide_models(const Scene& scene, std::span<const RigidModel* const> models,
                                               const sliding::SkippingMotion& motion, int polarity);

/// What the regressions ask for, measured from the scaled horizontal component; magnitude as the scene gives it.
/// @param period_s  T_s of the sliding mass [s]; 0: rigid, spectral accelerations are then the PGA
sliding::RegressionInputs regression_inputs(const RecordPair& pair, const GroundMotion& motion, const RigidModel& model,
                                            double period_s = 0.0);

/// The same motion without its vertical component.
GroundMotion horizontal_only(GroundMotion motion);

} // namespace damslip
