#include "fe2d/contact/released_system.hpp"

#include "core/version.hpp"
#include "fe2d/solver/dense_product.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr Index most_borders = 64;
constexpr Index large = 256;             ///< unknowns of a base from which it is factorised by blocks
constexpr double smallest_pivot = 1e-13; ///< of a factor against the unknown's own diagonal entry of V
constexpr double row_aim = 1e-13;        ///< of the released rows, relative to the largest stuck force: refine above
constexpr double row_tolerance = 1e-10;  ///< the same: refuse above

/// y -= c₀ x₀ + c₁ x₁ + c₂ x₂ + c₃ x₃, each row in this order.
[[gnu::always_inline]] inline void subtract_four(const std::array<const double*, 4>& c, const double* const x,
                                                 double* const y, const Index from, const Index to)
{
    const double *const c0 = c[0], *const c1 = c[1], *const c2 = c[2], *const c3 = c[3];
    const double x0 = x[0], x1 = x[1], x2 = x[2], x3 = x[3];
    DAMSLIP_INDEPENDENT // y is no column of c
        for (Index i = from; i < to; ++i) y[i] = y[i] - x0 * c0[i] - x1 * c1[i] - x2 * c2[i] - x3 * c3[i];
}

[[gnu::always_inline]] inline void subtract_one(const double* const c, const double x, double* const y,
                                                const Index from, const Index to)
{
    for (Index i = from; i < to; ++i) y[i] -= x * c[i];
}

/// A square matrix that is factorised in place, in the leading part of a larger one.
struct Block {
    double* first;
    Index stride;
    Index size;

    double* column(Index j) const { return first + j * stride; }
};

Block leading(Eigen::MatrixXd& matrix, Index size)
{
    return {matrix.data(), matrix.rows(), size};
}

/// x = L⁻¹ x with the first `columns` of the unit lower L, taken off all rows below.
DAMSLIP_TWO_LEVELS void solve_lower(const Block& a, const Index columns, double* const x)
{
    Index k = 0;
    for (; k + 4 <= columns; k += 4) {
        const std::array<const double*, 4> c{a.column(k), a.column(k + 1), a.column(k + 2), a.column(k + 3)};
        double* const y = x + k;
        y[1] -= y[0] * c[0][k + 1];
        y[2] = y[2] - y[0] * c[0][k + 2] - y[1] * c[1][k + 2];
        y[3] = y[3] - y[0] * c[0][k + 3] - y[1] * c[1][k + 3] - y[2] * c[2][k + 3];
        subtract_four(c, y, x, k + 4, a.size);
    }
    for (; k < columns; ++k) subtract_one(a.column(k), x[k], x, k + 1, a.size);
}

/// x = U⁻¹ x
DAMSLIP_TWO_LEVELS void solve_upper(const Block& a, double* const x)
{
    Index k = a.size;
    for (; k % 4 != 0; --k) {
        x[k - 1] /= a.column(k - 1)[k - 1];
        subtract_one(a.column(k - 1), x[k - 1], x, 0, k - 1);
    }
    for (; k > 0; k -= 4) {
        const Index low = k - 4;
        const std::array<const double*, 4> c{a.column(low), a.column(low + 1), a.column(low + 2), a.column(low + 3)};
        double* const y = x + low;
        y[3] /= c[3][low + 3];
        y[2] = (y[2] - y[3] * c[3][low + 2]) / c[2][low + 2];
        y[1] = (y[1] - y[3] * c[3][low + 1] - y[2] * c[2][low + 1]) / c[1][low + 1];
        y[0] = (y[0] - y[3] * c[3][low] - y[2] * c[2][low] - y[1] * c[1][low]) / c[0][low];
        subtract_four(c, y, x, 0, low);
    }
}

/// A = PLU in place, column by column: each is solved with the columns of L before it.
/// @param scale  of a column by its place: what its pivot is measured against
/// @returns the smallest pivot over its scale
template <class Scale>
double factorise(const Block& a, std::vector<Index>& pivots, const Scale& scale)
{
    double smallest = std::numeric_limits<double>::infinity();
    pivots.resize(static_cast<std::size_t>(a.size));
    for (Index j = 0; j < a.size; ++j) {
        double* const column = a.column(j);
        for (Index i = 0; i < j; ++i) std::swap(column[i], column[pivots[static_cast<std::size_t>(i)]]);
        solve_lower(a, j, column);
        Index pivot = j;
        for (Index i = j + 1; i < a.size; ++i)
            if (std::abs(column[i]) > std::abs(column[pivot])) pivot = i;
        const double size = std::abs(column[pivot]);
        if (!(size > 0.0) || !std::isfinite(size)) return 0.0;
        smallest = std::min(smallest, size / scale(j));
        pivots[static_cast<std::size_t>(j)] = pivot;
        if (pivot != j)
            for (Index i = 0; i <= j; ++i) std::swap(a.column(i)[j], a.column(i)[pivot]);
        for (Index i = j + 1; i < a.size; ++i) column[i] /= column[j];
    }
    return smallest;
}

/// The same by blocks of columns, for large matrices: other round-off, and a fraction of the time.
template <class Scale>
double factorise_large(Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>> a, std::vector<Index>& pivots,
                       const Scale& scale)
{
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(a);
    a = lu.matrixLU();
    const auto& to = lu.permutationP().indices(); // of a row
    const auto size = static_cast<std::size_t>(a.rows());
    std::vector<Index> wanted(size), at(size), place(size); // row wanted at a place; row at a place; place of a row
    for (std::size_t i = 0; i < size; ++i) {
        wanted[static_cast<std::size_t>(to[static_cast<Index>(i)])] = static_cast<Index>(i);
        at[i] = place[i] = static_cast<Index>(i);
    }
    pivots.resize(size);
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < size; ++i) {
        const Index other = place[static_cast<std::size_t>(wanted[i])];
        pivots[i] = other;
        std::swap(at[i], at[static_cast<std::size_t>(other)]);
        place[static_cast<std::size_t>(at[i])] = static_cast<Index>(i);
        place[static_cast<std::size_t>(at[static_cast<std::size_t>(other)])] = other;
        const auto j = static_cast<Index>(i);
        const double pivot = std::abs(a(j, j));
        if (!(pivot > 0.0) || !std::isfinite(pivot)) return 0.0;
        smallest = std::min(smallest, pivot / scale(j));
    }
    return smallest;
}

/// x = A⁻¹ x by the factors.
void solve_in_place(const Block& a, const std::vector<Index>& pivots, double* const x)
{
    for (Index i = 0; i < a.size; ++i) std::swap(x[i], x[pivots[static_cast<std::size_t>(i)]]);
    solve_lower(a, a.size, x);
    solve_upper(a, x);
}

/// force -= V x of some columns of V: four at a time, each row by its columns in their order.
/// @param x  by unknown
DAMSLIP_TWO_LEVELS void take_off(const Eigen::MatrixXd& stiffness, const std::vector<Index>& columns, const VectorXd& x,
                                 VectorXd& force)
{
    const auto column = [&](std::size_t k) { return stiffness.data() + columns[k] * stiffness.rows(); };
    const auto factor = [&](std::size_t k) { return x[columns[k]]; };
    std::size_t k = 0;
    for (; k + 4 <= columns.size(); k += 4) {
        const double factors[4] = {factor(k), factor(k + 1), factor(k + 2), factor(k + 3)};
        subtract_four({column(k), column(k + 1), column(k + 2), column(k + 3)}, factors, force.data(), 0, force.size());
    }
    for (; k < columns.size(); ++k) subtract_one(column(k), factor(k), force.data(), 0, force.size());
}

} // namespace

ReleasedSystem::ReleasedSystem(const Eigen::MatrixXd& stiffness)
    : stiffness_(stiffness), pairs_(stiffness.rows() / 2), rows_(static_cast<std::size_t>(stiffness.rows())),
      states_(static_cast<std::size_t>(pairs_), ContactState::stick), friction_(VectorXd::Zero(pairs_)),
      base_rows_(rows_), stale_(rows_.size(), 0), place_(rows_.size(), -1), factor_(stiffness.rows(), stiffness.rows()),
      columns_(stiffness.rows(), most_borders), lines_(stiffness.rows(), most_borders),
      corner_(most_borders, most_borders), corner_factor_(most_borders, most_borders), residual_(stiffness.rows()),
      step_(stiffness.rows()), base_part_(stiffness.rows()), border_part_(most_borders)
{
    assert(stiffness.rows() == stiffness.cols() && stiffness.rows() % 2 == 0);
    unknowns_.reserve(rows_.size());
    base_.reserve(rows_.size());
    pivots_.reserve(rows_.size());
    borders_.reserve(most_borders);
    corner_pivots_.reserve(most_borders);
}

std::pair<ReleasedSystem::Row, ReleasedSystem::Row> ReleasedSystem::rows_of(ContactState state, double friction)
{
    switch (state) {
    case ContactState::stick:
        break;
    case ContactState::slip_downstream:
        return {{}, {true, friction}};
    case ContactState::slip_upstream:
        return {{}, {true, -friction}};
    case ContactState::open:
        return {{true, 0.0}, {true, 0.0}};
    case ContactState::pulled:
        return {{}, {true, 0.0}};
    }
    return {};
}

bool ReleasedSystem::take_rows(const ContactStates& states, const VectorXd& friction)
{
    bool changed = false;
    for (Index i = 0; i < pairs_; ++i) {
        const auto normal = static_cast<std::size_t>(i), shear = static_cast<std::size_t>(pairs_ + i);
        if (states[normal] == states_[normal] && friction[i] == friction_[i]) continue;
        states_[normal] = states[normal];
        friction_[i] = friction[i];
        const auto [of_normal, of_shear] = rows_of(states[normal], friction[i]);
        changed = changed || rows_[normal] != of_normal || rows_[shear] != of_shear;
        rows_[normal] = of_normal;
        rows_[shear] = of_shear;
    }
    return changed;
}

double ReleasedSystem::right_hand_side(Index unknown, const ContactLaw& law, const ContactStates& states) const
{
    if (unknown < pairs_) return 0.0;
    const Index pair = unknown - pairs_;
    const ContactState state = states[static_cast<std::size_t>(pair)];
    if (state == ContactState::slip_downstream) return -law.cohesion[pair];
    if (state == ContactState::slip_upstream) return law.cohesion[pair];
    return 0.0;
}

double ReleasedSystem::entry(Index unknown, const Row& row, Index column) const
{
    // V is symmetric but within a pair: its columns are read in place of its rows.
    const auto value = [&](Index k) {
        return std::abs(k - column) == pairs_ ? stiffness_(k, column) : stiffness_(column, k);
    };
    return row.coupling == 0.0 ? value(unknown) : value(unknown) + row.coupling * value(unknown - pairs_);
}

bool ReleasedSystem::set(const ContactStates& states, const ContactLaw& law)
{
    const bool changed = take_rows(states, law.friction);
    if (settled_ && !changed) return regular_;
    settled_ = true;
    unknowns_.clear();
    for (std::size_t k = 0; k < rows_.size(); ++k)
        if (rows_[k].released) unknowns_.push_back(static_cast<Index>(k));
    return (regular_ && follow_by_borders()) || rebuild();
}

/// How an unknown of rows_ differs from the base.
ReleasedSystem::Border ReleasedSystem::wanted_border(std::size_t unknown) const
{
    const Row &now = rows_[unknown], &base = base_rows_[unknown];
    const auto of = [&](BorderKind kind) { return Border{static_cast<Index>(unknown), kind, now}; };
    if (!base.released) return of(now.released ? BorderKind::added : BorderKind::none);
    if (!now.released) return of(BorderKind::removed);
    return of(now == base && !stale_[unknown] ? BorderKind::none : BorderKind::changed);
}

/// @returns false where a new base is cheaper, or S is singular, though the set itself may be regular
bool ReleasedSystem::follow_by_borders()
{
    const auto size = static_cast<Index>(base_.size());
    const Index most = std::min<Index>(most_borders, 6 + size / 6);
    Index wanted = 0;
    const auto differs = [&](std::size_t k) {
        const Row &now = rows_[k], &base = base_rows_[k];
        return base.released ? !(now == base) || stale_[k] : now.released;
    };
    for (std::size_t k = 0; k < rows_.size(); ++k)
        if (differs(k) && ++wanted > most) return false;
    for (std::size_t j = borders_.size(); j-- > 0;)
        if (borders_[j] != wanted_border(static_cast<std::size_t>(borders_[j].unknown))) drop(j);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        if (!differs(k)) continue;
        const Border border = wanted_border(k);
        if (std::find(borders_.begin(), borders_.end(), border) == borders_.end()) put(border);
    }
    return factorise_corner();
}

/// Columns and rows of removed and changed unknowns are scaled by V_kk, so that S has entries of one size.
void ReleasedSystem::put(const Border& border)
{
    const auto size = static_cast<Index>(base_.size()), last = static_cast<Index>(borders_.size());
    const Index unknown = border.unknown, place = place_[static_cast<std::size_t>(unknown)];
    auto column = columns_.col(last).head(size), line = lines_.col(last).head(size);
    if (border.kind == BorderKind::added) {
        for (Index i = 0; i < size; ++i) {
            const Index other = base_[static_cast<std::size_t>(i)];
            column[i] = entry(other, base_rows_[static_cast<std::size_t>(other)], unknown);
        }
    } else {
        column.setZero();
        column[place] = stiffness_(unknown, unknown);
    }
    if (border.kind == BorderKind::removed) {
        line.setZero();
        line[place] = stiffness_(unknown, unknown);
    } else {
        for (Index i = 0; i < size; ++i) line[i] = entry(unknown, border.row, base_[static_cast<std::size_t>(i)]);
    }
    solve_in_place(leading(factor_, size), pivots_, column.data());
    borders_.push_back(border);
    const auto corner = [&](Index row, Index of) { // E - R Y
        const Border &a = borders_[static_cast<std::size_t>(row)], &b = borders_[static_cast<std::size_t>(of)];
        const bool of_v = a.kind != BorderKind::removed && b.kind == BorderKind::added;
        return (of_v ? entry(a.unknown, a.row, b.unknown) : 0.0) -
               lines_.col(row).head(size).dot(columns_.col(of).head(size));
    };
    for (Index j = 0; j < last; ++j) {
        corner_(last, j) = corner(last, j);
        corner_(j, last) = corner(j, last);
    }
    corner_(last, last) = corner(last, last);
    ++updates_;
}

void ReleasedSystem::drop(std::size_t border)
{
    const auto last = static_cast<Index>(borders_.size()) - 1, place = static_cast<Index>(border);
    const auto size = static_cast<Index>(base_.size());
    if (place != last) {
        columns_.col(place).head(size) = columns_.col(last).head(size);
        lines_.col(place).head(size) = lines_.col(last).head(size);
        corner_.row(place).head(last + 1) = corner_.row(last).head(last + 1);
        corner_.col(place).head(last + 1) = corner_.col(last).head(last + 1);
        borders_[border] = borders_.back();
    }
    borders_.pop_back();
}

bool ReleasedSystem::factorise_corner()
{
    const auto count = static_cast<Index>(borders_.size());
    const auto scale = [&](Index j) {
        const Index unknown = borders_[static_cast<std::size_t>(j)].unknown;
        return stiffness_(unknown, unknown);
    };
    corner_factor_.topLeftCorner(count, count) = corner_.topLeftCorner(count, count);
    return count == 0 || factorise(leading(corner_factor_, count), corner_pivots_, scale) > smallest_pivot;
}

void ReleasedSystem::row_changed(Index unknown)
{
    const auto k = static_cast<std::size_t>(unknown);
    if (place_[k] >= 0) stale_[k] = 1;
    for (std::size_t j = borders_.size(); j-- > 0;)
        if (borders_[j].unknown == unknown) drop(j);
    settled_ = false;
    if (unknown < pairs_ && rows_[k].released != rows_[k + static_cast<std::size_t>(pairs_)].released)
        row_changed(unknown + pairs_); // a slipping pair: the row of its slip holds that of its opening
}

void ReleasedSystem::stiffness_changed()
{
    rows_.assign(rows_.size(), {});
    std::fill(states_.begin(), states_.end(), ContactState::stick);
    rebuild_base(); // nothing released: the next set() starts from there
    regular_ = true;
    settled_ = false;
}

/// Without its factor.
void ReleasedSystem::rebuild_base()
{
    borders_.clear();
    base_.clear();
    base_rows_ = rows_;
    std::fill(stale_.begin(), stale_.end(), char{0});
    std::fill(place_.begin(), place_.end(), -1);
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        if (!rows_[k].released) continue;
        place_[k] = static_cast<Index>(base_.size());
        base_.push_back(static_cast<Index>(k));
    }
}

bool ReleasedSystem::rebuild()
{
    rebuild_base();
    ++rebuilds_;
    const auto size = static_cast<Index>(base_.size());
    auto matrix = factor_.topLeftCorner(size, size);
    for (Index j = 0; j < size; ++j) {
        const auto column = stiffness_.col(base_[static_cast<std::size_t>(j)]);
        for (Index i = 0; i < size; ++i) {
            const Index unknown = base_[static_cast<std::size_t>(i)];
            const double coupling = rows_[static_cast<std::size_t>(unknown)].coupling;
            matrix(i, j) = column[unknown] + (coupling == 0.0 ? 0.0 : coupling * column[unknown - pairs_]);
        }
    }
    const auto scale = [&](Index j) {
        const Index unknown = base_[static_cast<std::size_t>(j)];
        return stiffness_(unknown, unknown);
    };
    regular_ = size == 0 || (size < large ? factorise(leading(factor_, size), pivots_, scale)
                                          : factorise_large(matrix, pivots_, scale)) > smallest_pivot;
    return regular_;
}

/// Of the released rows, by unknown; zero for all others.
void ReleasedSystem::row_residual(const ContactLaw& law, const ContactSolution& solution)
{
    residual_.setZero();
    largest_ = 0.0;
    for (const Index unknown : unknowns_) {
        const double coupling = rows_[static_cast<std::size_t>(unknown)].coupling;
        double rest = solution.force[unknown] - right_hand_side(unknown, law, solution.states);
        if (coupling != 0.0) rest += coupling * solution.force[unknown - pairs_];
        residual_[unknown] = rest;
        largest_ = std::max(largest_, std::abs(rest));
    }
}

/// Displacements that take residual_ off, into step_.
void ReleasedSystem::solve_for_step()
{
    const auto size = static_cast<Index>(base_.size()), count = static_cast<Index>(borders_.size());
    auto x = base_part_.head(size);
    for (Index i = 0; i < size; ++i) x[i] = residual_[base_[static_cast<std::size_t>(i)]];
    solve_in_place(leading(factor_, size), pivots_, x.data());
    if (count > 0) {
        auto s = border_part_.head(count);
        for (Index j = 0; j < count; ++j) s[j] = residual_[borders_[static_cast<std::size_t>(j)].unknown];
        s.noalias() -= lines_.topLeftCorner(size, count).transpose() * x;
        solve_in_place(leading(corner_factor_, count), corner_pivots_, s.data());
        x.noalias() -= columns_.topLeftCorner(size, count) * s;
    }
    for (Index i = 0; i < size; ++i) step_[base_[static_cast<std::size_t>(i)]] = x[i];
    for (Index j = 0; j < count; ++j) {
        const Border& border = borders_[static_cast<std::size_t>(j)];
        if (border.kind == BorderKind::added) step_[border.unknown] = border_part_[j];
    }
}

bool ReleasedSystem::solve(const ContactLaw& law, const VectorXd& stuck_force, ContactSolution& solution)
{
    const double scale = stuck_force.cwiseAbs().maxCoeff();
    for (int attempt = 0; attempt < 2; ++attempt) {
        solution.displacement.setZero(2 * pairs_);
        solution.force = stuck_force;
        row_residual(law, solution);
        // The first pass solves, the others refine what the borders have lost.
        for (int pass = 0; pass < 3 && largest_ > row_aim * scale; ++pass) {
            solve_for_step();
            take_off(stiffness_, unknowns_, step_, solution.force);
            for (const Index unknown : unknowns_) solution.displacement[unknown] -= step_[unknown];
            row_residual(law, solution);
        }
        if (largest_ <= row_tolerance * scale) return true;
        if (borders_.empty() || !rebuild()) return false;
    }
    return false;
}

} // namespace damslip::fe2d
