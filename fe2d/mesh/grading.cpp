#include "fe2d/mesh/grading.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace damslip::fe2d {

namespace {

/// Distance at which the largest size is reached.
double growing_length(const Grading& g)
{
    return g.growth > 1.0 ? (g.largest - g.first) / std::log(g.growth) : 0.0;
}

int nearest_count(double elements)
{
    return std::max(1, static_cast<int>(std::lround(elements)));
}

} // namespace

double Grading::size_at(double distance) const
{
    return std::min(largest, first + distance * std::log(growth));
}

double Grading::elements_to(double distance) const
{
    if (growth <= 1.0) return distance / first;
    const double rate = std::log(growth);
    const double graded = std::min(distance, growing_length(*this));
    return std::log1p(rate * graded / first) / rate + (distance - graded) / largest;
}

double Grading::distance_after(double element_number) const
{
    if (growth <= 1.0) return element_number * first;
    const double rate = std::log(growth);
    const double length = growing_length(*this);
    const double graded = elements_to(length);
    return element_number <= graded ? first * std::expm1(rate * element_number) / rate
                                    : length + (element_number - graded) * largest;
}

std::vector<double> graded_positions(const std::vector<double>& stations, const Grading& grading)
{
    assert(stations.size() >= 2 && grading.first > 0.0 && grading.growth >= 1.0 && grading.largest >= grading.first);
    const double origin = stations.front();
    std::vector<double> positions{origin};
    for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
        const double start = grading.elements_to(stations[i] - origin);
        const double end = grading.elements_to(stations[i + 1] - origin);
        const int count = nearest_count(end - start);
        for (int k = 1; k < count; ++k)
            positions.push_back(origin + grading.distance_after(start + (end - start) * k / count));
        positions.push_back(stations[i + 1]);
    }
    return positions;
}

std::vector<double> even_positions(const std::vector<double>& stations, double size)
{
    return graded_positions(stations, {.first = size, .growth = 1.0, .largest = size});
}

} // namespace damslip::fe2d
