#pragma once

/// Which vector instructions the hot loops of a step use.
///
/// Every sum runs in the same order on every level, two at a time, and nothing is fused: results have the same bits
/// whatever the machine can do. So the level is no part of the provenance, and rows of different machines can be merged.
namespace damslip::fe2d {

enum class VectorLevel {
    sse2, ///< two numbers at a time: what every x86-64 does; other processors do the same by plain C++
    avx2  ///< four at a time
};

/// The best that this processor does. DAMSLIP_VECTOR_LEVEL=sse2 in the environment takes the lower one, to compare.
VectorLevel vector_level();

} // namespace damslip::fe2d

#if defined(__x86_64__) && defined(__GNUC__)
#define DAMSLIP_HAS_AVX2 1
#define DAMSLIP_AVX2 __attribute__((target("avx2")))
#else
#define DAMSLIP_HAS_AVX2 0
#endif
