#pragma once

#include "records/read/fixed_fields.hpp"
#include "records/read/samples.hpp"
#include "records/read/time_column.hpp"

#include <span>

/// What the readers of agency formats share: samples in the file's unit made m/s^2, gaps found, channels chosen.
namespace damslip::records {

/// Values in `unit` as m/s^2. @param gap  the file's value for "no sample here", if it has one
/// @throws InputError at a gap and beyond largest_sample.
std::vector<double> samples_of(const RecordText& text, std::span<const double> values, const AccelerationUnit& unit,
                               const FieldFormat& format, std::size_t first_line, std::optional<double> gap = {});

/// The times of pairs (time, acceleration) that stand in fields from line `first` on. @param time  every second field; outlives the result
TimeColumn times_of_pairs(const RecordText& text, const FieldFormat& format, std::size_t first,
                          std::span<const double> time);

/// The next line that is not blank must not go on with numbers. @throws InputError naming the stated count.
void demand_end_of_block(const RecordText& text, std::size_t line, const Stated<std::size_t>& stated,
                         std::string_view key);

/// A count from 2 to max_samples. @throws InputError at `place`.
std::size_t checked_sample_count(const RecordText& text, double count, Place place, std::string_view key);

/// A peak that a file states beside its samples.
struct StatedPeak {
    double accel;      ///< [m/s^2]; of either sign
    double resolution; ///< half of the last digit printed, at least [m/s^2]
    std::size_t line;  ///< where it stands
};

/// The peak of the samples beside the one the file states. Up to a resolution they agree; more than 1 % apart is a
/// warning. @throws InputError naming both numbers where they are more than 10 % apart: a unit that is wrong, samples
/// that are missing or a number that was cut are worse than that, another processing is not
void check_stated_peak(const RecordText& text, Record& record, const StatedPeak& stated);

/// The channels of a file, those of equal names told apart by "(channel 3)"; with options.column the one it names:
/// by name, first word of the name ("90" of "90 DEG") or number from 1. @throws InputError: there is none of that name.
std::vector<Record> chosen_channels(const RecordText& text, std::vector<Record> records, const ReadOptions& options);

} // namespace damslip::records
