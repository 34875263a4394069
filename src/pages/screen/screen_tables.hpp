#pragma once

#include "analysis/screen/screening.hpp"
#include "core/table.hpp"

namespace damslip::pages {

Table yield_table(const Screening& s);
/// The rigid block above each lift joint: static safety and yield acceleration. Empty without lift joints.
Table lift_joint_table(const Scene& scene);
Table slip_table(const Screening& s, const std::optional<double>& allowable);
/// Slip of the flexible block beside the rigid one, with its verdict.
Table flexible_table(const Screening& s, const std::optional<double>& allowable);

/// Every regression for every record, for files.
Table regression_table(const Screening& s);
/// Those that give an answer of their own, with the weighted median of each record; in the notes a line per record with
/// what is outside its range (slip, never weighted), what expects no slip and what is missing.
Table regression_summary(const Screening& s);
Table statistics_table(const Screening& s);

} // namespace damslip::pages
