#include "fe2d/contact/joint_law.hpp"

#include "fe2d/solver/dense_product.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double settled = 1e-12; ///< changes of mu below this are none [-]
/// The change of friction falls by the factor ρ(V_tt⁻¹D) with each solution: this many are enough up to a factor of 0.75, and
/// half a step has less than half of it.
constexpr int most_corrections = 100;

} // namespace

RateFrictionLaw::RateFrictionLaw(Index pairs, std::vector<RateFrictionPart> parts)
    : parts_(std::move(parts)), ratio_(VectorXd::Ones(pairs)), rate_(VectorXd::Zero(pairs))
{
}

void RateFrictionLaw::begin(const JointStart& start)
{
    dt_ = start.dt;
    rate_slope_ = start.rate_slope;
    rate_known_ = start.rate_known;
    stiffness_ = start.stiffness;
    strength_ = start.strength ? start.strength->friction : VectorXd::Ones(ratio_.size());
    trial_ = dt_ > 0.0 ? ratio_ : VectorXd::Ones(ratio_.size()); // a static stage knows no rate
    rate_then_ = slope_ = VectorXd::Zero(ratio_.size());
    solutions_ = 0;
}

void RateFrictionLaw::add(JointTerms& terms) const
{
    for (const RateFrictionPart& part : parts_)
        terms.strength.friction.segment(part.first, part.pairs).array() *=
            trial_.segment(part.first, part.pairs).array();
}

RateFrictionLaw::Value RateFrictionLaw::value(const RateFriction& law, double start, double rate) const
{
    const double decay = std::exp(-rate / *law.characteristic_rate);
    const double steady = law.kinetic_ratio + (1.0 - law.kinetic_ratio) * decay;
    const double steady_slope = -(1.0 - law.kinetic_ratio) * decay / *law.characteristic_rate;
    if (!law.relaxation_time && !law.relaxation_slip) return {steady, steady_slope};
    const double per_time = law.relaxation_time ? 1.0 / *law.relaxation_time : 0.0;
    const double per_slip = law.relaxation_slip ? 1.0 / *law.relaxation_slip : 0.0;
    const double left = std::exp(-(per_time + rate * per_slip) * dt_);
    return {steady + (start - steady) * left, steady_slope * (1.0 - left) - (start - steady) * left * per_slip * dt_};
}

JointFit RateFrictionLaw::revise(const ContactSolution& solution)
{
    if (!(dt_ > 0.0)) return JointFit::fits;
    double change = 0.0;
    for (const RateFrictionPart& part : parts_)
        for (Index i = part.first; i < part.first + part.pairs; ++i) {
            const ContactState state = solution.states[static_cast<std::size_t>(i)];
            slope_[i] = rate_then_[i] = 0.0;
            if (state == ContactState::open) continue;
            const double slip = solution.displacement[ratio_.size() + i];
            const double rate = is_slip(state) ? std::abs(rate_slope_ * slip + rate_known_[i]) : 0.0;
            const Value now = value(part.law, ratio_[i], rate);
            rate_then_[i] = rate;
            if (is_slip(state)) slope_[i] = value(part.law, ratio_[i], std::min(rate, rate_[i])).slope;
            change = std::max(change, strength_[i] * std::abs(now.ratio - trial_[i]));
            trial_[i] = now.ratio;
        }
    if (change <= settled) return unique(solution) ? JointFit::fits : JointFit::too_far;
    return ++solutions_ < most_corrections && std::isfinite(change) ? JointFit::changed : JointFit::too_far;
}

/// Is V_tt - D positive definite on the slipping pairs? With the slopes of the way through the step.
bool RateFrictionLaw::unique(const ContactSolution& solution) const
{
    if (!stiffness_) return true;
    const Index m = ratio_.size();
    std::vector<Index> slipping;
    bool weakens = false;
    for (Index i = 0; i < m; ++i)
        if (is_slip(solution.states[static_cast<std::size_t>(i)])) {
            slipping.push_back(m + i);
            weakens = weakens || slope_[i] < 0.0;
        }
    if (!weakens) return true;
    MatrixXd left = (*stiffness_)(slipping, slipping);
    for (std::size_t k = 0; k < slipping.size(); ++k) {
        const Index i = slipping[k] - m, place = static_cast<Index>(k);
        left(place, place) += std::max(0.0, solution.force[i]) * strength_[i] * slope_[i] * rate_slope_;
    }
    return left.llt().info() == Eigen::Success;
}

void RateFrictionLaw::end(const ContactSolution&)
{
    ratio_ = trial_;
    rate_ = rate_then_;
    stiffness_ = nullptr;
}

namespace {

constexpr int newton_steps = 40;
constexpr int renewals = 100;
constexpr int whole_renewals = 15; ///< later ones go half the way

double direction(ContactState state)
{
    return state == ContactState::slip_downstream ? 1.0 : -1.0;
}

ContactState slipping(bool downstream)
{
    return downstream ? ContactState::slip_downstream : ContactState::slip_upstream;
}

} // namespace

ExponentialNormal::ExponentialNormal(MatrixXd stiffness, VectorXd area, const ExponentialPressure& pressure,
                                     const ContactOptions& options)
    : stiffness_(std::move(stiffness)), area_(std::move(area)), pressure_(pressure), options_(options)
{
    assert(stiffness_.rows() == 2 * area_.size());
}

ExponentialNormal::Iterate ExponentialNormal::start(const ContactSolution& given) const
{
    const Index m = area_.size();
    Iterate it{given, VectorXd::Zero(m)};
    if (it.at.states.size() != static_cast<std::size_t>(m))
        it.at.states.assign(static_cast<std::size_t>(m), ContactState::stick);
    const bool remembers = given.force.size() == 2 * m && !given.force.isZero(0.0);
    for (Index i = 0; i < m; ++i) {
        if (remembers)
            it.point[i] = given.force[i] > 0.0 ? pressure_.clearance(given.force[i] / area_[i]) : pressure_.range();
        ContactState& state = it.at.states[static_cast<std::size_t>(i)];
        if (it.point[i] >= pressure_.range())
            state = ContactState::open;
        else if (state == ContactState::open || state == ContactState::pulled)
            state = ContactState::stick;
    }
    it.at.displacement.setZero(2 * m);
    return it;
}

ExponentialNormal::Tangent ExponentialNormal::tangent(const VectorXd& point) const
{
    Tangent t{VectorXd(point.size()), VectorXd(point.size())};
    for (Index i = 0; i < point.size(); ++i) {
        t.stiffness[i] = area_[i] * pressure_.stiffness(point[i]);
        t.constant[i] = area_[i] * pressure_.pressure(point[i]) + t.stiffness[i] * point[i];
    }
    return t;
}

/// Rows λ_n + D g = constant of all pairs, λ_t + κ λ_n = ∓c of those that slip, λ_t = 0 of the open ones.
bool ExponentialNormal::linear_solution(const Step& step, Iterate& it) const
{
    const Index m = area_.size();
    std::vector<Index> unknowns(static_cast<std::size_t>(m));
    for (Index i = 0; i < m; ++i) unknowns[static_cast<std::size_t>(i)] = i;
    for (Index i = 0; i < m; ++i)
        if (it.at.states[static_cast<std::size_t>(i)] != ContactState::stick) unknowns.push_back(m + i);
    const auto size = static_cast<Index>(unknowns.size());
    const Tangent law = tangent(it.point);
    MatrixXd matrix = stiffness_(unknowns, unknowns);
    VectorXd right = -step.stuck_force(unknowns);
    matrix.diagonal().head(m) += law.stiffness;
    right.head(m) += law.constant;
    for (Index row = m; row < size; ++row) {
        const Index pair = unknowns[static_cast<std::size_t>(row)] - m;
        const ContactState state = it.at.states[static_cast<std::size_t>(pair)];
        if (state == ContactState::open) continue;
        const double coupling = direction(state) * step.law.friction[pair];
        for (Index k = 0; k < size; ++k)
            matrix(row, k) += coupling * stiffness_(unknowns[static_cast<std::size_t>(k)], pair);
        right[row] -= coupling * step.stuck_force[pair] + direction(state) * step.law.cohesion[pair];
    }
    const Eigen::PartialPivLU<MatrixXd> lu(matrix);
    const VectorXd pivots = lu.matrixLU().diagonal().cwiseAbs();
    if (!(pivots.minCoeff() > 1e-14 * pivots.maxCoeff())) return false;
    const VectorXd x = lu.solve(right);
    it.at.displacement.setZero(2 * m);
    it.at.displacement(unknowns) = x;
    it.at.force = step.stuck_force;
    for (Index k = 0; k < size; ++k) it.at.force += x[k] * stiffness_.col(unknowns[static_cast<std::size_t>(k)]);
    return it.at.force.allFinite();
}

double ExponentialNormal::next_point(const Iterate& it, Index pair) const
{
    const double clearance = it.at.displacement[pair], before = it.point[pair];
    if (clearance >= before) return clearance;
    if (before < pressure_.range()) return pressure_.clearance(it.at.force[pair] / area_[pair]);
    return std::max(clearance, 0.0); // closes: nothing tells how far, p0 is a start
}

ContactState ExponentialNormal::next_state(const Step& step, const Iterate& it, Index pair, double point) const
{
    if (point >= pressure_.range()) return ContactState::open;
    const Index t = area_.size() + pair;
    const ContactState now = it.at.states[static_cast<std::size_t>(pair)];
    const double slip = it.at.displacement[t], shear = it.at.force[t];
    if (now == ContactState::open) { // where the trial force of a penalty lies, as for hard contact
        const double closing = pressure_.range() - it.at.displacement[pair];
        return std::abs(slip) > step.law.friction[pair] * closing ? slipping(slip > 0.0) : ContactState::stick;
    }
    if (is_slip(now)) return direction(now) * slip * stiffness_(t, t) < -step.tolerance ? ContactState::stick : now;
    const double strength = step.law.strength(pair, it.at.force[pair]);
    return std::abs(shear) > strength + step.tolerance ? slipping(shear < 0.0) : ContactState::stick;
}

double ExponentialNormal::residual(const Step& step, const ContactSolution& at) const
{
    const Index m = area_.size();
    double largest = 0.0;
    for (Index i = 0; i < m; ++i) {
        const Index t = m + i;
        const double normal_residual = at.force[i] - area_[i] * pressure_.pressure(at.displacement[i]);
        const double slip = at.displacement[t] * stiffness_(t, t);
        const bool closed = at.states[static_cast<std::size_t>(i)] != ContactState::open;
        const double strength = closed ? step.law.strength(i, at.force[i]) : 0.0;
        const double shear_residual = at.force[t] - std::clamp(at.force[t] - slip, -strength, strength);
        if (!std::isfinite(normal_residual) || !std::isfinite(shear_residual)) return HUGE_VAL;
        largest = std::max({largest, std::abs(normal_residual), std::abs(shear_residual)});
    }
    return largest;
}

bool ExponentialNormal::newton(const Step& step, Iterate& it, ContactReport& report) const
{
    const Index m = area_.size();
    for (int k = 0; k < newton_steps; ++k) {
        ++report.iterations;
        if (!linear_solution(step, it)) {
            report.mechanism = true;
            return false;
        }
        if (residual(step, it.at) <= step.tolerance) return true;
        for (Index i = 0; i < m; ++i) {
            const double point = next_point(it, i);
            it.at.states[static_cast<std::size_t>(i)] = next_state(step, it, i, point);
            it.point[i] = point;
        }
    }
    return false;
}

/// Coulomb's law exactly, with the normal forces along their tangents: the clearances eliminated,
/// g = -K (λ⁰_n + V_nt s - constant), K = (V_nn + D)⁻¹, leave a contact problem without openings in
/// V' = V - V_:n K V_n: and λ⁰' = λ⁰ - V_:n K (λ⁰_n - constant). Normal forces below zero carry no shear in it.
bool ExponentialNormal::friction_solution(const Step& step, Iterate& it, ContactReport& report) const
{
    const Index m = area_.size();
    const Tangent law = tangent(it.point);
    MatrixXd normal = stiffness_.topLeftCorner(m, m);
    normal.diagonal() += law.stiffness;
    const Eigen::LLT<MatrixXd> llt(normal);
    if (llt.info() != Eigen::Success) return false;
    const auto to_normal = stiffness_.topRows(m);
    MatrixXd condensed = stiffness_;
    condensed.noalias() -= to_normal.transpose() * llt.solve(to_normal);
    condensed = (0.5 * (condensed + condensed.transpose())).eval();
    const VectorXd held = llt.solve(VectorXd(step.stuck_force.head(m) - law.constant));
    const VectorXd stuck = step.stuck_force - to_normal.transpose() * held;
    ContactLaw friction = step.law;
    friction.separation = JointOpening::none;
    ContactSolution solution{it.at.states, {}, {}};
    for (Index i = 0; i < m; ++i) {
        if (it.point[i] < pressure_.range()) continue;
        friction.cohesion[i] = 0.0;
        solution.states[static_cast<std::size_t>(i)] = ContactState::pulled;
    }
    ContactSolver solver(std::move(condensed), options_);
    const ContactReport inner = solver.solve(stuck, friction, solution);
    report.iterations += inner.iterations;
    if (!inner.resolved()) return false;
    const VectorXd slip = solution.displacement.tail(m);
    it.at.displacement.tail(m) = slip;
    it.at.displacement.head(m) = -held - llt.solve(VectorXd(stiffness_.topRightCorner(m, m) * slip));
    it.at.force = step.stuck_force + stiffness_ * it.at.displacement;
    it.at.states = std::move(solution.states);
    return it.at.force.allFinite();
}

bool ExponentialNormal::renewed_tangents(const Step& step, Iterate& it, ContactReport& report) const
{
    const Index m = area_.size();
    for (int k = 0; k < renewals; ++k) {
        if (!friction_solution(step, it, report)) return false;
        for (Index i = 0; i < m; ++i) {
            const double point = next_point(it, i);
            it.point[i] = k < whole_renewals ? point : 0.5 * (it.point[i] + point);
            ContactState& state = it.at.states[static_cast<std::size_t>(i)];
            if (it.point[i] >= pressure_.range())
                state = ContactState::open;
            else if (state == ContactState::pulled)
                state = slipping(it.at.displacement[m + i] > 0.0);
        }
        if (residual(step, it.at) <= step.tolerance) return true;
    }
    return false;
}

ContactReport ExponentialNormal::solve(const VectorXd& stuck_force, const ContactLaw& law,
                                       ContactSolution& solution) const
{
    const double scale = stuck_force.cwiseAbs().maxCoeff();
    const Step step{stuck_force, law, options_.tolerance * scale};
    const Iterate first = start(solution);
    ContactReport report;
    Iterate it = first;
    if (!newton(step, it, report)) {
        it = first;
        const bool settled = renewed_tangents(step, it, report);
        Iterate polished = it;
        const bool done = newton(step, polished, report);
        if (done) it = std::move(polished);
        report.path = done || settled ? ContactPath::gauss_seidel : ContactPath::unresolved;
    }
    report.residual = scale > 0.0 ? residual(step, it.at) / scale : 0.0;
    // What round-off leaves of an open pair's force is no pull.
    it.at.force.head(area_.size()) = it.at.force.head(area_.size()).cwiseMax(0.0);
    solution = std::move(it.at);
    return report;
}

namespace {

constexpr double deepest = ExponentialPressure::deepest;

double slope(double z) // of z (exp z - 1)
{
    return std::expm1(z) + z * std::exp(z);
}

/// ∫ z (exp z - 1) dz from 0. The closed form loses all digits at small z, where a series is summed.
double integral(double z)
{
    if (z > 0.5) return (z - 1.0) * std::exp(z) + 1.0 - 0.5 * z * z;
    double sum = 0.0, term = z; // z^(k+1)/k!
    for (int k = 1; k < 20; ++k) {
        term *= z / k;
        sum += term * z / (k + 2);
    }
    return sum;
}

} // namespace

ExponentialPressure::ExponentialPressure(double at_zero_clearance, double at_zero_pressure)
    : unit_(at_zero_clearance / (std::numbers::e - 1.0)), range_(at_zero_pressure)
{
    assert(at_zero_clearance > 0.0 && at_zero_pressure > 0.0);
}

double ExponentialPressure::pressure(double clearance) const
{
    const double z = 1.0 - clearance / range_;
    if (z <= 0.0) return 0.0;
    if (z <= deepest) return unit_ * z * std::expm1(z);
    return unit_ * (deepest * std::expm1(deepest) + slope(deepest) * (z - deepest));
}

double ExponentialPressure::stiffness(double clearance) const
{
    const double z = 1.0 - clearance / range_;
    if (z <= 0.0) return 0.0;
    return unit_ / range_ * slope(z < deepest ? z : deepest);
}

double ExponentialPressure::energy(double clearance) const
{
    const double z = 1.0 - clearance / range_;
    if (z <= 0.0) return 0.0;
    if (z <= deepest) return unit_ * range_ * integral(z);
    const double beyond = z - deepest;
    return unit_ * range_ *
           (integral(deepest) + beyond * (deepest * std::expm1(deepest) + 0.5 * beyond * slope(deepest)));
}

double ExponentialPressure::clearance(double pressure) const
{
    assert(pressure > 0.0);
    const double q = pressure / unit_;
    const double last = deepest * std::expm1(deepest);
    if (q >= last) return range_ * (1.0 - deepest - (q - last) / slope(deepest));
    // z² <= z (exp z - 1) everywhere and exp z - 1 <= z (exp z - 1) from z = 1 on: Newton falls from above, the function
    // being convex.
    double z = q < std::numbers::e - 1.0 ? std::sqrt(q) : std::log1p(q);
    for (int k = 0; k < 60; ++k) {
        const double step = (z * std::expm1(z) - q) / slope(z);
        z -= step;
        if (std::abs(step) <= 1e-15 * z) break;
    }
    return range_ * (1.0 - z);
}

ElasticStick::ElasticStick(MatrixXd& stiffness, const VectorXd& compliance) : compliance_(compliance)
{
    const Index m = compliance.size();
    MatrixXd sum = MatrixXd::Identity(2 * m, 2 * m);
    sum.rightCols(m) += stiffness.rightCols(m) * compliance.asDiagonal();
    soften_ = sum.partialPivLu().inverse();
    stiffness = soften_ * stiffness;
    stiffness = (0.5 * (stiffness + stiffness.transpose())).eval();
    tangential_ = stiffness.rightCols(m);
}

void ElasticStick::soften(VectorXd& stuck_force, const VectorXd& elastic) const
{
    if (!active()) return;
    stuck_force = (soften_ * stuck_force).eval();
    stuck_force -= tangential_ * elastic;
}

VectorXd ElasticStick::give(const VectorXd& force) const
{
    return -compliance_.cwiseProduct(force.tail(compliance_.size()));
}

} // namespace damslip::fe2d
