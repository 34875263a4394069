#pragma once

#include "records/record.hpp"
#include "scene/scene.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/flexible/flexible_mode.hpp"

#include <optional>
#include <string>
#include <vector>

/// Slip of a block whose yield acceleration is given: a slope, a landfill, a dam that another program has looked at.
namespace damslip {

/// What slides on the yield.
struct GivenYieldBlock {
    std::vector<sliding::YieldPoint> yield;
    std::optional<sliding::FlexibleBlock> flexible; ///< its mode; none: rigid alone
    std::optional<sliding::StrainColumn> column;    ///< in place of period and damping of `flexible`
    bool two_way = false;                           ///< slides upstream, too, at the same yield
};

/// One record by one analysis, both polarities.
struct GivenYieldRow {
    std::string record;
    std::string method;                         ///< "rigid", "decoupled", "coupled"
    double pga = 0.0;                           ///< [m/s^2]
    double yield = 0.0;                         ///< of the block that has not slipped [m/s^2]
    sliding::SlideResult normal, inverse;       ///< as recorded, and flipped
    double largest_acceleration = 0.0;          ///< of the mass on average, the larger of both; rigid: PGA [m/s^2]
    std::optional<sliding::FlexibleBlock> mode; ///< of a flexible one; of a column the one it has in this motion
    bool settled = true;                        ///< the column's strain did
    Status status() const;                      ///< of both ways the graver
    double mean_slip() const { return 0.5 * (normal.max_slip + inverse.max_slip); } ///< [m]
};

/// @param motions  horizontal components; vertical ones are not used
/// @throws InputError  as stages_of_yield(), slide() and check_flexible()
std::vector<GivenYieldRow> given_yield_runs(const GivenYieldBlock& block, const std::vector<GroundMotion>& motions,
                                            const std::vector<std::string>& methods);

} // namespace damslip
