#pragma once

#include "sliding/block/contact_block.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

/// The rigid block in permanent contact: its friction does not change with the slip, and the motion never lifts it. It is at
/// rest or slides, with no other event. One source for one block and for several side by side, a batched run.
namespace damslip::sliding {

/// The operations that the runs need of a number: those of one double; four doubles have theirs in
/// permanent_contact_batch.cpp.
template <class Number>
struct Batch;
template <>
struct Batch<double> {
    using Mask = bool;
    static constexpr std::size_t size = 1;

    static double choose(bool mask, double yes, double no) { return mask ? yes : no; }
    static bool any_of(bool mask) { return mask; }
    static bool all_of(bool mask) { return mask; }
    static double square_root(double x) { return std::sqrt(x); }
    static void set(double& number, std::size_t, double value) { number = value; }
    static void set(bool& mask, std::size_t, bool value) { mask = value; }
    static double get(double number, std::size_t) { return number; }
    static bool get(bool mask, std::size_t) { return mask; }
    static double load(const double* from) { return *from; }
    static std::size_t first_of(bool) { return 0; }
};

/// Between events the slip acceleration is linear in time, the rate quadratic, the slip cubic; a start is a root of the net
/// driving force, a stop one of the rate. The operations are those of SlipMotion in their order, so the bits are the same.
/// @tparam Number  double, or several side by side: then all that follows is done for each of them
/// @tparam vertical  the motion has a vertical component
template <class Number, bool vertical>
class PermanentContact : Batch<Number> {
public:
    using Batch<Number>::size;

    /// @param blocks  `size` of them
    PermanentContact(std::span<const ContactBlock> blocks, const ContactMotion& motion)
        : motion_(motion), dt_(motion.dt)
    {
        each(blocks, [this](const ContactBlock& b, std::size_t i) {
            put(drive_, i, b.drive);
            put(down_, i, b.down);
            put(up_, i, b.up);
            set(plainly_below_, i, b.plainly_below);
            set(time_, i, b.time);
            set(rate_, i, b.rate);
            set(path_, i, b.path);
            set(slid_down_, i, b.slid.downstream);
            set(slid_up_, i, b.slid.upstream);
            set(largest_, i, b.slid.largest);
            set(peak_rate_, i, b.slid.peak_rate);
            set(first_time_, i, b.slid.first_time);
            set(last_time_, i, b.slid.last_time);
            set(start_path_, i, b.slid.start_path);
            set(phases_, i, b.slid.phases);
            set(changes_, i, static_cast<double>(b.changes));
            set(two_way_, i, b.two_way);
            set(moving_, i, b.moving);
            set(from_rest_, i, b.from_rest);
            set(downstream_, i, b.direction == SlipDirection::downstream);
        });
        path_limit_ = blocks.front().path_limit;
        some_upstream_ = any_of(two_way_ | (moving_ & inverse(downstream_)));
    }

    void write(std::span<ContactBlock> blocks) const
    {
        each(blocks, [this](ContactBlock& b, std::size_t i) {
            b.time = get(time_, i);
            b.rate = get(rate_, i);
            b.path = get(path_, i);
            b.slid.downstream = get(slid_down_, i);
            b.slid.upstream = get(slid_up_, i);
            b.slid.largest = get(largest_, i);
            b.slid.peak_rate = get(peak_rate_, i);
            b.slid.first_time = get(first_time_, i);
            b.slid.last_time = get(last_time_, i);
            b.slid.start_path = get(start_path_, i);
            b.slid.phases = static_cast<int>(get(phases_, i));
            b.changes = static_cast<long>(get(changes_, i));
            b.moving = get(moving_, i);
            b.from_rest = get(from_rest_, i);
            b.direction = get(downstream_, i) ? SlipDirection::downstream : SlipDirection::upstream;
            b.unresolved = unresolved_;
        });
    }

    /// Intervals k ... last - 1. @param before  intervals so far, for the time  @returns the first one that is left
    std::size_t run(std::size_t k, std::size_t last, std::size_t before)
    {
        const auto time_of = [&, first = k](std::size_t i) { return static_cast<double>(before + (i - first)) * dt_; };
        while (k < last) {
            const std::size_t from = k;
            if (!any_of(moving_))
                k = rest(k, last);
            else if (!any_of(from_rest_))
                k = go_on(k, last);
            if (k > from) time_ = all(time_of(k - 1) + dt_);
            if (k == last || path_limit_ != never) break;
            time_ = all(time_of(k));
            cross(k++);
            if (unresolved_) break;
        }
        return k;
    }

private:
    using typename Batch<Number>::Mask;
    using Batch<Number>::choose;
    using Batch<Number>::any_of;
    using Batch<Number>::all_of;
    using Batch<Number>::square_root;
    using Batch<Number>::set;
    using Batch<Number>::get;

    static constexpr int most_events = 1000; ///< of an interval; more is no motion

    struct Form {
        Number constant{}, per_a_h{}, per_a_v{};
    };
    struct Way {
        Form excess;
        Number mass{};
        Form normal;
        Number friction{}, bond{};
    };
    struct Ground {
        Number h{}, v{};
    };
    /// Of a quantity that is linear over the rest of the interval.
    struct Ends {
        Number now, end;
    };

    template <class Blocks, class Function>
    static void each(Blocks blocks, Function function)
    {
        for (std::size_t i = 0; i < size; ++i) function(blocks[i], i);
    }
    static void put(Form& form, std::size_t i, const GroundLinear& of)
    {
        set(form.constant, i, of.constant);
        set(form.per_a_h, i, of.per_a_h);
        set(form.per_a_v, i, of.per_a_v);
    }
    static void put(Way& way, std::size_t i, const ContactBlock::Way& of)
    {
        put(way.excess, i, of.excess);
        put(way.normal, i, of.normal);
        set(way.mass, i, of.mass);
        set(way.friction, i, of.friction);
        set(way.bond, i, of.bond);
    }

    static Mask inverse(Mask mask) { return !mask; }
    static Number all(double x) { return Number{} + x; }
    static Number larger(Number a, Number b) { return choose(a < b, b, a); }
    static Number smaller(Number a, Number b) { return choose(b < a, b, a); }
    static Number magnitude(Number a) { return choose(a < all(0.0), -a, a); }
    Number of_way(Number down, Number up) const { return some_upstream_ ? choose(downstream_, down, up) : down; }

    static Number at(const Form& form, const Ground& ground)
    {
        const Number sum = form.constant + form.per_a_h * ground.h;
        if constexpr (vertical)
            return sum + form.per_a_v * ground.v;
        else
            return sum;
    }
    Ground ground(std::size_t k) const
    {
        if constexpr (vertical)
            return {all(motion_.a_h[k]), all(motion_.a_v[k])};
        else
            return {all(motion_.a_h[k]), all(0.0)};
    }
    Ends ends(const Form& form) const { return {at(form, now_), at(form, end_)}; }

    static Number upper(const Form& form, const AccelRange& r)
    {
        const Number h = choose(form.per_a_h > all(0.0), all(r.h_max), all(r.h_min));
        if constexpr (!vertical) return form.constant + form.per_a_h * h;
        return form.constant + form.per_a_h * h +
               form.per_a_v * choose(form.per_a_v > all(0.0), all(r.v_max), all(r.v_min));
    }

    /// Blocks at rest that plainly stay so under an acceleration, or a range of it.
    template <class Force>
    Mask plainly_rests(Force force) const
    {
        const Mask down = force(down_.excess) < plainly_below_;
        if (!some_upstream_) return down;
        return down & (inverse(two_way_) | (force(up_.excess) < plainly_below_));
    }
    Mask rests_at(std::size_t k) const
    {
        return plainly_rests([here = ground(k)](const Form& form) { return at(form, here); });
    }

    /// First interval from k on, all blocks at rest, in which one of them may start.
    std::size_t rest(std::size_t k, std::size_t last) const
    {
        const auto all_rest = [this](const AccelRange& r) {
            return all_of(plainly_rests([&r](const Form& form) { return upper(form, r); }));
        };
        if (!all_of(rests_at(k))) return k;
        while (k < last) {
            std::size_t end = last;
            if (motion_.ranges) {
                if (k % SkippingMotion::block == 0) k = std::min(motion_.ranges->skip(k, all_rest), last);
                end = std::min(last, (k / SkippingMotion::block + 1) * SkippingMotion::block);
            }
            while (k < end && all_of(rests_at(k + 1))) ++k;
            if (k < end) break;
        }
        return k;
    }

    /// What a movement adds up to.
    struct Sums {
        Number rate, path, along, peak_rate; ///< along: the sum of the slips in its direction
    };
    Sums sums() const { return {rate_, path_, of_way(slid_down_, slid_up_), peak_rate_}; }
    void put(const Sums& s)
    {
        rate_ = s.rate;
        path_ = s.path;
        peak_rate_ = s.peak_rate;
        slid_down_ = some_upstream_ ? choose(downstream_, s.along, slid_down_) : s.along;
        if (some_upstream_) slid_up_ = choose(downstream_, slid_up_, s.along);
        grow_largest();
    }
    static Number zero_unless(Mask mask, Number x)
    {
        if constexpr (size == 1)
            return x;
        else
            return choose(mask, x, all(0.0));
    }
    /// Not even with its lowest acceleration all along does the rate come near zero; else it is looked at closely.
    Mask keeps_moving(Number rate, Number now, Number end) const
    {
        return (rate + dt_ * smaller(now, end) > 1e-6 * rate) | ((now > all(0.0)) & (end > all(0.0)));
    }
    /// Slip over an interval without an event. @param now, end  slip acceleration at its ends
    Number way(Number rate, Number now, Number end) const { return dt_ * (rate + dt_ * (2.0 * now + end) / 6.0); }
    void advance(Sums& s, Mask moving, Number way, Number now, Number end) const
    {
        const Mask turns = moving & (now > all(0.0)) & (end < all(0.0));
        if (any_of(turns))
            s.peak_rate =
                choose(turns, larger(s.peak_rate, s.rate - now * now / (2.0 * ((end - now) / dt_))), s.peak_rate);
        way = zero_unless(moving, way);
        s.path += way;
        s.along += way;
        s.rate = zero_unless(moving, s.rate + 0.5 * dt_ * (now + end));
        s.peak_rate = larger(s.peak_rate, s.rate);
    }
    Form sliding_excess() const
    {
        return {of_way(down_.excess.constant, up_.excess.constant), of_way(down_.excess.per_a_h, up_.excess.per_a_h),
                of_way(down_.excess.per_a_v, up_.excess.per_a_v)};
    }

    /// First interval from k on in which one of the blocks may start or stop.
    std::size_t go_on(std::size_t k, std::size_t last)
    {
        const Form excess = sliding_excess();
        const Number mass = of_way(down_.mass, up_.mass);
        Mask moving = moving_;
        if constexpr (size == 1)
            moving = true; // else rest() is asked
        else if (!all_of(moving | rests_at(k)))
            return k;
        Sums s = sums();
        Number now = at(excess, ground(k)) / mass;
        for (; k < last; ++k) {
            const Number force = at(excess, ground(k + 1)), end = force / mass;
            Mask goes_on = keeps_moving(s.rate, now, end);
            if constexpr (size > 1)
                goes_on = (moving & goes_on) |
                          (inverse(moving) & (some_upstream_ ? rests_at(k + 1) : force < plainly_below_));
            if (!all_of(goes_on)) break;
            const Number step = way(s.rate, now, end);
            if constexpr (size == 1)
                if (path_limit_ != never && !(s.path + step < path_limit_)) break;
            advance(s, moving, step, now, end);
            now = end;
        }
        put(s);
        return k;
    }

    /// |slip| over a movement has its largest value at one of the ends.
    void grow_largest() { largest_ = larger(largest_, magnitude(slid_down_ - slid_up_)); }

    /// An interval, event by event; of several blocks those without an event at once.
    void cross(std::size_t k)
    {
        now_ = ground(k);
        end_ = ground(k + 1);
        span_ = all(dt_);
        if constexpr (size > 1) {
            const Form excess = sliding_excess();
            const Number mass = of_way(down_.mass, up_.mass), now = at(excess, now_) / mass,
                         end = at(excess, end_) / mass;
            const Mask slides = moving_ & inverse(from_rest_) & keeps_moving(rate_, now, end);
            const Mask without_event = slides | (inverse(moving_) & rests_at(k) & rests_at(k + 1));
            Sums s = sums(), before = s;
            advance(s, slides, way(s.rate, now, end), now, end);
            s.rate = choose(slides, s.rate, before.rate);
            put(s);
            time_ = choose(without_event, time_ + dt_, time_);
            span_ = zero_unless(inverse(without_event), span_);
        }
        for (int events = 0;; ++events) {
            const Mask left = span_ > all(0.0), moving = left & moving_, waiting = left & inverse(moving_);
            if (!any_of(left)) return;
            if (events >= most_events) {
                unresolved_ = true;
                return;
            }
            if (any_of(moving)) move(moving);
            if (any_of(waiting)) wait(waiting);
        }
    }

    /// Blocks at rest, to their start.
    void wait(Mask mask)
    {
        const auto rest_under = [this](const Ground& here) {
            return plainly_rests([&here](const Form& form) { return at(form, here); });
        };
        if (!any_of(mask & inverse(rest_under(now_) & rest_under(end_)))) return elapse(mask, span_);
        const Ends drive = ends(drive_);
        const auto resistance = [this](const Way& way) {
            const Ends normal = ends(way.normal);
            return Ends{way.friction * normal.now + way.bond, way.friction * normal.end + way.bond};
        };
        const Ends down = resistance(down_);
        const Number h_down = time_above_zero(drive.now - down.now, drive.end - down.end);
        Number h_up = all(never);
        if (some_upstream_) {
            const Ends up = resistance(up_);
            h_up = choose(two_way_, time_above_zero(-drive.now - up.now, -drive.end - up.end), h_up);
        }
        const Number h = smaller(h_down, h_up);
        elapse(mask, smaller(h, span_));
        start(mask & (h < all(never)), h == h_down);
    }

    /// Moving blocks, to their stop.
    void move(Mask mask)
    {
        const Number none = all(0.0), mass = of_way(down_.mass, up_.mass);
        Ends accel{of_way(at(down_.excess, now_), at(up_.excess, now_)) / mass,
                   of_way(at(down_.excess, end_), at(up_.excess, end_)) / mass};
        accel.now = choose(from_rest_, larger(accel.now, none), accel.now);
        const Number jerk = (accel.end - accel.now) / span_;
        // A block that does not slow down in the interval does not stop in it.
        Number h_stop = all(never);
        if (any_of(mask & inverse((accel.now >= none) & (accel.end > none)))) h_stop = time_of_stop(accel.now, jerk);
        const Number h = smaller(h_stop, span_);
        const Number then = choose(h == span_, accel.end, accel.now + (accel.end - accel.now) * (h / span_));
        const Mask turns = mask & (accel.now > none) & (then < none);
        peak_rate_ = choose(turns, larger(peak_rate_, rate_ - accel.now * accel.now / (2.0 * jerk)), peak_rate_);
        const Number way = choose(mask, larger(h * (rate_ + h * (2.0 * accel.now + then) / 6.0), none), none);
        path_ += way;
        slid_down_ += some_upstream_ ? choose(downstream_, way, none) : way;
        if (some_upstream_) slid_up_ += choose(downstream_, none, way);
        grow_largest();
        rate_ = choose(mask, larger(none, rate_ + 0.5 * h * (accel.now + then)), rate_);
        peak_rate_ = larger(peak_rate_, rate_);
        from_rest_ = from_rest_ & (inverse(mask) | (h == none));
        elapse(mask, h);
        stop(mask & (h == h_stop));
    }

    /// time_above_zero() of roots.hpp over the rest of the interval.
    Number time_above_zero(Number now, Number end) const
    {
        const Number none = all(0.0), h = span_ * (-now / (end - now));
        return choose(now > none, none, choose((end > none) & (h < span_), h, all(never)));
    }

    /// time_of_stop() of roots.hpp.
    Number time_of_stop(Number accel, Number jerk) const
    {
        const Number none = all(0.0), no_stop = all(never);
        const Number discriminant = accel * accel - 2.0 * jerk * rate_;
        const Number root = square_root(larger(discriminant, none));
        const Number falling = choose(rate_ == none, none, 2.0 * rate_ / (root - accel));
        const Number rising = choose(jerk < none, (accel + root) / -jerk, no_stop);
        const Number moving = choose(discriminant < none, no_stop, choose(accel > none, rising, falling));
        return choose((rate_ == none) & (accel == none), choose(jerk > none, no_stop, none), moving);
    }

    void elapse(Mask mask, Number h)
    {
        time_ = choose(mask, time_ + h, time_);
        const Mask whole = mask & (h >= span_), some = mask & (h < span_);
        if (any_of(whole)) {
            now_.h = choose(whole, end_.h, now_.h);
            if constexpr (vertical) now_.v = choose(whole, end_.v, now_.v);
        }
        if (any_of(some)) {
            const Number share = h / span_;
            now_.h = choose(some, now_.h + (end_.h - now_.h) * share, now_.h);
            if constexpr (vertical) now_.v = choose(some, now_.v + (end_.v - now_.v) * share, now_.v);
        }
        span_ = choose(whole, all(0.0), choose(some, span_ - h, span_));
    }

    void start(Mask mask, Mask downstream)
    {
        if (!any_of(mask)) return;
        count(changes_, mask, 1.0);
        count(phases_, mask, 1.0);
        moving_ = moving_ | mask;
        from_rest_ = from_rest_ | mask;
        downstream_ = (mask & downstream) | (inverse(mask) & downstream_);
        rate_ = choose(mask, all(0.0), rate_);
        start_path_ = choose(mask, path_, start_path_);
        first_time_ = choose(mask & (phases_ == all(1.0)), time_, first_time_);
    }

    void stop(Mask mask)
    {
        if (!any_of(mask)) return;
        count(changes_, mask, 1.0);
        moving_ = moving_ & inverse(mask);
        from_rest_ = from_rest_ & inverse(mask);
        rate_ = choose(mask, all(0.0), rate_);
        const Mask nothing = mask & (path_ == start_path_);
        count(phases_, nothing, -1.0);
        last_time_ = choose(mask & inverse(nothing), time_, last_time_);
    }
    static void count(Number& number, Mask mask, double by) { number = choose(mask, number + by, number); }

    Form drive_;
    Way down_, up_;
    Number plainly_below_{};
    Mask two_way_{};
    bool some_upstream_ = false; ///< one of the blocks may slide upstream
    double path_limit_ = never;
    ContactMotion motion_;
    double dt_;

    Number time_{}, rate_{}, path_{}, slid_down_{}, slid_up_{}, largest_{}, peak_rate_{};
    Number first_time_{}, last_time_{}, start_path_{}, phases_{}, changes_{};
    Mask moving_{}, from_rest_{}, downstream_{};
    bool unresolved_ = false;

    Ground now_, end_; ///< of what is left of the interval
    Number span_{};
};

} // namespace damslip::sliding
