#include "fe2d/run/static_contact.hpp"

#include <Eigen/Cholesky>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Pᵀ S P
MatrixXd carried(const MatrixXd& stiffness, const Pairing::Matrix& trace)
{
    const MatrixXd right = stiffness * trace;
    return trace.transpose() * right;
}

} // namespace

StaticContact::StaticContact(const ContactStructure& structure, const ContactOptions& options, double slip)
    : structure_(structure)
{
    MatrixXd stiffness = structure.plane().to_plane(structure.static_factor().schur());
    if (structure.has_rock()) {
        const MatrixXd& rock = structure.rock_stiffness();
        if (structure.slides_far()) {
            trace_ = structure.pairing().trace(slip);
            dam_stiffness_ = stiffness;
        }
        const MatrixXd tied = rock + (structure.slides_far() ? carried(stiffness, trace_) : stiffness);
        tied_flexibility_ = tied.llt().solve(MatrixXd::Identity(tied.rows(), tied.cols()));
        tied_flexibility_ = (0.5 * (tied_flexibility_ + tied_flexibility_.transpose())).eval();
        if (structure.slides_far()) {
            const MatrixXd held = stiffness * trace_;
            stiffness -= held * tied_flexibility_ * held.transpose();
        } else {
            stiffness = rock - rock * tied_flexibility_ * rock;
        }
        stiffness = (0.5 * (stiffness + stiffness.transpose())).eval();
    }
    solver_ = std::make_unique<JointSolver>(std::move(stiffness), structure.plane().area, options);
}

VectorXd StaticContact::condensed(const SplitLoad& load) const
{
    VectorXd b = load.dam;
    structure_.static_factor().forward(b);
    return structure_.plane().to_plane(VectorXd(b.tail(2 * structure_.plane().pairs())));
}

VectorXd StaticContact::tied(const VectorXd& on_base, const SplitLoad& load) const
{
    if (!structure_.slides_far()) return tied_flexibility_ * (on_base + load.rock);
    return tied_flexibility_ * (trace_.transpose() * on_base + structure_.rock_load(load, trace_));
}

ContactReport StaticContact::solve(const SplitLoad& load, const ContactLaw& law, ContactMemory& memory)
{
    const Index m = structure_.plane().pairs();
    const VectorXd on_base = condensed(load);
    VectorXd stuck = -on_base;
    if (structure_.slides_far())
        stuck += dam_stiffness_ * (trace_ * tied(on_base, load));
    else if (structure_.has_rock())
        stuck = load.rock - structure_.rock_stiffness() * tied(on_base, load);
    stuck += solver_->stiffness().rightCols(m) * (memory.slip + memory.elastic);
    ContactSolution solution{memory.states, {}, memory.force};
    VectorXd elastic = memory.elastic;
    const ContactReport report = solver_->solve(stuck, law, elastic, solution);
    if (!report.resolved()) return report;
    memory.elastic = elastic;
    memory.states = solution.states;
    memory.force = solution.force;
    memory.opening = solution.displacement.head(m);
    memory.slip += solution.displacement.tail(m);
    return report;
}

StaticState StaticContact::displacements(const SplitLoad& load, const ContactMemory& memory) const
{
    const Index m = structure_.plane().pairs();
    VectorXd gap(2 * m);
    gap << memory.opening, memory.slip + memory.elastic;
    StaticState state;
    VectorXd u = gap;
    if (structure_.slides_far()) {
        state.rock = tied(condensed(load) - dam_stiffness_ * gap, load);
        u += trace_ * state.rock;
    } else {
        if (structure_.has_rock())
            u = tied_flexibility_ * (condensed(load) + load.rock + structure_.rock_stiffness() * gap);
        state.rock = u - gap;
    }
    state.dam = load.dam;
    structure_.static_factor().forward(state.dam);
    state.dam.tail(2 * m) = structure_.plane().to_interface(u);
    structure_.static_factor().backward(state.dam);
    return state;
}

} // namespace damslip::fe2d
