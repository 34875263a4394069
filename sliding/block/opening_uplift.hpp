#pragma once

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
};

} // namespace damslip::sliding
