#pragma once

#include "core/statistics.hpp"
#include "core/status.hpp"
#include "records/record.hpp"
#include "scene/anchor_bar.hpp"
#include "scene/scene.hpp"
#include "sliding/block/skipping_motion.hpp"
#include "sliding/block/slip_stage.hpp"

#include <limits>
#include <span>
#include <string>
#include <vector>

/// Sliding of a rigid block under a ground motion: the general, event-located integrator.
namespace damslip::sliding {

enum class HistoryOutput { none, samples };

/// What is followed, on top of the scene's [sliding] options.
struct SlideOptions {
    SlidingOptions sliding;                      ///< scheme, lift-off, one or two ways, run-out (scene.hpp)
    int polarity = 1;                            ///< +1 or -1: multiplies a_h of the motion passed in [-]
    HistoryOutput history = HistoryOutput::none; ///< samples: values at every sample, run-out included
    /// Anchors whose forces before any slip (prestress, dowel) the block's static forces hold already.
    std::vector<AnchorBar> anchors = {};
};

/// How the slip was found between events.
enum class SlideAccuracy {
    closed_form, ///< polynomials, sines and hyperbolic sines: exact up to round-off
    series, ///< somewhere a Taylor series was needed (friction linear in slip under varying N', friction over the rate,
            ///< anchors), to round-off, events within 1e-10
    scheme  ///< a time-stepping scheme with an error of its own (SLAMMER's)
};

/// Values at the samples; the last ones may belong to the run-out.
struct SlideHistory {
    std::vector<double> time;         ///< [s]
    std::vector<double> slip;         ///< positive downstream [m]
    std::vector<double> slip_rate;    ///< positive downstream [m/s]
    std::vector<double> yield;        ///< downstream yield acceleration, lift-off and slip so far included [m/s^2]
    std::vector<double> normal_force; ///< N' [N/m]; 0 while lifted off
    std::vector<double> gap;          ///< opening normal to the base, `ballistic` only [m]
};

struct SlideResult {
    /// at_rest, sliding_at_end; static_failure or floats (a_y < 0, a_y^- < 0, or N' <= 0 before the earthquake: it slides
    /// by itself; slip up to the record's end, no run-out); not_resolved (more events in one interval than any motion
    /// has, a freak combination of cohesion, incline and lift-off; see notes).
    Status status = Status::at_rest;
    SlideAccuracy accuracy = SlideAccuracy::closed_form;
    double slip = 0.0;            ///< at the end, positive downstream [m]
    double max_slip = 0.0;        ///< largest |slip| on the way [m]
    double slip_error = 0.0;      ///< of max_slip, by the table of SlowWater; 0: exact [m]
    double downstream_slip = 0.0; ///< sum of the downstream movements [m], >= 0
    double upstream_slip = 0.0;   ///< sum of the upstream movements [m], >= 0; slip = downstream - upstream
    double peak_slip_rate = 0.0;  ///< largest |slip rate| [m/s]
    double first_slip_time = std::numeric_limits<double>::quiet_NaN(); ///< start of the first movement [s]; NaN: none
    double last_slip_time =
        std::numeric_limits<double>::quiet_NaN(); ///< end of the last movement, or of the integration [s]; NaN: none
    int phases = 0;                               ///< movements: from rest (or a reversal) to rest (or a reversal)
    int lift_offs = 0;                            ///< times the base opened (N' reached zero)
    double max_gap = 0.0;                         ///< largest opening, `ballistic` only [m]
    double end_time = 0.0;                        ///< of the integration, run-out included [s]
    int landings = 0;                             ///< `ballistic` only
    double last_landing_time =
        std::numeric_limits<double>::quiet_NaN(); ///< when the base last shut after a flight [s]; NaN: never
    double impact_loss = 0.0;           ///< kinetic energy that landings took, friction's impulses included [J/m]
    double wet_length = 0.0;            ///< how far water came into the crack at most (uplift.opening mouth) [m]
    std::vector<EventSlip> events;      ///< of a sequence, as far as they were reached; else empty
    std::vector<std::string> notes;     ///< sentences for people
    std::vector<AnchorOutcome> anchors; ///< in the order of the options
    SlideHistory history;
};

/// Slip of the block under the motion, acceleration linear between samples, starting at rest at the first sample.
///
/// Along the base A(a_g + s'' t) = F + (U + N') n - R t with R = +-(c A' + mu N') against the slip (see BaseEquations),
/// so while nothing changes s'' is linear in time, the slip rate quadratic, the slip cubic; start, stop, reversal,
/// lift-off, landing and slip values at which the block changes are roots inside the interval or on a sample, located
/// to the last digits. Newmark (1965); Goldgruber (2015), section 4. Friction linear in slip: sines or hyperbolic sines
/// in closed form where N' is constant over an interval, else a Taylor series.
///
/// Lift-off: `no_friction`: while N' <= 0 there is no resistance, cohesion included, and no vertical flight.
/// `ballistic`: the gap follows y'' = -(normal force of the free block)/m, lands plastically with the impulse J = m
/// |y'| and Coulomb's impulse <= mu J along the base; with restitution e it leaves again with e |y'|, J = (1 + e) m |y'|
/// (Newton; Moreau 1988), until a flight would last less than 1e-13 s. Friction over the rate: see RatedSlip. A sequence:
/// each event goes on from what the one before left, see GroundMotion::events. Run-out: zero ground acceleration from the last sample on until
/// the block rests, at most run_out_max. (With zero ground acceleration a block at rest stays at rest, so the half
/// second of rest that FE runs wait for needs no integration here.)
///
/// Anchors pull with N(s) sin ψ' against downstream slip and press with N(s) cos ψ' (AnchorBar, joint shut); between the slips
/// at which one of them yields, slackens, tightens or snaps the slip is a Taylor series in time, to round-off.
///
/// @throws InputError for dt <= 0, fewer than 2 samples, components of unequal length, non-finite samples, and what
/// check_stages refuses; for anchors with ballistic lift-off or SLAMMER's scheme.
SlideResult slide(const GroundMotion& motion, const SlipStages& stages, const SlideOptions& options = {});

/// The same bits sooner: while the block rests, whole stretches that cannot start it are skipped (unless a history is
/// asked for).
SlideResult slide(const SkippingMotion& motion, const SlipStages& stages, const SlideOptions& options = {});

/// The same bits for several blocks, without histories. Four neighbours go through a horizontal motion together where they
/// slide downstream only, at one friction each, and are never lifted: worth it for blocks that move at the same times.
/// @param blocks  none null
std::vector<SlideResult> slide_together(const SkippingMotion& motion, std::span<const SlipStages* const> blocks,
                                        const SlideOptions& options);

/// One block that does not change with slip.
SlideResult slide(const GroundMotion& motion, const RigidBlock& block, const SlideOptions& options = {});

} // namespace damslip::sliding
