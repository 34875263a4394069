#include "fe2d/contact/contact_problem.hpp"

#include "fe2d/solver/dense_product.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;

ContactLaw uniform_law(Index pairs, double friction, double cohesion_force)
{
    return {Eigen::VectorXd::Constant(pairs, friction), Eigen::VectorXd::Constant(pairs, cohesion_force),
            JointOpening::allowed};
}

double violation(const ContactProblem& problem, const ContactSolution& solution, Index pair)
{
    const Index m = problem.law.pairs();
    const double normal = solution.force[pair], shear = solution.force[m + pair];
    const double opening = solution.displacement[pair], slip = solution.displacement[m + pair];
    const double strength = problem.law.strength(pair, normal);
    const double slip_stiffness = problem.stiffness(m + pair, m + pair);
    const bool may_open = problem.law.separation == JointOpening::allowed;
    switch (solution.states[static_cast<std::size_t>(pair)]) {
    case ContactState::stick:
        if (normal < 0.0) return -normal;
        return std::max(0.0, std::abs(shear) - strength);
    case ContactState::slip_downstream:
        if (normal < 0.0) return -normal;
        return std::max(0.0, -slip * slip_stiffness);
    case ContactState::slip_upstream:
        if (normal < 0.0) return -normal;
        return std::max(0.0, slip * slip_stiffness);
    case ContactState::open:
        return may_open ? std::max(0.0, -opening * problem.stiffness(pair, pair)) : HUGE_VAL;
    case ContactState::pulled:
        return may_open ? HUGE_VAL : std::max(0.0, normal);
    }
    return HUGE_VAL;
}

double complementarity_residual(const ContactProblem& problem, const ContactSolution& solution)
{
    const Index m = problem.law.pairs();
    double largest = 0.0;
    for (Index i = 0; i < m; ++i) {
        const double normal = solution.force[i], shear = solution.force[m + i];
        const double opening = solution.displacement[i] * problem.stiffness(i, i);
        const double slip = solution.displacement[m + i] * problem.stiffness(m + i, m + i);
        const bool may_open = problem.law.separation == JointOpening::allowed;
        const bool parted = may_open ? opening > 0.0 : normal < 0.0; // then there is no shear, cohesion or not
        const double strength = parted ? 0.0 : problem.law.strength(i, normal);
        const double normal_residual = may_open ? std::min(normal, opening) : opening;
        // λ_t is its own projection on [-strength, strength] after a step against the slip.
        const double shear_residual = shear - std::clamp(shear - slip, -strength, strength);
        largest = std::max({largest, std::abs(normal_residual), std::abs(shear_residual)});
        if (!std::isfinite(normal_residual) || !std::isfinite(shear_residual)) return HUGE_VAL;
    }
    return largest;
}

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double smallest_pivot_share = 1e-11;

/// I w - M z - 1 z0 = q with the unknowns w: 0 ... n-1, z: n ... 2n-1, z0: 2n.
class Tableau {
public:
    Tableau(const MatrixXd& matrix, const VectorXd& q)
        : n_(matrix.rows()), body_(n_, 2 * n_ + 1), value_(q), basis_(static_cast<std::size_t>(n_))
    {
        body_ << MatrixXd::Identity(n_, n_), -matrix, -VectorXd::Ones(n_);
        for (Index i = 0; i < n_; ++i) basis_[static_cast<std::size_t>(i)] = i;
    }

    Index artificial() const { return 2 * n_; }
    Index complement(Index unknown) const { return unknown < n_ ? unknown + n_ : unknown - n_; }
    Index basic(Index row) const { return basis_[static_cast<std::size_t>(row)]; }
    double value(Index row) const { return value_[row]; }

    /// Row that limits the growth of `entering`; the artificial one is preferred among equals. -1: a ray.
    Index leaving_row(Index entering) const
    {
        Index row = -1;
        double smallest = HUGE_VAL;
        for (Index i = 0; i < n_; ++i) {
            if (body_(i, entering) <= smallest_pivot_share) continue;
            const double ratio = std::max(0.0, value_[i]) / body_(i, entering);
            const double slack = 1e-13 * (1.0 + std::abs(smallest));
            const bool better = row < 0 || ratio < smallest - slack;
            const bool equal = !better && ratio <= smallest + slack;
            if (better || (equal && (basic(i) == artificial() ||
                                     (basic(row) != artificial() && body_(i, entering) > body_(row, entering))))) {
                row = i;
                smallest = std::min(ratio, smallest);
            }
        }
        return row;
    }

    void pivot(Index row, Index entering)
    {
        const double scale = 1.0 / body_(row, entering);
        body_.row(row) *= scale;
        value_[row] *= scale;
        const Eigen::RowVectorXd pivot_row = body_.row(row);
        VectorXd column = body_.col(entering);
        column[row] = 0.0;
        body_.noalias() -= column * pivot_row;
        value_ -= column * value_[row];
        basis_[static_cast<std::size_t>(row)] = entering;
    }

private:
    Index n_;
    MatrixXd body_;
    VectorXd value_;
    std::vector<Index> basis_;
};

} // namespace

LcpResult lemke(const MatrixXd& matrix, const VectorXd& q, int pivot_limit)
{
    const Index n = q.size();
    LcpResult result{.solved = false, .pivots = 0, .z = VectorXd::Zero(n)};
    Index row = 0;
    if (n == 0 || q.minCoeff(&row) >= 0.0) {
        result.solved = true;
        return result;
    }
    Tableau tableau(matrix, q);
    Index leaving = tableau.basic(row);
    tableau.pivot(row, tableau.artificial());
    for (result.pivots = 1; result.pivots < pivot_limit && !result.solved; ++result.pivots) {
        const Index entering = tableau.complement(leaving);
        row = tableau.leaving_row(entering);
        if (row < 0) return result;
        leaving = tableau.basic(row);
        tableau.pivot(row, entering);
        result.solved = leaving == tableau.artificial();
    }
    for (Index i = 0; i < n; ++i)
        if (tableau.basic(i) >= n && tableau.basic(i) < 2 * n)
            result.z[tableau.basic(i) - n] = std::max(0.0, tableau.value(i));
    return result;
}

bool solve_by_lemke(const ContactProblem& problem, ContactSolution& solution, int& pivots)
{
    assert(problem.law.separation == JointOpening::allowed);
    const Index m = problem.law.pairs();
    const double force = problem.stuck_force.cwiseAbs().maxCoeff();
    const Eigen::LDLT<MatrixXd> factor(problem.stiffness);
    const VectorXd pivot = factor.vectorD();
    if (!(force > 0.0) || !(pivot.minCoeff() > smallest_pivot_share * pivot.maxCoeff())) return false;
    MatrixXd w = factor.solve(MatrixXd::Identity(2 * m, 2 * m));
    const double scale = w.diagonal().mean(); // [m²/N]; forces in units of `force`, displacements of scale * force
    w = (0.5 / scale * (w + w.transpose())).eval();
    const VectorXd free = -w * problem.stuck_force / force;

    const MatrixXd one = MatrixXd::Identity(m, m), zero = MatrixXd::Zero(m, m);
    const MatrixXd nn = w.topLeftCorner(m, m), nt = w.topRightCorner(m, m), tn = w.bottomLeftCorner(m, m),
                   tt = w.bottomRightCorner(m, m), mu = problem.law.friction.asDiagonal();
    MatrixXd matrix(4 * m, 4 * m);
    matrix << nn, nt, -nt, zero, tn, tt, -tt, one, -tn, -tt, tt, one, mu, -one, -one, zero;
    VectorXd q(4 * m);
    // Without cohesion the last m entries are zero and the ratio test is full of ties: a share of 1e-10 of the largest
    // force, different for each pair, breaks them. The caller solves again with the states found.
    const VectorXd tie_breaker = VectorXd::LinSpaced(m, 1e-10, 2e-10);
    q << free.head(m), free.tail(m), -free.tail(m), problem.law.cohesion / force + tie_breaker;
    const LcpResult result = lemke(matrix, q, static_cast<int>(80 * m + 100));
    pivots = result.pivots;
    if (!result.solved) return false;

    VectorXd lambda(2 * m);
    lambda << result.z.head(m), result.z.segment(m, m) - result.z.segment(2 * m, m);
    solution.force = force * lambda;
    solution.displacement = scale * force * (w * lambda + free);
    solution.states.resize(static_cast<std::size_t>(m));
    const VectorXd sigma = result.z.tail(m);
    for (Index i = 0; i < m; ++i) {
        const double slip = solution.displacement[m + i];
        solution.states[static_cast<std::size_t>(i)] = !(lambda[i] > 0.0) ? ContactState::open
                                                       : sigma[i] == 0.0  ? ContactState::stick
                                                       : slip > 0.0       ? ContactState::slip_downstream
                                                                          : ContactState::slip_upstream;
    }
    return true;
}

namespace {

/// One pair with everything else held: forces q at x = 0, stiffness [[nn, nt], [nt, tt]].
struct Pair {
    double q_n, q_t, nn, nt, tt, friction, cohesion;
};

struct PairResult {
    ContactState state;
    double opening, slip;
};

bool slips(const Pair& p, double direction, PairResult& result)
{
    // λ_t + direction (c + mu λ_n) = 0
    const double stiffness = p.tt + direction * p.friction * p.nt;
    if (!(stiffness > 0.0)) return false;
    const double slip = -(p.q_t + direction * (p.cohesion + p.friction * p.q_n)) / stiffness;
    if (slip * direction < 0.0 || p.q_n + p.nt * slip < 0.0) return false;
    result = {direction > 0.0 ? ContactState::slip_downstream : ContactState::slip_upstream, 0.0, slip};
    return true;
}

PairResult solve_pair(const Pair& p, JointOpening separation)
{
    const bool in_tension = p.q_n < 0.0;
    const double strength = p.cohesion + p.friction * std::max(0.0, p.q_n);
    if (!in_tension && std::abs(p.q_t) <= strength) return {ContactState::stick, 0.0, 0.0};
    PairResult result{};
    if (slips(p, p.q_t < 0.0 ? 1.0 : -1.0, result) || slips(p, p.q_t < 0.0 ? -1.0 : 1.0, result)) return result;
    if (separation == JointOpening::none) return {ContactState::pulled, 0.0, -p.q_t / p.tt};
    const double determinant = p.nn * p.tt - p.nt * p.nt;
    return {ContactState::open, (p.nt * p.q_t - p.tt * p.q_n) / determinant,
            (p.nt * p.q_n - p.nn * p.q_t) / determinant};
}

} // namespace

int gauss_seidel(const ContactProblem& problem, ContactSolution& solution, int sweeps, double tolerance)
{
    const Eigen::MatrixXd& v = problem.stiffness;
    const Index m = problem.law.pairs();
    auto& x = solution.displacement;
    solution.force = problem.stuck_force + v * x;
    for (int sweep = 1; sweep <= sweeps; ++sweep) {
        double largest_change = 0.0;
        for (Index i = 0; i < m; ++i) {
            const Index t = m + i;
            const Pair pair{solution.force[i] - v(i, i) * x[i] - v(i, t) * x[t],
                            solution.force[t] - v(t, i) * x[i] - v(t, t) * x[t],
                            v(i, i),
                            v(i, t),
                            v(t, t),
                            problem.law.friction[i],
                            problem.law.cohesion[i]};
            const PairResult result = solve_pair(pair, problem.law.separation);
            const double opening_step = result.opening - x[i], slip_step = result.slip - x[t];
            ContactState& state = solution.states[static_cast<std::size_t>(i)];
            largest_change = std::max({largest_change, std::abs(opening_step * v(i, i)), std::abs(slip_step * v(t, t)),
                                       state == result.state ? 0.0 : HUGE_VAL});
            state = result.state;
            x[i] = result.opening;
            x[t] = result.slip;
            if (opening_step != 0.0) solution.force += opening_step * v.col(i);
            if (slip_step != 0.0) solution.force += slip_step * v.col(t);
        }
        if (largest_change <= tolerance) return sweep;
    }
    return sweeps;
}

} // namespace damslip::fe2d
