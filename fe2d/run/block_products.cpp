#include "fe2d/run/block_products.hpp"

#include <algorithm>

#if DAMSLIP_HAS_AVX2
#include <immintrin.h>
#endif

namespace damslip::fe2d {

BlockProducts::BlockProducts(const SparseMatrix& stiffness, const SparseMatrix& mass)
{
    // Symmetric matrices: the columns of node j hold its row of blocks, transposed.
    const int nodes = static_cast<int>(stiffness.cols() / 2);
    std::vector<int> place(nodes, -1);
    std::vector<Block> of_mass;
    begin_.push_back(0);
    for (int j = 0; j < nodes; ++j) {
        const std::size_t first = column_.size();
        of_mass.clear();
        const auto add = [&](const SparseMatrix& matrix, bool is_mass) {
            for (const int c : {0, 1})
                for (SparseMatrix::InnerIterator it(matrix, 2 * j + c); it; ++it) {
                    const int other = static_cast<int>(it.row() / 2);
                    if (place[other] < 0) {
                        place[other] = static_cast<int>(column_.size());
                        column_.push_back(other);
                        stiffness_.push_back({});
                        of_mass.push_back({});
                    }
                    Block& block = is_mass ? of_mass[place[other] - first] : stiffness_[place[other]];
                    // entry (2 other + d, 2 j + c) = entry (2 j + c, 2 other + d)
                    block.v[2 * (it.row() % 2) + c] = it.value();
                }
        };
        add(stiffness, false);
        add(mass, true);
        for (std::size_t k = first; k < column_.size(); ++k) place[column_[k]] = -1;
        begin_.push_back(static_cast<int>(column_.size()));
        const bool alike = std::all_of(of_mass.begin(), of_mass.end(), [](const Block& b) {
            return b.v[0] == b.v[3] && b.v[1] == 0.0 && b.v[2] == 0.0;
        });
        full_begin_.push_back(alike ? -1 : static_cast<int>(full_mass_.size()));
        for (const Block& b : of_mass) mass_.push_back(b.v[0]);
        if (!alike) full_mass_.insert(full_mass_.end(), of_mass.begin(), of_mass.end());
    }
}

std::size_t BlockProducts::bytes() const
{
    return (stiffness_.size() + full_mass_.size()) * sizeof(Block) + mass_.size() * sizeof(double) +
           (column_.size() + begin_.size() + full_begin_.size()) * sizeof(int);
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
            const double *const b = stiffness_[e].v, *const g = gathered + 8 * column_[e];
            const Pair kx = Values(b), ky = Values(b + 2);
            k1 += kx * g[0] + ky * g[1];
            k2 += kx * g[2] + ky * g[3];
            if (full_begin_[j] < 0) {
                m1 += mass_[e] * Values(g + 4);
                m2 += mass_[e] * Values(g + 6);
            } else {
                const double* const m = full_mass(j)[e - begin_[j]].v;
                m1 += Values(m) * g[4] + Values(m + 2) * g[5];
                m2 += Values(m) * g[6] + Values(m + 2) * g[7];
            }
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
            const double *const b = stiffness_[e].v, *const y = x.data() + 2 * column_[e];
            k += Values(b) * y[0] + Values(b + 2) * y[1];
            if (full_begin_[j] < 0) {
                m += mass_[e] * Values(y);
            } else {
                const double* const of_mass = full_mass(j)[e - begin_[j]].v;
                m += Values(of_mass) * y[0] + Values(of_mass + 2) * y[1];
            }
        }
        stiffness.segment<2>(2 * j) = k.matrix();
        mass.segment<2>(2 * j) = m.matrix();
    }
}

#if DAMSLIP_HAS_AVX2

namespace {

/// A block by two vectors side by side, [x0, x1, y0, y1].
DAMSLIP_AVX2 inline __m256d times_two(const double* const block, __m256d vectors)
{
    const __m256d x = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(block)),
                  y = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(block + 2));
    return _mm256_add_pd(_mm256_mul_pd(x, _mm256_movedup_pd(vectors)),
                         _mm256_mul_pd(y, _mm256_permute_pd(vectors, 0b1111)));
}

/// A block by one vector.
DAMSLIP_AVX2 inline __m128d times_one(const double* const block, const double* const x)
{
    const __m256d both = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(x));
    const __m256d terms = _mm256_mul_pd(_mm256_load_pd(block), _mm256_permute_pd(both, 0b1100)); // x0, x0, x1, x1
    return _mm_add_pd(_mm256_castpd256_pd128(terms), _mm256_extractf128_pd(terms, 1));
}

} // namespace

/// Two vectors of one matrix side by side: [K x1, K x2] and [M x3, M x4].
DAMSLIP_AVX2 void BlockProducts::multiply_avx2(const double* const gathered, Products& out) const
{
    const int nodes = static_cast<int>(begin_.size()) - 1;
    const int* column = column_.data();
    const double *of_k = stiffness_.data()->v, *mass = mass_.data();
    double *const k1 = out.stiffness_1.data(), *const k2 = out.stiffness_2.data(), *const m1 = out.mass_1.data(),
                  *const m2 = out.mass_2.data();
    for (int j = 0; j < nodes; ++j) {
        __m256d k = _mm256_setzero_pd(), m = k;
        const int* const end = column + (begin_[j + 1] - begin_[j]);
        if (full_begin_[j] < 0) {
            for (; column != end; ++column, of_k += 4, ++mass) {
                const double* const g = gathered + 8 * *column;
                k = _mm256_add_pd(k, times_two(of_k, _mm256_loadu_pd(g)));
                m = _mm256_add_pd(m, _mm256_mul_pd(_mm256_broadcast_sd(mass), _mm256_loadu_pd(g + 4)));
            }
        } else {
            for (const double* of_m = full_mass(j)->v; column != end; ++column, of_k += 4, ++mass, of_m += 4) {
                const double* const g = gathered + 8 * *column;
                k = _mm256_add_pd(k, times_two(of_k, _mm256_loadu_pd(g)));
                m = _mm256_add_pd(m, times_two(of_m, _mm256_loadu_pd(g + 4)));
            }
        }
        _mm_storeu_pd(k1 + 2 * j, _mm256_castpd256_pd128(k));
        _mm_storeu_pd(k2 + 2 * j, _mm256_extractf128_pd(k, 1));
        _mm_storeu_pd(m1 + 2 * j, _mm256_castpd256_pd128(m));
        _mm_storeu_pd(m2 + 2 * j, _mm256_extractf128_pd(m, 1));
    }
}

/// K x and M x of one vector.
DAMSLIP_AVX2 void BlockProducts::multiply_avx2(const double* const x, double* const stiffness, double* const mass) const
{
    const int nodes = static_cast<int>(begin_.size()) - 1;
    for (int j = 0; j < nodes; ++j) {
        __m128d k = _mm_setzero_pd(), m = k;
        const int begin = begin_[j], end = begin_[j + 1];
        if (full_begin_[j] < 0) {
            for (int e = begin; e < end; ++e) {
                const double* const y = x + 2 * column_[e];
                k = _mm_add_pd(k, times_one(stiffness_[e].v, y));
                m = _mm_add_pd(m, _mm_mul_pd(_mm_set1_pd(mass_[e]), _mm_loadu_pd(y)));
            }
        } else {
            const Block* const of_mass = full_mass(j);
            for (int e = begin; e < end; ++e) {
                const double* const y = x + 2 * column_[e];
                k = _mm_add_pd(k, times_one(stiffness_[e].v, y));
                m = _mm_add_pd(m, times_one(of_mass[e - begin].v, y));
            }
        }
        _mm_storeu_pd(stiffness + 2 * j, k);
        _mm_storeu_pd(mass + 2 * j, m);
    }
}

#endif

} // namespace damslip::fe2d
