#pragma once

#include "sliding/block/line.hpp"

#include <memory>
#include <vector>

namespace damslip::sliding {

enum class SlipDirection { downstream = 1, upstream = -1 };

class SlowWater;

/// Change of the uplift of a block by the crack that its own motion opens, for each direction of sliding [N/m]. The block
/// keeps the acceleration at which sliding began, so one crack length holds for the whole slide; only the vertical
/// acceleration changes it. A block that does not slide needs no uplift of its crack.
struct OpeningUplift {
    std::vector<double> accel_v;              ///< a_v, ascending, at least one [m/s²]
    std::vector<double> downstream, upstream; ///< change of U there, linear between, constant beyond [N/m]
    /// Water that needs time to come in; the table is then its limit for fast water. Null: it is there at once.
    std::shared_ptr<const SlowWater> slow = {};

    double at(SlipDirection direction, double a_v) const;
    double per_accel_v(SlipDirection direction) const; ///< about a_v = 0 [kg/m]
    double largest() const;                            ///< of both directions, at least 0
    double largest(SlipDirection direction, double a_v_min, double a_v_max) const; ///< there; slow: with no water yet
    /// Share of the way of a_v at which the table bends next. @param from  the share so far @returns 1 where it does not
    double next_bend(const Line& a_v, double from) const;
};

} // namespace damslip::sliding
