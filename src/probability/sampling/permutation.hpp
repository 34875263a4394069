#pragma once

#include "probability/sampling/philox.hpp"

#include <cstdint>
#include <vector>

namespace damslip::probability {

/// A permutation of 0 ... n - 1, all n! equally likely (Fisher-Yates), fixed by stream and block alone.
std::vector<std::uint32_t> permutation(const Stream& stream, std::uint32_t n, std::uint32_t block = 0);

} // namespace damslip::probability
