#pragma once

#include "core/status.hpp"
#include "records/record.hpp"
#include "scene/anchor_bar.hpp"
#include "scene/scene.hpp"
#include "sliding/block/rigid_block.hpp"

#include <cstddef>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace damslip::sliding {

/// Range of the ground acceleration over some intervals, end samples included [m/s^2].
struct AccelRange {
    double h_min = 0.0, h_max = 0.0, v_min = 0.0, v_max = 0.0;
};

/// A ground motion with the ranges of its blocks of samples, made once and used for many yields: a block at rest skips
/// every stretch whose range cannot start it. Two levels: blocks of 32 intervals, and 32 of those.
class SkippingMotion {
public:
    /// @throws InputError for what check_motion refuses.
    explicit SkippingMotion(GroundMotion motion);

    static constexpr std::size_t block = 32;            ///< intervals of a block
    static constexpr std::size_t large = block * block; ///< intervals of a large block

    const GroundMotion& motion() const { return motion_; }
    bool has_vertical() const { return !motion_.accel_v.empty(); }
    std::size_t intervals() const { return motion_.accel_h.size() - 1; }
    const AccelRange& whole() const { return whole_; }
    const AccelRange& block_range(std::size_t k) const { return blocks_[k]; } ///< intervals 32 k ... 32 k + 31
    const AccelRange& large_range(std::size_t k) const
    {
        return large_blocks_[k];
    } ///< intervals 1024 k ... 1024 k + 1023

    /// First interval at or after k which does not lie in a whole block that `rests(range)` says cannot move;
    /// intervals() when there is none.
    template <typename Rests>
    std::size_t skip(std::size_t k, Rests&& rests) const
    {
        while (k < intervals()) {
            if (k % large == 0 && rests(large_blocks_[k / large]))
                k += large;
            else if (k % block == 0 && rests(blocks_[k / block]))
                k += block;
            else
                return k;
        }
        return intervals();
    }

private:
    GroundMotion motion_;
    std::vector<AccelRange> blocks_, large_blocks_;
    AccelRange whole_;
};

/// @throws InputError for dt <= 0, fewer than 2 samples, components of unequal length, non-finite samples.
void check_motion(const GroundMotion& motion);

// Sliding of a rigid block under a ground motion: the general, event-located integrator.

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
    std::vector<Note> notes;            ///< what there is to say of it
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

/// The static state of the block between two records of a sequence: water at rest in what has cracked so far.
class RestBetweenEvents {
public:
    virtual ~RestBetweenEvents() = default;

    /// The crack that opens with sliding in a direction (downstream: at the heel), under (a_h, a_v) [m/s²]; a block that slides
    /// has the crack of its own acceleration, no longer one [m].
    virtual double crack(SlipDirection direction, double a_h, double a_v) const = 0;

    struct Rest {
        SlipStages stages;                             ///< as many as before, from the same paths on
        Note note;                                     ///< rest_after: what it stands on
        std::shared_ptr<const RestBetweenEvents> next; ///< from there on
    };
    /// With cracks of these lengths [m]. Its first block says whether it stands (static_state()).
    virtual Rest rest(double heel, double toe) const = 0;
};

/// slide() of a sequence with such a state after each record but the last: slip, its path and the strength lost with it,
/// friction that lags and anchors go on, the motion itself has come to rest. A block that does not stand there ends the
/// sequence with the status of its static state. @param rests  null: as slide()
SlideResult slide(const GroundMotion& motion, const SlipStages& stages, const SlideOptions& options,
                  const RestBetweenEvents* rests);

// The step-by-step scheme of SLAMMER, kept for comparison with results of its users.

/// Trapezoid rule of SLAMMER (Jibson, Rathje, Jibson & Lee 2013, U.S. Geological Survey Techniques and Methods 12-B1)
/// for its rigid-block analysis. With y_k = s'' at sample k, zero while the block rests:
///
///     v_k = v_{k-1} + dt/2 (y_{k-1} + y_k),   s_k = s_{k-1} + dt/2 (v_{k-1} + v_k);   v_k = y_k = 0 when v_k would
///     turn against the slip.
///
/// Start and stop are moved to samples and the slip is integrated by trapezoids: an error of order dt^2 that is
/// largest, relative to the slip, when a_y is near the peak (few samples above a_y). The scheme has no state before the
/// first sample (y_{-1} = 0) and ends with the record; there is no run-out. Not taken over: SLAMMER skips samples that
/// are exactly zero, time included, while the block slides.
///
/// Yield may follow a_v and change between stages (friction constant within each); lift-off is `no_friction` only.
SlideResult slide_slammer(const GroundMotion& motion, const SlipStages& stages, const SlideOptions& options);

/// The same for a constant yield and one-way sliding; the kernel the bench times.
/// @param accel ground acceleration [m/s^2], positive drives the block; @param dt [s]; @param yield_acceleration
/// [m/s^2], > 0
/// @returns slip [m]
double slammer_slip(std::span<const double> accel, double dt, double yield_acceleration);

} // namespace damslip::sliding
