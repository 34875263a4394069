#include "fe2d/time/condensation.hpp"

#include <algorithm>
#include <cassert>

namespace damslip::fe2d {

using Eigen::Index;

namespace {

constexpr Index columns_at_once = 16; // what the solver takes at a time; no dense copy of all of K_ic

SparseMatrix part(const SparseMatrix& matrix, const std::vector<Index>& row_place, Index rows,
                  const std::vector<Index>& column_place, Index columns)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (Index column = 0; column < matrix.outerSize(); ++column) {
        const Index to_column = column_place[static_cast<std::size_t>(column)];
        if (to_column < 0) continue;
        for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
            const Index to_row = row_place[static_cast<std::size_t>(entry.row())];
            if (to_row >= 0) entries.emplace_back(to_row, to_column, entry.value());
        }
    }
    SparseMatrix result(rows, columns);
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

} // namespace

CondensedBody::Partition CondensedBody::partition(const SparseMatrix& stiffness, std::span<const Index> kept)
{
    Partition parts;
    parts.kept.assign(kept.begin(), kept.end());
    std::vector<Index> kept_place(static_cast<std::size_t>(stiffness.rows()), -1), inner_place(kept_place);
    for (std::size_t k = 0; k < kept.size(); ++k) {
        assert(kept_place[static_cast<std::size_t>(kept[k])] < 0 && "an unknown is kept twice");
        kept_place[static_cast<std::size_t>(kept[k])] = static_cast<Index>(k);
    }
    for (Index row = 0; row < stiffness.rows(); ++row)
        if (kept_place[static_cast<std::size_t>(row)] < 0) {
            inner_place[static_cast<std::size_t>(row)] = static_cast<Index>(parts.inner.size());
            parts.inner.push_back(row);
        }
    const auto n_kept = static_cast<Index>(parts.kept.size()), n_inner = static_cast<Index>(parts.inner.size());
    parts.k_cc = part(stiffness, kept_place, n_kept, kept_place, n_kept);
    parts.k_ci = part(stiffness, kept_place, n_kept, inner_place, n_inner);
    parts.k_ii = part(stiffness, inner_place, n_inner, inner_place, n_inner);
    return parts;
}

CondensedBody::CondensedBody(const SparseMatrix& stiffness, std::span<const Index> kept)
    : CondensedBody(partition(stiffness, kept))
{
}

CondensedBody::CondensedBody(Partition partition) : parts_(std::move(partition))
{
    stiffness_ = Eigen::MatrixXd(parts_.k_cc);
    if (!factor_.factorise(parts_.k_ii).ok()) return;
    const SparseMatrix k_ic = parts_.k_ci.transpose();
    for (Index first = 0; first < k_ic.cols(); first += columns_at_once) {
        const Index count = std::min(columns_at_once, k_ic.cols() - first);
        const Eigen::MatrixXd inner = factor_.solve(Eigen::MatrixXd(k_ic.middleCols(first, count)));
        stiffness_.middleCols(first, count) -= parts_.k_ci * inner;
    }
    stiffness_ = (0.5 * (stiffness_ + stiffness_.transpose())).eval();
}

Eigen::VectorXd CondensedBody::condense_load(const Eigen::VectorXd& load) const
{
    const Eigen::VectorXd kept = load(parts_.kept), inner = load(parts_.inner);
    return kept - parts_.k_ci * factor_.solve(inner);
}

Eigen::VectorXd CondensedBody::recover(const Eigen::VectorXd& kept_displacement, const Eigen::VectorXd& load) const
{
    Eigen::VectorXd all(load.size());
    all(parts_.kept) = kept_displacement;
    const Eigen::VectorXd inner = load(parts_.inner);
    all(parts_.inner) = factor_.solve(Eigen::VectorXd(inner - parts_.k_ci.transpose() * kept_displacement));
    return all;
}

void add_dense_block(SparseMatrix& matrix, const Eigen::MatrixXd& block, std::span<const Index> at, double factor)
{
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(at.size() * at.size());
    for (std::size_t j = 0; j < at.size(); ++j)
        for (std::size_t i = 0; i < at.size(); ++i)
            entries.emplace_back(at[i], at[j], factor * block(static_cast<Index>(i), static_cast<Index>(j)));
    SparseMatrix addition(matrix.rows(), matrix.cols());
    addition.setFromTriplets(entries.begin(), entries.end());
    matrix += addition;
}

} // namespace damslip::fe2d
