#include "sliding/block/slide_batch.hpp"

#include "sliding/block/coasting.hpp"
#include "sliding/block/roots.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::sliding {
namespace {

/// Excess of the ground acceleration over a yield at the samples, positive where it drives the slip:
/// sign a_h - per_a_v a_v - constant, linear between samples.
struct ConstantExcess {
    const double* h;
    double sign, constant;

    double operator()(std::size_t k) const { return sign * h[k] - constant; }
    bool rests(const AccelRange& range) const { return (sign > 0.0 ? range.h_max : -range.h_min) <= constant; }
};

struct VerticalExcess {
    const double* h;
    const double* v;
    double sign, constant, per_a_v;

    double operator()(std::size_t k) const { return sign * h[k] - per_a_v * v[k] - constant; }
    bool rests(const AccelRange& range) const
    {
        const double drive = sign > 0.0 ? range.h_max : -range.h_min;
        const double relief = std::max(-per_a_v * range.v_min, -per_a_v * range.v_max);
        // Margin for round-off: what is skipped plainly rests.
        return drive + relief + 1e-14 * (std::abs(drive) + std::abs(relief) + std::abs(constant)) < constant;
    }
};

/// No motion in this direction.
struct NoExcess {
    double operator()(std::size_t) const { return -1.0; }
    bool rests(const AccelRange&) const { return true; }
};

/// Where a movement ended: time `tau` within interval `k`, or at the record's end with the rate still positive.
struct Movement {
    std::size_t k = 0;
    double tau = 0.0;
    double rate = 0.0;
    double slip = 0.0;
    double peak_rate = 0.0;
};

/// Follows a movement that starts from rest at `tau` within interval `k` with the excess y0, until it stops or the
/// record ends.
template <typename Excess>
Movement follow(const Excess& excess, std::size_t k, double tau, double y0, double dt, std::size_t intervals)
{
    double y1 = excess(k + 1), h = dt - tau, v = 0.0, s = 0.0, peak = 0.0;
    const double dt_half = 0.5 * dt, dt2_sixth = dt * dt / 6.0;
    double v1 = 0.5 * h * (y0 + y1), ds = h * h * (2.0 * y0 + y1) / 6.0;
    for (;;) {
        bool stops = v1 <= 0.0;
        if (y0 * y1 <= 0.0) {
            if (y0 > 0.0) // the rate peaks inside (or at the end of) the interval
                peak = std::max(peak, v + 0.5 * h * y0 * y0 / (y0 - y1));
            else if (y1 > 0.0) // the rate dips inside: it stops there if it would fall to zero
                stops = stops || (v > 0.0 && 2.0 * v * (y1 - y0) <= h * y0 * y0);
        }
        if (stops) {
            const double jerk = (y1 - y0) / h;
            double stop = time_of_stop(v, y0, jerk);
            if (stop == never) stop = y1 > 0.0 ? -y0 / jerk : h; // a dip that only just reaches zero
            stop = std::min(stop, h);
            s += stop * (v + stop * (3.0 * y0 + jerk * stop) / 6.0);
            return {k, tau + stop, 0.0, s, peak};
        }
        s += ds;
        v = v1;
        tau = 0.0;
        if (++k == intervals) return {k, 0.0, v, s, std::max(peak, v)};
        h = dt;
        y0 = y1;
        y1 = excess(k + 1);
        v1 = v + dt_half * (y0 + y1);
        ds = dt * v + dt2_sixth * (2.0 * y0 + y1);
    }
}

template <typename Down, typename Up>
class Integration {
public:
    Integration(const Down& down, const Up& up, const FixedYield& yield, const FixedYieldOptions& options, double dt,
                std::size_t intervals)
        : down_(down), up_(up), yield_(yield), options_(options), dt_(dt), intervals_(intervals)
    {
        const bool slides_statically = yield.downstream.law.constant < 0.0 || yield.upstream.law.constant < 0.0;
        if (slides_statically) summary_.status = Status::static_failure;
    }

    template <typename Find>
    SlipSummary run(Find&& find)
    {
        if (down_(0) > 0.0)
            k_ = slide_from(0, 0.0, SlipDirection::downstream);
        else if (up_(0) > 0.0)
            k_ = slide_from(0, 0.0, SlipDirection::upstream);
        while ((k_ = find(k_)) < intervals_) k_ = start_in(k_, 0.0);
        summary_.slip = summary_.downstream_slip - summary_.upstream_slip;
        return summary_;
    }

private:
    /// The block rests in interval k from `tau` on: starts it at the crossing if there is one. @returns the interval to
    /// go on from
    std::size_t start_in(std::size_t k, double tau)
    {
        for (const SlipDirection direction : {SlipDirection::downstream, SlipDirection::upstream}) {
            const double y1 = excess(k + 1, direction);
            if (y1 <= 0.0) continue;
            const double y0 = excess(k, direction), start = std::clamp(dt_ * (-y0 / (y1 - y0)), tau, dt_);
            if (start >= dt_) return next_after(k); // a last-digit excess: it starts on the sample
            return slide_from(k, start, direction, 0.0);
        }
        return k + 1;
    }

    std::size_t slide_from(std::size_t k, double tau, SlipDirection direction)
    {
        return slide_from(k, tau, direction, excess(k, direction));
    }

    /// Movements from there to the next rest, reversals included. @returns the interval to go on from
    std::size_t slide_from(std::size_t k, double tau, SlipDirection direction, double y0)
    {
        for (;;) {
            const Movement m = direction == SlipDirection::downstream ? follow(down_, k, tau, y0, dt_, intervals_)
                                                                      : follow(up_, k, tau, y0, dt_, intervals_);
            add(m, direction);
            if (m.k == intervals_) return intervals_;
            const SlipDirection other =
                direction == SlipDirection::downstream ? SlipDirection::upstream : SlipDirection::downstream;
            const double reversed = excess(m.k, other) + (excess(m.k + 1, other) - excess(m.k, other)) * (m.tau / dt_);
            if (!(reversed > 0.0) || m.tau >= dt_) return start_in_rest(m.k, m.tau);
            k = m.k;
            tau = m.tau;
            y0 = reversed;
            direction = other;
        }
    }

    /// After a stop inside interval k; a stop on its end sample leaves the rest to the next interval.
    std::size_t start_in_rest(std::size_t k, double tau) { return tau < dt_ ? start_in(k, tau) : next_after(k); }

    /// A stop on a sample may be a reversal there, when the ground drives the other way already.
    std::size_t next_after(std::size_t k)
    {
        if (k + 1 == intervals_) return intervals_;
        for (const SlipDirection direction : {SlipDirection::downstream, SlipDirection::upstream})
            if (excess(k + 1, direction) > 0.0) return slide_from(k + 1, 0.0, direction);
        return k + 1;
    }

    double excess(std::size_t k, SlipDirection direction) const
    {
        return direction == SlipDirection::downstream ? down_(k) : up_(k);
    }

    void add(const Movement& m, SlipDirection direction)
    {
        const Yield& yield = direction == SlipDirection::downstream ? yield_.downstream : yield_.upstream;
        double slip = yield.factor * m.slip;
        if (m.k == intervals_ && m.rate > 0.0) {
            const bool run_out = summary_.status != Status::static_failure;
            const Coasting coasting =
                coast(m.rate, yield.law.constant, yield.factor, run_out ? options_.run_out_max : 0.0);
            slip += coasting.slip;
            if (run_out && !coasting.stops) summary_.status = Status::sliding_at_end;
        }
        (direction == SlipDirection::downstream ? summary_.downstream_slip : summary_.upstream_slip) += slip;
        summary_.max_slip = std::max(summary_.max_slip, std::abs(summary_.downstream_slip - summary_.upstream_slip));
        summary_.peak_slip_rate = std::max(summary_.peak_slip_rate, yield.factor * m.peak_rate);
        ++summary_.phases;
    }

    const Down& down_;
    const Up& up_;
    const FixedYield& yield_;
    const FixedYieldOptions& options_;
    double dt_;
    std::size_t intervals_;
    std::size_t k_ = 0;
    SlipSummary summary_;
};

/// First interval from k on whose end sample drives the block either way; `motion` null: no blocks to skip.
template <typename Down, typename Up>
SlipSummary integrate(const Down& down, const Up& up, const FixedYield& yield, const FixedYieldOptions& options,
                      double dt, std::size_t intervals, const SkippingMotion* motion)
{
    const auto rests = [&](const AccelRange& range) { return down.rests(range) && up.rests(range); };
    const auto find = [&](std::size_t k) {
        while (k < intervals) {
            if (motion) k = motion->skip(k, rests);
            const std::size_t end =
                motion ? std::min(intervals, k - k % SkippingMotion::block + SkippingMotion::block) : intervals;
            for (; k < end; ++k)
                if (down(k + 1) > 0.0 || up(k + 1) > 0.0) return k;
        }
        return intervals;
    };
    return Integration<Down, Up>(down, up, yield, options, dt, intervals).run(find);
}

template <typename Down>
SlipSummary with_upstream(const Down& down, const FixedYield& yield, const FixedYieldOptions& options, double dt,
                          std::size_t intervals, const SkippingMotion* motion, auto&& make_up)
{
    if (yield.upstream.law.constant == FixedYield::never_slides)
        return integrate(down, NoExcess{}, yield, options, dt, intervals, motion);
    return integrate(down, make_up(), yield, options, dt, intervals, motion);
}

} // namespace

FixedYield fixed_yield(const RigidBlock& block, bool two_way)
{
    FixedYield yield;
    yield.downstream = yield_downstream(block);
    if (two_way) yield.upstream = yield_upstream(block);
    return yield;
}

FixedYield fixed_yield(double downstream, double upstream)
{
    return {{{downstream, 0.0}, 1.0}, {{upstream, 0.0}, 1.0}};
}

SlipSummary slide_fixed_yield(const SkippingMotion& motion, const FixedYield& yield, const FixedYieldOptions& options)
{
    const GroundMotion& ground = motion.motion();
    const double* h = ground.accel_h.data();
    const double* v = ground.accel_v.data();
    const double polarity = options.polarity;
    const SkippingMotion* blocks = options.scan == Scan::skip_blocks ? &motion : nullptr;
    const YieldLaw &down = yield.downstream.law, &up = yield.upstream.law;
    if (!motion.has_vertical())
        return with_upstream(ConstantExcess{h, polarity, down.constant}, yield, options, ground.dt, motion.intervals(),
                             blocks, [&] {
                                 return ConstantExcess{h, -polarity, up.constant};
                             });
    return with_upstream(VerticalExcess{h, v, polarity, down.constant, down.per_a_v}, yield, options, ground.dt,
                         motion.intervals(), blocks, [&] {
                             return VerticalExcess{h, v, -polarity, up.constant, up.per_a_v};
                         });
}

SlipSummary slide_constant_yield(std::span<const double> accel, double dt, double yield_down, double yield_up,
                                 const FixedYieldOptions& options)
{
    if (accel.size() < 2) return {};
    const FixedYield yield = fixed_yield(yield_down, yield_up);
    const double polarity = options.polarity;
    return with_upstream(ConstantExcess{accel.data(), polarity, yield_down}, yield, options, dt, accel.size() - 1,
                         nullptr, [&] {
                             return ConstantExcess{accel.data(), -polarity, yield_up};
                         });
}

bool never_opens(const RigidBlock& block, const SkippingMotion& motion)
{
    const BaseEquations e = base_equations(block);
    const AccelRange& r = motion.whole();
    const double h = std::max(std::abs(r.h_min), std::abs(r.h_max)); // either polarity
    const auto stays_positive = [&](const GroundLinear& normal) {
        return normal.constant - std::abs(normal.per_a_h) * h +
                       std::min(normal.per_a_v * r.v_min, normal.per_a_v * r.v_max) >
                   0.0 &&
               normal.constant > 0.0;
    };
    return stays_positive(e.normal) && stays_positive(free_normal_force(e));
}

} // namespace damslip::sliding
