#pragma once

#include "analysis/prepare/rigid_model.hpp"
#include "records/record.hpp"
#include "scene/scene.hpp"
#include "sliding/block/rigid_block.hpp"
#include "sliding/block/slide.hpp"
#include "sliding/empirical/regression.hpp"
#include "sliding/flexible/flexible_mode.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace damslip {

/// Id of the row of all valid regressions.
inline constexpr std::string_view weighted_median_id = "weighted-median";

/// One regression, or all valid ones weighted, for one record.
struct RegressionRow {
    std::string record;
    std::string id; ///< "jibson-1998", "weighted-median"
    std::string model;
    std::optional<double> median, low, high; ///< 50, 16 and 84 % of the slip, P(D = 0) counted [m]; none: no value
    std::optional<double> nonzero_median;    ///< of slips above zero [m]
    std::optional<double> zero_probability;  ///< P(D = 0) [-], where the model has one
    bool valid = false;                      ///< has a value from inputs within their ranges
    std::string status;                      ///< in three words at most: "valid", "outside its range"
    std::optional<double> weight;            ///< share in the weighted median [-]; none: does not count
    std::string remark;                      ///< numbers of the status
};

/// Every regression in table order, then all valid ones weighted. @param weights  none: equal ones
std::vector<RegressionRow> regression_rows(const std::string& record, const sliding::RegressionInputs& inputs,
                                           const std::vector<sliding::RegressionWeight>& weights = {});

/// Those of every record of the scene, with its weights. @throws InputError for a weight of an id that no regression has
std::vector<RegressionRow> regression_rows(const Scene& scene, const RigidModel& model,
                                           const std::vector<RecordPair>& records);

/// Least yield coefficient a_c [-] at which the regression's median slip, P(D = 0) counted, is `slip` [m] at most: the seismic
/// coefficient for that allowable slip, to 1e-9. Medians fall with a_c; some of them at once to zero, where the yield reaches the demand.
/// @param inputs  their yield coefficient is not used
/// @returns nothing where an input is missing or where even the smallest a_c its data reach, or 1e-4 without such a range, slips less
std::optional<double> yield_coefficient_for(const sliding::Regression& regression, sliding::RegressionInputs inputs,
                                            double slip);

/// Slip of a block whose yield acceleration is given: a slope, a landfill, a dam that another program has looked at.

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
