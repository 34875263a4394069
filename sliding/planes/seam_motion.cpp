#include "sliding/planes/seam_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace damslip::sliding {

namespace {

/// A chain while it moves one way, with its equation of motion.
struct MovingChain {
    Chain chain;
    ChainLaw law;
    double per_a_h = 0.0, per_a_v = 0.0, constant = -1e9; ///< of the acceleration of the slip; locked: it never moves

    MovingChain(const Chain& given) : chain(given), law(chain_law(given))
    {
        if (law.locked) return;
        per_a_h = law.drive / law.mass;
        per_a_v = law.per_a_v / law.mass;
        constant = law.constant / law.mass;
    }

    /// Acceleration of the slip, linear in that of the ground.
    Line acceleration(const Line& a_h, const Line& a_v) const
    {
        const Line driven = combine(per_a_h, a_h, per_a_v, a_v);
        return {driven.now + constant, driven.end + constant};
    }
    /// Least and largest of it over a range of the ground's acceleration, round-off apart.
    Line acceleration(const AccelRange& range) const
    {
        const double h[]{per_a_h * range.h_min, per_a_h * range.h_max}, v[]{per_a_v * range.v_min, per_a_v * range.v_max};
        const double margin = 1e-12 * (std::abs(h[0]) + std::abs(h[1]) + std::abs(v[0]) + std::abs(v[1]) + std::abs(constant));
        return {std::min(h[0], h[1]) + std::min(v[0], v[1]) + constant - margin,
                std::max(h[0], h[1]) + std::max(v[0], v[1]) + constant + margin};
    }
    Point velocity(std::size_t i) const ///< of a block, per rate of the slip
    {
        const ChainBlock& b = chain.blocks[i];
        const double angle = b.dip - b.dilation;
        return {law.rates[i] * std::cos(angle), -law.rates[i] * std::sin(angle)};
    }
    double kinetic(double rate) const
    {
        double sum = 0.0;
        for (std::size_t i = 0; i < chain.blocks.size(); ++i) {
            const Point v = velocity(i);
            const AddedMassTensor& w = chain.blocks[i].added_mass;
            sum += chain.blocks[i].mass * dot(v, v) + w.xx * v.x * v.x + 2.0 * w.xy * v.x * v.y + w.yy * v.y * v.y;
        }
        return 0.5 * sum * rate * rate;
    }
};

/// Friction the other way round: the equations are those of negative strengths. A block does not ride down on its dilation.
Chain going_upstream(Chain body)
{
    for (ChainBlock& b : body.blocks) {
        b.friction = -b.friction;
        b.cohesion = -b.cohesion;
        b.dilation = 0.0;
    }
    return body;
}

struct MovingStage {
    double from_slip = 0.0;
    MovingChain together, down, up;
};

class SeamRun {
public:
    SeamRun(const std::vector<SeamStage>& stages, const SlideOptions& options, SeamWorks works)
        : two_way_(options.sliding.two_way), books_(works == SeamWorks::booked)
    {
        for (const SeamStage& s : stages) {
            stages_.push_back({s.from_slip, {s.chain}, {s.body}, {going_upstream(s.body)}});
        }
        wedge_ = stages.front().chain.blocks.size() > 1;
        out_.ledger.planes.assign(stages.front().chain.blocks.size(), 0.0);
        out_.ledger.interfaces.assign(stages.front().chain.interfaces.size(), 0.0);
    }

    /// A part of the motion in which the ground's acceleration is linear. @param until_rest  it ends when the body rests
    void pass(const Line& a_h, const Line& a_v, double span, bool until_rest)
    {
        double from = 0.0;
        for (int events = 0; from < span; ++events) {
            if (events > 10000) {
                out_.slide.status = Status::not_resolved;
                return;
            }
            const Line h = damslip::sliding::part(a_h, from / span, 1.0), v = damslip::sliding::part(a_v, from / span, 1.0);
            const double rest = span - from;
            const double length = way_ == 0 ? wait(h, v, rest) : slide(h, v, rest);
            const bool stuck = way_ == 0 && from + length == from; // moved by less than round-off
            from += stuck ? 1e-12 * span : length;
            time_ += length;
            if (way_ == 0 && (until_rest || length >= rest)) break;
        }
    }
    bool at_rest() const { return way_ == 0; }
    /// At rest: nothing in the range moves it.
    bool rests(const AccelRange& range) const
    {
        const MovingStage& s = stage();
        return (touching_ ? s.together : s.down).acceleration(range).end < 0.0 &&
               (!two_way_ || s.up.acceleration(range).now > 0.0);
    }
    void wait(double span) { time_ += span; } ///< at rest
    SeamSlide result()
    {
        stop_counting();
        SlideResult& s = out_.slide;
        if (way_ != 0 && s.status == Status::at_rest) s.status = Status::sliding_at_end;
        s.slip = x_;
        s.end_time = time_;
        s.impact_loss = out_.ledger.impact;
        out_.ledger.kinetic = way_ == 0 ? 0.0 : moving().kinetic(rate_);
        return std::move(out_);
    }

private:
    const MovingStage& stage() const { return stages_[stage_]; }
    const MovingChain& moving() const { return way_ < 0 ? stage().up : touching_ ? stage().together : stage().down; }

    /// At rest: until something moves it. @returns how long
    double wait(const Line& h, const Line& v, double rest)
    {
        const double down = time_above_zero((touching_ ? stage().together : stage().down).acceleration(h, v), rest);
        const double up = two_way_ ? time_above_zero(-stage().up.acceleration(h, v), rest) : never;
        const double start = std::min(down, up);
        if (start == never) return rest;
        way_ = down <= up ? 1 : -1;
        if (way_ < 0) touching_ = false; // the wedge stays
        while (stage_ + 1 < stages_.size() && stages_[stage_ + 1].from_slip <= path_) ++stage_;
        ++out_.slide.phases;
        begun_ = x_;
        if (std::isnan(out_.slide.first_slip_time)) out_.slide.first_slip_time = time_ + start;
        return start;
    }

    /// Sliding: until it stops, the gap closes, or a stage ends. @returns how long
    double slide(const Line& h, const Line& v, double rest)
    {
        Line a = moving().acceleration(h, v);
        if (rate_ == 0.0 && way_ * a.now < 0.0) a.now = 0.0; // it has just begun, at the root of this line
        const double sign = way_, jerk = (a.end - a.now) / rest;
        const double speed = std::abs(rate_);
        double length = std::min(rest, time_of_stop(speed, sign * a.now, sign * jerk));
        const bool stops = length < rest || (speed == 0.0 && length == 0.0);
        int event = stops ? 1 : 0;
        const double furthest = (speed + std::max(std::abs(a.now), std::abs(a.end)) * length) * length;
        const auto reach = [&](double distance, int which) { // of the slip from here
            if (distance > furthest) return;
            const std::array<double, 4> left{distance, -speed, -0.5 * sign * a.now, -sign * jerk / 6.0};
            const double at = first_fall_to_zero(left, length);
            if (at < length) length = at, event = which;
        };
        if (stage_ + 1 < stages_.size()) reach(stages_[stage_ + 1].from_slip - path_, 2);
        if (wedge_ && way_ > 0 && !touching_) reach(contact_ - x_, 3);
        if (books_) book(h, v, a, rest, length);
        const double moved = rate_ * length + (0.5 * a.now + jerk * length / 6.0) * length * length;
        x_ += moved;
        path_ += std::abs(moved);
        rate_ += (a.now + 0.5 * jerk * length) * length;
        if (touching_) contact_ = x_;
        out_.slide.max_slip = std::max(out_.slide.max_slip, std::abs(x_));
        out_.slide.peak_slip_rate = std::max(out_.slide.peak_slip_rate, std::abs(rate_));
        out_.slide.max_gap = std::max(out_.slide.max_gap, contact_ - x_);
        out_.slide.last_slip_time = time_ + length;
        if (books_) out_.ledger.largest = std::max(out_.ledger.largest, moving().kinetic(rate_));
        if (event == 1) {
            stop_counting();
            rate_ = 0.0;
            way_ = 0;
            touching_ = touching_ || x_ >= contact_;
        } else if (event == 2) {
            const double before = moving().kinetic(rate_);
            path_ = stages_[++stage_].from_slip;
            while (stage_ + 1 < stages_.size() && stages_[stage_ + 1].from_slip <= path_) ++stage_;
            out_.ledger.impact += before - moving().kinetic(rate_); // where the dilation ends
        } else if (event == 3) {
            const double before = stage().down.kinetic(rate_);
            x_ = contact_;
            touching_ = true;
            rate_ *= stage().down.law.mass / stage().together.law.mass;
            out_.ledger.impact += before - stage().together.kinetic(rate_);
            ++out_.impacts;
        }
        return length;
    }

    void stop_counting()
    {
        if (way_ == 0) return;
        (way_ > 0 ? out_.slide.downstream_slip : out_.slide.upstream_slip) += std::abs(x_ - begun_);
        begun_ = x_;
    }

    /// Works over a part: forces linear, rates quadratic in time, so that two points of Gauss are exact.
    void book(const Line& h, const Line& v, const Line& a, double rest, double length)
    {
        const MovingChain& m = moving();
        SeamLedger& l = out_.ledger;
        for (const double place : {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)}) {
            const double t = place * length, share = t / rest, a_h = h.at(share), a_v = v.at(share), accel = a.at(share);
            const double rate = rate_ + 0.5 * (a.now + accel) * t, step = 0.5 * length * rate;
            const ChainForces f = chain_forces(m.chain, m.law, a_h, a_v, accel);
            for (std::size_t i = 0; i < m.chain.blocks.size(); ++i) {
                const ChainBlock& b = m.chain.blocks[i];
                const AddedMassTensor& w = b.added_mass;
                const Point u = m.velocity(i), n{std::sin(b.dip), std::cos(b.dip)}, t_i{std::cos(b.dip), -std::sin(b.dip)};
                l.ground -= step * dot(u, {-(b.mass + w.xx) * a_h + w.xy * a_v, -w.xy * a_h + (b.mass + w.yy) * a_v});
                l.weight -= step * u.y * b.mass * m.chain.gravity;
                l.loads += step * dot(u, b.force);
                l.water += step * b.uplift * dot(u, n);
                l.planes[i] += step * (f.normal[i] * dot(u, n) - f.resistance[i] * dot(u, t_i));
                out_.least_pressure = std::min(out_.least_pressure, f.normal[i]);
            }
            for (std::size_t j = 0; j < m.chain.interfaces.size(); ++j) {
                const ChainInterface& face = m.chain.interfaces[j];
                const Point u = m.velocity(j), w = m.velocity(j + 1), apart{w.x - u.x, w.y - u.y};
                const Point e{std::cos(face.angle), std::sin(face.angle)}, out{e.y, -e.x};
                l.water += step * face.water * dot(apart, out);
                l.interfaces[j] += step * (f.thrust[j] * dot(apart, out) - f.shear[j] * dot(apart, e));
                out_.least_pressure = std::min(out_.least_pressure, f.thrust[j]);
            }
        }
    }

    std::vector<MovingStage> stages_;
    bool two_way_, books_, wedge_ = false;
    std::size_t stage_ = 0;
    bool touching_ = true;                ///< the wedge
    int way_ = 0;                         ///< 1 downstream, -1 upstream, 0 at rest
    double x_ = 0.0, rate_ = 0.0;         ///< of the body, downstream
    double path_ = 0.0, contact_ = 0.0;   ///< accumulated slip; place of the body at which it meets the wedge
    double begun_ = 0.0, time_ = 0.0;     ///< place where the movement began
    SeamSlide out_;
};

} // namespace

double SeamLedger::work() const
{
    double sum = ground + weight + loads + water;
    for (const double w : planes) sum += w;
    for (const double w : interfaces) sum += w;
    return sum;
}

Yield yield_upstream_alone(const Chain& body)
{
    const ChainLaw law = chain_law(going_upstream(body));
    if (law.locked || !(law.drive > 0.0)) return {{std::numeric_limits<double>::infinity(), 0.0}, 0.0};
    return {{law.constant / law.drive, law.per_a_v / law.drive}, law.drive / law.mass};
}

SeamSlide slide_seam(const SkippingMotion& skipping, const std::vector<SeamStage>& stages, const SlideOptions& options,
                     SeamWorks works)
{
    const GroundMotion& motion = skipping.motion();
    SeamRun run(stages, options, works);
    const auto at = [&](std::size_t i) { return options.polarity * motion.accel_h[i]; };
    const auto up = [&](std::size_t i) { return motion.accel_v.empty() ? 0.0 : motion.accel_v[i]; };
    const auto rests = [&](AccelRange range) {
        if (options.polarity < 0) range = {-range.h_max, -range.h_min, range.v_min, range.v_max};
        return run.rests(range);
    };
    for (std::size_t i = 0; i < skipping.intervals(); ++i) {
        if (run.at_rest()) {
            const std::size_t next = skipping.skip(i, rests);
            run.wait(static_cast<double>(next - i) * motion.dt);
            if ((i = next) == skipping.intervals()) break;
        }
        run.pass({at(i), at(i + 1)}, {up(i), up(i + 1)}, motion.dt, false);
    }
    if (options.sliding.run_out_max > 0.0) run.pass({}, {}, options.sliding.run_out_max, true);
    return run.result();
}

SeamSlide slide_seam(const GroundMotion& motion, const std::vector<SeamStage>& stages, const SlideOptions& options,
                     SeamWorks works)
{
    return slide_seam(SkippingMotion(motion), stages, options, works);
}

} // namespace damslip::sliding
