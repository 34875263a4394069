#pragma once

#include "pages/report/page.hpp"

#include <optional>
#include <string>
#include <vector>

namespace damslip::pages {

/// One bar from zero.
struct Bar {
    std::string name;
    std::optional<double> value;
    double error = 0.0;    ///< drawn as a whisker on both sides of the end; 0: none
    std::string words;     ///< beside the bar: its figure; in its place where there is no value
    bool doubtful = false; ///< drawn hollow: not larger than its error
};

/// Bars to both sides of zero, the longest on top; those without a value at the bottom.
/// @param unit  of the values, for the axis
Drawing tornado(std::string title, std::vector<Bar> bars, const std::string& axis, const std::string& note);

} // namespace damslip::pages
