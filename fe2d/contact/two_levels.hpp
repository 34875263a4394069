#pragma once

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
