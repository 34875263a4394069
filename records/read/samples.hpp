#pragma once

#include "records/read/header.hpp"
#include "records/read/read_record.hpp"
#include "records/read/unit.hpp"

/// What every format shares: the unit, the time step, numbers with their place, and the last checks.
namespace damslip::records {

/// The unit of the samples from what the file and the user say.
/// @throws InputError: neither says it, they differ, or it is unknown.
AccelerationUnit settle_unit(const RecordText& text, const std::optional<Stated<std::string>>& in_file,
                             const ReadOptions& options);

/// The time step, likewise; checked to lie in 1e-6 ... 1 s. @returns nothing when neither says it.
std::optional<double> settle_dt(const RecordText& text, const std::optional<Stated<double>>& in_file,
                                const ReadOptions& options);

/// The number at the start of `rest`, which starts at `place`. @param used  characters consumed
/// @throws InputError for what is no finite number: words, NaN, infinity, ****, overflow.
double number_at(const RecordText& text, std::string_view rest, Place place, std::size_t& used);

inline constexpr double largest_sample = 1e4; ///< [m/s^2]; a thousand g: what is larger is no ground acceleration

/// A sample of `value` units. @throws InputError beyond largest_sample. @returns [m/s^2]
double checked_sample(const RecordText& text, double value, const AccelerationUnit& unit, Place place);

/// @throws InputError when the file states a count and another number follows.
void check_count(const RecordText& text, const Stated<std::size_t>& stated, std::size_t found, std::string_view key);

/// Name, source and warnings (PGA above 3 g, constant offset) around samples in m/s^2. @throws InputError for fewer
/// than 2 or too many.
Record finished_record(const RecordText& text, std::vector<double> accel, double dt, RecordSource source);

} // namespace damslip::records
