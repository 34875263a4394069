#pragma once

#include "records/record.hpp"

#include <optional>

namespace damslip::records {

/// What the regressions and reports need to know of one accelerogram. All but the mean period are exact for
/// acceleration that is linear between samples, starting from rest; the record is measured as it is, without baseline
/// correction.
struct Measures {
    double duration = 0.0;             ///< of the record [s]
    double pga = 0.0;                  ///< max |a| [m/s^2]
    double pga_time = 0.0;             ///< of the first such sample [s]
    double pgv = 0.0;                  ///< max |v| [m/s]
    double pgd = 0.0;                  ///< max |u| [m]; of an uncorrected record mostly drift
    double final_velocity = 0.0;       ///< [m/s]; not zero: the record wants a baseline correction
    double final_displacement = 0.0;   ///< [m]
    double arias_intensity = 0.0;      ///< I_A [m/s]
    double cumulative_velocity = 0.0;  ///< CAV, cumulative absolute velocity [m/s]
    double duration_5_75 = 0.0;        ///< D5-75 [s]
    double duration_5_95 = 0.0;        ///< D5-95 [s]
    std::optional<double> mean_period; ///< T_m [s]; none for a record of zeros or without content in 0.25 to 20 Hz
};

/// @param record  at least 2 samples, dt > 0, all finite (as every reader leaves it).
Measures measure(const Record& record);

} // namespace damslip::records
