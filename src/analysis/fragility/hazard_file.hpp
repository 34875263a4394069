#pragma once

#include "core/intensity_measure.hpp"
#include "probability/annual_rate.hpp"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace damslip {

/// SI value of the unit in which OpenQuake's files have a measure: g, of PGV cm/s, of I_A m/s, of CAV g s.
double openquake_unit(const IntensityName& measure);

/// Which of a file's curves is wanted.
struct HazardWish {
    IntensityName measure;                     ///< of the levels
    double first_period = 0.0;                 ///< T_1 of the dam, where the measure is SA(T1) [s]
    double level_unit = 1.0;                   ///< SI value of one unit of the levels, for a file that names no unit
    std::string level_unit_text = "m/s2";      ///< "g"
    std::optional<std::array<double, 2>> site; ///< longitude and latitude [degrees], where the file has several
};

struct HazardFile {
    probability::HazardCurve curve; ///< intensities in SI, annual rates of exceedance
    std::vector<std::string> notes; ///< what was taken for granted, converted or passed over
};

/// Reads one curve of a file. Its headings say measure, unit and kind of every column: "pga_g,annual_rate", "Sa(0.5s) [m/s2];poe_50_years",
/// "return period [years]"; commas, semicolons (numbers with decimal commas, too), tabs or blanks between the columns; comment lines start with '#',
/// and may say imt='PGA', investigation_time=50.
///   - several measures beside each other or in a column imt: the wanted one
///   - exports of OpenQuake (lon,lat,depth,poe-0.1,...; imt,iml,poe; NRML) and of USGS web services (JSON); g for PGA and SA, cm/s for PGV, m/s for IA,
///     g s for CAV
///   - probabilities within t years become rates -ln(1 - p)/t, return periods 1/T; points with p = 1 or without an earthquake are passed over
/// A heading without measure or unit (im, pga) is taken as that of the levels, with a note; an unknown one is refused.
/// @throws InputError with file and line: a heading that is not known or contradicts the levels, probabilities without their time, several sites
///         without a choice, values that are no numbers, intensities that do not rise, rates that rise
HazardFile read_hazard_file(const std::filesystem::path& file, const HazardWish& wish);
HazardFile parse_hazard_file(std::string_view text, const std::string& file_name, const HazardWish& wish);

} // namespace damslip
