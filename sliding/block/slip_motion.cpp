#include "sliding/block/slip_motion.hpp"

#include "sliding/block/rigid_block.hpp"
#include "sliding/block/roots.hpp"
#include "sliding/block/slip_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace damslip::sliding {
namespace {

/// Sign just after now: positive, or zero and rising.
bool above_zero(const Line& line)
{
    return line.now > 0.0 || (line.now == 0.0 && line.end > 0.0);
}

GroundLinear combination(double a, const GroundLinear& x, double b, const GroundLinear& y)
{
    return {a * x.constant + b * y.constant, a * x.per_a_h + b * y.per_a_h, a * x.per_a_v + b * y.per_a_v};
}

/// Friction tables have tens of values; more than this in one interval is no motion. Friction over the rate takes a step for
/// each few v_c that the rate changes, a rebound some four events for each of its flights.
int events_per_interval(const SlipStage& stage)
{
    return stage.restitution > 0.0 ? 200000 : stage.rate.active() ? 5000 : 1000;
}

constexpr double shortest_flight = 1e-13; ///< [s]; a landing that would rebound for less stays

} // namespace

SlipMotion::SlipMotion(const SlipStages& stages, const SlideOptions& options) : options_(options.sliding)
{
    for (const AnchorBar& bar : options.anchors) anchors_.emplace_back(bar);
    take_stages(stages);
}

void SlipMotion::stand_on(const SlipStages& stages)
{
    take_stages(stages);
    if (!anchors_.empty()) hold_anchors();
    touching_ = true;
}

void SlipMotion::take_stages(const SlipStages& stages)
{
    stages_ = stages;
    forms_.clear();
    plain_.clear();
    forms_.reserve(stages.size());
    for (const SlipStage& stage : stages) {
        forms_.push_back(forms_of(stage.block));
        plain_.push_back(anchors_.empty() && !stage.rate.active() && stage.friction_slope == 0.0 &&
                         !stage.block.opening);
    }
    if (const SlowWater* water = slow_water()) {
        const double heel = water->first(SlipDirection::downstream), toe = water->first(SlipDirection::upstream);
        wet_down_ = {heel, heel};
        wet_up_ = {toe, toe};
    }
    if (anchors_.empty()) return;
    anchored_ = stages;
    unanchored_forms_ = forms_;
}

SlipMotion::StageForms SlipMotion::forms_of(const RigidBlock& block)
{
    const BaseEquations e = base_equations(block);
    // In flight A (s'', y'') = (drive, -normal): inverse of the 2 x 2 matrix.
    const double determinant = e.mass_tt * e.mass_nn - e.mass_tn * e.mass_tn;
    return {.equations = e,
            .free_normal = free_normal_force(e),
            .flight_accel = combination(e.mass_nn / determinant, e.drive, e.mass_tn / determinant, e.normal),
            .gap_accel = combination(-e.mass_tt / determinant, e.normal, -e.mass_tn / determinant, e.drive),
            .excess_downstream = excess_drive(e, block, SlipDirection::downstream),
            .excess_upstream = excess_drive(e, block, SlipDirection::upstream),
            .mass_downstream = sliding_mass(e, block.friction, SlipDirection::downstream),
            .mass_upstream = sliding_mass(e, block.friction, SlipDirection::upstream),
            .friction = block.friction,
            .bond = block.cohesion_force + block.dowel_force};
}

/// The uplift of an opening crack is linear in a_v between the values of its table: the interval is cut where a_v passes one.
void SlipMotion::cross(double start, double dt, const Line& a_h, const Line& a_v)
{
    const OpeningUplift* opening = stage().block.opening.get();
    for (double from = 0.0; from < 1.0 && !unresolved_;) {
        const double to = opening ? opening->next_bend(a_v, from) : 1.0;
        const Line h = part(a_h, from, to), v = part(a_v, from, to);
        if (slow_water())
            cross_wet(start + from * dt, (to - from) * dt, h, v);
        else
            cross_part(start + from * dt, (to - from) * dt, h, v);
        from = to;
    }
}

/// @param up_to_change  only to the first start, stop or change of contact or stage; span_ is what is left
/// @param goes_on  from such a change: the contact is what it left
void SlipMotion::cross_part(double start, double dt, const Line& a_h, const Line& a_v, bool up_to_change, bool goes_on)
{
    time_ = start;
    span_ = dt;
    a_h_ = a_h;
    a_v_ = a_v;
    read_opening();
    if (!goes_on) settle_contact();
    const long before = changes_;
    for (int events = 0; span_ > 0.0 && !(up_to_change && changes_ != before); ++events) {
        if (events >= events_per_interval(stage())) {
            unresolved_ = true;
            return;
        }
        if (!moving_)
            wait();
        else if (!anchors_.empty())
            move_anchored();
        else if (touching_ && stage().rate.active())
            move_rated();
        else if (touching_ && stage().friction_slope != 0.0)
            move_sloped();
        else
            move();
    }
}

/// N' of the block sliding without resistance; at rest its uplift is the static one.
Line SlipMotion::free_normal() const
{
    const Line normal = line(forms().free_normal);
    return moving_ ? less_opening(normal, direction_) : normal;
}

/// Contact or not, from the sign of N' just after now. A block at rest touches when it presses its base as it lies;
/// where a retained cohesion holds it, also when it would press its base once it moved (inclined base with added mass
/// only: elsewhere both forces are one).
void SlipMotion::settle_contact()
{
    if (airborne_) return;
    const Line sliding = free_normal();
    const bool was_touching = touching_;
    touching_ = moving_ ? above_zero(sliding)
                        : above_zero(line(forms().equations.normal)) || (bond_stays() && above_zero(sliding));
    if (was_touching != touching_) ++changes_;
    if (was_touching && !touching_) ++slid_.lift_offs;
    if (options_.lift_off == LiftOff::ballistic && !touching_ && above_zero(-sliding)) airborne_ = true;
}

/// Cohesion that slip would not take away.
bool SlipMotion::bond_stays() const
{
    return stage().block.cohesion_force > 0.0 && next_stage_path() > path_;
}

double SlipMotion::time_of_contact_change() const
{
    if (airborne_) {
        Line accel = line(forms().gap_accel);
        if (gap_ == 0.0 && gap_rate_ == 0.0) accel.now = std::max(accel.now, 0.0); // take-off just located
        const std::array<double, 4> gap{gap_, gap_rate_, accel.now / 2.0, (accel.end - accel.now) / (6.0 * span_)};
        return first_fall_to_zero(gap, span_);
    }
    // The state says on which side of zero N' is now, whatever round-off says just after an event.
    const auto change = [this](Line normal) {
        if (touching_) normal = -normal;
        normal.now = std::min(normal.now, 0.0);
        return time_above_zero(normal, span_);
    };
    if (moving_) return change(free_normal());
    const double at_rest = change(line(forms().equations.normal));
    if (!bond_stays()) return at_rest;
    const double sliding = change(free_normal());
    return touching_ ? std::max(at_rest, sliding) : std::min(at_rest, sliding);
}

void SlipMotion::turn_contact()
{
    ++changes_;
    if (airborne_) {
        land();
        return;
    }
    touching_ = !touching_;
    if (touching_) return;
    ++slid_.lift_offs;
    // At rest on an inclined base with added mass N' = 0 need not be where a sliding block leaves its base.
    const bool leaves = moving_ || forms().equations.mass_tn == 0.0 || above_zero(-line(forms().free_normal));
    airborne_ = leaves && options_.lift_off == LiftOff::ballistic;
}

/// Landing: of the gap rate its restitution is left, A (ds, (1 + e) |y'|) = (-I, J) with Coulomb's |I| <= mu J against the
/// slip. What leaves a level base by impulses J >= 0, |I| <= mu J gains no energy: J does -(1 - e) J |y'|/2 of work, I some
/// against the slip.
void SlipMotion::land()
{
    const BaseEquations& e = forms().equations;
    const double d = sign(direction_), impact = -gap_rate_, before = kinetic_energy();
    const double left = rebound(impact);
    ++landings_;
    last_landing_ = time_;
    gap_ = 0.0;
    gap_rate_ = left;
    airborne_ = left > 0.0;
    if (moving_) {
        const double push = (d * e.mass_tn + friction() * e.mass_nn) / sliding_mass(e, friction(), direction_);
        rate_ -= (impact + left) * push;
        if (rate_ <= 0.0) stop();
    }
    impact_loss_ += before - kinetic_energy();
    settle_contact();
}

/// Gap rate after a landing with the rate `impact`; 0: it stays. Flights get shorter as eⁿ: one that would last no time to
/// speak of is the last.
double SlipMotion::rebound(double impact) const
{
    const double left = stage().restitution * impact, fall = -line(forms().gap_accel).now;
    return 2.0 * left > shortest_flight * std::max(fall, 0.0) ? left : 0.0;
}

double SlipMotion::kinetic_energy() const
{
    const BaseEquations& e = forms().equations;
    const double s = sign(direction_) * rate();
    return 0.5 * (e.mass_tt * s * s + e.mass_nn * gap_rate_ * gap_rate_) + e.mass_tn * s * gap_rate_;
}

/// mu of this instant.
double SlipMotion::friction() const
{
    const double peak = friction_at(stage(), path_);
    const RateFriction& law = stage().rate;
    return !law.active() ? peak : peak * (lags(law) ? ratio_ : steady_ratio(law, rate()));
}

/// In a direction of slip that the block has, or is about to have.
RatedSlip SlipMotion::rated(SlipDirection towards) const
{
    const BaseEquations& e = forms().equations;
    const double direction = sign(towards);
    return {.law = stage().rate,
            .mass_tt = e.mass_tt,
            .mass_tn = direction * e.mass_tn,
            .cohesion = stage().block.cohesion_force,
            .friction = friction_at(stage(), path_),
            .slope = stage().friction_slope,
            .ratio = ratio_,
            .rate = rate_,
            .drive = combine(direction, line(e.drive), 0.0, {}),
            .normal = less_opening(line(e.normal), towards),
            .span = span_,
            .moves = moving_,
            .from_rest = from_rest_};
}

/// The block rests: follow the drive until it exceeds the resistance in one of the directions, or the contact changes.
void SlipMotion::wait()
{
    if (touching_ && lags(stage().rate)) return wait_lagging();
    const StageForms& f = forms();
    const Line drive = line(airborne_ ? f.flight_accel : f.equations.drive);
    const Line normal = line(f.equations.normal);
    const auto resistance = [&](SlipDirection direction) {
        Line sum;
        if (!touching_) return sum;
        const Line pressed = less_opening(normal, direction);
        sum = combine(friction(), pressed, 0.0, pressed);
        sum.now += stage().block.cohesion_force + stage().block.dowel_force;
        sum.end += stage().block.cohesion_force + stage().block.dowel_force;
        return sum;
    };
    const double h_down = time_above_zero(combine(1.0, drive, -1.0, resistance(SlipDirection::downstream)), span_);
    const double h_up = options_.two_way
                            ? time_above_zero(combine(-1.0, drive, -1.0, resistance(SlipDirection::upstream)), span_)
                            : never;
    const double h_contact = time_of_contact_change();
    const double h = std::min({h_down, h_up, h_contact});
    elapse(std::min(h, span_));
    if (h == never) return;
    if (h == h_down)
        start(SlipDirection::downstream);
    else if (h == h_up)
        start(SlipDirection::upstream);
    else
        turn_contact();
}

/// The same while friction goes back to its value at rest.
void SlipMotion::wait_lagging()
{
    const RatedStep step(rated(SlipDirection::downstream));
    const double h_down = step.time_of_start(1.0);
    const double h_up = options_.two_way ? RatedStep(rated(SlipDirection::upstream)).time_of_start(1.0) : never;
    const double h_contact = time_of_contact_change();
    const double h = std::min({h_down, h_up, h_contact, step.length()});
    ratio_ = step.ratio(h);
    if (stage().rate.relaxation_time && std::abs(ratio_ - 1.0) < 1e-14) ratio_ = 1.0;
    elapse(h);
    if (h == h_down)
        start(SlipDirection::downstream);
    else if (h == h_up)
        start(SlipDirection::upstream);
    else if (h == h_contact)
        turn_contact();
}

void SlipMotion::start(SlipDirection direction)
{
    ++changes_;
    moving_ = true;
    from_rest_ = true;
    direction_ = direction;
    rate_ = 0.0;
    slid_.begin(time_, path_);
    const bool changed = enter_stages();
    if (changed) from_rest_ = false;
    // Off the horizontal N' of the moving block is another one than that of the block at rest.
    if (changed || forms().equations.mass_tn != 0.0 || stage().block.opening) settle_contact();
}

void SlipMotion::stop()
{
    ++changes_;
    moving_ = false;
    from_rest_ = false;
    rate_ = 0.0;
    slid_.end(time_, path_);
    if (forms().equations.mass_tn != 0.0 || stage().block.opening) settle_contact();
}

bool SlipMotion::enter_stages()
{
    const std::size_t before = stage_;
    while (stage_ + 1 < stages_.size() && stages_[stage_ + 1].from_slip <= path_) ++stage_;
    if (stage_ != before) {
        ++changes_;
        read_opening();
    }
    return stage_ != before;
}

double SlipMotion::next_stage_path() const
{
    return stage_ + 1 < stages_.size() ? stages_[stage_ + 1].from_slip : never;
}

/// s'' in the direction of slip.
Line SlipMotion::slip_accel() const
{
    const StageForms& f = forms();
    const double d = sign(direction_);
    if (airborne_) return combine(d, line(f.flight_accel), 0.0, {});
    const Line drive = line(f.equations.drive);
    if (!touching_) return combine(d / f.equations.mass_tt, drive, 0.0, {});
    const bool downstream = direction_ == SlipDirection::downstream;
    const double mass = downstream ? f.mass_downstream : f.mass_upstream;
    Line accel = line(downstream ? f.excess_downstream : f.excess_upstream);
    if (stage().block.opening) {
        const Line change = less_opening({}, direction_);
        accel = combine(1.0, accel, -stage().block.friction, change);
    }
    return {accel.now / mass, accel.end / mass};
}

/// Time within h at which the path of the next stage is reached; `never`.
double SlipMotion::time_of_stage(double h, const Line& accel) const
{
    const double target = next_stage_path() - path_;
    const auto missing = [&](double x) {
        return x * (rate_ + x * (2.0 * accel.now + accel.at(x / span_)) / 6.0) - target;
    };
    if (missing(h) < 0.0) return never;
    return bracketed_root(missing, 0.0, h);
}

/// Constant friction or no contact: the rate is quadratic and the path cubic up to the next event.
void SlipMotion::move()
{
    Line accel = slip_accel();
    if (from_rest_) accel.now = std::max(accel.now, 0.0);
    const double jerk = (accel.end - accel.now) / span_;
    const double h_stop = time_of_stop(rate_, accel.now, jerk);
    const double h_contact = time_of_contact_change();
    double h = std::min({h_stop, h_contact, span_});
    const double h_stage = next_stage_path() == never ? never : time_of_stage(h, accel);
    h = std::min(h, h_stage);

    const double accel_then = h == span_ ? accel.end : accel.at(h / span_);
    if (accel.now > 0.0 && accel_then < 0.0)
        slid_.peak_rate = std::max(slid_.peak_rate, rate_ - accel.now * accel.now / (2.0 * jerk));
    add_slip(h * (rate_ + h * (2.0 * accel.now + accel_then) / 6.0));
    rate_ = std::max(0.0, rate_ + 0.5 * h * (accel.now + accel_then));
    slid_.peak_rate = std::max(slid_.peak_rate, rate_);
    from_rest_ = from_rest_ && h == 0.0;
    elapse(h);
    meet(h, h_stage, h_stop, h_contact);
}

/// The way of a step up to time h, where its rate is largest inside it, too.
template <class Step>
void SlipMotion::go_along(const Step& step, double h)
{
    if (step.accel(0.0) > 0.0 && step.accel(h) < 0.0)
        slid_.peak_rate =
            std::max(slid_.peak_rate, step.rate(bracketed_root([&](double x) { return step.accel(x); }, 0.0, h)));
    add_slip(step.path(h));
    rate_ = std::max(0.0, step.rate(h));
    slid_.peak_rate = std::max(slid_.peak_rate, rate_);
    from_rest_ = from_rest_ && h == 0.0;
}

/// Friction linear in the path slipped.
void SlipMotion::move_sloped()
{
    const BaseEquations& e = forms().equations;
    const double d = sign(direction_);
    const SlopedStep step(SlopedSlip{e.mass_tt, d * e.mass_tn, stage().block.cohesion_force, friction(),
                                     stage().friction_slope, rate_, combine(d, line(e.drive), 0.0, {}),
                                     less_opening(line(e.normal), direction_), span_, from_rest_});
    used_series_ = used_series_ || !step.closed_form();
    const double h_stop = step.time_of_stop();
    const double h_contact = time_of_contact_change();
    double h = std::min({h_stop, h_contact, step.length()});
    const double target = next_stage_path() - path_;
    const double h_stage = step.path(h) >= target ? step.time_of_path(target, h) : never;
    h = std::min(h, h_stage);

    go_along(step, h);
    elapse(h);
    meet(h, h_stage, h_stop, h_contact);
}

/// With anchors, whatever the friction, in contact or without resistance.
void SlipMotion::move_anchored()
{
    const BaseEquations& e = unanchored_forms_[stage_].equations;
    const double d = sign(direction_);
    AnchoredSlip slip;
    slip.slip = {e.mass_tt,
                 d * e.mass_tn,
                 stage().block.cohesion_force,
                 friction(),
                 stage().friction_slope,
                 rate_,
                 combine(d, line(e.drive), 0.0, {}),
                 less_opening(line(e.normal), direction_),
                 span_,
                 from_rest_};
    slip.direction = d;
    slip.slip_now = this->slip();
    slip.touching = touching_;
    double to_change = never;
    std::vector<double> changes;
    for (BlockAnchor& anchor : anchors_) {
        slip.initial_tangential += anchor.bar.prestress * anchor.bar.sine;
        slip.initial_normal += anchor.bar.prestress * anchor.bar.cosine;
        anchor.face(d, slip.slip_now);
        changes.push_back(anchor.next_change(d, slip.slip_now));
        to_change = std::min(to_change, changes.back());
    }
    const AnchoredStep step(slip, anchors_);
    used_series_ = true;
    const double h_stop = step.time_of_stop();
    const double h_contact = step.time_of_contact_change();
    double h = std::min({h_stop, h_contact, step.length()});
    const double to_stage = next_stage_path() - path_, nearest = std::min(to_stage, to_change);
    const double h_path = step.path(h) >= nearest ? step.time_of_path(nearest, h) : never;
    h = std::min(h, h_path);
    const double h_stage = nearest == to_stage ? h_path : never;

    go_along(step, h);
    for (std::size_t k = 0; k < anchors_.size(); ++k) {
        anchors_[k].history.plastic_work += step.dowel_work(k, h);
        if (h == h_path && changes[k] == nearest)
            anchors_[k].change(this->slip(), time_ + h);
        else
            anchors_[k].go_to(this->slip());
    }
    hold_anchors();
    elapse(h);
    meet(h, h_stage, h_stop, h_contact);
    // A force that is gone all at once may leave the base open or the block at rest.
    if (h == h_path && h_stage == never) settle_contact();
}

/// The stages with the anchors' forces at the slip so far.
void SlipMotion::hold_anchors()
{
    double tangential = 0.0, normal = 0.0, dowel = 0.0;
    for (const BlockAnchor& anchor : anchors_) {
        tangential += anchor.tangential(slip()) - anchor.bar.prestress * anchor.bar.sine;
        normal += anchor.normal(slip()) - anchor.bar.prestress * anchor.bar.cosine;
        dowel += anchor.dowel();
    }
    for (std::size_t i = 0; i < anchored_.size(); ++i) {
        RigidBlock& block = anchored_[i].block;
        const RigidBlock& before = stages_[i].block;
        const double c = std::cos(block.base_inclination), s = std::sin(block.base_inclination);
        // On the block -tangential along t = (c, -s) and -normal along n = (s, c).
        block.horizontal_force = before.horizontal_force - tangential * c - normal * s;
        block.vertical_force = before.vertical_force - tangential * s + normal * c;
        block.dowel_force = dowel;
        forms_[i] = forms_of(block);
    }
}

/// Friction over the rate.
void SlipMotion::move_rated()
{
    const RatedStep step(rated(direction_));
    used_series_ = true;
    const double h_stop = step.time_of_stop();
    const double h_contact = time_of_contact_change();
    double h = std::min({h_stop, h_contact, step.length()});
    const double target = next_stage_path() - path_;
    const double h_stage = step.path(h) >= target ? step.time_of_path(target, h) : never;
    h = std::min(h, h_stage);

    go_along(step, h);
    ratio_ = step.ratio(h);
    elapse(h);
    meet(h, h_stage, h_stop, h_contact);
}

/// The event reached at time h, if any.
void SlipMotion::meet(double h, double h_stage, double h_stop, double h_contact)
{
    if (h == h_stage) {
        path_ = next_stage_path();
        enter_stages();
        settle_contact();
    } else if (h == h_stop) {
        stop();
    } else if (h == h_contact) {
        turn_contact();
    }
}

void SlipMotion::add_slip(double path)
{
    path = std::max(path, 0.0);
    path_ += path;
    (direction_ == SlipDirection::downstream ? slid_.downstream : slid_.upstream) += path;
    slid_.largest = std::max(slid_.largest, std::abs(slid_.downstream - slid_.upstream));
}

/// Time passes; the gap moves on, the ground lines are cut to the rest of the interval.
void SlipMotion::elapse(double h)
{
    if (airborne_) {
        Line accel = line(forms().gap_accel);
        if (gap_ == 0.0 && gap_rate_ == 0.0) accel.now = std::max(accel.now, 0.0);
        const double then = accel.at(h / span_);
        const double rate_then = gap_rate_ + 0.5 * h * (accel.now + then);
        if (gap_rate_ > 0.0 && rate_then < 0.0) {
            const double jerk = (accel.end - accel.now) / span_;
            const double top = time_of_stop(gap_rate_, accel.now, jerk);
            max_gap_ = std::max(max_gap_, gap_ + top * (gap_rate_ + top * (accel.now / 2.0 + top * jerk / 6.0)));
        }
        gap_ = std::max(0.0, gap_ + h * (gap_rate_ + h * (2.0 * accel.now + then) / 6.0));
        gap_rate_ = rate_then;
        max_gap_ = std::max(max_gap_, gap_);
    }
    time_ += h;
    if (h >= span_) {
        span_ = 0.0;
        a_h_.now = a_h_.end;
        a_v_.now = a_v_.end;
        opening_down_.now = opening_down_.end;
        opening_up_.now = opening_up_.end;
        wet_down_.now = wet_down_.end;
        wet_up_.now = wet_up_.end;
        return;
    }
    a_h_.now = a_h_.at(h / span_);
    a_v_.now = a_v_.at(h / span_);
    opening_down_.now = opening_down_.at(h / span_);
    opening_up_.now = opening_up_.at(h / span_);
    wet_down_.now = wet_down_.at(h / span_);
    wet_up_.now = wet_up_.at(h / span_);
    span_ -= h;
}

} // namespace damslip::sliding
