#pragma once

#include "sliding/block/roots.hpp"
#include "sliding/block/slip_motion.hpp"

#include <algorithm>

namespace damslip::sliding {

/// A block of constant friction in its last stage that its ground motion never lifts: rest and movements by turns, with no
/// other event. The sums of SlipMotion::cross() in their order, so its bits, at a fraction of the price.
/// @tparam vertical  the motion has a vertical component
template <bool vertical>
class PressedSlip {
public:
    /// @param polarity  1 or -1
    PressedSlip(const SlipMotion& block, const SkippingMotion& motion, double polarity)
        : drive_(turned(block.forms().equations.drive, polarity)),
          normal_(turned(block.forms().equations.normal, polarity)),
          down_(turned(block.forms().excess_downstream, polarity)),
          up_(turned(block.forms().excess_upstream, polarity)), mass_down_(block.forms().mass_downstream),
          mass_up_(block.forms().mass_upstream), friction_(block.forms().friction), bond_(block.forms().bond),
          motion_(motion), h_(motion.motion().accel_h.data()), v_(vertical ? motion.motion().accel_v.data() : nullptr),
          dt_(motion.motion().dt), time_(block.time_), moving_(block.moving_), from_rest_(block.from_rest_),
          direction_(block.direction_), rate_(block.rate_), path_(block.path_), slid_(block.slid_),
          changes_(block.changes_)
    {
        plainly_below_ = -1e-13 * (largest(block.forms().equations.drive) +
                                   friction_ * largest(block.forms().equations.normal) + std::abs(bond_));
        two_way_ = block.options_.two_way && !(upper(up_, motion.whole()) < plainly_below_);
    }

    /// True where it may slide upstream, too. A block that the motion nowhere drives that way does not, whatever it is let.
    bool two_way() const { return two_way_; }

    /// True where N' at rest and N' of the sliding block stay above zero all along the motion.
    bool stays_pressed(const GroundLinear& free_normal, double polarity) const
    {
        const AccelRange& whole = motion_.whole();
        const auto lowest = [&](const GroundLinear& form) {
            return -upper({-form.constant, -form.per_a_h, -form.per_a_v}, whole);
        };
        return std::min(lowest(normal_) - 1e-13 * largest(normal_),
                        lowest(turned(free_normal, polarity)) - 1e-13 * largest(free_normal)) > 0.0;
    }

    /// Intervals k ... last - 1. @param before  intervals so far, for the time  @returns the first one that is left
    std::size_t run(std::size_t k, std::size_t last, std::size_t before)
    {
        const auto time_of = [&, first = k](std::size_t i) { return static_cast<double>(before + (i - first)) * dt_; };
        const auto goes_by = [&](std::size_t next) {
            if (next > k) time_ = time_of(next - 1) + dt_;
            k = next;
        };
        while (k < last) {
            if (!moving_)
                goes_by(rest(k, last));
            else if (!from_rest_)
                goes_by(slide(k, last));
            if (k == last) break;
            time_ = time_of(k);
            cross(k++);
            if (unresolved_) break;
        }
        return k;
    }

    void write(SlipMotion& block) const
    {
        block.time_ = time_;
        block.moving_ = moving_;
        block.from_rest_ = from_rest_;
        block.direction_ = direction_;
        block.rate_ = rate_;
        block.path_ = path_;
        block.slid_ = slid_;
        block.changes_ = changes_;
        block.unresolved_ = unresolved_;
    }

private:
    friend class PressedLanes;

    static constexpr int most_events = 1000; ///< of an interval; more is no motion

    struct Ground {
        double h, v;
    };

    static GroundLinear turned(const GroundLinear& form, double polarity)
    {
        return {form.constant, polarity * form.per_a_h, form.per_a_v};
    }
    static double at(const GroundLinear& form, const Ground& ground)
    {
        const double sum = form.constant + form.per_a_h * ground.h;
        return vertical ? sum + form.per_a_v * ground.v : sum;
    }
    Ground ground(std::size_t k) const { return {h_[k], vertical ? v_[k] : 0.0}; }

    static double upper(const GroundLinear& form, const AccelRange& r)
    {
        const double sum = form.constant + form.per_a_h * (form.per_a_h > 0.0 ? r.h_max : r.h_min);
        return vertical ? sum + form.per_a_v * (form.per_a_v > 0.0 ? r.v_max : r.v_min) : sum;
    }
    /// Bound of |terms| over the motion.
    double largest(const GroundLinear& form) const
    {
        const AccelRange& r = motion_.whole();
        return std::abs(form.constant) + std::abs(form.per_a_h) * std::max(-r.h_min, r.h_max) +
               std::abs(form.per_a_v) * std::max(-r.v_min, r.v_max);
    }

    /// First interval from k on, at rest, in which the block may start.
    std::size_t rest(std::size_t k, std::size_t last) const
    {
        const auto rests = [&](std::size_t i) {
            const Ground now = ground(i);
            return at(down_, now) < plainly_below_ && (!two_way_ || at(up_, now) < plainly_below_);
        };
        const auto all_rest = [&](const AccelRange& r) {
            return upper(down_, r) < plainly_below_ && (!two_way_ || upper(up_, r) < plainly_below_);
        };
        if (!rests(k)) return k;
        while (k < last) {
            if (k % SkippingMotion::block == 0) {
                k = std::min(motion_.skip(k, all_rest), last);
                if (k == last) break;
            }
            const std::size_t end = std::min(last, (k / SkippingMotion::block + 1) * SkippingMotion::block);
            while (k < end && rests(k + 1)) ++k;
            if (k < end) break;
        }
        return k;
    }

    /// First interval from k on, sliding, in which the block may stop.
    std::size_t slide(std::size_t k, std::size_t last)
    {
        const bool downstream = direction_ == SlipDirection::downstream;
        const GroundLinear excess = downstream ? down_ : up_;
        const double mass = downstream ? mass_down_ : mass_up_, dt = dt_, half = 0.5 * dt_;
        double& along = downstream ? slid_.downstream : slid_.upstream;
        double rate = rate_, path = path_, slid = along, peak_rate = slid_.peak_rate;
        double now = at(excess, ground(k)) / mass;
        for (; k < last; ++k) {
            const double end = at(excess, ground(k + 1)) / mass;
            // Not even with its lowest acceleration all along does the rate come near zero; else it is looked at closely.
            if (!(rate + dt * std::min(now, end) > 1e-6 * rate) && !(now > 0.0 && end > 0.0)) break;
            if (now > 0.0 && end < 0.0) peak_rate = std::max(peak_rate, rate - now * now / (2.0 * ((end - now) / dt)));
            const double way = dt * (rate + dt * (2.0 * now + end) / 6.0);
            path += way;
            slid += way;
            rate += half * (now + end);
            peak_rate = std::max(peak_rate, rate);
            now = end;
        }
        rate_ = rate;
        path_ = path;
        along = slid;
        slid_.peak_rate = peak_rate;
        grow_largest();
        return k;
    }

    /// |slip| over a movement has its largest value at one of the ends.
    void grow_largest() { slid_.largest = std::max(slid_.largest, std::abs(slid_.downstream - slid_.upstream)); }

    void cross(std::size_t k)
    {
        now_ = ground(k);
        end_ = ground(k + 1);
        span_ = dt_;
        for (int events = 0; span_ > 0.0; ++events) {
            if (events >= most_events) {
                unresolved_ = true;
                return;
            }
            moving_ ? move() : wait();
        }
    }

    void wait()
    {
        const Line drive{at(drive_, now_), at(drive_, end_)};
        const Line resistance{friction_ * at(normal_, now_) + bond_, friction_ * at(normal_, end_) + bond_};
        const double h_down = time_above_zero({drive.now - resistance.now, drive.end - resistance.end}, span_);
        const double h_up =
            two_way_ ? time_above_zero({-drive.now - resistance.now, -drive.end - resistance.end}, span_) : never;
        const double h = std::min(h_down, h_up);
        elapse(std::min(h, span_));
        if (h != never) start(h == h_down ? SlipDirection::downstream : SlipDirection::upstream);
    }

    void move()
    {
        const bool downstream = direction_ == SlipDirection::downstream;
        const GroundLinear& excess = downstream ? down_ : up_;
        const double mass = downstream ? mass_down_ : mass_up_;
        Line accel{at(excess, now_) / mass, at(excess, end_) / mass};
        if (from_rest_) accel.now = std::max(accel.now, 0.0);
        const double jerk = (accel.end - accel.now) / span_;
        const double h_stop = time_of_stop(rate_, accel.now, jerk);
        const double h = std::min(h_stop, span_);
        const double then = h == span_ ? accel.end : accel.at(h / span_);
        if (accel.now > 0.0 && then < 0.0)
            slid_.peak_rate = std::max(slid_.peak_rate, rate_ - accel.now * accel.now / (2.0 * jerk));
        const double way = std::max(h * (rate_ + h * (2.0 * accel.now + then) / 6.0), 0.0);
        path_ += way;
        (downstream ? slid_.downstream : slid_.upstream) += way;
        grow_largest();
        rate_ = std::max(0.0, rate_ + 0.5 * h * (accel.now + then));
        slid_.peak_rate = std::max(slid_.peak_rate, rate_);
        from_rest_ = from_rest_ && h == 0.0;
        elapse(h);
        if (h == h_stop) stop();
    }

    void elapse(double h)
    {
        time_ += h;
        if (h >= span_) {
            span_ = 0.0;
            now_ = end_;
            return;
        }
        const double part = h / span_;
        now_ = {now_.h + (end_.h - now_.h) * part, now_.v + (end_.v - now_.v) * part};
        span_ -= h;
    }

    void start(SlipDirection direction)
    {
        ++changes_;
        moving_ = from_rest_ = true;
        direction_ = direction;
        rate_ = 0.0;
        slid_.begin(time_, path_);
    }

    void stop()
    {
        ++changes_;
        moving_ = from_rest_ = false;
        rate_ = 0.0;
        slid_.end(time_, path_);
    }

    GroundLinear drive_, normal_, down_, up_;
    double mass_down_, mass_up_, friction_, bond_;
    double plainly_below_; ///< an excess below this is no start, whatever round-off says [N/m]
    bool two_way_;         ///< the motion may drive it upstream, and it is let
    const SkippingMotion& motion_;
    const double* h_;
    const double* v_;
    double dt_;

    double time_;
    bool moving_, from_rest_, unresolved_ = false;
    SlipDirection direction_;
    double rate_, path_;
    SlipTotals slid_;
    long changes_;

    Ground now_{}, end_{}; ///< of what is left of the interval
    double span_ = 0.0;
};

} // namespace damslip::sliding
