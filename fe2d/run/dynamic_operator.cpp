#include "fe2d/run/dynamic_operator.hpp"

#include "fe2d/solver/dense_product.hpp"

#include <cassert>

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
    SparseMatrix damped = (w * c.a1 * damping.constants.mass) * structure.dam_mass();
    if (structure.gyrates()) damped += (w * c.a1) * structure.gyration();
    if (!structure.water())
        return c.a0 * structure.mass() + damped +
               w * (1.0 + c.a1 * damping.constants.stiffness) * structure.stiffness();
    return c.a0 * structure.mass() + damped + w * structure.stiffness() +
           (w * c.a1 * damping.constants.stiffness) * structure.of_dam(structure.stiffness());
}

} // namespace

SlipDamping::SlipDamping(const ContactStructure& structure, const RunDamping& damping)
    : weights(structure.planes().weights())
{
    if (damping.mass != MassDamping::deformation_only || damping.constants.mass == 0.0) return;
    const MatrixXd motions = sliding_motions(structure.planes());
    MatrixXd ordered(structure.dam_unknowns(), motions.cols());
    for (Index k = 0; k < motions.cols(); ++k) ordered.col(k) = structure.to_order(motions.col(k));
    momentum = damping.constants.mass * (structure.dam_mass() * ordered);
    drag = ordered.transpose() * momentum;
}

DynamicOperator::DynamicOperator(const ContactStructure& structure, const RunDamping& damping,
                                 const SlipDamping& slip_damping, const StepConstants& constants,
                                 const ReducedRock* radiating)
    : structure_(structure), slip_damping_(slip_damping), constants_(constants),
      factor_(dam_matrix(structure, damping, constants), structure.order().inner - structure.floor_nodes(),
              structure.water() ? -1 : 0, structure.floor_nodes(), structure.ties(),
              // without water all it adds to K, which the structure has checked, is semi-definite
              structure.water() ? InterfaceSigns::checked : InterfaceSigns::known),
      gaps_(structure.planes().gaps())
{
    if (!factor_.regular()) return;
    const double w = 1.0 + constants.scheme.alpha;
    if (radiating) rock_step_.emplace(*radiating, damping.constants.stiffness, constants);
    by_gaps_ = !radiating && !structure.has_rock() && !has_floor() && structure.planes().count() > 1;
    if (has_floor())
        couple_floor();
    else if (!by_gaps_)
        interface_flexibility_ = symmetric_inverse(factor_.schur());
    const ContactPlanes::Matrix& gaps = gaps_;
    if (!by_gaps_) {
        pull_ = interface_flexibility_ * gaps.transpose();
        dam_flexibility_ = gaps * pull_;
    }
    if (!radiating && structure.has_rock())
        rock_share_ = 1.0 / (w * (1.0 + constants.a1 * damping.constants.stiffness));
    if (slip_damping.active()) {
        const Index planes = slip_damping.momentum.cols(), interface = interface_unknowns();
        momentum_ = w * constants.a1 * slip_damping.momentum;
        drag_ = w * constants.a1 * slip_damping.drag;
        for (Index k = 0; k < planes; ++k) {
            VectorXd column = momentum_.col(k);
            factor_.forward(column);
            momentum_.col(k) = column;
        }
        if (by_gaps_) {
            z_ = gaps * momentum_.bottomRows(interface);
            zeta_ = MatrixXd::Zero(planes, planes);
        } else {
            interface_momentum_ = interface_flexibility_ * momentum_.bottomRows(interface);
            z_ = gaps * interface_momentum_;
            zeta_ = momentum_.bottomRows(interface).transpose() * interface_momentum_;
        }
        for (Index i = 0; i < planes; ++i)
            for (Index k = 0; k < planes; ++k) zeta_(i, k) += factor_.inner_product(momentum_.col(i), momentum_.col(k));
        if (!by_gaps_)
            unmixed_ = (MatrixXd::Identity(planes, planes) -
                        z_.bottomRows(structure.pairs()).transpose() * slip_damping.weights)
                           .inverse();
    }
    contact_ = contact_at(structure.trace(0.0));
}

/// The floor's part of the step: pressures see the rock's compliance there, and contact forces reach them through it.
void DynamicOperator::couple_floor()
{
    const ReducedRock& rock = rock_step_->rock();
    const MatrixXd& compliance = rock_step_->compliance();
    const Index base = rock.base(), floor = rock.floor, first = factor_.inner_unknowns(),
                pressures = 2 * structure_.floor_nodes();
    assert(floor == static_cast<Index>(structure_.floor().size()) && !structure_.slides_far());
    floor_factor_ = (1.0 + constants_.scheme.alpha) * constants_.a1 * structure_.water()->scale;
    MatrixXd places = MatrixXd::Zero(floor, pressures);
    for (Index k = 0; k < floor; ++k) places(k, structure_.floor()[static_cast<std::size_t>(k)] - first) = 1.0;

    MatrixXd schur = factor_.schur();
    schur.topLeftCorner(pressures, pressures) -=
        (floor_factor_ * floor_factor_) * (places.transpose() * compliance.bottomRightCorner(floor, floor) * places);
    const MatrixXd inverse = schur.partialPivLu().inverse(); // of both signs
    interface_flexibility_ = 0.5 * (inverse + inverse.transpose());

    const ContactPlanes::Matrix& of_dam = structure_.planes().gaps();
    MatrixXd gaps(of_dam.rows(), pressures + of_dam.cols());
    gaps.rightCols(of_dam.cols()) = of_dam;
    gaps.leftCols(pressures) =
        -floor_factor_ * (structure_.trace(0.0) * (compliance.topRightCorner(base, floor) * places));
    gaps_ = gaps.sparseView(0.0, 0.0);
}

VectorXd DynamicOperator::on_floor(const VectorXd& interface) const
{
    VectorXd values(static_cast<Index>(structure_.floor().size()));
    for (Index k = 0; k < values.size(); ++k)
        values[k] = interface[structure_.floor()[static_cast<std::size_t>(k)] - factor_.inner_unknowns()];
    return values;
}

/// W⁻¹
MatrixXd DynamicOperator::sticking_stiffness(const Pairing::Matrix& trace) const
{
    MatrixXd flexibility = dam_flexibility_;
    if (rock_step_) {
        const Index base = rock_step_->rock().base();
        const MatrixXd half = trace * rock_step_->compliance().topLeftCorner(base, base);
        flexibility += half * trace.transpose();
    } else if (structure_.has_rock()) {
        const MatrixXd half = trace * structure_.rock_flexibility();
        flexibility += rock_share_ * (half * trace.transpose());
    }
    return symmetric_inverse(flexibility);
}

/// w V where the gaps are all that is free on the interface.
MatrixXd DynamicOperator::stiffness_by_gaps() const
{
    const Index m = structure_.pairs();
    MatrixXd stiffness = gaps_ * factor_.schur();
    stiffness = (stiffness * gaps_.transpose()).eval();
    if (!slip_damping_.active()) return stiffness;
    const MatrixXd& weights = slip_damping_.weights;
    stiffness.rightCols(m) -= z_ * weights.transpose();
    stiffness.bottomRows(m) -= weights * z_.transpose();
    stiffness.bottomRightCorner(m, m) += weights * (drag_ - zeta_) * weights.transpose();
    return 0.5 * (stiffness + stiffness.transpose());
}

StepContact DynamicOperator::contact_at(const Pairing::Matrix& trace) const
{
    const double w = 1.0 + constants_.scheme.alpha;
    const Index m = structure_.pairs();
    StepContact contact;
    if (by_gaps_) {
        contact.stiffness = std::make_shared<const MatrixXd>(stiffness_by_gaps() / w);
        return contact;
    }
    MatrixXd stiffness = sticking_stiffness(trace);
    if (!slip_damping_.active()) {
        contact.to_stuck = -stiffness / w;
    } else if (const MatrixXd& weights = slip_damping_.weights; weights.cols() == 1) {
        MatrixXd e = MatrixXd::Identity(2 * m, 2 * m);
        e.rightCols(m) -= z_ * weights.transpose();
        contact.to_stuck = -e.transpose() * stiffness / w;
        stiffness = e.transpose() * stiffness * e;
        stiffness.bottomRightCorner(m, m) += weights * (drag_ - zeta_) * weights.transpose();
        stiffness = (0.5 * (stiffness + stiffness.transpose())).eval();
    } else { // the same by products of a few columns
        const MatrixXd pulled = z_.transpose() * stiffness;
        const MatrixXd own = drag_ - zeta_ + pulled * z_;
        contact.to_stuck = -stiffness / w;
        contact.to_stuck.bottomRows(m) += weights * (pulled / w);
        stiffness.bottomRows(m) -= weights * pulled;
        stiffness.rightCols(m) -= pulled.transpose() * weights.transpose();
        stiffness.bottomRightCorner(m, m) += weights * own * weights.transpose();
        stiffness = (0.5 * (stiffness + stiffness.transpose())).eval();
    }
    contact.stiffness = std::make_shared<const MatrixXd>(stiffness / w);
    return contact;
}

void DynamicOperator::solve_free(Free& free, const VectorXd& rock_gap) const
{
    const Index interface = interface_unknowns();
    if (by_gaps_) {
        free.gap.noalias() = gaps_ * free.dam.tail(interface);
        free.mean.setZero(momentum_.cols());
    } else {
        set_product(interface_flexibility_, free.dam.tail(interface), free.interface);
        free.gap.noalias() = gaps_ * free.interface;
        if (rock_gap.size() > 0) free.gap -= rock_gap;
    }
    if (!slip_damping_.active()) return;
    if (!by_gaps_) free.mean.noalias() = momentum_.bottomRows(interface).transpose() * free.interface;
    for (Index k = 0; k < momentum_.cols(); ++k) free.mean[k] += factor_.inner_product(momentum_.col(k), free.dam);
}

void DynamicOperator::stuck_force(const StepContact& contact, Free& free, const VectorXd& known, VectorXd& stuck) const
{
    const double w = 1.0 + constants_.scheme.alpha;
    if (by_gaps_) {
        stuck = (known - free.gap) / w;
    } else {
        set_product(contact.to_stuck, free.gap, stuck);
        stuck += known / w;
    }
    if (!slip_damping_.active()) return;
    free.drag = free.mean / w;
    free.on_pairs.noalias() = slip_damping_.weights * free.drag;
    stuck.tail(structure_.pairs()) -= free.on_pairs;
}

void DynamicOperator::finish(Free& free, const VectorXd& force, const VectorXd& known, const VectorXd& gap,
                             VectorXd& tilde) const
{
    const Index m = structure_.pairs(), inner = factor_.inner_unknowns();
    if (by_gaps_) {
        if (slip_damping_.active()) {
            free.slip.noalias() = slip_damping_.weights.transpose() * gap.tail(m);
            free.dam.head(inner).noalias() += momentum_.topRows(inner) * free.slip;
        }
        free.interface.noalias() = gaps_.transpose() * gap;
        free.dam.tail(free.interface.size()) = free.interface;
        return;
    }
    tilde = (1.0 + constants_.scheme.alpha) * force - known;
    if (slip_damping_.active()) {
        // λ̃ = w λ₁ - known - ω (κ' s - kᵀΔu),  kᵀΔu = mean + ζ s + zᵀλ̃
        const MatrixXd& weights = slip_damping_.weights;
        VectorXd &slip = free.slip, &drag = free.drag, &pulled = free.pulled;
        slip.noalias() = weights.transpose() * gap.tail(m);
        drag.noalias() = drag_ * slip;
        pulled.noalias() = zeta_ * slip;
        drag -= free.mean;
        drag -= pulled;
        free.on_pairs.noalias() = weights * drag;
        tilde.tail(m) -= free.on_pairs;
        pulled.noalias() = z_.transpose() * tilde;
        drag.noalias() = unmixed_ * pulled;
        free.on_pairs.noalias() = weights * drag;
        tilde.tail(m) += free.on_pairs;
        free.dam.head(inner).noalias() += momentum_.topRows(inner) * slip;
        free.interface.noalias() += interface_momentum_ * slip;
    }
    add_product(pull_, tilde, free.interface);
    free.dam.tail(free.interface.size()) = free.interface;
}

std::size_t DynamicOperator::bytes() const
{
    const std::size_t rock =
        rock_step_ ? static_cast<std::size_t>(rock_step_->inverse().size() + rock_step_->modal_pull().size() +
                                              rock_step_->compliance().size() + rock_step_->rock().modes.size() +
                                              rock_step_->rock().damping.size() + rock_step_->rock().residual.size())
                   : 0;
    return factor_.bytes() + sizeof(double) * rock +
           sizeof(double) *
               static_cast<std::size_t>(interface_flexibility_.size() + pull_.size() + dam_flexibility_.size() +
                                        contact_.to_stuck.size() + contact_.stiffness->size() + momentum_.size());
}

} // namespace damslip::fe2d
