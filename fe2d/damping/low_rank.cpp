#include "fe2d/damping/low_rank.hpp"

namespace damslip::fe2d {

void LowRank::add_product(const Eigen::VectorXd& x, double factor, Eigen::VectorXd& result) const
{
    if (!empty()) result.noalias() += columns * (factor * (core * (columns.transpose() * x)));
}

} // namespace damslip::fe2d
