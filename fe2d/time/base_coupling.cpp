#include "fe2d/time/base_coupling.hpp"

#include <cassert>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

SparseMatrix selection(std::span<const Index> unknowns, Index size)
{
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t k = 0; k < unknowns.size(); ++k) entries.emplace_back(static_cast<Index>(k), unknowns[k], 1.0);
    SparseMatrix map(static_cast<Index>(unknowns.size()), size);
    map.setFromTriplets(entries.begin(), entries.end());
    return map;
}

} // namespace

BaseCoupling::BaseCoupling(std::unique_ptr<MovingBase> base, const StepOperator& dam, std::span<const Index> unknowns,
                           Index size)
    : base_(std::move(base)), map_(selection(unknowns, size)), alpha_(dam.constants().scheme.alpha),
      dam_(dam.flexibility(map_)), force_(VectorXd::Zero(map_.rows())), force_before_(force_)
{
    assert(base_->compliance().rows() == map_.rows());
    factor_.compute(dam_.delassus + (1.0 + alpha_) * base_->compliance());
}

InterfaceForces BaseCoupling::step(const FreeStep& free)
{
    VectorXd gap = base_->begin_step();
    if (alpha_ != 0.0) gap += alpha_ * (base_->compliance() * force_);
    gap -= map_ * free.increment;
    const VectorXd force = factor_.solve(gap);
    base_->end_step(alpha_ * force_ - (1.0 + alpha_) * force);

    InterfaceForces forces{map_.transpose() * force, dam_.response * force};
    const VectorXd step = map_ * (free.increment + (1.0 + alpha_) * forces.displacement);
    numerical_work_ = 0.5 * alpha_ * step.dot(force - force_before_);
    force_before_ = force_;
    force_ = force;
    return forces;
}

} // namespace damslip::fe2d
