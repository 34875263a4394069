#include "fe2d/time/modal_recurrence.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// exp(A) by scaling to a norm below 1/4, Taylor's series of 14 terms ((1/4)^15/15! < 1e-21) and squaring.
MatrixXd exponential(const MatrixXd& matrix)
{
    const double norm = matrix.cwiseAbs().rowwise().sum().maxCoeff();
    const int squarings = std::max(0, static_cast<int>(std::ceil(std::log2(std::max(norm, 1e-300) / 0.25))));
    const MatrixXd small = matrix / std::pow(2.0, squarings);
    MatrixXd sum = MatrixXd::Identity(matrix.rows(), matrix.cols()), term = sum;
    for (int k = 1; k <= 14; ++k) {
        term = (term * small / k).eval();
        sum += term;
    }
    for (int k = 0; k < squarings; ++k) sum = (sum * sum).eval();
    return sum;
}

bool has_off_diagonal(const MatrixXd& matrix)
{
    const MatrixXd diagonal = matrix.diagonal().asDiagonal();
    return (matrix - diagonal).cwiseAbs().maxCoeff() > 1e-12 * matrix.cwiseAbs().maxCoeff();
}

} // namespace

ModalRecurrence::ModalRecurrence(const VectorXd& omega, const MatrixXd& damping, const MatrixXd& loads, double dt)
    : omega_(omega), damping_(damping), loads_(loads), coupled_(has_off_diagonal(damping))
{
    assert(dt > 0.0 && omega.minCoeff() > 0.0 && damping.rows() == omega.size());
    // The closed formula is for oscillating modes; overdamped ones go by the exponential.
    if ((damping_.diagonal().array() >= 2.0 * omega_.array()).any()) coupled_ = true;
    if (coupled_)
        make_coupled(dt);
    else
        make_diagonal(dt);
}

/// With p(s) = p₀ + (p₁ - p₀) s/Δt the part that follows the load is q_p = A + B s, B = (p₁ - p₀)/(Δt ω²),
/// A = p₀/ω² - 2ζB/ω, and the rest vibrates freely from (q₀ - A, q̇₀ - B).
void ModalRecurrence::make_diagonal(double dt)
{
    const Index n = modes();
    for (Eigen::ArrayXd* values : {&qq_, &qv_, &vq_, &vv_, &q0_, &q1_, &v0_, &v1_}) values->resize(n);
    for (Index k = 0; k < n; ++k) {
        const double w = omega_[k], half = 0.5 * damping_(k, k); // ζω
        const double wd = std::sqrt((w - half) * (w + half));
        const double decay = std::exp(-half * dt), c = std::cos(wd * dt), s = std::sin(wd * dt) / wd;
        const double qq = decay * (c + half * s), qv = decay * s;
        const double vq = -decay * w * w * s, vv = decay * (c - half * s);
        qq_[k] = qq, qv_[k] = qv, vq_[k] = vq, vv_[k] = vv;
        const double b = 1.0 / (dt * w * w), lag = 2.0 * half / (w * w) * b; // B and 2ζB/ω per p₁ - p₀
        // Of p₁ alone: A = -lag, B = b; of p₀ alone: A = 1/ω² + lag, B = -b.
        q1_[k] = -lag + b * dt + qq * lag - qv * b;
        v1_[k] = b + vq * lag - vv * b;
        const double a0 = 1.0 / (w * w) + lag;
        q0_[k] = a0 - b * dt - qq * a0 + qv * b;
        v0_[k] = -b - vq * a0 + vv * b;
    }
}

/// d/dt (x, a, a') = [[A, B, 0], [0, 0, 1], [0, 0, 0]] (x, a, a'), A = [[0, Ω], [-Ω, -C]], B = [[0], [P]], time in steps.
void ModalRecurrence::make_coupled(double dt)
{
    const Index n = modes();
    const Index l = loads_.cols();
    MatrixXd matrix = MatrixXd::Zero(2 * (n + l), 2 * (n + l));
    matrix.block(0, n, n, n) = (dt * omega_).asDiagonal();
    matrix.block(n, 0, n, n) = (-dt * omega_).asDiagonal();
    matrix.block(n, n, n, n) = -dt * damping_;
    matrix.block(n, 2 * n, n, l) = dt * loads_;
    matrix.block(2 * n, 2 * n + l, l, l).setIdentity();
    const MatrixXd all = exponential(matrix);
    transition_ = all.topLeftCorner(2 * n, 2 * n);
    from_after_ = all.block(0, 2 * n + l, 2 * n, l); // of a' = a₁ - a₀
    from_before_ = all.block(0, 2 * n, 2 * n, l) - from_after_;
}

void ModalRecurrence::step(VectorXd& q, VectorXd& rate, const VectorXd& before, const VectorXd& after) const
{
    if (coupled_) {
        const Index n = modes();
        VectorXd x(2 * n);
        x << omega_.cwiseProduct(q), rate;
        x = (transition_ * x + from_before_ * before + from_after_ * after).eval();
        q = x.head(n).cwiseQuotient(omega_);
        rate = x.tail(n);
        return;
    }
    const Eigen::ArrayXd q0 = q.array(), v0 = rate.array(), p0 = (loads_ * before).array(),
                         p1 = (loads_ * after).array();
    q = (qq_ * q0 + qv_ * v0 + q0_ * p0 + q1_ * p1).matrix();
    rate = (vq_ * q0 + vv_ * v0 + v0_ * p0 + v1_ * p1).matrix();
}

VectorXd ModalRecurrence::acceleration(const VectorXd& q, const VectorXd& rate, const VectorXd& amplitudes) const
{
    return loads_ * amplitudes - damping_ * rate - omega_.cwiseAbs2().cwiseProduct(q);
}

} // namespace damslip::fe2d
