#pragma once

#include "analysis/sweep/fe_sweep.hpp"

#include <array>
#include <chrono>
#include <map>
#include <memory>
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
    std::string state;          ///< at the end: "snapped", "yielded" (at any time), else "elastic"

    friend bool operator==(const RowAnchor&, const RowAnchor&) = default;
};

/// What a method gave for one row; what it does not give is empty.
struct RowResults {
    std::optional<double> yield;                                              ///< acceleration, downstream [m/s^2]
    std::optional<double> slip, max_slip, upstream_slip, slip_low, slip_high; ///< [m]
    std::optional<double> slip_error, truncation_error;                       ///< [m]
    std::optional<double> critical_friction;                                  ///< [-]
    std::string status;              ///< of the list, or a remark of the method
    std::optional<double> lift_slip; ///< [m]
    // Of finite elements, see fe2d::RunOutFigures.
    std::optional<double> slid_at_least;        ///< of a dam whose sliding feeds itself: its slip when the run ended [m]
    std::optional<double> thrust_over_friction; ///< [-]
    std::optional<double> lift_offs;
    std::optional<double> lift_off_frequency;         ///< [Hz]
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

/// A number of a row and its column, in the database and in the CSV. The names of columns stay while those of members follow
/// docs/symbols.md: a sweep that an earlier version stopped goes on, and questions to databases still work.
struct RowNumber {
    const char* column;
    std::optional<double> RowResults::*value;
};

inline constexpr auto row_numbers =
    std::to_array<RowNumber>({{"yield_acceleration_m_s2", &RowResults::yield},
                              {"slip_m", &RowResults::slip},
                              {"max_slip_m", &RowResults::max_slip},
                              {"upstream_slip_m", &RowResults::upstream_slip},
                              {"slip_low_m", &RowResults::slip_low},
                              {"slip_high_m", &RowResults::slip_high},
                              {"slip_error_m", &RowResults::slip_error},
                              {"truncation_error_m", &RowResults::truncation_error},
                              {"critical_friction", &RowResults::critical_friction},
                              {"lift_joint_slip_m", &RowResults::lift_slip},
                              {"walked_at_least_m", &RowResults::slid_at_least},
                              {"thrust_over_friction", &RowResults::thrust_over_friction},
                              {"hops", &RowResults::lift_offs},
                              {"hop_frequency_Hz", &RowResults::lift_off_frequency},
                              {"unloaded_share", &RowResults::unloaded_share},
                              {"end_rate_m_s", &RowResults::end_rate},
                              {"shaking_slip_m", &RowResults::slip_shaking},
                              {"run_out_slip_m", &RowResults::slip_at_rest},
                              {"opening_m", &RowResults::opening},
                              {"factor_after", &RowResults::factor_after}});

struct FinishedRow {
    std::size_t id = 0;
    bool good = true; ///< false: the method did not end properly. A stored row: as its status says
    RowResults results;
    SlipHistory history = {}; ///< of slides and FE runs of sweeps of few rows
};

enum class StoreStart {
    fresh, ///< an unfinished store in its place is refused, one that is done or empty is replaced
    resume ///< finished rows are kept; without a store as fresh
};

class Database;
class RowInserter;

/// Finished rows of a sweep in an SQLite database, so that a stop at any moment loses none of them (docs/sweeps.md).
///
/// Tables: `sweep` (identity, part and axes, one row), `rows` (a column for each result), `axis` (values of the axes),
/// `begun` (runs that were stopped); the view `results` has rows beside their values on the axes. Doubles keep their
/// bits; NaN is stored as none. Each row has a checksum over its columns: a damaged row is computed again, a damaged
/// file refused. One process at a time has the database open.
class ResultStore {
public:
    /// @throws InputError for a store of other inputs (names those that differ), for one that another process has open,
    /// for an unfinished one when starting fresh, for what is no store, and where it cannot be written.
    ResultStore(const std::filesystem::path& file, const SweepIdentity& identity, const Shard& shard, StoreStart start);
    /// One that is there, to be read. @throws InputError
    explicit ResultStore(const std::filesystem::path& file);
    ~ResultStore();

    const std::filesystem::path& file() const;
    const SweepIdentity& identity() const { return identity_; }
    const Shard& shard() const { return shard_; }
    const std::string& axes() const { return axes_; } ///< as described
    bool done() const { return done_; }

    std::size_t finished() const { return finished_; }      ///< whole rows as found when opened
    std::size_t damaged() const { return damaged_.size(); } ///< rows that are not as they were written: left out
    /// Finished rows with ids first ... last, ascending. @throws InputError for a damaged one
    std::vector<FinishedRow> rows(std::size_t first, std::size_t last) const;

    /// How often rows that are not finished were begun, by id: a run of them was stopped so many times.
    const std::map<std::size_t, int>& stopped() const { return stopped_; }

    /// Rows that go through the earthquake together from now on. From any thread; in the file when this returns.
    void begin(std::span<const std::size_t> ids);
    /// From any thread. In the file with the thousandth row, with one a tenth of a second later, or at the next begin() or flush().
    /// @throws InputError when the disk is full
    void append(std::span<const FinishedRow> rows);
    void flush(); ///< all rows are in the file

    /// @param axes  JSON: {"friction": {"every": 24, "values": [0.7, 0.8]}, ...}: row `id` has the value at place
    /// id / every % (number of values); every 0: no column of the view
    void describe(const std::string& axes);

    /// Adds the rows of another store. @throws InputError where a row is in both
    void take(const std::filesystem::path& part);

    void mark_done(); ///< the table is written: a fresh start may replace this store

private:
    void open(const std::filesystem::path& file, int flags);
    void write(std::span<const FinishedRow> rows); ///< those that wait, and these
    void check_format() const;
    void create(const SweepIdentity& identity, const Shard& shard);
    void write_head() const;
    void read_head();
    void read_rows();

    std::unique_ptr<Database> database_;
    std::unique_ptr<RowInserter> inserter_;
    SweepIdentity identity_;
    Shard shard_;
    std::string axes_;
    bool done_ = false;
    std::size_t finished_ = 0;
    std::vector<std::int64_t> damaged_; ///< ids
    std::map<std::size_t, int> stopped_;
    std::vector<FinishedRow> waiting_; ///< to be written
    std::chrono::steady_clock::time_point written_{};
    mutable std::mutex waiting_mutex_, database_mutex_;
};

/// "results.csv" -> "results.sqlite"; of a part "results.2-of-4.sqlite".
std::filesystem::path store_of(const std::filesystem::path& csv, const std::optional<Shard>& shard = std::nullopt);

} // namespace damslip
