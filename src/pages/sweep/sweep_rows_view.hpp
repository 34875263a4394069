#pragma once

#include "core/status_count.hpp"
#include "core/table.hpp"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
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
    std::string record, method;
    double yield_acceleration = 0.0; ///< [m/s²]
    double pga = 0.0;                ///< [m/s²]
    std::optional<double> slip;      ///< of answers: largest on the way, else the final one [m]
    std::optional<double> error;     ///< of an FE slip by its steps [m]
    std::optional<double> low, high; ///< band of a regression [m]
    std::optional<double> critical_friction;
    std::string status;          ///< as printed
    std::optional<Status> state; ///< the same of the list; none: a remark of a method that does not apply
    bool error_known = true;     ///< false: an FE slip without an estimate of what the step leaves open

    bool finite_elements() const { return method.rfind("fe", 0) == 0; }
    bool rigid() const { return method.rfind("rigid", 0) == 0; }
    bool fails_statically() const { return state && damslip::fails_statically(*state); }
    bool unanswered() const { return state && !is_answer(*state); }
};

struct SweepView {
    std::vector<SweepRow> rows;
    std::vector<SweepVariant> variants;     ///< in order of appearance
    std::vector<std::string> variant_names; ///< what sets each apart from the others; empty for a single one
    std::vector<std::string> methods, records;
    std::vector<double> frictions; ///< ascending

    using Group = std::tuple<std::size_t, std::string, double>; ///< variant, method, friction
    std::map<Group, std::vector<std::size_t>> groups;           ///< rows of each
};

/// Makes the view of rows that come part by part.
class SweepViewMaker {
public:
    /// @param table  columns by their keys, as `sweep` writes them, the same in each part; a column that is missing has its
    /// default
    void add(const Table& table);
    SweepView view(); ///< of all that was added; once

private:
    SweepView view_;
    std::set<double> frictions_;
};

/// Of rows in one table.
SweepView sweep_view(const Table& table);

/// Rows without an answer, how many and which: "3 rows have no answer: 2 not resolved (rows 4, 7), 1 tolerance missed (row 9)";
/// empty where all have one. Of many only the first are named.
std::string unanswered_words(const SweepView& view);

/// How many FE slips have no error estimate, and why; empty where all have one.
std::string unknown_error_words(const SweepView& view);

} // namespace damslip::pages
