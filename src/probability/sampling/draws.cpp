#include "probability/sampling/draws.hpp"

#include "core/number.hpp"
#include "probability/laws/distribution.hpp"
#include "probability/sampling/permutation.hpp"

#include <algorithm>
#include <cmath>

namespace damslip::probability {

namespace {

/// The name of the stream of records. No variable has it: names of variables have no blanks.
constexpr const char* record_stream = "record of a sample";

} // namespace

RecordDraw::RecordDraw(RecordOrder order, std::uint64_t seed, std::span<const double> weights, std::uint32_t replicate)
    : order_(order), stream_(seed, record_stream, replicate)
{
    if (weights.empty()) throw ParameterError("records", "0", "one record at least");
    double sum = 0.0;
    for (const double w : weights) {
        if (!(w > 0.0) || !std::isfinite(w)) throw ParameterError("weight", shortest(w), "a number > 0");
        below_.push_back(sum += w);
    }
    for (double& b : below_) b /= sum;
    below_.back() = 1.0;
    equal_ = std::all_of(weights.begin(), weights.end(), [&](double w) { return w == weights.front(); });
}

RecordDraw::RecordDraw(RecordOrder order, std::uint64_t seed, std::size_t records, std::uint32_t replicate)
    : RecordDraw(order, seed, std::vector<double>(records, 1.0), replicate)
{
}

std::size_t RecordDraw::operator()(std::uint32_t sample) const
{
    const std::uint32_t n = static_cast<std::uint32_t>(below_.size());
    double u = stream_.uniform(sample);
    if (order_ == RecordOrder::balanced) {
        const std::uint32_t block = sample / n;
        const std::uint32_t stratum = permutation(stream_, n, 1 + block)[sample % n];
        if (equal_) return stratum;
        u = std::min((stratum + stream_.uniform(block)) / n, 1.0 - 0x1p-53); // one offset for the block: systematic
    }
    if (equal_) return std::min<std::size_t>(n - 1, static_cast<std::size_t>(u * n));
    return static_cast<std::size_t>(std::upper_bound(below_.begin(), below_.end() - 1, u) - below_.begin());
}

} // namespace damslip::probability
