#pragma once

#include "core/table.hpp"

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

/// The rows of a sweep as its report reads them.
namespace damslip::cli {

/// What is the same for all motions, frictions and methods that are compared with each other.
struct SweepVariant {
    double level = 0.0; ///< [m]
    std::string uplift, reservoir;
    double size = 1.0, scale = 1.0; ///< [-]

    friend auto operator<=>(const SweepVariant&, const SweepVariant&) = default;
};

struct SweepRow {
    std::size_t variant = 0; ///< of SweepView::variants
    double friction = 0.0;
    int polarity = 1;
    std::string record, method;
    double yield_acceleration = 0.0; ///< [m/s²]
    double pga = 0.0;                ///< [m/s²]
    std::optional<double> slip;      ///< largest on the way, else the final one [m]; none: no answer
    std::optional<double> low, high; ///< band of a regression [m]
    std::optional<double> critical_friction;
    std::string status;

    bool finite_elements() const { return method.rfind("fe", 0) == 0; }
    bool rigid() const { return method.rfind("rigid", 0) == 0; }
    bool fails_statically() const { return !slip && critical_friction && *critical_friction > friction; }
    /// A run without an answer that should have one; regressions may be outside their range, rigid-v without a record.
    bool unanswered() const { return !slip && finite_elements() && !fails_statically(); }
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

/// @param table  columns by their keys, as `sweep` writes them; a column that is missing has its default
SweepView sweep_view(const Table& table);

} // namespace damslip::cli
