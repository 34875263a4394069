#include "fe2d/solver/transposed_product.hpp"

#include <cassert>

#if DAMSLIP_HAS_AVX2
#include <immintrin.h>
#endif

namespace damslip::fe2d {

using Eigen::Index;

namespace {

/// Sums of even and odd rows, of the first column, then of the second.
void sums_of_two(const double* a, const double* const x, const std::size_t twos, double* const sums)
{
    double s0 = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0;
    for (std::size_t k = 0; k < twos; ++k, a += 4) {
        s0 += a[0] * x[2 * k];
        s1 += a[1] * x[2 * k + 1];
        s2 += a[2] * x[2 * k];
        s3 += a[3] * x[2 * k + 1];
    }
    sums[0] = s0;
    sums[1] = s1;
    sums[2] = s2;
    sums[3] = s3;
}

#if DAMSLIP_HAS_AVX2
/// The same of several pairs of columns.
template <int pairs>
DAMSLIP_AVX2 void sums_avx2(const double* const a, const double* const x, const std::size_t twos, double* const sums)
{
    __m256d sum[pairs];
    for (int p = 0; p < pairs; ++p) sum[p] = _mm256_setzero_pd();
    for (std::size_t k = 0; k < twos; ++k) {
        const __m256d both = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(x + 2 * k));
        for (int p = 0; p < pairs; ++p)
            sum[p] = _mm256_add_pd(sum[p], _mm256_mul_pd(_mm256_loadu_pd(a + 4 * (p * twos + k)), both));
    }
    for (int p = 0; p < pairs; ++p) _mm256_storeu_pd(sums + 4 * p, sum[p]);
}
#endif

} // namespace

TransposedProduct::TransposedProduct(const Eigen::MatrixXd& matrix)
    : twos_(static_cast<std::size_t>(matrix.rows()) / 2), columns_(static_cast<std::size_t>(matrix.cols()))
{
    assert(matrix.rows() % 2 == 0);
    for (Index j = 0; j < matrix.cols(); j += 2)
        for (Index i = 0; i < matrix.rows(); i += 2)
            for (const Index column : {j, j + 1})
                for (const Index row : {i, i + 1})
                    columns_of_two_.push_back(column < matrix.cols() ? matrix(row, column) : 0.0);
}

void TransposedProduct::add(const Eigen::VectorXd& x, Eigen::VectorXd& y, [[maybe_unused]] VectorLevel level) const
{
    constexpr std::size_t at_once = 4;
    const std::size_t pairs = (columns_ + 1) / 2;
    for (std::size_t p = 0; p < pairs;) {
        double sums[4 * at_once];
        std::size_t count = 1;
        const double* const a = columns_of_two_.data() + 4 * p * twos_;
#if DAMSLIP_HAS_AVX2
        if (level == VectorLevel::avx2) {
            count = p + at_once <= pairs ? at_once : 1;
            count == 1 ? sums_avx2<1>(a, x.data(), twos_, sums) : sums_avx2<at_once>(a, x.data(), twos_, sums);
        } else
#endif
            sums_of_two(a, x.data(), twos_, sums);
        for (std::size_t c = 0; c < 2 * count && 2 * p + c < columns_; ++c)
            y[static_cast<Index>(2 * p + c)] += sums[2 * c] + sums[2 * c + 1];
        p += count;
    }
}

} // namespace damslip::fe2d
