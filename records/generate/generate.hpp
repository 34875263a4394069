#pragma once

#include "core/csv.hpp"
#include "records/generate/wavelet_match.hpp"
#include "records/record.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace damslip::records {

enum class EnvelopeShape {
    compound, ///< quadratic rise, level, exponential decay to 5 % at the end: Jennings, Housner & Tsai (1968)
    trapezoid ///< linear rise, level, linear fall to zero at the end
};

/// How the strength of shaking varies over the record, between 0 and 1.
struct Envelope {
    EnvelopeShape shape = EnvelopeShape::compound;
    double rise = 0.1;  ///< end of the rise, fraction of the duration, > 0
    double level = 0.5; ///< end of the strong part, fraction of the duration, rise <= level < 1
};

/// Values at n samples. The last 2.5 % are brought to zero (half a cosine), so that both ends are exactly zero.
std::vector<double> envelope_samples(const Envelope& envelope, std::size_t n);

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

/// Adds sin^2(pi x)(c0 + c1 x), x = t/duration, such that the piecewise-linear record ends with zero velocity and
/// displacement.
void end_at_rest(std::vector<double>& accel);

/// Makes max |a| equal to `pga`, not by scaling but locally: the largest sample is raised if it is below, samples above are cut, and
/// each change d of a sample is paid by -d/2 at both neighbours, which leaves final velocity and displacement as they are. A factor
/// near 1 does the rest. @param accel  not zero throughout, ends at rest
void set_peak(std::vector<double>& accel, double pga);

/// Rounds to multiples of 1e-6 m/s^2, towards zero where `pga` would be passed; the sample of largest |a| keeps its value. Files stay
/// small, and differences in the last digits of mathematical libraries do not show.
void round_samples(std::vector<double>& accel, double pga);

/// The two stages of generate().

/// What the first stage makes its record from.
struct RandomPhaseOptions {
    double dt = 0.01; ///< [s]
    double pga = 1.0; ///< [m/s^2]
    std::uint64_t seed = 1;
    std::uint64_t stream = 0; ///< component: independent phases of one seed
    int iterations = 12;
};

/// Sum of sines with random phases under an envelope, in the manner of SIMQKE (Gasparini & Vanmarcke 1976): amplitudes
/// start from the power spectrum that belongs to the target spectrum, and are multiplied by target over computed
/// spectrum at their period. Lines from 0.15 Hz to 0.8 of the Nyquist frequency (at most 40 Hz). The result follows the
/// target within some 10 to 20 %.
/// @param envelope  one value per sample   @returns acceleration [m/s^2], as long as the envelope
std::vector<double> random_phase_record(const TargetSpectrum& target, std::span<const double> envelope,
                                        const RandomPhaseOptions& options);

/// One pass of spectral matching in the time domain: Lilhanand & Tseng (1988) with the tapered cosine wavelets of Al
/// Atik & Abrahamson (2010). For each period wavelets are placed so that their oscillator answers them at the times of
/// its own positive and negative peak; the amplitudes that bring the larger peaks 70 % of their way to the target
/// together, while those of the other sign stay, solve a linear system (regularised least squares). PGA is one more
/// equation. Peaks that were lower before may surface, so the caller repeats passes and drops those that did harm.
/// @param accel  [m/s^2], changed in place; both ends keep their values
/// @param pga    [m/s^2]   @param periods  T [s] to match, rising
/// @param regularisation  [-], > 0; small: bold steps (1e-5), large: small ones (1)
void match_by_wavelets(std::vector<double>& accel, double dt, const TargetSpectrum& target, double pga,
                       std::span<const double> periods, double regularisation);

/// Artificial record, or pair of records, that a list of seeds names; its files are there.
struct SeededPair {
    std::string name, event;
    std::filesystem::path horizontal;
    std::optional<std::filesystem::path> vertical;
    double weight = 1.0; ///< > 0 [-]
};

struct SeededSuite {
    std::vector<SeededPair> pairs;
    std::filesystem::path folder; ///< where the records are
    std::size_t made = 0;         ///< pairs that were made now; the others were there
};

/// The columns of a list of seeds.
inline constexpr std::string_view seed_columns =
    "name, seed, pga_m_s2 and, as far as they are wanted, target, ground, duration_s, dt_s, tolerance, vertical, "
    "vertical_pga_m_s2, vertical_tolerance, event, weight";

/// What a list of records or seeds has to be: columns of `known` alone, each once, those of `needed` among them, and in no line more fields than
/// headings, as a decimal comma makes them. Shorter lines leave the last columns empty. @param columns  all of them, for messages
/// @throws InputError with file and line
void check_list(const std::filesystem::path& list, const CsvTable& table, const std::vector<std::string>& known,
                const std::vector<std::string>& needed, std::string_view columns);

/// Whether the heading of a CSV says that it is a list of seeds: it has a column `seed`.
bool is_seed_list(std::string_view text);

/// The records of a list of seeds, made as `damslip record generate` makes them. They go to the folder beside the list that has its name
/// without extension, or, where that cannot be written, to the cache folder; what is there and was made of the same line is kept, so that only
/// the first use takes time. Columns: name of the files, NAME_h.csv and NAME_v.csv; seed, a whole number >= 0; pga_m_s2 of the horizontal component;
/// target: rock (usual), ec8-1, ec8-2 or a file from the list's folder; ground A (usual) ... E; duration_s, 20; dt_s, 0.01; tolerance of the
/// match, 0.1; vertical: yes (usual) or no, with a random stream of its own, its PGA and tolerance those of the horizontal unless said;
/// event, the name; weight, 1.
/// @param jobs  threads; 0: all cores
/// @throws InputError with file and line for what is not allowed, and for a seed whose spectrum misses the tolerance
SeededSuite records_of_seeds(const std::filesystem::path& list, int jobs = 0);

} // namespace damslip::records
