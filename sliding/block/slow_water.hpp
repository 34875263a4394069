#pragma once

#include "sliding/block/opening_uplift.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::sliding {

/// Where the water and the crack of one end of the base are, and what that makes of the uplift.
struct WetCrack {
    double wet = 0.0;    ///< x_w, how far water has come [m]
    double tip = 0.0;    ///< x_t of the crack [m]
    double change = 0.0; ///< of the uplift against that before any motion [N/m]
};

/// Water that comes into the crack of a rigid block with a finite speed: full head to x_w, nothing from there to the tip
/// x_t, beyond it what a crack of length x_w leaves. x_w follows the tip with `speed` at most and is driven out by it.
/// While the block slides its crack is that of its own acceleration, so the change of U is one number for each x_w.
/// The heel's crack belongs to sliding downstream, the toe's to sliding upstream.
class SlowWater {
public:
    virtual ~SlowWater() = default;
    virtual double speed() const = 0;                        ///< v_w [m/s]
    virtual double length() const = 0;                       ///< of the base [m]
    virtual double first(SlipDirection direction) const = 0; ///< x_w before any motion [m]
    /// x_w of a block at rest under (a_h, a_v) [m/s²], from `now` on or back: as far as `come` where the crack opens so far,
    /// and never beyond its tip.
    virtual double front(SlipDirection direction, double a_h, double a_v, double now, double come) const = 0;
    /// The same by a table of half the resolution, which shows its error; null: there is no table.
    virtual std::shared_ptr<const SlowWater> coarser() const { return nullptr; }
    /// While it slides.
    virtual WetCrack sliding(SlipDirection direction, double a_v, double wet) const = 0;
};

/// Parts of an interval dt in which the water of the block that rocks is brought forward: it comes less than 1/128 of the
/// base in one, where that takes at most 64.
inline int parts(const SlowWater& water, double dt)
{
    return static_cast<int>(std::clamp(std::ceil(128.0 * water.speed() * dt / water.length()), 4.0, 64.0));
}

} // namespace damslip::sliding
