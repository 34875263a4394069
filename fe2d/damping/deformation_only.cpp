#include "fe2d/damping/deformation_only.hpp"

#include <cassert>
#include <cmath>

namespace damslip::fe2d {

LowRank deformation_only_correction(double mass_coefficient, const Eigen::SparseMatrix<double>& mass,
                                    const Eigen::VectorXd& rigid_translation, const Eigen::VectorXd& slip_weights)
{
    assert(std::abs(slip_weights.dot(rigid_translation) - 1.0) < 1e-9);
    const Eigen::VectorXd momentum = mass * rigid_translation;
    const double modal_mass = rigid_translation.dot(momentum);
    // Columns of like size keep the small system of Woodbury's formula well scaled: M r is divided by rᵀM r.
    LowRank correction;
    correction.columns.resize(mass.rows(), 2);
    correction.columns << slip_weights, momentum / modal_mass;
    correction.core.resize(2, 2);
    correction.core << 1.0, -1.0, -1.0, 0.0;
    correction.core *= mass_coefficient * modal_mass;
    return correction;
}

} // namespace damslip::fe2d
