#include "sliding/rocking/rocking_motion.hpp"

#include "sliding/block/roots.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace damslip::sliding {

namespace {

constexpr double local_error = 1e-12;      // of a step, in m and m/s, and relative
constexpr int looks = 4;                   // at the events within a step
constexpr int events_per_interval = 20000; // a slender block lands hundreds of times before it stands
constexpr double shortest_flight = 1e-7;   // [s]: a corner that would come down again sooner stays
constexpr std::array both_directions{SlipDirection::downstream, SlipDirection::upstream};

/// +1 clockwise, the way a block turns on that corner.
double sense(Stance stance)
{
    return stance == Stance::heel ? -1.0 : 1.0;
}

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
        unresolved_ = jammed_ || events == events_per_interval;
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

void RockingMotion::apply(Event event)
{
    switch (event) {
    case Event::stop:
        stop();
        settle();
        break;
    case Event::start:
        if (const std::size_t before = stage_; start(instant(0.0, y_).drive), stage_ != before) settle();
        break;
    case Event::land:
        land();
        break;
    case Event::lift_toe:
        lift(Stance::toe);
        break;
    case Event::lift_heel:
        lift(Stance::heel);
        break;
    case Event::press:
        pressed_ = !pressed_;
        if (!pressed_) ++slid_.lift_offs;
        settle();
        break;
    case Event::stage:
        y_[path] = next_stage_path();
        enter_stages();
        settle();
        break;
    case Event::overturn:
        overturned_ = true;
        seen_.overturned_time = time_;
        break;
    }
}

void RockingMotion::stop()
{
    sliding_ = false;
    y_[slip_rate] = 0.0;
    slid_.end(time_, y_[path]);
}

void RockingMotion::start(double drive)
{
    sliding_ = true;
    direction_ = drive < 0.0 ? -1.0 : 1.0;
    slid_.begin(time_, y_[path]);
    enter_stages();
}

double RockingMotion::next_stage_path() const
{
    return stage_ + 1 < block_.stages.size() ? block_.stages[stage_ + 1].slip.from_slip : never;
}

void RockingMotion::enter_stages()
{
    while (next_stage_path() <= y_[path]) ++stage_;
    if (block_.stages[stage_].slip.block.cohesion_force == 0.0) lose_bond();
}

void RockingMotion::lose_bond()
{
    if (bonded_) seen_.bond_lost_time = time_;
    bonded_ = false;
}

/// What the block does from now on, after its forces have jumped.
void RockingMotion::settle()
{
    if (stance_ == Stance::base && pressed_)
        settle_on_base();
    else
        settle_slip();
}

/// A corner that does not move along the base: does it stay, or which way does it go?
void RockingMotion::settle_slip()
{
    if (y_[slip_rate] != 0.0) return;
    if (sliding_) stop();
    const Instant now = instant(0.0, y_);
    const bool barred = now.drive < 0.0 && !options_.two_way;
    if (!barred && std::abs(now.drive) > now.resistance) start(now.drive);
}

/// Flat on its base both questions, slip and rocking, have to be answered together: friction may hold a block that rocks and
/// not one that stands, and the other way round. The first answer that agrees with itself, the calmest one first.
void RockingMotion::settle_on_base()
{
    struct Answer {
        Stance stance;
        double direction; ///< 0: does not slide
    };
    const double v = y_[slip_rate];
    for (const Answer& answer : {Answer{Stance::base, 0.0}, Answer{Stance::base, 1.0}, Answer{Stance::base, -1.0},
                                 Answer{Stance::toe, 0.0}, Answer{Stance::heel, 0.0}, Answer{Stance::toe, 1.0},
                                 Answer{Stance::toe, -1.0}, Answer{Stance::heel, 1.0}, Answer{Stance::heel, -1.0}}) {
        if (v != 0.0 ? !(answer.direction * v > 0.0) : answer.direction < 0.0 && !options_.two_way) continue;
        if (!agrees(answer.stance, answer.direction)) continue;
        if (sliding_ && v == 0.0) stop();
        if (answer.direction != 0.0 && !sliding_) start(answer.direction);
        if (answer.stance != Stance::base) stand_on(answer.stance);
        return;
    }
    settle_slip(); // round-off between two answers
}

/// Does the block, at rest or sliding that way, do what this answer says?
bool RockingMotion::agrees(Stance stance, double direction) const
{
    RockingMotion trial(*this);
    trial.stance_ = stance;
    trial.sliding_ = direction != 0.0;
    if (direction != 0.0) trial.direction_ = direction;
    const Instant now = trial.instant(0.0, y_);
    if (now.jams) return false;
    const bool barred = now.drive < 0.0 && !options_.two_way;
    if (direction == 0.0 && !barred && std::abs(now.drive) > now.resistance) return false;
    if (direction != 0.0 && y_[slip_rate] == 0.0 && !(direction * now.slip_accel > 0.0)) return false;
    if (stance == Stance::base) return now.over_toe <= 0.0 && now.over_heel >= 0.0;
    return sense(stance) * now.turn_accel > 0.0;
}

/// The base opens from end to end: the block stands on the corner, unless it would slide there and by that come back at once.
void RockingMotion::lift(Stance stance)
{
    lose_bond();
    const double direction = sense(stance);
    if (!sliding_ && fills(stance, 0.0) && (direction > 0.0 || options_.two_way) && !agrees_at_limit(stance))
        start(direction);
    else
        stand_on(stance);
}

/// Does a block at rest that is about to tip stay on that corner? Not where the friction of the open joint lets it go, and
/// sliding presses its base back on the rock.
bool RockingMotion::agrees_at_limit(Stance stance) const
{
    RockingMotion trial(*this);
    trial.stance_ = stance;
    const Instant held = trial.instant(0.0, y_);
    if (std::abs(held.drive) <= held.resistance) return true;
    trial.sliding_ = true;
    trial.direction_ = held.drive < 0.0 ? -1.0 : 1.0;
    return trial.direction_ != sense(stance) || sense(stance) * trial.instant(0.0, y_).turn_accel >= 0.0;
}

void RockingMotion::stand_on(Stance stance)
{
    if (seen_.rocks++ == 0) seen_.first_rock_time = time_;
    stance_ = stance;
    drive_water_out();
    lose_bond();
}

/// The corner in the air comes down.
///
/// Housner (1963): the impulse at that corner has no moment about it, so the angular momentum about it stays; along the base
/// Coulomb's law holds for the impulse, with the slip rate after the landing.
void RockingMotion::land()
{
    if (seen_.landings++ == 0) seen_.first_landing_time = time_;
    const Corner old_corner = standing(0.0);
    const Stance other = stance_ == Stance::toe ? Stance::heel : Stance::toe;
    const Corner k = corner_of(other, 0.0);
    const double v = y_[slip_rate];
    const double w = old_corner.sense * y_[turn_rate] < 0.0 ? y_[turn_rate] : 0.0; // else it has not left: round-off
    const double before = kinetic_energy(old_corner, 0.0, v, w);
    const double down = w * (k.arm.x - old_corner.arm.x); // clockwise: points downstream of the old corner sink
    const Momentum p = momentum(k, v, down, w);
    const CornerEquations e = equations(k, 0.0, 0.0, {}); // its mass terms
    const double mu = friction(y_[path]);
    // Slip rate after, for the angular rate w: Coulomb's impulse mu P_n against it, P_n = nt v + nr w - p.n.
    const auto slip_after = [&](double rate) {
        const double free = p.t - e.tr * rate; // what friction has to take up for v = 0
        if (std::abs(free) <= mu * (e.nr * rate - p.n)) return 0.0;
        const double d = free < 0.0 ? -1.0 : 1.0;
        if (d < 0.0 && !options_.two_way) return 0.0;
        const double slides = (free - d * mu * (e.nr * rate - p.n)) / (e.tt + d * mu * e.nt);
        return d * slides > 0.0 ? slides : 0.0;
    };
    double w_after = 0.0, v_after = 0.0;
    if (options_.restitution) {
        const auto gains = [&](double r) {
            return kinetic_energy(k, 0.0, slip_after(r * w), r * w) > before * (1.0 + 1e-14);
        };
        double ratio = *options_.restitution;
        if (gains(ratio)) {
            double low = 0.0;
            for (int i = 0; i < 60; ++i) (gains(0.5 * (low + ratio)) ? ratio : low) = 0.5 * (low + ratio);
            ratio = low;
        }
        w_after = ratio * w;
        v_after = slip_after(w_after);
    } else {
        w_after = p.r / e.rr; // the corner sticks
        v_after = slip_after(w_after);
        if (v_after != 0.0) { // it slides: both at once
            const double d = v_after < 0.0 ? -1.0 : 1.0;
            const double tt = e.tt + d * mu * e.nt, tr = e.tr + d * mu * e.nr, push = p.t + d * mu * p.n;
            const double determinant = tt * e.rr - tr * e.tr;
            v_after = (push * e.rr - tr * p.r) / determinant;
            w_after = (tt * p.r - e.tr * push) / determinant;
        }
        if (w_after * w <= 0.0) { // would go on into the rock with the old corner: both stand
            w_after = 0.0;
            v_after = slip_after(0.0);
        }
    }
    stance_ = other;
    pressed_ = true;
    y_[turn] = 0.0;
    y_[turn_rate] = w_after;
    move_at(v_after);
    settle_slip();
    const double back = instant(0.0, y_).turn_accel;
    const bool returns = (back > 0.0) != (w_after > 0.0);
    if (w_after == 0.0 || (returns && 2.0 * std::abs(w_after) < shortest_flight * std::abs(back))) {
        stance_ = Stance::base;
        drive_water_out();
        y_[turn_rate] = 0.0;
        const double v_base = slip_after(0.0);
        move_at(0.0); // a slide as short as the flight stays, too
        const bool stays = std::abs(v_base) * e.tt < shortest_flight * instant(0.0, y_).resistance;
        if (!(stays && agrees(Stance::base, 0.0))) move_at(v_base);
    } else {
        drive_water_out();
        ++seen_.rocks;
    }
    landing_loss_ += before - kinetic_energy(k, 0.0, y_[slip_rate], y_[turn_rate]);
    pressed_ = instant(0.0, y_).normal > 0.0;
    settle();
}

/// The slip rate jumps.
void RockingMotion::move_at(double v)
{
    const bool goes_on = sliding_ && v * direction_ > 0.0;
    if (sliding_ && !goes_on) stop();
    y_[slip_rate] = v;
    if (v != 0.0 && !goes_on) start(v);
}

void RockingMotion::add_sample(double time, RockingResult& result) const
{
    SlideHistory& history = result.slide.history;
    history.time.push_back(time);
    history.slip.push_back(y_[slip]);
    history.slip_rate.push_back(y_[slip_rate]);
    history.normal_force.push_back(pressed_ ? std::max(0.0, instant(0.0, y_).normal) : 0.0);
    result.rotation.push_back(y_[turn]);
    result.uplift.push_back(stance_ == Stance::base ? block_.stages[stage_].slip.block.uplift
                                                    : standing(0.0).force_n - block_.force_n);
}

void RockingMotion::write(RockingResult& result) const
{
    std::vector<double> rotation = std::move(result.rotation), uplift = std::move(result.uplift);
    SlideHistory history = std::move(result.slide.history);
    result = seen_;
    result.rotation = std::move(rotation);
    result.uplift = std::move(uplift);
    SlideResult& r = result.slide;
    r.history = std::move(history);
    r.accuracy = SlideAccuracy::series;
    r.slip = y_[slip];
    slid_.write(r, time_, sliding_);
    r.wet_length = longest_wet_;
    r.max_gap = block_.length *
                std::sin(std::min(0.5 * std::numbers::pi, std::max(seen_.max_toe_rotation, seen_.max_heel_rotation)));
    RockingEnergy& e = result.energy;
    e.ground = y_[work_ground];
    e.loads = y_[work_loads];
    e.friction = y_[work_friction];
    e.landings = landing_loss_;
    e.kinetic = kinetic_energy(standing(0.0), y_[turn], y_[slip_rate], y_[turn_rate]);
    const double left = first_energy_ + e.ground + e.loads - e.kinetic - e.friction - e.landings;
    e.imbalance = largest_work_ > 0.0 ? left / largest_work_ : 0.0;
}

} // namespace damslip::sliding
