#pragma once

#include "analysis/screen/screening.hpp"
#include "pages/report/chart.hpp"

/// Slip over friction and over the records.
namespace damslip::pages {

/// Largest slip over friction, worse polarity, with the vertical component where a record has one: each record up to 6,
/// beyond that median, 16/84 % and largest.
/// @param jobs  threads, 0: all cores
/// @returns nothing without records, or for a scene whose friction is a table over slip
std::optional<Chart> slip_over_friction(const Scene& scene, const Screening& s,
                                        const std::vector<GroundMotion>& motions, int jobs);

/// Largest slip of each record, worse polarity.
Chart slip_by_record(const Screening& s, const std::optional<double>& allowable);

/// Largest slip of each record over a_y/PGA.
Chart slip_over_ratio(const Screening& s);

/// The regressions of record `number` with their bands beside its rigorous slip; nothing where none gives a slip.
std::optional<Chart> regressions_beside(const Screening& s, std::size_t number);

} // namespace damslip::pages
