#pragma once

#include "sliding/block/contact_block.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/block/roots.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/block/slip_steps.hpp"

#include <array>
#include <span>
#include <vector>

namespace damslip::sliding {

/// The state of a sliding block and its exact advance over one sample interval, event by event. Used by slide() and
/// slide_decoupled().
class SlipMotion {
public:
    SlipMotion(const SlipStages& stages, const SlideOptions& options);

    /// Ground acceleration linear from (a_h.now, a_v.now) at time `start` to the ends at start + dt.
    void cross(double start, double dt, const Line& a_h, const Line& a_v);

    /// Passes intervals in which the motion surely does not lift the block and its friction does not change
    /// (PermanentContact): what cross() does, bit by bit, at a fraction of the cost.
    /// @param k, last  intervals k ... last - 1 of the motion  @param before  intervals so far, for the time
    /// @returns the first interval that needs cross()
    std::size_t pass(const SkippingMotion& motion, double polarity, std::size_t k, std::size_t last,
                     std::size_t before);

    /// Carries blocks, at rest at first, through a whole motion in a batched run, with the bits that pass() gives for each of
    /// them. @returns false where a block may be lifted or changes with its slip; the blocks are unchanged then
    static bool pass_together(const SkippingMotion& motion, double polarity,
                              const std::array<SlipMotion*, batch_size>& blocks);

    /// Other stages under the block at rest, from the same paths on: another static state. Its water is that of them.
    void stand_on(const SlipStages& stages);

    bool moving() const { return moving_ && rate_ > 0.0; }
    bool at_rest() const { return !moving() && !airborne_; }
    bool unresolved() const { return unresolved_; }
    bool used_series() const { return used_series_; }
    bool on_base() const { return touching_ && !airborne_; }          ///< N' > 0, there is resistance
    double rate() const { return moving() ? rate_ : 0.0; }            ///< |slip rate| [m/s]
    double slip() const { return slid_.downstream - slid_.upstream; } ///< so far [m]
    double peak_rate() const { return slid_.peak_rate; }              ///< largest |slip rate| so far [m/s]
    /// Starts, stops, contacts and stages so far: two equal counts say that nothing of the kind came between.
    long changes() const { return changes_; }
    void add_sample(double time, double a_h, double a_v, SlideHistory& history) const;
    void write(SlideResult& result) const;

    /// True when a block at rest on its base surely stays there while a_h and a_v stay within the given ranges.
    bool stays_at_rest(double a_h_min, double a_h_max, double a_v_min, double a_v_max) const;

private:
    /// What does not change within a stage.
    struct StageForms {
        BaseEquations equations;
        GroundLinear free_normal;                          ///< N' of the block sliding without resistance
        GroundLinear flight_accel;                         ///< s'' in flight
        GroundLinear gap_accel;                            ///< y'' in flight
        GroundLinear excess_downstream, excess_upstream;   ///< over the resistance [N/m]
        double mass_downstream = 0.0, mass_upstream = 0.0; ///< felt by the slip [kg/m]
        double friction = 0.0;                             ///< while it is constant [-]
        double bond = 0.0;                                 ///< cohesion and dowels [N/m]
    };

    void take_stages(const SlipStages& stages);
    void cross_part(double start, double dt, const Line& a_h, const Line& a_v, bool up_to_change = false,
                    bool goes_on = false);
    void cross_wet(double start, double dt, const Line& a_h, const Line& a_v);
    const SlowWater* slow_water() const;
    double wet_after(SlipDirection direction, double wet, double dt, double a_h, double a_v) const;
    double let_water_flow(double dt, const Line& a_h, const Line& a_v);
    bool water_stays(double a_h_min, double a_h_max, double a_v_min, double a_v_max) const;
    void wait();
    void wait_lagging();
    void move();
    void move_sloped();
    void move_anchored();
    void hold_anchors();
    template <class Step>
    void go_along(const Step& step, double h);
    void move_rated();
    void start(SlipDirection direction);
    void stop();
    void turn_contact();
    void land();
    double rebound(double impact) const;
    double kinetic_energy() const;
    void settle_contact();
    bool bond_stays() const;
    bool enter_stages();
    void elapse(double h);
    void meet(double h, double h_stage, double h_stop, double h_contact);
    void add_slip(double path);
    double time_of_contact_change() const;
    double time_of_stage(double h, const Line& accel) const;

    static StageForms forms_of(const RigidBlock& block);
    bool stays_in_contact(const AccelRange& range, const AccelRange& whole) const;
    std::size_t contact_until(const SkippingMotion& motion, double polarity, std::size_t k, std::size_t last) const;
    ContactBlock contact_block(const SkippingMotion& motion, double polarity) const;
    void take(const ContactBlock& block);
    const SlipStage& stage() const { return anchors_.empty() ? stages_[stage_] : anchored_[stage_]; }
    const StageForms& forms() const { return forms_[stage_]; }
    double friction() const;
    RatedSlip rated(SlipDirection towards) const;
    Line line(const GroundLinear& form) const { return {form.at(a_h_.now, a_v_.now), form.at(a_h_.end, a_v_.end)}; }
    void read_opening();
    /// N' with the uplift of the crack that sliding in a direction opens.
    Line less_opening(const Line& normal, SlipDirection direction) const;
    Line free_normal() const;
    Line slip_accel() const;
    double next_stage_path() const;

    std::span<const SlipStage> stages_; ///< the caller's
    SlidingOptions options_;
    std::vector<StageForms> forms_;
    std::vector<bool> plain_; ///< stages of constant friction and nothing else that changes within them

    // With anchors: those, and the stages with what they have come to; forms_ are of these.
    std::vector<BlockAnchor> anchors_;
    SlipStages anchored_;
    std::vector<StageForms> unanchored_forms_; ///< of stages_, which hold the anchors' forces before any slip

    // The interval: what is left of it.
    double time_ = 0.0; ///< now [s]
    double span_ = 0.0; ///< rest of the interval [s]
    Line a_h_, a_v_;
    Line opening_down_, opening_up_; ///< change of the uplift while it slides [N/m]
    Line wet_down_, wet_up_;         ///< x_w in the crack at heel and toe (SlowWater) [m]

    // The block. Its direction is only meaningful while it moves; rate and path are counted along it.
    std::size_t stage_ = 0;
    bool moving_ = false;
    bool from_rest_ = false; ///< the start was located just now: s'' >= 0 whatever round-off says
    bool touching_ = true;   ///< N' > 0: there is resistance
    bool airborne_ = false;  ///< in ballistic flight
    SlipDirection direction_ = SlipDirection::downstream;
    double rate_ = 0.0;                 ///< |slip rate| [m/s]
    double path_ = 0.0;                 ///< sum of |slip| [m]
    double gap_ = 0.0, gap_rate_ = 0.0; ///< [m], [m/s]
    double ratio_ = 1.0;                ///< mu over that of rest, where it lags behind the rate [-]

    // Results.
    SlipTotals slid_;
    double max_gap_ = 0.0;
    double last_landing_ = 0.0, impact_loss_ = 0.0;
    double longest_wet_ = 0.0; ///< largest x_w [m]
    int landings_ = 0;
    long changes_ = 0;
    bool unresolved_ = false, used_series_ = false;
};

/// What became of the block: results and status. `record_end` [s]: of the ground motion.
void conclude(const SlipMotion& block, const SlipStages& stages, const SlideOptions& options, double record_end,
              SlideResult& result);

/// Zero ground acceleration from `start` on, in steps of dt, until the block rests; at most `longest` [s]. None of a block that
/// slides without an earthquake. @param history  where the samples go; null: nowhere
void run_out(SlipMotion& block, const SlipStages& stages, double start, double dt, double longest,
             SlideHistory* history);

} // namespace damslip::sliding
