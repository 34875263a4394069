#pragma once

#include "analysis/prepare/records.hpp"
#include "analysis/sweep/fe_sweep.hpp"
#include "analysis/sweep/sweep_run.hpp"
#include "core/csv.hpp"
#include "core/status.hpp"
#include "pages/report/chart.hpp"
#include "pages/report/answer.hpp"
#include "pages/report/page.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
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
    std::string plane = {};                          ///< what the block slides on; empty: the base

    friend auto operator<=>(const SweepVariant&, const SweepVariant&) = default;
};

/// Do some of the variants differ in this member?
template <class Value>
bool differ(const std::vector<SweepVariant>& variants, Value SweepVariant::*member)
{
    return std::ranges::any_of(
        variants, [&](const Value& value) { return value != variants.front().*member; }, member);
}

/// Is the method one of finite elements?
inline bool is_of_elements(std::string_view method)
{
    return method.starts_with("fe");
}

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
    std::optional<double> critical_friction;
    std::string_view status;     ///< as printed
    std::optional<Status> state; ///< the same of the list; none: a remark of a method that does not apply
    bool error_known = true;     ///< false: an FE slip without an estimate of what the step leaves open

    bool finite_elements() const { return is_of_elements(method); }
    bool rigid() const { return method.starts_with("rigid"); }
    bool fails_statically() const { return state && damslip::fails_statically(*state); }
    bool unanswered() const { return state && !is_answer(*state); }
};

/// Rows without an answer, counted one by one.
class UnansweredRows {
public:
    /// @param state  of SweepRow
    void add(std::int64_t id, const std::optional<Status>& state);
    /// "3 rows have no answer: 2 not resolved (rows 4, 7), 1 tolerance missed (row 9)"; empty where all have one. Of many
    /// only the first are named.
    std::string words() const;

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
    bool finite_elements() const { return std::ranges::any_of(rows, &SweepRow::finite_elements); }

    using Words = std::set<std::string, std::less<>>;
    std::shared_ptr<const Words> words; ///< that the rows look at
};

/// A row: its place in the grid and what was found there.
struct SweepLine {
    const Grid& grid;
    std::size_t id;
    GridIndex at;
    const RowResults& results;
    const FinishedRow* row = nullptr;  ///< null: not reached
    std::optional<double> mean = {};   ///< slip of both polarities [m]

    const Axes& axes() const { return grid.axes; }
    double yield() const { return results.yield ? *results.yield : grid.yield(at); }
    bool finite_elements() const { return axes().method[at.method].kind == SweepKind::finite_elements; }
    /// Nothing finer was run beside a slip of finite elements.
    bool error_known() const { return !finite_elements() || !results.slip || results.slip_error; }
};

/// Makes the view of rows that come one by one.
class SweepViewMaker {
public:
    /// @param every  n where only the rows of every n-th friction are added; the others are left out
    explicit SweepViewMaker(std::size_t every = 1);
    void expect(std::size_t rows); ///< that many will be added: their memory is taken once
    void add(const SweepLine& line);
    void leave_out(const SweepLine& line);
    /// @param row  its words are copied, its variant is found
    void add(const SweepVariant& variant, SweepRow row);
    SweepView view(); ///< of all that was added; once

private:
    SweepRow row_of(const SweepLine& line);
    std::size_t variant_of(const SweepLine& line);
    std::size_t number_of(const SweepVariant& variant);
    std::string_view kept(std::string_view word);
    std::string_view listed(const std::string& word, std::vector<std::string>& list);
    void complete(SweepRow& row);
    void put(const SweepRow& row);
    void group_rows();

    SweepView view_;
    std::shared_ptr<SweepView::Words> words_ = std::make_shared<SweepView::Words>();
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> variants_; ///< by TaskList::variant() and scale
    std::vector<std::string_view> records_, methods_;                     ///< by their places on the axes
    std::set<double> frictions_;
    std::string_view last_status_;
    std::optional<Status> last_state_;
};

/// Of all rows. @param ids  ascending
SweepView sweep_view(const Grid& grid, const std::vector<std::size_t>& ids, const SweepOutcome& outcome);

/// How many FE slips have no error estimate, and why; empty where all have one.
std::string unknown_error_words(const SweepView& view);

/// Charts of a sweep. Slips are the largest on the way; of the polarities of a record the worse counts.

/// Slip over friction of one variant, a curve for each method: the largest of up to three records, of more the median, with
/// a band from the least to the largest of the main method. Where the dam does not stand without an earthquake there is no
/// value, and a line marks the critical friction.
Chart slip_over_friction(const SweepView& view, std::size_t variant, const std::optional<double>& allowable);

/// Slip over time of one variant and method under the first record and polarity, a curve for each friction (of more than
/// eight every n-th); nothing where there is no history.
/// @param histories  of the view's rows, in their order
std::optional<Chart> slip_histories(const SweepView& view, std::size_t variant, const std::string& method,
                                    const std::vector<SlipHistory>& histories);

/// A history as a curve [s, mm].
Curve history_curve(const std::string& name, const SlipHistory& history);

/// The method a reader looks at first: FE, else the rigid block with the vertical component.
std::string main_method(const SweepView& view);

/// The same of one method, a curve for each of the first eight variants.
Chart slip_by_variant(const SweepView& view, const std::string& method, const std::optional<double>& allowable);

/// Slip of every row over a_y/PGA.
Chart slip_over_yield_ratio(const SweepView& view);

/// FE slip over the rigid block's, with the vertical component where both have it; nothing without both methods.
std::optional<Chart> fe_over_rigid(const SweepView& view);

/// Yield acceleration over friction of the variants.
Chart yield_over_friction(const SweepView& view);

/// The friction from which on no slip of a sweep is above the allowable one, of one variant by one method.
struct NeededFriction {
    std::string variant, method;
    std::optional<double> more;    ///< highest friction of the grid that slips more; none: all hold
    std::optional<double> holds;   ///< the next one; none: even the highest slips more
    std::optional<double> between; ///< where the slip, linear in friction between the two, is the allowable one
    std::string record;            ///< that slips most at `more`
    std::optional<int> polarity;   ///< of that record

    /// Between the two; none where the grid does not bracket it.
    std::optional<double> friction() const { return !more || !holds ? std::nullopt : between ? between : holds; }
};

/// For every variant and method, between the two frictions of the grid that bracket it. Empty where there is no allowable slip or
/// only one friction. An FE slip counts with its error of the step added; a row without a slip, or without an answer, slips
/// more than any. @param allowable  [m]
std::vector<NeededFriction> needed_frictions(const SweepView& view, const std::optional<double>& allowable);

/// The same as a table.
Table needed_friction_table(const SweepView& view, const std::optional<double>& allowable);

/// What the rules for water in the opening base are worth: largest slips on the way under each rule side by side, and how
/// far they are apart. None where the rows of a sweep have fewer than two rules.
std::optional<Table> opening_water_table(const SweepView& view);

/// A sweep as the report that is handed in.

struct SweepReportInput {
    const Scene* scene;                  ///< as given; null: not known, as of merged parts
    const Table& rows;                   ///< the whole table, or the first rows of a long one
    const SweepView& view;               ///< of all rows
    const Table& compared;               ///< FE against the rigid block; without rows: no finite elements
    const std::optional<FeSweepCounts>& fe; ///< none: no finite elements
    const std::vector<RecordPair>& records;
    std::filesystem::path csv;               ///< where the rows are; empty: nowhere
    std::vector<SlipHistory> histories = {}; ///< of the rows, in their order; empty: none kept
    std::string closing = {};                ///< of the full text: how many rows there are, and where
};

inline constexpr std::size_t listed_rows = 400; ///< that the report prints

Page sweep_page(const SweepReportInput& input);

/// The full text is what stands beside the rows. @pre input.scene
Answer sweep_answer(const SweepReportInput& input);

/// A sweep as tables.

/// Rows in the order of their ids; what an interrupted sweep did not reach says so. Axes, yield acceleration and PGA, then
/// what the method gave. @param mean  with the mean slip of both polarities, empty where one of them has none
Table sweep_table(const Grid& grid, const std::vector<std::size_t>& ids, const SweepOutcome& outcome,
                  bool mean = false);

/// Takes a row and its cells in that table, which are overwritten by those of the next.
using TakeLine = std::function<void(const SweepLine& line, const std::vector<Cell>& cells)>;

/// Makes the rows one by one and keeps none. @param ids  ascending
void for_each_sweep_row(const Grid& grid, const std::vector<std::size_t>& ids, const SweepOutcome& outcome, bool mean,
                        const TakeLine& take);

/// Its columns.
std::vector<Column> sweep_columns(const Grid& grid, bool mean = false);

/// Remark of FE rows whose step was given: nothing to compare it with was run, so ± step is empty.
inline constexpr const char* no_error_estimate = "no error estimate: fixed sub-steps";

Table comparison_table(const Grid& grid, const std::vector<SweepComparison>& compared);

/// Counts that show how much was made once; the same for any number of threads.
Table count_table(const FeSweepCounts& counts);

} // namespace damslip::pages
