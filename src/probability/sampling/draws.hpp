#pragma once

#include "probability/sampling/philox.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace damslip::probability {

enum class RecordOrder {
    balanced,        ///< each block of R samples has every record once, in random order
    with_replacement ///< each sample a record of its own
};

/// Which record a sample meets. Unequal weights, balanced: u = (pi(j) + v) / R with one v a block, through the distribution
/// of the weights, so that a record of weight w is met R w times a block, rounded up or down.
class RecordDraw {
public:
    /// @param weights  of the records, > 0, of any sum
    RecordDraw(RecordOrder order, std::uint64_t seed, std::span<const double> weights, std::uint32_t replicate = 0);
    RecordDraw(RecordOrder order, std::uint64_t seed, std::size_t records, std::uint32_t replicate = 0);

    std::size_t operator()(std::uint32_t sample) const; ///< 0 ... R - 1

private:
    RecordOrder order_;
    Stream stream_;
    std::vector<double> below_; ///< below_[r] = share of the records 0 ... r
    bool equal_;
};

} // namespace damslip::probability
