#include "sliding/rocking/rocking_motion.hpp"

#include <algorithm>
#include <cmath>

// What the block does at an event: a start, a stop, a corner that lifts, an impact, another stage.
namespace damslip::sliding {

namespace {

constexpr double shortest_corner_flight = 1e-7;   // [s]: a corner that would come down again sooner stays

} // namespace

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
    if (w_after == 0.0 || (returns && 2.0 * std::abs(w_after) < shortest_corner_flight * std::abs(back))) {
        stance_ = Stance::base;
        drive_water_out();
        y_[turn_rate] = 0.0;
        const double v_base = slip_after(0.0);
        move_at(0.0); // a slide as short as the flight stays, too
        const bool stays = std::abs(v_base) * e.tt < shortest_corner_flight * instant(0.0, y_).resistance;
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

} // namespace damslip::sliding
