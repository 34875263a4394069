#pragma once

#include <vector>

namespace damslip::fe2d {

/// Element size as a function of the distance d from where the mesh is fine: h(d) = min(largest, first + d ln(growth)).
/// With it neighbouring elements differ by the factor `growth` until `largest` is reached.
struct Grading {
    double first = 1.0;   ///< size at d = 0 [m], > 0
    double growth = 1.0;  ///< ratio of neighbouring sizes [-], >= 1
    double largest = 1.0; ///< [m], >= first

    double size_at(double distance) const;
    double elements_to(double distance) const;          ///< integral of dd/h(d): elements between 0 and `distance`
    double distance_after(double element_number) const; ///< inverse of elements_to
};

/// Positions from stations.front() to stations.back(), graded away from the first, with every station exactly among
/// them.
/// @param stations  strictly increasing, at least two
/// Each interval gets the nearest whole number of elements, at least one.
std::vector<double> graded_positions(const std::vector<double>& stations, const Grading& grading);

/// Positions with every station among them, each interval divided evenly into the nearest whole number of parts of
/// `size`, at least one.
std::vector<double> even_positions(const std::vector<double>& stations, double size);

} // namespace damslip::fe2d
