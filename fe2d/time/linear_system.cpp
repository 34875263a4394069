#include "fe2d/time/linear_system.hpp"

namespace damslip::fe2d {

void LinearSystem::add_damping_product(const Eigen::VectorXd& velocity, Eigen::VectorXd& force) const
{
    force.noalias() += damping * velocity;
    damping_low_rank.add_product(velocity, 1.0, force);
}

std::vector<char> massless_unknowns(const SparseMatrix& mass)
{
    std::vector<char> massless(static_cast<std::size_t>(mass.rows()), 1);
    for (Eigen::Index column = 0; column < mass.outerSize(); ++column)
        for (SparseMatrix::InnerIterator entry(mass, column); entry; ++entry)
            if (entry.value() != 0.0) massless[static_cast<std::size_t>(entry.row())] = 0;
    return massless;
}

} // namespace damslip::fe2d
