#pragma once

#include "analysis/screen/needed.hpp"
#include "analysis/screen/screening.hpp"
#include "core/table.hpp"

namespace damslip::pages {

Table yield_table(const Screening& s);
/// The rigid block above each lift joint: static safety and yield acceleration. Empty without lift joints.
Table lift_joint_table(const Scene& scene);
Table slip_table(const Screening& s, const std::optional<double>& allowable);
/// Mean slip of both polarities, of records that have a slip in both.
Table mean_slip_table(const Screening& s);
/// The block that rocks and slides, with its energies.
Table rocking_table(const Screening& s, const std::optional<double>& allowable);
/// The slip without bond, where much of the resistance is bond.
Table bond_table(const Screening& s, const std::optional<double>& allowable);
/// What the anchors through the base came to in each slide, with the vertical component where there is one.
Table screened_anchor_table(const Screening& s);
/// Of a sequence, one row for each event and polarity; without rows where there is none.
Table event_table(const Screening& s);
/// Slip of the flexible block beside the rigid one, with its verdict.
Table flexible_table(const Screening& s, const std::optional<double>& allowable);

/// Yield and friction that keep the slip within the allowable one; without rows where there is none.
Table needed_table(const std::vector<NeededRow>& rows, const Scene& scene);

/// Every regression for every record, for files.
Table regression_table(const std::vector<RegressionRow>& rows);
/// Those that give an answer of their own, with the weighted median of each record; in the notes a line per record with
/// what is outside its range (slip, never weighted), what expects no slip and what is missing.
Table regression_summary(const std::vector<RegressionRow>& rows);
Table statistics_table(const Screening& s);

} // namespace damslip::pages
