#include "probability/sampling/permutation.hpp"

#include <numeric>
#include <utility>

namespace damslip::probability {

std::vector<std::uint32_t> permutation(const Stream& stream, std::uint32_t n, std::uint32_t block)
{
    std::vector<std::uint32_t> p(n);
    std::iota(p.begin(), p.end(), 0u);
    for (std::uint32_t k = n; k > 1; --k) std::swap(p[k - 1], p[stream.below(k, k, block)]);
    return p;
}

} // namespace damslip::probability
