#include "core/version.hpp"
#include "sliding/block/contact_block.hpp"
#include "sliding/block/slide_batch.hpp"

#if DAMSLIP_HAS_AVX2
#include <immintrin.h>

// From here on all is compiled for AVX2: the runs of four numbers, which have no other place. The headers above are
// not, so this file includes the runs after them, and is compiled by itself (cmake/alone.cmake).
DAMSLIP_AVX2_BEGIN

#include "sliding/block/constant_yield_run.hpp"
#include "sliding/block/permanent_contact.hpp"

namespace damslip::sliding {

using Four = double __attribute__((vector_size(32)));
using FourMask = decltype(Four{} < Four{}); ///< all bits of a number set, or none

template <>
struct Batch<Four> {
    using Mask = FourMask;
    static constexpr std::size_t size = batch_size;

    static Four choose(Mask mask, Four yes, Four no) { return mask ? yes : no; }
    static int bits(Mask mask) { return _mm256_movemask_pd(reinterpret_cast<__m256d>(mask)); }
    static bool any_of(Mask mask) { return bits(mask) != 0; }
    static bool all_of(Mask mask) { return bits(mask) == 15; }
    static Four square_root(Four x) { return _mm256_sqrt_pd(x); }
    static void set(Four& number, std::size_t i, double value) { number[i] = value; }
    static void set(Mask& mask, std::size_t i, bool value) { mask[i] = value ? -1 : 0; }
    static double get(const Four& number, std::size_t i) { return number[i]; }
    static bool get(const Mask& mask, std::size_t i) { return mask[i] != 0; }
    static Four load(const double* from) { return _mm256_loadu_pd(from); }
    static std::size_t first_of(Mask mask) { return static_cast<std::size_t>(__builtin_ctz(bits(mask))); }
};

namespace {

template <bool vertical>
bool run_four(std::span<ContactBlock> blocks, const ContactMotion& motion, std::size_t last)
{
    PermanentContact<Four, vertical> run(blocks, motion);
    run.run(0, last, 0);
    run.write(blocks);
    return !blocks.front().unresolved;
}

bool run_batch(std::span<ContactBlock> blocks, const ContactMotion& motion, std::size_t last)
{
    return motion.a_v ? run_four<true>(blocks, motion, last) : run_four<false>(blocks, motion, last);
}

void run_yields(std::span<const ConstantYield> yields, const ContactMotion& motion, std::size_t intervals,
                const ConstantYieldOptions& options, std::span<SlipSummary> results)
{
    ConstantYieldRun<Four>(yields, motion, intervals, options).run(results);
}

} // namespace

} // namespace damslip::sliding

DAMSLIP_AVX2_END

namespace damslip::sliding {

bool has_batched_runs()
{
    return vector_level() == VectorLevel::avx2;
}

bool run_in_contact(std::span<ContactBlock, batch_size> blocks, const ContactMotion& motion, std::size_t last)
{
    return run_batch(blocks, motion, last);
}

void run_constant_yield(std::span<const ConstantYield, batch_size> yields, const ContactMotion& motion,
                        std::size_t intervals, const ConstantYieldOptions& options,
                        std::span<SlipSummary, batch_size> results)
{
    run_yields(yields, motion, intervals, options, results);
}

} // namespace damslip::sliding

#else

namespace damslip::sliding {

bool has_batched_runs()
{
    return false;
}

bool run_in_contact(std::span<ContactBlock, batch_size>, const ContactMotion&, std::size_t)
{
    return false;
}

void run_constant_yield(std::span<const ConstantYield, batch_size>, const ContactMotion&, std::size_t,
                        const ConstantYieldOptions&, std::span<SlipSummary, batch_size>)
{
}

} // namespace damslip::sliding

#endif
