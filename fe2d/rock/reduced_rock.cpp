#include "fe2d/rock/reduced_rock.hpp"
#include "fe2d/solver/dense_algebra.hpp"

#include <fmt/format.h>

#include <cassert>
#include <cmath>

namespace damslip::fe2d {

std::string ReductionReport::missed_gate() const
{
    return fmt::format("The radiating rock's reduction errs by {:.2g} %, {:.2g} % are allowed: give a smaller "
                       "foundation.wave_frequency_Hz.",
                       100.0 * error, 100.0 * wanted);
}

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

MatrixXd ReducedRock::static_flexibility() const
{
    return modes * stiffness.cwiseInverse().asDiagonal() * modes.transpose() + residual;
}

MatrixXcd ReducedRock::response(double frequency, double stiffness_damping, const MatrixXd& loads) const
{
    assert(loads.rows() == interface());
    const std::complex<double> viscous(1.0, frequency * stiffness_damping); // 1 + iω b_K
    MatrixXcd matrix = std::complex<double>(0.0, frequency) * damping;
    matrix.diagonal() += viscous * stiffness;
    matrix.diagonal().array() -= frequency * frequency;
    const MatrixXd modal = modes.transpose() * loads, rest = residual * loads;
    const MatrixXcd q = matrix.partialPivLu().solve(modal.cast<std::complex<double>>());
    return modes * q + rest / viscous;
}

ReducedRock ReducedRock::scaled(double young_modulus, double density, double length) const
{
    assert(young_modulus > 0.0 && density > 0.0 && length > 0.0);
    const double rate = std::sqrt(young_modulus / density) / length;
    ReducedRock result = *this;
    result.stiffness *= rate * rate;
    result.damping *= rate;
    result.modes /= std::sqrt(density) * length;
    result.residual /= young_modulus;
    if (floor > 0) { // volumes
        result.modes.bottomRows(floor) *= length;
        result.residual.bottomRows(floor) *= length;
        result.residual.rightCols(floor) *= length;
    }
    return result;
}

ReducedRock ReducedRock::on_plane(const Eigen::Vector2d& normal, const Eigen::Vector2d& tangent) const
{
    const Index n = base() / 2;
    const auto rows = [&](const MatrixXd& m) {
        MatrixXd turned(m.rows(), m.cols());
        for (Index i = 0; i < n; ++i) {
            turned.row(i) = normal.transpose() * m.middleRows(2 * i, 2);
            turned.row(n + i) = tangent.transpose() * m.middleRows(2 * i, 2);
        }
        turned.bottomRows(floor) = m.bottomRows(floor);
        return turned;
    };
    ReducedRock result = *this;
    result.modes = rows(modes);
    const MatrixXd half = rows(residual);
    result.residual = rows(half.transpose());
    return result;
}

} // namespace damslip::fe2d
