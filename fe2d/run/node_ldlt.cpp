#include "fe2d/run/node_ldlt.hpp"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <array>

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

/// Tree of elimination of the nodes and their blocks in L.
struct Pattern {
    std::vector<int> parent, begin;
};

Pattern pattern_of(const LowerRows& rows)
{
    const std::size_t nodes = rows.begin.size() - 1;
    Pattern pattern{std::vector<int>(nodes, -1), std::vector<int>(nodes + 1, 0)};
    std::vector<int> seen(nodes, -1);
    for (int k = 0; k < static_cast<int>(nodes); ++k) {
        seen[k] = k;
        for (int p = rows.begin[k]; p < rows.begin[k + 1]; ++p)
            for (int i = rows.column[p]; seen[i] != k; i = pattern.parent[i]) {
                if (pattern.parent[i] < 0) pattern.parent[i] = k;
                ++pattern.begin[i + 1];
                seen[i] = k;
            }
    }
    for (std::size_t k = 1; k <= nodes; ++k) pattern.begin[k] += pattern.begin[k - 1];
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

NodeLdlt by_nodes(const LowerRows& rows, const VectorXd& added, [[maybe_unused]] VectorLevel level)
{
    auto* take = take_off;
#if DAMSLIP_HAS_AVX2
    if (level == VectorLevel::avx2) take = take_off_avx2;
#endif
    const int nodes = static_cast<int>(rows.begin.size()) - 1;
    Pattern pattern = pattern_of(rows);
    NodeLdlt f;
    f.row.resize(static_cast<std::size_t>(pattern.begin.back()));
    f.block.resize(f.row.size());
    f.inside.resize(static_cast<std::size_t>(nodes));
    f.diagonal.resize(2 * nodes);
    double* const d = f.diagonal.data();
    std::vector<int> end = pattern.begin; // of what each column has so far
    std::vector<int> path(static_cast<std::size_t>(nodes)), seen(static_cast<std::size_t>(nodes), -1);
    std::vector<Rows> left(static_cast<std::size_t>(nodes));
    for (int k = 0; k < nodes; ++k) {
        int top = nodes; // columns of this row, each behind those it depends on, from here to the end of `path`
        seen[k] = k;
        const int last = rows.begin[k + 1] - 1; // the diagonal block
        for (int p = rows.begin[k]; p < last; ++p) {
            for (int c = 0; c < 4; ++c) left[rows.column[p]].v[c] += rows.block[p].v[c];
            int length = 0;
            for (int i = rows.column[p]; seen[i] != k; i = pattern.parent[i]) {
                path[length++] = i;
                seen[i] = k;
            }
            while (length > 0) path[--top] = path[--length];
        }
        const double* const here = rows.block[last].v;
        double d0 = here[0] + added[2 * k], e = here[2], d1 = here[3] + added[2 * k + 1];
        for (; top < nodes; ++top) {
            const int j = path[top], from = pattern.begin[j], to = end[j]++;
            Rows y = left[j];
            left[j] = {};
            y.v[1] -= f.inside[j] * y.v[0];
            y.v[3] -= f.inside[j] * y.v[2];
            take(f.block.data() + from, f.row.data() + from, f.row.data() + to, y, left.data());
            const double l00 = y.v[0] / d[2 * j], l01 = y.v[1] / d[2 * j + 1], l10 = y.v[2] / d[2 * j],
                         l11 = y.v[3] / d[2 * j + 1];
            d0 = (d0 - l00 * y.v[0]) - l01 * y.v[1];
            e = (e - l00 * y.v[2]) - l01 * y.v[3];
            d1 = (d1 - l10 * y.v[2]) - l11 * y.v[3];
            f.row[to] = k;
            f.block[to] = {{l00, l10, l01, l11}};
        }
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

/// Unknown by unknown.
NodeLdlt by_unknowns(const SparseMatrix& matrix, const VectorXd& added)
{
    SparseMatrix shifted = matrix;
    for (Index k = 0; k < added.size(); ++k)
        if (added[k] != 0.0) shifted.coeffRef(k, k) += added[k];
    const Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::NaturalOrdering<int>> ldlt(shifted);
    NodeLdlt f;
    if (ldlt.info() != Eigen::Success) return f;
    f.exists = true;
    f.diagonal = ldlt.vectorD();
    const auto& lower = ldlt.matrixL().nestedExpression(); // CSC without the unit diagonal, rows ascending
    const Index n = matrix.rows();
    f.begin.assign(1, 0);
    for (int j = 0; j < n / 2; ++j) {
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

NodeLdlt node_ldlt(const SparseMatrix& matrix, const VectorXd& added, VectorLevel level)
{
    return in_node_blocks(matrix) ? by_nodes(lower_rows(matrix), added, level) : by_unknowns(matrix, added);
}

} // namespace damslip::fe2d
