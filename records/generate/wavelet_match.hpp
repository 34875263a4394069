#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace damslip::records {

/// Shape of an elastic acceleration spectrum at 5 % damping, normalised to the peak ground acceleration.
struct TargetSpectrum {
    std::string name;                                   ///< "Eurocode 8 type 1, ground A, horizontal"
    std::function<double(double period)> amplification; ///< S_a(T)/PGA [-], T >= 0 [s]; 1 at T = 0
};

enum class Eurocode8Type { type_1, type_2 }; ///< type 2: surface-wave magnitude not above 5.5
enum class GroundType { A, B, C, D, E };     ///< A: rock ... E: 5 to 20 m of soil on rock
enum class MotionComponent { horizontal, vertical };

/// EN 1998-1:2004, 3.2.2.2 (horizontal, table 3.2 and 3.3: PGA = a_g S) and 3.2.2.3 (vertical, table 3.4: PGA = a_vg;
/// the ground type does not enter), eta = 1. Beyond 4 s, where the standard ends, its last branch T^-2 goes on.
TargetSpectrum eurocode8_spectrum(Eurocode8Type type, GroundType ground, MotionComponent component);

/// A rock spectrum built as in the studies of the 1970s that McGuire (1974) belongs to: straight lines on log paper
/// whose three levels are amplified peak ground acceleration, velocity and displacement. The numbers are those of
/// Newmark & Hall (1982), competent rock, 5 % damping, median: amplification 2.12, 1.65, 1.39; v/a = 36 in/s per g, a
/// d/v^2 = 6; S_a = PGA up to 33 Hz, from 8 Hz on the amplified level. Corners: 0.030, 0.125, 0.454, 2.95 s. The
/// spectrum of the Austrian dam guideline (2001) that Goldgruber (2015) used, also after McGuire, is not reproduced:
/// its corner values are not given there.
TargetSpectrum rock_spectrum();

/// One row of a user's spectrum.
struct SpectrumRow {
    double period = 0.0;       ///< T [s], >= 0, rising
    double acceleration = 0.0; ///< S_a, any unit, > 0
};

/// A table, interpolated linearly on log-log scales (from T = 0 to the second row linearly), divided by its first row,
/// which is the PGA: T of the first row is at most 0.03 s. Beyond the last row S_a falls with 1/T^2.
/// @throws InputError (file `name`) for fewer than 2 rows, periods that do not rise, values that are not positive, a
/// late first row or a last row before 2 s.
TargetSpectrum table_spectrum(std::span<const SpectrumRow> rows, std::string name);

/// A user's target spectrum: two columns, period [s] and spectral acceleration at 5 % damping in any unit (only its shape counts), the
/// first row being the PGA. A heading line may say so in other words and units, and in another order: "T [ms];Sa [%g]", "frequency_hz,psa_m_s2"; of
/// frequencies the highest is the PGA. Named after the file.
/// @throws InputError for anything else than two columns of numbers, headings that are neither, velocities and displacements, and as
///         table_spectrum does
TargetSpectrum read_target_spectrum(const std::filesystem::path& path);
TargetSpectrum parse_target_spectrum(std::string_view content, std::string_view file_name);

/// The spectrum that a word names: rock, ec8-1 or ec8-2; for any other word, the spectrum in `file`.
/// @param ground, component  of ec8 @returns nullopt where the word names no spectrum and `file` does not exist
/// @throws InputError as read_target_spectrum()
std::optional<TargetSpectrum> find_target_spectrum(std::string_view word, const std::filesystem::path& file,
                                                   GroundType ground, MotionComponent component);

/// Linear equations, more or fewer than unknowns, solved in the least-squares sense with small unknowns preferred.
class RegularisedLeastSquares {
public:
    explicit RegularisedLeastSquares(std::size_t unknowns)
        : unknowns_(unknowns), normal_(unknowns * unknowns, 0.0), right_(unknowns, 0.0)
    {
    }

    /// One equation: sum coefficients[j] x[j] = value.
    void add(std::span<const double> coefficients, double value);

    /// x that minimises |C x - r|^2 + lambda |x|^2, lambda = regularisation * mean diagonal of C^T C. @param
    /// regularisation  > 0
    std::vector<double> solve(double regularisation) const;

private:
    std::size_t unknowns_;
    std::vector<double> normal_; ///< C^T C, lower triangle by rows
    std::vector<double> right_;  ///< C^T r
};

/// Uniform numbers in [0, 1), the same on every machine: the standard fixes the sequence of mt19937_64 but not its
/// distributions, so the upper 53 bits are mapped here. `stream` tells independent uses of one seed apart.
class UniformRandom {
public:
    UniformRandom(std::uint64_t seed, std::uint64_t stream) : engine_(mixed(mixed(seed) + stream)) {}
    double next() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

private:
    /// SplitMix64 (Steele, Lea & Flood 2014): neighbouring seeds give unrelated engines.
    static std::uint64_t mixed(std::uint64_t x)
    {
        x += 0x9e3779b97f4a7c15u;
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
        return x ^ (x >> 31);
    }
    std::mt19937_64 engine_;
};

} // namespace damslip::records
