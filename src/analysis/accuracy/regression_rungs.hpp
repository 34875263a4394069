#pragma once

#include "analysis/prepare/ready.hpp"

#include <optional>
#include <string>
#include <vector>

namespace damslip {

/// Slip by one regression, or by all that are valid together.
struct RegressionSlip {
    double median = 0.0;             ///< [m], P(D = 0) counted; of the ensemble the weighted median
    std::optional<double> low, high; ///< 16 and 84 % [m]; none where no sigma is published
    std::string remark;              ///< for the ensemble how many
};

/// @param id  of a regression, or "ensemble". Nothing where it is not valid here.
std::optional<RegressionSlip> regression_slip(const std::string& id, const Ready& ready, const RecordPair& record,
                                              const RigidModel& model);

/// The three regressions with the smallest published scatter among those that are valid for all records, and
/// "ensemble"; best first. Scatter is chosen by, not closeness to any result. Empty: none is valid, or the block slides
/// statically.
std::vector<std::string> best_regressions(const Scene& scene, const Records& records);

} // namespace damslip
