#pragma once

#include "records/read/number_table.hpp"
#include "records/read/read_record.hpp"

#include <span>

namespace damslip::records {

/// Largest relative deviation of a step from the mean step that still counts as even.
inline constexpr double even_tolerance = 1e-3;

/// At least 3 values, each larger than the one before: no accelerogram does so.
bool is_rising(std::span<const double> values);

/// The uniform step of a time column; `stated` (file or user) is kept when it agrees within 1e-4.
/// @param column  of the time in the table, for places in messages
/// @throws InputError: not rising, uneven (unless options.uneven is resample: then nothing is returned), or not the
/// stated step.
std::optional<double> step_of(const RecordText& text, const NumberTable& table, std::size_t column,
                              std::span<const double> time, std::optional<double> stated, const ReadOptions& options);

/// Linear interpolation of (time, accel) at multiples of `dt`, or of the smallest step, from the first time on.
/// @throws InputError when more than max_samples result.
std::vector<double> at_even_times(const RecordText& text, std::span<const double> time, std::span<const double> accel,
                                  double& dt);

} // namespace damslip::records
