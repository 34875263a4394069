#include "fe2d/run/explicit_contact.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr int steps_between_products = 256; ///< of K u

} // namespace

ExplicitContact::ExplicitContact(std::shared_ptr<const ExplicitOperators> operators, SplitLoad load,
                                 const StaticState& start, const ContactMemory& memory)
    : operators_(std::move(operators)), load_(std::move(load)),
      largest_slips_(operators_->structure().planes(), memory.slip)
{
    const Index n = operators_->structure().dam_unknowns(), m = operators_->structure().pairs();
    state_.u = start.dam;
    state_.v = state_.a = VectorXd::Zero(n);
    state_.contact = memory;
    normal_force_ = memory.force.head(operators_->structure().plane().pairs()).sum();
    VectorXd deformation;
    operators_->structure().take_off_translations(state_.u, deformation);
    product_ = operators_->stiffness * deformation;
    rate_product_ = VectorXd::Zero(n);
    impulse_ = impulses_ = VectorXd::Zero(2 * m);
    energy_.strain = energy_start_.strain = 0.5 * deformation.dot(product_);
    counts_.factorisations = 0;
}

void ExplicitContact::advance(double dt, std::span<const GroundAcceleration> ground, const ContactLaw& law)
{
    impulses_.setZero();
    for (const GroundAcceleration& g : ground) step(dt, g, law);
    state_.contact.force = impulses_ / (dt * static_cast<double>(ground.size()));
}

void ExplicitContact::step(double dt, const GroundAcceleration& ground, const ContactLaw& law)
{
    const ExplicitOperators& op = *operators_;
    const ContactStructure& structure = op.structure();
    const GroundAcceleration& g = state_.ground;
    loads_ = load_.dam + g.h * structure.inertia_x() - g.v * structure.inertia_y();
    if (g.drag_h != 0.0 || g.drag_v != 0.0)
        loads_ += g.drag_h * structure.dam_inertia_x() - g.drag_v * structure.dam_inertia_y();
    damping_force_.setZero(loads_.size());
    op.add_damping(state_.v, rate_product_, damping_force_);

    const VectorXd v_before = state_.v;
    state_.a.noalias() = op.inverse * (loads_ - product_ - damping_force_); // without contact, for the moment
    state_.v += dt * state_.a;
    contact(dt, law);
    state_.v.noalias() += op.pull * impulse_;
    state_.a = (state_.v - v_before) / dt;
    state_.u += dt * state_.v;
    add_energy(dt, v_before);

    rate_product_.noalias() = op.stiffness.transpose() * state_.v;
    if (++since_product_ == steps_between_products) {
        since_product_ = 0;
        VectorXd deformation;
        structure.take_off_translations(state_.u, deformation);
        product_.noalias() = op.stiffness.transpose() * deformation;
    } else {
        product_ += dt * rate_product_;
    }
    impulses_ += impulse_;
    state_.time += dt;
    state_.ground = ground;
    ++counts_.steps;
    largest_slips_.look(state_.contact.slip);
}

/// Impulses from the rates without them, and what becomes of the gaps.
void ExplicitContact::contact(double dt, const ContactLaw& law)
{
    const ExplicitOperators& op = *operators_;
    ContactMemory& memory = state_.contact;
    const Index m = op.structure().pairs();
    const VectorXd rates = op.gaps * state_.v;
    bool landed = false;
    for (Index i = 0; i < m; ++i) {
        const ExplicitPair& pair = op.pairs[static_cast<std::size_t>(i)];
        ContactState& state = memory.states[static_cast<std::size_t>(i)];
        const ExplicitImpulse p = solve_pair(pair, rates[i], rates[m + i], -memory.opening[i] / dt, law.friction[i],
                                             law.cohesion[i] * dt, law.separation);
        impulse_[i] = p.normal;
        impulse_[m + i] = p.tangential;
        landed = landed || (state == ContactState::open && p.state != ContactState::open);
        state = p.state;
        if (p.state == ContactState::open)
            memory.opening[i] += dt * rates[i];
        else
            memory.opening[i] = 0.0;
        if (p.state != ContactState::stick)
            memory.slip[i] += dt * (rates[m + i] + pair.nt * p.normal + pair.tt * p.tangential);
    }
    counts_.landings += landed;
}

/// Before K u goes on: product_ is K u_n, state_.u is u_{n+1}.
void ExplicitContact::add_energy(double dt, const VectorXd& v_before)
{
    const ExplicitOperators& op = *operators_;
    const Index m = op.structure().pairs();
    const VectorXd mean = 0.5 * (state_.v + v_before), rates = op.gaps * mean;
    energy_.kinetic = 0.5 * state_.v.dot(op.mass * state_.v);
    VectorXd deformation;
    op.structure().take_off_translations(state_.u, deformation);
    energy_.strain = 0.5 * deformation.dot(product_);
    energy_.external += dt * mean.dot(loads_);
    energy_.damping += dt * mean.dot(damping_force_);
    energy_.contact_normal += impulse_.head(m).dot(rates.head(m));
    energy_.friction -= impulse_.tail(m).dot(rates.tail(m));
    energy_scale_ = std::max({energy_scale_, energy_.kinetic, std::abs(energy_.damping), std::abs(energy_.friction),
                              std::abs(energy_.external), std::abs(energy_.contact_normal)});
}

std::size_t ExplicitContact::bytes() const
{
    const auto entries =
        operators_->stiffness.nonZeros() + operators_->mass.nonZeros() + operators_->inverse.nonZeros();
    return static_cast<std::size_t>(entries) * (sizeof(double) + sizeof(int)) +
           10 * static_cast<std::size_t>(state_.u.size()) * sizeof(double);
}

} // namespace damslip::fe2d
