#include "sliding/planes/seam_motion.hpp"

#include "sliding/block/slip_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace damslip::sliding {

namespace {

/// Of an acceleration, or of a difference of two, over both components of the ground's.
struct Form {
    double per_a_h = 0.0, per_a_v = 0.0, constant = 0.0;

    double at(double a_h, double a_v) const { return per_a_h * a_h + per_a_v * a_v + constant; }
    double largest(const AccelRange& range) const
    {
        return std::max(per_a_h * range.h_min, per_a_h * range.h_max) + std::max(per_a_v * range.v_min, per_a_v * range.v_max) +
               constant;
    }
    /// At some sample, or with the ground at rest: it is linear between samples.
    bool rises_above_zero(const SkippingMotion& skipping, int polarity) const
    {
        const GroundMotion& motion = skipping.motion();
        if (constant > 0.0) return true;
        if (largest(turned(skipping.whole(), polarity)) <= 0.0) return false;
        const auto below = [&](const AccelRange& range) { return largest(turned(range, polarity)) <= 0.0; };
        for (std::size_t i = 0; i < skipping.intervals(); ++i) {
            if ((i = skipping.skip(i, below)) == skipping.intervals()) break;
            for (const std::size_t k : {i, i + 1})
                if (at(polarity * motion.accel_h[k], motion.accel_v.empty() ? 0.0 : motion.accel_v[k]) > 0.0) return true;
        }
        return false;
    }
};

/// A chain while it moves one way, with its equation of motion.
struct MovingChain {
    Chain chain;
    ChainLaw law;
    double per_a_h = 0.0, per_a_v = 0.0, constant = 0.0; ///< of the acceleration of the slip

    /// @param locked  the acceleration of a locked chain: it never moves
    MovingChain(const Chain& given, double locked = -1e9) : chain(given), law(chain_law(given)), constant(locked)
    {
        if (law.locked || !(law.drive > 0.0)) return;
        per_a_h = law.drive / law.mass;
        per_a_v = law.per_a_v / law.mass;
        constant = law.constant / law.mass;
    }

    Form form() const { return {per_a_h, per_a_v, constant}; } ///< of the acceleration of the slip

    /// In terms of another slip. @param rate  of this chain's over that one
    void count_by(double rate)
    {
        for (double& q : law.rates) q *= rate;
        for (double* c : {&per_a_h, &per_a_v, &constant}) *c /= rate;
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

bool has_wedge(const SeamStage& stage)
{
    return stage.chain.blocks.size() > stage.body.blocks.size();
}

/// The blocks of the body with the water of the face before them, and the wedge with that behind it. @pre has_wedge()
std::pair<Chain, Chain> parted(const SeamStage& stage)
{
    const auto count = static_cast<std::ptrdiff_t>(stage.body.blocks.size());
    Chain body = stage.chain, wedge = stage.chain;
    body.blocks.erase(body.blocks.begin() + count, body.blocks.end());
    body.interfaces.erase(body.interfaces.begin() + count - 1, body.interfaces.end());
    wedge.blocks.erase(wedge.blocks.begin(), wedge.blocks.begin() + count);
    wedge.interfaces.erase(wedge.interfaces.begin(), wedge.interfaces.begin() + count);
    wedge.dam = 0;
    const ChainInterface& face = stage.chain.interfaces[body.interfaces.size()];
    const Point push{face.water * std::sin(face.angle), -face.water * std::cos(face.angle)};
    body.blocks.back().force = {body.blocks.back().force.x - push.x, body.blocks.back().force.y - push.y};
    wedge.blocks[0].force = {wedge.blocks[0].force.x + push.x, wedge.blocks[0].force.y + push.y};
    return {body, wedge};
}

struct MovingStage {
    double from_slip = 0.0;
    MovingChain together, down, up;
    /// The body behind a wedge that has run ahead, and that wedge, by the slip of the body; none: the wedge may not.
    std::optional<MovingChain> behind, wedge;
    Form of_wedge, gain;                      ///< its acceleration; what it has more than the body behind it
    bool cohesive = false;                    ///< the face between them
    double growth = 0.0;                      ///< κ H/M*

    MovingStage(const SeamStage& s)
        : from_slip(s.from_slip), together(s.chain), down(s.body), up(going_upstream(s.body), 1e9),
          growth(s.growth * together.law.factor())
    {
        if (!s.parts || !has_wedge(s)) return;
        const auto [body, alone] = parted(s);
        behind.emplace(body);
        wedge.emplace(alone);
        wedge->count_by(together.law.rates[s.body.blocks.size()]);
        cohesive = s.chain.interfaces[s.body.blocks.size() - 1].cohesion > 0.0;
        of_wedge = wedge->form();
        gain = {wedge->per_a_h - behind->per_a_h, wedge->per_a_v - behind->per_a_v, wedge->constant - behind->constant};
    }

    bool may_run_ahead(const SkippingMotion& motion, int polarity) const
    {
        return wedge && (of_wedge.rises_above_zero(motion, polarity) || gain.rises_above_zero(motion, polarity));
    }
};

class SeamRun {
public:
    SeamRun(const std::vector<SeamStage>& stages, const SlideOptions& options, SeamWorks works, const SkippingMotion& motion)
        : stages_(stages.begin(), stages.end()), two_way_(options.sliding.two_way), books_(works == SeamWorks::booked),
          has_wedge_(has_wedge(stages.front())), gravity_(stages.front().chain.gravity)
    {
        for (const MovingStage& s : stages_) {
            runs_ahead_ = runs_ahead_ || s.may_run_ahead(motion, options.polarity);
            grows_ = grows_ || s.growth != 0.0;
        }
        out_.body_blocks = stages.front().body.blocks.size();
        out_.ledger.planes.assign(stages.front().chain.blocks.size(), 0.0);
        out_.ledger.interfaces.assign(stages.front().chain.interfaces.size(), 0.0);
    }

    /// A part of the motion in which the ground's acceleration is linear. @param until_rest  it ends when all rests
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
            const double length = at_rest() ? wait(h, v, rest) : slide(h, v, rest);
            const bool stuck = at_rest() && from + length == from; // moved by less than round-off
            from += stuck ? 1e-12 * span : length;
            time_ += length;
            if (at_rest() && (until_rest || length >= rest)) break;
        }
    }
    /// Passes the intervals in which the body surely goes on sliding and nothing else happens: the bits of pass(), sooner.
    /// @returns the first interval that needs pass()
    template <class AccelH, class AccelV>
    std::size_t slide_on(const AccelH& a_h, const AccelV& a_v, double dt, std::size_t k, std::size_t last)
    {
        if (books_ || grows_ || ahead_ || way_ == 0) return k;
        constexpr double margin = 1e-9; // of the rate, for the round-off of a stop that falls on the end
        const MovingChain& m = moving();
        const double per_a_h = m.per_a_h, per_a_v = m.per_a_v, constant = m.constant, way = way_,
                     stage_end = stage_ + 1 < stages_.size() ? stages_[stage_ + 1].from_slip : never,
                     meets = has_wedge_ && way_ > 0 && !touching_ ? contact_ : never;
        const bool ends_somewhere = stage_end != never || meets != never, may_loosen = runs_ahead_;
        double x = x_, rate = rate_, path = path_, time = time_, fastest = out_.slide.peak_slip_rate, x_first = x;
        const std::size_t first = k;
        const Form& loosens = together() ? stage().gain : stage().of_wedge; // above zero: the wedge may move by itself
        double end = (per_a_h * a_h(k) + per_a_v * a_v(k)) + constant;
        for (; k < last; ++k) {
            const double now = end;
            end = (per_a_h * a_h(k + 1) + per_a_v * a_v(k + 1)) + constant;
            const double speed = std::abs(rate), slower = std::min(way * now, way * end);
            if (!((1.0 - margin) * speed + slower * dt > 0.0)) break;
            if (may_loosen && std::max(loosens.at(a_h(k), a_v(k)), loosens.at(a_h(k + 1), a_v(k + 1))) > 0.0) break;
            if (ends_somewhere) {
                const double furthest = (speed + std::max(std::abs(now), std::abs(end)) * dt) * dt;
                if (stage_end - path <= furthest || meets - x <= furthest) break;
            }
            const double jerk = (end - now) / dt, moved = rate * dt + (0.5 * now + jerk * dt / 6.0) * dt * dt;
            x += moved;
            path += std::abs(moved);
            rate += (now + 0.5 * jerk * dt) * dt;
            fastest = std::max(fastest, std::abs(rate));
            time += dt;
            if (k == first) x_first = x;
        }
        if (k == first) return k;
        for (const double place : {x_first, x}) see(place); // the body goes one way: slip and gap are largest at one of the two
        x_ = x, rate_ = rate, path_ = path;
        if (touching_) contact_ = x;
        out_.slide.peak_slip_rate = fastest;
        out_.slide.last_slip_time = time_ = time;
        return k;
    }
    /// The same of a body at rest, up to the next block of intervals that may be skipped.
    template <class AccelH, class AccelV>
    std::size_t rest_on(const AccelH& a_h, const AccelV& a_v, double dt, std::size_t k, std::size_t last)
    {
        const Form down = going_down().form(), up = stage().up.form(), wedge = stage().of_wedge;
        const auto moves = [&](std::size_t i) {
            const double h = a_h(i), v = a_v(i);
            return down.at(h, v) > 0.0 || (two_way_ && up.at(h, v) < 0.0) || (runs_ahead_ && wedge.at(h, v) > 0.0);
        };
        if (grows_ || moves(k)) return k;
        do {
            if (moves(k + 1)) return k;
            time_ += dt;
        } while (++k < last && k % SkippingMotion::block != 0);
        return k;
    }
    bool at_rest() const { return way_ == 0 && !ahead_; }
    /// At rest: nothing in the range moves it.
    bool rests(const AccelRange& range) const
    {
        const MovingStage& s = stage();
        double down = going_down().acceleration(range).end;
        if (grows_ && touching_) down -= std::min(held(range.v_min), held(range.v_max));
        return down < 0.0 && (!two_way_ || s.up.acceleration(range).now > 0.0) &&
               (!runs_ahead_ || s.wedge->acceleration(range).end < 0.0);
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
        out_.ledger.kinetic = kinetic();
        return std::move(out_);
    }

private:
    void see(double x) ///< a place of the body
    {
        out_.slide.max_slip = std::max(out_.slide.max_slip, std::abs(x));
        if (!touching_) out_.slide.max_gap = std::max(out_.slide.max_gap, contact_ - x);
    }
    enum class Event { none, starts, stops, stage, meets, parts, wedge_starts, wedge_stops };

    const MovingStage& stage() const { return stages_[stage_]; }
    const MovingChain& going_down() const { return touching_ ? stage().together : wide_ ? stage().down : *stage().behind; }
    const MovingChain& moving() const { return way_ < 0 ? stage().up : going_down(); }
    bool together() const { return touching_ && way_ > 0; }
    double kinetic() const
    {
        return (way_ == 0 ? 0.0 : moving().kinetic(rate_)) + (ahead_ ? stage().wedge->kinetic(wedge_rate_) : 0.0);
    }

    /// What κ takes off the acceleration of the chain: it acts as friction does, under the weight that a_v changes.
    double held(double a_v) const { return stage().growth * pushed_ * (1.0 + a_v / gravity_); }

    struct Start {
        double time = never;
        int way = 0; ///< 1, -1; 0: the wedge alone
    };
    /// What moves first of a body at rest, or of a wedge at rest.
    Start start_of(const Line& h, const Line& v, double rest) const
    {
        Start first;
        const auto take = [&](double time, int way) {
            if (time < first.time) first = {time, way};
        };
        if (way_ == 0) {
            Line down = going_down().acceleration(h, v);
            if (grows_ && touching_) down = {down.now - held(v.now), down.end - held(v.end)};
            take(time_above_zero(down, rest), 1);
            if (two_way_) take(time_above_zero(-stage().up.acceleration(h, v), rest), -1);
        }
        if (runs_ahead_ && !ahead_ && !together()) take(time_above_zero(stage().wedge->acceleration(h, v), rest), 0);
        return first;
    }

    void start(int way, double time)
    {
        if (way == 0) return part_from_wedge(0.0);
        way_ = way;
        if (way_ < 0) touching_ = false, wide_ = true; // the wedge stays
        while (stage_ + 1 < stages_.size() && stages_[stage_ + 1].from_slip <= path_) ++stage_;
        ++out_.slide.phases;
        begun_ = x_;
        if (std::isnan(out_.slide.first_slip_time)) out_.slide.first_slip_time = time;
    }

    void part_from_wedge(double rate)
    {
        if (touching_) ++out_.partings;
        touching_ = false;
        ahead_ = true;
        wedge_rate_ = rate;
    }

    /// At rest: until something moves it. @returns how long
    double wait(const Line& h, const Line& v, double rest)
    {
        const Start first = start_of(h, v, rest);
        if (first.time == never) return rest;
        start(first.way, time_ + first.time);
        return first.time;
    }

    /// When the face between body and wedge would have to pull. Without cohesion in it, and without κ, that is when both alone would go
    /// apart.
    double time_of_parting(const Line& h, const Line& v, const Line& a, const SlopedStep* sloped, double rest, double until) const
    {
        const MovingStage& s = stage();
        const Line apart{s.gain.at(h.now, v.now), s.gain.at(h.end, v.end)};
        if (!s.cohesive && !sloped) return time_above_zero(apart, rest);
        if (std::max(apart.now, apart.end) <= 0.0) return never;
        const auto pull = [&](double t) {
            const double share = t / rest, gain = apart.at(share);
            if (!(gain > 0.0)) return gain;
            const ChainForces f = chain_forces(s.together.chain, s.together.law, h.at(share), v.at(share),
                                               sloped ? sloped->accel(t) : a.at(share));
            return std::min(gain, -f.thrust[s.down.chain.blocks.size() - 1] / s.together.law.mass);
        };
        if (pull(0.0) > 0.0) return 0.0;
        return pull(until) > 0.0 ? bracketed_root(pull, 0.0, until) : never;
    }

    /// Something slides: until it stops, the gap closes or opens, something else begins to slide, or a stage ends. @returns how long
    double slide(const Line& h, const Line& v, double rest)
    {
        const double sign = way_, speed = std::abs(rate_);
        Line a, w; // accelerations of body and wedge
        if (way_ != 0) a = moving().acceleration(h, v);
        if (rate_ == 0.0 && way_ * a.now < 0.0) a.now = 0.0; // it has just begun, at the root of this line
        if (ahead_) {
            w = stage().wedge->acceleration(h, v);
            if (wedge_rate_ == 0.0 && w.now < 0.0) w.now = 0.0;
        }
        const double jerk = (a.end - a.now) / rest, wedge_jerk = (w.end - w.now) / rest;
        std::optional<SlopedStep> sloped;
        if (grows_ && together())
            sloped.emplace(SlopedSlip{1.0, 0.0, 0.0, pushed_, 1.0, rate_, a,
                                      {stage().growth * (1.0 + v.now / gravity_), stage().growth * (1.0 + v.end / gravity_)},
                                      rest, rate_ == 0.0});
        double length = rest;
        Event event = Event::none;
        const auto until = [&](double time, Event which) {
            if (time < length) length = time, event = which;
        };
        if (sloped) {
            length = sloped->length();
            if (const double stop = sloped->time_of_stop(); stop <= length) length = stop, event = Event::stops;
        } else if (way_ != 0) {
            length = std::min(rest, time_of_stop(speed, sign * a.now, sign * jerk));
            if (length < rest || (speed == 0.0 && length == 0.0)) event = Event::stops;
        }
        if (ahead_) until(time_of_stop(wedge_rate_, w.now, wedge_jerk), Event::wedge_stops);
        int starting = 0;
        if (way_ == 0 || runs_ahead_)
            if (const Start first = start_of(h, v, rest); first.time < length) {
                starting = first.way;
                until(first.time, first.way == 0 ? Event::wedge_starts : Event::starts);
            }
        const double furthest = (speed + std::max(std::abs(a.now), std::abs(a.end)) * length) * length;
        const auto reach = [&](double distance, Event which) { // of the slip from here
            if (distance > furthest) return;
            if (sloped) {
                if (sloped->path(length) >= distance) until(sloped->time_of_path(distance, length), which);
                return;
            }
            const std::array<double, 4> left{distance, -speed, -0.5 * sign * a.now, -sign * jerk / 6.0};
            until(first_fall_to_zero(left, length), which);
        };
        if (stage_ + 1 < stages_.size() && way_ != 0) reach(stages_[stage_ + 1].from_slip - path_, Event::stage);
        if (ahead_) {
            const bool at_once = contact_ == x_ && wedge_rate_ == rate_; // they have just parted
            const double gain = w.now - a.now;
            const std::array<double, 4> gap{std::max(contact_ - x_, 0.0), wedge_rate_ - rate_, 0.5 * (at_once ? std::max(gain, 0.0) : gain),
                                            (wedge_jerk - jerk) / 6.0};
            const double closes = (std::min(gap[1], 0.0) - (std::abs(gap[2]) + std::abs(gap[3]) * length) * length) * length;
            if (!(gap[0] + 2.0 * closes > 0.0)) until(first_fall_to_zero(gap, length), Event::meets);
        } else if (has_wedge_ && way_ > 0 && !touching_) {
            reach(contact_ - x_, Event::meets);
        }
        if (runs_ahead_ && together())
            until(time_of_parting(h, v, a, sloped ? &*sloped : nullptr, rest, length), Event::parts);
        if (books_) book(h, v, a, w, sloped ? &*sloped : nullptr, rest, length);
        if (way_ != 0) move(a, jerk, sloped ? &*sloped : nullptr, length);
        if (ahead_) {
            contact_ += wedge_rate_ * length + (0.5 * w.now + wedge_jerk * length / 6.0) * length * length;
            wedge_rate_ += (w.now + 0.5 * wedge_jerk * length) * length;
        }
        out_.slide.max_gap = std::max(out_.slide.max_gap, contact_ - x_);
        if (books_) out_.ledger.largest = std::max(out_.ledger.largest, kinetic());
        happen(event, starting, length);
        return length;
    }

    void move(const Line& a, double jerk, const SlopedStep* sloped, double length)
    {
        const double moved = sloped ? sloped->path(length) : rate_ * length + (0.5 * a.now + jerk * length / 6.0) * length * length;
        x_ += moved;
        path_ += std::abs(moved);
        rate_ = sloped ? sloped->rate(length) : rate_ + (a.now + 0.5 * jerk * length) * length;
        if (together()) pushed_ += moved;
        if (touching_) contact_ = x_;
        out_.slide.max_slip = std::max(out_.slide.max_slip, std::abs(x_));
        out_.slide.peak_slip_rate = std::max(out_.slide.peak_slip_rate, std::abs(rate_));
        out_.slide.last_slip_time = time_ + length;
    }

    void happen(Event event, int starting, double after)
    {
        const double before = event == Event::stage || event == Event::meets ? kinetic() : 0.0;
        switch (event) {
        case Event::none: return;
        case Event::starts:
        case Event::wedge_starts: return start(starting, time_ + after);
        case Event::stops:
            stop_counting();
            rate_ = 0.0;
            way_ = 0;
            if (!ahead_ && x_ >= contact_) touching_ = true, wide_ = false;
            return;
        case Event::wedge_stops:
            ahead_ = false;
            wedge_rate_ = 0.0;
            return;
        case Event::parts: return part_from_wedge(rate_);
        case Event::stage: // kinetic energy goes where the dilation ends
            path_ = stages_[++stage_].from_slip;
            while (stage_ + 1 < stages_.size() && stages_[stage_ + 1].from_slip <= path_) ++stage_;
            break;
        case Event::meets:
            x_ = contact_;
            rate_ *= stage().down.law.mass / stage().together.law.mass;
            if (ahead_) rate_ += wedge_rate_ * (1.0 - stage().down.law.mass / stage().together.law.mass);
            touching_ = true;
            wide_ = ahead_ = false;
            wedge_rate_ = 0.0;
            ++out_.impacts;
        }
        out_.ledger.impact += before - kinetic();
    }

    void stop_counting()
    {
        if (way_ == 0) return;
        (way_ > 0 ? out_.slide.downstream_slip : out_.slide.upstream_slip) += std::abs(x_ - begun_);
        begun_ = x_;
    }

    /// Works over a part: forces linear, rates quadratic in time, so that two points of Gauss are exact; of a chain whose yield
    /// grows as it slides five, to round-off.
    void book(const Line& h, const Line& v, const Line& a, const Line& w, const SlopedStep* sloped, double rest, double length)
    {
        const auto at = [&](double place, double weight) {
            const double t = place * length, share = t / rest, a_h = h.at(share), a_v = v.at(share);
            if (way_ != 0) {
                const double accel = sloped ? sloped->accel(t) : a.at(share),
                             rate = sloped ? sloped->rate(t) : rate_ + 0.5 * (a.now + accel) * t, step = weight * length * rate;
                book(moving(), 0, a_h, a_v, accel, step);
                if (sloped) out_.ledger.weight -= step * lifting(stage().growth * (pushed_ + sloped->path(t)) * (1.0 + a_v / gravity_));
            }
            if (!ahead_) return;
            const double accel = w.at(share), rate = wedge_rate_ + 0.5 * (w.now + accel) * t;
            book(*stage().wedge, stage().down.chain.blocks.size(), a_h, a_v, accel, weight * length * rate);
        };
        const auto both = [&](double from_middle, double weight) {
            at(0.5 - from_middle, weight);
            at(0.5 + from_middle, weight);
        };
        if (!sloped) return both(0.5 / std::sqrt(3.0), 0.5);
        at(0.5, 64.0 / 225.0);
        both(0.2692346550528416, 0.2393143352496832);
        both(0.4530899229693320, 0.1184634425280945);
    }

    /// Power, per rate of the slip, of the force against the way of the last block that takes so much off the acceleration.
    double lifting(double accel) const
    {
        const MovingChain& m = stage().together;
        const std::size_t last = m.chain.blocks.size() - 1;
        const Point along = m.law.of_blocks[last].along;
        return accel * m.law.mass * dot(m.velocity(last), along) / dot(m.law.weights[last], along);
    }

    /// @param first  its first block's place in the whole chain @param step  slip of the body at this state [m]
    void book(const MovingChain& m, std::size_t first, double a_h, double a_v, double accel, double step)
    {
        SeamLedger& l = out_.ledger;
        const ChainForces f = chain_forces(m.chain, m.law, a_h, a_v, accel);
        for (std::size_t i = 0; i < m.chain.blocks.size(); ++i) {
            const ChainBlock& b = m.chain.blocks[i];
            const AddedMassTensor& w = b.added_mass;
            const Point u = m.velocity(i), n{std::sin(b.dip), std::cos(b.dip)}, t_i{std::cos(b.dip), -std::sin(b.dip)};
            l.ground -= step * dot(u, {-(b.mass + w.xx) * a_h + w.xy * a_v, -w.xy * a_h + (b.mass + w.yy) * a_v});
            l.weight -= step * u.y * b.mass * m.chain.gravity;
            l.loads += step * dot(u, b.force);
            l.water += step * b.uplift * dot(u, n);
            l.planes[first + i] += step * (f.normal[i] * dot(u, n) - f.resistance[i] * dot(u, t_i));
            out_.least_pressure = std::min(out_.least_pressure, f.normal[i]);
        }
        for (std::size_t j = 0; j < m.chain.interfaces.size(); ++j) {
            const ChainInterface& face = m.chain.interfaces[j];
            const Point u = m.velocity(j), w = m.velocity(j + 1), apart{w.x - u.x, w.y - u.y};
            const Point e{std::cos(face.angle), std::sin(face.angle)}, out{e.y, -e.x};
            l.water += step * face.water * dot(apart, out);
            l.interfaces[first + j] += step * (f.thrust[j] * dot(apart, out) - f.shear[j] * dot(apart, e));
            const bool parts = runs_ahead_ && first + j + 1 == stage().down.chain.blocks.size(); // where it would pull
            if (!parts) out_.least_pressure = std::min(out_.least_pressure, f.thrust[j]);
        }
    }

    std::vector<MovingStage> stages_;
    bool two_way_, books_, has_wedge_;
    bool runs_ahead_ = false, grows_ = false; ///< the wedge may; the yield does
    double gravity_;
    std::size_t stage_ = 0;
    bool touching_ = true;                ///< body and wedge
    bool wide_ = false;                   ///< a gap that the body has made as it went upstream
    int way_ = 0;                         ///< 1 downstream, -1 upstream, 0 at rest
    double x_ = 0.0, rate_ = 0.0;         ///< of the body, downstream
    double path_ = 0.0, contact_ = 0.0;   ///< accumulated slip; place of the body at which it meets the wedge
    bool ahead_ = false;                  ///< the wedge slides alone
    double wedge_rate_ = 0.0;             ///< then: of that place
    double pushed_ = 0.0;                 ///< slip that body and wedge made together
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

bool may_run_ahead(const SkippingMotion& motion, const std::vector<SeamStage>& stages, int polarity)
{
    return std::any_of(stages.begin(), stages.end(), [&](const SeamStage& s) {
        return s.parts && has_wedge(s) && MovingStage(s).may_run_ahead(motion, polarity);
    });
}

Chain going_upstream(Chain body)
{
    for (ChainBlock& b : body.blocks) {
        b.friction = -b.friction;
        b.cohesion = -b.cohesion;
        b.dilation = 0.0;
    }
    for (ChainInterface& face : body.interfaces) {
        face.friction = -face.friction;
        face.cohesion = -face.cohesion;
        face.dilation = 0.0;
    }
    return body;
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
    SeamRun run(stages, options, works, skipping);
    const double polarity = options.polarity;
    const double *h = motion.accel_h.data(), *v = motion.accel_v.empty() ? nullptr : motion.accel_v.data();
    const auto at = [=](std::size_t i) { return polarity * h[i]; };
    const auto up = [=](std::size_t i) { return v ? v[i] : 0.0; };
    const auto rests = [&](const AccelRange& range) {
        return run.rests(turned(range, options.polarity));
    };
    for (std::size_t i = 0; i < skipping.intervals(); ++i) {
        if (run.at_rest()) {
            const std::size_t next = skipping.skip(i, rests);
            run.wait(static_cast<double>(next - i) * motion.dt);
            if ((i = next) == skipping.intervals()) break;
            if (const std::size_t on = run.rest_on(at, up, motion.dt, i, skipping.intervals()); on != i) {
                i = on - 1;
                continue;
            }
        } else if ((i = run.slide_on(at, up, motion.dt, i, skipping.intervals())) == skipping.intervals()) {
            break;
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
