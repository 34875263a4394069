#pragma once

#include "analysis/fragility/fragility_plan.hpp"

namespace damslip {

/// Intensity of a motion's horizontal component [SI]. @param first_period  T_1 of the dam [s], for SA(T1)
double intensity_of(const GroundMotion& motion, const IntensityInput& intensity, double first_period);

/// T_1 of the dam on its rock with the water that moves with it, for SA(T1) [s]. @throws InputError, NotConverged
double first_period_of(const Scene& scene);

/// Records with their intensities as the scene scales them. Each is an event of its own, of weight 1, unless the lists say else.
/// @param event, weight  of each record, or empty
/// @throws InputError for a record without any shaking, for the same record twice
ShakingSuite measured_suite(const Scene& scene, Records pairs, const IntensityInput& intensity,
                            std::vector<std::string> event = {}, std::vector<double> weight = {});

/// The records of [suite] files, or those of the scene where it names none, measured. Files: a folder, a glob, or a CSV with the columns
/// horizontal and, as far as they are wanted, vertical, event, weight, magnitude, scale; paths in it start from its folder.
/// @throws InputError for files that are missing or cannot be read, for a CSV with other columns
ShakingSuite suite_of_input(const Scene& scene, const FragilityInput& input);

} // namespace damslip
