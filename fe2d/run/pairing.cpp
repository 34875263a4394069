#include "fe2d/run/pairing.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;

namespace {

constexpr double round_off = 1e-13; ///< weights below are zero [-]

double shortest(const std::vector<double>& places)
{
    double result = places.back() - places.front();
    for (std::size_t k = 0; k + 1 < places.size(); ++k) result = std::min(result, places[k + 1] - places[k]);
    return result;
}

} // namespace

Pairing::Pairing(std::vector<double> dam, std::vector<double> rock) : dam_(std::move(dam)), rock_(std::move(rock))
{
    assert(dam_.size() > 1 && rock_.size() > 1);
}

bool Pairing::reaches(double slip) const
{
    const double slack = 1e-9 * (rock_.back() - rock_.front());
    return slip >= reach_upstream() - slack && slip <= reach_downstream() + slack;
}

double Pairing::smallest_element() const
{
    return std::min(shortest(dam_), shortest(rock_));
}

Pairing::Matrix Pairing::weights(double slip) const
{
    assert(reaches(slip));
    const auto m = dam_.size(), n = rock_.size();
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<double> area(m, 0.0);
    for (std::size_t i = 0; i + 1 < m; ++i) {
        area[i] += 0.5 * (dam_[i + 1] - dam_[i]);
        area[i + 1] += 0.5 * (dam_[i + 1] - dam_[i]);
    }
    for (std::size_t i = 0; i + 1 < m; ++i) {
        const double left = dam_[i] + slip, right = dam_[i + 1] + slip, length = right - left;
        auto next = std::upper_bound(rock_.begin(), rock_.end(), left);
        auto j = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, next - rock_.begin() - 1));
        for (j = std::min(j, n - 2); j + 1 < n; ++j) {
            const bool first = j == 0, last = j + 2 == n; // the outermost elements take what round-off leaves outside
            const double begin = first ? left : std::max(left, rock_[j]),
                         end = last ? right : std::min(right, rock_[j + 1]);
            if (end > begin) {
                // ψ N is quadratic: two points of Gauss are exact.
                const double half = 0.5 * (end - begin), middle = 0.5 * (end + begin);
                for (const double sign : {-1.0, 1.0}) {
                    const double x = middle + sign * half / std::sqrt(3.0);
                    const double xi = (x - left) / length, eta = (x - rock_[j]) / (rock_[j + 1] - rock_[j]);
                    for (const auto& [node, dual] : {std::pair{i, 2.0 - 3.0 * xi}, std::pair{i + 1, 3.0 * xi - 1.0}}) {
                        entries.emplace_back(node, j, half * dual * (1.0 - eta) / area[node]);
                        entries.emplace_back(node, j + 1, half * dual * eta / area[node]);
                    }
                }
            }
            if (!(rock_[j + 1] < right)) break;
        }
    }
    Matrix result(static_cast<Index>(m), static_cast<Index>(n));
    result.setFromTriplets(entries.begin(), entries.end());
    result.prune([](Index, Index, double value) { return std::abs(value) > round_off; });
    return result;
}

} // namespace damslip::fe2d
