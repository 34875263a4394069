#include "fe2d/run/dynamic_contact.hpp"

#include <cmath>

/// What becomes of a step that is asked for: whole, or in halves where its contact is not resolved or its error too large.
namespace damslip::fe2d {

using Eigen::Index;
using Eigen::VectorXd;

/// Local error of the slips' area means, the largest of all planes [m]: (1/6 - β) Δt² (s̈₁ - s̈₀), what Newmark's formula
/// leaves of a linear acceleration (Zienkiewicz & Xie 1991), over the pairs that are not held all the step. It sees a
/// slide that begins or ends within the step once its contact is solved.
double DynamicContact::slip_error() const
{
    const StepConstants& c = op_->constants();
    const Index m = structure_.pairs();
    const ContactMemory& memory = state_.contact;
    VectorXd change = VectorXd::Zero(m);
    for (Index i = 0; i < m; ++i) {
        if (holds(memory.states, m + i) && holds(solution_.states, m + i)) continue;
        const double step = solution_.displacement[m + i] + elastic_[i] - memory.elastic[i];
        change[i] = c.a0 * step - c.a2 * rate_t_[i] - (c.a3 + 1.0) * accel_t_[i];
    }
    const VectorXd mean = structure_.planes().weights().transpose() * change;
    return std::abs(1.0 / 6.0 - c.scheme.beta) * c.dt * c.dt * mean.cwiseAbs().maxCoeff();
}

/// The same of the dam's displacements, root mean square over its mass [m]. Call when Δu is on free_.dam.
double DynamicContact::dam_error() const
{
    const StepConstants& c = op_->constants();
    const VectorXd &mass_x = structure_.dam_inertia_x(), &mass_y = structure_.dam_inertia_y();
    double sum = 0.0;
    for (Index i = 0; i < mass_x.size(); ++i) {
        const double change = c.a0 * free_.dam[i] - c.a2 * state_.v[i] - (c.a3 + 1.0) * state_.a[i];
        sum += (mass_x[i] + mass_y[i]) * change * change;
    }
    return std::abs(1.0 / 6.0 - c.scheme.beta) * c.dt * c.dt * std::sqrt(sum / mass_x.sum());
}

/// Asked when the contact of a step is known and nothing of the step is kept yet. @param cuts  that led to it
bool DynamicContact::wants_halves(const ContactReport& report, int cuts)
{
    const int more = control_ ? control_->largest_cuts : 0;
    if (!report.resolved() && cuts < largest_cuts + more) {
        ++counts_.halved;
        return true;
    }
    if (cuts >= more || control_->local_error == 0.0 || slip_error() <= control_->local_error) return false;
    ++counts_.refined;
    return true;
}

/// Asked again when all of the step is known.
bool DynamicContact::wants_halves(int cuts)
{
    if (!control_) return false;
    const double error = dam_error();
    if (cuts < control_->largest_cuts && control_->local_error > 0.0 && error > control_->local_error) {
        ++counts_.refined;
        return true;
    }
    local_errors_.push_back(error);
    // twice the step has eight times the error
    expected_cuts_ = 8.0 * error > control_->local_error ? cuts : std::max(0, cuts - 1);
    return false;
}

/// Nothing of the state has changed when the contact of a step turns out not to be resolved.
ContactReport DynamicContact::in_halves(double dt, const GroundAcceleration& ground, const ContactLaw& law, int cuts)
{
    const auto mean = [&](double GroundAcceleration::*part) { return 0.5 * (state_.ground.*part + ground.*part); };
    GroundAcceleration middle; // velocities by the trapezoid, displacements by velocities: acceleration is linear
    for (const auto part : {&GroundAcceleration::h, &GroundAcceleration::v, &GroundAcceleration::velocity_h,
                            &GroundAcceleration::velocity_v, &GroundAcceleration::displacement_v,
                            &GroundAcceleration::drag_h, &GroundAcceleration::drag_v})
        middle.*part = mean(part);
    const double eighth = dt / 8.0;
    middle.velocity_h -= eighth * (ground.h - state_.ground.h);
    middle.velocity_v -= eighth * (ground.v - state_.ground.v);
    middle.displacement_v -= eighth * (ground.velocity_v - state_.ground.velocity_v);
    const ContactReport first = step(0.5 * dt, middle, law, cuts + 1);
    ContactReport second = step(0.5 * dt, ground, law, cuts + 1);
    second.path = std::max(first.path, second.path);
    second.iterations += first.iterations;
    second.residual = std::max(first.residual, second.residual);
    return second;
}

ContactReport DynamicContact::step(double dt, const GroundAcceleration& ground, const ContactLaw& law, int cuts)
{
    if (control_ && cuts < std::min(expected_cuts_, control_->largest_cuts)) return in_halves(dt, ground, law, cuts);
    begin(dt, ground);
    op_->factor().forward(free_.dam);
    const ContactReport report = solve_contact(law);
    if (wants_halves(report, cuts)) return in_halves(dt, ground, law, cuts);
    accept();
    op_->factor().backward(free_.dam);
    if (wants_halves(cuts)) return in_halves(dt, ground, law, cuts);
    end(ground, report, law);
    return report;
}

ContactReport DynamicContact::advance(double dt, const GroundAcceleration& ground, const ContactLaw& law)
{
    return step(dt, ground, law, 0);
}

void DynamicContact::advance(std::span<Lane> lanes, double dt, const GroundAcceleration& ground)
{
    std::vector<VectorXd*> vectors;
    std::vector<Lane*> tried, whole;
    for (Lane& lane : lanes) {
        if (lane.run->expected_cuts_ > 0) {
            lane.report = lane.run->step(dt, ground, *lane.law, 0);
            continue;
        }
        lane.run->begin(dt, ground);
        tried.push_back(&lane);
        vectors.push_back(&lane.run->free_.dam);
    }
    if (tried.empty()) return;
    const InterfaceFactor& factor = tried.front()->run->op_->factor();
    factor.forward(vectors);
    vectors.clear();
    for (Lane* const one : tried) {
        Lane& lane = *one;
        lane.report = lane.run->solve_contact(*lane.law);
        if (lane.run->wants_halves(lane.report, 0)) {
            lane.report = lane.run->in_halves(dt, ground, *lane.law, 0);
            continue;
        }
        lane.run->accept();
        whole.push_back(&lane);
        vectors.push_back(&lane.run->free_.dam);
    }
    factor.backward(vectors);
    for (Lane* lane : whole)
        if (lane->run->wants_halves(0))
            lane->report = lane->run->in_halves(dt, ground, *lane->law, 0);
        else
            lane->run->end(ground, lane->report, *lane->law);
}

} // namespace damslip::fe2d
