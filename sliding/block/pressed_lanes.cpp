#include "sliding/block/pressed_lanes.hpp"

#include "core/version.hpp"
#include "sliding/block/four.hpp"

namespace damslip::sliding {

bool has_pressed_lanes()
{
    return vector_level() == VectorLevel::avx2;
}

#if DAMSLIP_HAS_AVX2

/// The steps of PressedSlip::slide(), rest(), wait() and move(), which is where to read them, for four blocks. Rare cases
/// are left to a block's own cross().
class PressedLanes {
public:
    DAMSLIP_AVX2 PressedLanes(const SkippingMotion& motion, FourPressed& blocks)
        : motion_(motion), h_(motion.motion().accel_h.data()), intervals_(motion.intervals()), dt_(motion.motion().dt),
          blocks_(blocks), down_(four([](const Block& b) { return b.down_.constant; })),
          down_per_a_h_(four([](const Block& b) { return b.down_.per_a_h; })),
          drive_(four([](const Block& b) { return b.drive_.constant; })),
          drive_per_a_h_(four([](const Block& b) { return b.drive_.per_a_h; })),
          normal_(four([](const Block& b) { return b.normal_.constant; })),
          normal_per_a_h_(four([](const Block& b) { return b.normal_.per_a_h; })),
          friction_(four([](const Block& b) { return b.friction_; })),
          bond_(four([](const Block& b) { return b.bond_; })), mass_(four([](const Block& b) { return b.mass_down_; })),
          plainly_below_(four([](const Block& b) { return b.plainly_below_; }))
    {
    }

    DAMSLIP_AVX2 bool run()
    {
        State now;
        int crossed = 0; // lanes that had an event in the interval before
        for (std::size_t k = 0; k < intervals_; ++k) {
            const std::size_t from = k;
            if (lanes_of(now.moving) == 0) k = rest(k);
            k = slide(now, k);
            if (k > from) crossed = 0;
            if (k == intervals_) break;
            if (!cross(now, k, crossed)) return false;
        }
        finish(now, crossed);
        return true;
    }

private:
    using Block = PressedSlip<false>;

    static constexpr int all_lanes = (1 << pressed_lanes) - 1;

    /// Of lanes that rest the rate is zero.
    struct State {
        Four moving{}; ///< mask
        Four rate{};
        Four path{};
        Four peak_rate{};
    };
    struct alignas(32) Numbers {
        double moving[pressed_lanes], rate[pressed_lanes], path[pressed_lanes], peak_rate[pressed_lanes];
    };

    /// @param number  of a block
    template <typename Number>
    DAMSLIP_AVX2 Four four(Number number) const
    {
        return _mm256_setr_pd(number(blocks_[0]), number(blocks_[1]), number(blocks_[2]), number(blocks_[3]));
    }
    static DAMSLIP_FOUR_INLINE Four zero() { return _mm256_setzero_pd(); }
    static DAMSLIP_FOUR_INLINE Four minus(Four a) { return _mm256_xor_pd(a, all(-0.0)); }
    static DAMSLIP_FOUR_INLINE Four all_set() { return _mm256_cmp_pd(zero(), zero(), _CMP_EQ_OQ); }

    /// Of the lanes of the mask, to `value` where that is more.
    static DAMSLIP_FOUR_INLINE void raise(Four& peak, Four lanes, Four value)
    {
        peak = chosen(both(lanes, above(value, peak)), value, peak);
    }

    /// Of the sliding block. @param a_h  ground acceleration
    DAMSLIP_FOUR_INLINE Four excess(Four a_h) const { return down_ + down_per_a_h_ * a_h; }
    /// Drive less resistance of the block at rest.
    DAMSLIP_FOUR_INLINE Four excess_at_rest(Four a_h) const
    {
        return drive_ + drive_per_a_h_ * a_h - (friction_ * (normal_ + normal_per_a_h_ * a_h) + bond_);
    }

    /// At the ends of an interval.
    struct Ends {
        Four excess0, accel0, excess1, accel1;
    };
    DAMSLIP_FOUR_INLINE Ends ends(std::size_t k) const
    {
        const Four excess0 = excess(all(h_[k])), excess1 = excess(all(h_[k + 1]));
        return {excess0, excess0 / mass_, excess1, excess1 / mass_};
    }

    /// Lanes that surely go on as they are all along an interval.
    DAMSLIP_FOUR_INLINE Four go_on(const State& now, const Ends& at) const
    {
        const Four least_rate = now.rate + all(dt_) * _mm256_min_pd(at.accel0, at.accel1);
        const Four slide = _mm256_or_pd(above(least_rate, all(1e-6) * now.rate),
                                        both(above(at.accel0, zero()), above(at.accel1, zero())));
        const Four rest = both(above(plainly_below_, at.excess0), above(plainly_below_, at.excess1));
        return chosen(now.moving, slide, rest);
    }

    /// First interval from k on in which one of them may start or stop.
    DAMSLIP_AVX2 std::size_t slide(State& now, std::size_t k) const
    {
        if (k == intervals_) return k;
        State here = now;
        Ends at = ends(k);
        while (lanes_of(go_on(here, at)) == all_lanes) {
            slide(here, here.moving, at);
            if (++k == intervals_) break;
            const Four next = excess(all(h_[k + 1]));
            at = {at.excess1, at.accel1, next, next / mass_};
        }
        now = here;
        return k;
    }
    /// An interval in which the lanes of the mask slide all along.
    DAMSLIP_FOUR_INLINE void slide(State& now, Four lanes, const Ends& at) const
    {
        const Four a0 = at.accel0, a1 = at.accel1;
        const Four turns = both(lanes, both(above(a0, zero()), above(zero(), a1)));
        if (lanes_of(turns) != 0) {
            const Four crest = now.rate - a0 * a0 / (all(2.0) * ((a1 - a0) / all(dt_)));
            raise(now.peak_rate, turns, crest);
        }
        const Four way = all(dt_) * (now.rate + all(dt_) * (all(2.0) * a0 + a1) / all(6.0));
        now.path = now.path + both(lanes, way);
        now.rate = now.rate + both(lanes, all(0.5 * dt_) * (a0 + a1));
        raise(now.peak_rate, lanes, now.rate);
    }

    /// An interval with an event. @param[out] crossed  lanes that have one @returns false: not resolved
    DAMSLIP_AVX2 bool cross(State& now, std::size_t k, int& crossed)
    {
        const Ends at = ends(k);
        const Four goes_on = go_on(now, at);
        const Four stops = without(now.moving, goes_on), starts = without(without(all_set(), now.moving), goes_on);
        crossed = lanes_of(goes_on) ^ all_lanes;
        int left = crossed;
        slide(now, both(now.moving, goes_on), at);
        if (k + 1 < intervals_) { // the time after the last interval is the block's to tell
            if (lanes_of(starts) != 0) left &= ~start(now, starts, k, at.accel1);
            if (lanes_of(stops) != 0) left &= ~stop(now, stops, k, at.accel0, at.accel1);
        }
        return left == 0 || cross_one_by_one(now, left, k);
    }

    /// An interval in which resting lanes may start. @returns lanes that are done: those that do not, and those that then
    /// slide ever faster to its end
    DAMSLIP_FOUR_INLINE int start(State& now, Four lanes, std::size_t k, Four a1)
    {
        const Four h0 = all(h_[k]), h1 = all(h_[k + 1]), dt = all(dt_);
        const Four excess0 = excess_at_rest(h0), excess1 = excess_at_rest(h1);
        const Four at_once = above(excess0, zero()), crossing = dt * (minus(excess0) / (excess1 - excess0));
        const Four starts = both(lanes, _mm256_or_pd(at_once, both(above(excess1, zero()), above(dt, crossing))));
        const Four wait = without(crossing, at_once), span = dt - wait;
        const Four accel = _mm256_max_pd(zero(), excess(h0 + (h1 - h0) * (wait / dt)) / mass_);
        const Four gets_off = both(starts, above((a1 - accel) / span, zero()));
        const Four way = span * (span * (all(2.0) * accel + a1) / all(6.0));
        const Four rate = all(0.5) * span * (accel + a1);
        begin(lanes_of(gets_off), all(static_cast<double>(k) * dt_) + wait, now.path);
        now.moving = _mm256_or_pd(now.moving, gets_off);
        now.path = now.path + both(gets_off, way);
        now.rate = chosen(gets_off, rate, now.rate);
        raise(now.peak_rate, gets_off, rate);
        return lanes_of(without(lanes, without(starts, gets_off)));
    }

    /// An interval in which sliding lanes may stop. @returns lanes that are done: those that do not, and those that then rest
    /// to its end
    DAMSLIP_FOUR_INLINE int stop(State& now, Four lanes, std::size_t k, Four a0, Four a1)
    {
        const Four h0 = all(h_[k]), h1 = all(h_[k + 1]), dt = all(dt_), jerk = (a1 - a0) / dt;
        // time_of_stop() with a rate above zero
        const Four discriminant = a0 * a0 - all(2.0) * jerk * now.rate, root = _mm256_sqrt_pd(discriminant);
        const Four pushed_back = not_above(a0, zero());
        const Four falls_to_zero = chosen(pushed_back, all(2.0) * now.rate / (root - a0), (a0 + root) / minus(jerk));
        const Four never_stops =
            _mm256_or_pd(above(zero(), discriminant), without(not_above(zero(), jerk), pushed_back));
        const Four h = chosen(never_stops, dt, _mm256_min_pd(dt, falls_to_zero));
        const Four stops = without(not_above(falls_to_zero, dt), never_stops), at_end = not_above(dt, h);
        const Four then = chosen(at_end, a1, a0 + (a1 - a0) * (h / dt));
        const Four at_stop = excess_at_rest(h0 + (h1 - h0) * (h / dt)), last = excess_at_rest(h1);
        const Four rests = _mm256_or_pd(at_end, both(not_above(at_stop, zero()), not_above(last, zero())));
        const Four done = both(both(lanes, above(now.rate, zero())), rests);
        const Four turns = both(both(done, above(a0, zero())), above(zero(), then));
        const Four crest = now.rate - a0 * a0 / (all(2.0) * jerk);
        raise(now.peak_rate, turns, crest);
        const Four way = _mm256_max_pd(zero(), h * (now.rate + h * (all(2.0) * a0 + then) / all(6.0)));
        now.path = now.path + both(done, way);
        const Four rate = _mm256_max_pd(now.rate + all(0.5) * h * (a0 + then), zero());
        raise(now.peak_rate, done, rate);
        const Four stopped = both(done, stops);
        now.rate = without(chosen(done, rate, now.rate), stopped);
        now.moving = without(now.moving, stopped);
        end(lanes_of(stopped), all(static_cast<double>(k) * dt_) + h, now.path);
        return lanes_of(done);
    }

    /// Movements of some lanes begin. @param time  [s] @param path  slipped so far [m]
    DAMSLIP_FOUR_INLINE void begin(int lanes, Four time, Four path)
    {
        for_each(lanes, time, path, [](Block& block) {
            block.start(SlipDirection::downstream);
            block.from_rest_ = false;
        });
    }
    /// They end.
    DAMSLIP_FOUR_INLINE void end(int lanes, Four time, Four path)
    {
        for_each(lanes, time, path, [](Block& block) { block.stop(); });
    }
    template <typename Event>
    DAMSLIP_FOUR_INLINE void for_each(int lanes, Four time, Four path, Event event)
    {
        alignas(32) double times[pressed_lanes], paths[pressed_lanes];
        _mm256_store_pd(times, time);
        _mm256_store_pd(paths, path);
        for (std::size_t i = 0; i < pressed_lanes; ++i) {
            if (!(lanes >> i & 1)) continue;
            blocks_[i].time_ = times[i];
            blocks_[i].path_ = paths[i];
            event(blocks_[i]);
        }
    }

    /// Crosses an interval with the blocks of some lanes, one by one. @returns false: not resolved
    DAMSLIP_AVX2 bool cross_one_by_one(State& now, int lanes, std::size_t k)
    {
        Numbers numbers;
        store(now, numbers);
        for (std::size_t i = 0; i < pressed_lanes; ++i) {
            if (!(lanes >> i & 1)) continue;
            Block& block = blocks_[i];
            put(numbers, i);
            block.time_ = static_cast<double>(k) * dt_;
            block.cross(k);
            if (block.unresolved_ || (block.moving_ && block.from_rest_)) return false;
            numbers.moving[i] = block.moving_ ? -1.0 : 0.0;
            numbers.rate[i] = block.rate_;
            numbers.path[i] = block.path_;
            numbers.peak_rate[i] = block.slid_.peak_rate;
        }
        now.moving = above(zero(), _mm256_load_pd(numbers.moving));
        now.rate = _mm256_load_pd(numbers.rate);
        now.path = _mm256_load_pd(numbers.path);
        now.peak_rate = _mm256_load_pd(numbers.peak_rate);
        return true;
    }

    static DAMSLIP_FOUR_INLINE void store(const State& now, Numbers& numbers)
    {
        _mm256_store_pd(numbers.moving, both(now.moving, all(-1.0)));
        _mm256_store_pd(numbers.rate, now.rate);
        _mm256_store_pd(numbers.path, now.path);
        _mm256_store_pd(numbers.peak_rate, now.peak_rate);
    }

    /// Into the block of a lane. One that slides downstream only has slipped as far as its path.
    void put(const Numbers& numbers, std::size_t i)
    {
        Block& block = blocks_[i];
        block.rate_ = numbers.rate[i];
        block.path_ = block.slid_.downstream = numbers.path[i];
        block.slid_.peak_rate = numbers.peak_rate[i];
        block.grow_largest();
    }

    /// @param crossed  lanes whose time is that of an event of the last interval
    DAMSLIP_AVX2 void finish(const State& now, int crossed)
    {
        Numbers numbers;
        store(now, numbers);
        for (std::size_t i = 0; i < pressed_lanes; ++i) {
            put(numbers, i);
            if (!(crossed >> i & 1)) blocks_[i].time_ = static_cast<double>(intervals_ - 1) * dt_ + dt_;
        }
    }

    /// First interval from k on, all at rest, in which one of them may start.
    DAMSLIP_AVX2 std::size_t rest(std::size_t k) const
    {
        const auto all_rest = [&](const AccelRange& range) {
            return std::all_of(blocks_.begin(), blocks_.end(), [&](const Block& block) {
                return block.upper(block.down_, range) < block.plainly_below_;
            });
        };
        if (!rest_at(k)) return k;
        while (k < intervals_) {
            if (k % SkippingMotion::block == 0) {
                k = motion_.skip(k, all_rest);
                if (k == intervals_) break;
            }
            const std::size_t end = std::min(intervals_, (k / SkippingMotion::block + 1) * SkippingMotion::block);
            while (k < end && rest_at(k + 1)) ++k;
            if (k < end) break;
        }
        return k;
    }
    DAMSLIP_FOUR_INLINE bool rest_at(std::size_t k) const
    {
        return lanes_of(above(plainly_below_, excess(all(h_[k])))) == all_lanes;
    }

    const SkippingMotion& motion_;
    const double* h_;
    std::size_t intervals_;
    double dt_;
    FourPressed& blocks_;
    Four down_, down_per_a_h_, drive_, drive_per_a_h_, normal_, normal_per_a_h_, friction_, bond_, mass_,
        plainly_below_;
};

DAMSLIP_AVX2 bool run_in_lanes(const SkippingMotion& motion, FourPressed& blocks)
{
    return PressedLanes(motion, blocks).run();
}

#else

bool run_in_lanes(const SkippingMotion&, FourPressed&)
{
    return false;
}

#endif

} // namespace damslip::sliding
