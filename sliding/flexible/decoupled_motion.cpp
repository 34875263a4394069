#include "sliding/flexible/decoupled_motion.hpp"

#include "sliding/block/yield.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace damslip::sliding {

namespace {

constexpr double straight = 1e-6;   ///< of |k|: so little bent a piece is a line, events included
constexpr int most_halvings = 24;   ///< where k itself is nothing
constexpr double peak_found = 1e-9; ///< of the peak: so little can still be above it

} // namespace

DecoupledMotion::DecoupledMotion(const SlipStages& stages, const FlexibleBlock& flexible, const SlideOptions& options)
    : flexible_(flexible), omega_(2.0 * std::numbers::pi / flexible.period), mode_(omega_, flexible.damping_ratio, 1.0),
      block_(stages, options), before_(block_)
{
    for (const SlipStage& stage : stages)
        for (const Yield& yield : {yield_downstream(stage.block), yield_upstream(stage.block)}) {
            factor_ = std::max(factor_, yield.factor);
            yield_per_a_v_ = std::max(yield_per_a_v_, std::abs(yield.law.per_a_v));
        }
}

double DecoupledMotion::average_acceleration(double a_h) const
{
    return (1.0 - flexible_.mass_ratio) * a_h + flexible_.mass_ratio * mode_.restoring(state_);
}

/// Bound of |r| from now on, while the ground acceleration stays on its line: r'' + 2 zeta omega r' + omega^2 r = 0, so
/// r^2 + (r'/omega)^2 does not grow.
double DecoupledMotion::vibration(const OscillatorState& state, double a_h, double a_h_rate) const
{
    const double r = mode_.restoring(state) - a_h;
    const double r_rate = omega_ * omega_ * state.v - 2.0 * flexible_.damping_ratio * omega_ * r - a_h_rate;
    return std::hypot(r, r_rate / omega_);
}

DecoupledMotion::Course DecoupledMotion::course_of(const Piece& p) const
{
    const double gamma = flexible_.mass_ratio, turn = omega_ * p.length;
    Course c;
    c.k = {(1.0 - gamma) * p.a_h.now + gamma * mode_.restoring(p.begin),
           (1.0 - gamma) * p.a_h.end + gamma * mode_.restoring(p.end)};
    c.vibration = vibration(p.begin, p.a_h.now, (p.a_h.end - p.a_h.now) / p.length);
    // |r''| <= omega^2 (1 + 2 zeta) |r| of the bound: a chord is off by h^2/8 of it, and never by more than 2 |r|.
    c.bend = gamma * c.vibration * std::min((1.0 + 2.0 * flexible_.damping_ratio) * turn * turn / 8.0, 2.0);
    return c;
}

/// The line whose integral and double integral over the piece are those of k = a_h - Gamma x''.
Line DecoupledMotion::line_of(const Piece& p, const Course& c) const
{
    const double h = p.length, gamma = flexible_.mass_ratio;
    const double mean = 0.5 * (p.a_h.now + p.a_h.end) - gamma * (p.end.v - p.begin.v) / h;
    // First moment about the middle: Gamma (x1 - x0 - h (v0 + v1)/2) besides that of a_h. In very short pieces the
    // difference is round-off, and the chord's rise the same but for (omega h)^2/10.
    double rise = c.k.end - c.k.now;
    if (omega_ * h > 1e-3)
        rise = p.a_h.end - p.a_h.now + 12.0 * gamma * (p.end.x - p.begin.x - 0.5 * h * (p.begin.v + p.end.v)) / (h * h);
    return {mean - 0.5 * rise, mean + 0.5 * rise};
}

bool DecoupledMotion::halve_again(const Piece& p, const Course& c) const
{
    return p.halvings < most_halvings && c.bend > straight * std::max(std::abs(c.k.now), std::abs(c.k.end));
}

bool DecoupledMotion::rests_through(const Piece& p, const Course& c) const
{
    const auto [k_min, k_max] = std::minmax(c.k.now, c.k.end);
    const auto [v_min, v_max] = std::minmax(p.a_v.now, p.a_v.end);
    return block_.stays_at_rest(k_min - c.bend, k_max + c.bend, v_min, v_max);
}

/// Could the rate of a moving block touch zero within a piece in which the line saw no stop? Under the line it lies above
/// its lower end less h^2/8 of its largest bow; under k it is off by what r and its line can bring apart.
bool DecoupledMotion::may_stop_unseen(const Piece& p, const Course& c, const Line& line, double lowest_rate) const
{
    const double bow = std::abs(line.end - line.now) + yield_per_a_v_ * std::abs(p.a_v.end - p.a_v.now);
    const double apart = std::min(c.bend * p.length, 8.0 * flexible_.mass_ratio * c.vibration / omega_);
    return lowest_rate < factor_ * (0.125 * p.length * bow + apart);
}

void DecoupledMotion::cross(double start, double dt, const Line& a_h, const Line& a_v)
{
    const double slope = (a_h.end - a_h.now) / dt;
    const Piece whole{start, dt, a_h, a_v, state_, mode_.after(state_, a_h.now, slope, dt), 0};
    take(whole);
    look_for_peak(whole);
    state_ = whole.end;
}

void DecoupledMotion::take(const Piece& p)
{
    const Course c = course_of(p);
    if (block_.unresolved() || rests_through(p, c)) return;
    const Line line = line_of(p, c);
    if (!halve_again(p, c)) {
        block_.cross(p.start, p.length, line, p.a_v);
        return;
    }
    if (block_.on_base() && may_stop_unseen(p, c, line, block_.rate())) { // at rest too
        take_halves(p);
        return;
    }
    before_ = block_;
    block_.cross(p.start, p.length, line, p.a_v);
    const bool eventful = block_.changes() != before_.changes();
    const bool faster_between = block_.peak_rate() > std::max({before_.peak_rate(), before_.rate(), block_.rate()});
    if (eventful || faster_between || (block_.moving() && may_stop_unseen(p, c, line, block_.rate()))) {
        block_ = before_;
        take_halves(p);
    }
}

std::pair<DecoupledMotion::Piece, DecoupledMotion::Piece> DecoupledMotion::halves_of(const Piece& p) const
{
    const double h = 0.5 * p.length, slope = (p.a_h.end - p.a_h.now) / p.length;
    const double a_h = p.a_h.at(0.5), a_v = p.a_v.at(0.5);
    const OscillatorState middle = mode_.after(p.begin, p.a_h.now, slope, h);
    return {{p.start, h, {p.a_h.now, a_h}, {p.a_v.now, a_v}, p.begin, middle, p.halvings + 1},
            {p.start + h, h, {a_h, p.a_h.end}, {a_v, p.a_v.end}, middle, p.end, p.halvings + 1}};
}

void DecoupledMotion::take_halves(const Piece& p)
{
    const auto [first, second] = halves_of(p);
    take(first);
    take(second);
}

/// Branch and bound: only pieces that can exceed the peak so far are looked into.
void DecoupledMotion::look_for_peak(const Piece& p)
{
    const Course c = course_of(p);
    const double at_ends = std::max(std::abs(c.k.now), std::abs(c.k.end));
    peak_acceleration_ = std::max(peak_acceleration_, at_ends);
    if (p.halvings == most_halvings || at_ends + c.bend <= (1.0 + peak_found) * peak_acceleration_) return;
    const auto [first, second] = halves_of(p);
    look_for_peak(first);
    look_for_peak(second);
}

bool DecoupledMotion::at_rest_for_good() const
{
    const double k = flexible_.mass_ratio * vibration(state_, 0.0, 0.0);
    return block_.at_rest() && block_.stays_at_rest(-k, k, 0.0, 0.0);
}

} // namespace damslip::sliding
