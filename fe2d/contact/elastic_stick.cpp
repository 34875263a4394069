#include "fe2d/contact/elastic_stick.hpp"
#include "fe2d/solver/dense_algebra.hpp"

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

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
