#pragma once

#include "cli/run/screening.hpp"
#include "core/table.hpp"

namespace damslip::cli {

Table yield_table(const Screening& s);
Table slip_table(const Screening& s, const std::optional<double>& allowable);
/// Slip of the flexible block beside the rigid one, with its verdict.
Table flexible_table(const Screening& s, const std::optional<double>& allowable);

Table regression_table(const Screening& s);
Table statistics_table(const Screening& s);

} // namespace damslip::cli
