#pragma once

#include "core/status_count.hpp"
#include "core/table.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// The rows of a sweep as its report reads them.
namespace damslip::pages {

/// What is the same for all motions, frictions and methods that are compared with each other.
struct SweepVariant {
    double level = 0.0; ///< [m]
    std::string uplift, reservoir;
    double size = 1.0, scale = 1.0;                  ///< [-]
    std::string opening = {};                        ///< uplift.opening; empty: the scene's
    std::optional<double> period = {}, damping = {}; ///< of the flexible block [s], [-]; none: the scene's

    friend auto operator<=>(const SweepVariant&, const SweepVariant&) = default;
};

struct SweepRow {
    std::int64_t id = 0;
    std::size_t variant = 0; ///< of SweepView::variants
    double friction = 0.0;
    int polarity = 1;
    std::string_view record, method; ///< of SweepView::words
    double yield_acceleration = 0.0; ///< [m/s²]
    double pga = 0.0;                ///< [m/s²]
    std::optional<double> slip;      ///< of answers: largest on the way, else the final one [m]
    std::optional<double> error;     ///< of an FE slip by its steps [m]
    std::optional<double> low, high; ///< band of a regression [m]
    std::optional<double> critical_friction;
    std::string_view status;     ///< as printed
    std::optional<Status> state; ///< the same of the list; none: a remark of a method that does not apply
    bool error_known = true;     ///< false: an FE slip without an estimate of what the step leaves open

    bool finite_elements() const { return method.starts_with("fe"); }
    bool rigid() const { return method.starts_with("rigid"); }
    bool fails_statically() const { return state && damslip::fails_statically(*state); }
    bool unanswered() const { return state && !is_answer(*state); }
};

/// Rows without an answer, counted one by one.
class UnansweredRows {
public:
    /// @param state  of SweepRow
    void add(std::int64_t id, const std::optional<Status>& state);
    std::string words() const; ///< as unanswered_words()

private:
    struct Rows {
        std::size_t count = 0;
        std::string first; ///< ids
    };
    std::map<Status, Rows> rows_;
};

struct SweepView {
    std::vector<SweepRow> rows;
    std::vector<SweepVariant> variants;     ///< in order of appearance
    std::vector<std::string> variant_names; ///< what sets each apart from the others; empty for a single one
    std::vector<std::string> methods, records;
    std::vector<double> frictions; ///< ascending
    std::vector<int> polarities;   ///< in order of appearance

    /// Rows of a variant, method and friction, ascending; empty: none.
    std::span<const std::uint32_t> group(std::size_t variant, std::string_view method, double friction) const;

    std::vector<std::uint32_t> by_group;  ///< rows by variant and method, of these by friction
    std::vector<std::size_t> group_begin; ///< in by_group: of each variant and method, and the end of the last
    UnansweredRows unanswered;            ///< of all rows, those left out included

    // Of a sweep of too many rows to be drawn: those of every n-th friction are in the lists above.
    std::size_t every = 1;
    std::size_t left_out = 0;                 ///< other rows
    std::optional<SweepRow> largest_left_out; ///< of them, by |slip|
    std::size_t all() const { return rows.size() + left_out; }

    using Words = std::set<std::string, std::less<>>;
    std::shared_ptr<const Words> words; ///< that the rows look at
};

/// Makes the view of rows that come one by one.
class SweepViewMaker {
public:
    /// @param columns  by their keys, as `sweep` writes them; one that is missing has its default
    /// @param every  n where only the rows of every n-th friction are added; the others are left out
    explicit SweepViewMaker(const std::vector<Column>& columns, std::size_t every = 1);
    ~SweepViewMaker();
    void expect(std::size_t rows); ///< that many will be added: their memory is taken once
    void add(const std::vector<Cell>& row);
    void leave_out(const std::vector<Cell>& row);
    SweepView view(); ///< of all that was added; once

private:
    struct Parts;

    std::size_t variant_of(const std::vector<Cell>& row);
    SweepRow row_of(const std::vector<Cell>& row);
    void group_rows();

    SweepView view_;
    std::unique_ptr<Parts> parts_;
};

/// Of rows in one table.
SweepView sweep_view(const Table& table);

/// Rows without an answer, how many and which: "3 rows have no answer: 2 not resolved (rows 4, 7), 1 tolerance missed (row 9)";
/// empty where all have one. Of many only the first are named.
std::string unanswered_words(const SweepView& view);

/// How many FE slips have no error estimate, and why; empty where all have one.
std::string unknown_error_words(const SweepView& view);

} // namespace damslip::pages
