#include "fe2d/run/block_products.hpp"

#if DAMSLIP_HAS_AVX2
#include <immintrin.h>
#endif

namespace damslip::fe2d {

BlockProducts::BlockProducts(const SparseMatrix& stiffness, const SparseMatrix& mass)
{
    // Symmetric matrices: the columns of node j hold its row of blocks, transposed.
    const int nodes = static_cast<int>(stiffness.cols() / 2);
    std::vector<int> place(nodes, -1);
    begin_.push_back(0);
    for (int j = 0; j < nodes; ++j) {
        const std::size_t first = column_.size();
        const auto add = [&](const SparseMatrix& matrix, double(Block::*values)[4]) {
            for (const int c : {0, 1})
                for (SparseMatrix::InnerIterator it(matrix, 2 * j + c); it; ++it) {
                    const int other = static_cast<int>(it.row() / 2);
                    if (place[other] < 0) {
                        place[other] = static_cast<int>(column_.size());
                        column_.push_back(other);
                        block_.push_back({});
                    }
                    // entry (2 other + d, 2 j + c) = entry (2 j + c, 2 other + d)
                    (block_[place[other]].*values)[2 * (it.row() % 2) + c] = it.value();
                }
        };
        add(stiffness, &Block::k);
        add(mass, &Block::m);
        for (std::size_t k = first; k < column_.size(); ++k) place[column_[k]] = -1;
        begin_.push_back(static_cast<int>(column_.size()));
    }
}

void BlockProducts::multiply(const ProductVectors& in, Products& out, [[maybe_unused]] VectorLevel level) const
{
    const int nodes = static_cast<int>(begin_.size()) - 1;
    for (Eigen::VectorXd* y : {&out.stiffness_1, &out.stiffness_2, &out.mass_1, &out.mass_2}) y->resize(2 * nodes);
    out.gathered.resize(static_cast<std::size_t>(8 * nodes));
    double* const gathered = out.gathered.data();
    const Eigen::VectorXd* const x[4] = {&in.stiffness_1, &in.stiffness_2, &in.mass_1, &in.mass_2};
    for (int j = 0; j < nodes; ++j)
        for (int v = 0; v < 4; ++v) {
            gathered[8 * j + 2 * v] = (*x[v])[2 * j];
            gathered[8 * j + 2 * v + 1] = (*x[v])[2 * j + 1];
        }
#if DAMSLIP_HAS_AVX2
    if (level == VectorLevel::avx2) return multiply_avx2(gathered, out);
#endif
    using Pair = Eigen::Array2d;
    using Values = Eigen::Map<const Pair>;
    for (int j = 0; j < nodes; ++j) {
        Pair k1 = Pair::Zero(), k2 = k1, m1 = k1, m2 = k1;
        for (int e = begin_[j]; e < begin_[j + 1]; ++e) {
            const Block& b = block_[e];
            const double* const g = gathered + 8 * column_[e];
            const Pair kx = Values(b.k), ky = Values(b.k + 2), mx = Values(b.m), my = Values(b.m + 2);
            k1 += kx * g[0] + ky * g[1];
            k2 += kx * g[2] + ky * g[3];
            m1 += mx * g[4] + my * g[5];
            m2 += mx * g[6] + my * g[7];
        }
        out.stiffness_1.segment<2>(2 * j) = k1.matrix();
        out.stiffness_2.segment<2>(2 * j) = k2.matrix();
        out.mass_1.segment<2>(2 * j) = m1.matrix();
        out.mass_2.segment<2>(2 * j) = m2.matrix();
    }
}

void BlockProducts::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& stiffness, Eigen::VectorXd& mass,
                             [[maybe_unused]] VectorLevel level) const
{
    const int nodes = static_cast<int>(begin_.size()) - 1;
    stiffness.resize(2 * nodes);
    mass.resize(2 * nodes);
#if DAMSLIP_HAS_AVX2
    if (level == VectorLevel::avx2) return multiply_avx2(x.data(), stiffness.data(), mass.data());
#endif
    using Pair = Eigen::Array2d;
    using Values = Eigen::Map<const Pair>;
    for (int j = 0; j < nodes; ++j) {
        Pair k = Pair::Zero(), m = k;
        for (int e = begin_[j]; e < begin_[j + 1]; ++e) {
            const Block& b = block_[e];
            const double x0 = x[2 * column_[e]], x1 = x[2 * column_[e] + 1];
            k += Values(b.k) * x0 + Values(b.k + 2) * x1;
            m += Values(b.m) * x0 + Values(b.m + 2) * x1;
        }
        stiffness.segment<2>(2 * j) = k.matrix();
        mass.segment<2>(2 * j) = m.matrix();
    }
}

#if DAMSLIP_HAS_AVX2

/// Two vectors of one matrix side by side: [K x1, K x2] and [M x3, M x4].
DAMSLIP_AVX2 void BlockProducts::multiply_avx2(const double* const gathered, Products& out) const
{
    const int nodes = static_cast<int>(begin_.size()) - 1;
    double *const k1 = out.stiffness_1.data(), *const k2 = out.stiffness_2.data(), *const m1 = out.mass_1.data(),
                  *const m2 = out.mass_2.data();
    for (int j = 0; j < nodes; ++j) {
        __m256d k = _mm256_setzero_pd(), m = k;
        for (int e = begin_[j]; e < begin_[j + 1]; ++e) {
            const Block& b = block_[e];
            const double* const g = gathered + 8 * column_[e];
            const __m256d of_k = _mm256_loadu_pd(g), of_m = _mm256_loadu_pd(g + 4);
            const __m256d kx = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(b.k)),
                          ky = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(b.k + 2)),
                          mx = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(b.m)),
                          my = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(b.m + 2));
            k = _mm256_add_pd(k, _mm256_add_pd(_mm256_mul_pd(kx, _mm256_movedup_pd(of_k)),
                                               _mm256_mul_pd(ky, _mm256_permute_pd(of_k, 0b1111))));
            m = _mm256_add_pd(m, _mm256_add_pd(_mm256_mul_pd(mx, _mm256_movedup_pd(of_m)),
                                               _mm256_mul_pd(my, _mm256_permute_pd(of_m, 0b1111))));
        }
        _mm_storeu_pd(k1 + 2 * j, _mm256_castpd256_pd128(k));
        _mm_storeu_pd(k2 + 2 * j, _mm256_extractf128_pd(k, 1));
        _mm_storeu_pd(m1 + 2 * j, _mm256_castpd256_pd128(m));
        _mm_storeu_pd(m2 + 2 * j, _mm256_extractf128_pd(m, 1));
    }
}

/// Both matrices side by side: [K x, M x].
DAMSLIP_AVX2 void BlockProducts::multiply_avx2(const double* const x, double* const stiffness, double* const mass) const
{
    const int nodes = static_cast<int>(begin_.size()) - 1;
    for (int j = 0; j < nodes; ++j) {
        __m256d sum = _mm256_setzero_pd();
        for (int e = begin_[j]; e < begin_[j + 1]; ++e) {
            const Block& b = block_[e];
            const __m256d both = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(x + 2 * column_[e]));
            const __m256d values = _mm256_permute_pd(both, 0b1100); // x0, x0, x1, x1
            const __m256d k = _mm256_mul_pd(_mm256_load_pd(b.k), values),
                          m = _mm256_mul_pd(_mm256_load_pd(b.m), values);
            sum = _mm256_add_pd(sum,
                                _mm256_add_pd(_mm256_permute2f128_pd(k, m, 0x20), _mm256_permute2f128_pd(k, m, 0x31)));
        }
        _mm_storeu_pd(stiffness + 2 * j, _mm256_castpd256_pd128(sum));
        _mm_storeu_pd(mass + 2 * j, _mm256_extractf128_pd(sum, 1));
    }
}

#endif

} // namespace damslip::fe2d
