#include "fe2d/time/condensation.hpp"

#include "fe2d/solver/dense_product.hpp"

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

void LinearSystem::add_damping_product(const Eigen::VectorXd& velocity, Eigen::VectorXd& force) const
{
    force.noalias() += damping * velocity;
    damping_low_rank.add_product(velocity, 1.0, force);
}

std::vector<char> massless_unknowns(const SparseMatrix& mass)
{
    std::vector<char> massless(static_cast<std::size_t>(mass.rows()), 1);
    for (Eigen::Index column = 0; column < mass.outerSize(); ++column)
        for (SparseMatrix::InnerIterator entry(mass, column); entry; ++entry)
            if (entry.value() != 0.0) massless[static_cast<std::size_t>(entry.row())] = 0;
    return massless;
}

namespace {

SparseMatrix sparse_step_matrix(const LinearSystem& system, const StepConstants& c)
{
    const double weight = 1.0 + c.scheme.alpha;
    SparseMatrix matrix = c.a0 * system.mass + (weight * c.a1) * system.damping;
    matrix += weight * system.stiffness;
    matrix.makeCompressed();
    return matrix;
}

} // namespace

StepOperator::StepOperator(const LinearSystem& system, const StepConstants& constants, const SolverOptions& solver)
    : constants_(constants), factor_(solver)
{
    factor_.factorise(sparse_step_matrix(system, constants));
    const LowRank& low_rank = system.damping_low_rank;
    if (low_rank.empty() || !report().ok()) return;
    columns_ = low_rank.columns;
    response_ = factor_.solve(columns_);
    const Eigen::MatrixXd core = (1.0 + constants.scheme.alpha) * constants.a1 * low_rank.core;
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(core.rows(), core.cols());
    small_ = (identity + core * (columns_.transpose() * response_)).partialPivLu().solve(core);
}

void StepOperator::correct_low_rank(Eigen::MatrixXd& solutions) const
{
    if (columns_.cols() > 0) solutions -= response_ * (small_ * (columns_.transpose() * solutions).eval());
}

Eigen::VectorXd StepOperator::solve(const Eigen::VectorXd& right_hand_side) const
{
    Eigen::VectorXd solution = factor_.solve(right_hand_side);
    if (columns_.cols() > 0) solution -= response_ * (small_ * (columns_.transpose() * solution).eval());
    return solution;
}

Eigen::MatrixXd StepOperator::solve_columns(const SparseMatrix& right_hand_sides) const
{
    Eigen::MatrixXd solutions = factor_.solve(Eigen::MatrixXd(right_hand_sides));
    correct_low_rank(solutions);
    return solutions;
}

InterfaceFlexibility StepOperator::flexibility(const SparseMatrix& interface_map) const
{
    assert(report().ok());
    InterfaceFlexibility result;
    result.response = solve_columns(SparseMatrix(interface_map.transpose()));
    result.delassus = (1.0 + constants_.scheme.alpha) * (interface_map * result.response);
    result.delassus = (0.5 * (result.delassus + result.delassus.transpose())).eval();
    return result;
}

} // namespace damslip::fe2d
