#pragma once

#include "records/generate/envelope.hpp"
#include "records/generate/target_spectrum.hpp"
#include "records/record.hpp"

#include <cstdint>

namespace damslip::records {

/// One artificial accelerogram.
struct GenerateOptions {
    double pga = 1.0;       ///< reached exactly [m/s^2], 1e-3 ... 50
    double duration = 20.0; ///< [s], 5 ... 600, a whole number of dt
    double dt = 0.01;       ///< [s], 0.001 ... 0.01: five samples at the shortest period matched
    std::uint64_t seed = 1; ///< same seed and options, same record
    MotionComponent component =
        MotionComponent::horizontal; ///< its own random stream: both components of one seed are independent
    Envelope envelope;
    double tolerance = 0.10; ///< of the match [-], 0.01 ... 0.5
};

/// The band in which the spectrum is matched, and judged at 200 periods [s].
inline constexpr double matched_from = 0.05, matched_to = 2.0;

struct GeneratedRecord {
    Record record;
    double worst_deviation = 0.0; ///< largest |S_a/target - 1| over the band, 5 % damping [-]
    double worst_period = 0.0;    ///< where [s]
    int passes = 0;               ///< of the time-domain matching
    bool within_tolerance = false;
};

/// Artificial accelerogram whose 5 % spectrum follows `target` * pga: random phases under an envelope (SIMQKE), then
/// wavelet passes until the deviation is half the tolerance, or within it and ten passes bring nothing, or 60 are done; the best pass is kept. It ends at
/// rest (zero velocity and displacement up to the rounding of 1e-6 m/s^2), starts and ends at zero acceleration, and
/// reaches the PGA exactly. A match that misses the tolerance is returned with within_tolerance = false and a warning
/// in the record.
/// @throws InputError for options outside their range.
GeneratedRecord generate_record(const TargetSpectrum& target, const GenerateOptions& options);

/// A record of an earthquake whose 5 % spectrum is brought to `target` * pga by the same wavelet passes, with the same end: it keeps
/// its phases and its length, ends at rest and reaches the PGA exactly.
/// @param record  scaled already as near as a factor brings it: dt 0.001 ... 0.01 s, 5 s long at least @param pga  [m/s^2]
/// @param tolerance  0.01 ... 0.5 [-] @throws InputError for a record that is coarser or shorter, with the fix
GeneratedRecord matched_record(const Record& record, const TargetSpectrum& target, double pga, double tolerance);

/// Largest |S_a/(pga target) - 1| over the matched band and its period.
struct SpectrumMatch {
    double deviation = 0.0; ///< [-]
    double period = 0.0;    ///< [s]
};
SpectrumMatch spectrum_match(const std::vector<double>& accel, double dt, const TargetSpectrum& target, double pga);

} // namespace damslip::records
