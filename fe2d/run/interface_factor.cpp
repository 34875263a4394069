#include "fe2d/run/interface_factor.hpp"

#include "fe2d/run/node_products.hpp"
#include "fe2d/solver/dense_product.hpp"

#include <algorithm>
#include <cassert>

#if DAMSLIP_HAS_AVX2
#include <immintrin.h>
#endif

namespace damslip::fe2d {

using Eigen::Index;

namespace {

using Pair = Eigen::Array2d; ///< both unknowns of a node; two at a time is what every x86-64 does in one operation
using Values = Eigen::Map<const Pair>;

/// Of two blocks by columns: the first columns of both, then the second ones.
void join(InterfaceFactor::Block& one, InterfaceFactor::Block& other)
{
    std::swap_ranges(one.v + 2, one.v + 4, other.v);
}

/// Are the values of both nodes zero? Jumps of pairs that stick are.
inline bool rest(const double* const y, const double* const z, int numbers)
{
    for (int i = 0; i < numbers; ++i)
        if (y[i] != 0.0 || z[i] != 0.0) return false;
    return true;
}

/// A_ii⁻¹ b less what stands behind. @param here  b of the node on entry
inline void take_pivot(const InterfaceFactor::Pivot& p, double first, double second, double* const here)
{
    const double b0 = here[0], b1 = here[1];
    here[0] = p.xx * b0 + p.xy * b1 - first;
    here[1] = p.xy * b0 + p.yy * b1 - second;
}

} // namespace

InterfaceFactor::InterfaceFactor(const SparseMatrix& of_nodes, int inner_nodes, int negative, int negative_nodes,
                                 std::vector<Tie> ties, InterfaceSigns signs)
    : inner_(inner_nodes), ties_(std::move(ties))
{
    const SparseMatrix matrix = tied(of_nodes, ties_);
    NodeLdlt ldlt = node_ldlt(matrix, inner_);
    if (!ldlt.exists) return;
    const Eigen::VectorXd& d = ldlt.diagonal;
    if (!d.allFinite() || (d.array() == 0.0).any() || (negative >= 0 && (d.array() < 0.0).count() != negative)) return;
    schur_ = ldlt.schur(matrix);
    // Of one sign each; what nothing holds is none, up to round-off, so a multiple of the identity is added for the check.
    const Index below = 2 * negative_nodes, above = schur_.rows() - below;
    const auto definite = [&](Index first, Index count, double sign) {
        Eigen::MatrixXd part = sign * schur_.block(first, first, count, count);
        part.diagonal().array() += sign * matrix.diagonal().segment(2 * inner_ + first, count).mean();
        return Eigen::LLT<Eigen::MatrixXd>(part).info() == Eigen::Success;
    };
    if (signs == InterfaceSigns::checked && ((below > 0 && !definite(0, below, -1.0)) || (above > 0 && !definite(below, above, 1.0))))
        return;
    regular_ = true;

    begin_ = std::move(ldlt.begin);
    row_ = std::move(ldlt.row);
    block_.reserve(row_.size());
    pivot_.reserve(static_cast<std::size_t>(inner_));
    for (int j = 0; j < inner_; ++j) {
        const double l = ldlt.inside[j];
        for (int k = begin_[j]; k < begin_[j + 1]; ++k) {
            const double* const v = ldlt.block[k].v;
            block_.push_back({{v[0] - l * v[2], v[1] - l * v[3], v[2], v[3]}}); // times the inverse of [1 0; l 1]
        }
        for (int k = begin_[j]; k + 1 < begin_[j + 1]; k += 2) join(block_[k], block_[k + 1]);
        const double first = 1.0 / d[2 * j], second = 1.0 / d[2 * j + 1];
        pivot_.push_back({first + l * l * second, -l * second, second});
    }
}

// Both unknowns of a node stand together, column after column. Each column sees the same operations in the same order
// whatever the number of columns.
template <int columns>
void InterfaceFactor::forward_columns(double* const x) const
{
    constexpr int width = 2 * columns;
    for (int j = 0; j < inner_; ++j) {
        double x0[columns], x1[columns];
        for (int column = 0; column < columns; ++column) {
            x0[column] = x[width * j + 2 * column];
            x1[column] = x[width * j + 2 * column + 1];
        }
        const auto take_off = [&](int row, const double* const l, const double* const m) {
            const Pair first = Values(l), second = Values(m);
            double* const y = x + width * row;
            for (int column = 0; column < columns; ++column)
                Eigen::Map<Pair>(y + 2 * column) -= first * x0[column] + second * x1[column];
        };
        int k = begin_[j];
        for (const int end = begin_[j + 1]; k + 1 < end; k += 2) {
            take_off(row_[k], block_[k].v, block_[k + 1].v);
            take_off(row_[k + 1], block_[k].v + 2, block_[k + 1].v + 2);
        }
        if (k < begin_[j + 1]) take_off(row_[k], block_[k].v, block_[k].v + 2);
    }
}

template <int columns>
void InterfaceFactor::backward_columns(double* const x) const
{
    constexpr int width = 2 * columns;
    for (int j = inner_ - 1; j >= 0; --j) {
        Pair first[columns], second[columns], first_odd[columns], second_odd[columns];
        for (int column = 0; column < columns; ++column)
            first[column] = second[column] = first_odd[column] = second_odd[column] = Pair::Zero();
        int k = begin_[j];
        for (const int end = begin_[j + 1]; k + 1 < end; k += 2) { // two sums each: they do not wait for each other
            const double *const l = block_[k].v, *const m = block_[k + 1].v;
            const double *const y = x + width * row_[k], *const z = x + width * row_[k + 1];
            if (row_[k] >= inner_ && rest(y, z, width)) continue;
            for (int column = 0; column < columns; ++column) {
                first[column] += Values(l) * Values(y + 2 * column);
                second[column] += Values(m) * Values(y + 2 * column);
                first_odd[column] += Values(l + 2) * Values(z + 2 * column);
                second_odd[column] += Values(m + 2) * Values(z + 2 * column);
            }
        }
        if (k < begin_[j + 1]) {
            const double *const l = block_[k].v, *const y = x + width * row_[k];
            for (int column = 0; column < columns; ++column) {
                first[column] += Values(l) * Values(y + 2 * column);
                second[column] += Values(l + 2) * Values(y + 2 * column);
            }
        }
        for (int column = 0; column < columns; ++column) {
            const Pair a = first[column] + first_odd[column], b = second[column] + second_odd[column];
            take_pivot(pivot_[j], a[0] + a[1], b[0] + b[1], x + width * j + 2 * column);
        }
    }
}

#if DAMSLIP_HAS_AVX2

namespace {

/// Two nodes side by side; their rows are different.
DAMSLIP_AVX2 inline __m256d both(const double* const y, const double* const z)
{
    return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(y)), _mm_loadu_pd(z), 1);
}

} // namespace

// The addresses are kept aside: a store of vector numbers may alias them as far as the compiler knows.
DAMSLIP_AVX2 void InterfaceFactor::forward_avx2(double* const x) const
{
    const int *row = row_.data(), *begin = begin_.data();
    const double* l = block_.data()->v;
    for (int j = 0, inner = inner_; j < inner; ++j) {
        const __m256d x0 = _mm256_broadcast_sd(x + 2 * j), x1 = _mm256_broadcast_sd(x + 2 * j + 1);
        const int count = begin[j + 1] - begin[j];
        for (const int* const end = row + (count & ~1); row != end; row += 2, l += 8) {
            const __m256d sum =
                _mm256_add_pd(_mm256_mul_pd(_mm256_load_pd(l), x0), _mm256_mul_pd(_mm256_load_pd(l + 4), x1));
            double *const y = x + 2 * row[0], *const z = x + 2 * row[1];
            const __m256d left = _mm256_sub_pd(both(y, z), sum);
            _mm_storeu_pd(y, _mm256_castpd256_pd128(left));
            _mm_storeu_pd(z, _mm256_extractf128_pd(left, 1));
        }
        if (count % 2 == 0) continue;
        const __m128d sum = _mm_add_pd(_mm_mul_pd(_mm_load_pd(l), _mm256_castpd256_pd128(x0)),
                                       _mm_mul_pd(_mm_load_pd(l + 2), _mm256_castpd256_pd128(x1)));
        double* const y = x + 2 * *row;
        _mm_storeu_pd(y, _mm_sub_pd(_mm_loadu_pd(y), sum));
        ++row;
        l += 4;
    }
}

/// Sums of even and of odd blocks side by side.
DAMSLIP_AVX2 void InterfaceFactor::backward_avx2(double* const x) const
{
    const int *const rows = row_.data(), *const begin = begin_.data();
    const Block* const blocks = block_.data();
    for (int j = inner_ - 1, inner = inner_; j >= 0; --j) {
        __m256d first = _mm256_setzero_pd(), second = first;
        const int count = begin[j + 1] - begin[j];
        const int* row = rows + begin[j];
        const double* l = blocks[begin[j]].v;
        for (const int* const end = row + (count & ~1); row != end; row += 2, l += 8) {
            const __m256d values = both(x + 2 * row[0], x + 2 * row[1]);
            const __m256i bits = _mm256_castpd_si256(values);
            if (row[0] >= inner && _mm256_testz_si256(bits, bits)) continue; // jumps of pairs that stick are zero
            first = _mm256_add_pd(first, _mm256_mul_pd(_mm256_load_pd(l), values));
            second = _mm256_add_pd(second, _mm256_mul_pd(_mm256_load_pd(l + 4), values));
        }
        __m128d a = _mm256_castpd256_pd128(first), b = _mm256_castpd256_pd128(second);
        if (count % 2 != 0) {
            const __m128d values = _mm_loadu_pd(x + 2 * *row);
            a = _mm_add_pd(a, _mm_mul_pd(_mm_load_pd(l), values));
            b = _mm_add_pd(b, _mm_mul_pd(_mm_load_pd(l + 2), values));
        }
        a = _mm_add_pd(a, _mm256_extractf128_pd(first, 1));
        b = _mm_add_pd(b, _mm256_extractf128_pd(second, 1));
        take_pivot(pivot_[j], a[0] + a[1], b[0] + b[1], x + 2 * j);
    }
}

/// Two columns side by side.
template <int columns>
DAMSLIP_AVX2 void InterfaceFactor::forward_columns_avx2(double* const x) const
{
    constexpr int width = 2 * columns, halves = columns / 2;
    for (int j = 0; j < inner_; ++j) {
        __m256d x0[halves], x1[halves];
        for (int h = 0; h < halves; ++h) {
            const __m256d here = _mm256_loadu_pd(x + width * j + 4 * h);
            x0[h] = _mm256_movedup_pd(here);
            x1[h] = _mm256_permute_pd(here, 0b1111);
        }
        const auto take_off = [&](int row, const double* const l, const double* const m) DAMSLIP_AVX2 {
            const __m256d first = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(l)),
                          second = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(m));
            double* const y = x + width * row;
            for (int h = 0; h < halves; ++h) {
                const __m256d sum = _mm256_add_pd(_mm256_mul_pd(first, x0[h]), _mm256_mul_pd(second, x1[h]));
                _mm256_storeu_pd(y + 4 * h, _mm256_sub_pd(_mm256_loadu_pd(y + 4 * h), sum));
            }
        };
        int k = begin_[j];
        for (const int end = begin_[j + 1]; k + 1 < end; k += 2) {
            take_off(row_[k], block_[k].v, block_[k + 1].v);
            take_off(row_[k + 1], block_[k].v + 2, block_[k + 1].v + 2);
        }
        if (k < begin_[j + 1]) take_off(row_[k], block_[k].v, block_[k].v + 2);
    }
}

template <int columns>
DAMSLIP_AVX2 void InterfaceFactor::backward_columns_avx2(double* const x) const
{
    constexpr int width = 2 * columns, halves = columns / 2;
    for (int j = inner_ - 1; j >= 0; --j) {
        __m256d first[2][halves], second[2][halves]; // of even and of odd blocks
        for (int parity = 0; parity < 2; ++parity)
            for (int h = 0; h < halves; ++h) first[parity][h] = second[parity][h] = _mm256_setzero_pd();
        const auto add = [&](int parity, int row, const double* const l, const double* const m) DAMSLIP_AVX2 {
            const __m256d of_l = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(l)),
                          of_m = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(m));
            const double* const y = x + width * row;
            for (int h = 0; h < halves; ++h) {
                const __m256d values = _mm256_loadu_pd(y + 4 * h);
                first[parity][h] = _mm256_add_pd(first[parity][h], _mm256_mul_pd(of_l, values));
                second[parity][h] = _mm256_add_pd(second[parity][h], _mm256_mul_pd(of_m, values));
            }
        };
        int k = begin_[j];
        for (const int end = begin_[j + 1]; k + 1 < end; k += 2) {
            if (row_[k] >= inner_ && rest(x + width * row_[k], x + width * row_[k + 1], width)) continue;
            add(0, row_[k], block_[k].v, block_[k + 1].v);
            add(1, row_[k + 1], block_[k].v + 2, block_[k + 1].v + 2);
        }
        if (k < begin_[j + 1]) add(0, row_[k], block_[k].v, block_[k].v + 2);
        for (int h = 0; h < halves; ++h) {
            const __m256d a = _mm256_add_pd(first[0][h], first[1][h]), b = _mm256_add_pd(second[0][h], second[1][h]);
            double* const here = x + width * j + 4 * h;
            take_pivot(pivot_[j], a[0] + a[1], b[0] + b[1], here);
            take_pivot(pivot_[j], a[2] + a[3], b[2] + b[3], here + 2);
        }
    }
}

#endif

template <int columns>
void InterfaceFactor::forward_together(double* const x) const
{
#if DAMSLIP_HAS_AVX2
    if (vector_level() == VectorLevel::avx2) return forward_columns_avx2<columns>(x);
#endif
    forward_columns<columns>(x);
}

template <int columns>
void InterfaceFactor::backward_together(double* const x) const
{
#if DAMSLIP_HAS_AVX2
    if (vector_level() == VectorLevel::avx2) return backward_columns_avx2<columns>(x);
#endif
    backward_columns<columns>(x);
}

void InterfaceFactor::forward_one(double* const x, [[maybe_unused]] VectorLevel level) const
{
#if DAMSLIP_HAS_AVX2
    if (level == VectorLevel::avx2) return forward_avx2(x);
#endif
    forward_columns<1>(x);
}

void InterfaceFactor::backward_one(double* const x, [[maybe_unused]] VectorLevel level) const
{
#if DAMSLIP_HAS_AVX2
    if (level == VectorLevel::avx2) return backward_avx2(x);
#endif
    backward_columns<1>(x);
}

/// Tᵀ b
void InterfaceFactor::to_ties(Eigen::VectorXd& b) const
{
    for (const Tie& tie : ties_) b.segment<2>(2 * tie.lower) += b.segment<2>(2 * tie.upper);
}

/// T x
void InterfaceFactor::from_ties(Eigen::VectorXd& x) const
{
    for (const Tie& tie : ties_) x.segment<2>(2 * tie.upper) += x.segment<2>(2 * tie.lower);
}

void InterfaceFactor::forward(Eigen::VectorXd& b, VectorLevel level) const
{
    to_ties(b);
    forward_one(b.data(), level);
}

void InterfaceFactor::backward(Eigen::VectorXd& b, VectorLevel level) const
{
    backward_one(b.data(), level);
    from_ties(b);
}

namespace {

/// Columns side by side, node by node, and back.
void gather(std::span<Eigen::VectorXd* const> vectors, std::vector<double>& together)
{
    const std::size_t columns = vectors.size(), nodes = static_cast<std::size_t>(vectors[0]->size()) / 2;
    together.resize(2 * columns * nodes);
    for (std::size_t column = 0; column < columns; ++column)
        for (std::size_t node = 0; node < nodes; ++node)
            for (const std::size_t c : {0, 1})
                together[2 * (columns * node + column) + c] = vectors[column]->data()[2 * node + c];
}

void scatter(const std::vector<double>& together, std::span<Eigen::VectorXd* const> vectors)
{
    const std::size_t columns = vectors.size(), nodes = static_cast<std::size_t>(vectors[0]->size()) / 2;
    for (std::size_t column = 0; column < columns; ++column)
        for (std::size_t node = 0; node < nodes; ++node)
            for (const std::size_t c : {0, 1})
                vectors[column]->data()[2 * node + c] = together[2 * (columns * node + column) + c];
}

/// In groups of four, then two, then one.
template <class One, class Two, class Four>
void in_groups(std::span<Eigen::VectorXd* const> vectors, std::vector<double>& together, One one, Two two, Four four)
{
    while (!vectors.empty()) {
        const std::size_t columns = vectors.size() >= 4 ? 4 : vectors.size() >= 2 ? 2 : 1;
        const auto group = vectors.first(columns);
        if (columns == 1) {
            one(group[0]->data());
        } else {
            gather(group, together);
            columns == 4 ? four(together.data()) : two(together.data());
            scatter(together, group);
        }
        vectors = vectors.subspan(columns);
    }
}

} // namespace

void InterfaceFactor::forward(std::span<Eigen::VectorXd* const> b, std::vector<double>& gathered) const
{
    for (Eigen::VectorXd* one : b) to_ties(*one);
    in_groups(
        b, gathered, [this](double* x) { forward_one(x, vector_level()); },
        [this](double* x) { forward_together<2>(x); }, [this](double* x) { forward_together<4>(x); });
}

void InterfaceFactor::backward(std::span<Eigen::VectorXd* const> b, std::vector<double>& gathered) const
{
    in_groups(
        b, gathered, [this](double* x) { backward_one(x, vector_level()); },
        [this](double* x) { backward_together<2>(x); }, [this](double* x) { backward_together<4>(x); });
    for (Eigen::VectorXd* one : b) from_ties(*one);
}

double InterfaceFactor::inner_product(const Eigen::Ref<const Eigen::VectorXd>& a,
                                      const Eigen::Ref<const Eigen::VectorXd>& b) const
{
    double sum = 0.0;
    for (int j = 0; j < inner_; ++j) {
        const Pivot& p = pivot_[j];
        sum +=
            a[2 * j] * (p.xx * b[2 * j] + p.xy * b[2 * j + 1]) + a[2 * j + 1] * (p.xy * b[2 * j] + p.yy * b[2 * j + 1]);
    }
    return sum;
}

std::size_t InterfaceFactor::bytes() const
{
    return block_.size() * sizeof(Block) + (row_.size() + begin_.size()) * sizeof(int) + pivot_.size() * sizeof(Pivot) +
           static_cast<std::size_t>(schur_.size()) * sizeof(double);
}

} // namespace damslip::fe2d
