#pragma once

#include "analysis/fragility/fragility_plan.hpp"
#include "records/suite/suite.hpp"

namespace damslip {

/// Intensity of one horizontal component as it shakes the dam [SI]. @param first_period  T_1 of the dam [s], for SA(T1)
/// @param index  asked first; what it lacks is added
double intensity_of(const Record& horizontal, const IntensityInput& intensity, double first_period,
                    records::SuiteIndex& index);

/// T_1 of the dam on its rock with the water that moves with it, for SA(T1) [s]. @throws InputError, NotConverged
double first_period_of(const Scene& scene);

/// Records with their intensities as the scene scales them. Each is an event of its own, of weight 1, unless the lists say else.
/// The geometric mean is that of both horizontal components, with one factor on both; of a record that has no other it is that of the one.
/// @param index  of their measures @param event, weight  of each record, or empty
/// @throws InputError for a record without any shaking, for the same record twice
ShakingSuite measured_suite(const Scene& scene, Records pairs, const IntensityInput& intensity,
                            records::SuiteIndex& index, std::vector<std::string> event = {},
                            std::vector<double> weight = {});

/// The records of [suite] files, or those of the scene where it names none, measured. Files: a folder, a glob, or a CSV with the columns
/// horizontal and, as far as they are wanted, vertical, other_horizontal, event, weight, magnitude, scale; or a list of seeds. Their measures are
/// kept in its folder (records/suite/suite.hpp).
/// @throws InputError for files that are missing or cannot be read, for a CSV with other columns
ShakingSuite suite_of_input(const Scene& scene, const FragilityInput& input);

} // namespace damslip
