#pragma once

#include "scene/planes.hpp"
#include "scene/scene.hpp"
#include "scene/uplift_models.hpp"
#include "scene/water.hpp"
#include "sliding/loads/static_loads.hpp"
#include "sliding/planes/chain.hpp"
#include "sliding/planes/seam_motion.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

/// A weak seam in the rock below the dam. The dam and the rock above the seam are the body; where the seam is closed in front
/// of the toe, the body pushes a wedge of rock up a plane of its own. Rock is saturated, water presses on its boundaries only.
namespace damslip::sliding {

/// Ground acceleration that a factor of safety is asked for; both 0: the static state.
struct GroundState {
    std::string name;
    double a_h = 0.0; ///< drives downstream [m/s^2]
    double a_v = 0.0; ///< up [m/s^2]
};

/// What of the seam changes while it slides.
struct SeamState {
    std::optional<double> friction; ///< of the seam [-]; none: its peak
    bool bonded = true;             ///< its cohesion is there
    bool dilates = true;
    DrainState drains = DrainState::effective;
};

/// The chain of a seam and where its numbers come from.
struct SeamModel {
    Chain chain;
    Polyline path;                  ///< all segments, that of the wedge included [m]
    PressureProfile pressure;       ///< over the distance along the path
    std::vector<Polyline> outlines; ///< rock of each block; empty polygon: none
    std::vector<Force> loads;       ///< on each block: weight, water on its faces, all static loads of the dam [N/m]
    std::vector<Point> centroids;   ///< of each block, the dam included
    Polyline feet, tops;            ///< of the interfaces
    Force water_per_a_h;            ///< of the added mass under a_h = 1 m/s^2, on the dam's block [N/m]
};

/// @param angle  α of the wedge's plane [rad]; none: the seam without a wedge, its rock in front of the last point taken away
///               (exit "free-face") or the path as it is
/// @param interface  friction or smooth, in place of the seam's word
SeamModel seam_model(const Scene& scene, const Seam& seam, std::optional<double> angle, const SeamState& state = {},
                     std::optional<InterfaceModel> interface = std::nullopt);

/// One angle of the wedge.
struct WedgeTrial {
    double angle = 0.0;          ///< α [rad]
    std::vector<double> factors;       ///< F of each ground state [-]
    std::vector<ChainStatus> statuses; ///< at these factors
    double yield = 0.0;                ///< a_y [m/s^2]
    ChainStatus status = ChainStatus::stands; ///< at the yield
};

/// F of one ground state.
struct SeamFactor {
    double factor = 0.0;         ///< by the seam's interface.model [-]
    std::optional<double> angle; ///< α at which it is least [rad]; none: no wedge
    double smooth = 0.0, friction = 0.0; ///< at that angle, by the wedge method and by Sarma's with the interface's strength [-]
    ChainStatus status = ChainStatus::stands; ///< at this factor
    double without_wedge = 0.0;          ///< nothing in front of the body: the slip that mobilises a wedge may be too much [-]
};

struct SeamPlane {
    std::string name;
    std::vector<SeamFactor> factors; ///< of each ground state
    std::vector<WedgeTrial> trials;  ///< by ascending angle: those given, or the scan of the search and its minima
    std::optional<double> angle;     ///< α of the least a_y [rad]
    bool at_end_of_range = false;    ///< the search found a least value at its end
    bool wedge_left_out = false;     ///< the seam as if nothing were in front of it: no angle lets the wedge stand, or one given does not
    ChainStatus status = ChainStatus::stands; ///< at the yield
    SeamModel model;                          ///< at `angle`
    double yield = 0.0, yield_per_a_v = 0.0;  ///< a_y [m/s^2], da_y/da_v [-]
    /// Of the body alone, which leaves the wedge; infinite: it is locked.
    Yield upstream{{std::numeric_limits<double>::infinity(), 0.0}, 0.0};
    double wedge_back = std::numeric_limits<double>::infinity(); ///< upstream yield of the wedge before a gap [m/s^2]
    double slip_factor = 1.0;    ///< H/M* [-]
    double holding_friction = 0.0; ///< μ of the seam at which the static F is 1 [-]; without states at `angle`
    double growth = 0.0;           ///< κ: of a_y over the slip, by the rock that crosses the interfaces [1/s^2]
    double valid_slip = 0.0;       ///< slip at which κ changes a_y by 5 % [m]; infinite without wedge
    double impact = 1.0;           ///< rate after over rate before, when the body meets the wedge again [-]
    ChainForces forces;            ///< at the yield
    std::vector<double> resultants; ///< distance of N from the upstream end of each segment over its length [-]; beyond 0 ... 1: tips
    std::vector<double> shares;     ///< of the resistance: segments, then interfaces [-]
    bool of_block = false;          ///< one block without dilation: `stages` are its own, lift-off and both ways among them
    SlipStages stages;              ///< for slide(), else downstream only
    /// For slide_seam(), both ways: friction that slopes by its mean over sixteenths. Of a body that would have to pull blocks upstream
    /// these are the wedge. Empty: locked.
    std::vector<SeamStage> bodies;
};

/// What of a seam does not depend on its strengths: its geometry, loads and water, for each angle of the wedge that is tried. All
/// models have the strengths of the seam that it was made for.
class SeamGround {
public:
    struct Rock;
    struct Scanned {
        double angle = 0.0;
        Chain chain;
        ChainLaw law;
    };

    /// @throws InputError for a seam whose blocks cannot be made (messages of check.hpp come first)
    SeamGround(const Scene& scene, const Seam& seam);

    bool serves(const Seam& seam) const; ///< a seam that differs in strengths alone, dilation apart
    const Rock& rock() const { return *rock_; }
    const std::vector<Scanned>& scan() const { return scan_; } ///< by ascending angle; empty: no wedge
    const SeamModel& with_wedge() const { return with_wedge_; } ///< at one of these angles
    const SeamModel& body() const { return body_; }             ///< without a wedge

private:
    std::shared_ptr<const Rock> rock_;
    Seam seam_;
    std::vector<Scanned> scan_;
    SeamModel with_wedge_, body_;
};

/// @param states  the first is the static one; none: factors, trials and what of the yield is only printed are not asked for
/// @throws InputError for a seam whose blocks cannot be made (messages of check.hpp come first)
SeamPlane seam_plane(const Scene& scene, const Seam& seam, const std::vector<GroundState>& states);
/// @param ground  of the same scene and of a seam that it serves
SeamPlane seam_plane(const Scene& scene, const Seam& seam, const std::vector<GroundState>& states, const SeamGround& ground);

/// Stages of a seam over its slip: cohesion lost, friction over the slip, drains sheared off, dilation at its end; with
/// planes.geometry = "linear" the yield grows by `growth` with the slip.
SlipStages seam_stages(const Scene& scene, const Seam& seam, std::optional<double> angle, double growth);

} // namespace damslip::sliding
