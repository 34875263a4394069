#include "fe2d/solver/dense_product.hpp"

#include <algorithm>
#include <cassert>

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

void add_product(const MatrixXd& matrix, const Eigen::Ref<const VectorXd>& x, Eigen::Ref<VectorXd> y, VectorLevel level)
{
    if (level != VectorLevel::avx2) { // runs in this order
        y.noalias() += matrix * x;
        return;
    }
#if DAMSLIP_HAS_AVX2
    const Index rows = matrix.rows(), columns = matrix.cols();
    const Index block = columns < 128 ? columns : rows * Index(sizeof(double)) < 32000 ? 16 : 4;
    for (Index j = 0; j < columns; j += block) {
        const Index count = std::min(block, columns - j);
        if (x.segment(j, count).isZero(0.0)) continue; // landings shake few of many pairs
        add_columns_avx2({matrix.data() + j * rows, rows, count}, x.data() + j, rows, y.data());
    }
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

template void Eigen::PartialPivLU<Eigen::MatrixXd>::compute();

template Eigen::LLT<Eigen::MatrixXd>&
Eigen::LLT<Eigen::MatrixXd>::compute<Eigen::MatrixXd>(const Eigen::EigenBase<Eigen::MatrixXd>&);

template Eigen::LDLT<Eigen::MatrixXd>&
Eigen::LDLT<Eigen::MatrixXd>::compute<Eigen::MatrixXd>(const Eigen::EigenBase<Eigen::MatrixXd>&);

template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>&
Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>::compute<Eigen::MatrixXd>(const Eigen::EigenBase<Eigen::MatrixXd>&, int);

template Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>&
Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>::compute(const Eigen::MatrixXd&, const Eigen::MatrixXd&, int);

template struct Eigen::internal::general_matrix_vector_product<
    Eigen::Index, double, Eigen::internal::const_blas_data_mapper<double, Eigen::Index, Eigen::ColMajor>,
    Eigen::ColMajor, false, double, Eigen::internal::const_blas_data_mapper<double, Eigen::Index, Eigen::RowMajor>,
    false>;
template struct Eigen::internal::general_matrix_vector_product<
    Eigen::Index, double, Eigen::internal::const_blas_data_mapper<double, Eigen::Index, Eigen::RowMajor>,
    Eigen::RowMajor, false, double, Eigen::internal::const_blas_data_mapper<double, Eigen::Index, Eigen::ColMajor>,
    false>;

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

namespace {

/// Four columns: the block on the diagonal, then those below it. @param x, y  from the diagonal on
void add_panel(const double* a, const double* const x, const Index blocks, double* const y)
{
    double sums[4][4] = {};
    for (Index block = 0; block < blocks; ++block, a += 16)
        for (int row = 0; row < 4; ++row) {
            double& sum = y[4 * block + row];
            for (int column = 0; column < 4; ++column) {
                sum += a[4 * column + row] * x[column];
                if (block > 0) sums[column][row] += a[4 * column + row] * x[4 * block + row];
            }
        }
    for (int column = 0; column < 4; ++column)
        y[column] += (sums[column][0] + sums[column][1]) + (sums[column][2] + sums[column][3]);
}

#if DAMSLIP_HAS_AVX2
DAMSLIP_AVX2 void add_panel_avx2(const double* a, const double* const x, const Index blocks, double* const y)
{
    const __m256d factors[4]{_mm256_broadcast_sd(x), _mm256_broadcast_sd(x + 1), _mm256_broadcast_sd(x + 2),
                             _mm256_broadcast_sd(x + 3)};
    __m256d sums[4]{_mm256_setzero_pd(), _mm256_setzero_pd(), _mm256_setzero_pd(), _mm256_setzero_pd()};
    __m256d first = _mm256_loadu_pd(y);
    for (int c = 0; c < 4; ++c) first = _mm256_add_pd(first, _mm256_mul_pd(_mm256_loadu_pd(a + 4 * c), factors[c]));
    _mm256_storeu_pd(y, first);
    for (Index block = 1; block < blocks; ++block) {
        a += 16;
        const __m256d of_rows = _mm256_loadu_pd(x + 4 * block);
        __m256d rows = _mm256_loadu_pd(y + 4 * block);
        for (int c = 0; c < 4; ++c) {
            const __m256d column = _mm256_loadu_pd(a + 4 * c);
            rows = _mm256_add_pd(rows, _mm256_mul_pd(column, factors[c]));
            sums[c] = _mm256_add_pd(sums[c], _mm256_mul_pd(column, of_rows));
        }
        _mm256_storeu_pd(y + 4 * block, rows);
    }
    for (int c = 0; c < 4; ++c) {
        alignas(32) double sum[4];
        _mm256_store_pd(sum, sums[c]);
        y[c] += (sum[0] + sum[1]) + (sum[2] + sum[3]);
    }
}
#endif

} // namespace

SymmetricProduct::SymmetricProduct(const MatrixXd& matrix) : rows_(matrix.rows()), blocks_((matrix.rows() + 3) / 4)
{
    MatrixXd whole = MatrixXd::Zero(4 * blocks_, 4 * blocks_); // the last four is filled up with zeros
    whole.topLeftCorner(rows_, rows_) = matrix;
    for (Index column = 0; column < 4 * blocks_; column += 4)
        for (Index row = column; row < 4 * blocks_; row += 4)
            for (Index c = column; c < column + 4; ++c)
                for (Index r = row; r < row + 4; ++r) panels_.push_back(whole(std::max(r, c), std::min(r, c)));
}

void SymmetricProduct::add(const Eigen::Ref<const VectorXd>& x, Eigen::Ref<VectorXd> y, VectorXd& room,
                           [[maybe_unused]] VectorLevel level) const
{
    const Index padded = 4 * blocks_;
    room.setZero(2 * padded);
    room.head(rows_) = x;
    room.segment(padded, rows_) = y;
    const double* panel = panels_.data();
    for (Index block = 0; block < blocks_; ++block) {
        const double* const from = room.data() + 4 * block;
        double* const to = room.data() + padded + 4 * block;
#if DAMSLIP_HAS_AVX2
        if (level == VectorLevel::avx2) add_panel_avx2(panel, from, blocks_ - block, to);
        else
#endif
            add_panel(panel, from, blocks_ - block, to);
        panel += 16 * (blocks_ - block);
    }
    y = room.segment(padded, rows_);
}

} // namespace damslip::fe2d
