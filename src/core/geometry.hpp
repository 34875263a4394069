#pragma once

#include <vector>

namespace damslip {

/// A point of the section; x downstream, y up, heel of the dam at the origin [m].
struct Point {
    double x = 0.0;
    double y = 0.0;
    friend bool operator==(const Point&, const Point&) = default;
};

using Polyline = std::vector<Point>;

} // namespace damslip
