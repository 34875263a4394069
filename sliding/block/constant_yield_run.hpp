#pragma once

#include "sliding/block/permanent_contact.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

namespace damslip::sliding {

/// Downstream only, under a horizontal motion, with a constant yield: the excess a_h - a_y is all that its equation needs,
/// and between events the sums have no division, so it takes half the time of PermanentContact; round-off differs.
/// @tparam Number  double, or several side by side
template <class Number>
class ConstantYieldRun : Batch<Number> {
public:
    using Batch<Number>::size;

    /// @param yields  `size` of them, the first is the least
    ConstantYieldRun(std::span<const ConstantYield> yields, const ContactMotion& motion, std::size_t intervals,
                     const ConstantYieldOptions& options)
        : yields_(yields), motion_(motion), intervals_(intervals), options_(options), polarity_(options.polarity),
          least_(yields.front().acceleration)
    {
        for (std::size_t i = 0; i < size; ++i) {
            set(yield_, i, yields[i].acceleration);
            set(factor_, i, yields[i].factor);
        }
    }

    void run(std::span<SlipSummary> results)
    {
        const double dt = motion_.dt, dt_half = 0.5 * dt, dt2_sixth = dt * dt / 6.0;
        moving_ = excess(0) > all(0.0);
        for (std::size_t k = 0; any_of(moving_) || (k = next_start(k)) < intervals_;) {
            Number y0 = excess(k);
            do {
                const Number y1 = excess(k + 1), rate = rate_ + dt_half * (y0 + y1);
                const Number way = dt * rate_ + dt2_sixth * (2.0 * y0 + y1);
                const Mask turns = y0 * y1 <= all(0.0), ends = rate <= all(0.0), drives = y1 > all(0.0);
                if (any_of((moving_ & (turns | ends)) | (inverse(moving_) & drives)))
                    cross(y0, y1, rate, way);
                else {
                    slip_ += way;
                    rate_ = rate;
                }
                y0 = y1;
            } while (++k < intervals_ && any_of(moving_));
            if (k == intervals_) break;
        }
        for (std::size_t i = 0; i < size; ++i) results[i] = summary(i);
    }

private:
    using typename Batch<Number>::Mask;
    using Batch<Number>::choose;
    using Batch<Number>::any_of;
    using Batch<Number>::square_root;
    using Batch<Number>::set;
    using Batch<Number>::get;

    static Number all(double x) { return Number{} + x; }
    static Mask inverse(Mask mask) { return !mask; }
    static Number larger(Number a, Number b) { return choose(a < b, b, a); }
    static Number smaller(Number a, Number b) { return choose(b < a, b, a); }
    Number excess(std::size_t k) const { return polarity_ * motion_.a_h[k] - yield_; }

    /// First interval from k on, all blocks at rest, whose end sample drives the least yield.
    std::size_t next_start(std::size_t k) const
    {
        const auto rests = [this](const AccelRange& r) { return (polarity_ > 0.0 ? r.h_max : -r.h_min) <= least_; };
        while (k < intervals_) {
            std::size_t end = intervals_;
            if (motion_.ranges) {
                k = motion_.ranges->skip(k, rests);
                end = std::min(intervals_, k - k % SkippingMotion::block + SkippingMotion::block);
            }
            for (; k + size <= end; k += size) // as many samples at a time as there are blocks
                if (const auto drives = polarity_ * this->load(motion_.a_h + k + 1) - least_ > all(0.0); any_of(drives))
                    return k + this->first_of(drives);
            for (; k < end; ++k)
                if (polarity_ * motion_.a_h[k + 1] - least_ > 0.0) return k;
        }
        return intervals_;
    }

    /// An interval in which a block starts or stops, or its excess changes sign. A block that starts on the end sample goes
    /// on from there with a rate of zero. @param rate, way  at its end and over it, of blocks that go on
    void cross(Number y0, Number y1, Number rate, Number way)
    {
        const Number none = all(0.0), h = all(motion_.dt);
        const Mask turns = moving_ & (y0 * y1 <= none);
        const Number crest = rate_ + 0.5 * h * y0 * y0 / (y0 - y1);
        peak_ = choose(turns & (y0 > none), larger(peak_, crest), peak_);
        const Mask touches =
            turns & (y0 <= none) & (y1 > none) & (rate_ > none) & (2.0 * rate_ * (y1 - y0) <= h * y0 * y0);
        const Mask stops = moving_ & ((rate <= none) | touches);
        Number from = none;
        if (any_of(stops)) from = choose(stops, stop(stops, y0, y1), none);
        const Mask starts = (y1 > none) & (stops | inverse(moving_));
        slip_ += way;
        rate_ = rate;
        moving_ = moving_ & inverse(stops);
        if (!any_of(starts)) return;
        const Number left = h - smaller(larger(h * (-y0 / (y1 - y0)), from), h);
        rate_ = choose(starts, 0.5 * left * y1, rate_);
        slip_ = choose(starts, left * left * y1 / 6.0, slip_);
        peak_ = choose(starts, none, peak_);
        moving_ = moving_ | starts;
    }

    /// Ends movements within the interval. @returns when, from its begin
    Number stop(Mask stops, Number y0, Number y1)
    {
        const Number none = all(0.0), h = all(motion_.dt), jerk = (y1 - y0) / h;
        const Number discriminant = y0 * y0 - 2.0 * jerk * rate_, root = square_root(larger(discriminant, none));
        const Mask pushed_back = y0 <= none;
        const Number time = choose(pushed_back, 2.0 * rate_ / (root - y0), (y0 + root) / -jerk);
        const Mask is_never = (discriminant < none) | (inverse(pushed_back) & (jerk >= none));
        const Number otherwise = choose(y1 > none, -y0 / jerk, h); // a dip that only just reaches zero
        const Number end = smaller(choose(is_never, otherwise, time), h);
        const Number slip = slip_ + end * (rate_ + end * (3.0 * y0 + jerk * end) / 6.0);
        total_ = choose(stops, total_ + factor_ * slip, total_);
        peak_rate_ = choose(stops, larger(peak_rate_, factor_ * peak_), peak_rate_);
        phases_ = choose(stops, phases_ + 1.0, phases_);
        return end;
    }

    /// With what a block that moves at the last sample does after it: the ground accelerates no more.
    SlipSummary summary(std::size_t i) const
    {
        const double yield = yields_[i].acceleration, factor = yields_[i].factor, rate = get(rate_, i);
        SlipSummary s;
        if (yield < 0.0) s.status = Status::static_failure;
        s.downstream_slip = get(total_, i);
        s.peak_slip_rate = get(peak_rate_, i);
        s.phases = static_cast<int>(get(phases_, i));
        if (get(moving_, i) && rate > 0.0) {
            const double longest = yield < 0.0 ? 0.0 : options_.run_out_max;
            const bool stops = yield > 0.0 && rate <= yield * longest;
            s.downstream_slip += factor * get(slip_, i) + (stops ? factor * rate * rate / (2.0 * yield)
                                                                 : factor * longest * (rate - 0.5 * yield * longest));
            s.peak_slip_rate = std::max(s.peak_slip_rate, factor * std::max(get(peak_, i), rate));
            if (!stops && yield >= 0.0) s.status = Status::sliding_at_end;
            ++s.phases;
        }
        s.slip = s.max_slip = s.downstream_slip;
        return s;
    }

    std::span<const ConstantYield> yields_;
    ContactMotion motion_;
    std::size_t intervals_;
    ConstantYieldOptions options_;
    double polarity_, least_;
    Number yield_{}, factor_{};

    // Of this movement, per factor: a start sets them.
    Mask moving_{};
    Number rate_{}, slip_{}, peak_{};
    // Of the movements that have ended.
    Number total_{}, peak_rate_{}, phases_{};
};

} // namespace damslip::sliding
