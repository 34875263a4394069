#pragma once

#include "verification/external/external.hpp"
#include "verification/external/slammer_scheme.hpp"

#include <memory>
#include <optional>

namespace damslip::external {

/// One analysis of the set: the motion as its authors scaled it, and what they found.
struct SlammerAnalysis {
    std::string id;                                     ///< "analysis_0012_coupled"
    std::string words;                                  ///< record, peak, column and yield for people
    std::string method;                                 ///< "rigid", "decoupled", "coupled"
    std::shared_ptr<const std::vector<double>> samples; ///< of the record [g]
    double dt = 0.0;                                    ///< [s]
    double scale = 0.0;                                 ///< on the samples [m/s^2 per g]
    double yield = 0.0;                                 ///< [m/s^2]
    double published[2] = {};                           ///< slip under the motion and under its inverse [cm]
    double height = 0.0;                                ///< of the column [m]; 0: rigid
    std::optional<double> k_max;                        ///< [g]
    double final_velocity = 0.0, final_damping = 0.0;   ///< what the slips were computed with [m/s], [-]
    std::optional<StrainColumn> strain;                 ///< of an equivalent-linear one

    std::vector<double> accel(double polarity) const; ///< [m/s^2]
    SlammerColumn column() const;
};

inline constexpr const char* slammer_file = "slammer_results.json.gz"; ///< beside it: records/NAME.csv, time and g

/// All 2,610. @throws InputError naming the file that is missing or is not what it should be
std::vector<SlammerAnalysis> read_slammer_set(const std::filesystem::path& folder);

/// The set as a source: slips in both directions, largest drive, strain-compatible velocity and damping.
Source slammer_source();

} // namespace damslip::external
