#pragma once

#include "records/record.hpp"

namespace damslip::records {

/// Every sample times `factor`; -1 flips the polarity. @param factor  finite
Record scaled(Record record, double factor);

/// The factor that makes max |a| = pga. @param pga  [m/s^2], > 0   @throws InputError for a record of zeros.
double factor_to_pga(const Record& record, double pga);

/// Scaled, with its sign kept, so that max |a| = pga. @param pga  [m/s^2], > 0
/// @throws InputError for a record of zeros.
Record scaled_to_pga(const Record& record, double pga);

/// Each interval cut into `parts` equal ones: the same motion exactly (acceleration is linear between samples).
/// @param parts  >= 1. @throws InputError when more than max_samples would result.
Record subdivided(const Record& record, int parts);

/// Linear interpolation at multiples of `dt`. Exact where the old dt is a whole multiple of the new; else corners of
/// the polygon are cut and the result carries a warning with both PGA. The end is dropped where the duration is no
/// multiple of dt.
/// @param dt  [s], > 0   @throws InputError when fewer than 2 or more than max_samples samples would result.
Record resampled(const Record& record, double dt);

inline constexpr std::size_t max_samples = 5'000'000; ///< of one component; readers refuse more

} // namespace damslip::records
