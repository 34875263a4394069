#pragma once

#include "analysis/screen/screening.hpp"
#include "pages/report/page.hpp"

/// Charts of a screening: yield acceleration, slip, and what the block does under each record.
namespace damslip::pages {

/// Yield acceleration over friction for each uplift model the scene has the data for.
Chart yield_over_friction(const Scene& scene, const Screening& s);

/// Yield acceleration over the reservoir level, likewise. @pre scene.reservoir
Chart yield_over_level(const Scene& scene, const Screening& s);

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

/// Ground acceleration, slip histories, and (with a vertical component) yield against ground acceleration as
/// Goldgruber (2015), fig. 4-7, of one record; regressions beside the slip. The charts share cursor and zoom.
/// @param motion   of record `number`  @param records  how many there are: the more, the fewer samples each chart keeps
std::vector<Part> record_parts(const Scene& scene, const Screening& s, const GroundMotion& motion, std::size_t number,
                               std::size_t records);

} // namespace damslip::pages
