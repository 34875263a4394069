#include "fe2d/run/static_contact.hpp"
#include "fe2d/solver/dense_algebra.hpp"

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
    const ContactPlanes& planes = structure.planes();
    const MatrixXd& interface = structure.static_factor().schur();
    dam_stiffness_ = symmetric(between(planes.held(), interface, planes.held()));
    if (planes.count() > 1) {
        joined_ = inverse(between(planes.joined(), interface, planes.joined()));
        coupling_ = between(planes.joined(), interface, planes.held());
        dam_stiffness_ = symmetric(dam_stiffness_ - coupling_.transpose() * (joined_ * coupling_));
    }
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
    const ContactPlanes& planes = structure_.planes();
    VectorXd dam = load.dam;
    structure_.static_factor().forward(dam);
    Reduced result;
    result.on_interface = dam.tail(2 * structure_.interface());
    result.force = planes.held().transpose() * result.on_interface;
    if (planes.count() > 1)
        result.force -= coupling_.transpose() * (joined_ * (planes.joined().transpose() * result.on_interface));
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
    const ContactPlanes& planes = structure_.planes();
    const Reduced f = reduced(load);
    StaticState state;
    VectorXd x = gap;
    if (structure_.has_rock()) {
        state.rock = tied_flexibility_ * (trace_.transpose() * (f.force - dam_stiffness_ * gap) + f.rock);
        x += trace_ * state.rock;
    }
    VectorXd interface = planes.held() * x;
    if (planes.count() > 1)
        interface +=
            planes.joined() * VectorXd(joined_ * (planes.joined().transpose() * f.on_interface - coupling_ * x));
    state.dam = load.dam;
    structure_.static_factor().forward(state.dam);
    state.dam.tail(interface.size()) = interface;
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

} // namespace damslip::fe2d
