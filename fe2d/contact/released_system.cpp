#include "fe2d/contact/released_system.hpp"

#include "core/defect.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr int updates_between_rebuilds = 200; ///< round-off of the updates is also checked at every solution
constexpr double smallest_pivot = 1e-13;      ///< of a new row against its own diagonal entry
constexpr double row_aim = 1e-13;       ///< of the released rows, relative to the largest stuck force: refine above
constexpr double row_tolerance = 1e-10; ///< the same: refuse above

/// force -= V x of some columns of V: four at a time, each row by its columns in their order.
void take_off(const Eigen::MatrixXd& stiffness, const std::vector<Index>& columns, const VectorXd& x, VectorXd& force)
{
    const auto column = [&](Index k) { return stiffness.col(columns[static_cast<std::size_t>(k)]); };
    Index k = 0;
    for (; k + 4 <= x.size(); k += 4)
        force =
            force - x[k] * column(k) - x[k + 1] * column(k + 1) - x[k + 2] * column(k + 2) - x[k + 3] * column(k + 3);
    for (; k < x.size(); ++k) force -= x[k] * column(k);
}

} // namespace

ReleasedSystem::ReleasedSystem(const Eigen::MatrixXd& stiffness)
    : stiffness_(stiffness), pairs_(stiffness.rows() / 2), rows_(static_cast<std::size_t>(stiffness.rows())),
      wanted_(rows_), place_(rows_.size(), -1), inverse_(stiffness.rows(), stiffness.rows())
{
    assert(stiffness.rows() == stiffness.cols() && stiffness.rows() % 2 == 0);
    unknowns_.reserve(rows_.size());
}

void ReleasedSystem::wanted_rows(const ContactStates& states, const ContactLaw& law)
{
    for (Index i = 0; i < pairs_; ++i) {
        const auto normal = static_cast<std::size_t>(i), shear = static_cast<std::size_t>(pairs_ + i);
        wanted_[normal] = wanted_[shear] = {};
        switch (states[normal]) {
        case ContactState::stick:
            break;
        case ContactState::slip_downstream:
            wanted_[shear] = {true, law.friction[i]};
            break;
        case ContactState::slip_upstream:
            wanted_[shear] = {true, -law.friction[i]};
            break;
        case ContactState::open:
            wanted_[normal] = wanted_[shear] = {true, 0.0};
            break;
        case ContactState::pulled:
            wanted_[shear] = {true, defect(Defect::friction_on_pulled_pairs) ? law.friction[i] : 0.0};
            break;
        }
    }
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

VectorXd ReleasedSystem::row_of(Index unknown, const Row& row) const
{
    // V is symmetric: its columns are read in place of its rows.
    if (row.coupling == 0.0) return stiffness_.col(unknown);
    return stiffness_.col(unknown) + row.coupling * stiffness_.col(unknown - pairs_);
}

bool ReleasedSystem::set(const ContactStates& states, const ContactLaw& law)
{
    wanted_rows(states, law);
    std::size_t differences = 0, released = 0;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        differences += rows_[k] != wanted_[k];
        released += wanted_[k].released;
    }
    if (differences == 0) return regular_;
    if (!regular_ || differences > 2 + released / 6 || updates_since_rebuild_ > updates_between_rebuilds)
        return rebuild();
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        if (rows_[k] == wanted_[k]) continue;
        const auto unknown = static_cast<Index>(k);
        const bool done = !rows_[k].released    ? add(unknown, wanted_[k])
                          : wanted_[k].released ? change(unknown, wanted_[k])
                                                : remove(unknown);
        if (!done) return rebuild(); // on the way a singular set may be passed though the last one is regular
        ++updates_;
        ++updates_since_rebuild_;
    }
    return true;
}

bool ReleasedSystem::add(Index unknown, const Row& row)
{
    const auto size = static_cast<Index>(unknowns_.size());
    const VectorXd line = row_of(unknown, row);
    column_.resize(size);
    line_.resize(size);
    for (Index k = 0; k < size; ++k) {
        const Index other = unknowns_[static_cast<std::size_t>(k)];
        const Row& other_row = rows_[static_cast<std::size_t>(other)];
        column_[k] = stiffness_(other, unknown);
        if (other_row.coupling != 0.0) column_[k] += other_row.coupling * stiffness_(other - pairs_, unknown);
        line_[k] = line[other];
    }
    const auto inverse = inverse_.topLeftCorner(size, size);
    const VectorXd right = inverse * column_;
    const Eigen::RowVectorXd left = line_.transpose() * inverse;
    const double pivot = line[unknown] - line_.dot(right);
    if (!(std::abs(pivot) > smallest_pivot * stiffness_(unknown, unknown))) return false;
    inverse_.topLeftCorner(size, size).noalias() += (right / pivot) * left;
    inverse_.col(size).head(size) = -right / pivot;
    inverse_.row(size).head(size) = -left / pivot;
    inverse_(size, size) = 1.0 / pivot;
    rows_[static_cast<std::size_t>(unknown)] = row;
    place_[static_cast<std::size_t>(unknown)] = size;
    unknowns_.push_back(unknown);
    return true;
}

bool ReleasedSystem::remove(Index unknown)
{
    const Index last = static_cast<Index>(unknowns_.size()) - 1, place = place_[static_cast<std::size_t>(unknown)];
    if (place != last) {
        inverse_.row(place).head(last + 1).swap(inverse_.row(last).head(last + 1));
        inverse_.col(place).head(last + 1).swap(inverse_.col(last).head(last + 1));
        const Index moved = unknowns_[static_cast<std::size_t>(last)];
        unknowns_[static_cast<std::size_t>(place)] = moved;
        place_[static_cast<std::size_t>(moved)] = place;
    }
    unknowns_.pop_back();
    place_[static_cast<std::size_t>(unknown)] = -1;
    rows_[static_cast<std::size_t>(unknown)] = {};
    const double pivot = inverse_(last, last);
    if (!(std::abs(pivot) * stiffness_(unknown, unknown) > smallest_pivot)) return false;
    column_ = inverse_.col(last).head(last) / pivot;
    line_ = inverse_.row(last).head(last);
    inverse_.topLeftCorner(last, last).noalias() -= column_ * line_.transpose();
    return true;
}

bool ReleasedSystem::change(Index unknown, const Row& row)
{
    // Only the friction coupling of a slip row can change: the row moves by a multiple of the normal's row of V.
    const auto size = static_cast<Index>(unknowns_.size());
    const Index place = place_[static_cast<std::size_t>(unknown)];
    const double step = row.coupling - rows_[static_cast<std::size_t>(unknown)].coupling;
    line_.resize(size);
    for (Index k = 0; k < size; ++k)
        line_[k] = step * stiffness_(unknown - pairs_, unknowns_[static_cast<std::size_t>(k)]);
    const auto inverse = inverse_.topLeftCorner(size, size);
    const Eigen::RowVectorXd left = line_.transpose() * inverse;
    const double pivot = 1.0 + left[place];
    if (!(std::abs(pivot) > smallest_pivot)) return false;
    column_ = inverse.col(place) / pivot;
    inverse_.topLeftCorner(size, size).noalias() -= column_ * left;
    rows_[static_cast<std::size_t>(unknown)] = row;
    return true;
}

void ReleasedSystem::diagonal_changed(Index unknown, double by)
{
    // A released normal row stands alone, and a shut pair's normal column takes no part: only the entry itself changes.
    const Index place = place_[static_cast<std::size_t>(unknown)];
    if (place < 0 || !regular_) return;
    const auto size = static_cast<Index>(unknowns_.size());
    const auto inverse = inverse_.topLeftCorner(size, size);
    const double pivot = 1.0 + by * inverse(place, place);
    if (!(std::abs(pivot) > smallest_pivot)) {
        stiffness_changed();
        return;
    }
    column_ = inverse.col(place) * (by / pivot);
    const Eigen::RowVectorXd line = inverse.row(place);
    inverse_.topLeftCorner(size, size).noalias() -= column_ * line;
    ++updates_;
    ++updates_since_rebuild_;
}

void ReleasedSystem::stiffness_changed()
{
    clear(); // nothing released: the next set() starts from there
    rows_.assign(rows_.size(), {});
    regular_ = true;
}

void ReleasedSystem::clear()
{
    unknowns_.clear();
    std::fill(place_.begin(), place_.end(), -1);
}

bool ReleasedSystem::rebuild()
{
    clear();
    rows_ = wanted_;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
        if (!rows_[k].released) continue;
        place_[k] = static_cast<Index>(unknowns_.size());
        unknowns_.push_back(static_cast<Index>(k));
    }
    ++rebuilds_;
    updates_since_rebuild_ = 0;
    const auto size = static_cast<Index>(unknowns_.size());
    Eigen::MatrixXd matrix(size, size);
    for (Index j = 0; j < size; ++j) {
        const auto column = stiffness_.col(unknowns_[static_cast<std::size_t>(j)]);
        for (Index i = 0; i < size; ++i) {
            const Index unknown = unknowns_[static_cast<std::size_t>(i)];
            const double coupling = rows_[static_cast<std::size_t>(unknown)].coupling;
            matrix(i, j) = column[unknown] + (coupling == 0.0 ? 0.0 : coupling * column[unknown - pairs_]);
        }
    }
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(matrix);
    const double largest = size > 0 ? matrix.diagonal().cwiseAbs().maxCoeff() : 0.0;
    regular_ = size == 0 || lu.matrixLU().diagonal().cwiseAbs().minCoeff() > smallest_pivot * largest;
    if (regular_ && size > 0) inverse_.topLeftCorner(size, size) = lu.inverse();
    return regular_;
}

double ReleasedSystem::row_residual(const ContactLaw& law, const ContactSolution& solution, VectorXd& residual) const
{
    residual.resize(static_cast<Index>(unknowns_.size()));
    for (Index k = 0; k < residual.size(); ++k) {
        const Index unknown = unknowns_[static_cast<std::size_t>(k)];
        const double coupling = rows_[static_cast<std::size_t>(unknown)].coupling;
        residual[k] = solution.force[unknown] - right_hand_side(unknown, law, solution.states);
        if (coupling != 0.0) residual[k] += coupling * solution.force[unknown - pairs_];
    }
    return residual.size() > 0 ? residual.cwiseAbs().maxCoeff() : 0.0;
}

bool ReleasedSystem::solve(const ContactLaw& law, const VectorXd& stuck_force, ContactSolution& solution)
{
    const double scale = stuck_force.cwiseAbs().maxCoeff();
    for (int attempt = 0; attempt < 2; ++attempt) {
        solution.displacement.setZero(2 * pairs_);
        solution.force = stuck_force;
        double largest = row_residual(law, solution, residual_);
        // The first pass solves, the others refine what the updates have lost.
        for (int pass = 0; pass < 3 && largest > row_aim * scale; ++pass) {
            const auto size = static_cast<Index>(unknowns_.size());
            column_.noalias() = inverse_.topLeftCorner(size, size) * residual_;
            take_off(stiffness_, unknowns_, column_, solution.force);
            for (Index k = 0; k < size; ++k)
                solution.displacement[unknowns_[static_cast<std::size_t>(k)]] -= column_[k];
            largest = row_residual(law, solution, residual_);
        }
        if (largest <= row_tolerance * scale) return true;
        if (updates_since_rebuild_ == 0 || !rebuild()) return false;
    }
    return false;
}

} // namespace damslip::fe2d
