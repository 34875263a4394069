#pragma once

#include "core/version.hpp"

#if DAMSLIP_HAS_AVX2

#include <immintrin.h>

/// Four numbers at a time, for loops over four blocks of one motion. Only within functions marked DAMSLIP_AVX2.
namespace damslip::sliding {

#define DAMSLIP_FOUR_INLINE DAMSLIP_AVX2 inline __attribute__((always_inline))

/// One number of each lane; a mask has all bits of a lane set or none.
using Four = __m256d;

DAMSLIP_FOUR_INLINE Four all(double x)
{
    return _mm256_set1_pd(x);
}
DAMSLIP_FOUR_INLINE Four chosen(Four mask, Four yes, Four no)
{
    return _mm256_blendv_pd(no, yes, mask);
}
DAMSLIP_FOUR_INLINE Four above(Four a, Four b)
{
    return _mm256_cmp_pd(a, b, _CMP_GT_OQ);
}
DAMSLIP_FOUR_INLINE Four not_above(Four a, Four b)
{
    return _mm256_cmp_pd(a, b, _CMP_LE_OQ);
}
DAMSLIP_FOUR_INLINE Four both(Four a, Four b)
{
    return _mm256_and_pd(a, b);
}
/// In the first, not in the second.
DAMSLIP_FOUR_INLINE Four without(Four a, Four b)
{
    return _mm256_andnot_pd(b, a);
}
DAMSLIP_FOUR_INLINE int lanes_of(Four mask)
{
    return _mm256_movemask_pd(mask);
}

} // namespace damslip::sliding

#endif
