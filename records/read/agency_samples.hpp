#pragma once

#include "records/read/header.hpp"
#include "records/read/number_table.hpp"
#include "records/read/read_record.hpp"

#include <optional>
#include <span>
#include <vector>

/// Numbers in columns of fixed width, as Fortran programs write them: neighbours may touch, so blanks do not separate.
namespace damslip::records {

/// "(8F10.5)": 8 fields of 10 characters a line. "(10I8)", "(5E15.7)" and "(8(1PE10.4E1))" likewise.
struct FieldFormat {
    std::size_t per_line = 8; ///< 1 ... 100
    std::size_t width = 10;   ///< [characters] 1 ... 60
};

/// The last such format a line names; nothing for none.
std::optional<FieldFormat> field_format(std::string_view line);

/// The width of `per_line` fields from the length of a full line; nothing where it is no multiple.
std::optional<FieldFormat> format_of_length(std::string_view line, std::size_t per_line);

/// Where field k of a block stands whose first line is `first` (from 1).
Place place_of(const FieldFormat& format, std::size_t first, std::size_t k);

/// Up to `count` numbers from line `first` on. Stops early, without an error, at the end of the file, at a line of
/// words and at the blank rest of a line: the caller knows what a smaller number means.
/// @throws InputError for a blank field before a filled one and for what is no number in a line of numbers.
std::vector<double> read_fields(const RecordText& text, std::size_t first, std::size_t count,
                                const FieldFormat& format);

/// Line after a block of `count` fields.
std::size_t line_after(const FieldFormat& format, std::size_t first, std::size_t count);

/// The line has a letter that no number has (other than E and D, which stand in exponents).
bool has_words(std::string_view line);

/// What every format shares: the unit, the time step, numbers with their place, and the last checks.

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

/// What the readers of agency formats share: samples in the file's unit made m/s^2, gaps found, channels chosen.

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
