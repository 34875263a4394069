#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace damslip::probability {

/// Annual rate H(x) of earthquakes with more than the intensity x, log-log between its points.
class HazardCurve {
public:
    /// @throws ParameterError for fewer than 2 points, intensities not > 0 and rising, rates not > 0 or rising
    HazardCurve(std::vector<double> x, std::vector<double> rate);

    const std::vector<double>& x() const { return x_; }
    const std::vector<double>& rate() const { return rate_; }
    double rate_at(double x) const; ///< NaN outside the points
    /// -d ln H / d ln x of the segment between points i and i + 1; >= 0.
    double slope(std::size_t i) const;

private:
    std::vector<double> x_, rate_;
};

struct HazardFile {
    HazardCurve curve;   ///< intensities in the unit of the file: OpenQuake's are g for PGA and SA, cm/s for PGV
    std::string measure; ///< "PGA", "SA(0.5)"; empty: the file does not say
    double investigation_time = 0.0; ///< [a]; 0: the file has rates
    std::vector<std::string> notes;  ///< points left out, with their reason
};

struct Site {
    double longitude = 0.0, latitude = 0.0; ///< degrees
};

/// Reads a hazard curve:
/// - plain CSV: a heading and two columns, intensity and annual rate of exceedance; comment lines start with '#', one may hold imt='PGA';
/// - OpenQuake's export: a comment line with investigation_time and imt (imt else from the file's name, hazard_curve-mean-PGA_1.csv), then
///   lon,lat,depth,poe-0.1,... and a row for each site; rate = -ln(1 - poe) / t. Points with poe = 0 are left out at the end of the curve, with a note.
/// @param site  which row of several: the nearest one, within 0.01 degree
/// @throws InputError with file and line: not a number, intensities that do not rise, rates that rise, poe = 1, a time that is missing, several sites
HazardFile read_hazard_curve(const std::filesystem::path& file, std::optional<Site> site = {});
HazardFile parse_hazard_curve(std::string_view text, const std::string& file_name, std::optional<Site> site = {});

} // namespace damslip::probability
