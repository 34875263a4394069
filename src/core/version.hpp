#pragma once

#include <string>

namespace damslip {

std::string program_version();      ///< "0.2.0"
std::string program_verification(); ///< SHA-256 of the verification record that the release was made with (verification/record.sha256)

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
/// All functions and templates defined between the two.
#if defined(__clang__)
#define DAMSLIP_AVX2_BEGIN _Pragma("clang attribute push(__attribute__((target(\"avx2\"))), apply_to = function)")
#define DAMSLIP_AVX2_END _Pragma("clang attribute pop")
#else
#define DAMSLIP_AVX2_BEGIN _Pragma("GCC push_options") _Pragma("GCC target(\"avx2\")")
#define DAMSLIP_AVX2_END _Pragma("GCC pop_options")
#endif
#else
#define DAMSLIP_HAS_AVX2 0
#endif

/// A function compiled twice, the processor chooses: four numbers at a time in place of two, nothing fused, the same bits.
/// Not with checkers: the choice runs before they are set up.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) &&               \
    !defined(__SANITIZE_THREAD__)
#define DAMSLIP_TWO_LEVELS __attribute__((target_clones("avx2", "default")))
#define DAMSLIP_INDEPENDENT _Pragma("GCC ivdep") ///< no vector of the loop overlaps one that it writes
#else
#define DAMSLIP_TWO_LEVELS
#define DAMSLIP_INDEPENDENT
#endif
