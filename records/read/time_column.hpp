#pragma once

#include "records/read/number_table.hpp"
#include "records/read/read_record.hpp"

#include <functional>
#include <span>

namespace damslip::records {

/// Largest relative deviation of a step from the mean step that still counts as even.
inline constexpr double even_tolerance = 1e-3;

/// At least 3 values, each larger than the one before: no accelerogram does so.
bool is_rising(std::span<const double> values);

/// Times that stand in a file.
struct TimeColumn {
    std::span<const double> time;              ///< [s]
    std::size_t digits = 0;                    ///< most significant digits that one of them is printed with
    std::function<Place(std::size_t k)> place; ///< of time k
};

/// Digits of a printed number from its first that is not zero to its last, exponent left out: 3 of "0.0120".
std::size_t significant_digits(std::string_view number);

/// The uniform step of these times. They are even where all steps are equal within even_tolerance, and where all times are t_0 + k dt within
/// the rounding of their printed digits or of single precision; `stated` (file or user) is kept when it agrees within 1e-4, or within that
/// rounding.
/// @throws InputError: not rising, uneven (unless options.uneven is resample: then nothing is returned), rounded so that the step stays open
/// by more than even_tolerance, or not the stated step.
std::optional<double> step_of(const RecordText& text, const TimeColumn& column, std::optional<double> stated,
                              const ReadOptions& options);

/// Samples that stand beside their times at equal steps: as they are, or interpolated linearly at multiples of the stated step, else of the
/// smallest. @param stated  file or user @param dt  the step [s] @param warnings  what was interpolated
/// @throws InputError as step_of(), and when more than max_samples result
std::vector<double> at_even_times(const RecordText& text, const TimeColumn& column, std::vector<double> accel,
                                  std::optional<double> stated, const ReadOptions& options, double& dt,
                                  std::vector<std::string>& warnings);

} // namespace damslip::records
