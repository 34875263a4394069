#pragma once

#include "analysis/sweep/slip_history.hpp"
#include "analysis/sweep/sweep_identity.hpp"

#include <array>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace damslip {

/// What one row made of an anchor.
struct RowAnchor {
    std::string name;
    double largest_force = 0.0; ///< [N/m]
    std::string state;          ///< anchor_end()

    friend bool operator==(const RowAnchor&, const RowAnchor&) = default;
};

/// What a method gave for one row; what it does not give is empty.
struct RowResults {
    std::optional<double> slip, max_slip, upstream_slip, slip_low, slip_high; ///< [m]
    std::optional<double> slip_error, truncation_error;                       ///< [m]
    std::optional<double> critical_friction;                                  ///< [-]
    std::string status;              ///< of the list, or a remark of the method
    std::optional<double> lift_slip; ///< [m]
    // Of finite elements, see fe2d::RunOutFigures.
    std::optional<double> walked;               ///< at least, by a dam that goes on by itself [m]
    std::optional<double> thrust_over_friction; ///< [-]
    std::optional<double> hops;
    std::optional<double> hop_frequency;              ///< [Hz]
    std::optional<double> unloaded_share;             ///< [-]
    std::optional<double> end_rate;                   ///< [m/s]
    std::optional<double> slip_shaking, slip_at_rest; ///< [m]
    std::optional<double> opening;                    ///< largest of the base on the way [m]; of fragility
    std::optional<double> factor_after;               ///< sliding factor after the earthquake [-]; of fragility
    // Of the rigid block and of finite elements.
    std::vector<double>
        event_slips;                ///< of a sequence: slip when the next event begins, as far as they were reached [m]
    std::vector<RowAnchor> anchors; ///< those that the method has; empty: none, or no slip

    friend bool operator==(const RowResults&, const RowResults&) = default;
};

/// The numbers of a row, in the order of a journal's line.
inline constexpr std::array<std::optional<double> RowResults::*, 19> row_numbers = {
    &RowResults::slip,
    &RowResults::max_slip,
    &RowResults::upstream_slip,
    &RowResults::slip_low,
    &RowResults::slip_high,
    &RowResults::slip_error,
    &RowResults::truncation_error,
    &RowResults::critical_friction,
    &RowResults::lift_slip,
    &RowResults::walked,
    &RowResults::thrust_over_friction,
    &RowResults::hops,
    &RowResults::hop_frequency,
    &RowResults::unloaded_share,
    &RowResults::end_rate,
    &RowResults::slip_shaking,
    &RowResults::slip_at_rest,
    &RowResults::opening,
    &RowResults::factor_after};

struct FinishedRow {
    std::size_t id = 0;
    bool good = true; ///< false: the method did not end properly
    RowResults results;
    SlipHistory history = {}; ///< of slides and FE runs of sweeps of few rows
};

enum class JournalStart {
    fresh, ///< an unfinished journal in its place is refused, one that is done or empty replaced
    resume ///< finished rows are read; without a journal as fresh
};

/// Finished rows of a sweep in a file, so that a stop at any moment loses none of them.
///
/// A head with the sweep's identity, written whole; then one line per row, appended as rows finish: a checksum (64
/// bits) and the row as JSON, numbers with all digits; "done" when the table is written. A
/// line that was torn by the stop is cut off on resuming; one whose checksum is wrong is left aside, and its row is
/// computed again. A line "begun" with the ids of rows that start together says on resuming which were stopped on the way.
class Journal {
public:
    /// @throws InputError for a journal of other inputs (says which differ), for one that another process has open, for
    /// an unfinished one when starting fresh, and where it cannot be written.
    Journal(std::filesystem::path file, const SweepIdentity& identity, const Shard& shard, JournalStart start);
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    std::size_t finished() const { return finished_.size(); } ///< rows as found when opened
    /// Of those, the ones with ids first ... last, ascending; read from the file, which alone holds them.
    std::vector<FinishedRow> finished_rows(std::size_t first, std::size_t last) const;
    std::size_t damaged() const { return damaged_; } ///< lines left aside, torn last line included

    /// How often rows that are not finished were begun, by id: a run of them was stopped so many times.
    const std::map<std::size_t, int>& stopped() const { return stopped_; }

    /// Rows that go through the earthquake together from now on. From any thread.
    void begin(std::span<const std::size_t> ids);

    /// From any thread; in the file when this returns. @throws InputError when the disk is full.
    void append(std::span<const FinishedRow> rows);

    void mark_done(); ///< the table is written: a fresh start may replace this journal

private:
    void write(std::string_view lines);
    void read(const std::string& head, std::size_t rows);

    std::filesystem::path file_;
    int descriptor_ = -1;
    struct Place {
        std::size_t id = 0;
        std::uint64_t byte = 0;
        std::uint32_t length = 0;
    };
    std::vector<Place> finished_; ///< by id
    std::size_t rows_ = 0;        ///< of the whole sweep
    std::map<std::size_t, int> stopped_;
    std::size_t damaged_ = 0, whole_bytes_ = 0;
    bool done_ = false;
    std::mutex mutex_;
};

/// "results.csv" -> "results.csv.journal".
std::filesystem::path journal_of(const std::filesystem::path& csv);

} // namespace damslip
