#include "fe2d/run/dynamic_operator.hpp"

#include <Eigen/Cholesky>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

MatrixXd symmetric_inverse(const MatrixXd& matrix)
{
    const MatrixXd inverse = matrix.llt().solve(MatrixXd::Identity(matrix.rows(), matrix.cols()));
    return 0.5 * (inverse + inverse.transpose());
}

SparseMatrix dam_matrix(const ContactStructure& structure, const RunDamping& damping, const StepConstants& c)
{
    const double w = 1.0 + c.scheme.alpha;
    return (c.a0 + w * c.a1 * damping.constants.mass) * structure.mass() +
           w * (1.0 + c.a1 * damping.constants.stiffness) * structure.stiffness();
}

} // namespace

SlipDamping::SlipDamping(const ContactStructure& structure, const RunDamping& damping)
    : weights(structure.plane().weights())
{
    if (damping.mass != MassDamping::deformation_only || damping.constants.mass == 0.0) return;
    VectorXd translation(structure.dam_unknowns());
    for (Index k = 0; k < translation.size(); k += 2) translation.segment<2>(k) = structure.plane().tangent;
    momentum = structure.mass() * translation;
    const double modal_mass = translation.dot(momentum);
    momentum /= modal_mass;
    coefficient = damping.constants.mass * modal_mass;
}

DynamicOperator::DynamicOperator(const ContactStructure& structure, const RunDamping& damping,
                                 const SlipDamping& slip_damping, const StepConstants& constants,
                                 const ContactOptions& options)
    : structure_(structure), slip_damping_(slip_damping), constants_(constants),
      factor_(dam_matrix(structure, damping, constants), structure.order().inner), options_(options)
{
    if (!factor_.regular()) return;
    const double w = 1.0 + constants.scheme.alpha;
    const Index m = structure.plane().pairs();
    dam_flexibility_ = symmetric_inverse(structure.plane().to_plane(factor_.schur()));
    if (structure.has_rock()) rock_share_ = 1.0 / (w * (1.0 + constants.a1 * damping.constants.stiffness));
    if (slip_damping.active()) {
        k_ = w * constants.a1 * slip_damping.coefficient;
        momentum_ = slip_damping.momentum;
        factor_.forward(momentum_);
        on_base_ = structure.plane().to_plane(VectorXd(momentum_.tail(2 * m)));
        z_ = dam_flexibility_ * on_base_;
        zeta_ = factor_.inner_product(momentum_, momentum_) + on_base_.dot(z_);
    }
    if (!structure.slides_far()) set_contact(nullptr);
}

void DynamicOperator::slide_to(const Pairing::Matrix& trace)
{
    set_contact(&trace);
}

void DynamicOperator::set_contact(const Pairing::Matrix* trace)
{
    const double w = 1.0 + constants_.scheme.alpha;
    const Index m = structure_.plane().pairs();
    MatrixXd flexibility = dam_flexibility_;
    if (trace) {
        const MatrixXd half = *trace * structure_.rock_flexibility();
        flexibility += rock_share_ * (half * trace->transpose());
    } else if (structure_.has_rock()) {
        flexibility += rock_share_ * structure_.rock_flexibility();
    }
    MatrixXd stiffness = symmetric_inverse(flexibility); // W⁻¹
    to_stuck_ = -stiffness / w;
    if (slip_damping_.active()) {
        const VectorXd& weights = slip_damping_.weights;
        MatrixXd e = MatrixXd::Identity(2 * m, 2 * m);
        e.rightCols(m) -= k_ * z_ * weights.transpose();
        to_stuck_ = -e.transpose() * stiffness / w;
        stiffness = e.transpose() * stiffness * e;
        stiffness.bottomRightCorner(m, m) += k_ * (1.0 - k_ * zeta_) * weights * weights.transpose();
        stiffness = (0.5 * (stiffness + stiffness.transpose())).eval();
    }
    stiffness /= w;
    contact_ = std::make_unique<JointSolver>(std::move(stiffness), structure_.plane().area, options_);
}

void DynamicOperator::solve_free(Free& free, const VectorXd& rock_gap) const
{
    const Index m = structure_.plane().pairs();
    factor_.forward(free.dam);
    free.on_base = structure_.plane().to_plane(VectorXd(free.dam.tail(2 * m)));
    free.dam_gap.noalias() = dam_flexibility_ * free.on_base;
    free.gap = free.dam_gap - rock_gap;
    if (slip_damping_.active()) free.mean = factor_.inner_product(momentum_, free.dam) + on_base_.dot(free.dam_gap);
}

void DynamicOperator::stuck_force(const Free& free, const VectorXd& known, VectorXd& stuck) const
{
    const double w = 1.0 + constants_.scheme.alpha;
    stuck.noalias() = to_stuck_ * free.gap;
    stuck += known / w;
    if (slip_damping_.active()) stuck.tail(structure_.plane().pairs()) -= (k_ / w * free.mean) * slip_damping_.weights;
}

const VectorXd& DynamicOperator::finish(Free& free, const VectorXd& force, const VectorXd& known, const VectorXd& gap,
                                        VectorXd& dam_interface)
{
    const Index m = structure_.plane().pairs();
    VectorXd& tilde = tilde_;
    tilde = (1.0 + constants_.scheme.alpha) * force - known;
    if (slip_damping_.active()) {
        // λ̃ = w λ₁ - known - k ω (s - m_Δ),  m_Δ = mean + k ζ s + zᵀλ̃
        const VectorXd& weights = slip_damping_.weights;
        const double slip = weights.dot(gap.tail(m));
        tilde.tail(m) -= (k_ * (slip - free.mean - k_ * zeta_ * slip)) * weights;
        const double z_tilde = z_.dot(tilde) / (1.0 - k_ * z_.tail(m).dot(weights));
        tilde.tail(m) += (k_ * z_tilde) * weights;
        free.dam.head(structure_.inner_unknowns()) += (k_ * slip) * momentum_.head(structure_.inner_unknowns());
        free.dam_gap += (k_ * slip) * z_;
    }
    dam_interface = free.dam_gap;
    dam_interface.noalias() += dam_flexibility_ * tilde;
    free.dam.tail(2 * m) = structure_.plane().to_interface(dam_interface);
    factor_.backward(free.dam);
    return tilde;
}

std::size_t DynamicOperator::bytes() const
{
    return factor_.bytes() +
           sizeof(double) * static_cast<std::size_t>(dam_flexibility_.size() + to_stuck_.size() +
                                                     2 * contact_->stiffness().size() + momentum_.size());
}

} // namespace damslip::fe2d
