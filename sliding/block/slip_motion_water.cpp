#include "sliding/block/slip_motion.hpp"

#include <algorithm>
#include <cmath>

// Uplift that changes while the block slides: by the crack that opens, and by water that needs time to enter it.
namespace damslip::sliding {
namespace {

constexpr double wet_tolerance = 1e-8;        ///< of the base's length and of the block's weight, within a part
constexpr double shortest_wet_part = 0x1p-26; ///< of an interval: the water's way may break there
constexpr int most_wet_parts = 100000;

} // namespace

/// Water on its way: in parts that are short enough for its uplift to be linear, and end where the block's motion changes.
void SlipMotion::cross_wet(double start, double dt, const Line& a_h, const Line& a_v)
{
    double from = 0.0, length = 1.0;
    bool changed = false;
    for (int parts = 0; from < 1.0 && !unresolved_; ++parts) {
        unresolved_ = parts > most_wet_parts;
        const double to = from + length < 1.0 ? from + length : 1.0, h = (to - from) * dt;
        const Line part_h = part(a_h, from, to), part_v = part(a_v, from, to);
        const double bend = let_water_flow(h, part_h, part_v);
        if (bend > 1.0 && length > shortest_wet_part) {
            length *= 0.5;
            continue;
        }
        cross_part(start + from * dt, h, part_h, part_v, true, changed);
        changed = span_ > 0.0;
        longest_wet_ = std::max({longest_wet_, wet_down_.now, wet_up_.now});
        from = to - (to - from) * (span_ / h);
        if (bend < 0.2) length = std::min(2.0 * length, 1.0);
    }
}

const SlowWater* SlipMotion::slow_water() const
{
    const OpeningUplift* opening = stages_[stage_].block.opening.get();
    return opening ? opening->slow.get() : nullptr;
}

/// x_w of one end of the base a time dt later, where (a_h, a_v) is the ground's acceleration then.
double SlipMotion::wet_after(SlipDirection direction, double wet, double dt, double a_h, double a_v) const
{
    const SlowWater& water = *slow_water();
    if (moving_ && !airborne_ && direction_ != direction) return water.first(direction);
    const double come = std::min(wet + water.speed() * dt, water.length());
    if (airborne_) return come;
    const double sliding = water.sliding(direction, a_v, come).wet;
    return moving_ ? sliding : std::min(sliding, water.front(direction, a_h, a_v, wet, come));
}

/// Where the water will be at the end of a part. @returns how far its way and its uplift are from straight lines, 1: as far
/// as they may be
double SlipMotion::let_water_flow(double dt, const Line& a_h, const Line& a_v)
{
    const SlowWater& water = *slow_water();
    double bend = 0.0;
    for (const SlipDirection direction : {SlipDirection::downstream, SlipDirection::upstream}) {
        Line& wet = direction == SlipDirection::downstream ? wet_down_ : wet_up_;
        const double middle = wet_after(direction, wet.now, 0.5 * dt, a_h.at(0.5), a_v.at(0.5));
        const double at_once = wet_after(direction, wet.now, dt, a_h.end, a_v.end);
        wet.end = wet_after(direction, middle, 0.5 * dt, a_h.end, a_v.end);
        const auto uplift = [&](double a_v, double x) { return water.sliding(direction, a_v, x).change; };
        const double chord = 0.5 * (uplift(a_v.now, wet.now) + uplift(a_v.end, wet.end));
        const double off = std::abs(uplift(a_v.at(0.5), middle) - chord) / stage().block.mass / stage().block.gravity;
        // Water that the crack still held back now and no longer at the end: it went on at an instant between.
        const double way = water.speed() * dt;
        const bool held = wet_after(direction, wet.now, dt, a_h.now, a_v.now) < wet.now + way;
        const double late = held && wet.end >= wet.now + way * (1.0 - 1e-9) ? way : std::abs(wet.end - at_once);
        bend = std::max({bend, off / wet_tolerance, late / (wet_tolerance * water.length())});
    }
    return bend;
}

void SlipMotion::read_opening()
{
    opening_down_ = opening_up_ = {};
    const OpeningUplift* opening = stage().block.opening.get();
    if (!opening) return;
    const auto over = [&](SlipDirection direction) {
        if (const SlowWater* slow = opening->slow.get()) {
            const Line& wet = direction == SlipDirection::downstream ? wet_down_ : wet_up_;
            return Line{slow->sliding(direction, a_v_.now, wet.now).change,
                        slow->sliding(direction, a_v_.end, wet.end).change};
        }
        return Line{opening->at(direction, a_v_.now), opening->at(direction, a_v_.end)};
    };
    opening_down_ = over(SlipDirection::downstream);
    opening_up_ = over(SlipDirection::upstream);
}

Line SlipMotion::less_opening(const Line& normal, SlipDirection direction) const
{
    if (!stage().block.opening) return normal;
    return combine(1.0, normal, -1.0, direction == SlipDirection::downstream ? opening_down_ : opening_up_);
}

/// No water has come in, and none does while a_h and a_v stay within the ranges.
bool SlipMotion::water_stays(double a_h_min, double a_h_max, double a_v_min, double a_v_max) const
{
    const SlowWater& water = *slow_water();
    for (const SlipDirection direction : {SlipDirection::downstream, SlipDirection::upstream}) {
        const double first = water.first(direction);
        if ((direction == SlipDirection::downstream ? wet_down_ : wet_up_).now != first) return false;
        for (const double a_h : {a_h_min, a_h_max})
            for (const double a_v : {a_v_min, a_v_max})
                if (water.front(direction, a_h, a_v, first, water.length()) != first) return false;
    }
    return true;
}

} // namespace damslip::sliding
