#include "fe2d/rock/reduced_rock.hpp"

#include "fe2d/solver/dense_product.hpp"

#include <cassert>
#include <cmath>
#include <fmt/format.h>

namespace damslip::fe2d {

Note ReductionReport::missed_gate() const
{
    return {NoteKind::rock_gate_missed, {100.0 * error, 100.0 * wanted}};
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
    return on_path(normal.replicate(1, n), tangent.replicate(1, n));
}

ReducedRock ReducedRock::on_path(const Eigen::Matrix2Xd& normals, const Eigen::Matrix2Xd& tangents) const
{
    const Index n = base() / 2;
    const auto rows = [&](const MatrixXd& m) {
        MatrixXd turned(m.rows(), m.cols());
        for (Index i = 0; i < n; ++i) {
            turned.row(i) = normals.col(i).transpose() * m.middleRows(2 * i, 2);
            turned.row(n + i) = tangents.col(i).transpose() * m.middleRows(2 * i, 2);
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

using Eigen::VectorXd;

RockStep::RockStep(const ReducedRock& rock, double stiffness_damping, const StepConstants& constants)
    : rock_(rock), constants_(constants), b_k_(stiffness_damping)
{
    const double w = 1.0 + constants.scheme.alpha, elastic = w * (1.0 + constants.a1 * b_k_);
    residual_share_ = 1.0 / elastic;
    MatrixXd d = (w * constants.a1) * rock.damping;
    d.diagonal() += elastic * rock.stiffness;
    d.diagonal().array() += constants.a0;
    const Eigen::LLT<MatrixXd> llt(d);
    inverse_ = llt.solve(MatrixXd::Identity(d.rows(), d.cols()));
    inverse_ = (0.5 * (inverse_ + inverse_.transpose())).eval();
    // W_r as a sum of squares: L⁻¹Φᵀ
    const MatrixXd half = llt.matrixL().solve(rock.modes.transpose());
    compliance_ = residual_share_ * rock.residual;
    compliance_.selfadjointView<Eigen::Lower>().rankUpdate(half.transpose());
    compliance_.triangularView<Eigen::StrictlyUpper>() = compliance_.transpose();
    modal_pull_.noalias() = inverse_ * rock.modes.transpose();
}

RockMotion::RockMotion(const ReducedRock& rock) : rock_(rock)
{
    const Index modes = rock.count(), interface = rock.interface();
    for (VectorXd* x : {&q_, &qv_, &qa_, &radiating_, &radiating_a_}) x->setZero(modes);
    for (VectorXd* x : {&r_, &rv_, &ra_, &u_, &v_, &a_, &e_, &step_}) x->setZero(interface);
    now_ = {q_, r_};
    before_ = before2_ = now_;
}

void RockMotion::begin(const RockStep& step, const VectorXd& constant)
{
    assert(&step.rock() == &rock_);
    op_ = &step;
    const StepConstants& c = step.constants();
    const double alpha = c.scheme.alpha, w = 1.0 + alpha, cv = alpha + w * c.a4, ca = w * c.a5,
                 b_k = step.stiffness_damping();
    modal_ = c.a2 * qv_ + c.a3 * qa_ + cv * radiating_ + ca * radiating_a_ -
             rock_.stiffness.cwiseProduct(q_ - b_k * (cv * qv_ + ca * qa_));
    free_residual_ = b_k * (cv * rv_ + ca * ra_) - r_;
    if (constant.size() > 0) {
        modal_.noalias() += rock_.modes.transpose() * constant;
        free_residual_ += constant;
    }
    free_residual_ *= step.residual_share();
    free_modal_.noalias() = step.inverse() * modal_;
    free_.noalias() = rock_.modes * free_modal_;
    free_.noalias() += rock_.residual * free_residual_;
}

void RockMotion::finish(const VectorXd& weighted_force)
{
    assert(op_ && weighted_force.size() == rock_.interface());
    const StepConstants& c = op_->constants();
    modal_step_ = free_modal_;
    modal_step_.noalias() += op_->modal_pull() * weighted_force;
    residual_step_ = free_residual_ + op_->residual_share() * weighted_force;
    e_step_.noalias() = rock_.residual * residual_step_;
    step_ = e_step_;
    step_.noalias() += rock_.modes * modal_step_;

    before_qv_ = qv_;
    before_qa_ = qa_;
    before_rv_ = rv_;
    const auto update = [&](const VectorXd& step, VectorXd& x, VectorXd& velocity, VectorXd& acceleration) {
        for (Index i = 0; i < x.size(); ++i) {
            const double v = velocity[i], a = acceleration[i];
            velocity[i] = c.a1 * step[i] - c.a4 * v - c.a5 * a;
            acceleration[i] = c.a0 * step[i] - c.a2 * v - c.a3 * a;
            x[i] += step[i];
        }
    };
    update(modal_step_, q_, qv_, qa_);
    update(residual_step_, r_, rv_, ra_);
    update(step_, u_, v_, a_);
    e_ += e_step_;
    radiating_.noalias() = rock_.damping * qv_;
    radiating_a_.noalias() = rock_.damping * qa_;
    add_energy();
}

/// EnergyLedger with M = 1, for the two bodies in series.
void RockMotion::add_energy()
{
    const StepConstants& c = op_->constants();
    const double alpha = c.scheme.alpha, gamma = c.scheme.gamma, dt = c.dt, b_k = op_->stiffness_damping();
    std::swap(before2_, before_);
    std::swap(before_, now_);
    now_.modal = radiating_ + rock_.stiffness.cwiseProduct(q_ + b_k * qv_);
    now_.residual = r_ + b_k * rv_;

    energy_.kinetic = 0.5 * qv_.squaredNorm();
    energy_.strain = 0.5 * q_.dot(rock_.stiffness.cwiseProduct(q_)) + 0.5 * e_.dot(r_);
    modal_ = qv_ + before_qv_;
    product_.noalias() = rock_.damping * modal_;
    energy_.radiated += 0.5 * modal_step_.dot(product_);
    energy_.damping +=
        0.5 * b_k * (modal_step_.dot(rock_.stiffness.cwiseProduct(modal_)) + e_step_.dot(rv_ + before_rv_));
    const VectorXd& change = modal_ = qa_ - before_qa_;
    const double half_beta = c.scheme.beta - 0.5 * gamma;
    double numerical = -(gamma - 0.5) * modal_step_.dot(change) +
                       (gamma - 0.5) * half_beta * dt * dt * change.squaredNorm() +
                       0.5 * half_beta * dt * dt * (qa_.squaredNorm() - before_qa_.squaredNorm());
    if (alpha != 0.0)
        numerical += 0.5 * alpha *
                     (modal_step_.dot(now_.modal - before2_.modal) + e_step_.dot(now_.residual - before2_.residual));
    if (landed_) { // the equation of the last step saw other velocities and accelerations
        numerical -= 0.5 * (1.0 + alpha) * (modal_step_.dot(landed_modal_) + e_step_.dot(landed_residual_));
        landed_ = false;
    }
    energy_.numerical += numerical;
}

void RockMotion::land()
{
    if (landed_) return;
    landed_ = true;
    landed_modal_.setZero(q_.size());
    landed_residual_.setZero(r_.size());
}

const VectorXd& RockMotion::jump_velocity(const VectorXd& force)
{
    assert(op_);
    const double b_k = op_->stiffness_damping();
    modal_.noalias() = op_->modal_pull() * force;
    residual_ = op_->residual_share() * force;
    qv_ += modal_;
    rv_ += residual_;
    jump_.noalias() = op_->compliance() * force;
    v_ += jump_;
    product_.noalias() = rock_.damping * modal_;
    radiating_ += product_;
    land();
    product_ += b_k * rock_.stiffness.cwiseProduct(modal_); // all damping forces
    landed_modal_ += product_;
    landed_residual_ += b_k * residual_;
    now_.modal += product_;
    now_.residual += b_k * residual_;
    const double kinetic = 0.5 * qv_.squaredNorm();
    energy_.numerical += energy_.kinetic - kinetic;
    energy_.kinetic = kinetic;
    return jump_;
}

const VectorXd& RockMotion::jump_acceleration(const VectorXd& force)
{
    assert(op_);
    modal_.noalias() = op_->modal_pull() * force;
    qa_ += modal_;
    ra_ += op_->residual_share() * force;
    jump_.noalias() = op_->compliance() * force;
    a_ += jump_;
    radiating_a_.noalias() += rock_.damping * modal_;
    land();
    landed_modal_ += modal_ / (1.0 + op_->constants().scheme.alpha); // M δa
    return jump_;
}

namespace {

class RockBase final : public MovingBase {
public:
    RockBase(const ReducedRock& rock, const StepConstants& constants, double stiffness_damping)
        : step_(rock, stiffness_damping, constants), motion_(rock)
    {
    }

    std::int64_t unknowns() const override { return step_.rock().count(); }
    const Eigen::MatrixXd& compliance() const override { return step_.compliance(); }
    const Eigen::VectorXd& begin_step() override
    {
        motion_.begin(step_);
        return motion_.free_step();
    }
    void end_step(const Eigen::VectorXd& weighted_force) override { motion_.finish(weighted_force); }
    Energy energy() const override
    {
        const RockEnergy& rock = motion_.energy();
        Energy energy;
        energy.kinetic = rock.kinetic;
        energy.strain = rock.strain;
        energy.damping = rock.damping;
        energy.radiated = rock.radiated;
        energy.numerical = rock.numerical;
        return energy;
    }

    Eigen::Index floor() const override { return step_.rock().floor; }
    Eigen::VectorXd floor_velocity() const override { return motion_.velocity().tail(floor()); }
    Eigen::VectorXd floor_acceleration() const override { return motion_.acceleration().tail(floor()); }

private:
    RockStep step_;
    RockMotion motion_;
};

} // namespace

std::unique_ptr<MovingBase> rock_base(const ReducedRock& rock, const StepConstants& constants, double stiffness_damping)
{
    return std::make_unique<RockBase>(rock, constants, stiffness_damping);
}

} // namespace damslip::fe2d
