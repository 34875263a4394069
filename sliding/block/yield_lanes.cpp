#include "sliding/block/yield_lanes.hpp"

#include "core/version.hpp"
#include "sliding/block/coasting.hpp"
#include "sliding/block/four.hpp"

#include <algorithm>

namespace damslip::sliding {

bool fits_lanes(const SkippingMotion& motion, const FixedYield& yield, int polarity)
{
    const double constant = yield.downstream.law.constant;
    return !motion.has_vertical() && yield.upstream.law.constant == FixedYield::never_slides && constant >= 0.0 &&
           !(polarity * motion.motion().accel_h.front() - constant > 0.0);
}

namespace {

using FourYields = std::array<FixedYield, yield_lanes>;
using FourSlips = std::array<SlipSummary, yield_lanes>;

#if DAMSLIP_HAS_AVX2

/// What the four blocks do now. Of lanes that rest, rate, slip and peak mean nothing: a start sets them.
struct Movements {
    Four moving{}; ///< mask
    Four rate{};
    Four slip{}; ///< of this movement, per factor
    Four peak{}; ///< largest rate of this movement
};

/// What the movements that have ended add up to.
struct Sums {
    Four slip{};
    Four max_slip{};
    Four peak_rate{};
    Four phases{};
};

/// The same steps in the same order as follow() and Integration of fixed_yield.cpp, which is where to read them.
/// The rare cases are left to that: lanes with one are marked `odd`.
class LaneRun {
public:
    DAMSLIP_AVX2 LaneRun(const SkippingMotion& motion, const FourYields& yields, const FixedYieldOptions& options)
        : motion_(motion), h_(motion.motion().accel_h.data()), intervals_(motion.intervals()),
          polarity_(options.polarity), dt_(motion.motion().dt), dt_half_(0.5 * dt_), dt2_sixth_(dt_ * dt_ / 6.0),
          least_(yields[0].downstream.law.constant), run_out_max_(options.run_out_max), yields_(yields)
    {
        alignas(32) double constants[yield_lanes], factors[yield_lanes];
        for (std::size_t i = 0; i < yield_lanes; ++i) {
            constants[i] = yields[i].downstream.law.constant;
            factors[i] = yields[i].downstream.factor;
        }
        constants_ = _mm256_load_pd(constants);
        factors_ = _mm256_load_pd(factors);
    }

    /// @param[out] odd  lanes whose slips are not to be used, a bit each
    DAMSLIP_AVX2 FourSlips run(int& odd)
    {
        Movements now;
        Sums sums;
        int odd_lanes = 0;
        std::size_t k = 0;
        while ((k = next_start(k)) < intervals_) {
            Four y0 = excess(k);
            for (bool all_rest = false; k < intervals_ && !all_rest; ++k) {
                const Four y1 = excess(k + 1);
                const Four rate = now.rate + all(dt_half_) * (y0 + y1);
                const Four stops_or_turns = _mm256_or_pd(not_above(rate, zero()), not_above(y0 * y1, zero()));
                if (lanes_of(chosen(now.moving, stops_or_turns, above(y1, zero()))) == 0) {
                    now.slip = now.slip + (all(dt_) * now.rate + all(dt2_sixth_) * (all(2.0) * y0 + y1));
                    now.rate = rate;
                } else {
                    cross(now, sums, odd_lanes, rate, y0, y1);
                    all_rest = lanes_of(now.moving) == 0;
                }
                y0 = y1;
            }
        }
        odd = odd_lanes;
        return finish(now, sums);
    }

private:
    static DAMSLIP_FOUR_INLINE Four zero() { return _mm256_setzero_pd(); }

    DAMSLIP_FOUR_INLINE Four excess(std::size_t k) const { return all(polarity_ * h_[k]) - constants_; }

    /// An interval in which a lane starts, stops, or its excess changes sign.
    DAMSLIP_FOUR_INLINE void cross(Movements& now, Sums& sums, int& odd, Four rate, Four y0, Four y1) const
    {
        const Four h = all(dt_), turns = both(now.moving, not_above(y0 * y1, zero()));
        const Four crest = now.rate + all(0.5) * h * y0 * y0 / (y0 - y1);
        now.peak = chosen(both(turns, above(y0, zero())), _mm256_max_pd(now.peak, crest), now.peak);
        const Four dips = both(without(turns, above(y0, zero())), above(y1, zero()));
        const Four touches = both(dips, not_above(all(2.0) * now.rate * (y1 - y0), h * y0 * y0));
        const Four stops = both(now.moving, _mm256_or_pd(not_above(rate, zero()), touches));
        Four starts = without(above(y1, zero()), now.moving), from = zero();
        if (lanes_of(stops) != 0) {
            from = stop(now, sums, stops, y0, y1);
            const Four again = both(stops, above(y1, zero()));
            odd |=
                lanes_of(without(again, above(h, from))); // a stop on the end sample, where the ground drives already
            starts = _mm256_or_pd(starts, again);
            now.moving = without(now.moving, stops);
        }
        now.slip = now.slip + (h * now.rate + all(dt2_sixth_) * (all(2.0) * y0 + y1));
        now.rate = rate;
        if (lanes_of(starts) != 0) odd |= start(now, starts, from, y0, y1);
    }

    /// Ends movements within the interval. @returns when, for the lanes that stop, from the interval's begin
    DAMSLIP_FOUR_INLINE Four stop(const Movements& now, Sums& sums, Four stops, Four y0, Four y1) const
    {
        const Four h = all(dt_), jerk = (y1 - y0) / h, minus = all(-0.0);
        // time_of_stop(): the rate at the interval's begin is above zero
        const Four discriminant = y0 * y0 - all(2.0) * jerk * now.rate, root = _mm256_sqrt_pd(discriminant);
        const Four pushed_back = not_above(y0, zero());
        const Four time =
            chosen(pushed_back, all(2.0) * now.rate / (root - y0), (y0 + root) / _mm256_xor_pd(jerk, minus));
        const Four is_never = _mm256_or_pd(above(zero(), discriminant), without(not_above(zero(), jerk), pushed_back));
        const Four otherwise = chosen(above(y1, zero()), _mm256_xor_pd(y0, minus) / jerk, h);
        const Four end = _mm256_min_pd(chosen(is_never, otherwise, time), h);
        const Four slip = now.slip + end * (now.rate + end * (all(3.0) * y0 + jerk * end) / all(6.0));
        sums.slip = chosen(stops, sums.slip + factors_ * slip, sums.slip);
        sums.max_slip = _mm256_max_pd(sums.max_slip, sums.slip);
        sums.peak_rate = chosen(stops, _mm256_max_pd(sums.peak_rate, factors_ * now.peak), sums.peak_rate);
        sums.phases = sums.phases + both(stops, all(1.0));
        return end;
    }

    /// Starts lanes at the crossing, not before `from`. @returns lanes that do not get off within the interval
    DAMSLIP_FOUR_INLINE int start(Movements& now, Four starts, Four from, Four y0, Four y1) const
    {
        const Four minus_y0 = _mm256_xor_pd(y0, all(-0.0));
        const Four crossing = all(dt_) * (minus_y0 / (y1 - y0));
        const Four h = all(dt_) - _mm256_min_pd(_mm256_max_pd(crossing, from), all(dt_));
        const Four rate = all(0.5) * h * y1;
        now.rate = chosen(starts, rate, now.rate);
        now.slip = chosen(starts, h * h * y1 / all(6.0), now.slip);
        now.peak = without(now.peak, starts);
        now.moving = _mm256_or_pd(now.moving, starts);
        return lanes_of(without(starts, above(rate, zero())));
    }

    /// First interval from k on whose end sample drives the least yield; intervals() without one.
    DAMSLIP_AVX2 std::size_t next_start(std::size_t k) const
    {
        const auto rests = [&](const AccelRange& range) {
            return (polarity_ > 0.0 ? range.h_max : -range.h_min) <= least_;
        };
        while (k < intervals_) {
            k = motion_.skip(k, rests);
            const std::size_t end = std::min(intervals_, k - k % SkippingMotion::block + SkippingMotion::block);
            for (; k + yield_lanes <= end; k += yield_lanes) {
                const Four drive = all(polarity_) * _mm256_loadu_pd(h_ + k + 1) - all(least_);
                if (const int driven = lanes_of(above(drive, zero()))) return k + __builtin_ctz(driven);
            }
            for (; k < end; ++k)
                if (polarity_ * h_[k + 1] - least_ > 0.0) return k;
        }
        return intervals_;
    }

    /// The slips, with what a block that moves at the record's end does after it.
    DAMSLIP_AVX2 FourSlips finish(const Movements& now, const Sums& sums) const
    {
        alignas(32) double slip[yield_lanes], max_slip[yield_lanes], peak_rate[yield_lanes], phases[yield_lanes];
        alignas(32) double last_slip[yield_lanes], last_rate[yield_lanes], last_peak[yield_lanes];
        _mm256_store_pd(slip, sums.slip);
        _mm256_store_pd(max_slip, sums.max_slip);
        _mm256_store_pd(peak_rate, sums.peak_rate);
        _mm256_store_pd(phases, sums.phases);
        _mm256_store_pd(last_slip, now.slip);
        _mm256_store_pd(last_rate, now.rate);
        _mm256_store_pd(last_peak, now.peak);
        const int moving = lanes_of(now.moving);
        FourSlips slips;
        for (std::size_t i = 0; i < yield_lanes; ++i) {
            SlipSummary& s = slips[i];
            s.downstream_slip = slip[i];
            s.peak_slip_rate = peak_rate[i];
            s.phases = static_cast<int>(phases[i]);
            if (moving >> i & 1) {
                const Yield& yield = yields_[i].downstream;
                const Coasting coasting = coast(last_rate[i], yield.law.constant, yield.factor, run_out_max_);
                s.downstream_slip += yield.factor * last_slip[i] + coasting.slip;
                s.peak_slip_rate = std::max(s.peak_slip_rate, yield.factor * std::max(last_peak[i], last_rate[i]));
                if (!coasting.stops) s.status = Status::sliding_at_end;
                ++s.phases;
            }
            s.slip = s.downstream_slip;
            s.max_slip = std::max(max_slip[i], s.slip);
        }
        return slips;
    }

    const SkippingMotion& motion_;
    const double* h_;
    std::size_t intervals_;
    double polarity_, dt_, dt_half_, dt2_sixth_, least_, run_out_max_;
    const FourYields& yields_;
    Four constants_, factors_;
};

DAMSLIP_AVX2 FourSlips slide_four(const SkippingMotion& motion, const FourYields& yields,
                                  const FixedYieldOptions& options)
{
    int odd = 0;
    FourSlips slips = LaneRun(motion, yields, options).run(odd);
    for (std::size_t i = 0; odd != 0 && i < yield_lanes; ++i)
        if (odd >> i & 1) slips[i] = slide_fixed_yield(motion, yields[i], options);
    return slips;
}

#endif

} // namespace

FourSlips slide_in_lanes(const SkippingMotion& motion, const FourYields& yields, const FixedYieldOptions& options)
{
#if DAMSLIP_HAS_AVX2
    if (vector_level() == VectorLevel::avx2) return slide_four(motion, yields, options);
#endif
    FourSlips slips;
    for (std::size_t i = 0; i < yield_lanes; ++i) slips[i] = slide_fixed_yield(motion, yields[i], options);
    return slips;
}

} // namespace damslip::sliding
