#include "fe2d/solver/dense_product.hpp"

#include <algorithm>

#if DAMSLIP_HAS_AVX2
#include <immintrin.h>
#endif

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Some columns of a matrix.
struct Columns {
    const double* first;
    Index stride;
    Index count;
};

/// Rows `from` ... `to` - 1.
void add_rows(const Columns& a, const double* const x, Index from, Index to, double* const y)
{
    for (Index i = from; i < to; ++i) {
        double sum = 0.0;
        for (Index j = 0; j < a.count; ++j) sum += a.first[i + j * a.stride] * x[j];
        y[i] += sum;
    }
}

#if DAMSLIP_HAS_AVX2

/// 4 `vectors` rows from row i on.
template <int vectors>
DAMSLIP_AVX2 inline void add_rows_avx2(const Columns& a, const double* const x, Index i, double* const y)
{
    __m256d sum[vectors];
    for (int v = 0; v < vectors; ++v) sum[v] = _mm256_setzero_pd();
    const double* column = a.first + i;
    for (Index j = 0; j < a.count; ++j, column += a.stride) {
        const __m256d factor = _mm256_broadcast_sd(x + j);
        for (int v = 0; v < vectors; ++v)
            sum[v] = _mm256_add_pd(sum[v], _mm256_mul_pd(_mm256_loadu_pd(column + 4 * v), factor));
    }
    for (int v = 0; v < vectors; ++v)
        _mm256_storeu_pd(y + i + 4 * v, _mm256_add_pd(_mm256_loadu_pd(y + i + 4 * v), sum[v]));
}

DAMSLIP_AVX2 void add_columns_avx2(const Columns& a, const double* const x, Index rows, double* const y)
{
    Index i = 0;
    for (; i + 32 <= rows; i += 32) add_rows_avx2<8>(a, x, i, y);
    for (; i + 8 <= rows; i += 8) add_rows_avx2<2>(a, x, i, y);
    for (; i + 4 <= rows; i += 4) add_rows_avx2<1>(a, x, i, y);
    add_rows(a, x, i, rows, y);
}

/// y -= x₀ a₀ + x₁ a₁ + x₂ a₂ + x₃ a₃, each row in this order; all but the last rows that make no four.
/// @returns the first row left
DAMSLIP_AVX2 Index subtract_four_avx2(const double* const a[4], const double* const x, Index rows, double* const y)
{
    const __m256d x0 = _mm256_broadcast_sd(x), x1 = _mm256_broadcast_sd(x + 1), x2 = _mm256_broadcast_sd(x + 2),
                  x3 = _mm256_broadcast_sd(x + 3);
    Index i = 0;
    for (; i + 4 <= rows; i += 4) {
        __m256d left = _mm256_loadu_pd(y + i);
        left = _mm256_sub_pd(left, _mm256_mul_pd(x0, _mm256_loadu_pd(a[0] + i)));
        left = _mm256_sub_pd(left, _mm256_mul_pd(x1, _mm256_loadu_pd(a[1] + i)));
        left = _mm256_sub_pd(left, _mm256_mul_pd(x2, _mm256_loadu_pd(a[2] + i)));
        left = _mm256_sub_pd(left, _mm256_mul_pd(x3, _mm256_loadu_pd(a[3] + i)));
        _mm256_storeu_pd(y + i, left);
    }
    return i;
}

#endif

/// The same of all rows.
void subtract_four(const double* const a[4], const double* const x, Index rows, double* const y,
                   [[maybe_unused]] VectorLevel level)
{
    Index i = 0;
#if DAMSLIP_HAS_AVX2
    if (level == VectorLevel::avx2) i = subtract_four_avx2(a, x, rows, y);
#endif
    for (; i < rows; ++i) y[i] = y[i] - x[0] * a[0][i] - x[1] * a[1][i] - x[2] * a[2][i] - x[3] * a[3][i];
}

} // namespace

void add_product(const MatrixXd& matrix, const Eigen::Ref<const VectorXd>& x, VectorXd& y, VectorLevel level)
{
    if (level != VectorLevel::avx2) { // runs in this order
        y.noalias() += matrix * x;
        return;
    }
#if DAMSLIP_HAS_AVX2
    const Index rows = matrix.rows(), columns = matrix.cols();
    const Index block = columns < 128 ? columns : rows * Index(sizeof(double)) < 32000 ? 16 : 4;
    for (Index j = 0; j < columns; j += block)
        add_columns_avx2({matrix.data() + j * rows, rows, std::min(block, columns - j)}, x.data() + j, rows, y.data());
#endif
}

void set_product(const MatrixXd& matrix, const Eigen::Ref<const VectorXd>& x, VectorXd& y)
{
    y.setZero(matrix.rows());
    add_product(matrix, x, y);
}

void subtract_columns(const MatrixXd& matrix, const VectorXd& x, VectorXd& y, VectorLevel level)
{
    const double* columns[4];
    double factors[4];
    int count = 0;
    for (Index j = 0; j < x.size(); ++j) {
        if (x[j] == 0.0) continue;
        columns[count] = matrix.data() + j * matrix.rows();
        factors[count++] = x[j];
        if (count < 4) continue;
        subtract_four(columns, factors, matrix.rows(), y.data(), level);
        count = 0;
    }
    for (int k = 0; k < count; ++k)
        for (Index i = 0; i < matrix.rows(); ++i) y[i] -= factors[k] * columns[k][i];
}

} // namespace damslip::fe2d
