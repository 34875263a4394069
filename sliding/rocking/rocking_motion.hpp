#pragma once

#include "sliding/block/line.hpp"
#include "sliding/block/slip_totals.hpp"
#include "sliding/rocking/corner.hpp"
#include "sliding/rocking/dormand_prince.hpp"
#include "sliding/rocking/rocking.hpp"

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace damslip::sliding {

/// The state of a block that rocks and slides, and its advance over one sample interval, event by event.
class RockingMotion {
public:
    RockingMotion(const RockingBlock& block, const SlideOptions& options, const RockingStart& start = {});

    /// Ground acceleration linear from (a_h.now, a_v.now) at time `start` to the ends at start + dt.
    void cross(double start, double dt, const Line& a_h, const Line& a_v);

    bool at_rest() const { return stance_ == Stance::base && !sliding_; }
    bool finished() const { return unresolved_ || overturned_; }
    bool unresolved() const { return unresolved_; }
    bool overturned() const { return overturned_; }
    bool jammed() const { return jammed_; }
    void add_sample(double time, RockingResult& result) const;
    void write(RockingResult& result) const;

private:
    // What is integrated: slip and rotation with their rates, path, and works.
    enum Component : std::size_t { slip, slip_rate, turn, turn_rate, path, work_ground, work_loads, work_friction };
    using State = std::array<double, 8>;

    enum class Event { stop, start, land, lift_toe, lift_heel, press, stage, overturn };
    static constexpr std::size_t event_count = 8;

    /// Accelerations and forces of an instant.
    struct Instant {
        double slip_accel = 0.0, turn_accel = 0.0;
        double normal = 0.0; ///< N' [N/m]
        double drive = 0.0; ///< friction that keeps the corner where it is, with the sign of the slip it prevents [N/m]
        double resistance = 0.0; ///< at most that much [N/m]
        double from_toe = 0.0;   ///< moment of N' about the toe [N]; of a block flat on its base
        double over_toe = 0.0;   ///< clockwise moment about the toe that N' has to balance: positive tips [N]
        double over_heel = 0.0;  ///< the same about the heel: negative tips [N]
        bool jams = false;       ///< friction and weight hold the sliding corner however hard it is driven: no answer
    };

    struct Found {
        double time;
        Event event;
    };

    BaseAcceleration ground(double x) const;
    Instant instant(double x, const State& y) const;
    void accelerate(const CornerEquations& e, bool turns, double friction, double bond, Instant& now) const;
    bool fills(Stance stance, double x) const;
    void slide_with_crack(double friction, double x, Instant& now) const;
    bool brittle(const State& y) const;
    double bonded_length(const Instant& now) const;
    State rates(double x, const State& y) const;
    State after(double h) const;
    double let_water_flow();
    double wet_on_base(SlipDirection direction, double h) const;
    void drive_water_out();
    double chosen_step();
    double distance(Event event, double x, const State& y) const;
    std::optional<Found> first_event(double h) const;
    double locate(Event event, double from, double to) const;
    std::optional<double> dip(double from, double to) const;

    void elapse(double h, const State& to);
    void note_extremes(double h, const State& to);
    void apply(Event event);
    void stop();
    void start(double drive);
    void lift(Stance stance);
    void stand_on(Stance stance);
    void land();
    void move_at(double v);
    void enter_stages();
    void settle();
    void settle_slip();
    void settle_on_base();
    bool agrees(Stance stance, double direction) const;
    bool agrees_at_limit(Stance stance) const;
    void lose_bond();

    Corner corner_of(Stance stance, double x) const;
    Corner standing(double x) const { return corner_of(stance_, x); }
    double tipping_moment(Stance stance, double bond, double x, const State& y) const;
    double friction(double path_slipped) const { return friction_at(block_.stages[stage_].slip, path_slipped); }
    double next_stage_path() const;

    const RockingBlock& block_;
    SlidingOptions options_;
    std::vector<Corner> bases_, toes_, heels_; ///< of each stage; on its whole base: about the toe

    // The interval: what is left of it.
    double time_ = 0.0, span_ = 0.0; ///< [s]
    Line a_h_, a_v_;
    double step_ = 0.0; ///< next length to try [s]; 0: as long as the interval
    double part_ = 0.0; ///< water under the block that stands flat goes on by parts of the interval [s]

    // The block.
    State y_{};
    Stance stance_ = Stance::base;
    bool sliding_ = false, pressed_ = true, bonded_ = false, settled_ = false;
    double direction_ = 1.0; ///< of the slip, +1 downstream
    std::size_t stage_ = 0;

    /// How far water has come into the joint from one end, and how fast it goes on until the next event.
    struct Front {
        double wet = 0.0;  ///< x_w [m]
        double rate = 0.0; ///< [m/s]
        double at(double x) const { return wet + rate * x; }
    };
    Front from_heel_, from_toe_; ///< of block_.mouth
    const Front& front(SlipDirection d) const { return d == SlipDirection::downstream ? from_heel_ : from_toe_; }
    Front& front(SlipDirection d) { return d == SlipDirection::downstream ? from_heel_ : from_toe_; }

    // Results.
    SlipTotals slid_;
    double landing_loss_ = 0.0, largest_work_ = 0.0, first_energy_ = 0.0;
    double longest_wet_ = 0.0; ///< [m]
    RockingResult seen_;       ///< rotations, counts and times
    bool unresolved_ = false, overturned_ = false, jammed_ = false;
};

} // namespace damslip::sliding
