#pragma once

#include "sliding/block/roots.hpp"
#include "sliding/block/slip_motion.hpp"
#include "sliding/rocking/rocking.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace damslip::sliding {

/// What the block stands on.
enum class Stance { base, toe, heel };

/// +1: clockwise, the way a block turns on that corner.
inline double sense(Stance stance)
{
    return stance == Stance::heel ? -1.0 : 1.0;
}

/// Ground acceleration in the directions of the base [m/s^2]: along it downstream, and up from it.
struct BaseAcceleration {
    double t = 0.0, n = 0.0;
};
/// @param a_h, a_v  upstream and up positive, as everywhere
BaseAcceleration in_base_directions(double base_inclination, double a_h, double a_v);

/// The block seen from a corner of its base. All about that corner; rotation theta clockwise, positive for a block that
/// stands on its toe, negative for one on its heel.
///
/// With rho = R(theta) (centroid - corner) and q = (s, theta), s the slip of the corner downstream:
///
///     (m + M_tt) s'' + (m rho_n + M_tr) theta'' = F_t + T - (m + M_tt) a_t - M_tn a_n + m theta'^2 rho_t
///     (m rho_n + M_tr) s'' + J theta''          = Q(theta) - m (rho_n a_t - rho_t a_n) - M_tr a_t - M_nr a_n
///     N' = -(F_n + U) + (m + M_nn) a_n + M_tn (a_t + s'') - m theta'^2 rho_n + (M_nr - m rho_t) theta''
///
/// J = I + m |rho|^2 + M_rr;  Q(theta) = cos theta Q(0) - sin theta (sum of force . (point - corner)).
/// The equations of Shenton (1996) for a general body with dead loads and added mass; T is the friction on the block,
/// downstream positive.
struct Corner {
    double sense = 1.0; ///< +1 toe, -1 heel: the way it turns
    Point arm;          ///< from the corner to the centroid at theta = 0 [m]
    double mass = 0.0;  ///< of the dam [kg/m]
    BaseAddedMass water;
    double inertia = 0.0;                ///< J [kg m]
    double force_t = 0.0, force_n = 0.0; ///< static loads with uplift [N/m]
    double moment = 0.0;                 ///< Q(0), with uplift [N]
    double virial = 0.0;                 ///< [N]

    /// From the corner to the centroid of the turned block.
    Point turned(double theta) const;
    /// Clockwise moment of the static loads on the turned block [N].
    double static_moment(double theta) const;
};

/// @param stage  whose uplift counts on the base, and on a corner where the block has no other uplift for it
/// @param stance  base: about the toe
Corner corner(const RockingBlock& block, const RockingStage& stage, Stance stance);

/// Uplift of the joint that is open to the corner `stance` and holds water as far as `wet` from its mouth [m].
UpliftResultant mouth_uplift(const RockingBlock& block, Stance stance, double wet);

/// The corner with another uplift.
Corner with_uplift(Corner corner, const RockingBlock& block, const UpliftResultant& uplift);

/// The equations of a corner at one instant: mass terms and right-hand sides.
struct CornerEquations {
    double tt = 0.0, tr = 0.0, rr = 0.0; ///< of s'', of both, of theta''
    double nt = 0.0, nr = 0.0;           ///< N' per s'' and per theta''
    double push = 0.0;                   ///< of the first, without T [N/m]
    double turn = 0.0;                   ///< of the second [N]
    double press = 0.0;                  ///< of the third: N' without accelerations [N/m]
};
CornerEquations equations(const Corner& corner, double theta, double rate, const BaseAcceleration& ground);

/// Momentum (along, up, about the corner) of a block that moves with its corner (v_t, v_n) and turns, at theta = 0.
struct Momentum {
    double t = 0.0, n = 0.0, r = 0.0;
};
Momentum momentum(const Corner& corner, double v_t, double v_n, double rate);

/// Kinetic energy relative to the rock [J/m], added mass included.
double kinetic_energy(const Corner& corner, double theta, double slip_rate, double rate);

/// State after a step and how far the embedded lower order is off.
template <std::size_t n>
struct RungeKuttaStep {
    std::array<double, n> state{};
    std::array<double, n> error{};
};

/// One step of y' = f(x, y) from (x, y) by h: order 5 with an embedded 4. Dormand & Prince (1980), J. Comput. Appl. Math. 6.
template <std::size_t n, class Function>
RungeKuttaStep<n> dormand_prince(Function&& f, double x, const std::array<double, n>& y, double h)
{
    constexpr std::array<double, 7> nodes{0.0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1.0, 1.0};
    constexpr double a[7][6] = {{},
                                {1.0 / 5},
                                {3.0 / 40, 9.0 / 40},
                                {44.0 / 45, -56.0 / 15, 32.0 / 9},
                                {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
                                {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
                                {35.0 / 384, 0.0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
    constexpr std::array<double, 7> fourth{5179.0 / 57600,    0.0,          7571.0 / 16695, 393.0 / 640,
                                           -92097.0 / 339200, 187.0 / 2100, 1.0 / 40};
    std::array<std::array<double, n>, 7> k;
    RungeKuttaStep<n> step;
    for (std::size_t stage = 0; stage < 7; ++stage) {
        step.state = y;
        for (std::size_t j = 0; j < stage; ++j)
            for (std::size_t i = 0; i < n; ++i) step.state[i] += h * a[stage][j] * k[j][i];
        k[stage] = f(x + nodes[stage] * h, step.state);
    }
    for (std::size_t i = 0; i < n; ++i) { // the last stage stands at the new state: step.state is it
        double embedded = y[i];
        for (std::size_t j = 0; j < 7; ++j) embedded += h * fourth[j] * k[j][i];
        step.error[i] = step.state[i] - embedded;
    }
    return step;
}

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
