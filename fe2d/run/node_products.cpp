#include "fe2d/run/node_products.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

namespace damslip::fe2d {

Eigen::VectorXd NodeOrder::to_new(const Eigen::VectorXd& old_vector) const
{
    Eigen::VectorXd result(old_vector.size());
    for (int k = 0; k < nodes(); ++k) result.segment<2>(2 * k) = old_vector.segment<2>(2 * old_node[k]);
    return result;
}

Eigen::VectorXd NodeOrder::to_old(const Eigen::VectorXd& new_vector) const
{
    Eigen::VectorXd result(new_vector.size());
    for (int k = 0; k < nodes(); ++k) result.segment<2>(2 * old_node[k]) = new_vector.segment<2>(2 * k);
    return result;
}

SparseMatrix NodeOrder::to_new(const SparseMatrix& old_matrix) const
{
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(static_cast<std::size_t>(old_matrix.nonZeros()));
    const auto place = [&](int unknown) { return 2 * new_node[unknown / 2] + unknown % 2; };
    for (int column = 0; column < old_matrix.outerSize(); ++column)
        for (SparseMatrix::InnerIterator it(old_matrix, column); it; ++it)
            entries.emplace_back(place(static_cast<int>(it.row())), place(column), it.value());
    SparseMatrix result(old_matrix.rows(), old_matrix.cols());
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

SparseMatrix tied(const SparseMatrix& matrix, std::span<const Tie> ties)
{
    if (ties.empty()) return matrix;
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < matrix.rows(); ++i) entries.emplace_back(i, i, 1.0);
    for (const Tie& tie : ties)
        for (const int c : {0, 1}) entries.emplace_back(2 * tie.upper + c, 2 * tie.lower + c, 1.0);
    SparseMatrix t(matrix.rows(), matrix.cols());
    t.setFromTriplets(entries.begin(), entries.end());
    const SparseMatrix half = matrix * t;
    return t.transpose() * half;
}

NodeOrder interface_last(const SparseMatrix& matrix, std::span<const int> interface_nodes)
{
    assert(matrix.rows() % 2 == 0);
    const int nodes = static_cast<int>(matrix.rows() / 2);
    NodeOrder order;
    order.new_node.assign(nodes, 0);
    for (const int node : interface_nodes) order.new_node[node] = -1;
    std::vector<int> inner;
    for (int node = 0; node < nodes; ++node)
        if (order.new_node[node] == 0) {
            order.new_node[node] = static_cast<int>(inner.size());
            inner.push_back(node);
        }
    order.inner = static_cast<int>(inner.size());

    std::vector<Eigen::Triplet<double>> edges;
    for (int column = 0; column < matrix.outerSize(); column += 2)
        for (int c = column; c < column + 2; ++c)
            for (SparseMatrix::InnerIterator it(matrix, c); it; ++it) {
                const int a = order.new_node[it.row() / 2], b = order.new_node[column / 2];
                if (a >= 0 && b >= 0) edges.emplace_back(a, b, 1.0);
            }
    SparseMatrix graph(order.inner, order.inner);
    graph.setFromTriplets(edges.begin(), edges.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation(order.inner);
    if (order.inner > 0) Eigen::AMDOrdering<int>()(graph, permutation);
    for (int k = 0; k < order.inner; ++k) order.old_node.push_back(inner[permutation.indices()[k]]);
    for (const int node : interface_nodes) order.old_node.push_back(node);
    for (int k = 0; k < nodes; ++k) order.new_node[order.old_node[k]] = k;
    return order;
}

} // namespace damslip::fe2d

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

#if DAMSLIP_HAS_AVX2
#include <immintrin.h>
#endif

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

using Pair = Eigen::Array2d;
using Values = Eigen::Map<const Pair>;

/// What is left of both rows of a node in one column of nodes: (2k, 2j), (2k, 2j+1), (2k+1, 2j), (2k+1, 2j+1).
struct alignas(32) Rows {
    double v[4] = {0.0, 0.0, 0.0, 0.0};
};

/// Blocks of the lower triangle by rows of nodes, columns ascending, the diagonal block last.
struct LowerRows {
    std::vector<int> begin, column;
    std::vector<Rows> block;
};

/// Hands over each block of the lower triangle, column by column of nodes, with its row and column.
template <class Use>
void for_lower_blocks(const SparseMatrix& matrix, const Use& use)
{
    const int *const outer = matrix.outerIndexPtr(), *const inner = matrix.innerIndexPtr();
    const double* const value = matrix.valuePtr();
    const int none = static_cast<int>(matrix.cols());
    for (int j = 0; j < none / 2; ++j) {
        int a = outer[2 * j], b = outer[2 * j + 1];
        const int a_end = b, b_end = outer[2 * j + 2];
        while (a < a_end && inner[a] < 2 * j) ++a;
        while (b < b_end && inner[b] < 2 * j) ++b;
        while (a < a_end || b < b_end) {
            const int i = std::min(a < a_end ? inner[a] : none, b < b_end ? inner[b] : none) / 2;
            Rows block;
            for (; a < a_end && inner[a] / 2 == i; ++a) block.v[2 * (inner[a] % 2)] = value[a];
            for (; b < b_end && inner[b] / 2 == i; ++b) block.v[2 * (inner[b] % 2) + 1] = value[b];
            use(i, j, block);
        }
    }
}

LowerRows lower_rows(const SparseMatrix& matrix)
{
    LowerRows rows;
    rows.begin.assign(static_cast<std::size_t>(matrix.cols()) / 2 + 1, 0);
    for_lower_blocks(matrix, [&](int i, int, const Rows&) { ++rows.begin[static_cast<std::size_t>(i) + 1]; });
    for (std::size_t k = 1; k < rows.begin.size(); ++k) rows.begin[k] += rows.begin[k - 1];
    rows.column.resize(static_cast<std::size_t>(rows.begin.back()));
    rows.block.resize(rows.column.size());
    std::vector<int> next = rows.begin;
    for_lower_blocks(matrix, [&](int i, int j, const Rows& block) {
        const auto at = static_cast<std::size_t>(next[static_cast<std::size_t>(i)]++);
        rows.column[at] = j;
        rows.block[at] = block;
    });
    return rows;
}

/// Tree of elimination of the first nodes and their blocks in L.
struct Pattern {
    std::vector<int> parent, begin;
};

Pattern pattern_of(const LowerRows& rows, int eliminated)
{
    const std::size_t nodes = rows.begin.size() - 1, columns = static_cast<std::size_t>(eliminated);
    Pattern pattern{std::vector<int>(columns, -1), std::vector<int>(columns + 1, 0)};
    std::vector<int> seen(nodes, -1);
    for (int k = 0; k < static_cast<int>(nodes); ++k) {
        seen[k] = k;
        for (int p = rows.begin[k]; p < rows.begin[k + 1]; ++p)
            for (int i = rows.column[p]; i < eliminated && seen[i] != k; i = pattern.parent[i]) {
                if (pattern.parent[i] < 0) pattern.parent[i] = k;
                ++pattern.begin[i + 1];
                seen[i] = k;
            }
    }
    for (std::size_t k = 1; k <= columns; ++k) pattern.begin[k] += pattern.begin[k - 1];
    return pattern;
}

/// Takes the blocks of a column times the numbers `y` of both rows in it off what is left of the rows.
void take_off(const NodeLdlt::Block* block, const int* row, const int* const end, const Rows& y, Rows* const left)
{
    for (; row != end; ++row, ++block) {
        const Values first(block->v), second(block->v + 2);
        double* const x = left[*row].v;
        Eigen::Map<Pair> upper(x), lower(x + 2);
        upper = (upper - first * y.v[0]) - second * y.v[1];
        lower = (lower - first * y.v[2]) - second * y.v[3];
    }
}

#if DAMSLIP_HAS_AVX2
DAMSLIP_AVX2 void take_off_avx2(const NodeLdlt::Block* block, const int* row, const int* const end, const Rows& y,
                                Rows* const left)
{
    const __m256d both = _mm256_load_pd(y.v), of_first = _mm256_movedup_pd(both),
                  of_second = _mm256_permute_pd(both, 0b1111);
    for (; row != end; ++row, ++block) {
        const __m256d first = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(block->v)),
                      second = _mm256_broadcast_pd(reinterpret_cast<const __m128d*>(block->v + 2));
        double* const x = left[*row].v;
        const __m256d less = _mm256_sub_pd(_mm256_load_pd(x), _mm256_mul_pd(first, of_first));
        _mm256_store_pd(x, _mm256_sub_pd(less, _mm256_mul_pd(second, of_second)));
    }
}
#endif

NodeLdlt by_nodes(const LowerRows& rows, int eliminated, [[maybe_unused]] VectorLevel level)
{
    auto* take = take_off;
#if DAMSLIP_HAS_AVX2
    if (level == VectorLevel::avx2) take = take_off_avx2;
#endif
    const int nodes = static_cast<int>(rows.begin.size()) - 1;
    Pattern pattern = pattern_of(rows, eliminated);
    NodeLdlt f;
    f.row.resize(static_cast<std::size_t>(pattern.begin.back()));
    f.block.resize(f.row.size());
    f.inside.resize(static_cast<std::size_t>(eliminated));
    f.diagonal.resize(2 * eliminated);
    double* const d = f.diagonal.data();
    std::vector<int> end = pattern.begin; // of what each column has so far
    std::vector<int> above = end;         // the same, of the rows that are eliminated
    std::vector<int> path(static_cast<std::size_t>(nodes)), seen(static_cast<std::size_t>(nodes), -1);
    std::vector<Rows> left(static_cast<std::size_t>(nodes));
    for (int k = 0; k < nodes; ++k) {
        const bool stays = k >= eliminated;
        int top = nodes; // columns of this row, each behind those it depends on, from here to the end of `path`
        seen[k] = k;
        const int last = rows.begin[k + 1] - 1; // the diagonal block
        for (int p = rows.begin[k]; p < last && rows.column[p] < eliminated; ++p) {
            for (int c = 0; c < 4; ++c) left[rows.column[p]].v[c] += rows.block[p].v[c];
            int length = 0;
            for (int i = rows.column[p]; i < eliminated && seen[i] != k; i = pattern.parent[i]) {
                path[length++] = i;
                seen[i] = k;
            }
            while (length > 0) path[--top] = path[--length];
        }
        const double* const here = rows.block[last].v;
        double d0 = here[0], e = here[2], d1 = here[3];
        for (; top < nodes; ++top) {
            const int j = path[top], from = pattern.begin[j], to = end[j]++;
            Rows y = left[j];
            left[j] = {};
            y.v[1] -= f.inside[j] * y.v[0];
            y.v[3] -= f.inside[j] * y.v[2];
            take(f.block.data() + from, f.row.data() + from, f.row.data() + (stays ? above[j] : to), y, left.data());
            const double l00 = y.v[0] / d[2 * j], l01 = y.v[1] / d[2 * j + 1], l10 = y.v[2] / d[2 * j],
                         l11 = y.v[3] / d[2 * j + 1];
            f.row[to] = k;
            f.block[to] = {{l00, l10, l01, l11}};
            if (stays) continue;
            above[j] = end[j];
            d0 = (d0 - l00 * y.v[0]) - l01 * y.v[1];
            e = (e - l00 * y.v[2]) - l01 * y.v[3];
            d1 = (d1 - l10 * y.v[2]) - l11 * y.v[3];
        }
        if (stays) continue;
        const double l = e / d0;
        d1 -= l * e;
        f.inside[k] = l;
        d[2 * k] = d0;
        d[2 * k + 1] = d1;
        if (d0 == 0.0 || d1 == 0.0) return f;
    }
    f.begin = std::move(pattern.begin);
    f.exists = true;
    return f;
}

/// Unknown by unknown, all of them: the other pivots, doubled so that none is zero, are not used.
NodeLdlt by_unknowns(const SparseMatrix& matrix, int eliminated)
{
    SparseMatrix shifted = matrix;
    for (Index k = 2 * eliminated; k < matrix.rows(); ++k) shifted.coeffRef(k, k) *= 2.0;
    const Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> ldlt(shifted);
    NodeLdlt f;
    if (ldlt.info() != Eigen::Success) return f;
    f.exists = true;
    f.diagonal = ldlt.vectorD().head(2 * eliminated);
    const auto& lower = ldlt.matrixL().nestedExpression(); // CSC without the unit diagonal, rows ascending
    const Index n = matrix.rows();
    f.begin.assign(1, 0);
    for (int j = 0; j < eliminated; ++j) {
        SparseMatrix::InnerIterator a(lower, 2 * j), b(lower, 2 * j + 1);
        while (a && a.row() <= 2 * j) ++a;
        f.inside.push_back(a && a.row() == 2 * j + 1 ? a.value() : 0.0);
        if (a && a.row() == 2 * j + 1) ++a;
        while (b && b.row() <= 2 * j + 1) ++b;
        while (a || b) {
            const Index node = std::min(a ? a.row() : n, b ? b.row() : n) / 2;
            NodeLdlt::Block block{{0.0, 0.0, 0.0, 0.0}};
            for (; a && a.row() / 2 == node; ++a) block.v[a.row() % 2] = a.value();
            for (; b && b.row() / 2 == node; ++b) block.v[2 + b.row() % 2] = b.value();
            f.row.push_back(static_cast<int>(node));
            f.block.push_back(block);
        }
        f.begin.push_back(static_cast<int>(f.row.size()));
    }
    return f;
}

} // namespace

bool in_node_blocks(const SparseMatrix& matrix)
{
    if (!matrix.isCompressed() || matrix.cols() % 2 != 0) return false;
    const int *const outer = matrix.outerIndexPtr(), *const inner = matrix.innerIndexPtr();
    const auto alone = [&](int u) { return outer[u + 1] == outer[u] + 1 && inner[outer[u]] == u; };
    for (int u = 0; u < matrix.cols(); ++u) {
        if (alone(u)) continue;
        const int *row = inner + outer[u], *const end = inner + outer[u + 1];
        if (!std::binary_search(row, end, u)) return false;
        if (u % 2 != 0 && !alone(u - 1) && !std::equal(inner + outer[u - 1], row, row, end)) return false;
        while (row != end) { // all of a node that do not stand alone, or none
            const int* const first = row;
            const int node = *row / 2;
            for (const int i : {2 * node, 2 * node + 1})
                if (!alone(i) && (row == end || *row++ != i)) return false;
            if (row == first) return false;
        }
    }
    return true;
}

NodeLdlt node_ldlt(const SparseMatrix& matrix, int eliminated, VectorLevel level)
{
    return in_node_blocks(matrix) ? by_nodes(lower_rows(matrix), eliminated, level) : by_unknowns(matrix, eliminated);
}

Eigen::MatrixXd NodeLdlt::schur(const SparseMatrix& matrix) const
{
    constexpr int together = 32; // columns of nodes whose rows are mostly the same
    const int eliminated = static_cast<int>(begin.size()) - 1;
    const Index first = 2 * eliminated, rest = matrix.rows() - first;
    Eigen::MatrixXd schur = matrix.bottomRightCorner(rest, rest);
    std::vector<int> place(static_cast<std::size_t>(rest / 2), -1), nodes;
    Eigen::MatrixXd l, product;
    for (int j = 0; j < eliminated; j += together) {
        const int last = std::min(eliminated, j + together);
        nodes.clear();
        for (int k = begin[j]; k < begin[last]; ++k)
            if (const int node = row[k] - eliminated; node >= 0 && std::exchange(place[node], 0) < 0) nodes.push_back(node);
        std::sort(nodes.begin(), nodes.end());
        for (std::size_t i = 0; i < nodes.size(); ++i) place[nodes[i]] = static_cast<int>(i);
        l.setZero(2 * static_cast<Index>(nodes.size()), 2 * (last - j));
        for (int column = j; column < last; ++column)
            for (int k = begin[column]; k < begin[column + 1]; ++k)
                if (row[k] >= eliminated)
                    l.block<2, 2>(2 * place[row[k] - eliminated], 2 * (column - j)) =
                        Eigen::Map<const Eigen::Matrix2d>(block[k].v);
        product.resize(l.rows(), l.rows());
        product.triangularView<Eigen::Lower>() = (l * diagonal.segment(2 * j, l.cols()).asDiagonal()).eval() * l.transpose();
        const auto unknown = [&nodes](Index k) { return 2 * nodes[static_cast<std::size_t>(k / 2)] + k % 2; };
        for (Index b = 0; b < product.cols(); ++b)
            for (Index a = b; a < product.rows(); ++a) schur(unknown(a), unknown(b)) -= product(a, b);
        for (const int node : nodes) place[node] = -1;
    }
    schur.triangularView<Eigen::StrictlyUpper>() = schur.transpose();
    return schur;
}

} // namespace damslip::fe2d
