#include "sliding/rocking/rocking_motion.hpp"

#include "sliding/block/roots.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace damslip::sliding {

namespace {

constexpr double local_error = 1e-12;      // of a step, in m and m/s, and relative
constexpr int looks = 4;                   // at the events within a step
constexpr int most_events = 20000; // a slender block lands hundreds of times before it stands
constexpr std::array both_directions{SlipDirection::downstream, SlipDirection::upstream};

/// The joint under a block on its toe is that of sliding downstream: it opens at the heel.
SlipDirection opens_for(Stance stance)
{
    return stance == Stance::heel ? SlipDirection::upstream : SlipDirection::downstream;
}

} // namespace

RockingMotion::RockingMotion(const RockingBlock& block, const SlideOptions& options, const RockingStart& start)
    : block_(block), options_(options.sliding)
{
    for (const RockingStage& stage : block.stages) {
        bases_.push_back(corner(block, stage, Stance::base));
        toes_.push_back(corner(block, stage, Stance::toe));
        heels_.push_back(corner(block, stage, Stance::heel));
    }
    bonded_ = block.cohesion > 0.0;
    if (block.mouth)
        for (const SlipDirection direction : both_directions)
            front(direction).wet = block.mouth->flat->first(direction);
    if (start.rotation == 0.0 && start.rotation_rate == 0.0) return;
    y_[turn] = start.rotation;
    y_[turn_rate] = start.rotation_rate;
    stance_ = start.rotation > 0.0 || (start.rotation == 0.0 && start.rotation_rate > 0.0) ? Stance::toe : Stance::heel;
    bonded_ = false;
    first_energy_ = kinetic_energy(standing(0.0), y_[turn], 0.0, y_[turn_rate]);
}

/// With the water that its joint holds x from now.
Corner RockingMotion::corner_of(Stance stance, double x) const
{
    if (stance == Stance::base) return bases_[stage_];
    const Corner& dry = stance == Stance::toe ? toes_[stage_] : heels_[stage_];
    if (!block_.mouth) return dry;
    return with_uplift(dry, block_, mouth_uplift(block_, stance, front(opens_for(stance)).at(x)));
}

BaseAcceleration RockingMotion::ground(double x) const
{
    const double share = span_ > 0.0 ? x / span_ : 0.0;
    return in_base_directions(block_.base_inclination, a_h_.at(share), a_v_.at(share));
}

/// Length that still has its bond [m]: closed before the earthquake, and pressed by N' where it acts now. The effective
/// stress is a triangle over three times the distance of N' from the nearer end.
double RockingMotion::bonded_length(const Instant& now) const
{
    const double length = block_.length;
    if (!(now.normal > 0.0)) return 0.0;
    const double from_toe = now.from_toe / now.normal;
    double heel_open = std::max(0.0, length - 3.0 * from_toe);
    double toe_open = std::max(0.0, length - 3.0 * (length - from_toe));
    double& cracked = block_.crack.side == Side::heel ? heel_open : toe_open;
    cracked = std::max(cracked, block_.crack.length);
    return std::max(0.0, length - heel_open - toe_open);
}

/// Is the bond lost at first slip? One that stays while it slides is taken as the sliding block takes it.
bool RockingMotion::brittle(const State& y) const
{
    return next_stage_path() <= y[path] && block_.stages[stage_ + 1].slip.block.cohesion_force == 0.0;
}

/// Accelerations of what the block does now. Sliding: T = -direction (mu N' + c A').
void RockingMotion::accelerate(const CornerEquations& e, bool turns, double mu, double bond, Instant& now) const
{
    if (!sliding_) {
        now.turn_accel = turns ? e.turn / e.rr : 0.0;
        return;
    }
    // T = -d (mu N' + c), N' = press + nt s'' + nr theta''.
    const double d = direction_;
    const double tt = e.tt + d * mu * e.nt, tr = turns ? e.tr + d * mu * e.nr : 0.0;
    const double push = e.push - d * (mu * e.press + bond);
    if (!turns) {
        now.jams = !(tt > 0.0);
        now.slip_accel = push / tt;
        return;
    }
    const double determinant = tt * e.rr - tr * e.tr;
    now.jams = !(determinant > 0.0);
    now.slip_accel = (push * e.rr - tr * e.turn) / determinant;
    now.turn_accel = (tt * e.turn - e.tr * push) / determinant;
}

/// Clockwise moment about a corner that the block would have to turn with if it stood on it now, without turning yet: with the
/// uplift of the joint that is open to there. While it slides the wetter of both joints, the open and the shut one, says by what
/// friction: a joint that would be drier once open is still shut until what the block slides with tips it.
double RockingMotion::tipping_moment(Stance stance, double bond, double x, const State& y) const
{
    const BaseAcceleration a = ground(x);
    const Corner open = corner_of(stance, x);
    const Corner& shut = bases_[stage_];
    const CornerEquations e = equations(open, 0.0, 0.0, a);
    Instant now;
    accelerate(open.force_n < shut.force_n ? equations(shut, 0.0, 0.0, a) : e, false,
               pressed_ ? friction(y[path]) : 0.0, bond, now);
    return e.turn - e.tr * now.slip_accel;
}

/// Does more water stand under the block on that corner than under the block on its base?
bool RockingMotion::fills(Stance stance, double x) const
{
    return corner_of(stance, x).force_n > bases_[stage_].force_n;
}

/// Flat on its base the block slides with the crack that its own acceleration opens. Where it would tip if it slid by the
/// friction of the shut joint, and not by that of the open one, the crack lies between: water comes in until the block slides
/// so fast that its resultant stays at the corner, over_toe = 0.
void RockingMotion::slide_with_crack(double mu, double x, Instant& now) const
{
    const Stance ahead = direction_ > 0.0 ? Stance::toe : Stance::heel;
    if (!fills(ahead, x)) return;
    const CornerEquations e = equations(corner_of(ahead, x), 0.0, 0.0, ground(x));
    Instant through;
    accelerate(e, false, mu, 0.0, through);
    const double balanced = std::min(direction_ * e.turn / e.tr, direction_ * through.slip_accel);
    if (!(balanced > direction_ * now.slip_accel)) return;
    now.slip_accel = direction_ * balanced;
    now.resistance = std::max(0.0, direction_ * (e.push - e.tt * now.slip_accel));
    now.normal = now.resistance / mu;
}

RockingMotion::Instant RockingMotion::instant(double x, const State& y) const
{
    const BaseAcceleration a = ground(x);
    const CornerEquations e = equations(standing(x), y[turn], y[turn_rate], a);
    const double mu = pressed_ ? friction(y[path]) : 0.0;
    const double kept = bonded_ && pressed_ ? block_.stages[stage_].slip.block.cohesion_force : 0.0;
    Instant now;
    const double bond = sliding_ ? kept : 0.0;
    accelerate(e, stance_ != Stance::base, mu, bond, now);
    now.normal = e.press + e.nt * now.slip_accel + e.nr * now.turn_accel;
    now.drive = e.push - e.tr * (sliding_ ? 0.0 : now.turn_accel);
    now.resistance = mu * std::max(0.0, now.normal);
    if (stance_ == Stance::base) {
        if (sliding_ && kept == 0.0 && mu > 0.0) slide_with_crack(mu, x, now);
        now.from_toe = -(e.turn - e.tr * now.slip_accel);
        now.over_toe = block_.uplift_on_toe || block_.mouth ? tipping_moment(Stance::toe, bond, x, y) : -now.from_toe;
        now.over_heel = tipping_moment(Stance::heel, bond, x, y);
        if (kept > 0.0) now.resistance += !sliding_ && brittle(y) ? block_.cohesion * bonded_length(now) : kept;
    }
    return now;
}

RockingMotion::State RockingMotion::rates(double x, const State& y) const
{
    const Instant now = instant(x, y);
    const BaseAcceleration a = ground(x);
    const Corner k = standing(x);
    const double v = sliding_ ? y[slip_rate] : 0.0, w = stance_ == Stance::base ? 0.0 : y[turn_rate];
    const Point rho = k.turned(y[turn]);
    const BaseAddedMass& m = k.water;
    State rate{};
    rate[slip] = v;
    rate[slip_rate] = now.slip_accel;
    rate[turn] = w;
    rate[turn_rate] = now.turn_accel;
    rate[path] = std::abs(v);
    rate[work_ground] = -k.mass * (a.t * (v + w * rho.y) - a.n * w * rho.x) - (m.tt * a.t + m.tn * a.n) * v -
                        (m.tr * a.t + m.nr * a.n) * w;
    rate[work_loads] = k.force_t * v + k.static_moment(y[turn]) * w;
    rate[work_friction] = now.resistance * std::abs(v);
    return rate;
}

/// The state after h, by one step.
RockingMotion::State RockingMotion::after(double h) const
{
    if (h == 0.0 || at_rest()) return y_;
    return dormand_prince([this](double x, const State& y) { return rates(x, y); }, 0.0, y_, h).state;
}

/// x_w of the block that stands on its whole base, h from now: as far as its crack lets the water come. The crack of a block
/// that slides is that of what its own acceleration leaves of the ground's.
double RockingMotion::wet_on_base(SlipDirection direction, double h) const
{
    const SlowWater& water = *block_.mouth->flat;
    const double share = sliding_ || span_ == 0.0 ? 0.0 : h / span_;
    const double slips = sliding_ ? instant(0.0, y_).slip_accel : 0.0;
    const double a_h = a_h_.at(share) - slips * std::cos(block_.base_inclination);
    const double a_v = a_v_.at(share) - slips * std::sin(block_.base_inclination);
    const double now = front(direction).wet, come = std::min(now + water.speed() * h, water.length());
    return water.front(direction, a_h, a_v, now, come);
}

/// Sets the rates of both fronts. @returns how long they hold [s]
double RockingMotion::let_water_flow()
{
    if (!block_.mouth) return span_;
    const SlowWater& water = *block_.mouth->flat;
    if (stance_ != Stance::base) {
        Front& open = front(opens_for(stance_));
        const double dry = water.length() - open.wet;
        open.rate = dry > 0.0 ? water.speed() : 0.0;
        return dry > 0.0 ? std::min(span_, dry / water.speed()) : span_;
    }
    const auto flow = [&](double h) {
        bool flows = false;
        for (const SlipDirection direction : both_directions) {
            Front& front = this->front(direction);
            front.rate = (wet_on_base(direction, h) - front.wet) / h;
            flows = flows || front.rate != 0.0;
        }
        return flows;
    };
    if (!flow(span_) || span_ <= part_) return span_;
    flow(part_);
    return part_;
}

/// A joint that shuts drives its water out: of the block on a corner all that has come in at the other end, of the block on
/// its base what its crack does not hold.
void RockingMotion::drive_water_out()
{
    if (!block_.mouth) return;
    for (const SlipDirection direction : both_directions) {
        if (stance_ == Stance::base)
            front(direction) = {wet_on_base(direction, 0.0), 0.0};
        else if (direction != opens_for(stance_))
            front(direction) = {block_.mouth->flat->first(direction), 0.0};
    }
}

/// A length whose local error is small enough.
double RockingMotion::chosen_step()
{
    const double longest = let_water_flow();
    if (at_rest()) return longest;
    double h = step_ > 0.0 ? std::min(step_, longest) : longest;
    for (;;) {
        const auto step = dormand_prince([this](double x, const State& y) { return rates(x, y); }, 0.0, y_, h);
        double error = 0.0;
        for (const auto& [i, length] : {std::pair{slip, 1.0}, std::pair{slip_rate, 1.0}, std::pair{turn, block_.length},
                                        std::pair{turn_rate, block_.length}})
            error = std::max(error, std::abs(step.error[i]) * length /
                                        (local_error * (1.0 + length * std::abs(step.state[i]))));
        const double factor = 0.9 * std::pow(std::max(error, 1e-10), -0.2);
        if (error <= 1.0 || h < 1e-9) {
            step_ = h * std::clamp(factor, 0.3, 5.0);
            return h;
        }
        h *= std::clamp(factor, 0.1, 0.9);
    }
}

/// Positive while the event has not come; infinite for one that cannot come now.
double RockingMotion::distance(Event event, double x, const State& y) const
{
    const bool on_base = stance_ == Stance::base;
    switch (event) {
    case Event::stop:
        return sliding_ ? direction_ * y[slip_rate] : never;
    case Event::land:
        return on_base ? never : sense(stance_) * y[turn];
    case Event::stage:
        return sliding_ ? next_stage_path() - y[path] : never;
    case Event::overturn:
        return 0.5 * std::numbers::pi - std::abs(y[turn]);
    default:
        break;
    }
    const Instant now = instant(x, y);
    switch (event) {
    case Event::start:
        if (sliding_ || (now.drive < 0.0 && !options_.two_way)) return never;
        return now.resistance - std::abs(now.drive);
    case Event::lift_toe: // the heel leaves the rock
        return on_base && pressed_ ? -now.over_toe : never;
    case Event::lift_heel:
        return on_base && pressed_ ? now.over_heel : never;
    default:
        return pressed_ ? now.normal : -now.normal;
    }
}

/// Where the rate of slip has its least value between two looks that both see it slide; nothing where it has none.
std::optional<double> RockingMotion::dip(double from, double to) const
{
    const double before = direction_ * instant(from, after(from)).slip_accel;
    const double then = direction_ * instant(to, after(to)).slip_accel;
    if (!(before < 0.0 && then > 0.0)) return std::nullopt;
    return from + (to - from) * before / (before - then);
}

/// The root between `from`, where the event has not come, and `to`, where it has. A motion that has only just begun stands
/// at zero with `from`: the root is then the one after it has gone up.
double RockingMotion::locate(Event event, double from, double to) const
{
    const auto f = [&](double x) { return distance(event, x, after(x)); };
    if (f(from) > 0.0) return bracketed_root(f, from, to);
    double upper = to;
    for (int k = 0; k < 40; ++k) {
        const double middle = from + 0.5 * (upper - from);
        if (f(middle) > 0.0) return bracketed_root(f, middle, upper);
        upper = middle;
    }
    return from;
}

std::optional<RockingMotion::Found> RockingMotion::first_event(double h) const
{
    double from = 0.0;
    for (int k = 1; k <= looks; ++k) {
        double to = k == looks ? h : h * k / looks;
        if (sliding_ && direction_ * after(from)[slip_rate] > 0.0) // not a start of just now
            if (const auto least = dip(from, to))
                if (distance(Event::stop, *least, after(*least)) < 0.0) to = *least;
        const State there = after(to);
        std::optional<Found> first;
        for (std::size_t i = 0; i < event_count; ++i) {
            const auto event = static_cast<Event>(i);
            if (!(distance(event, to, there) < 0.0)) continue;
            const double x = locate(event, from, to);
            if (!first || x < first->time) first = Found{x, event};
        }
        if (first) return first;
        from = to;
    }
    return std::nullopt;
}

void RockingMotion::cross(double start, double dt, const Line& a_h, const Line& a_v)
{
    time_ = start;
    span_ = dt;
    a_h_ = a_h;
    a_v_ = a_v;
    if (block_.mouth) part_ = dt / parts(*block_.mouth->flat, dt);
    if (!settled_) {
        settled_ = true;
        pressed_ = instant(0.0, y_).normal > 0.0;
        settle();
    }
    for (int events = 0; span_ > 0.0 && !finished(); ++events) {
        jammed_ = sliding_ && instant(0.0, y_).jams;
        unresolved_ = jammed_ || events == most_events;
        if (unresolved_) return;
        const double h = chosen_step();
        const auto found = first_event(h);
        elapse(found ? found->time : h, after(found ? found->time : h));
        if (found) apply(found->event);
    }
}

/// Largest rotation where it turns back, largest slip and rate.
void RockingMotion::note_extremes(double h, const State& to)
{
    const auto note = [this](double rotation) {
        seen_.max_toe_rotation = std::max(seen_.max_toe_rotation, rotation);
        seen_.max_heel_rotation = std::max(seen_.max_heel_rotation, -rotation);
    };
    if (y_[turn_rate] * to[turn_rate] < 0.0)
        note(after(bracketed_root([&](double x) { return after(x)[turn_rate]; }, 0.0, h))[turn]);
    note(to[turn]);
    slid_.largest = std::max(slid_.largest, std::abs(to[slip]));
    slid_.peak_rate = std::max(slid_.peak_rate, std::abs(to[slip_rate]));
    largest_work_ = std::max(
        {largest_work_, std::abs(to[work_ground]), std::abs(to[work_loads]), to[work_friction] + landing_loss_});
}

void RockingMotion::elapse(double h, const State& to)
{
    note_extremes(h, to);
    (direction_ > 0.0 ? slid_.downstream : slid_.upstream) += std::abs(to[slip] - y_[slip]);
    y_ = to;
    time_ += h;
    for (Front* front : {&from_heel_, &from_toe_}) {
        front->wet = std::min(front->at(h), block_.length);
        longest_wet_ = std::max(longest_wet_, front->wet);
    }
    if (h >= span_) {
        span_ = 0.0;
        a_h_.now = a_h_.end;
        a_v_.now = a_v_.end;
        return;
    }
    const double share = h / span_;
    a_h_.now = a_h_.at(share);
    a_v_.now = a_v_.at(share);
    span_ -= h;
}

} // namespace damslip::sliding
