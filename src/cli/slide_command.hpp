#pragma once

#include "cli/terminal/streams.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace damslip::cli {

/// A yield acceleration, what slides on it, and records. In the units of the flags.
struct SlideArguments {
    std::string yield_g, yield_m_s2;   ///< lists, as the axes of a sweep
    std::filesystem::path yield_table; ///< rows of slip [mm] and yield [g]; one of the three is given
    std::vector<std::filesystem::path> records;
    std::string record_list; ///< folder, pattern or list in place of them
    std::string unit, column;
    std::optional<double> dt;    ///< [s]
    double scale = 1.0;          ///< factor on all records
    std::optional<double> pga_g; ///< all records to this peak, before the factor
    std::string methods;         ///< list; empty: rigid, of a flexible block all three
    std::optional<double> period_s, height_m, velocity_m_s, base_velocity_m_s, reference_strain_percent;
    std::optional<double> damping, mass_ratio; ///< 0.05, 8/pi^2
    bool two_way = false;
};

/// Slip on a given yield acceleration, without a section: every record both ways, and their mean.
int slide_on_yield(const SlideArguments& arguments, const Streams& streams);

} // namespace damslip::cli
