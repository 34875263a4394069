#include "fe2d/run/static_contact.hpp"

#include "fe2d/solver/dense_product.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

MatrixXd symmetric(const MatrixXd& matrix)
{
    return 0.5 * (matrix + matrix.transpose());
}

MatrixXd inverse(const MatrixXd& matrix)
{
    return symmetric(matrix.llt().solve(MatrixXd::Identity(matrix.rows(), matrix.cols())));
}

/// Leftᵀ A Right
MatrixXd between(const ContactPlanes::Matrix& left, const MatrixXd& matrix, const ContactPlanes::Matrix& right)
{
    const MatrixXd half = matrix * right;
    return left.transpose() * half;
}

} // namespace

StaticOperator::StaticOperator(const ContactStructure& structure, double slip)
    : structure_(structure), trace_(structure.trace(slip))
{
    const ContactPlanes::Matrix to_interface = structure.planes().gaps().transpose();
    dam_stiffness_ = symmetric(between(to_interface, structure.static_factor().schur(), to_interface));
    MatrixXd stiffness = dam_stiffness_;
    if (structure.has_rock()) {
        tied_flexibility_ = inverse(symmetric(structure.rock_stiffness() + between(trace_, dam_stiffness_, trace_)));
        const MatrixXd half = trace_ * structure.rock_flexibility();
        const MatrixXd flexibility = half * trace_.transpose(); // F
        MatrixXd factor = dam_stiffness_ * flexibility;
        factor.diagonal().array() += 1.0;
        stiffness = symmetric(factor.partialPivLu().solve(dam_stiffness_));
    }
    stiffness_ = std::make_shared<const MatrixXd>(std::move(stiffness));
}

StaticOperator::Reduced StaticOperator::reduced(const SplitLoad& load) const
{
    VectorXd dam = load.dam;
    structure_.static_factor().forward(dam);
    Reduced result;
    result.force = structure_.planes().gaps() * dam.tail(2 * structure_.interface());
    if (structure_.has_rock()) result.rock = structure_.rock_load(load, trace_);
    return result;
}

VectorXd StaticOperator::shut_force(const SplitLoad& load) const
{
    const Reduced f = reduced(load);
    if (!structure_.has_rock()) return -f.force;
    const VectorXd rock = tied_flexibility_ * (trace_.transpose() * f.force + f.rock);
    return dam_stiffness_ * (trace_ * rock) - f.force;
}

StaticState StaticOperator::displacements(const SplitLoad& load, const VectorXd& gap) const
{
    StaticState state;
    VectorXd x = gap;
    if (structure_.has_rock()) {
        const Reduced f = reduced(load);
        state.rock = tied_flexibility_ * (trace_.transpose() * (f.force - dam_stiffness_ * gap) + f.rock);
        x += trace_ * state.rock;
    }
    state.dam = load.dam;
    structure_.static_factor().forward(state.dam);
    state.dam.tail(x.size()) = structure_.planes().gaps().transpose() * x;
    structure_.static_factor().backward(state.dam);
    return state;
}

VectorXd ContactMemory::contact_force() const
{
    return laws.active() ? VectorXd(force - laws.force()) : force;
}

void ContactMemory::contact_force(VectorXd& carried) const
{
    carried = force;
    if (laws.active()) carried -= laws.force();
}

StaticContact::StaticContact(std::shared_ptr<const StaticOperator> linear, const Contact& joint,
                             const ContactOptions& options)
    : linear_(std::move(linear)), options_(options),
      solver_(linear_->stiffness(), linear_->structure().planes().area(), joint, options)
{
}

StaticContact::StaticContact(const ContactStructure& structure, const Contact& joint, const ContactOptions& options,
                             double slip)
    : StaticContact(std::make_shared<const StaticOperator>(structure, slip), joint, options)
{
}

ContactReport StaticContact::solve(const SplitLoad& load, const ContactLaw& law, ContactMemory& memory)
{
    const Index m = memory.slip.size();
    VectorXd stuck = linear_->shut_force(load);
    stuck += solver_.stiffness().rightCols(m) * (memory.slip + memory.elastic);
    ContactSolution solution{memory.states, {}, memory.force};
    VectorXd elastic = memory.elastic;
    ContactReport report;
    if (memory.laws.active()) {
        report =
            memory.laws.solve(with_laws(), stuck, {0.0, memory.opening, memory.slip, memory.states}, law, solution);
        if (report.resolved()) memory.laws.end();
    } else {
        report = solver_.solve(stuck, law, elastic, solution);
    }
    if (!report.resolved()) return report;
    memory.elastic = elastic;
    memory.states = solution.states;
    memory.force = solution.force;
    memory.opening = solution.displacement.head(m);
    memory.slip += solution.displacement.tail(m);
    return report;
}

JointLawSolver& StaticContact::with_laws()
{
    if (!with_laws_) with_laws_ = std::make_unique<JointLawSolver>(linear_->stiffness(), options_);
    return *with_laws_;
}

StaticState StaticContact::displacements(const SplitLoad& load, const ContactMemory& memory) const
{
    VectorXd gap(2 * memory.slip.size());
    gap << memory.opening, memory.slip + memory.elastic;
    return linear_->displacements(load, gap);
}

namespace {

constexpr int most_events = 50000;
constexpr double load_tolerance = 1e-12; ///< of t, at an event [-]
constexpr double excess_tolerance = 1e-9;

/// The contact problem at one share of the load, damage held.
class HeldDamage {
public:
    HeldDamage(JointLawSolver& solver, const VectorXd& before, const VectorXd& load, const ContactLaw& law,
               const ContactMemory& memory)
        : solver_(solver), before_(before), load_(load), law_(law), memory_(memory)
    {
        stuck_slip_ = solver.stiffness()->rightCols(memory.slip.size()) * (memory.slip + memory.elastic);
        solution_.states = memory.states;
    }

    void take(const BondLaw& bond)
    {
        held_ = JointLaws();
        for (const auto& law : memory_.laws.all())
            if (!dynamic_cast<const BondLaw*>(law.get())) held_.add(law->clone());
        held_.add(bond.held());
    }

    /// How far the worst pair is beyond its damage at a share of the load; infinite without equilibrium.
    double beyond(double t, const BondLaw& bond)
    {
        ContactSolution trial{solution_.states, {}, {}};
        const VectorXd stuck = (1.0 - t) * before_ + t * load_ + stuck_slip_;
        report_ = held_.solve(solver_, stuck, {0.0, memory_.opening, memory_.slip, memory_.states}, law_, trial);
        if (!report_.resolved()) return std::numeric_limits<double>::infinity();
        solution_ = trial;
        contact_ = trial;
        contact_.force -= held_.force();
        return bond.excess(contact_).maxCoeff() - 1.0;
    }

    const ContactSolution& contact() const { return contact_; }   ///< λ_c
    const ContactSolution& solution() const { return solution_; } ///< λ
    const ContactReport& report() const { return report_; }
    JointLaws& laws() { return held_; }

private:
    JointLawSolver& solver_;
    const VectorXd &before_, &load_;
    const ContactLaw& law_;
    const ContactMemory& memory_;
    VectorXd stuck_slip_;
    JointLaws held_;
    ContactSolution solution_, contact_;
    ContactReport report_;
};

/// Largest t in [0, 1] at which no pair is beyond its damage; less than 0: not even t = 0.
/// @param guess  where to look first
double event_load(HeldDamage& problem, const BondLaw& bond, double guess)
{
    double low = std::max(0.0, guess), below = problem.beyond(low, bond);
    double high = 1.0, above = std::numeric_limits<double>::infinity();
    if (below > excess_tolerance) {
        for (double width = 0.02 * low + 1e-3; below > excess_tolerance; width *= 4.0) {
            if (low == 0.0) return -1.0;
            high = low;
            above = below;
            low = std::max(0.0, high - width);
            below = problem.beyond(low, bond);
        }
    } else {
        if (low >= 1.0) return 1.0;
        for (double width = 0.02 * low + 1e-3;; width *= 4.0) {
            high = std::min(1.0, low + width);
            above = problem.beyond(high, bond);
            if (above > excess_tolerance) break;
            if (high >= 1.0) return 1.0;
            low = high;
            below = above;
        }
    }
    for (int k = 0; k < 100 && high - low > load_tolerance && below < -excess_tolerance; ++k) {
        // Piecewise linear in t: the secant is soon exact; halves where it is not, and where there is no equilibrium above.
        const bool secant = std::isfinite(above) && k % 3 != 2;
        const double t = secant ? low - below * (high - low) / (above - below) : 0.5 * (low + high);
        const double now = problem.beyond(t, bond);
        if (std::abs(now) <= excess_tolerance) return t;
        (now > 0.0 ? high : low) = t;
        (now > 0.0 ? above : below) = now;
    }
    problem.beyond(low, bond);
    return low;
}

/// The damage that follows an event: of the worst pair, and of all that are nearly as far. @returns false: there is none
bool damage(BondLaw& bond, const ContactSolution& contact, double step)
{
    const VectorXd excess = bond.excess(contact);
    const double largest = excess.maxCoeff(), least = std::min(1.0 - 0.5 * step, largest);
    if (largest < 1.0 - 1e-3) return false; // no pair stops the load
    for (Index i = 0; i < excess.size(); ++i)
        if (excess[i] >= least) bond.damage_more(i, step);
    return true;
}

void remember(const HeldDamage& problem, JointLaws laws, ContactMemory& memory)
{
    const Index m = memory.slip.size();
    const ContactSolution& solution = problem.solution();
    memory.states = solution.states;
    memory.force = solution.force;
    memory.opening = solution.displacement.head(m);
    memory.slip += solution.displacement.tail(m);
    laws.end();
    laws.replace(laws.find<BondLaw>()->released());
    memory.laws = std::move(laws);
}

} // namespace

StaticPath follow_damage(JointLawSolver& solver, const VectorXd& before, const VectorXd& load, const ContactLaw& law,
                         ContactMemory& memory, double step)
{
    StaticPath path;
    const auto* start = memory.laws.find<BondLaw>();
    if (!start) return path;
    BondLaw bond = *start;
    bond.begin({0.0, memory.opening, memory.slip, memory.states});
    ContactMemory at_limit = memory;
    HeldDamage problem(solver, before, load, law, memory);
    double highest = -1.0, at = 0.0;
    for (; path.events < most_events; ++path.events) {
        problem.take(bond);
        const double t = event_load(problem, bond, at);
        path.contact = problem.report();
        if (t < 0.0) break;
        at = t;
        if (t > highest) {
            highest = t;
            at_limit = memory;
            remember(problem, problem.laws(), at_limit);
        }
        if (t >= 1.0) {
            path.holds = true;
            break;
        }
        if (!damage(bond, problem.contact(), step)) break;
    }
    path.largest_load = std::max(0.0, highest);
    if (highest >= 0.0) memory = std::move(at_limit);
    return path;
}

double limit_load(const PlaneLimit& plane, const PlaneLoad& before, const PlaneLoad& load)
{
    double least = std::numeric_limits<double>::infinity();
    // Each condition is value(t) = a + b t >= 0, met at t = 0.
    const auto condition = [&](double at_start, double at_end) {
        const double change = at_end - at_start;
        if (change < 0.0) least = std::min(least, std::max(0.0, -at_start / change));
    };
    const auto each = [&](const PlaneLoad& p, double side) {
        return plane.shear_strength + plane.friction * p.normal - side * p.shear;
    };
    for (const double side : {1.0, -1.0}) condition(each(before, side), each(load, side));
    const auto upstream = [&](const PlaneLoad& p) { return p.moment + 0.5 * plane.tension_strength * plane.length; };
    const auto downstream = [&](const PlaneLoad& p) {
        return (p.normal + plane.tension_strength) * plane.length - upstream(p);
    };
    condition(before.normal + plane.tension_strength, load.normal + plane.tension_strength);
    condition(upstream(before), upstream(load));
    condition(downstream(before), downstream(load));
    return least;
}

} // namespace damslip::fe2d
