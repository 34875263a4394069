#pragma once

#include <string>

namespace damslip {

std::string program_version(); ///< "0.1.0"

/// Which vector instructions hot loops use.
///
/// Loops of both levels round alike, operation by operation, and nothing is fused: results have the same bits whatever
/// the machine can do. So the level is no part of the provenance, and rows of different machines can be merged.

enum class VectorLevel {
    sse2, ///< what every x86-64 does; other processors do the same by plain C++
    avx2  ///< four numbers at a time
};

/// The best that this processor does. DAMSLIP_VECTOR_LEVEL=sse2 in the environment takes the lower one, to compare.
VectorLevel vector_level();

} // namespace damslip

#if defined(__x86_64__) && defined(__GNUC__)
#define DAMSLIP_HAS_AVX2 1
#define DAMSLIP_AVX2 __attribute__((target("avx2")))
#else
#define DAMSLIP_HAS_AVX2 0
#endif
